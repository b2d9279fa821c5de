#include "common/live/loop.hpp"

#include <fmt/format.h>

#include <future>
#include <utility>

#include "common/errors.hpp"
#include "common/text.hpp"

namespace fc::live {
namespace {

constexpr std::chrono::milliseconds state_interval{100};

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

// A scene whose step has failed may stand in the middle of it.
bool needs_a_whole_scene(const Command& command) {
  return std::visit(
      Overloaded{[](const command::Pause&) { return false; }, [](const command::Reset&) { return false; },
                 [](const command::Stop&) { return false; }, [](const command::Set&) { return false; },
                 [](const command::Twin& twin) { return twin.on; },
                 [](const command::Speed&) { return false; }, [](const auto&) { return true; }},
      command);
}

}  // namespace

Pace::Clock::duration Pace::lasting(double seconds) {
  constexpr double longest = 1e6;  // the clock's counter would overflow at 3e11
  return std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(std::clamp(seconds, 0.0, longest)));
}

void Loop::run() {
  struct AtTheEnd {  // however the loop ends: nobody waits for it forever
    Loop& loop;
    ~AtTheEnd() { loop.end(); }
  } at_the_end{*this};
  publish(true);
  pace_.begin(Pace::Clock::now(), period());
  std::vector<Task> tasks;
  while (wait_for_work(tasks)) {
    for (const Task& task : std::exchange(tasks, {})) task(false);
    if (course_.running && Pace::Clock::now() >= pace_.due()) step();
  }
  for (const Task& task : tasks) task(true);
}

// Waits until a frame is due or something is asked for; false: the loop is to stop.
bool Loop::wait_for_work(std::vector<Task>& tasks) {
  std::unique_lock lock(mutex_);
  const auto asked = [this] { return stop_ || !queue_.empty(); };
  if (course_.running)
    asked_.wait_until(lock, pace_.due(), asked);
  else
    asked_.wait(lock, asked);
  tasks.swap(queue_);
  return !stop_;
}

void Loop::end() {
  std::vector<Task> tasks;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    tasks.swap(queue_);
  }
  for (const Task& task : tasks) task(true);
  board_.close();
}

void Loop::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  asked_.notify_one();
}

// Hands work to the loop's thread, and waits for its result.
template <class Result>
Result Loop::wait_for(std::function<Result()> work, Result if_ended) {
  const auto promise = std::make_shared<std::promise<Result>>();
  std::future<Result> result = promise->get_future();
  {
    const std::lock_guard lock(mutex_);
    if (ended_) return if_ended;
    queue_.push_back([promise, work = std::move(work), if_ended](bool ended) {
      try {
        promise->set_value(ended ? if_ended : work());
      } catch (...) {
        promise->set_exception(std::current_exception());
      }
    });
  }
  asked_.notify_one();
  return result.get();
}

Loop::Reply Loop::ask(const Command& command) {
  const Reply ended{Reply::Kind::ended, refusal_text("the scene has been stopped")};
  return wait_for<Reply>([this, command] { return carry_out(command); }, ended);
}

std::shared_ptr<const std::string> Loop::glb() {
  using Text = std::shared_ptr<const std::string>;
  return wait_for<Text>(
      [this] {
        if (!glb_) glb_ = std::make_shared<const std::string>(simulation_.glb());
        return glb_;
      },
      nullptr);
}

Loop::Reply Loop::algorithm() {
  return wait_for<Reply>([this] { return explain(); }, {Reply::Kind::ended, "the scene has been stopped"});
}

// Worked out on a copy: what fails there has not failed in the scene.
Loop::Reply Loop::explain() {
  if (course_.running) {
    run_or_pause(false);
    publish(true);
  }
  if (course_.failed) return {Reply::Kind::refused, "the scene has failed: reset it first"};
  try {
    return {Reply::Kind::done, simulation_.algorithm()};
  } catch (const std::exception& error) {
    return {Reply::Kind::refused, one_line(error.what())};
  }
}

Loop::Reply Loop::carry_out(const Command& command) {
  Reply reply;
  try {
    const Answer answer = act(command);
    reply = {Reply::Kind::done, answer_text(answer, std::holds_alternative<command::Save>(command))};
  } catch (const InputError& refused) {
    return {Reply::Kind::refused, refusal_text(refused.what())};
  } catch (const std::exception& error) {
    fail(error);
    reply = {Reply::Kind::refused, refusal_text(error.what())};
  }
  publish(
      !std::holds_alternative<command::Drag>(command));  // a drag comes with each frame, and changes no state
  pace_.period_changed(Pace::Clock::now(), period());
  return reply;
}

Answer Loop::act(const Command& command) {
  if (course_.failed && needs_a_whole_scene(command))
    throw InputError("the scene has failed: reset it first");
  return std::visit(
      Overloaded{
          [this](const command::Run&) { return run_or_pause(true); },
          [this](const command::Pause&) { return run_or_pause(false); },
          [this](const command::Step&) { return step_once(); },
          [this](const command::Reset&) { return began_again(copies_.reset()); },
          [this](const command::Stop&) {
            stop();
            return Answer{"the scene has been stopped"};
          },
          [this](const command::Drop&) { return copies_.drop(); },
          [this](const command::Save&) { return copies_.save(); },
          [this](const command::Set& set) {
            const Answer answer = copies_.set(set.key, set.value, set.of_twin);
            return answer.restarted ? began_again(answer) : answer;
          },
          [this](const command::Twin& twin) { return twin.on ? copies_.begin_twin() : copies_.end_twin(); },
          [this](const command::Throw& ball) { return copies_.throw_ball(ball.from, ball.velocity); },
          [this](const command::Grab& grab) { return copies_.grab(grab.body, grab.point); },
          [this](const command::Drag& drag) { return copies_.drag(drag.to); },
          [this](const command::Speed& speed) {
            course_.speed = speed.value;
            return Answer{fmt::format("{:.6g} simulated seconds per second, at most", speed.value)};
          }},
      command);
}

Answer Loop::run_or_pause(bool running) {
  if (running && !course_.running) pace_.begin(Pace::Clock::now(), period());
  course_.running = running;
  return {running ? "it runs" : "it is paused"};
}

bool Loop::is_stopped() {
  const std::lock_guard lock(mutex_);
  return stop_;
}

Answer Loop::step_once() {
  run_or_pause(false);
  copies_.step([this] { return is_stopped(); });
  return {"one frame"};
}

// A scene that had failed is whole again; it stays paused.
Answer Loop::began_again(Answer answer) {
  course_.failed.reset();
  return answer;
}

void Loop::step() {
  try {
    copies_.step([this] { return is_stopped(); });
  } catch (const std::exception& error) {
    fail(error);
  }
  publish(course_.failed.has_value());
  pace_.frame_made(Pace::Clock::now(), period());
}

void Loop::fail(const std::exception& error) {
  course_.failed = error.what();
  course_.running = false;
}

void Loop::publish(bool with_state) {
  glb_.reset();
  last_ = simulation_.snapshot();
  const std::optional<TwinState> twin = copies_.twin(last_);
  const auto now = Pace::Clock::now();
  std::optional<std::string> state, of_twin;
  if (twin) of_twin = twin_message(*twin, course_);
  if (with_state || now - state_at_ >= state_interval) {
    state = state_message(state_text(simulation_, last_, course_, twin));
    state_at_ = now;
  }
  board_.post(frame_message(last_, simulation_.geometry(), course_), std::move(of_twin), std::move(state));
}

}  // namespace fc::live
