#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>

#include "common/display_mesh.hpp"
#include "common/errors.hpp"
#include "common/gltf.hpp"
#include "common/motion_page.hpp"
#include "common/motion_recording.hpp"

namespace fc {
namespace {

using gltf::Element;
using gltf::Json;

// Okabe and Ito's colours, distinct for any kind of colour vision; as linear light, which glTF asks for.
constexpr std::array<std::array<double, 3>, 6> kBodyColours = {{{0.000, 0.168, 0.445},
                                                                {0.791, 0.347, 0.000},
                                                                {0.000, 0.342, 0.171},
                                                                {0.093, 0.456, 0.815},
                                                                {0.604, 0.191, 0.386},
                                                                {0.871, 0.776, 0.054}}};
constexpr std::array<double, 3> kStaticColour = {0.46, 0.46, 0.46};
constexpr std::array<double, 3> kArrowColour = {0.90, 0.06, 0.03};
constexpr double kHoldFrames = 6;     // for how long a contact's arrow is seen
constexpr double kArrowLength = 0.8;  // of the largest moving body's reach: the arrow of the largest impulse
constexpr double kShortestArrow = 0.125;   // of the longest
constexpr std::size_t kMostArrows = 2000;  // at one time; further ones of that time are left out

}  // namespace

// Writes one recording into a glTF file.
class MotionFile {
 public:
  explicit MotionFile(const MotionRecording& recording) : r_(recording) {
    // z up becomes glTF's y up, once, at the root.
    const double half = std::sqrt(0.5);
    file_.add("nodes", {{"name", "world"}, {"rotation", {-half, 0, 0, half}}});
    std::vector<float> times;
    for (const double t : r_.frame_times_) times.push_back(static_cast<float>(t));
    if (!times.empty()) frame_times_ = file_.floats(times, Element::scalar);
    for (std::size_t i = 0; i < r_.bodies_.size(); ++i) add_body(static_cast<int>(i));
    add_contacts();
    Json children = Json::array();
    for (std::size_t i = 1; i < file_.json["nodes"].size(); ++i) children.push_back(i);
    file_.json["nodes"][0]["children"] = children;
    file_.json["scene"] = 0;
    for (const std::string& account : r_.accounts_)
      file_.json["extras"]["algorithm"].push_back(Json::parse(account));
    file_.add("scenes", {{"name", r_.title_}, {"nodes", {0}}, {"extras", extras()}});
  }

  std::string bytes() const { return file_.bytes(); }
  std::size_t left_out() const { return left_out_; }

 private:
  int material(const std::string& name, const std::array<double, 3>& colour, bool glows) {
    const auto known = materials_.find(name);
    if (known != materials_.end()) return known->second;
    Json m = {{"name", name},
              {"pbrMetallicRoughness",
               {{"baseColorFactor", {colour[0], colour[1], colour[2], 1}},
                {"metallicFactor", 0},
                {"roughnessFactor", 0.7}}},
              {"doubleSided", true}};
    if (glows) m["emissiveFactor"] = {colour[0], colour[1], colour[2]};
    return materials_[name] = file_.add("materials", std::move(m));
  }

  Json primitive(const DisplayMesh& mesh, int material_index) {
    Json attributes = {{"POSITION", file_.floats(mesh.positions, Element::vec3, true)}};
    if (!mesh.normals.empty()) attributes["NORMAL"] = file_.floats(mesh.normals, Element::vec3, true);
    return {{"attributes", attributes},
            {"indices", file_.indices(mesh.triangles, mesh.positions.size() / 3)},
            {"material", material_index}};
  }

  // All meshes of one shape share their numbers; there is one for each colour.
  int mesh_of(int shape, const std::string& colour_name, int material_index) {
    const auto key = std::make_pair(shape, material_index);
    const auto known = meshes_.find(key);
    if (known != meshes_.end()) return known->second;
    if (!primitives_.contains(shape)) primitives_[shape] = primitive(display_mesh(r_.shapes_[shape]), 0);
    Json own = primitives_[shape];
    own["material"] = material_index;
    return meshes_[key] = file_.add(
               "meshes", {{"name", r_.shapes_[shape].name + ", " + colour_name}, {"primitives", {own}}});
  }

  void add_body(int i) {
    const MotionRecording::Body& body = r_.bodies_[i];
    const std::size_t colour = static_cast<std::size_t>(i) % kBodyColours.size();
    const std::string name = body.moves ? fmt::format("colour {}", colour) : "static";
    const int paint = material(name, body.moves ? kBodyColours[colour] : kStaticColour, false);
    const Vec3& x = body.last.position;
    const Quat q = body.last.orientation.normalized();
    Json node = {{"name", fmt::format("body_{}", i)}, {"mesh", mesh_of(body.shape, name, paint)}};
    if (body.keys.empty()) {
      node["translation"] = {x.x(), x.y(), x.z()};
      node["rotation"] = {q.x(), q.y(), q.z(), q.w()};
    } else {
      const std::array<float, 7>& p = body.keys.front().pose;
      node["translation"] = {p[0], p[1], p[2]};
      node["rotation"] = {p[3], p[4], p[5], p[6]};
    }
    node["extras"] = {{"shape", r_.shapes_[body.shape].name}, {"static", !body.moves}};
    const int index = file_.add("nodes", std::move(node));
    if (body.keys.empty()) return;
    std::vector<float> times, positions, turns;
    bool own_times = body.keys.size() != r_.frame_times_.size();
    for (std::size_t k = 0; k < body.keys.size(); ++k) {
      const MotionRecording::Key& key = body.keys[k];
      times.push_back(key.t);
      positions.insert(positions.end(), key.pose.begin(), key.pose.begin() + 3);
      turns.insert(turns.end(), key.pose.begin() + 3, key.pose.end());
      own_times = own_times || !key.frame;
    }
    const int at = own_times ? file_.floats(times, Element::scalar) : frame_times_;
    file_.channel(index, "translation", at, file_.floats(positions, Element::vec3), false);
    file_.channel(index, "rotation", at, file_.floats(turns, Element::vec4), false);
  }

  // Contacts are arrows from a pool of nodes, each of which shows one contact after another and hides, with
  // scale 0, in between.
  void add_contacts() {
    if (r_.contacts_.empty()) return;
    double largest = 0, reach = 0;
    for (const MotionRecording::Contact& c : r_.contacts_) largest = std::max(largest, c.size);
    for (const MotionRecording::Body& body : r_.bodies_)
      if (body.moves) reach = std::max(reach, r_.shapes_[body.shape].reach);
    struct Slot {
      std::vector<float> times, points, turns, scales;
      float free_from = -1;
      void key(float t, const Vec3& p, const Quat& q, double scale) {
        times.push_back(t);
        for (int k = 0; k < 3; ++k) points.push_back(static_cast<float>(p[k]));
        for (int k = 0; k < 4; ++k) turns.push_back(static_cast<float>(q.coeffs()[k]));
        for (int k = 0; k < 3; ++k) scales.push_back(static_cast<float>(scale));
      }
    };
    std::vector<Slot> slots;
    for (const MotionRecording::Contact& c : r_.contacts_) {
      const auto t = static_cast<float>(c.t);
      auto slot = std::find_if(slots.begin(), slots.end(), [&](const Slot& s) { return s.free_from <= t; });
      if (slot == slots.end()) {
        if (slots.size() == kMostArrows) {
          ++left_out_;
          continue;
        }
        slot = slots.emplace(slots.end());
      }
      const Quat turn = Quat::FromTwoVectors(Vec3::UnitZ(), c.normal);
      const double share = largest > 0 ? std::max(kShortestArrow, c.size / largest) : 1;
      if (slot->times.empty() && t > 0) slot->key(0, c.point, turn, 0);
      if (!slot->times.empty() && slot->times.back() == t) {  // it was to hide at this very time
        slot->times.pop_back();
        slot->points.resize(slot->points.size() - 3);
        slot->turns.resize(slot->turns.size() - 4);
        slot->scales.resize(slot->scales.size() - 3);
      }
      slot->key(t, c.point, turn, share * kArrowLength * reach);
      slot->free_from = std::max(static_cast<float>(c.t + (c.rests ? r_.frame_dt_ : hold())),
                                 std::nextafter(t, std::numeric_limits<float>::max()));
      slot->key(slot->free_from, c.point, turn, 0);
    }
    const int mesh = file_.add(
        "meshes", {{"name", "arrow"},
                   {"primitives", {primitive(arrow_mesh(), material("contact", kArrowColour, true))}}});
    for (std::size_t k = 0; k < slots.size(); ++k) {
      const int node =
          file_.add("nodes", {{"name", fmt::format("contact_{}", k)}, {"mesh", mesh}, {"scale", {0, 0, 0}}});
      const int at = file_.floats(slots[k].times, Element::scalar);
      file_.channel(node, "translation", at, file_.floats(slots[k].points, Element::vec3), true);
      file_.channel(node, "rotation", at, file_.floats(slots[k].turns, Element::vec4), true);
      file_.channel(node, "scale", at, file_.floats(slots[k].scales, Element::vec3), true);
    }
  }

  double hold() const { return kHoldFrames * r_.frame_dt_; }

  Json extras() {
    Json e = {{"title", r_.title_}, {"chapter", r_.chapter_}, {"frame_dt", r_.frame_dt_}};
    if (!r_.frame_times_.empty()) e["frame_times"] = frame_times_;
    Json series = Json::array();
    for (const MotionRecording::Series& s : r_.series_)
      series.push_back({{"group", s.group},
                        {"name", s.name},
                        {"unit", s.unit},
                        {"values", file_.floats(s.values, Element::scalar)}});
    e["series"] = series;
    std::vector<float> instants;
    for (const MotionRecording::Contact& c : r_.contacts_)
      if (!c.rests && (instants.empty() || static_cast<float>(c.t) > instants.back()))
        instants.push_back(static_cast<float>(c.t));
    if (!instants.empty()) e["impact_times"] = file_.floats(instants, Element::scalar);
    e["contact_hold"] = hold();
    if (r_.stride_ > 1) e["note"] = fmt::format("one of {} frames is kept", r_.stride_);
    Json levels = Json::array();
    std::map<std::pair<int, int>, DisplayMesh> merged;
    std::map<std::pair<int, int>, int> count;
    for (const MotionRecording::Hull& hull : r_.hulls_) {
      DisplayMesh& all = merged[{hull.shape, hull.level}];
      const int first = static_cast<int>(all.positions.size() / 3);
      for (const Vec3& v : hull.mesh.vertices)
        for (int k = 0; k < 3; ++k) all.positions.push_back(static_cast<float>(v[k]));
      for (const auto& t : hull.mesh.triangles)
        all.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      ++count[{hull.shape, hull.level}];
    }
    for (const auto& [where, mesh] : merged) {  // meshes that no node shows: only our page draws them
      const auto [shape, level] = where;
      const std::string name = fmt::format("hulls of {}, level {}", r_.shapes_[shape].name, level);
      const int paint = material("static", kStaticColour, false);
      Json bodies = Json::array();
      for (std::size_t i = 0; i < r_.bodies_.size(); ++i)
        if (r_.bodies_[i].shape == shape) bodies.push_back(i);
      levels.push_back(
          {{"bodies", bodies},
           {"level", level},
           {"mesh", file_.add("meshes", {{"name", name}, {"primitives", {primitive(mesh, paint)}}})},
           {"hulls", count[where]}});
    }
    if (!levels.empty()) e["levels"] = levels;
    return e;
  }

  const MotionRecording& r_;
  gltf::File file_;
  int frame_times_ = 0;
  std::map<std::string, int> materials_;
  std::map<int, Json> primitives_;
  std::map<std::pair<int, int>, int> meshes_;
  std::size_t left_out_ = 0;
};

std::string MotionRecording::glb() const {
  return MotionFile(*this).bytes();
}

std::string MotionRecording::write(const std::filesystem::path& folder) {
  if (frame_times_.empty()) throw std::invalid_argument("a recording without frames");
  const MotionFile file(*this);
  const std::string bytes = file.bytes();
  for (const auto& [name, content] :
       {std::pair("motion.glb", bytes), std::pair("motion.html", motion_page(title_, bytes))}) {
    std::ofstream stream(folder / name, std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.close();
    if (!stream) throw InputError((folder / name).string() + ": cannot be written; is the disk full?");
  }
  std::string remark = "motion.html plays it (a double click opens it)";
  if (stride_ > 1) remark += fmt::format("; one of {} frames is kept", stride_);
  if (file.left_out() > 0)
    remark += fmt::format("; {} contacts beyond {} at a time are not shown", file.left_out(), kMostArrows);
  return remark;
}

}  // namespace fc
