#include "common/scene_keys.hpp"

#include <algorithm>
#include <unordered_map>

namespace fc {
namespace {

// Limits far beyond any sensible scene, and far enough from overflow that products of a few of them stay
// finite.
constexpr Range any{-1e9, 1e9};
constexpr Range size{1e-9, 1e9};
constexpr Range positive{1e-18, 1e18};
constexpr Range fraction{0, 1};
constexpr Range coefficient{0, 1e6};

// clang-format off
std::vector<SceneKey> build_table() {
  using enum KeyType;
  constexpr int on = all_later_chapters;
  const std::string required = "required", none = "none";
  const std::string one_kind = "required: exactly one kind";
  const std::string bodies_needed = "required, except with lcp or linear";
  return {
  // path, first, last, default, type, unit, range, meaning, example, choices, except, idle beside
  {"name", 1, on, "the file's name", text, "", {}, "Names the scene in summaries and in the output folder.", "two-bodies", {}},
  {"step", 4, on, required, section, "", {}, "Turns the scene into a simulation of round(duration / dt) frames.", "{dt: 0.01, duration: 4}", {}},
  {"step.dt", 4, on, required, number, "s", {1e-9, 1e3}, "Length of a frame.", "0.01", {}},
  {"step.duration", 4, on, required, number, "s", {1e-9, 1e9}, "Simulated time.", "4", {}},
  {"gravity", 4, on, none, vector3, "m/s^2", any, "Acceleration of every body that moves; absent, none is computed.", "[0, 0, -9.81]", {}},
  {"gyroscopic", 4, on, none, boolean, "", {}, "Free bodies turn by Euler's equations, in closed form; absent, their spin is constant. Only true.", "true", {}},
  {"drag", 4, on, none, section, "", {}, "Bodies that move freely lose momentum to the air, in closed form.", "{linear: 0.1, angular: 0.1}", {}},
  {"drag.linear", 4, on, "0", number, "1/s", {0, 1e6}, "Rate at which velocities decay: dv/dt = gravity - linear v.", "0.1", {}},
  {"drag.angular", 4, on, "0", number, "1/s", {0, 1e6}, "Rate at which spins (with gyroscopic: angular momenta) decay.", "0.1", {}},
  {"sleep", 4, on, none, section, "", {}, "Bodies that have been slow, and held in place (lost_time; with an envelope: in contact), for long enough fall asleep until something hits them.", "{after: 0.25, speed: 0.01}", {}},
  {"sleep.after", 4, on, "0.25", number, "s", {0, 1e9, true}, "For how long a body must have been held, or supported, without a break.", "0.25", {}},
  {"sleep.speed", 4, on, "0.01", number, "m/s", {0, 1e9}, "A body falls asleep only if none of its points is faster.", "0.01", {}},
  {"envelope", 5, on, none, number, "m", {0, 1e3}, "Bodies nearer than this are in contact, and rest at half of it; 0: a thousandth of the smallest reach of a shape that moves.", "5.0e-4", {}},
  {"restitution", 3, on, "0", number, "1", fraction, "Part of the approach speed that an impact returns; a pair takes the larger of its shapes' values.", "0.5", {}, 0, "lcp"},
  {"friction", 6, on, none, number, "1", coefficient, "Coulomb's coefficient; a pair takes the geometric mean of its shapes' values. Absent everywhere, no friction is computed.", "0.5", {}},
  {"pairs", 3, on, none, list, "", {}, "What two shapes do to each other, instead of the rules that combine their own values.", "[{a: ice, b: steel, restitution: 0.1}]", {}, 0, "lcp"},
  {"pairs[].a", 3, on, required, text, "", {}, "Name of a shape.", "ice", {}},
  {"pairs[].b", 3, on, required, text, "", {}, "Name of the other shape, or the same.", "steel", {}},
  {"pairs[].restitution", 3, on, "required unless friction", number, "1", fraction, "Restitution between bodies of the two shapes.", "0.1", {}},
  {"pairs[].friction", 6, on, "the rule for two shapes", number, "1", coefficient, "Coulomb's coefficient between bodies of the two shapes.", "0.02", {}},
  {"ccd", 1, on, none, section, "", {}, "Continuous collision detection.", "{tolerance: 1.0e-6}", {}, 3},
  {"ccd.tolerance", 1, on, "1e-6", number, "m", {0, 1e3, true}, "Gap at which two bodies are in contact.", "1.0e-6", {}, 3},
  {"ccd.bound", 1, 1, "second_order", choice, "", {}, "Motion bound, from the plainest to the sharpest; chapter 2 has its own.", "second_order", {"naive", "directional", "projected", "second_order"}, 0, "linear"},
  {"ccd.max_iterations", 1, on, "1000000", integer, "1", {1, 1e9}, "Advances (chapter 1) or pairs of nodes (later) per query before it ends as unresolved.", "10000", {}, 3},
  {"ccd.warm_start", 1, 1, "true", boolean, "", {}, "GJK begins with the simplex of the pose before; false shows what that saves.", "false", {}, 0, "linear"},
  {"solver", 3, on, none, section, "", {}, "The solver of the contact equations.", "{method: dantzig}", {}},
  {"solver.method", 3, on, "dantzig", choice, "", {}, "Algorithm that solves the LCP.", "dantzig", {"dantzig", "lemke", "pgs", "interior_point"}},
  {"solver.limit", 3, on, "the method's own", integer, "1", {1, 1e9}, "Pivots, sweeps or Newton steps after which the method ends as limit.", "1000", {}},
  {"solver.tolerance", 3, on, "1.0e-10", number, "1", {0, 1, true}, "Residual that an answer must have; pgs and interior_point are done when they have it.", "1.0e-12", {}},
  {"solver.compare", 3, 3, "false", boolean, "", {}, "Solve the same LCP by every other method too, for solvers.csv.", "true", {}},

  {"shapes", 1, on, bodies_needed, named, "", {}, "Shapes by name; bodies refer to them.", "{ball: {sphere: {radius: 0.5}, mass: 1}}", {}},
  {"shapes.<name>.sphere", 1, on, one_kind, section, "", {}, "A ball about the shape's origin.", "{radius: 0.5}", {}},
  {"shapes.<name>.sphere.radius", 1, on, required, number, "m", size, "Radius.", "0.5", {}},
  {"shapes.<name>.box", 1, on, one_kind, section, "", {}, "A box about the shape's origin.", "{size: [1, 1, 1]}", {}},
  {"shapes.<name>.box.size", 1, on, required, vector3, "m", size, "Full edge lengths.", "[1, 1, 1]", {}},
  {"shapes.<name>.capsule", 1, on, one_kind, section, "", {}, "A cylinder along local z with half-spheres at its ends.", "{radius: 0.1, length: 1}", {}},
  {"shapes.<name>.capsule.radius", 1, on, required, number, "m", size, "Radius of the cylinder and its caps.", "0.1", {}},
  {"shapes.<name>.capsule.length", 1, on, required, number, "m", size, "Length of the cylinder, without the caps.", "1", {}},
  {"shapes.<name>.cylinder", 1, on, one_kind, section, "", {}, "A cylinder along local z about the shape's origin.", "{radius: 0.1, length: 1}", {}},
  {"shapes.<name>.cylinder.radius", 1, on, required, number, "m", size, "Radius.", "0.1", {}},
  {"shapes.<name>.cylinder.length", 1, on, required, number, "m", size, "Length.", "1", {}},
  {"shapes.<name>.cone", 1, on, one_kind, section, "", {}, "A cone along local z: its base at -length/2, its apex at length/2.", "{radius: 0.1, length: 1}", {}},
  {"shapes.<name>.cone.radius", 1, on, required, number, "m", size, "Radius of its base.", "0.1", {}},
  {"shapes.<name>.cone.length", 1, on, required, number, "m", size, "Height, from the base to the apex.", "1", {}},
  {"shapes.<name>.hull", 1, on, one_kind, section, "", {}, "The convex hull of points.", "{points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}", {}},
  {"shapes.<name>.hull.points", 1, on, required, points, "m", any, "At least four points that span a volume.", "[[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]", {}},
  {"shapes.<name>.mesh", 2, on, one_kind, file, "", {}, "A triangle mesh: OBJ, STL or PLY; looked for beside the scene, then in --mesh-path folders.", "bunny.obj", {}},
  {"shapes.<name>.scale", 2, on, "1", number, "1", size, "Factor on the mesh's coordinates.", "1", {}},
  {"shapes.<name>.parts", 2, on, one_kind, list, "", {}, "A compound: the union of convex parts, each placed in the shape's frame. They may overlap; each part's mass is counted in full.", "[{box: {size: [1, 1, 1]}}, {sphere: {radius: 0.3}, position: [0, 0, 0.6]}]", {}},
  {"shapes.<name>.parts[].position", 2, on, "[0, 0, 0]", vector3, "m", any, "Where the part's own frame is.", "[0, 0, 0.6]", {}},
  {"shapes.<name>.parts[].orientation", 2, on, "[1, 0, 0, 0]", quaternion, "1", any, "Quaternion [w, x, y, z] that turns the part's frame; normalised.", "[1, 0, 0, 0]", {}},
  {"shapes.<name>.parts[].rotation", 2, on, none, section, "", {}, "The turn of the part's frame by an axis and an angle, instead of orientation.", "{axis: [0, 0, 1], degrees: 30}", {}},
  {"shapes.<name>.parts[].rotation.axis", 2, on, required, vector3, "1", any, "Direction to turn about, right-handed; normalised, not zero.", "[0, 0, 1]", {}},
  {"shapes.<name>.parts[].rotation.degrees", 2, on, required, number, "deg", any, "Angle.", "30", {}},
  {"shapes.<name>.density", 1, on, "required to move (chapter 3 on), unless mass", number, "kg/m^3", positive, "Mass per volume; never beside mass.", "1000", {}},
  {"shapes.<name>.mass", 1, on, "required to move (chapter 3 on), unless density", number, "kg", positive, "Mass; never beside density.", "2", {}},
  {"shapes.<name>.inertia", 1, on, "of a uniform solid", inertia, "kg m^2", {-1e18, 1e18}, "Inertia about the centre of mass, along the shape's axes; needs mass.", "[0.1, 0.1, 0.1]", {}},
  {"shapes.<name>.center_of_mass", 1, on, "of a uniform solid", vector3, "m", any, "Centre of mass in the shape's frame; needs inertia.", "[0, 0, 0]", {}},
  {"shapes.<name>.restitution", 3, on, "the scene's", number, "1", fraction, "Overrides the scene's restitution.", "0.5", {}},
  {"shapes.<name>.friction", 6, on, "the scene's", number, "1", coefficient, "Overrides the scene's coefficient of friction.", "0.5", {}},

  {"bodies", 1, on, bodies_needed, list, "", {}, "Bodies, numbered from 0 in file order; exactly two in chapters 1 and 2.", "[{shape: ball}]", {}},
  {"bodies[].shape", 1, on, required, text, "", {}, "Name of the body's shape.", "ball", {}},
  {"bodies[].name", 1, on, none, text, "", {}, "A name for the body in contacts and messages, besides its number; no other body has it.", "door", {}},
  {"bodies[].static", 1, on, "false", boolean, "", {}, "A static body never moves and needs no mass.", "true", {}},
  {"bodies[].kinematic", 4, on, "false", boolean, "", {}, "A kinematic body keeps its velocity and spin, whatever it hits, and needs no mass.", "true", {}},
  {"bodies[].sensor", 4, on, "false", boolean, "", {}, "A sensor reports what touches it (sensors.csv) and pushes nothing.", "true", {}},
  {"bodies[].position", 1, on, "[0, 0, 0]", vector3, "m", any, "Where the shape's own frame is.", "[0, 0, 1]", {}},
  {"bodies[].orientation", 1, on, "[1, 0, 0, 0]", quaternion, "1", any, "Quaternion [w, x, y, z] that turns the shape's frame; normalised.", "[1, 0, 0, 0]", {}},
  {"bodies[].rotation", 1, on, none, section, "", {}, "The turn of the shape's frame by an axis and an angle, instead of orientation.", "{axis: [0, 0, 1], degrees: 30}", {}},
  {"bodies[].rotation.axis", 1, on, required, vector3, "1", any, "Direction to turn about, right-handed; normalised, not zero.", "[0, 0, 1]", {}},
  {"bodies[].rotation.degrees", 1, on, required, number, "deg", any, "Angle.", "30", {}},
  {"bodies[].velocity", 1, on, "[0, 0, 0]", vector3, "m/s", any, "Velocity of the centre of mass.", "[1, 0, 0]", {}},
  {"bodies[].spin", 1, on, "[0, 0, 0]", vector3, "rad/s", any, "Angular velocity in world axes.", "[0, 0, 1]", {}},
  {"bodies[].fixed", 3, on, none, words, "", {}, "Degrees of freedom that the body does not have: moves along the world's axes, turns about its shape's own. All six: it stays where it is.", "[x, z, rx]", {"x", "y", "z", "rx", "ry", "rz"}},
  {"bodies[].path", 4, on, none, file, "", {}, "CSV of poses that a kinematic body goes through, columns t,px,py,pz,qw,qx,qy,qz: straight and with constant spin between rows, at rest before the first and after the last.", "path.csv", {}},
  {"bodies[].grid", 1, on, none, section, "", {}, "Repeats the body on a grid that begins at its position.", "{count: [2, 2, 2], spacing: [1, 1, 1]}", {}},
  {"bodies[].grid.count", 1, on, required, integers3, "1", {1, 1e6}, "Bodies along x, y and z; x counts fastest.", "[10, 10, 10]", {}},
  {"bodies[].grid.spacing", 1, on, required, vector3, "m", any, "Distance of neighbours along x, y and z.", "[1.1, 1.1, 1.1]", {}},

  {"interval", 1, 2, "1", number, "s", {0, 1e6, true}, "Time that a query covers.", "1", {}},
  {"motions", 1, 2, "the bodies' own", file, "", {}, "CSV of queries, one per row: a_px,a_py,a_pz,a_qw,a_qx,a_qy,a_qz,a_vx,a_vy,a_vz,a_wx,a_wy,a_wz (position, orientation, velocity and spin, as in bodies), then the same with b_.", "motions.csv", {}},
  {"linear", 1, 1, none, file, "", {}, "CSV of queries: a vertex and a triangle, or two edges, whose corners fly straight; no bodies then. Columns: kind (vf or ee), p0_x0,p0_y0,p0_z0 to p3_z0 at the start, p0_x1 to p3_z1 at the end.", "linear.csv", {}},

  {"contacts", 3, 3, bodies_needed, list, "", {}, "Contacts of the touching bodies.", "[{a: 0, b: 1, point: [0, 0, 0], normal: [0, 0, 1]}]", {}},
  {"contacts[].a", 3, 3, required, body, "", {0, 1e6}, "Number or name of the first body.", "0", {}},
  {"contacts[].b", 3, 3, required, body, "", {0, 1e6}, "Number or name of the second body.", "1", {}},
  {"contacts[].point", 3, 3, required, vector3, "m", any, "Where they touch, in the world.", "[0, 0, 0.5]", {}},
  {"contacts[].normal", 3, 3, required, vector3, "1", any, "Direction from A to B; normalised, not zero.", "[0, 0, 1]", {}},
  {"lcp", 3, 3, none, section, "", {}, "An LCP w = A z + b given directly: two files, or A and b.", "{A: [[2, 1], [1, 2]], b: [-1, -1]}", {}},
  {"lcp.matrix", 3, 3, "required with vector", file, "", {}, "Matrix Market file of A.", "A.mtx", {}},
  {"lcp.vector", 3, 3, "required with matrix", file, "", {}, "Matrix Market file of b.", "b.mtx", {}},
  {"lcp.solution", 3, 3, none, file, "", {}, "Matrix Market file of a known solution z.", "z.mtx", {}},
  {"lcp.A", 3, 3, "required with b", matrix, "", {-1e300, 1e300}, "The rows of A, as many as columns.", "[[2, 1], [1, 2]]", {}},
  {"lcp.b", 3, 3, "required with A", numbers, "", {-1e300, 1e300}, "As many numbers as A has rows.", "[-1, -1]", {}},
  };
}
// clang-format on

// A part of a compound has the keys of the convex kinds, too.
std::vector<SceneKey> with_parts(std::vector<SceneKey> table) {
  const std::string shape = "shapes.<name>.";
  std::vector<SceneKey> of_parts;
  for (SceneKey key : table)
    for (const std::string kind : {"sphere", "box", "capsule", "cylinder", "cone", "hull"})
      if (key.path == shape + kind || key.path.starts_with(shape + kind + ".")) {
        key.path = shape + "parts[]." + key.path.substr(shape.size());
        key.first = 2;
        of_parts.push_back(key);
      }
  const auto first = std::find_if(table.begin(), table.end(), [&](const SceneKey& key) {
    return key.path == shape + "parts[].position";
  });
  table.insert(first, of_parts.begin(), of_parts.end());
  return table;
}

std::string parent_of(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

}  // namespace

const std::vector<SceneKey>& scene_keys() {
  static const std::vector<SceneKey> table = with_parts(build_table());
  return table;
}

const std::vector<LaterName>& later_names() {
  static const std::vector<LaterName> names = {{"joints", 7, false}};
  return names;
}

const SceneKey* find_scene_key(const std::string& path) {
  static const auto by_path = [] {
    std::unordered_map<std::string, const SceneKey*> map;
    for (const SceneKey& key : scene_keys()) map[key.path] = &key;
    return map;
  }();
  const auto it = by_path.find(path);
  return it == by_path.end() ? nullptr : it->second;
}

std::vector<std::string> scene_keys_below(const std::string& parent, int chapter) {
  std::vector<std::string> names;
  for (const SceneKey& key : scene_keys()) {
    if (parent_of(key.path) == parent && (chapter == 0 || key.known_in(chapter)))
      names.push_back(key.last_name());
  }
  return names;
}

const LaterName* find_later_name(const std::string& name) {
  for (const LaterName& later : later_names()) {
    if (later.name == name) return &later;
  }
  return nullptr;
}

std::string chapter_title(int chapter) {
  static const std::vector<std::string> titles = {
      "convex advancement", "hull hierarchy", "impulse LCP", "multibody stepping",
      "resting contact",    "friction",       "joints"};
  const auto index = static_cast<std::size_t>(chapter - 1);
  return "chapter " + std::to_string(chapter) + (index < titles.size() ? " (" + titles[index] + ")" : "");
}

}  // namespace fc
