// Chapter 6: friction. Chapter 5's step with Coulomb's law at each contact.
#include <fmt/format.h>

#include "ch05_resting_contact/rest_run.hpp"
#include "ch06_friction/clear/law.hpp"
#include "ch06_friction/clear/pieces.hpp"
#include "ch06_friction/coulomb_law.hpp"
#include "ch06_friction/rubbing.hpp"
#include "ch06_friction/show_cones.hpp"
#include "common/live/serve.hpp"

namespace {

using namespace fc;

// Runs on the pieces if --clear or --mine asks for it.
int run(const Scene& scene, const RunContext& context, Summary& summary,
        const friction::clear::Pieces& pieces) {
  if (!friction::asks_for_friction(scene)) {
    if (context.clear)
      throw InputError(
          "--clear and --mine: this scene has no friction; give it the key 'friction', or run it with chapter 5");
    if (scene.envelope) return resting::run_scene(scene, context, summary);
    return world::run_scene(scene, context, summary, world::step, true, {}, {}, world::show_frame);
  }
  friction::refuse_idle_keys(scene);
  resting::RunOptions options;
  // ANCHOR: law
  options.law = [](world::World& world) { return std::make_unique<friction::CoulombLaw>(world); };
  // ANCHOR_END: law
  options.account = friction::show_frame;
  int unsolved = 0;
  if (context.clear)
    options.law = [&](world::World& world) {
      return std::make_unique<friction::clear::ClearLaw>(world, pieces.solve_contact, unsolved);
    };
  double work = 0;
  options.columns = [&work](const resting::RestReport& last) {
    world::MoreColumns more;
    more.columns = {{"friction_work", "J"}};
    more.cells = [&last, &work] {
      work += last.tangential_work;
      return std::vector<Cell>{last.tangential_work};
    };
    more.contact_columns = {{"tx", "N s"},          {"ty", "N s"},         {"tz", "N s"},
                            {"slip_before", "m/s"}, {"slip_after", "m/s"}, {"patch", ""}};
    more.contact_cells = [](const world::ImpactRecord& record) {
      const Vec3& t = record.tangential;
      return std::vector<Cell>{t.x(),
                               t.y(),
                               t.z(),
                               record.slip_before.norm(),
                               record.slip_after.norm(),
                               std::int64_t{record.patch}};
    };
    return more;
  };
  const int code = resting::run_scene(friction::with_envelope(scene), context, summary, options);
  summary.add("work of friction", work, "J");
  if (context.clear) {
    summary.add_note("islands are solved by",
                     "sweeps over their contacts, one after the other, and no other method");
    summary.add("islands that sweeps did not solve (piles from then on)", std::int64_t{unsolved});
  }
  return code;
}

void check(const Scene& scene) {
  if (friction::asks_for_friction(scene)) friction::refuse_idle_keys(scene);
  if (scene.envelope || friction::asks_for_friction(scene))
    resting::check(friction::with_envelope(scene));
  else
    world::build_world(scene);
}

}  // namespace

int main(int argc, char** argv) {
  friction::clear::Pieces pieces;
  Chapter chapter;
  chapter.number = 6;
  chapter.name = "ch06_friction";
  chapter.purpose =
      "Moves rigid bodies that collide, rest, slide, roll and stick, by Coulomb's law with the exact cone. With the key "
      "`friction` (of the scene, a shape or a pair) contacts of that pair have three rows, at impacts and at rest; without it, "
      "or where it is 0, everything is as in chapter 5, to the byte.";
  chapter.example = "build/bin/ch06_friction chapters/ch06_friction/scenes/slope.yaml";
  chapter.explain = [](const Scene& scene) { return friction::explain(scene); };
  chapter.run = [&](const Scene& scene, const RunContext& context, Summary& summary) {
    return run(scene, context, summary, pieces);
  };
  chapter.check = check;
  chapter.live = [](const SceneSource& source, int port, bool quiet) {
    return live::serve(*world::make_live(source, friction::live_chapter()), port, quiet);
  };
  chapter.pieces = slots(pieces);
  return run_program(argc, argv, chapter);
}
