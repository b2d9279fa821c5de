#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "common/program.hpp"

namespace fc {

Progress::Progress(std::string what, std::int64_t total, bool quiet)
    : what_(std::move(what)),
      total_(std::max<std::int64_t>(total, 1)),
      enabled_(!quiet && isatty(STDERR_FILENO)) {}

void Progress::update(std::int64_t done) {
  if (!enabled_) return;
  const auto percent = static_cast<int>(std::clamp<double>(100.0 * double(done) / double(total_), 0, 100));
  if (percent == shown_percent_) return;
  shown_percent_ = percent;
  constexpr int width = 40;
  const auto filled = static_cast<std::size_t>(percent * width / 100);
  fmt::print(stderr, "\r{} [{}{}] {:3}%", what_, std::string(filled, '#'), std::string(width - filled, ' '),
             percent);
  std::fflush(stderr);
}

Progress::~Progress() {
  if (enabled_ && shown_percent_ >= 0) fmt::print(stderr, "\r\033[K");  // to the line's start, and clear it
}

}  // namespace fc
