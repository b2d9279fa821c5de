#include "common/live/messages.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "common/text.hpp"

namespace fc::live {
namespace {

// Objects keep the order in which the simulation names things: a page shows them so.
using Json = nlohmann::ordered_json;

// Appends little-endian numbers to a message.
class Writer {
 public:
  explicit Writer(MessageKind kind) {
    put(std::uint32_t{0});  // the length, known at the end
    put(static_cast<std::uint32_t>(kind));
  }

  template <class Number>
  void put(Number number) {
    char bytes[sizeof(Number)];
    std::memcpy(bytes, &number, sizeof(Number));
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes, bytes + sizeof(Number));
    message_.append(bytes, sizeof(Number));
  }
  void put_floats(const Vec3& v) {
    for (const double x : {v.x(), v.y(), v.z()}) put(static_cast<float>(x));
  }
  void put_bytes(std::string_view bytes) { message_ += bytes; }
  void reserve(std::size_t bytes) { message_.reserve(bytes); }

  std::string message() {
    std::string body = std::exchange(message_, {});
    put(static_cast<std::uint32_t>(body.size() - sizeof(std::uint32_t)));
    std::copy(message_.begin(), message_.end(), body.begin());
    return body;
  }

 private:
  std::string message_;
};

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);  // a name of the scene's may be no UTF-8
}

// JSON has neither infinity nor NaN.
Json number(double x) {
  return std::isfinite(x) ? Json(x) : Json(nullptr);
}

Json numbers(const std::vector<std::pair<std::string, double>>& named) {
  Json object = Json::object();
  for (const auto& [name, value] : named) object[name] = number(value);
  return object;
}

Json effect_json(const EffectState& effect) {
  Json json = {
      {"on", effect.on}, {"ms", number(effect.ms)}, {"can_switch", effect.can_switch}, {"set", nullptr}};
  if (const std::size_t equals = effect.key.find('='); equals != std::string::npos)
    json["set"] = {{"key", effect.key.substr(0, equals)}, {"on", effect.key.substr(equals + 1)}};
  json["why"] = effect.why;
  json["adds"] = effect.adds;
  return json;
}

Json knob_json(const Knob& knob) {
  return {{"key", knob.key},         {"unit", knob.unit},        {"value", knob.value},
          {"meaning", knob.meaning}, {"low", number(knob.low)},  {"high", number(knob.high)},
          {"choices", knob.choices}, {"restarts", knob.restarts}};
}

// All of a frame's message but its header.
void put_frame(Writer& writer, const Snapshot& snapshot, int geometry, bool running, bool failed) {
  writer.reserve(128 + 28 * snapshot.poses.size() + 40 * snapshot.contacts.size());
  writer.put(static_cast<std::uint32_t>(geometry));
  writer.put(static_cast<std::uint32_t>(snapshot.frame));
  writer.put(snapshot.t);
  writer.put(std::uint32_t{running} | std::uint32_t{failed} << 1);
  writer.put(static_cast<std::uint32_t>(snapshot.poses.size()));
  writer.put(static_cast<std::uint32_t>(snapshot.contacts.size()));
  writer.put(static_cast<std::int32_t>(snapshot.grabbed));
  for (const Pose& pose : snapshot.poses) {
    writer.put_floats(pose.position);
    const Quat& q = pose.orientation;
    for (const double x : {q.x(), q.y(), q.z(), q.w()}) writer.put(static_cast<float>(x));
  }
  for (const ContactMark& contact : snapshot.contacts) {
    writer.put_floats(contact.point);
    writer.put_floats(contact.normal);
    writer.put_floats(contact.impulse);
    writer.put(contact.rests ? 1.0f : 0.0f);
  }
  if (snapshot.grabbed >= 0) {
    writer.put_floats(snapshot.grab_point);
    writer.put_floats(snapshot.grab_target);
  }
}

Json line_or_null(const std::optional<std::string>& text) {
  return text ? Json(one_line(*text)) : Json(nullptr);
}

void add_numbers(Json& json, const Snapshot& snapshot) {
  json["step_ms"] = number(snapshot.step_ms);
  json["stages"] = numbers(snapshot.stages);
  json["contacts"] = snapshot.contacts.size();
  json["energy"] = number(snapshot.energy);
  json["kinetic"] = number(snapshot.kinetic);
  json["potential"] = number(snapshot.potential);
  json["account"] = numbers(snapshot.account);
  json["min_gap"] = number(snapshot.min_gap);
  json["lost_time"] = number(snapshot.lost_time);
  json["residual"] = number(snapshot.residual);
  json["warnings"] = Json::array();
  for (const std::string& line : snapshot.warnings) json["warnings"].push_back(one_line(line));
}

void add_offers(Json& json, const Simulation& simulation) {
  json["effects"] = Json::object();
  for (const EffectState& effect : simulation.effects()) json["effects"][effect.name] = effect_json(effect);
  json["knobs"] = Json::array();
  for (const Knob& knob : simulation.knobs()) json["knobs"].push_back(knob_json(knob));
}

Json twin_json(const TwinState& twin) {
  Json json = {{"t", number(twin.now.t)},
               {"frame", twin.now.frame},
               {"failed", line_or_null(twin.failed)},
               {"dt", number(twin.now.dt)}};
  add_numbers(json, twin.now);
  add_offers(json, *twin.simulation);
  json["distance"] = number(twin.distance.metres);
  return json;
}

}  // namespace

std::string frame_message(const Snapshot& snapshot, int geometry, const Course& course) {
  Writer writer(MessageKind::frame);
  put_frame(writer, snapshot, geometry, course.running, course.failed.has_value());
  return writer.message();
}

std::string twin_message(const TwinState& twin, const Course& course) {
  Writer writer(MessageKind::twin);
  writer.put(twin.distance.metres);
  writer.put(static_cast<std::int32_t>(twin.distance.farthest));
  put_frame(writer, twin.now, twin.simulation->geometry(), course.running, twin.failed.has_value());
  return writer.message();
}

std::string state_message(std::string_view state) {
  Writer writer(MessageKind::state);
  writer.put_bytes(state);
  return writer.message();
}

std::string state_text(const Simulation& simulation, const Snapshot& snapshot, const Course& course,
                       const std::optional<TwinState>& twin) {
  Json json = {{"t", number(snapshot.t)},         {"frame", snapshot.frame},
               {"running", course.running},       {"failed", line_or_null(course.failed)},
               {"title", simulation.title()},     {"dt", number(snapshot.dt)},
               {"bodies", snapshot.poses.size()}, {"geometry", simulation.geometry()}};
  add_numbers(json, snapshot);
  json["speed"] = number(course.speed);
  add_offers(json, simulation);
  json["twin"] = twin ? twin_json(*twin) : Json(nullptr);
  return dumped(json);
}

std::string answer_text(const Answer& answer, bool saved) {
  Json json = {{"ok", true},
               {"text", saved ? "the scene as it stands" : one_line(answer.text)},
               {"restarted", answer.restarted},
               {"rebuilt", answer.rebuilt},
               {"ms", number(answer.ms)}};
  if (saved) json["scene"] = answer.text;
  return dumped(json);
}

std::string refusal_text(std::string_view why) {
  return dumped({{"ok", false}, {"text", one_line(why)}});
}

}  // namespace fc::live
