// Chapter 6: friction. Chapter 5's step with Coulomb's law at each contact.
#include <fmt/format.h>

#include "ch05_resting_contact/rest_run.hpp"
#include "ch06_friction/clear/law.hpp"
#include "ch06_friction/clear/pieces.hpp"
#include "ch06_friction/coulomb_law.hpp"

namespace {

using namespace fc;

// Friction needs contacts that last: the envelope is the scene's, or chapter 5's default.
Scene with_envelope(const Scene& scene) {
  Scene result = scene;
  if (!result.envelope) result.envelope = 0;
  return result;
}

// Throws InputError for keys that have no effect with friction.
void refuse_idle_keys(const Scene& scene) {
  for (const char* key : {"solver.method", "solver.limit", "solver.tolerance"})
    if (const auto mark = scene.mark(key))
      throw InputError(*mark,
                       fmt::format("'{}' has no effect on contacts with friction, which have their own "
                                   "solvers; remove it, or the friction",
                                   key));
}

std::vector<Effect> explain(const Scene& scene) {
  if (!friction::asks_for_friction(scene))
    return scene.envelope ? resting::explain(scene) : world::explain(scene);
  std::vector<Effect> list = resting::explain(with_envelope(scene));
  std::erase_if(list, [](const Effect& effect) { return effect.name == "no rotation"; });
  const world::World world = world::build_world(scene);
  std::vector<char> moves(
      world.shapes.size(),
      0);  // whether a body of the shape can be moved: between two that cannot, there is no friction
  for (const world::Body& body : world.bodies)
    moves[static_cast<std::size_t>(body.shape)] |= !body.state.is_static();
  for (std::size_t a = 0; a < world.shapes.size(); ++a)
    for (std::size_t b = a; b < world.shapes.size(); ++b) {
      if (!moves[a] && !moves[b]) continue;
      const double mu = world.pair_rules.friction(world.shapes, static_cast<int>(a), static_cast<int>(b));
      list.push_back(
          {"friction", fmt::format("pair of '{}' and '{}'", world.shapes[a].name, world.shapes[b].name),
           mu > 0 ? fmt::format("µ = {:.6g}: three rows a contact", mu) : "µ = 0: one row a contact",
           mu > 0 ? 3 : 1});
    }
  return list;
}

// Runs on the pieces if --clear or --mine asks for it.
int run(const Scene& scene, const RunContext& context, Summary& summary,
        const friction::clear::Pieces& pieces) {
  if (!friction::asks_for_friction(scene)) {
    if (context.clear)
      throw InputError(
          "--clear and --mine: this scene has no friction; give it the key 'friction', or run it with chapter 5");
    if (scene.envelope) return resting::run_scene(scene, context, summary);
    return world::run_scene(scene, context, summary, world::step, true);
  }
  refuse_idle_keys(scene);
  resting::RunOptions options;
  // ANCHOR: law
  options.law = [](world::World& world) { return std::make_unique<friction::CoulombLaw>(world); };
  // ANCHOR_END: law
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
  const int code = resting::run_scene(with_envelope(scene), context, summary, options);
  summary.add("work of friction", work, "J");
  if (context.clear) {
    summary.add_note("islands are solved by",
                     "sweeps over their contacts, one after the other, and no other method");
    summary.add("islands that sweeps did not solve (piles from then on)", std::int64_t{unsolved});
  }
  return code;
}

void check(const Scene& scene) {
  if (friction::asks_for_friction(scene)) refuse_idle_keys(scene);
  if (scene.envelope || friction::asks_for_friction(scene))
    resting::check(with_envelope(scene));
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
  chapter.explain = explain;
  chapter.run = [&](const Scene& scene, const RunContext& context, Summary& summary) {
    return run(scene, context, summary, pieces);
  };
  chapter.check = check;
  chapter.pieces = slots(pieces);
  return run_program(argc, argv, chapter);
}
