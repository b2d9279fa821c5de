// Chapter 5: resting and sliding contact, by plans for the bodies that are nearer than the envelope; all else is chapter 4's.
#include <fmt/format.h>

#include <memory>

#include "ch04_multibody_stepping/run.hpp"
#include "ch05_resting_contact/resting.hpp"

namespace {

using namespace fc;

constexpr double kWide = 10;  // g dt^2: from here on an envelope is called wide

std::vector<Effect> explain(const Scene& scene) {
  std::vector<Effect> list = world::explain(scene);
  if (!scene.envelope) return list;
  const world::World world = world::build_world(scene);
  const double margin = resting::envelope_of(scene, world, scene.step->dt);
  const std::string why = "declared at " + scene.mark("envelope")->text();
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
             "{:.3g} times what gravity and a frame's length ask for (g dt^2): little bounces; narrow it, "
             "or take longer frames",
             margin / fall),
         0});
  list.push_back({"plans", why,
                  "an island goes on together: an LCP of gaps at the plan's end, another puts gaps right",
                  2});
  list.push_back(
      {"impact law", why,
       fmt::format("at each instant: compression, and expansion if something comes in faster than {:.3g} m/s "
                   "(envelope / dt)",
                   margin / scene.step->dt),
       1});
  return list;
}

// frame: s, its start.
void report_clash(const Scene& scene, const resting::Clash& clash, double frame) {
  const auto where = [&](int body) { return scene.bodies[static_cast<std::size_t>(body)].where.text(); };
  fmt::print(
      stderr,
      "{}: this driven body goes into the one of {}, which does not give way either, at {:.6g} s; nothing "
      "stops it\n",
      where(clash.kinematic), where(clash.other), frame + clash.time);
}

int run(const Scene& scene, const RunContext& context, Summary& summary) {
  if (!scene.envelope)
    return world::run_scene(scene, context, summary, world::step, true);  // chapter 4's motion, to the byte
  std::unique_ptr<resting::Resting> resting;
  resting::RestReport all, last;
  int frame = 0, clashes = 0;
  const auto prepare = [&](world::World& world) {
    resting = std::make_unique<resting::Resting>(scene, world, scene.step->dt);
  };
  const auto step = [&](world::World& world, double, const world::Listeners& listeners) {
    const resting::RestReport& report = last = resting->step(world, listeners);
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
    for (const resting::Clash& clash : report.clashes) report_clash(scene, clash, frame * scene.step->dt);
    clashes += static_cast<int>(report.clashes.size());
    ++frame;
    return report.step;
  };
  const world::MoreColumns more = {
      {{"correction_energy", "J"}, {"shortened", ""}, {"lost_impulse", "N s"}}, [&last] {
        return std::vector<Cell>{last.correction_energy, std::int64_t{last.shortened}, last.lost_impulse};
      }};
  const int code = world::run_scene(scene, context, summary, step, true, prepare, more);
  summary.add("envelope", resting->envelope(), "m");
  summary.add("nothing bounces below (envelope / dt)", resting->envelope() / scene.step->dt, "m/s");
  summary.add("resting contacts with an impulse", std::int64_t{all.resting});
  summary.add("largest island", std::int64_t{all.largest_island}, "contact points");
  summary.add("largest correction of a position in a plan", all.correction, "m");
  summary.add("energy added by corrections", all.correction_energy, "J");
  summary.add("bodies whose paths were shortened", std::int64_t{all.shortened});
  summary.add("momentum that shortened paths took", all.lost_impulse, "N s");
  if (clashes > 0) summary.add("driven bodies that went into what cannot give way", std::int64_t{clashes});
  summary.counter("plans", all.plans, 0);
  summary.counter("paths of pairs that were proved", all.checked, 0);
  summary.counter("envelope (pairs whose contacts were searched)", all.searched, 0);
  summary.counter("sweeps of Gauss-Seidel", all.sweeps, 0);
  return code;
}

void check(const Scene& scene) {
  world::World world = world::build_world(scene);
  if (scene.envelope) resting::Resting(scene, world, scene.step->dt);
}

}  // namespace

int main(int argc, char** argv) {
  Chapter chapter;
  chapter.number = 5;
  chapter.name = "ch05_resting_contact";
  chapter.purpose =
      "Moves rigid bodies that collide, rest, slide and stack, without friction. With the key `envelope`, "
      "bodies nearer than that are in contact and go by plans: proved paths that use no gap up, with impulses that act "
      "all along. Without it, everything is as in chapter 4. Bodies that meet in one frame so often that nobody could go "
      "from one event to the next are a pile: its contacts are solved to a residual that is reported, two plans a frame, and "
      "where paths cannot be proved they are shortened, which is reported as `lost_impulse`.";
  chapter.example = "build/bin/ch05_resting_contact chapters/ch05_resting_contact/scenes/stack.yaml";
  chapter.explain = explain;
  chapter.run = run;
  chapter.check = check;
  return run_program(argc, argv, chapter);
}
