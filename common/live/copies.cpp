#include "common/live/copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/stopwatch.hpp"

namespace fc::live {
namespace {

constexpr double kSameTime = 1e-9;  // of a frame
constexpr int kMostFrames = 1000;   // within which two frames' lengths are seen to meet

bool is_same(const Pose& a, const Pose& b) {
  return a.position == b.position && a.orientation.coeffs() == b.orientation.coeffs();
}

// The point of the body in the copy that is `point` of the body in the scene. If both stand alike it is the same to the last
// digit, so that copies that are alike stay so.
Vec3 same_point(const Pose& scene, const Pose& twin, const Vec3& point) {
  if (is_same(scene, twin)) return point;
  return twin.position + twin.orientation * (scene.orientation.conjugate() * (point - scene.position));
}

// After how many frames of the scene both stand at one time again, if it is not after each.
std::string meeting_text(double scene_dt, double twin_dt) {
  const double near = kSameTime * std::min(scene_dt, twin_dt);
  for (int frames = 1; frames <= kMostFrames; ++frames) {
    const double passed = frames * scene_dt;
    if (std::abs(passed - std::round(passed / twin_dt) * twin_dt) > near) continue;
    return frames == 1
               ? ""
               : fmt::format("; scene and copy stand at one time after every {} frames of the scene", frames);
  }
  return fmt::format(
      "; scene and copy do not come to one time within {} frames, so their distance is not known: give one a frame that divides "
      "the other's",
      kMostFrames);
}

}  // namespace

Distance distance_of(const Snapshot& a, const Snapshot& b) {
  const bool one_time = std::abs(a.t - b.t) <= kSameTime * std::min(a.dt, b.dt);
  if (!one_time || a.poses.size() != b.poses.size()) return {std::numeric_limits<double>::quiet_NaN()};
  Distance largest{0};
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    const double distance = (a.poses[i].position - b.poses[i].position).norm();
    if (distance > largest.metres) largest = {distance, static_cast<int>(i)};
  }
  return largest;
}

std::optional<TwinState> Copies::twin(const Snapshot& now) const {
  if (!twin_) return std::nullopt;
  TwinState state{twin_->simulation.get(), twin_->simulation->snapshot(), twin_->failed, {}};
  state.distance = distance_of(now, state.now);
  return state;
}

Answer Copies::begin_twin() {
  const Stopwatch watch;
  twin_ = Twin{scene_.copy(), std::nullopt};
  return {.text = "a copy of the scene begins, as it stands",
          .rebuilt = true,
          .ms = 1e-6 * static_cast<double>(watch.ns())};
}

Answer Copies::end_twin() {
  const bool was = twin_.has_value();
  twin_.reset();
  return {was ? "the copy has ended" : "there is no copy"};
}

void Copies::step(const std::function<bool()>& stopped) {
  scene_.step();
  if (!twin_ || twin_->failed) return;
  try {
    follow(stopped);
  } catch (const std::exception& error) {
    twin_->failed = error.what();
  }
}

void Copies::follow(const std::function<bool()>& stopped) {
  const Snapshot twin = twin_->simulation->snapshot();
  const double frames = std::ceil((scene_.snapshot().t - twin.t) / twin.dt - kSameTime);
  for (double frame = 0; frame < frames && !stopped(); ++frame) twin_->simulation->step();
}

// What the scene has done, its copy does, too.
Answer Copies::with_twin(Answer answer, const std::function<void(Simulation&)>& act) {
  if (!twin_ || twin_->failed) return answer;
  try {
    act(*twin_->simulation);
  } catch (const InputError& refused) {
    answer.text += fmt::format("; its copy refuses: {}", refused.what());
  } catch (const std::exception& error) {
    twin_->failed = error.what();
  }
  return answer;
}

// One of the two stands at its beginning, and the other one is brought there. If that cannot be, the copy ends.
Answer Copies::begun_again(Answer answer, bool of_twin, const std::function<void(Simulation&)>& begin_other) {
  if (!twin_) return answer;
  try {
    begin_other(of_twin ? scene_ : *twin_->simulation);
    twin_->failed.reset();
  } catch (const std::exception& error) {
    twin_.reset();
    if (of_twin) throw;
    answer.text += fmt::format("; the copy has ended: {}", error.what());
  }
  return answer;
}

Answer Copies::reset() {
  return begun_again(scene_.reset(), false, [](Simulation& twin) { twin.reset(); });
}

// What begins the one again begins the other, so that their times stay one; and both keep the same bodies.
Answer Copies::set(const std::string& key, const std::string& value, bool of_twin) {
  if (of_twin && !twin_) throw InputError("there is no copy; make one first");
  Answer answer;
  try {
    answer = of_twin ? twin_->simulation->set(key, value) : scene_.set(key, value);
  } catch (const NumericalFailure& failure) {
    if (!of_twin) throw;  // the scene fails; else the copy alone
    twin_->failed = failure.what();
    return {fmt::format("the copy has failed: {}", failure.what())};
  }
  if (!twin_) return answer;
  if (answer.restarted) {
    answer.text += of_twin ? ", and so does the scene itself" : ", and so does its copy";
    return begun_again(answer, of_twin, [&](Simulation& other) {
      if (answer.reshaped)
        other.set(key, value);
      else
        other.reset();
    });
  }
  if (key.starts_with("step"))
    answer.text += meeting_text(scene_.snapshot().dt, twin_->simulation->snapshot().dt);
  return answer;
}

// A ball flies in both or in none.
Answer Copies::throw_ball(const Vec3& from, const Vec3& velocity) {
  if (twin_ && twin_->failed)
    throw InputError("the copy has failed, so no ball can fly in both: reset the scene, or end the copy");
  if (twin_) twin_->simulation->check_throw(from, velocity);
  return with_twin(scene_.throw_ball(from, velocity),
                   [&](Simulation& twin) { twin.throw_ball(from, velocity); });
}

Answer Copies::grab(int body, const Vec3& point) {
  return with_twin(scene_.grab(body, point), [&](Simulation& twin) {
    const auto number = static_cast<std::size_t>(body);
    const Snapshot now = scene_.snapshot(), of_twin = twin.snapshot();
    if (number >= of_twin.poses.size()) throw InputError(fmt::format("it has no body {}", body));
    twin.grab(body, same_point(now.poses[number], of_twin.poses[number], point));
  });
}

Answer Copies::drag(const Vec3& to) {
  return with_twin(scene_.drag(to), [&](Simulation& twin) { twin.drag(to); });
}

Answer Copies::drop() {
  return with_twin(scene_.drop(), [](Simulation& twin) { twin.drop(); });
}

// Saving lets go, and forgets what steps remember: so it does in the copy, whose text nobody needs. A copy that cannot be saved
// goes on without a hand.
Answer Copies::save() {
  const Answer saved = scene_.save();
  with_twin({}, [](Simulation& twin) {
    try {
      twin.save();
    } catch (const InputError&) {
      twin.drop();
    }
  });
  return saved;
}

}  // namespace fc::live
