#include "common/algorithm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace fc::algorithm {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kRoles[] = {"a", "b", "now", "past", "good", "bad", "force"};
constexpr const char* kKinds[] = {"point", "line", "arrow", "plane", "mesh", "label"};

const char* role_name(Role role) {
  return kRoles[static_cast<int>(role)];
}

// Seven digits are more than a picture shows, and a third of what a double takes.
Json short_number(double x) {
  if (!std::isfinite(x)) throw std::invalid_argument("an account of a frame has a number that is not finite");
  return std::strtod(fmt::format("{:.7g}", x).c_str(), nullptr);
}

Json json_of(const Vec3& v) {
  return Json::array({short_number(v.x()), short_number(v.y()), short_number(v.z())});
}

Json json_of(const std::vector<Vec3>& points) {
  Json list = Json::array();
  for (const Vec3& v : points) list.push_back(json_of(v));
  return list;
}

Json json_of(const Mark& mark) {
  using Kind = Mark::Kind;
  Json j = {{"kind", kKinds[static_cast<int>(mark.kind)]}};
  if (mark.kind == Kind::point || mark.kind == Kind::label) j["at"] = json_of(mark.points.at(0));
  if (mark.kind == Kind::line || mark.kind == Kind::mesh) j["points"] = json_of(mark.points);
  if (mark.kind == Kind::arrow) {
    j["from"] = json_of(mark.points.at(0));
    j["to"] = json_of(mark.points.at(1));
  }
  if (mark.kind == Kind::plane) {
    j["at"] = json_of(mark.points.at(0));
    j["normal"] = json_of(mark.points.at(1));
    j["radius"] = short_number(mark.radius);
  }
  if (mark.kind == Kind::mesh) j["triangles"] = mark.triangles;
  if (mark.kind == Kind::line) j["closed"] = mark.closed;
  if (mark.kind == Kind::label)
    j["text"] = mark.text;
  else
    j["role"] = role_name(mark.role);
  return j;
}

Json json_of(const Chart& chart) {
  Json curves = Json::array(), notes = Json::array();
  for (const Curve& curve : chart.curves) {
    Json points = Json::array();
    for (const auto& p : curve.points) points.push_back({short_number(p[0]), short_number(p[1])});
    curves.push_back(
        {{"name", curve.name}, {"role", role_name(curve.role)}, {"points", points}, {"steps", curve.steps}});
  }
  for (const ChartNote& note : chart.notes)
    notes.push_back(Json::array({short_number(note.x), short_number(note.y), note.text}));
  return {{"x", chart.x}, {"y", chart.y}, {"log", chart.log}, {"curves", curves}, {"marks", notes}};
}

Json json_of(const Bars& bars) {
  Json rows = Json::array();
  for (const Bar& bar : bars.rows)
    rows.push_back({{"label", bar.label},
                    {"value", short_number(bar.value)},
                    {"role", role_name(bar.role)},
                    {"note", bar.note}});
  return {{"title", bars.title}, {"unit", bars.unit}, {"rows", rows}};
}

Json json_of(const Step& step) {
  Json j = {{"text", step.text}};
  if (!step.poses.empty()) {
    Json poses = Json::array();
    for (const BodyPose& p : step.poses) {
      Json pose = Json::array({p.body});
      for (int k = 0; k < 3; ++k) pose.push_back(short_number(p.position[k]));
      for (int k = 0; k < 4; ++k) pose.push_back(short_number(p.orientation.coeffs()[k]));  // x y z w
      poses.push_back(pose);
    }
    j["poses"] = poses;
  }
  if (!step.draw.empty()) {
    j["draw"] = Json::array();
    for (const Mark& mark : step.draw) j["draw"].push_back(json_of(mark));
  }
  if (step.chart) j["chart"] = json_of(*step.chart);
  if (step.bars) j["bars"] = json_of(*step.bars);
  return j;
}

// A part while it may still lose steps: their texts, and which of them stay.
struct WrittenPart {
  const Part* part;
  std::vector<Step> steps;
  std::vector<std::string> texts;
  std::size_t bytes = 0;
  int left_out = 0;

  explicit WrittenPart(const Part& from) : part(&from), steps(from.steps) {
    for (const Step& step : steps) {
      texts.push_back(json_of(step).dump());
      bytes += texts.back().size() + 1;
    }
  }

  // Leaves out the step before the middle; the first two and the last stay.
  bool shorten() {
    if (texts.size() < 4) return false;
    const auto at = static_cast<std::ptrdiff_t>(texts.size() / 2);
    bytes -= texts[static_cast<std::size_t>(at)].size() + 1;
    texts.erase(texts.begin() + at);
    steps.erase(steps.begin() + at);
    ++left_out;
    return true;
  }

  std::string text() {
    if (left_out > 0) {
      steps.back().text += fmt::format(" {} steps of this part are left out.", left_out);
      texts.back() = json_of(steps.back()).dump();
    }
    return fmt::format("{{\"chapter\":{},\"title\":{},\"steps\":[{}]}}", part->chapter,
                       Json(part->title).dump(), fmt::join(texts, ","));
  }
};

}  // namespace

Mark point(const Vec3& at, Role role) {
  return {Mark::Kind::point, role, {at}};
}
Mark line(std::vector<Vec3> points, Role role, bool closed) {
  Mark mark{Mark::Kind::line, role, std::move(points)};
  mark.closed = closed;
  return mark;
}
Mark arrow(const Vec3& from, const Vec3& to, Role role) {
  return {Mark::Kind::arrow, role, {from, to}};
}
Mark plane(const Vec3& at, const Vec3& normal, double radius, Role role) {
  Mark mark{Mark::Kind::plane, role, {at, normal}};
  mark.radius = radius;
  return mark;
}
Mark mesh(std::vector<Vec3> points, std::vector<std::array<int, 3>> triangles, Role role) {
  return {Mark::Kind::mesh, role, std::move(points), std::move(triangles)};
}
Mark label(const Vec3& at, std::string text) {
  Mark mark{Mark::Kind::label, Role::now, {at}};
  mark.text = std::move(text);
  return mark;
}

std::string json(const Document& document) {
  constexpr std::size_t kHead = 1000;  // what is not in a step, and the remarks on what is left out
  std::vector<WrittenPart> parts;
  std::size_t bytes = kHead;
  for (const Part& part : document.parts) {
    parts.emplace_back(part);
    bytes += parts.back().bytes + part.title.size() + 100;
  }
  while (bytes > kMostBytes) {
    WrittenPart* longest = nullptr;
    for (WrittenPart& part : parts)
      if (part.texts.size() >= 4 && (longest == nullptr || part.bytes > longest->bytes)) longest = &part;
    if (longest == nullptr) throw std::invalid_argument("an account of a frame is too long, in single steps");
    const std::size_t before = longest->bytes;
    longest->shorten();
    bytes -= before - longest->bytes;
  }
  std::vector<std::string> texts;
  for (WrittenPart& part : parts) texts.push_back(part.text());
  return fmt::format("{{\"frame\":{},\"t0\":{},\"t1\":{},\"parts\":[{}]}}", document.frame,
                     short_number(document.t0).dump(), short_number(document.t1).dump(),
                     fmt::join(texts, ","));
}

std::string count(std::int64_t n, const std::string& noun) {
  return fmt::format("{} {}{}", n, noun, n == 1 ? "" : "s");
}

std::string number(double x) {
  if (x == 0) return "0";
  return fmt::format("{:.4g}", x);
}

}  // namespace fc::algorithm
