#include <fmt/format.h>

#include "common/scene_keys.hpp"
#include "common/scene_parts.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

const std::vector<std::string> kinds = {"sphere", "box",  "capsule", "cylinder",
                                        "cone",   "hull", "mesh",    "parts"};

// Debian's glmark2-data ships the Stanford bunny here.
constexpr const char* system_models = "/usr/share/glmark2/models";

std::filesystem::path find_mesh(const Section& shape, const SceneSource& source) {
  const std::filesystem::path name = shape.get(text_value, "mesh");
  std::vector<std::filesystem::path> folders = {source.file.parent_path()};
  folders.insert(folders.end(), source.mesh_path.begin(), source.mesh_path.end());
  folders.emplace_back(system_models);
  if (name.is_absolute()) folders = {""};
  std::vector<std::string> tried;
  for (const std::filesystem::path& folder : folders) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(folder / name, ignored)) return folder / name;
    tried.push_back(folder.empty() ? "the current folder" : folder.string());
  }
  if (name.is_absolute()) {
    refuse(shape.node("mesh").place,
           fmt::format("no mesh file {}; check the path", in_quotes(name.string())));
  }
  refuse(shape.node("mesh").place,
         fmt::format("no mesh file {} in {}; put it there, or name its folder by --mesh-path",
                     in_quotes(name.string()), one_of(tried)));
}

// The one kind of shape that the section of a shape, or of a part, has. `who`: "shape 'rod'".
std::string kind_of(const Section& shape, const std::string& who, int chapter) {
  std::string found;
  for (const std::string& kind : kinds) {
    if (!shape.has(kind)) continue;
    if (!found.empty()) {
      refuse(shape.entry(kind).key_place,
             fmt::format("{} has two kinds, '{}' and '{}'; keep one of them", who, found, kind));
    }
    found = kind;
  }
  if (found.empty()) {
    std::vector<std::string> known;  // to this chapter
    for (const std::string& kind : kinds)
      if (const SceneKey* key = shape.find_row(kind); key && key->known_in(chapter)) known.push_back(kind);
    refuse(shape.place(), fmt::format("{} has no kind; give it one of {}", who, one_of(known)));
  }
  return found;
}

// The geometry of a convex kind, into a shape's specification or a part's.
template <class Spec>
void read_convex(const Section& shape, const std::string& kind, Spec& spec) {
  const Section geometry = shape.section(kind);
  if (kind == "sphere") spec.geometry = SphereSpec{geometry.get(number_value, "radius")};
  if (kind == "box") spec.geometry = BoxSpec{geometry.get(vector_value, "size")};
  if (kind == "capsule") {
    spec.geometry = CapsuleSpec{geometry.get(number_value, "radius"), geometry.get(number_value, "length")};
  }
  if (kind == "cylinder")
    spec.geometry = CylinderSpec{geometry.get(number_value, "radius"), geometry.get(number_value, "length")};
  if (kind == "cone")
    spec.geometry = ConeSpec{geometry.get(number_value, "radius"), geometry.get(number_value, "length")};
  if (kind == "hull") {
    spec.geometry = HullSpec{geometry.get(points_value, "points")};
    if (std::get<HullSpec>(spec.geometry).points.size() < 4) {
      refuse(geometry.node("points").place,
             "a hull of fewer than 4 points has no volume; give at least 4 points");
    }
  }
}

CompoundSpec read_parts(const Section& shape, const std::string& name, int chapter) {
  CompoundSpec compound;
  for (const YamlPtr& item : shape.node("parts").items) {
    const Section part(*item, "shapes.<name>.parts[]");
    const std::string kind =
        kind_of(part, fmt::format("part {} of shape {}", compound.parts.size(), in_quotes(name)), chapter);
    PartSpec spec;
    spec.where = part.node(kind).mark();
    read_convex(part, kind, spec);
    spec.position = part.get_or(vector_value, "position", spec.position);
    spec.orientation = read_orientation(part);
    compound.parts.push_back(std::move(spec));
  }
  return compound;
}

void read_geometry(const Section& shape, const std::string& kind, const SceneSource& source,
                   ShapeSpec& spec) {
  spec.geometry_where = shape.node(kind).mark();
  if (kind == "mesh")
    spec.geometry = MeshSpec{find_mesh(shape, source), shape.get_or(number_value, "scale", 1.0)};
  else if (kind == "parts")
    spec.geometry = read_parts(shape, spec.name, source.chapter);
  else
    read_convex(shape, kind, spec);
}

void read_mass(const Section& shape, ShapeSpec& spec) {
  const auto refuse_at = [&](const char* key, const char* message) {
    refuse(shape.entry(key).key_place, message);
  };
  if (shape.has("mass") && shape.has("density")) {
    refuse_at("density", "'density' beside 'mass'; keep one of them");
  }
  if (shape.has("inertia") && !shape.has("mass")) {
    refuse_at("inertia", "'inertia' without 'mass'; give the mass too, or remove it");
  }
  if (shape.has("center_of_mass") && !shape.has("inertia")) {
    refuse_at("center_of_mass",
              "'center_of_mass' without 'inertia'; give the inertia about it, or remove it");
  }
  if (shape.has("density")) spec.density = shape.get(number_value, "density");
  if (shape.has("mass")) spec.mass = shape.get(number_value, "mass");
  if (shape.has("inertia")) spec.inertia = shape.get(inertia_value, "inertia");
  if (shape.has("center_of_mass")) spec.center_of_mass = shape.get(vector_value, "center_of_mass");
}

}  // namespace

std::filesystem::path resolved_file(const Section& section, const std::string& key,
                                    const SceneSource& source) {
  const std::filesystem::path file = source.file.parent_path() / section.get(text_value, key);  // or absolute
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) return file;
  refuse(section.node(key).place,
         fmt::format("no file {}; give a path relative to the scene's folder, or absolute",
                     in_quotes(file.string())));
}

std::vector<ShapeSpec> read_shapes(const Section& scene, const SceneSource& source) {
  std::vector<ShapeSpec> shapes;
  for (const YamlNode::Entry& entry : scene.node("shapes").entries) {
    const Section shape(*entry.value, "shapes.<name>");
    ShapeSpec spec;
    spec.name = entry.key;
    spec.where = entry.key_place.mark();
    const std::string kind = kind_of(shape, "shape " + in_quotes(entry.key), source.chapter);
    if (shape.has("scale") && kind != "mesh") {
      refuse(shape.entry("scale").key_place,
             "'scale' is for meshes only; remove it, and write the size you want");
    }
    read_geometry(shape, kind, source, spec);
    read_mass(shape, spec);
    if (shape.has("restitution")) spec.restitution = shape.get(number_value, "restitution");
    if (shape.has("friction")) spec.friction = shape.get(number_value, "friction");
    shapes.push_back(std::move(spec));
  }
  return shapes;
}

}  // namespace fc
