#include "ch04_multibody_stepping/show_recording.hpp"

#include <fmt/format.h>

#include "common/options.hpp"

namespace fc::world {

RecordedAccounts::RecordedAccounts(const Scene& scene, std::vector<int> frames, FrameAccount account)
    : scene_(scene), frames_(std::move(frames)), account_(std::move(account)) {
  if (!account_) frames_.clear();
}

void RecordedAccounts::before(const World& world) {
  if (frames_.empty()) return;
  bodies_ = world.bodies;
  sighted_ = world.sighted;
}

void RecordedAccounts::after(const World& world, int frame, const StepReport& report) {
  const bool touches = report.contacts > 0 || report.impacts > 0;
  const auto is_this = [&](int wanted) { return wanted == kFirstContact ? touches : wanted == frame + 1; };
  if (std::erase_if(frames_, is_this) > 0) make(world, frame);
}

// A picture that fails must not cost a run its results: the summary says so.
void RecordedAccounts::make(const World& world, int frame) {
  World copy = world;
  copy.bodies = bodies_;
  copy.sighted = sighted_;
  copy.schedule = {};
  copy.memory.certificate = nullptr;
  try {
    accounts_.push_back(algorithm::json(account_(scene_, copy, frame, frame * scene_.step->dt)));
  } catch (const std::exception& error) {
    failures_.push_back(fmt::format("frame {}: {}", frame + 1, error.what()));
  }
}

void RecordedAccounts::write(Recorder& recorder, Summary& summary) const {
  for (const std::string& account : accounts_) recorder.algorithm(account);
  for (const std::string& failure : failures_) summary.add_note("no account of the algorithm of", failure);
  for (const int frame : frames_)
    if (frame != kFirstContact)
      summary.add_note("no account of the algorithm of",
                       fmt::format("frame {}: the run has fewer frames", frame));
}

}  // namespace fc::world
