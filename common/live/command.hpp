// What a page can ask of a live scene, read from its JSON (STREAM.md). No HTTP here.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "common/types.hpp"

namespace fc::live {

namespace command {
struct Run {};
struct Pause {};
struct Step {};
struct Reset {};
struct Stop {};
struct Drop {};
struct Save {};
struct Set {
  std::string key, value;
  bool of_twin = false;  // else of the scene
};
struct Twin {
  bool on = false;
};
struct Throw {
  Vec3 from, velocity;  // m, m/s
};
struct Grab {
  int body = 0;
  Vec3 point;  // m, world
};
struct Drag {
  Vec3 to;  // m, world
};
struct Speed {
  double value = 1;  // simulated seconds per second, in (0, 1]
};
}  // namespace command

using Command = std::variant<command::Run, command::Pause, command::Step, command::Reset, command::Stop,
                             command::Drop, command::Save, command::Set, command::Twin, command::Throw,
                             command::Grab, command::Drag, command::Speed>;

// Throws InputError, with one line that says what is wrong, for all that is not exactly one command: fields that are
// missing, unknown or of another type, and numbers that are not finite.
Command parse_command(std::string_view json);

}  // namespace fc::live
