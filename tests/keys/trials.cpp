#include "trials.hpp"

#include <map>

namespace fc_test {
namespace {

const std::string two_shapes =
    "shapes:\n"
    "  a: {box: {size: [1, 0.8, 0.6]}, mass: 2}\n"
    "  b: {sphere: {radius: 0.5}, mass: 1}\n"
    "  c: {box: {size: [0.9, 0.9, 0.9]}, mass: 1}\n";
const std::string a_spins = "bodies:\n  - {shape: a, spin: [0.2, 0.3, 1]}\n";

// A box that falls flat on the floor: four contacts, three of which would do.
const std::string lands =
    "step: {dt: 0.01, duration: 0.5}\ngravity: [0, 0, -10]\n"
    "shapes:\n  floor: {box: {size: [9, 9, 1]}}\n  box: {box: {size: [1, 1, 1]}, mass: 1}\n"
    "bodies:\n  - {shape: floor, static: true}\n  - {shape: box, position: [0.3, 0, 1.2], velocity: [1, 0, 0]}\n";
// One that lies on it, for long enough to fall asleep.
const std::string lies =
    "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -10]\n"
    "shapes:\n  floor: {box: {size: [9, 9, 1]}}\n  ball: {sphere: {radius: 0.5}, mass: 1}\n"
    "bodies:\n  - {shape: floor, static: true}\n  - {shape: ball, position: [0, 0, 1.0], velocity: [0.005, 0, 0]}\n";

// One that slides.
const std::string slides =
    "step: {dt: 0.01, duration: 0.5}\ngravity: [0, 0, -10]\n"
    "shapes:\n  floor: {box: {size: [9, 9, 1]}, friction: 0.5}\n  box: {box: {size: [1, 1, 0.4]}, mass: 1, friction: 0.5}\n"
    "bodies:\n  - {shape: floor, static: true}\n  - {shape: box, position: [0, 0, 0.701], velocity: [2, 0, 0]}\n";

const std::string motions_header =
    "a_px,a_py,a_pz,a_qw,a_qx,a_qy,a_qz,a_vx,a_vy,a_vz,a_wx,a_wy,a_wz,"
    "b_px,b_py,b_pz,b_qw,b_qx,b_qy,b_qz,b_vx,b_vy,b_vz,b_wx,b_wy,b_wz\n";
const std::string linear_header =
    "kind,p0_x0,p0_y0,p0_z0,p1_x0,p1_y0,p1_z0,p2_x0,p2_y0,p2_z0,p3_x0,p3_y0,p3_z0,"
    "p0_x1,p0_y1,p0_z1,p1_x1,p1_y1,p1_z1,p2_x1,p2_y1,p2_z1,p3_x1,p3_y1,p3_z1\n";

std::vector<std::string> shape_b(const std::string& shape) {
  return {"shapes.b={" + shape + ", mass: 1}"};
}

// Those that are the same in all chapters that know the key.
std::map<std::string, Trial> common_trials() {
  const std::string tetrahedron = "[[0,0,-1],[1,0,0.5],[-1,0.5,0.5],[-1,-0.5,0.5]]";
  const std::string flatter = "[[0,0,-1],[0.5,0,0.5],[-1,0.5,0.5],[-1,-0.5,0.5]]";
  const auto capsule = shape_b("capsule: {radius: 0.3, length: 0.5}");
  const auto cylinder = shape_b("cylinder: {radius: 0.3, length: 0.5}");
  const auto cone = shape_b("cone: {radius: 0.3, length: 0.5}");
  const std::string lcp = "lcp: {A: [[2, 1], [1, 2]], b: [-1, -1]}\n";
  const std::string files = "lcp: {matrix: A.mtx, vector: b.mtx}\n";
  const auto two_parts = [](const char* height) {
    return "[{box: {size: [0.6, 0.5, 0.4]}}, {sphere: {radius: 0.3}, position: [0, 0, " +
           std::string(height) + "]}]";
  };
  const std::vector<std::string> three = {
      "bodies=[{shape: a}, {shape: b, position: [1, 0.2, 0.1], velocity: [-4, 0, 0]}, {shape: c, position: [0.2, 0.4, 0]}]"};
  const std::vector<std::string> compound = {"shapes.b={parts: " + two_parts("0.4") + ", mass: 1}"};
  const std::vector<std::string> turned = {
      "shapes.b={parts: [{box: {size: [0.6, 0.5, 0.4]}, rotation: "
      "{axis: [0, 0, 1], degrees: 30}}, {sphere: {radius: 0.3}}], mass: 1}"};
  return {
      {"name", {"name", "one", "two"}},
      {"step", {"step", "{dt: 0.01, duration: 1}", "{dt: 0.01, duration: 0.5}"}},
      {"step.dt", {"step.dt", "0.01", "0.02"}},
      {"step.duration", {"step.duration", "1", "0.5"}},
      {"gravity", {"gravity", "[0, 0, -1]", "[0, 0, -2]"}},
      {"gyroscopic", {"gyroscopic", "", "true"}},
      {"drag", {"drag", "{linear: 0.1}", "{linear: 0.2}"}},
      {"drag.linear", {"drag.linear", "0.1", "0.2"}},
      {"drag.angular", {"drag.angular", "0.1", "0.2"}},
      {"sleep", {"sleep", "", "{after: 0.1}", {}, lies}},
      {"sleep.after", {"sleep.after", "0.1", "0.3", {}, lies}},
      {"sleep.speed", {"sleep.speed", "0.01", "0.001", {"sleep.after=0.1"}, lies}},
      {"friction", {"friction", "0.2", "0.4", {}, lands}},
      {"shapes.<name>.friction", {"shapes.box.friction", "0.2", "0.4", {}, slides}},
      {"pairs[].friction",
       {"pairs",
        "[{a: floor, b: box, restitution: 0, friction: 0.1}]",
        "[{a: floor, b: box, restitution: 0, friction: 0.2}]",
        {},
        slides}},
      {"envelope", {"envelope", "1e-3", "2e-3", {}, lands}},
      {"restitution", {"restitution", "0.2", "0.8"}},
      {"ccd", {"ccd", "{tolerance: 1e-3}", "{tolerance: 1e-6}"}},
      {"ccd.tolerance", {"ccd.tolerance", "1e-3", "1e-6"}},
      {"ccd.bound", {"ccd.bound", "naive", "second_order"}},
      {"ccd.max_iterations", {"ccd.max_iterations", "1", "1000"}},
      {"ccd.warm_start", {"ccd.warm_start", "false", "true"}},
      {"solver", {"solver", "{method: dantzig}", "{method: pgs}", {}, lands}},
      {"solver.method", {"solver.method", "dantzig", "interior_point", {}, lands}},
      {"solver.limit", {"solver.limit", "1", "1000", {}, lands}},
      {"solver.tolerance", {"solver.tolerance", "1e-30", "1e-10", {}, lands}},
      {"solver.compare", {"solver.compare", "", "true"}},
      {"shapes",
       {"shapes", "{a: {box: {size: [1, 1, 1]}, mass: 2}, b: {sphere: {radius: 0.5}, mass: 1}}",
        "{a: {box: {size: [1, 1, 1]}, mass: 2}, b: {sphere: {radius: 0.4}, mass: 1}}"}},
      {"shapes.<name>.sphere", {"shapes.b.sphere", "{radius: 0.5}", "{radius: 0.4}"}},
      {"shapes.<name>.sphere.radius", {"shapes.b.sphere.radius", "0.5", "0.4"}},
      {"shapes.<name>.box", {"shapes.a.box", "{size: [1, 1, 1]}", "{size: [1, 1, 2]}"}},
      {"shapes.<name>.box.size", {"shapes.a.box.size", "[1, 1, 1]", "[1, 2, 1]"}},
      {"shapes.<name>.capsule",
       {"shapes.b.capsule", "{radius: 0.3, length: 0.5}", "{radius: 0.3, length: 0.6}", capsule}},
      {"shapes.<name>.capsule.radius", {"shapes.b.capsule.radius", "0.3", "0.2", capsule}},
      {"shapes.<name>.capsule.length", {"shapes.b.capsule.length", "0.5", "0.6", capsule}},
      {"shapes.<name>.cylinder",
       {"shapes.b.cylinder", "{radius: 0.3, length: 0.5}", "{radius: 0.3, length: 0.6}", cylinder}},
      {"shapes.<name>.cylinder.radius", {"shapes.b.cylinder.radius", "0.3", "0.2", cylinder}},
      {"shapes.<name>.cylinder.length", {"shapes.b.cylinder.length", "0.5", "0.6", cylinder}},
      {"shapes.<name>.cone",
       {"shapes.b.cone", "{radius: 0.3, length: 0.5}", "{radius: 0.3, length: 0.6}", cone}},
      {"shapes.<name>.cone.radius", {"shapes.b.cone.radius", "0.3", "0.2", cone}},
      {"shapes.<name>.cone.length", {"shapes.b.cone.length", "0.5", "0.6", cone}},
      {"shapes.<name>.hull",
       {"shapes.b.hull", "{points: " + tetrahedron + "}", "{points: " + flatter + "}",
        shape_b("hull: {points: " + tetrahedron + "}")}},
      {"shapes.<name>.hull.points",
       {"shapes.b.hull.points", tetrahedron, flatter, shape_b("hull: {points: " + tetrahedron + "}")}},
      {"shapes.<name>.mesh", {"shapes.b.mesh", "one.obj", "two.obj", shape_b("mesh: one.obj")}},
      {"shapes.<name>.scale", {"shapes.b.scale", "1", "0.5", shape_b("mesh: one.obj")}},
      {"shapes.<name>.density",
       {"shapes.b.density", "1", "2", {"shapes.b={sphere: {radius: 0.5}, density: 1}"}}},
      {"shapes.<name>.mass", {"shapes.b.mass", "1", "2"}},
      {"shapes.<name>.inertia", {"shapes.a.inertia", "[0.1, 0.1, 0.1]", "[0.1, 0.1, 0.15]"}},
      {"shapes.<name>.center_of_mass",
       {"shapes.a.center_of_mass", "[0, 0, 0]", "[0, 0.1, 0.1]", {"shapes.a.inertia=[0.1, 0.1, 0.1]"}}},
      {"shapes.<name>.restitution", {"shapes.b.restitution", "0.2", "0.8"}},
      {"pairs", {"pairs", "[{a: a, b: b, restitution: 0.1}]", "[{a: a, b: b, restitution: 0.9}]"}},
      {"pairs[].a", {"pairs.0.a", "a", "c", {"pairs=[{a: a, b: b, restitution: 0.9}]"}}},
      {"pairs[].b", {"pairs.0.b", "b", "c", {"pairs=[{a: a, b: b, restitution: 0.9}]"}}},
      {"pairs[].restitution",
       {"pairs.0.restitution", "0.1", "0.9", {"pairs=[{a: a, b: b, restitution: 0.9}]"}}},
      {"shapes.<name>.parts", {"shapes.b.parts", two_parts("0.4"), two_parts("0.5"), compound}},
      {"shapes.<name>.parts[].position",
       {"shapes.b.parts.1.position", "[0, 0, 0.4]", "[0, 0, 0.5]", compound}},
      {"shapes.<name>.parts[].orientation",
       {"shapes.b.parts.0.orientation", "[1, 0, 0, 0]", "[1, 0, 0, 0.3]", compound}},
      {"shapes.<name>.parts[].rotation",
       {"shapes.b.parts.0.rotation", "{axis: [0, 0, 1], degrees: 30}", "{axis: [0, 0, 1], degrees: 40}",
        compound}},
      {"shapes.<name>.parts[].rotation.axis",
       {"shapes.b.parts.0.rotation.axis", "[0, 0, 1]", "[0, 1, 1]", turned}},
      {"shapes.<name>.parts[].rotation.degrees", {"shapes.b.parts.0.rotation.degrees", "30", "40", turned}},
      {"bodies[].fixed", {"bodies.0.fixed", "[y]", "[x, y]"}},
      {"bodies[].path",
       {"bodies.0.path", "one_path.csv", "two_path.csv", {"bodies.0={shape: a, kinematic: true}"}}},
      {"bodies[].name", {"bodies.0.name", "door", "wall"}},
      {"bodies[].rotation",
       {"bodies.0.rotation", "{axis: [0, 0, 1], degrees: 30}", "{axis: [0, 0, 1], degrees: 40}"}},
      {"bodies[].rotation.axis",
       {"bodies.0.rotation.axis",
        "[0, 0, 1]",
        "[0, 1, 1]",
        {"bodies.0.rotation={axis: [0, 0, 1], degrees: 30}"}}},
      {"bodies[].rotation.degrees",
       {"bodies.0.rotation.degrees", "30", "40", {"bodies.0.rotation={axis: [0, 0, 1], degrees: 30}"}}},
      {"bodies[].shape", {"bodies.1.shape", "b", "c"}},
      {"bodies[].static", {"bodies.0.static", "", "true", {"bodies.0={shape: a}"}}},
      {"bodies[].kinematic", {"bodies.0.kinematic", "", "true"}},
      {"bodies[].sensor", {"bodies.0.sensor", "", "true"}},
      {"bodies[].position", {"bodies.0.position", "[0, 0, 0]", "[0, 0, 0.1]"}},
      {"bodies[].orientation", {"bodies.0.orientation", "[1, 0, 0, 0]", "[1, 0, 0, 0.3]"}},
      {"bodies[].velocity", {"bodies.0.velocity", "[0, 0, 0]", "[-0.1, 0, 0]"}},
      {"bodies[].spin", {"bodies.0.spin", "[0, 0, 0]", "[0, 0, 0.1]"}},
      {"interval", {"interval", "1", "0.2"}},
      {"motions", {"motions", "one.csv", "two.csv", {"bodies=[{shape: a}, {shape: b}]"}}},
      {"linear", {"linear", "one_linear.csv", "two_linear.csv", {}, "name: linear\n"}},
      {"contacts",
       {"contacts", "[{a: 0, b: 1, point: [0.5, 0.3, 0.05], normal: [1, 0, 0]}]",
        "[{a: 0, b: 1, point: [0.5, 0.25, 0.1], normal: [1, 0, 0]}]"}},
      {"contacts[].a", {"contacts.0.a", "0", "2", three}},
      {"contacts[].b", {"contacts.0.b", "1", "2", three}},
      {"contacts[].point", {"contacts.0.point", "[0.5, 0.2, 0.05]", "[0.5, 0.3, 0.05]"}},
      {"contacts[].normal", {"contacts.0.normal", "[1, 0, 0]", "[1, 0.1, 0]"}},
      {"lcp", {"lcp", "{A: [[2, 1], [1, 2]], b: [-1, -1]}", "{A: [[2, 1], [1, 2]], b: [-1, -2]}", {}, lcp}},
      {"lcp.matrix", {"lcp.matrix", "A.mtx", "B.mtx", {}, files}},
      {"lcp.vector", {"lcp.vector", "b.mtx", "c.mtx", {}, files}},
      {"lcp.solution", {"lcp.solution", "b.mtx", "c.mtx", {}, files}},
      {"lcp.A", {"lcp.A", "[[2, 1], [1, 2]]", "[[3, 1], [1, 2]]", {}, lcp}},
      {"lcp.b", {"lcp.b", "[-1, -1]", "[-1, -2]", {}, lcp}},
  };
}

}  // namespace

std::string scene_of(int chapter) {
  std::string b = "  - {shape: b, position: [3, 0.2, 0.1], velocity: [-4, 0, 0]}\n", rest;
  if (chapter == 3) {
    b = "  - {shape: b, position: [1, 0.2, 0.1], velocity: [-4, 0, 0]}\n";
    rest = "contacts:\n  - {a: 0, b: 1, point: [0.5, 0.3, 0.05], normal: [1, 0, 0]}\n";
  }
  if (chapter >= 4) rest = "step: {dt: 0.05, duration: 1}\n";
  return two_shapes + a_spins + b + rest;
}

std::optional<Trial> trial_of(const std::string& path, int chapter) {
  static const std::map<std::string, Trial> trials = common_trials();
  const std::string part = "shapes.<name>.parts[].";
  if (path.starts_with(part) && !trials.contains(path)) {  // a kind of a compound's part: as of a shape
    const std::string kind = path.substr(part.size());
    const auto it = trials.find("shapes.<name>." + kind);
    if (it == trials.end()) return std::nullopt;
    Trial trial = it->second;
    const std::string first = "{" + kind.substr(0, kind.find('.')) + ": ";
    const std::string whole = trials.at("shapes.<name>." + kind.substr(0, kind.find('.'))).value;
    trial.key = "shapes.b.parts.0." + kind;
    trial.sets = {"shapes.b={parts: [" + first + whole +
                  "}, {sphere: {radius: 0.1}, position: [0, 0, 0.4]}], mass: 1}"};
    return trial;
  }
  if (path.starts_with("solver") && chapter == 3)  // the floor's four corners
    if (const auto it = trials.find(path); it != trials.end()) {
      Trial trial = it->second;
      trial.scene =
          "lcp: {A: [[4, 1, -2, 1], [1, 4, 1, -2], [-2, 1, 4, 1], [1, -2, 1, 4]], b: [-1, -2, -1, -1]}\n";
      return trial;
    }
  if (path.starts_with("solver") && chapter >= 5) {
    Trial trial = trials.at(path);
    trial.sets.emplace_back("envelope=1e-3");
    return trial;
  }
  const std::string b = chapter == 3 ? "{shape: b, position: [1, 0.2, 0.1], velocity: [-4, 0, 0]}"
                                     : "{shape: b, position: [3, 0.2, 0.1], velocity: [-4, 0, 0]}";
  if (path == "bodies") return Trial{"bodies", "[{shape: a}, " + b + "]", "[{shape: c}, " + b + "]"};
  if (path.starts_with("bodies[].grid")) {  // two bodies of one entry, side by side, that spin at each other
    const std::vector<std::string> sets = {
        "bodies=[{shape: a, spin: [0, 0, 1], grid: {count: [1, 2, 1], spacing: [1.1, 1.1, 1.1]}}]"};
    if (path == "bodies[].grid")
      return Trial{"bodies.0.grid", "{count: [1, 2, 1], spacing: [1, 1.1, 1]}",
                   "{count: [1, 2, 1], spacing: [1, 1.2, 1]}", sets};
    if (path == "bodies[].grid.count") return Trial{"bodies.0.grid.count", "[2, 1, 1]", "[1, 2, 1]", sets};
    return Trial{"bodies.0.grid.spacing", "[1, 1.1, 1]", "[1, 1.2, 1]", sets};
  }
  const auto it = trials.find(path);
  return it == trials.end() ? std::nullopt : std::optional(it->second);
}

std::vector<std::pair<std::string, std::string>> files() {
  const auto tetrahedron = [](const char* size) {
    const std::string s = size;
    return "v 0 0 0\nv " + s + " 0 0\nv 0 " + s + " 0\nv 0 0 " + s + "\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  };
  const std::string row = "0,0,0,1,0,0,0,0,0,0,0,0,1,3,0.2,0,1,0,0,0,-";
  const auto flight = [](const char* height) {
    return "vf,0.2,0.2," + std::string(height) + ",0,0,0,1,0,0,0,1,0,0.2,0.2,-1,0,0,0,1,0,0,0,1,0\n";
  };
  const std::string array = "%%MatrixMarket matrix array real general\n";
  return {{"one.obj", tetrahedron("1")},
          {"two.obj", tetrahedron("0.8")},
          {"one.csv", motions_header + row + "4,0,0,0,0,0\n"},
          {"two.csv", motions_header + row + "5,0,0,0,0,0\n"},
          {"one_linear.csv", linear_header + flight("1")},
          {"two_linear.csv", linear_header + flight("2")},
          {"one_path.csv", "t,px,py,pz,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,0.1,0,0,1,0,0,0\n"},
          {"two_path.csv", "t,px,py,pz,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n1,0,0.2,0,1,0,0,0\n"},
          {"A.mtx", array + "2 2\n2\n1\n1\n2\n"},
          {"B.mtx", array + "2 2\n3\n1\n1\n2\n"},
          {"b.mtx", array + "2 1\n-1\n-1\n"},
          {"c.mtx", array + "2 1\n-1\n-2\n"}};
}

}  // namespace fc_test
