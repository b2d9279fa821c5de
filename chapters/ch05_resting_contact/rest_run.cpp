#include "ch05_resting_contact/rest_run.hpp"

#include <fmt/format.h>

#include <memory>

#include "ch05_resting_contact/show_rest.hpp"

namespace fc::resting {
namespace {

constexpr double kWide = 10;  // times g dt^2: a wider envelope is called wide

}  // namespace

std::vector<Effect> explain(const Scene& scene) {
  return explain(scene, world::build_world(scene));
}

std::vector<Effect> explain(const Scene& scene, const world::World& world) {
  std::vector<Effect> list = world::explain(scene);
  const double margin = envelope_of(scene, world, scene.step->dt);
  const std::string why = scene.mark("envelope") ? "declared at " + scene.mark("envelope")->text()
                                                 : "derived: friction needs contacts that last";
  list.push_back({"envelope", why,
                  fmt::format("bodies nearer than {:.3g} m are in contact, and rest {:.3g} m apart", margin,
                              0.5 * margin),
                  0});
  const double fall =
      world.effects.gravity ? world.effects.gravity->norm() * scene.step->dt * scene.step->dt : 0;
  if (fall > 0 && margin > kWide * fall)
    list.push_back(
        {"wide envelope", why,
         fmt::format(
             "{:.3g} times what gravity and the frame's length need (g dt^2): few impacts bounce; narrow it, "
             "or use longer frames",
             margin / fall),
         0});
  list.push_back(
      {"plans", why,
       "the bodies of an island go on together: one LCP for the gaps at the plan's end, another corrects gaps",
       2});
  list.push_back(
      {"impact law", why,
       fmt::format("at each instant: compression, and expansion if something comes in faster than {:.3g} m/s "
                   "(envelope / dt)",
                   margin / scene.step->dt),
       1});
  return list;
}

std::string clash_text(const Scene& scene, const Clash& clash) {
  const auto where = [&](int body) { return scene.bodies[static_cast<std::size_t>(body)].where.text(); };
  return fmt::format(
      "{}: this kinematic body runs into the one of {}, which cannot give way either; nothing stops it",
      where(clash.kinematic), where(clash.other));
}

void report_clash(const Scene& scene, const Clash& clash, double frame_start) {
  fmt::print(stderr, "{} (at {:.6g} s)\n", clash_text(scene, clash), frame_start + clash.time);
}

int run_scene(const Scene& scene, const RunContext& context, Summary& summary, const RunOptions& options) {
  std::unique_ptr<Resting> resting;
  RestReport all, last;
  int frame = 0, clashes = 0;
  const auto prepare = [&](world::World& world) {
    resting = std::make_unique<Resting>(scene, world, scene.step->dt, RestOptions{},
                                        options.law ? options.law(world) : nullptr);
  };
  const auto step = [&](world::World& world, double, const world::Listeners& listeners) {
    const RestReport& report = last = resting->step(world, listeners);
    all.resting += report.resting;
    all.plans += report.plans;
    all.searched += report.searched;
    all.checked += report.checked;
    all.sweeps += report.sweeps;
    all.shortened += report.shortened;
    all.lost_impulse += report.lost_impulse;
    all.correction_energy += report.correction_energy;
    all.correction = std::max(all.correction, report.correction);
    all.largest_island = std::max(all.largest_island, report.largest_island);
    for (const Clash& clash : report.clashes) report_clash(scene, clash, frame * scene.step->dt);
    clashes += static_cast<int>(report.clashes.size());
    ++frame;
    return report.step;
  };
  world::MoreColumns more, of_law;
  if (options.columns) of_law = options.columns(last);
  more.columns = {{"correction_energy", "J"}, {"shortened", ""}, {"lost_impulse", "N s"}};
  more.columns.insert(more.columns.end(), of_law.columns.begin(), of_law.columns.end());
  more.cells = [&] {
    std::vector<Cell> cells{last.correction_energy, std::int64_t{last.shortened}, last.lost_impulse};
    if (of_law.cells)
      for (const Cell& cell : of_law.cells()) cells.push_back(cell);
    return cells;
  };
  more.contact_columns = of_law.contact_columns;
  more.contact_cells = of_law.contact_cells;
  world::FrameAccount account = options.account ? options.account : world::FrameAccount(show_frame);
  if (context.clear) account = {};  // it would show other methods than those that run
  const int code = world::run_scene(scene, context, summary, step, true, prepare, more, account);
  summary.add("envelope", resting->envelope(), "m");
  summary.add("nothing bounces below (envelope / dt)", resting->envelope() / scene.step->dt, "m/s");
  summary.add("resting contacts with an impulse", std::int64_t{all.resting});
  summary.add("largest island", std::int64_t{all.largest_island}, "contact points");
  summary.add("largest correction of a position in a plan", all.correction, "m");
  summary.add("energy added by corrections", all.correction_energy, "J");
  summary.add("bodies whose paths were shortened", std::int64_t{all.shortened});
  summary.add("momentum that shortened paths took", all.lost_impulse, "N s");
  if (clashes > 0) summary.add("kinematic bodies that ran into what cannot give way", std::int64_t{clashes});
  summary.counter("plans", all.plans, 0);
  summary.counter("paths of pairs that were proved", all.checked, 0);
  summary.counter("envelope (pairs whose contacts were searched)", all.searched, 0);
  summary.counter("sweeps of Gauss-Seidel", all.sweeps, 0);
  return code;
}

void check(const Scene& scene) {
  world::World world = world::build_world(scene);
  Resting(scene, world, scene.step->dt);
}

}  // namespace fc::resting
