#include "common/live/board.hpp"

#include <utility>

namespace fc::live {

void Board::post(std::string frame, std::optional<std::string> twin, std::optional<std::string> state) {
  auto shared_frame = std::make_shared<const std::string>(std::move(frame));
  auto shared_twin = twin ? std::make_shared<const std::string>(*std::move(twin)) : nullptr;
  auto shared_state = state ? std::make_shared<const std::string>(*std::move(state)) : nullptr;
  {
    const std::lock_guard lock(mutex_);
    news_.frame.message.swap(shared_frame);
    ++news_.frame.number;
    news_.twin.message.swap(shared_twin);
    ++news_.twin.number;
    if (shared_state) {
      news_.state.message.swap(shared_state);
      ++news_.state.number;
    }
  }
  changed_.notify_all();
}  // what was there before is freed here, outside of the lock, unless a page still sends it

void Board::close() {
  {
    const std::lock_guard lock(mutex_);
    news_.closed = true;
  }
  changed_.notify_all();
}

News Board::news() const {
  const std::lock_guard lock(mutex_);
  return news_;
}

News Board::wait(std::uint64_t frame, std::uint64_t state, std::chrono::milliseconds longest) const {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, longest,
                    [&] { return news_.closed || news_.frame.number > frame || news_.state.number > state; });
  return news_;
}

}  // namespace fc::live
