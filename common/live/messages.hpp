// What the server tells a page, as bytes (STREAM.md). No HTTP here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/live/copies.hpp"
#include "common/live/simulation.hpp"

namespace fc::live {

// How the server runs the simulation.
struct Course {
  bool running = true;
  std::optional<std::string> failed;  // what the simulation said
  double speed = 1;                   // simulated seconds per second, at most
};

enum class MessageKind : std::uint32_t { frame = 1, state = 2, twin = 3 };
inline constexpr std::size_t message_header = 8;  // bytes: the length and the kind

// A message of the stream: header and body.
std::string frame_message(const Snapshot& snapshot, int geometry, const Course& course);
std::string twin_message(const TwinState& twin, const Course& course);
std::string state_message(std::string_view state);

// The JSON of GET /state. Calls the simulation's title(), geometry(), effects() and knobs().
std::string state_text(const Simulation& simulation, const Snapshot& snapshot, const Course& course,
                       const std::optional<TwinState>& twin = std::nullopt);

// The JSON that answers a command. `saved`: the answer's text is a scene file.
std::string answer_text(const Answer& answer, bool saved);
std::string refusal_text(std::string_view why);

}  // namespace fc::live
