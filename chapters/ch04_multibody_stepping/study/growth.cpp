// What a gas costs, from ten bodies to thousands.
#include <cmath>

#include "ch04_multibody_stepping/study/parts.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::world {
namespace {

constexpr double kFrame = 1.0 / 60;  // s
constexpr int kFrames = 60, kWarmUp = 5;

}  // namespace

void study_growth(const StudyOptions& options) {
  TableWriter table(options.out / "growth.csv", {{"kind", ""},
                                                 {"bodies", ""},
                                                 {"frames", ""},
                                                 {"impacts", ""},
                                                 {"pairs_per_body_and_frame", ""},
                                                 {"queries_per_impact", ""},
                                                 {"energy_drift", ""},
                                                 {"frame_ns", ""},
                                                 {"impact_ns", ""}});
  constexpr std::array kKinds = {std::pair{Kind::ball, "balls"}, std::pair{Kind::block, "blocks"},
                                 std::pair{Kind::hull, "hulls"}};
  constexpr std::array kBodies = {10, 30, 100, 300, 1000, 3000};
  Progress progress("growth", static_cast<std::int64_t>(kKinds.size() * kBodies.size()), options.quiet);
  std::int64_t done = 0;
  for (const auto& [kind, name] : kKinds)
    for (const int bodies : kBodies) {
      progress.update(++done);
      if (bodies > options.bodies) continue;
      World world = build_world(gas(kind, bodies, 1));
      run_frames(world, kFrame, kWarmUp);
      const Run run = run_frames(world, kFrame, kFrames);
      const double impacts = std::max(1, run.sum.impacts);
      table.row({std::string(name), std::int64_t{bodies}, std::int64_t{kFrames},
                 std::int64_t{run.sum.impacts}, static_cast<double>(run.sum.pairs) / (bodies * kFrames),
                 static_cast<double>(run.sum.queries) / impacts, run.energy_drift, run.total_ns() / kFrames,
                 run.total_ns() / impacts});
    }
  table.close();
}

}  // namespace fc::world
