// A scene as plain data: what scenes/*.yaml says, checked once, before anything is built from it.
//
// read_scene refuses everything that contract 1.4 refuses, with file, line and column. Presence matters: an
// effect is on when, and only when, its key is present, so optional keys are std::optional or carry the mark
// of their line.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/errors.hpp"
#include "common/types.hpp"

namespace fc {

struct SphereSpec {
  double radius = 0;  // m
};
struct BoxSpec {
  Vec3 size = Vec3::Zero();  // m, full edge lengths
};
struct CapsuleSpec {
  double radius = 0;  // m
  double length = 0;  // m, along local z, without the caps
};
struct CylinderSpec {
  double radius = 0;  // m
  double length = 0;  // m, along local z, its middle at the shape's origin
};
struct ConeSpec {
  double radius = 0;  // m, of its base
  double length = 0;  // m, along local z: from the base at -length/2 to the apex at length/2
};
struct HullSpec {
  std::vector<Vec3> points;  // m
};
struct MeshSpec {
  std::filesystem::path file;  // resolved: it exists
  double scale = 1;
};

// One part of a compound: a convex shape, placed in the compound's frame.
struct PartSpec {
  std::variant<SphereSpec, BoxSpec, CapsuleSpec, CylinderSpec, ConeSpec, HullSpec> geometry;
  Vec3 position = Vec3::Zero();         // m, of the part's own frame
  Quat orientation = Quat::Identity();  // normalised
  SourceMark where;                     // the value of its sphere/box/... key
};
struct CompoundSpec {
  std::vector<PartSpec> parts;
};

struct ShapeSpec {
  std::string name;
  std::variant<SphereSpec, BoxSpec, CapsuleSpec, CylinderSpec, ConeSpec, HullSpec, MeshSpec, CompoundSpec>
      geometry;
  std::optional<double> density;       // kg/m^3; never together with mass
  std::optional<double> mass;          // kg
  std::optional<Mat3> inertia;         // kg m^2 about the centre of mass, shape axes; needs mass
  std::optional<Vec3> center_of_mass;  // m, shape frame; only with inertia
  std::optional<double> restitution;   // [0, 1], overrides the scene's
  std::optional<double> friction;      // Coulomb's, >= 0, overrides the scene's
  SourceMark where;                    // the shape's name
  SourceMark geometry_where;           // the value of its sphere/box/.../mesh/parts key
};

// A row of a path: a pose at a time.
struct PathRow {
  double time = 0;                      // s
  Vec3 position = Vec3::Zero();         // m, of the shape's own frame
  Quat orientation = Quat::Identity();  // normalised
};

struct BodySpec {
  std::string name;  // empty: none
  int shape = 0;     // index into Scene::shapes
  bool is_static = false;
  bool is_kinematic = false;       // moves with its velocity and spin, whatever it hits
  bool is_sensor = false;          // reports contacts, resolves none
  Vec3 free_moves = Vec3::Ones();  // 1 or 0: whether it can move along each of the world's axes,
  Vec3 free_turns = Vec3::Ones();  // and turn about each of its own
  std::vector<PathRow> path;       // kinematic: where it is when, ascending; empty: no path
  std::optional<std::filesystem::path> path_file;  // that these rows come from; resolved: it exists
  Vec3 position = Vec3::Zero();                    // m, of the shape's own frame
  Quat orientation = Quat::Identity();             // normalised
  Vec3 velocity = Vec3::Zero();                    // m/s, of the centre of mass
  Vec3 spin = Vec3::Zero();                        // rad/s, world axes
  SourceMark where;                                // the list item it came from
};

// What two shapes do to each other, instead of the rules for pairs.
struct PairSpec {
  int shape_a = 0, shape_b = 0;       // indices into Scene::shapes, ascending; may be equal
  std::optional<double> restitution;  // [0, 1]
  std::optional<double> friction;     // Coulomb's, >= 0
  SourceMark where;
};

struct StepSpec {
  double dt = 0;        // s
  double duration = 0;  // s
  int frames = 0;       // round(duration / dt)
};

struct DragSpec {
  double linear = 0, angular = 0;  // 1/s
};

struct SleepSpec {
  double after = 0.25;  // s
  double speed = 0.01;  // m/s
};

struct CcdSpec {
  double tolerance = 1e-6;             // m
  std::string bound = "second_order";  // the motion bound (chapter 1)
  int max_iterations = 1'000'000;      // per query; then `unresolved`
  bool warm_start = true;              // of GJK within a query (chapter 1)
};

struct SolverSpec {
  std::string method = "dantzig";
  int limit = 0;         // pivots, sweeps or steps; 0: the method's own
  double tolerance = 0;  // the residual that ends an iterative method; 0: the method's own
  bool compare = false;  // every other method too (chapter 3)
};

// A contact written by hand (chapter 3).
struct ContactSpec {
  int body_a = 0, body_b = 0;
  Vec3 point = Vec3::Zero();   // m, world
  Vec3 normal = Vec3::Zero();  // unit, from A to B
  SourceMark where;
};

// A linear complementarity problem given directly (chapter 3): files, or numbers in the scene.
struct LcpSpec {
  std::optional<std::filesystem::path> matrix_file, vector_file, solution_file;  // resolved: they exist
  std::optional<MatX> matrix;                                                    // n by n
  std::optional<VecX> vector;                                                    // n
  SourceMark where;
};

struct Scene {
  std::filesystem::path file;
  std::string name;
  std::optional<StepSpec> step;
  std::optional<Vec3> gravity;        // m/s^2
  std::optional<double> restitution;  // [0, 1]
  std::optional<double> friction;     // Coulomb's, >= 0
  bool gyroscopic = false;
  std::optional<DragSpec> drag;
  std::optional<SleepSpec> sleep;
  std::optional<double> envelope;  // m; 0: from the shapes' sizes
  CcdSpec ccd;
  SolverSpec solver;
  std::vector<ShapeSpec> shapes;                         // in file order
  std::vector<PairSpec> pairs;                           // in file order, no two shapes twice
  std::vector<BodySpec> bodies;                          // grids expanded, numbered from 0
  double interval = 1;                                   // s (chapters 1, 2)
  std::optional<std::filesystem::path> motions, linear;  // resolved: they exist
  std::vector<ContactSpec> contacts;
  std::optional<LcpSpec> lcp;
  std::map<std::string, SourceMark>
      key_marks;  // every key present, by its dotted path ("ccd.tolerance"), for --explain

  // A body in a message: "3", or "3 ('door')".
  std::string body_text(int body) const;

  // The mark of a key, or nothing if the scene does not have it.
  std::optional<SourceMark> mark(const std::string& path) const {
    const auto it = key_marks.find(path);
    return it == key_marks.end() ? std::nullopt : std::optional(it->second);
  }
};

// A change of one value while a scene runs: as --set; or, without a value, the key is taken away, if the scene has it.
struct SceneEdit {
  std::string key;  // "ccd.tolerance"
  std::optional<std::string> value;
};

struct SceneSource {
  std::filesystem::path file;
  std::vector<std::string> overrides;            // --set: "key.path=value", applied in order
  std::vector<std::filesystem::path> mesh_path;  // --mesh-path, in order
  int chapter = 0;                               // refuses keys of later chapters, requires this one's
  std::string swept = {};                        // --sweep: one more override, applied last
  std::vector<SceneEdit> edits = {};             // of a live scene, applied after all others
};

// Reads and checks a scene. Throws InputError.
Scene read_scene(const SceneSource& source);
// The same for a text that stands for the file's content: relative paths begin at the file's folder, and messages name the file.
Scene read_scene_text(const std::string& text, const SceneSource& source);

}  // namespace fc
