// Demo of exercise 2.3: two bumpy balls fly past each other until they touch. How many pairs of hulls does
// your search look at, and how many a global step and a depth-first search? Writes looks.csv.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "ch02_hull_hierarchy/hull_model.hpp"
#include "ch02_hull_hierarchy/steps.hpp"
#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex03_own_time.hpp"

namespace {

using namespace fc;
using exercises::Found;
using exercises::Look;
using exercises::Pairs;

// A ball of about 1 m with dents and bumps.
hulls::HullModel bumpy_ball() {
  constexpr int around = 48, rings = 24;
  Shape shape;
  shape.kind = Shape::Kind::mesh;
  const auto bump = [](double theta, double phi) {
    return 1 + 0.12 * std::sin(5 * phi) * std::sin(theta) * std::sin(4 * theta);
  };
  for (int i = 1; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double theta = std::numbers::pi * i / rings, phi = 2 * std::numbers::pi * k / around;
      shape.core.vertices.push_back(bump(theta, phi) * Vec3(std::sin(theta) * std::cos(phi),
                                                            std::sin(theta) * std::sin(phi),
                                                            std::cos(theta)));
    }
  const int top = static_cast<int>(shape.core.vertices.size()), bottom = top + 1;
  shape.core.vertices.emplace_back(0, 0, 1);
  shape.core.vertices.emplace_back(0, 0, -1);
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around, last = around * (rings - 2);
    shape.core.triangles.push_back({top, k, next});
    shape.core.triangles.push_back({bottom, last + next, last + k});
    for (int i = 0; i < rings - 2; ++i) {
      shape.core.triangles.push_back({i * around + k, (i + 1) * around + k, (i + 1) * around + next});
      shape.core.triangles.push_back({i * around + k, (i + 1) * around + next, i * around + next});
    }
  }
  return hulls::build_hull_model(hulls::build_model(shape));
}

// Two hierarchies of hulls as Pairs; counts the looks.
struct Balls {
  hulls::HullModel model = bumpy_ball();
  ca::Motion motion_a, motion_b;
  double interval = 2, tolerance = 1e-6;
  std::int64_t looks = 0;

  Pairs pairs() {
    looks = 0;
    return {0, [this](int pair, double t) { return look(pair, t); }};
  }
  Look look(int pair, double t) {
    ++looks;
    const int nodes = static_cast<int>(model.tree.nodes.size()), i = pair / nodes, j = pair % nodes;
    const hulls::HullNode &x = model.tree.nodes[i], &y = model.tree.nodes[j];
    const ca::Convex hull_a = model.convex(x), hull_b = model.convex(y);
    const ca::PairPose pose(motion_a, motion_b, t);
    const ca::GjkResult g = ca::distance(hull_a, hull_b, pose, {tolerance / 8, 1e-6, 128});
    const double room = g.lower - tolerance / 2;
    const double step = room > 0 ? hulls::ball_step(motion_a, hull_a, x.radius, motion_b, hull_b, y.radius,
                                                    pose, g.normal, t, interval, room)
                                       .time
                                 : 0;
    if (x.leaf() && y.leaf()) return {t + step, g.upper <= tolerance, {}};
    if (!x.leaf() && (y.leaf() || x.radius >= y.radius))
      return {t + step, false, {x.left * nodes + j, x.right * nodes + j}};
    return {t + step, false, {i * nodes + y.left, i * nodes + y.right}};
  }
};

// Like FAST and C2A: the shortest safe step of all pairs of leaves, from the roots down, again and again.
struct GlobalStep {
  const Pairs& pairs;
  double t = 0, until = 0;
  bool reached = false;

  void visit(const Look& look) {
    if (look.reached) reached = true;
    if (reached || look.clear_until >= until) return;
    if (look.children.empty()) until = look.clear_until;
    std::vector<Look> below;
    for (const int child : look.children) below.push_back(pairs.look(child, t));
    std::sort(below.begin(), below.end(),
              [](const Look& x, const Look& y) { return x.clear_until < y.clear_until; });
    for (const Look& child : below) visit(child);
  }
  Found run(double interval) {
    for (t = 0; t < interval; t = until) {
      until = interval;
      visit(pairs.look(pairs.root, t));
      if (reached) return {ca::Status::contact, t, -1};
    }
    return {ca::Status::separated, interval, -1};
  }
};

// Takes each pair of leaves to its own contact, in the order of the trees, unless an earlier contact is
// known.
void depth_first(const Pairs& pairs, int pair, double t, Found& best) {
  while (t < best.time) {
    const Look look = pairs.look(pair, t);
    if (look.reached) {
      best = {ca::Status::contact, t, pair};
      return;
    }
    t = look.clear_until;
    for (const int child : look.children) depth_first(pairs, child, t, best);
    if (!look.children.empty()) return;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch02_ex03";
  Balls balls;
  RigidBody a, b;
  a.spin = {0.4, 0.1, 1.5};
  b.position = {3, 0.9, 0.4};
  b.velocity = {-1, 0, 0};
  b.spin = {0.3, -1, 0.2};
  balls.motion_a = ca::Motion(a);
  balls.motion_b = ca::Motion(b);
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "looks.csv",
                      {{"search", ""}, {"tolerance", "m"}, {"looks", ""}, {"time of contact", "s"}});
    for (const char* search : {"global step", "depth first", "yours"}) {
      for (int digits = 1; digits <= 11; ++digits) {
        balls.tolerance = std::pow(10, -digits);
        const Pairs pairs = balls.pairs();
        Found found{ca::Status::separated, balls.interval, -1};
        if (search == std::string("global step"))
          found = GlobalStep{pairs}.run(balls.interval);
        else if (search == std::string("depth first"))
          depth_first(pairs, pairs.root, 0, found);
        else
          found = exercises::first_contact(pairs, balls.interval, 10'000'000);
        table.row({std::string(search), balls.tolerance, balls.looks, found.time});
        if (digits % 5 == 1)
          std::printf("%s, tolerance %g m: %s at %.9f s after %ld looks\n", search, balls.tolerance,
                      ca::name_of(found.status), found.time, static_cast<long>(balls.looks));
      }
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch02_ex03_own_time.py %s\n", folder.string().c_str());
}
