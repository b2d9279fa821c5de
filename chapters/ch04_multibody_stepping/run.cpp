#include "ch04_multibody_stepping/run.hpp"

#include "ch04_multibody_stepping/record.hpp"
#include "ch04_multibody_stepping/show_recording.hpp"
#include "common/stopwatch.hpp"

namespace fc::world {

int run_scene(const Scene& scene, const RunContext& context, Summary& summary, const StepFunction& step_frame,
              bool kinds, const Prepare& prepare, const MoreColumns& more, const FrameAccount& account) {
  const Stopwatch watch;
  World world = build_world(scene);
  if (prepare) prepare(world);
  const std::int64_t built_ns = watch.ns();
  summary.add("bodies", static_cast<std::int64_t>(world.bodies.size()));
  for (std::size_t i = 0; i < world.shapes.size(); ++i) {
    const Shape& shape = world.shapes[i];
    if (shape.kind == Shape::Kind::mesh) summary.add("shape " + shape.name, shape.report.text());
    summary.add("shape " + shape.name + ", mass from", shape.mass_source);
  }
  summary.add_time("time to build shapes and hierarchies", built_ns);

  const StepSpec& step = *scene.step;
  Recorder recorder(scene, world, context, kinds, more);
  recorder.start(world);
  RecordedAccounts accounts(scene, context.algorithm, account);
  Progress progress("frames", step.frames, context.quiet);
  try {
    for (int frame = 0; frame < step.frames; ++frame) {
      accounts.before(world);
      const StepReport report =
          step_frame(world, step.dt,
                     {[&](const ImpactRecord& impact) { recorder.impact(impact); },
                      [&](const World& now, double time) { recorder.instant(now, time); },
                      [&](const Sighting& sighting) { recorder.sighting(sighting); }});
      recorder.frame(world, frame + 1, (frame + 1) * step.dt, report);
      accounts.after(world, frame, report);
      progress.update(frame + 1);
    }
    accounts.write(recorder, summary);
  } catch (...) {  // what was simulated so far stays, and can be watched
    recorder.close();
    throw;
  }
  summary.add_note("motion", recorder.close());
  if (recorder.first_impact()) summary.add("first impact at", *recorder.first_impact(), "s");
  summarize(scene, world, recorder.reports(), summary);
  return 0;
}

}  // namespace fc::world
