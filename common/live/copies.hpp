// A scene and, if a page asks for it, a copy of it with settings of its own: both go through the same time, and what a hand does to
// the one it does to the other.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/live/simulation.hpp"

namespace fc::live {

// How far two scenes of the same bodies are from each other.
struct Distance {
  double metres;      // the largest distance of the same body's centres; NaN: they do not stand at one time
  int farthest = -1;  // that body; -1: none
};
// Times count as one if they differ by less than a part in 10^9 of the shorter frame.
Distance distance_of(const Snapshot& a, const Snapshot& b);

// The copy, as the state message describes it.
struct TwinState {
  const Simulation* simulation;
  Snapshot now;
  std::optional<std::string> failed;  // what the copy said; it stands still since
  Distance distance;                  // from the scene
};

// The command `set` acts on one of the two, `save` answers for the scene, and all others act on both. One thread calls all
// of this; it throws what the scene throws. What the copy alone cannot do, the answer says.
class Copies {
 public:
  explicit Copies(Simulation& scene) : scene_(scene) {}

  const Simulation& scene() const { return scene_; }
  // now: the scene's snapshot. Empty: there is no copy.
  std::optional<TwinState> twin(const Snapshot& now) const;

  Answer begin_twin();  // anew, if there is one
  Answer end_twin();
  // One frame of the scene, and as many of the copy as bring it to the same time; `stopped` is asked between these, for there
  // may be many. A copy that fails is left where it stands.
  void step(const std::function<bool()>& stopped);
  Answer reset();
  Answer set(const std::string& key, const std::string& value, bool of_twin);
  Answer throw_ball(const Vec3& from, const Vec3& velocity);
  Answer grab(int body, const Vec3& point);
  Answer drag(const Vec3& to);
  Answer drop();
  Answer save();

 private:
  struct Twin {
    std::unique_ptr<Simulation> simulation;
    std::optional<std::string> failed;
  };

  void follow(const std::function<bool()>& stopped);
  Answer with_twin(Answer answer, const std::function<void(Simulation&)>& act);
  Answer begun_again(Answer answer, bool of_twin, const std::function<void(Simulation&)>& begin_other);

  Simulation& scene_;
  std::optional<Twin> twin_;
};

}  // namespace fc::live
