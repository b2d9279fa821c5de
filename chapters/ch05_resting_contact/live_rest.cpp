#include "ch05_resting_contact/live_rest.hpp"

#include <utility>

#include "ch05_resting_contact/rest_run.hpp"
#include "ch05_resting_contact/show_rest.hpp"

namespace fc::resting {

// Impacts are what instants and plans took along the normals, corrections what plans added: of gaps, and by their error, which
// is of second order. (The table's correction_energy is less: there an instant's losses are taken off first.)
world::LiveStep live_step(const Scene& scene, world::World& world, const world::LiveBefore& before,
                          std::unique_ptr<ContactLaw> law, const std::string& law_effect) {
  using world::ms;
  const auto resting = std::make_shared<Resting>(scene, world, scene.step->dt, RestOptions{}, std::move(law));
  if (before.step != nullptr && before.step->state)
    resting->take_over(*std::static_pointer_cast<Resting>(before.step->state), before.same_rules);
  const auto frame = [resting, law_effect, &scene](world::World& now, const world::Listeners& listeners) {
    const RestReport report = resting->step(now, listeners);
    const StageTimes& times = report.times;
    const std::int64_t others =
        times.contacts_ns + times.solver_ns + times.corrections_ns + times.proofs_ns + report.step.broad_ns;
    world::LiveFrame result;
    result.report = report.step;
    for (const Clash& clash : report.clashes)
      result.warnings.push_back({clash.time, clash_text(scene, clash)});
    result.account = {{"impacts", report.impact_energy + report.plan_loss},
                      {"friction", report.tangential_work},
                      {"corrections", report.plan_gain}};
    result.stages = {
        {"broad_phase_ms", ms(report.step.broad_ns)}, {"ccd_ms", ms(report.step.ccd_ns - others)},
        {"contacts_ms", ms(times.contacts_ns)},       {"lcp_ms", ms(times.solver_ns)},
        {"corrections_ms", ms(times.corrections_ns)}, {"proofs_ms", ms(times.proofs_ns)}};
    const std::int64_t plans_ns = times.corrections_ns + times.proofs_ns;
    result.effects = {{"swept detection", ms(report.step.broad_ns)},
                      {"collision", ms(report.step.ccd_ns - others)},
                      {"envelope", ms(times.contacts_ns)}};
    if (law_effect.empty())
      result.effects.insert(result.effects.end(),
                            {{"impact law", ms(times.instants_ns)},
                             {"plans", ms(plans_ns + times.solver_ns - times.instants_ns)}});
    else
      result.effects.insert(result.effects.end(),
                            {{"plans", ms(plans_ns)}, {law_effect, ms(times.solver_ns)}});
    return result;
  };
  return {frame, resting->envelope(), resting};
}

world::LiveChapter live_chapter() {
  world::LiveChapter chapter;
  chapter.number = 5;
  chapter.name = "ch05_resting_contact";
  chapter.prepare = [](const Scene& scene, world::World& world, const world::LiveBefore& before) {
    return scene.envelope ? live_step(scene, world, before) : world::live_step(scene);
  };
  chapter.explain = [](const Scene& scene, const world::World& world) {
    return scene.envelope ? explain(scene, world) : world::explain(scene);
  };
  chapter.algorithm = [](const Scene& scene, world::World& copy, std::int64_t frame, double t0) {
    return algorithm::json(resting::show_frame(scene, copy, frame, t0));
  };
  return chapter;
}

}  // namespace fc::resting
