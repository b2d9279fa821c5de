// ch02_pictures: what chapter 2's drawings show, computed by its own code: two small flat bodies, their trees of hulls, each
// look of the search, the same by global steps; and the convex pieces of a dish.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "ch01_convex_advancement/gjk.hpp"
#include "ch02_hull_hierarchy/convex_pieces.hpp"
#include "ch02_hull_hierarchy/hull_model.hpp"
#include "ch02_hull_hierarchy/study/search.hpp"
#include "common/convex_hull.hpp"
#include "common/errors.hpp"
#include "common/table.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;
using clear::Look;

using Polygon = std::vector<Vec3>;

// A body of the drawings: convex polygons in the plane, each named by a letter or a digit.
struct Flat {
  std::string names;
  std::vector<Polygon> pieces;
  ca::Motion motion;
  HullModel model;
};

Flat flat(std::string names, std::vector<Polygon> pieces, const Vec3& position, const Vec3& velocity,
          double spin) {
  Flat body{std::move(names), std::move(pieces), {}, {}};
  body.motion.position = position;
  body.motion.velocity = velocity;
  body.motion.spin = Vec3(0, 0, spin);
  body.motion.spin_rate = std::abs(spin);
  for (const Polygon& piece : body.pieces)
    for (const Vec3& p : piece) body.model.reach = std::max(body.model.reach, p.norm());
  body.model.tree = clear::hull_tree(body.pieces);
  return body;
}

Polygon polygon(std::initializer_list<std::array<double, 2>> corners) {
  Polygon points;
  for (const auto& [x, y] : corners) points.emplace_back(x, y, 0);
  return points;
}

// Four parts of a ring that is open on its right.
std::vector<Polygon> claw() {
  const std::array<double, 5> angle = {0.85, 1.9, 3.0, 4.2, 5.3}, outer = {1.05, 1.15, 1.1, 1.15, 1.1},
                              inner = {0.8, 0.72, 0.7, 0.72, 0.85};
  std::vector<Polygon> parts;
  const auto at = [&](int k, double r) { return Vec3(r * std::cos(angle[k]), r * std::sin(angle[k]), 0); };
  for (int k = 0; k < 4; ++k)
    parts.push_back({at(k, outer[k]), at(k + 1, outer[k + 1]), at(k + 1, inner[k + 1]), at(k, inner[k])});
  return parts;
}

std::string name_of(const Flat& body, int node) {
  const HullNode& n = body.model.tree.nodes[node];
  if (n.leaf()) return {body.names[n.piece]};
  std::string name = name_of(body, n.left) + name_of(body, n.right);
  std::sort(name.begin(), name.end());
  return name;
}

void write_nodes(const std::filesystem::path& file,
                 const std::vector<std::pair<std::string, const Flat*>>& bodies) {
  TableWriter table(file, {{"body", ""},
                           {"node", ""},
                           {"name", ""},
                           {"left", ""},
                           {"right", ""},
                           {"radius", "m"},
                           {"x", "m"},
                           {"y", "m"}});
  for (const auto& [name, body] : bodies)
    for (std::size_t n = 0; n < body->model.tree.nodes.size(); ++n) {
      const HullNode& node = body->model.tree.nodes[n];
      for (const Vec3& p : node.points)
        table.row({name, static_cast<std::int64_t>(n), name_of(*body, static_cast<int>(n)),
                   std::int64_t{node.left}, std::int64_t{node.right}, node.radius, p.x(), p.y()});
    }
  table.close();
}

void write_motions(const std::filesystem::path& file,
                   const std::vector<std::pair<std::string, const Flat*>>& bodies) {
  TableWriter table(file,
                    {{"body", ""}, {"x", "m"}, {"y", "m"}, {"vx", "m/s"}, {"vy", "m/s"}, {"spin", "rad/s"}});
  for (const auto& [name, body] : bodies) {
    const ca::Motion& m = body->motion;
    table.row({name, m.position.x(), m.position.y(), m.velocity.x(), m.velocity.y(), m.spin.z()});
  }
  table.close();
}

// The looks, each with the plane that it found and the queue that it left, earliest first.
void write_looks(const std::filesystem::path& file, const Flat& a, const Flat& b,
                 const std::vector<Look>& looks) {
  TableWriter table(file, {{"look", ""},
                           {"time", "s"},
                           {"a", ""},
                           {"b", ""},
                           {"pair", ""},
                           {"gap", "m"},
                           {"speed", "m/s"},
                           {"next", "s"},
                           {"radii", "m"},
                           {"nx", ""},
                           {"ny", ""},
                           {"fate", ""},
                           {"queue", ""}});
  struct Waits {
    double time;
    std::string name;
  };
  std::vector<Waits> queue{{0, name_of(a, 0) + "–" + name_of(b, 0)}};
  std::int64_t number = 0;
  for (const Look& look : looks) {
    const HullNode &x = a.model.tree.nodes[look.a], &y = b.model.tree.nodes[look.b];
    const auto pair = [&](int i, int j) { return name_of(a, i) + "–" + name_of(b, j); };
    const std::string name = pair(look.a, look.b);
    const auto at = std::find_if(queue.begin(), queue.end(), [&](const Waits& w) { return w.name == name; });
    if (at == queue.end()) throw NumericalFailure("a pair was looked at that was not in the queue: " + name);
    queue.erase(at);
    if (look.fate == Look::Fate::advanced) queue.push_back({look.next, name});
    if (look.fate == Look::Fate::opened) {
      const bool open_a = y.leaf() || (!x.leaf() && x.radius >= y.radius);
      for (const int child : open_a ? std::array{x.left, x.right} : std::array{y.left, y.right})
        queue.push_back({look.next, open_a ? pair(child, look.b) : pair(look.a, child)});
    }
    std::stable_sort(queue.begin(), queue.end(),
                     [](const Waits& p, const Waits& q) { return p.time < q.time; });
    std::string waiting;
    for (const Waits& w : queue)
      if (w.time < 1) waiting += fmt::format("{}{} {:.3f}", waiting.empty() ? "" : ", ", w.name, w.time);
    if (look.fate == Look::Fate::contact) waiting = "(not looked at any more)";
    const ca::GjkResult g = ca::distance(a.model.convex(x), b.model.convex(y),
                                         ca::PairPose(a.motion, b.motion, look.time), {1e-9, 1e-6, 128});
    constexpr const char* kFates[] = {"advanced", "opened", "contact"};
    table.row({++number, look.time, std::int64_t{look.a}, std::int64_t{look.b}, name, look.gap, look.speed,
               std::min(look.next, 1e9), x.radius + y.radius, g.normal.x(), g.normal.y(),
               kFates[static_cast<int>(look.fate)], waiting.empty() ? "empty" : waiting});
  }
  table.close();
}

// What a search by global steps looks at, and the gap of each pair of nodes over time.
void write_rounds(const std::filesystem::path& file, const Flat& a, const Flat& b,
                  const TocOptions& options) {
  std::vector<Visit> visits;
  study_time_of_contact(a.model, a.motion, b.model, b.motion, options,
                        {Order::global, Bound::directional, &visits});
  TableWriter table(file, {{"time", "s"}, {"pair", ""}, {"step", "s"}});
  for (const Visit& visit : visits)
    table.row({visit.time, name_of(a, visit.a) + "–" + name_of(b, visit.b), std::min(visit.step, 1e9)});
  table.close();
}
void write_gaps(const std::filesystem::path& file, const Flat& a, const Flat& b) {
  TableWriter table(file, {{"pair", ""}, {"time", "s"}, {"gap", "m"}});
  for (int i = 0; i < static_cast<int>(a.model.tree.nodes.size()); ++i)
    for (int j = 0; j < static_cast<int>(b.model.tree.nodes.size()); ++j)
      for (int k = 0; k <= 50; ++k) {
        const double t = k / 50.0;
        const ca::GjkResult g =
            ca::distance(a.model.convex(a.model.tree.nodes[i]), b.model.convex(b.model.tree.nodes[j]),
                         ca::PairPose(a.motion, b.motion, t), {1e-9, 1e-6, 128});
        table.row({name_of(a, i) + "–" + name_of(b, j), t, std::max(0.0, g.lower)});
      }
  table.close();
}

// A dish: an arc of a thick shell, straight along z. Its section and its pieces, seen along z.
void write_dish(const std::filesystem::path& out) {
  constexpr int kSegments = 8;
  constexpr double kOpening = 1.9, kOuter = 1, kThickness = 0.09, kDepth = 0.6;
  TriangleMesh mesh;
  for (int side = 0; side < 2; ++side)  // z
    for (int shell = 0; shell < 2; ++shell)
      for (int k = 0; k <= kSegments; ++k) {
        const double angle = kOpening * (static_cast<double>(k) / kSegments - 0.5),
                     r = kOuter - shell * kThickness;
        mesh.vertices.emplace_back(r * std::sin(angle), -r * std::cos(angle), side * kDepth);
      }
  const auto at = [](int side, int shell, int k) { return (side * 2 + shell) * (kSegments + 1) + k; };
  const auto quad = [&](int i, int j, int k, int l) {
    mesh.triangles.push_back({i, j, k});
    mesh.triangles.push_back({i, k, l});
  };
  for (int k = 0; k < kSegments; ++k) {
    quad(at(0, 0, k), at(0, 0, k + 1), at(1, 0, k + 1), at(1, 0, k));  // outer
    quad(at(0, 1, k), at(1, 1, k), at(1, 1, k + 1), at(0, 1, k + 1));  // inner
    quad(at(1, 0, k), at(1, 0, k + 1), at(1, 1, k + 1), at(1, 1, k));  // front
    quad(at(0, 0, k), at(0, 1, k), at(0, 1, k + 1), at(0, 0, k + 1));  // back
  }
  quad(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0));
  quad(at(0, 0, kSegments), at(0, 1, kSegments), at(1, 1, kSegments), at(1, 0, kSegments));
  if (signed_volume(mesh) < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  const FeatureMesh features = build_feature_mesh(mesh, true);
  TableWriter section(out / "dish.csv", {{"shell", ""}, {"x", "m"}, {"y", "m"}});
  for (int shell = 0; shell < 2; ++shell)
    for (int k = 0; k <= kSegments; ++k) {
      const Vec3& p = mesh.vertices[at(0, shell, k)];
      section.row({std::int64_t{shell}, p.x(), p.y()});
    }
  section.close();
  TableWriter pieces(out / "dish_pieces.csv", {{"piece", ""}, {"x", "m"}, {"y", "m"}});
  std::int64_t number = 0;
  for (const std::vector<Vec3>& points : points_of_pieces(features, convex_pieces(features))) {
    for (const Vec3& p : points) pieces.row({number, p.x(), p.y()});
    ++number;
  }
  pieces.close();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Writes the tables that chapter 2's drawings are made of.\n\n  build/bin/ch02_pictures --out out/ch02/pictures"};
  std::filesystem::path out = "out/ch02/pictures";
  app.add_option("--out", out, "The folder for the tables")->capture_default_str()->type_name("DIR");
  CLI11_PARSE(app, argc, argv);
  try {
    std::filesystem::create_directories(out);
    const Flat a = flat("abcd", claw(), Vec3(-1.9, 0, 0), Vec3(2, -0.1, 0), 0.7);
    const Flat b = flat("123",
                        {polygon({{-1.1, -0.1}, {0, -0.22}, {0, 0.22}, {-1.1, 0.1}}),
                         polygon({{0, 0.02}, {0.75, -0.05}, {0.6, 0.9}, {-0.1, 0.75}}),
                         polygon({{0, -0.02}, {-0.1, -0.8}, {0.65, -0.9}, {0.75, -0.09}})},
                        Vec3(0.9, 0, 0), Vec3::Zero(), 0);
    const std::vector<std::pair<std::string, const Flat*>> bodies = {{"A", &a}, {"B", &b}};
    write_nodes(out / "nodes.csv", bodies);
    write_motions(out / "motions.csv", bodies);
    std::vector<Look> looks;
    clear::SearchOptions search;
    search.target = 0.01;
    search.slack = 0.005;
    search.looks = &looks;
    clear::search(a.model, a.motion, b.model, b.motion, search, {});
    write_looks(out / "looks.csv", a, b, looks);
    TocOptions options;
    options.target = search.target;
    options.slack = search.slack;
    options.start = options.tolerance = 0.02;
    write_rounds(out / "rounds.csv", a, b, options);
    write_gaps(out / "gaps.csv", a, b);
    write_dish(out);
  } catch (const std::exception& error) {
    fmt::print(stderr, "ch02_pictures: {}\n", error.what());
    return 3;
  }
  return 0;
}
