// How tight the volumes are; and the hulls and visits that are drawn.
#include <algorithm>
#include <tuple>

#include "ch02_hull_hierarchy/study/tally.hpp"

namespace fc::hulls {

void study_tightness(const StudyCase& c, const StudyOptions& options) {
  constexpr int kNodes = 64, kDirections = 200;  // of a level; of a node
  struct Row {
    const char* name;
    Volume volume;
    int most;
  };
  const std::vector<Row> rows = {{"sphere", Volume::sphere, 0},    {"swept sphere", Volume::swept_sphere, 0},
                                 {"box", Volume::box, 0},          {"hull of 8", Volume::hull, 8},
                                 {"hull of 16", Volume::hull, 16}, {"hull of 32", Volume::hull, 32},
                                 {"hull of 64", Volume::hull, 64}};
  TableWriter table(options.out / "tightness.csv", {{"volume", ""},
                                                    {"level", ""},
                                                    {"nodes", ""},
                                                    {"radius", "m"},
                                                    {"overhang", "1"},
                                                    {"overhang_p95", "1"},
                                                    {"across", "1"}});
  const HullModel hulls = build_study_model(c.model, c.pieces, {Volume::hull, Leaves::triangles});
  std::vector<std::vector<int>> levels{{0}};
  while (!levels.back().empty()) {
    std::vector<int> next;
    for (const int n : levels.back()) {
      const HullNode& node = hulls.tree.nodes[n];
      if (!node.leaf()) next.insert(next.end(), {node.left, node.right});
    }
    std::erase_if(next, [&](int n) { return hulls.tree.nodes[n].leaf(); });
    levels.push_back(next);
  }
  const std::vector<Vec3> directions = even_directions(kDirections);
  for (const Row& row : rows) {
    const HullModel volumes =
        build_study_model(c.model, c.pieces, {row.volume, Leaves::triangles, std::max(4, row.most)});
    for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
      const std::vector<int>& nodes = levels[level];
      const int count = std::min(kNodes, static_cast<int>(nodes.size()));
      std::vector<double> all;
      double radius = 0, sum = 0, across = 0;
      for (int k = 0; k < count; ++k) {
        const int n = nodes[k * nodes.size() / count];
        const double r = hulls.tree.nodes[n].radius;
        radius += r / count;
        const Vec3 thin = thin_direction(hulls.tree.nodes[n].points);
        across += 0.5 / count * (overhang(volumes, hulls, n, thin) + overhang(volumes, hulls, n, -thin)) / r;
        for (const Vec3& d : directions) all.push_back(overhang(volumes, hulls, n, d) / r);
      }
      for (const double x : all) sum += x / static_cast<double>(all.size());
      table.row({row.name, static_cast<std::int64_t>(level), static_cast<std::int64_t>(nodes.size()), radius,
                 sum, quantile(all, 0.95), across});
    }
  }
  table.close();
}

void study_pictures(const StudyCase& c, const StudyOptions& options) {
  const HullModel hulls = build_study_model(c.model, c.pieces, {Volume::hull, Leaves::pieces});
  TableWriter table(options.out / "hulls.csv",
                    {{"level", ""}, {"node", ""}, {"x", "m"}, {"y", "m"}, {"z", "m"}});
  std::vector<int> level{0};
  for (std::int64_t depth = 0; depth <= 8; ++depth) {
    std::vector<int> next;
    for (const int n : level) {
      const HullNode& node = hulls.tree.nodes[n];
      if (depth % 2 == 0)
        for (const Vec3& p : node.points) table.row({depth, std::int64_t{n}, p.x(), p.y(), p.z()});
      if (!node.leaf()) next.insert(next.end(), {node.left, node.right});
    }
    level = std::move(next);
  }
  table.close();

  // The first of the far motions that hits after a while, as three searches see it.
  TocOptions asked = toc_options(kStudyTolerance * c.size);
  asked.max_pairs = kMostPairs;
  TableWriter visits(options.out / "visits.csv", {{"search", ""},
                                                  {"time", "s"},
                                                  {"step", "s"},
                                                  {"gap", "m"},
                                                  {"radii", "m"},
                                                  {"leaves", ""},
                                                  {"fate", ""}});
  for (const MotionPair& m : c.families[0].motions) {
    const TimeOfContact hit = time_of_contact(c.model, m.a, c.model, m.b, asked);
    if (hit.status != TimeOfContact::Status::reached || hit.time < 0.3) continue;
    for (const auto& [name, order, bound] : {std::tuple{"FAST's", Order::global, Bound::directional},
                                             std::tuple{"depth first", Order::depth_first, Bound::points},
                                             std::tuple{"ours", Order::best_first, Bound::points}}) {
      std::vector<Visit> seen;
      study_time_of_contact(hulls, m.a, hulls, m.b, asked, {order, bound, &seen});
      for (const Visit& v : seen)
        visits.row({name, v.time, v.step, v.gap, v.radii, std::int64_t{v.leaves}, name_of(v.fate)});
    }
    break;
  }
  visits.close();
}

}  // namespace fc::hulls
