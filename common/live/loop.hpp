// The thread that steps a live scene, and alone touches it: at the scene's own pace, with the pages' commands between frames.
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "common/live/board.hpp"
#include "common/live/command.hpp"
#include "common/live/copies.hpp"
#include "common/live/messages.hpp"
#include "common/live/simulation.hpp"

namespace fc::live {

// When the next frame is due. Simulated time never runs ahead of the clock times `speed`. Frames that take longer than they
// last make the scene slower than real time: of what is lost, at most one frame is caught up. Periods are in seconds of the
// clock.
class Pace {
 public:
  using Clock = std::chrono::steady_clock;

  void begin(Clock::time_point now, double period) { due_ = now + lasting(period); }
  void frame_made(Clock::time_point now, double period) {
    due_ = std::max(due_ + lasting(period), now - lasting(period));
  }
  void period_changed(Clock::time_point now, double period) { due_ = std::min(due_, now + lasting(period)); }
  Clock::time_point due() const { return due_; }

 private:
  static Clock::duration lasting(double seconds);

  Clock::time_point due_;
};

class Loop {
 public:
  explicit Loop(Simulation& simulation) : simulation_(simulation), copies_(simulation) {}

  // Steps the simulation in the calling thread, until stop() or the command stop. The scene begins running. A step or a
  // command that fails pauses it, and the pages say why. What the simulation's other functions throw is a defect: it comes
  // out here, or of ask() or glb() if the call was for one of these.
  void run();
  // From any thread. A frame that has begun is ended first.
  void stop();

  struct Reply {
    enum class Kind { done, refused, ended } kind = Kind::ended;  // ended: the loop no longer runs
    std::string json;
  };
  // From any thread but the loop's: waits until the command has been carried out, between two frames.
  Reply ask(const Command& command);
  // The same for the scene as binary glTF, in its poses of now; nullptr if the loop no longer runs.
  std::shared_ptr<const std::string> glb();
  // What the next frame will do, step by step, as JSON; pauses the scene. Refused: a line says why.
  Reply algorithm();

  const Board& board() const { return board_; }

 private:
  using Task = std::function<void(bool ended)>;

  bool wait_for_work(std::vector<Task>& tasks);
  void end();
  template <class Result>
  Result wait_for(std::function<Result()> work, Result if_ended);
  Reply carry_out(const Command& command);
  Reply explain();
  Answer act(const Command& command);
  Answer run_or_pause(bool running);
  Answer step_once();
  bool is_stopped();
  Answer began_again(Answer answer);
  void step();
  void fail(const std::exception& error);
  void publish(bool with_state);
  double period() const { return last_.dt / course_.speed; }

  // The loop's thread alone uses these.
  Simulation& simulation_;
  Copies copies_;
  Course course_;
  Snapshot last_;
  Pace pace_;
  Pace::Clock::time_point state_at_{};      // when the last state was posted
  std::shared_ptr<const std::string> glb_;  // of the present state; nullptr: not asked for yet

  // All threads.
  Board board_;
  std::mutex mutex_;  // of what follows
  std::condition_variable asked_;
  std::vector<Task> queue_;
  bool stop_ = false, ended_ = false;
};

}  // namespace fc::live
