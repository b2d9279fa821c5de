// The live scene behind make_live(): what it consists of. Its frames are in live_world.cpp, its commands in live_commands.cpp.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ch04_multibody_stepping/live.hpp"
#include "ch04_multibody_stepping/live_hand.hpp"
#include "ch04_multibody_stepping/live_scene.hpp"

namespace fc::world {

// A scene, its world, and the step for it: exchanged as a whole, so that a change that is refused changes nothing.
struct Pipeline {
  Scene scene;
  World world;
  LiveStep step;
  std::vector<live::EffectState> effects;
  std::vector<live::Knob> knobs;

  Pipeline(const LiveChapter& chapter, Scene of, World made, const LiveBefore& before = {});
};

// J, since the start or the last reset. Kinetic and potential energy are those of the start and these sums.
class Account {
 public:
  void add(const std::string& name, double energy) {
    const auto known =
        std::find_if(sums_.begin(), sums_.end(), [&](const auto& e) { return e.first == name; });
    if (known != sums_.end())
      known->second += energy;
    else
      sums_.emplace_back(name, energy);
  }
  const NamedNumbers& sums() const { return sums_; }

 private:
  NamedNumbers sums_ = {{"impacts", 0}, {"hand", 0}};
};

// All of a live scene but its pipeline, which refers to its own parts and cannot be copied.
struct LiveState {
  SceneSource source;
  std::string text;  // the file's, as it was at the start
  LiveChapter chapter;
  Scene first;  // as it was read at the start: what an effect is switched on with again
  std::vector<Throw> balls;
  Hand hand;
  double size = 0;                 // m, of the scene at its start
  std::optional<double> envelope;  // m, in force before the first ball was thrown
  int geometry = 0;
  // Times are counted, not summed: so two scenes with frames of 1/60 and 1/240 s come to the same time, whatever it is.
  std::int64_t frame = 0, dt_since = 0;  // frames that were made; how many of them before the present dt
  double t_since = 0;                    // s, at that frame
  Account account;
  std::vector<ImpactRecord> contacts;  // of the last frame
  LiveFrame last;
  std::vector<std::string> warnings;  // the last few lines
};

class LiveWorld final : public live::Simulation {
 public:
  LiveWorld(const SceneSource& source, const LiveChapter& chapter);

  std::string title() const override { return now_->scene.name; }
  std::string glb() const override;
  int geometry() const override { return state_.geometry; }
  void step() override;
  live::Snapshot snapshot() const override;
  std::vector<live::EffectState> effects() const override;
  std::vector<live::Knob> knobs() const override { return now_->knobs; }
  live::Answer reset() override;
  live::Answer set(const std::string& key, const std::string& value) override;
  live::Answer throw_ball(const Vec3& from, const Vec3& velocity) override;
  void check_throw(const Vec3& from, const Vec3& velocity) const override;
  live::Answer grab(int body, const Vec3& point) override;
  live::Answer drag(const Vec3& to) override;
  live::Answer drop() override;
  live::Answer save() override;
  std::unique_ptr<live::Simulation> copy() override;
  std::string algorithm() const override;

 private:
  LiveWorld(LiveState state, const Pipeline& pipeline);

  Scene read(const std::vector<SceneEdit>& edits) const;
  Scene completed(const Scene& scene) const;
  Scene with_balls(Scene scene, const std::vector<Throw>& balls) const;
  std::pair<Scene, World> with_ball(const Throw& ball) const;
  double t() const {
    return state_.t_since + static_cast<double>(state_.frame - state_.dt_since) * now_->scene.step->dt;
  }
  void start(const Scene& scene);
  void put(std::unique_ptr<Pipeline> next, const char* entry);
  std::unique_ptr<Pipeline> rebuilt(const Pipeline& from) const;
  void count(const LiveFrame& frame, double before, double hand);
  void book(const std::vector<LiveWarning>& warnings);

  LiveState state_;
  std::unique_ptr<Pipeline> now_;
};

double energy_of(const World& world);  // J

}  // namespace fc::world
