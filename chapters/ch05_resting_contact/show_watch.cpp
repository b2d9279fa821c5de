#include <algorithm>

#include "ch05_resting_contact/show_rest.hpp"

namespace fc::resting {

namespace {

// A law is not told what it is asked for. An instant asks for limits of 0, with the bodies' velocities; a plan with their mean
// velocities until its end, which gravity has changed for all alike.
bool is_for_plan(const world::World& world, const SeenPush& push) {
  if (std::any_of(push.limits.begin(), push.limits.end(), [](double limit) { return limit != 0; }))
    return true;
  if (!world.effects.gravity || world.effects.gravity->isZero(0)) return false;
  constexpr double kAside = 0.05;  // of the change: drag, and what rounding leaves
  const Vec3 down = world.effects.gravity->normalized();
  for (std::size_t i = 0; i < push.before.size(); ++i) {
    if (push.before[i].is_static() || push.before[i].is_guided()) continue;
    const Vec3 change = push.before[i].velocity - world.bodies[at(push.numbers[i])].state.velocity;
    if (!(change.dot(down) > 0) || change.cross(down).norm() > kAside * change.norm()) return false;
  }
  return true;
}

}  // namespace

lcp::ShownContacts SeenPush::shown(const world::World& world) const {
  return {before, numbers, contacts, world::arrow_length(world, numbers)};
}

std::vector<algorithm::BodyPose> SeenPush::poses() const {
  std::vector<algorithm::BodyPose> poses;
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!before[i].is_static()) poses.push_back({numbers[i], before[i].position, before[i].orientation});
  return poses;
}

SeenPush WatchedLaw::begin(const ContactSet& set, std::span<const double> limits) const {
  SeenPush seen;
  seen.time = watch_.now;
  seen.numbers.assign(set.numbers.begin(), set.numbers.end());
  seen.before.assign(set.bodies.begin(), set.bodies.end());
  seen.contacts.assign(set.contacts.begin(), set.contacts.end());
  seen.limits.assign(limits.begin(), limits.end());
  seen.bends.assign(set.bends.begin(), set.bends.end());
  seen.of_plan = is_for_plan(*watch_.world, seen);
  return seen;
}

void WatchedLaw::end(SeenPush seen, const ContactSet& set, const IslandResult& result) {
  work_ = law_->work();
  seen.result = result;
  seen.after.assign(set.bodies.begin(), set.bodies.end());
  if (watch_.pushes.size() < RestWatch::kMost && seen.contacts.size() <= RestWatch::kMostContacts)
    watch_.pushes.push_back(std::move(seen));
}

IslandResult WatchedLaw::push(const ContactSet& set, std::span<const double> limits, std::span<Vec3> impulses,
                              const IslandOptions& options) {
  SeenPush seen = begin(set, limits);
  const IslandResult result = law_->push(set, limits, impulses, options);
  seen.impulses.assign(impulses.begin(), impulses.end());
  end(std::move(seen), set, result);
  return result;
}

IslandResult WatchedLaw::correct(const ContactSet& set, std::span<const double> limits,
                                 std::span<double> impulses, const IslandOptions& options) {
  SeenPush seen = begin(set, limits);
  seen.corrects = true;
  const IslandResult result = law_->correct(set, limits, impulses, options);
  for (std::size_t i = 0; i < impulses.size(); ++i)
    seen.impulses.push_back(impulses[i] * set.contacts[i].normal);
  end(std::move(seen), set, result);
  return result;
}

std::vector<const SeenPush*> pushes_that_count(const RestWatch& watch) {
  std::vector<const SeenPush*> list;
  for (const SeenPush& push : watch.pushes) {
    const auto is_same = [&](const SeenPush* known) {
      return known->time == push.time && known->corrects == push.corrects &&
             known->is_instant() == push.is_instant() && known->numbers == push.numbers;
    };
    const auto known = std::find_if(list.begin(), list.end(), is_same);
    if (known == list.end())
      list.push_back(&push);
    else
      *known = &push;
  }
  return list;
}

namespace {

// The planner of the step, which notes what it does at each of its events.
class WatchedResting final : public Resting {
 public:
  WatchedResting(const Scene& scene, world::World& world, std::unique_ptr<ContactLaw> law, RestWatch& watch)
      : Resting(scene, world, scene.step->dt, {}, std::move(law)), watch_(watch) {}

  std::vector<int> begin(world::World& world, double dt, world::StepReport& report,
                         const world::Listeners& listeners) override {
    part_ = dt;
    watch_.world = &world;
    const std::vector<int> changed = watched(world, {.time = 0}, world::SeenEvent::Kind::begin,
                                             [&] { return Resting::begin(world, dt, report, listeners); });
    if (watch_.planned.empty()) {
      watch_.planned = world.bodies;
      watch_.plan_end = world.part_start + std::min(dt, next_end());
    }
    return changed;
  }
  std::vector<int> end_plans(world::World& world, double now, world::StepReport& report,
                             const world::Listeners& listeners) override {
    return watched(world, {.time = now}, world::SeenEvent::Kind::plans_end,
                   [&] { return Resting::end_plans(world, now, report, listeners); });
  }
  std::vector<int> meet(world::World& world, int a, int b, double now, world::StepReport& report,
                        const world::Listeners& listeners) override {
    const world::clear::Event event{world::clear::Event::Kind::contact, now, std::min(a, b), std::max(a, b)};
    return watched(world, event, world::SeenEvent::Kind::contact,
                   [&] { return Resting::meet(world, a, b, now, report, listeners); });
  }

 private:
  template <class Act>
  std::vector<int> watched(const world::World& world, const world::clear::Event& event,
                           world::SeenEvent::Kind kind, const Act& act) {
    watch_.now = world.part_start + event.time;
    watch_.frame.before(world, event, kind, part_);
    std::vector<int> changed = act();
    watch_.frame.after(world, changed);
    return changed;
  }

  RestWatch& watch_;
  double part_ = 0;  // s, of the part of the frame that is being stepped
};

}  // namespace

RestWatch watched_frame(const Scene& scene, world::World& world, std::unique_ptr<ContactLaw> law) {
  RestWatch watch;
  WatchedResting resting(scene, world, std::make_unique<WatchedLaw>(std::move(law), watch), watch);
  world::Listeners listeners;
  listeners.impact = [&](const world::ImpactRecord& record) { watch.records.push_back(record); };
  watch.report = resting.step(world, listeners);
  return watch;
}

}  // namespace fc::resting
