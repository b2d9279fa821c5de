// Recorded motion: bodies, contacts and curves over time, as motion.glb and motion.html (contract 1.5; the
// format is described in common/MOTION.md).
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/shape.hpp"

namespace fc {

// Filled during a run, written at its end. Times are in s and never decrease; a time that is not later than
// the body's last key, as a float, adds no key. Throws std::invalid_argument for numbers that are not finite
// and for bodies that it does not know.
class MotionRecording {
 public:
  // frame_dt: s between two frames.
  MotionRecording(std::string title, std::string chapter, double frame_dt);

  // The scene: shapes first, then the bodies in the scene's order. A shape is drawn about its centre of mass.
  void add_shape(const Shape& shape);
  void add_body(int shape, const RigidBody& body);
  // One of the convex hulls around a part of a shape, to be drawn at a level of its hierarchy (0: the whole).
  void add_hull(int shape, int level, const TriangleMesh& hull);

  // The state of all bodies at a frame's time, in the order of the bodies. Each body turns with its `spin`
  // from now on: between keys that are a quarter turn or more apart, further keys are added.
  void frame(double t, const std::vector<RigidBody>& bodies);
  // The state of one body just after an impact: its path has a kink there.
  void key(int body, double t, const RigidBody& state);
  // A contact at a point (m, world) with its unit normal; `size` is its impulse in N s. Shown as an arrow:
  // for some frames after an impact; for one frame if it `rests`, since the next frame reports it again.
  void contact(double t, const Vec3& point, const Vec3& normal, double size, bool rests = false);
  // A value of the curve at the last frame's time; curves of one group share their axes. The first frame
  // decides which curves there are.
  void value(const std::string& group, const std::string& name, const std::string& unit, double value);

  // An account of one frame, as JSON (algorithm.hpp).
  void algorithm(std::string account) { accounts_.push_back(std::move(account)); }

  // Writes both files. Returns a remark for the summary: what was left out, if anything.
  std::string write(const std::filesystem::path& folder);
  // The bytes of motion.glb. Without a frame: shapes and bodies where they were added, and no animation.
  std::string glb() const;

 private:
  struct Key {
    float t;
    std::array<float, 7> pose;  // x, y, z in m; quaternion x, y, z, w
    bool frame;
  };
  struct Body {
    int shape;
    bool moves;
    RigidBody last;  // the latest state, at `time` (s)
    double time = 0;
    std::vector<Key> keys;
  };
  struct Contact {
    double t;
    Vec3 point, normal;
    double size;
    bool rests;
  };
  struct Series {
    std::string group, name, unit;
    std::vector<float> values;
  };
  struct Hull {
    int shape, level;
    TriangleMesh mesh;
  };
  friend class MotionFile;

  void add_key(Body& body, double t, const RigidBody& state, bool frame);
  void push(Body& body, double t, const Vec3& position, const Quat& orientation, bool frame);
  void thin_out();

  std::string title_, chapter_;
  double frame_dt_;
  std::vector<Shape> shapes_;
  std::vector<Body> bodies_;
  std::vector<Contact> contacts_;
  std::vector<Series> series_;
  std::vector<Hull> hulls_;
  std::vector<std::string> accounts_;
  std::vector<double> frame_times_;  // of the frames that are kept
  std::size_t keys_ = 0;
  long frames_ = 0;   // seen so far
  long stride_ = 1;   // one of this many frames is kept
  bool kept_ = true;  // whether the last frame was
};

}  // namespace fc
