// What the benchmarks of chapters 5 and 6 share: scenes that our engine, Bullet and ODE step for ten seconds from the
// start, and one overlap check for all.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "ch05_resting_contact/contact_law.hpp"
#include "common/scene.hpp"

namespace fc::bench {

inline constexpr int kFrames = 600;  // of 1/60 s

struct Case {
  std::string name;
  Scene scene;
  int frames = kFrames;
  bool meshes = false;  // for our engine alone, which is also judged by its own certified gap
  bool stands = false;  // bodies are right if they stay where they start
  // Our contact law; none: chapter 5's.
  std::function<std::unique_ptr<resting::ContactLaw>(world::World&)> law = {};
};

// Registers the rows ours, bullet, bullet_50, ode and ode_50, with the scene's friction.
void add_case(const Case& what);

// The N of --frames=N, which is removed from the arguments; kFrames if it is absent.
int most_frames(int& argc, char** argv);

// What was registered; for main() to return.
int run_cases(int argc, char** argv);

}  // namespace fc::bench
