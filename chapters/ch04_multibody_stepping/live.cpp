#include "ch04_multibody_stepping/live.hpp"

#include "ch04_multibody_stepping/live_world.hpp"
#include "ch04_multibody_stepping/show_frame.hpp"

namespace fc::world {

double ms(std::int64_t ns) {
  return 1e-6 * static_cast<double>(ns);
}

double impact_energy(const ImpactRecord& record) {
  return 0.5 * record.impulse.impulse * (record.impulse.v_before + record.impulse.v_after);
}

LiveStep live_step(const Scene& scene) {
  const double dt = scene.step->dt;
  return {[dt](World& world, const Listeners& listeners) {
    LiveFrame frame;
    double impacts = 0;
    Listeners own = listeners;
    own.impact = [&](const ImpactRecord& record) {
      impacts += impact_energy(record);
      if (listeners.impact) listeners.impact(record);
    };
    frame.report = step(world, dt, own);
    frame.account = {{"impacts", impacts}};
    frame.stages = {{"broad_phase_ms", ms(frame.report.broad_ns)},
                    {"ccd_ms", ms(frame.report.ccd_ns - frame.report.broad_ns)},
                    {"lcp_ms", ms(frame.report.lcp_ns)}};
    frame.effects = {{"swept detection", ms(frame.report.broad_ns)},
                     {"collision", ms(frame.report.ccd_ns - frame.report.broad_ns + frame.report.lcp_ns)}};
    return frame;
  }};
}

LiveChapter live_chapter() {
  LiveChapter chapter;
  chapter.name = "ch04_multibody_stepping";
  chapter.prepare = [](const Scene& scene, World&, const LiveBefore&) { return live_step(scene); };
  chapter.explain = [](const Scene& scene, const World&) { return explain(scene); };
  chapter.algorithm = [](const Scene& scene, World& copy, std::int64_t frame, double t0) {
    return algorithm::json(show_frame(scene, copy, frame, t0));
  };
  return chapter;
}

std::unique_ptr<live::Simulation> make_live(const SceneSource& source, const LiveChapter& chapter) {
  return std::make_unique<LiveWorld>(source, chapter);
}

}  // namespace fc::world
