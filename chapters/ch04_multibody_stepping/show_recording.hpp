// Accounts of single frames of a run, for its recording.
#pragma once

#include <string>
#include <vector>

#include "ch04_multibody_stepping/run.hpp"

namespace fc::world {

// While a wanted frame is still to come, the bodies are copied before each frame. Once it has been, the account is made on a
// copy of the world as it was: the run itself does not notice.
class RecordedAccounts {
 public:
  // frames: their numbers from 1 on, or kFirstContact. account: empty: there are none.
  RecordedAccounts(const Scene& scene, std::vector<int> frames, FrameAccount account);
  void before(const World& world);
  // The frame with this number (from 0 on) has been.
  void after(const World& world, int frame, const StepReport& report);
  // Hands the accounts over. A frame that could not be told, or never came, is a note in the summary.
  void write(Recorder& recorder, Summary& summary) const;

 private:
  void make(const World& world, int frame);

  const Scene& scene_;
  std::vector<int> frames_;  // still to come
  FrameAccount account_;
  std::vector<Body> bodies_;
  std::vector<std::pair<int, int>> sighted_;
  std::vector<std::string> accounts_, failures_;
};

}  // namespace fc::world
