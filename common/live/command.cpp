#include "common/live/command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"
#include "common/text.hpp"

namespace fc::live {
namespace {

using Json = nlohmann::json;

// The fields of one command, each of which is read once.
class Fields {
 public:
  explicit Fields(const Json& object) : object_(object), name_(text("do")) {}

  const std::string& name() const { return name_; }

  // A field that the command does not have is a mistake of the page's: its effect would be missed.
  void only(std::initializer_list<std::string_view> known) const {
    for (const auto& [field, value] : object_.items())
      if (field != "do" && std::find(known.begin(), known.end(), field) == known.end())
        throw InputError(fmt::format("'{}' has no field {}", name_, in_quotes(field)));
  }

  std::string text(const char* field) const {
    const Json& value = at(field);
    if (!value.is_string()) throw InputError(fmt::format("'{}' must be a text", field));
    return value.get<std::string>();
  }

  double number(const char* field) const { return finite(at(field), field, "a finite number"); }

  bool yes(const char* field) const {
    const Json& value = at(field);
    if (!value.is_boolean()) throw InputError(fmt::format("'{}' must be true or false", field));
    return value.get<bool>();
  }
  bool has(const char* field) const { return object_.contains(field); }

  int whole(const char* field) const {
    const Json& value = at(field);
    const bool fits =
        value.is_number_unsigned() &&
        value.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<int>::max());
    if (!fits) throw InputError(fmt::format("'{}' must be a whole number from 0 on", field));
    return value.get<int>();
  }

  Vec3 vector(const char* field) const {
    static const char* form = "three finite numbers, [x, y, z]";
    const Json& value = at(field);
    if (!value.is_array() || value.size() != 3) throw InputError(fmt::format("'{}' must be {}", field, form));
    Vec3 result;
    for (int i = 0; i < 3; ++i) result[i] = finite(value[static_cast<std::size_t>(i)], field, form);
    return result;
  }

 private:
  const Json& at(const char* field) const {
    const auto found = object_.find(field);
    if (found == object_.end()) throw InputError(fmt::format("the command has no field '{}'", field));
    return *found;
  }

  static double finite(const Json& value, const char* field, const char* form) {
    const double number = value.is_number() ? value.get<double>() : std::numeric_limits<double>::infinity();
    if (!std::isfinite(number)) throw InputError(fmt::format("'{}' must be {}", field, form));
    return number;
  }

  const Json& object_;
  std::string name_;
};

template <class Bare>
Command bare(const Fields& fields) {
  fields.only({});
  return Bare{};
}

Command parse_set(const Fields& fields) {
  fields.only({"key", "value", "of"});
  const bool of_twin = fields.has("of");
  if (of_twin && fields.text("of") != "twin")
    throw InputError("'of' must be \"twin\"; without it the key is of the scene");
  return command::Set{fields.text("key"), fields.text("value"), of_twin};
}

Command parse_twin(const Fields& fields) {
  fields.only({"on"});
  return command::Twin{fields.yes("on")};
}

Command parse_throw(const Fields& fields) {
  fields.only({"from", "velocity"});
  return command::Throw{fields.vector("from"), fields.vector("velocity")};
}

Command parse_grab(const Fields& fields) {
  fields.only({"body", "point"});
  return command::Grab{fields.whole("body"), fields.vector("point")};
}

Command parse_drag(const Fields& fields) {
  fields.only({"to"});
  return command::Drag{fields.vector("to")};
}

Command parse_speed(const Fields& fields) {
  fields.only({"value"});
  const double value = fields.number("value");
  if (!(value > 0 && value <= 1))
    throw InputError(fmt::format("'value' is {}, out of range (0, 1]: simulated seconds per second", value));
  return command::Speed{value};
}

struct Kind {
  std::string_view name;
  Command (*parse)(const Fields&);
};

constexpr std::array<Kind, 13> kinds = {{{"run", bare<command::Run>},
                                         {"pause", bare<command::Pause>},
                                         {"step", bare<command::Step>},
                                         {"reset", bare<command::Reset>},
                                         {"stop", bare<command::Stop>},
                                         {"drop", bare<command::Drop>},
                                         {"save", bare<command::Save>},
                                         {"set", parse_set},
                                         {"twin", parse_twin},
                                         {"throw", parse_throw},
                                         {"grab", parse_grab},
                                         {"drag", parse_drag},
                                         {"speed", parse_speed}}};

}  // namespace

Command parse_command(std::string_view json) {
  const Json object = Json::parse(json, nullptr, /*allow_exceptions=*/false);
  if (object.is_discarded()) throw InputError("the command is not JSON");
  if (!object.is_object()) throw InputError("the command must be a JSON object, such as {\"do\": \"run\"}");
  const Fields fields(object);
  for (const Kind& kind : kinds)
    if (kind.name == fields.name()) return kind.parse(fields);
  throw InputError("there is no command " + in_quotes(fields.name()));
}

}  // namespace fc::live
