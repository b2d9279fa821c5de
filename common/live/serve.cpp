#include "common/live/serve.hpp"

#include <fmt/format.h>

#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <functional>
#include <mutex>
#include <thread>

#include "common/live/server.hpp"
#include "common/motion_page.hpp"
#include "common/text.hpp"

namespace fc::live {
namespace {

// Calls a function at the first Ctrl-C or SIGTERM, from a thread: a signal handler may do hardly anything. Threads that are
// begun during its life never get these signals. A second one ends the program as if nobody had waited: a step may be long.
class EndSignals {
 public:
  explicit EndSignals(std::function<void()> at_the_first) : at_the_first_(std::move(at_the_first)) {
    sigemptyset(&watched_);
    for (const int signal : {SIGINT, SIGTERM}) {
      struct sigaction action {};
      sigaction(signal, nullptr, &action);
      if (action.sa_handler != SIG_DFL) continue;  // ignored (nohup), or somebody else's
      sigaddset(&watched_, signal);
      last_ = signal;
    }
    if (last_ == 0) return;
    pthread_sigmask(SIG_BLOCK, &watched_, &before_);
    thread_ = std::thread([this] { wait(); });
  }
  ~EndSignals() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
      if (!came_) pthread_kill(thread_.native_handle(), last_);  // it still waits for one
    }
    changed_.notify_one();
    thread_.join();
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  void wait() {
    int signal = 0;
    sigwait(&watched_, &signal);
    std::unique_lock lock(mutex_);
    if (over_) return;
    came_ = true;
    at_the_first_();
    pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);  // the second comes to this thread
    changed_.wait(lock, [this] { return over_; });
  }

  std::function<void()> at_the_first_;
  sigset_t watched_{}, before_{};
  int last_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool came_ = false, over_ = false;
  std::thread thread_;
};

}  // namespace

int serve(Simulation& simulation, int port, bool quiet) {
  const std::string title = simulation.title();
  Server server(simulation, motion_page(title, ""), port);  // an empty recording is a live page
  const EndSignals signals([&server] { server.stop(); });
  if (!quiet) fmt::print("{}: open this address in a browser; Ctrl-C ends it\n", one_line(title));
  fmt::print("{}\n", server.address());
  std::fflush(stdout);
  server.run();
  return 0;
}

}  // namespace fc::live
