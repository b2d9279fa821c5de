// What scene_text() writes, read_scene() reads back: the same scene, to the last bit.
#include "common/scene_writer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <set>

#include "scene_files.hpp"

namespace {

using namespace fc;

// A quaternion of a scene that was made from an axis and an angle may have no digits that give it back.
constexpr double kTurn = 4 * std::numeric_limits<double>::epsilon();

bool same_turn(const Quat& a, const Quat& b) {
  return (a.coeffs() - b.coeffs()).cwiseAbs().maxCoeff() <= kTurn;
}

bool same(const std::optional<std::filesystem::path>& a, const std::optional<std::filesystem::path>& b) {
  return a.has_value() == b.has_value() && (!a || std::filesystem::equivalent(*a, *b));
}
bool same(const SphereSpec& a, const SphereSpec& b) {
  return a.radius == b.radius;
}
bool same(const BoxSpec& a, const BoxSpec& b) {
  return a.size == b.size;
}
template <class Spec>
requires requires(Spec s) {
  s.radius + s.length;
}
bool same(const Spec& a, const Spec& b) {
  return a.radius == b.radius && a.length == b.length;
}
bool same(const HullSpec& a, const HullSpec& b) {
  return a.points == b.points;
}
bool same(const MeshSpec& a, const MeshSpec& b) {
  return std::filesystem::equivalent(a.file, b.file) && a.scale == b.scale;
}
bool same(const CompoundSpec& a, const CompoundSpec& b);
template <class... Kinds>
bool same(const std::variant<Kinds...>& a, const std::variant<Kinds...>& b) {
  return a.index() == b.index() && std::visit(
                                       [&](const auto& geometry) {
                                         return same(geometry, std::get<std::decay_t<decltype(geometry)>>(b));
                                       },
                                       a);
}
bool same(const CompoundSpec& a, const CompoundSpec& b) {
  return std::equal(a.parts.begin(), a.parts.end(), b.parts.begin(), b.parts.end(),
                    [](const PartSpec& p, const PartSpec& q) {
                      return same(p.geometry, q.geometry) && p.position == q.position &&
                             same_turn(p.orientation, q.orientation);
                    });
}

void expect_same(const ShapeSpec& a, const ShapeSpec& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_TRUE(same(a.geometry, b.geometry)) << a.name;
  EXPECT_EQ(a.density, b.density);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.inertia, b.inertia);
  EXPECT_EQ(a.center_of_mass, b.center_of_mass);
  EXPECT_EQ(a.restitution, b.restitution);
  EXPECT_EQ(a.friction, b.friction);
}

void expect_same(const BodySpec& a, const BodySpec& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.shape, b.shape);
  EXPECT_EQ(a.is_static, b.is_static);
  EXPECT_EQ(a.is_kinematic, b.is_kinematic);
  EXPECT_EQ(a.is_sensor, b.is_sensor);
  EXPECT_EQ(a.free_moves, b.free_moves);
  EXPECT_EQ(a.free_turns, b.free_turns);
  EXPECT_EQ(a.position, b.position);
  EXPECT_TRUE(same_turn(a.orientation, b.orientation));
  EXPECT_EQ(a.velocity, b.velocity);
  EXPECT_LE((a.spin - b.spin).norm(),
            kTurn * a.spin.norm());  // turned to the body's axes and back, if some are fixed
  EXPECT_TRUE(same(a.path_file, b.path_file));
  ASSERT_EQ(a.path.size(), b.path.size());
  for (std::size_t i = 0; i < a.path.size(); ++i) {
    EXPECT_EQ(a.path[i].time, b.path[i].time);
    EXPECT_EQ(a.path[i].position, b.path[i].position);
    EXPECT_EQ(a.path[i].orientation.coeffs(), b.path[i].orientation.coeffs());
  }
}

void expect_same_rules(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.name, b.name);
  ASSERT_EQ(a.step.has_value(), b.step.has_value());
  if (a.step) {
    EXPECT_EQ(a.step->dt, b.step->dt);
    EXPECT_EQ(a.step->duration, b.step->duration);
    EXPECT_EQ(a.step->frames, b.step->frames);
  }
  EXPECT_EQ(a.gravity, b.gravity);
  EXPECT_EQ(a.restitution, b.restitution);
  EXPECT_EQ(a.friction, b.friction);
  EXPECT_EQ(a.gyroscopic, b.gyroscopic);
  ASSERT_EQ(a.drag.has_value(), b.drag.has_value());
  if (a.drag) {
    EXPECT_TRUE(a.drag->linear == b.drag->linear && a.drag->angular == b.drag->angular);
  }
  ASSERT_EQ(a.sleep.has_value(), b.sleep.has_value());
  if (a.sleep) {
    EXPECT_TRUE(a.sleep->after == b.sleep->after && a.sleep->speed == b.sleep->speed);
  }
  EXPECT_EQ(a.envelope, b.envelope);
  EXPECT_EQ(a.ccd.tolerance, b.ccd.tolerance);
  EXPECT_EQ(a.ccd.bound, b.ccd.bound);
  EXPECT_EQ(a.ccd.max_iterations, b.ccd.max_iterations);
  EXPECT_EQ(a.ccd.warm_start, b.ccd.warm_start);
  EXPECT_EQ(a.solver.method, b.solver.method);
  EXPECT_EQ(a.solver.limit, b.solver.limit);
  EXPECT_EQ(a.solver.tolerance, b.solver.tolerance);
  EXPECT_EQ(a.solver.compare, b.solver.compare);
  EXPECT_EQ(a.interval, b.interval);
  EXPECT_TRUE(same(a.motions, b.motions));
  EXPECT_TRUE(same(a.linear, b.linear));
}

void expect_same_problem(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.contacts.size(), b.contacts.size());
  for (std::size_t i = 0; i < a.contacts.size(); ++i) {
    EXPECT_EQ(a.contacts[i].body_a, b.contacts[i].body_a);
    EXPECT_EQ(a.contacts[i].body_b, b.contacts[i].body_b);
    EXPECT_EQ(a.contacts[i].point, b.contacts[i].point);
    EXPECT_LE((a.contacts[i].normal - b.contacts[i].normal).norm(), kTurn);  // made unit again
  }
  ASSERT_EQ(a.lcp.has_value(), b.lcp.has_value());
  if (!a.lcp) return;
  EXPECT_TRUE(same(a.lcp->matrix_file, b.lcp->matrix_file));
  EXPECT_TRUE(same(a.lcp->vector_file, b.lcp->vector_file));
  EXPECT_TRUE(same(a.lcp->solution_file, b.lcp->solution_file));
  EXPECT_EQ(a.lcp->matrix, b.lcp->matrix);
  EXPECT_EQ(a.lcp->vector, b.lcp->vector);
}

void expect_same(const Scene& a, const Scene& b) {
  expect_same_rules(a, b);
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (std::size_t i = 0; i < a.shapes.size(); ++i) expect_same(a.shapes[i], b.shapes[i]);
  ASSERT_EQ(a.pairs.size(), b.pairs.size());
  for (std::size_t i = 0; i < a.pairs.size(); ++i) {
    EXPECT_EQ(a.pairs[i].shape_a, b.pairs[i].shape_a);
    EXPECT_EQ(a.pairs[i].shape_b, b.pairs[i].shape_b);
    EXPECT_EQ(a.pairs[i].restitution, b.pairs[i].restitution);
    EXPECT_EQ(a.pairs[i].friction, b.pairs[i].friction);
  }
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) expect_same(a.bodies[i], b.bodies[i]);
  expect_same_problem(a, b);
}

// The text is read in another folder, where no relative path leads to a file.
Scene read_back(const Scene& scene, int chapter) {
  return read_scene_text(scene_text(scene),
                         {fc_test::folder() / "elsewhere" / "scene.yaml", {}, {}, chapter});
}

TEST(SceneWriter, EverySceneOfTheChapters) {
  int scenes = 0;
  std::set<std::string> meshless;  // the bunny's mesh is not on every machine
  const std::filesystem::path chapters = std::filesystem::path(FC_SOURCE_DIR) / "chapters";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(chapters)) {
    if (entry.path().extension() != ".yaml") continue;
    const std::string folder = std::filesystem::relative(entry.path(), chapters).begin()->string();
    const int chapter = folder[3] - '0';
    SCOPED_TRACE(entry.path().string());
    try {
      const Scene scene = read_scene({entry.path(), {}, {}, chapter});
      expect_same(scene, read_back(scene, chapter));
      ++scenes;
    } catch (const InputError& error) {
      ASSERT_NE(std::string(error.what()).find("no mesh file"), std::string::npos) << error.what();
      meshless.insert(entry.path().stem());
    }
  }
  EXPECT_GE(scenes + static_cast<int>(meshless.size()), 50);
  EXPECT_LE(meshless.size(), 12u);
}

// Every field that a scene of chapter 6 can have, with values that no default has.
TEST(SceneWriter, EveryField) {
  fc_test::write_file("door.csv", "t,px,py,pz,qw,qx,qy,qz\n0,0,0,5,1,0,0,0\n0.1,0,0,6,0.9,0.1,0,0\n");
  const Scene scene = fc_test::read_text(
      "name: 'a: \"b\" #c'\nstep: {dt: 0.1, duration: 0.30000000000000004}\ngravity: [-0.0, 1e-300, 9.81]\n"
      "gyroscopic: true\ndrag: {linear: 0.1}\nsleep: {}\nenvelope: 0\nrestitution: 0\nfriction: 0.7\n"
      "ccd: {tolerance: 3e-7, max_iterations: 77}\nsolver: {method: pgs, limit: 5, tolerance: 1e-3}\n"
      "shapes:\n  'true': {box: {size: [1, 2, 3]}, mass: 2, inertia: [1, 2, 2.5, 0.1, 0.2, 0.3], center_of_mass: [0.1, 0, 0]}\n"
      "  '5': {cone: {radius: 1, length: 0.1}, density: 0.3, restitution: 0.25, friction: 1}\n"
      "  \"tab\\there\": {parts: [{sphere: {radius: 1}}, {cylinder: {radius: 1, length: 3}, position: [1, 0, 0], "
      "rotation: {axis: [1, 2, 3], degrees: 77}}], density: 1}\n"
      "pairs: [{a: '5', b: 'true', friction: 0.1, restitution: 1}, {a: '5', b: '5', restitution: 0.5}]\n"
      "bodies:\n  - {shape: 'true', name: 'Tür \xF0\x9F\x9A\xAA: {[&*', grid: {count: [1, 1, 1], spacing: [1, 1, 1]}}\n",
      6,
      {"bodies=[{shape: 'true', name: \"T\xC3\xBCr: {[&*\"}, {shape: '5', kinematic: true, path: door.csv}, {shape: '5', "
       "position: [9, 0, 0], fixed: [x, ry], spin: [1, 0, 0]}, {shape: \"tab\\there\", static: true, sensor: true, position: "
       "[50, 0, 0]}]"});
  const Scene back = read_back(scene, 6);
  expect_same(scene, back);
  EXPECT_TRUE(std::signbit(back.gravity->x()));
  EXPECT_EQ(scene_text(back), scene_text(scene));
}

RC_GTEST_PROP(SceneWriter, AnyNamesAndNumbers, ()) {
  Scene scene = fc_test::read_text(fc_test::one_ball, 6);
  const auto name = [] {
    const auto parts = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::string>>(
        rc::gen::element<std::string>("a", "7", ".", "-", ":", ": ", " #", "'", "\"", "\\", "{", "}", "[",
                                      "]", ",", "&", "*", "!", "|", ">", "%", "@", "~", "?", "\n", "\t", "\r",
                                      "\x02", "\x7f", " ", "é", "\xF0\x9F\x9A\xAA", "null", "true", "1e5")));
    std::string text;
    for (const std::string& part : parts) text += part;
    return text;
  };
  const auto number = [] {
    const double mantissa = static_cast<double>(*rc::gen::inRange<std::int64_t>(-(1ll << 53), 1ll << 53));
    return std::ldexp(mantissa, *rc::gen::inRange(-200, -24));
  };
  const auto vector = [&] { return Vec3(number(), number(), number()); };
  scene.name = scene.shapes[0].name = name();
  scene.gravity = vector();
  scene.bodies.clear();
  const auto bodies = *rc::gen::inRange(1, 20);
  for (int i = 0; i < bodies; ++i) {
    BodySpec body;
    body.name = "n" + std::to_string(i) + name();
    body.position = vector();
    body.velocity = vector();
    body.spin = vector();
    body.orientation = Quat(number(), number(), number(), 1 + number()).normalized();
    scene.bodies.push_back(body);
  }
  expect_same(scene, read_back(scene, 6));
}

}  // namespace
