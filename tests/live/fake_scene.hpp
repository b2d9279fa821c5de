// A scene without physics, whose numbers a test knows beforehand.
#pragma once

#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <thread>

#include "common/errors.hpp"
#include "common/live/simulation.hpp"

namespace fc_test {

using fc::Vec3;
namespace live = fc::live;

// Body i is at (i + i t drift, frame, t). The members that are atomic may be looked at, or changed, while it runs.
class FakeScene : public live::Simulation {
 public:
  explicit FakeScene(int bodies = 3, double dt = 0.01) : bodies_(bodies), dt_(dt) {}

  std::atomic<int> step_ms{0};                   // how long a step takes
  std::atomic<std::int64_t> fails_at{-1};        // the frame whose step fails
  std::atomic<std::int64_t> frames{0};           // since the last reset
  std::atomic<std::int64_t> steps{0};            // in all
  mutable std::atomic<bool> two_threads{false};  // whether a second thread has called it
  std::atomic<bool> in_step{false};
  std::atomic<bool> has_algorithm{false};
  std::atomic<std::int64_t> twin_fails_at{-1};                      // of a copy that is made from now on
  std::atomic<double> no_ball_above{1e9}, twin_no_ball_above{1e9};  // m
  std::atomic<int> holds{0};                                        // how often something was grabbed
  std::atomic<std::chrono::steady_clock::duration> begun{};         // the clock at the first step's beginning

  std::string title() const override { return "fake & <scene>"; }
  std::string glb() const override {
    check_thread();
    return "glTF " + std::to_string(geometry_) + " at frame " + std::to_string(frames);
  }
  int geometry() const override { return geometry_; }

  void step() override {
    check_thread();
    if (steps++ == 0) begun = std::chrono::steady_clock::now().time_since_epoch();
    in_step = true;
    if (step_ms > 0) std::this_thread::sleep_for(std::chrono::milliseconds(step_ms));
    in_step = false;
    if (frames + 1 == fails_at) throw fc::NumericalFailure("energy grew\nby 3 J");
    ++frames;
  }

  live::Snapshot snapshot() const override {
    check_thread();
    live::Snapshot now;
    now.frame = frames;
    now.t = t();
    now.dt = dt_;
    for (int i = 0; i < bodies_; ++i)
      now.poses.push_back({Vec3(i + i * now.t * drift_, static_cast<double>(frames), now.t),
                           fc::Quat(2. / 9, -4. / 9, 5. / 9, 6. / 9)});
    now.contacts.push_back({Vec3(1, 2, 3), Vec3(0, 0, 1), Vec3(4, 5, 6), 0, 1, true});
    now.stages = {{"ccd_ms", 1.5}, {"lcp_ms", 0.5}};
    now.step_ms = 2;
    now.energy = 7;
    now.account = {{"impacts", -1.25}, {"hand", 0.5}};
    now.min_gap = std::numeric_limits<double>::infinity();
    now.residual = std::nan("");
    now.warnings = {"mind\nthe wall"};
    now.grabbed = grabbed_;
    now.grab_point = grab_point_;
    now.grab_target = grab_target_;
    return now;
  }

  std::vector<live::EffectState> effects() const override {
    return {{"restitution", false, false, "", "not asked for by this scene", "", 0},
            {"gravity", true, true, "gravity=[0, 0, -9.81]", "declared at line 7", "acceleration", 0.25}};
  }
  std::vector<live::Knob> knobs() const override {
    return {{"ccd.tolerance", "m", "1e-6", "how near is in contact", 1e-9, 1e-2, {}, false},
            {"solver.method", "", "dantzig", "which solver", 0, 0, {"dantzig", "pgs"}, true}};
  }

  live::Answer reset() override {
    check_thread();
    begin();
    return {"from the beginning", true};
  }
  live::Answer set(const std::string& key, const std::string& value) override {
    check_thread();
    if (key == "step.dt") {
      t_since_ = t();
      since_ = frames;
      dt_ = std::stod(value);
      return {.text = "rebuilt", .rebuilt = true, .ms = 1.5};
    }
    if (key == "solver.method") {
      begin();
      return {.text = "restarted", .restarted = true, .ms = 2.5};
    }
    if (key == "bodies") {
      if (copied_ && value == "9") throw fc::InputError("nine are too many");
      bodies_ = std::stoi(value);
      begin();
      ++geometry_;
      return {.text = "restarted", .restarted = true, .reshaped = true};
    }
    if (key == "drift") {
      drift_ = std::stod(value);
      return {.text = "it drifts", .rebuilt = true};
    }
    if (key == "breaks") throw fc::NumericalFailure("nothing is as it was");
    throw fc::InputError("--set " + key + "=" + value + ": no such key");
  }
  live::Answer throw_ball(const Vec3& from, const Vec3&) override {
    check_throw(from, Vec3::Zero());
    ++bodies_;
    ++geometry_;
    return {"thrown"};
  }
  live::Answer grab(int body, const Vec3& point) override {
    check_thread();
    if (body >= bodies_) throw fc::InputError("there is no body " + std::to_string(body));
    ++holds;
    grabbed_ = body;
    grab_point_ = grab_target_ = point;
    return {"grabbed"};
  }
  live::Answer drag(const Vec3& to) override {
    check_thread();
    grab_target_ = to;
    return {"dragged"};
  }
  live::Answer drop() override {
    check_thread();
    grabbed_ = -1;
    return {"dropped"};
  }
  void check_throw(const Vec3& from, const Vec3&) const override {
    check_thread();
    if (from.z() > no_ball_above) throw fc::InputError("no ball can fly there");
  }
  std::unique_ptr<live::Simulation> copy() override {
    check_thread();
    auto twin = std::make_unique<FakeScene>(bodies_, dt_);
    twin->frames = frames.load();
    twin->since_ = since_;
    twin->t_since_ = t_since_;
    twin->geometry_ = geometry_;
    twin->fails_at = twin_fails_at.load();
    twin->no_ball_above = twin_no_ball_above.load();
    twin->copied_ = true;
    return twin;
  }
  std::string algorithm() const override {
    check_thread();
    if (!has_algorithm) return live::Simulation::algorithm();
    return "{\"frame\": " + std::to_string(frames) + "}";
  }
  live::Answer save() override { return {"step: {dt: 0.01}\nbodies: []\n"}; }

 private:
  double t() const { return t_since_ + static_cast<double>(frames - since_) * dt_; }
  void begin() {
    frames = 0;
    since_ = 0;
    t_since_ = 0;
  }
  void check_thread() const {
    if (caller_ == std::thread::id()) caller_ = std::this_thread::get_id();
    if (caller_ != std::this_thread::get_id()) two_threads = true;
  }

  int bodies_;
  double dt_, drift_ = 0, t_since_ = 0;
  std::int64_t since_ = 0;  // frames at t_since_
  bool copied_ = false;
  int geometry_ = 0, grabbed_ = -1;
  Vec3 grab_point_ = Vec3::Zero(), grab_target_ = Vec3::Zero();
  mutable std::atomic<std::thread::id> caller_{};
};

}  // namespace fc_test
