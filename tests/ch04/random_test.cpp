// Bodies thrown together at random: no overlap, no energy from nowhere, no momentum lost.
#include <gtest/gtest.h>

#include <random>

#include "events.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

struct Random {
  std::mt19937_64 engine;
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  std::string vector(int n, double size) {
    std::string text;
    for (int i = 0; i < n; ++i) text += (i ? ", " : "[") + std::to_string((*this)(-size, size));
    return text + "]";
  }
};

const std::string head = R"(
step: {dt: 0.02, duration: 1}
restitution: 0.9
shapes:
  brick: {box: {size: [0.8, 0.5, 0.4]}, density: 1000}
  plate: {box: {size: [0.9, 0.9, 0.1]}, density: 500}
  slab: {box: {size: [5, 5, 1]}, density: 1}
  rock: {hull: {points: [[0.4, 0, 0], [-0.4, 0, 0], [0, 0.3, 0], [0, -0.3, 0], [0, 0, 0.3], [0, 0, -0.3]]}, density: 2500}
  ball: {sphere: {radius: 0.3}, density: 1000}
  rod: {capsule: {radius: 0.15, length: 0.6}, density: 1000}
bodies:
)";

// A closed tray of six slabs: inside it, |x|, |y| and |z| are below 1.5 m.
const std::string tray =
    "  - {shape: slab, static: true, position: [0, 0, -2]}\n"
    "  - {shape: slab, static: true, position: [0, 0, 2]}\n"
    "  - {shape: slab, static: true, position: [-2, 0, 0], orientation: [1, 0, 1, 0]}\n"
    "  - {shape: slab, static: true, position: [2, 0, 0], orientation: [1, 0, 1, 0]}\n"
    "  - {shape: slab, static: true, position: [0, -2, 0], orientation: [1, 1, 0, 0]}\n"
    "  - {shape: slab, static: true, position: [0, 2, 0], orientation: [1, 1, 0, 0]}\n";

// Eight bodies, one in each corner, flying towards the middle, more or less.
std::string thrown(Random& random, const std::vector<std::string>& shapes, double spacing = 0.8) {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    const double x = i & 1 ? spacing : -spacing, y = i & 2 ? spacing : -spacing,
                 z = i & 4 ? spacing : -spacing;
    text += "  - {shape: " + shapes[i % shapes.size()] + ", position: [" + std::to_string(x) + ", " +
            std::to_string(y) + ", " + std::to_string(z) + "], orientation: " + random.vector(4, 1) +
            ", spin: " + random.vector(3, 4) + ", velocity: [" + std::to_string(-3 * x + random(-1, 1)) +
            ", " + std::to_string(-3 * y + random(-1, 1)) + ", " + std::to_string(-3 * z + random(-1, 1)) +
            "]}\n";
  }
  return text;
}

independent::Mesh octahedron() {
  return {{{0.4, 0, 0}, {-0.4, 0, 0}, {0, 0.3, 0}, {0, -0.3, 0}, {0, 0, 0.3}, {0, 0, -0.3}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

independent::Solid solid(const std::string& shape) {
  if (shape == "slab") return independent::make_solid(independent::box({5, 5, 1}), 1);
  if (shape == "brick") return independent::make_solid(independent::box({0.8, 0.5, 0.4}), 1000);
  if (shape == "plate") return independent::make_solid(independent::box({0.9, 0.9, 0.1}), 500);
  return independent::make_solid(octahedron(), 2500);
}

std::vector<independent::Solid> solids_of(const fc::world::World& world) {
  std::vector<independent::Solid> solids;
  for (const auto& b : world.bodies) {
    solids.push_back(solid(world.shapes[b.shape].name));
    solids.back().is_static = b.state.is_static();
  }
  return solids;
}

const std::vector<std::string> flat{"brick", "plate", "rock"};

TEST(Thrown, InFreeSpaceKeepsMomentaAndNeverOverlaps) {
  int instants = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Random random{std::mt19937_64(seed)};
    auto world = make_world(head + thrown(random, flat));
    const Film seen = film(world, solids_of(world), 0.02, 40, 3, independent::How::tree);
    EXPECT_EQ(seen.watch.overlap, "");
    expect_laws(seen);
    instants += static_cast<int>(seen.jumps.size());
    for (const auto& report : seen.reports) EXPECT_EQ(report.lost_time, 0);
  }
  EXPECT_GT(instants, 100);
}

// Impacts pile up, and groups of bodies are frozen: nothing overlaps at any frame's end, by code that shares nothing with ours.
TEST(Thrown, WithHardlyAnyRestitutionFrozenGroupsNeverOverlap) {
  double lost = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Random random{std::mt19937_64(seed)};
    auto world = make_world(head + thrown(random, flat), {seed % 2 ? "restitution=0" : "restitution=0.2"});
    const Film seen = film(world, solids_of(world), 0.02, 40, 1, independent::How::tree);
    EXPECT_EQ(seen.watch.overlap, "");
    expect_laws(seen);
    for (const auto& report : seen.reports) lost += report.lost_time;
  }
  EXPECT_GT(lost, 0) << "or this tests nothing";
}

TEST(Thrown, InAClosedTrayNeverLeavesIt) {
  int instants = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random{std::mt19937_64(seed)};
    auto world =
        make_world(head + tray + thrown(random, flat), {seed % 2 ? "restitution=1" : "restitution=0.6"});
    const Film seen = film(world, solids_of(world), 0.02, 40, 2, independent::How::tree);
    EXPECT_EQ(seen.watch.overlap, "");
    expect_laws(seen, false);
    instants += static_cast<int>(seen.jumps.size());
    for (int i = 6; i < 14; ++i) EXPECT_LT(body(world, i).position.lpNorm<Eigen::Infinity>(), 1.5) << i;
  }
  EXPECT_GT(instants, 200);
}

TEST(Thrown, UnderGravityGainsNoEnergyAndNeverOverlaps) {
  double lost = 0;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    SCOPED_TRACE(seed);
    Random random{std::mt19937_64(seed)};
    auto world =
        make_world("gravity: [0, 0, -9.81]" + head + tray + thrown(random, flat), {"restitution=0.3"});
    const auto solids = solids_of(world);
    for (int frame = 0; frame < 40; ++frame) {
      // Between impacts the spin is constant, which is not what a free brick does: its energy may go either
      // way there. At impacts it may only fall.
      const Film seen = film(world, solids, 0.02, 1, 1, independent::How::tree);
      EXPECT_EQ(seen.watch.overlap, "") << frame;
      expect_laws(seen, false);
      EXPECT_LE(seen.reports[0].energy_gain, 1e-12 * (1 + kinetic_energy(world)));
      lost += seen.reports[0].lost_time;
    }
  }
  std::cout << "lost time " << lost << " s\n";
}

// Closed forms for what is round.
double point_box(const Vec3& point, const fc::RigidBody& box, const Vec3& half) {
  const Vec3 local = box.pose().rotation.transpose() * (point - box.position);
  return (local.cwiseAbs() - half).cwiseMax(0.0).norm();
}

// The least of a convex function over a segment, by thirds.
template <class F>
double least(const Vec3& p, const Vec3& q, F&& f) {
  double low = 0, high = 1;
  for (int i = 0; i < 100; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    if (f(p + a * (q - p)) < f(p + b * (q - p)))
      high = b;
    else
      low = a;
  }
  return f(p + 0.5 * (low + high) * (q - p));
}

std::pair<Vec3, Vec3> axis(const fc::world::World& world, int i) {
  const bool rod = world.shapes[world.bodies[i].shape].name == "rod";
  const Vec3 half = body(world, i).pose().rotation * Vec3(0, 0, rod ? 0.3 : 0);
  return {body(world, i).position - half, body(world, i).position + half};
}

double gap(const fc::world::World& world, int a, int b) {
  const auto radius = [&](int i) {
    const std::string& name = world.shapes[world.bodies[i].shape].name;
    return name == "ball" ? 0.3 : name == "rod" ? 0.15 : 0;
  };
  if (radius(a) == 0 && radius(b) == 0) return 1;  // seen by the other tests
  if (radius(a) == 0) std::swap(a, b);
  const auto [p, q] = axis(world, a);
  if (radius(b) == 0) {
    const Vec3 half =
        world.shapes[world.bodies[b].shape].name == "slab" ? Vec3(2.5, 2.5, 0.5) : Vec3(0.4, 0.25, 0.2);
    return least(p, q, [&](const Vec3& x) { return point_box(x, body(world, b), half); }) - radius(a);
  }
  const auto [r, s] = axis(world, b);
  const auto to_b = [&, r = r, s = s](const Vec3& x) {
    const Vec3 along = s - r;
    const double length = along.squaredNorm(),
                 t = length > 0 ? std::clamp((x - r).dot(along) / length, 0.0, 1.0) : 0;
    return (x - r - t * along).norm();
  };
  return least(p, q, to_b) - radius(a) - radius(b);
}

TEST(Thrown, RoundBodiesInATrayNeverOverlap) {
  int instants = 0;
  double smallest = 1;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Random random{std::mt19937_64(seed)};
    auto world = make_world((seed % 2 ? "gravity: [1, 2, -9]" : "") + head + tray +
                            thrown(random, {"ball", "rod", "brick"}));
    for (int frame = 0; frame < 40; ++frame) {
      const auto report =
          fc::world::step(world, 0.02, {.instant = [&](const fc::world::World&, double) { ++instants; }});
      EXPECT_LE(report.energy_gain, 1e-12 * (1 + kinetic_energy(world)));
      EXPECT_LE(report.lcp_residual, 1e-10);
      for (int a = 0; a < 14; ++a)
        for (int b = std::max(a + 1, 6); b < 14; ++b) {
          smallest = std::min(smallest, gap(world, a, b));
          ASSERT_GT(gap(world, a, b), 0) << a << " " << b << " in frame " << frame;
        }
    }
  }
  EXPECT_GT(instants, 200);
  EXPECT_LT(smallest, 1e-2) << "they come close";
}

}  // namespace
