#include "common/scene.hpp"

#include <gtest/gtest.h>

#include "common/scene_keys.hpp"
#include "scene_files.hpp"

namespace {

using fc::Vec3;
using fc_test::one_ball;
using fc_test::read_text;
using fc_test::refusal;
using fc_test::two_balls;

TEST(Scene, ReadsEveryKindOfKey) {
  const fc::Scene scene = read_text(R"(
name: all kinds
step: {dt: 0.016666666666666666, duration: 4.0}
gravity: [0, 0, -9.81]
restitution: 0.5
ccd: {tolerance: 1.0e-5, max_iterations: 77}
shapes:
  ball: {sphere: {radius: 0.5}, density: 1000, restitution: 1}
  block: {box: {size: [1, 2, 3]}, mass: 2.0, inertia: [1, 2, 3, 0.1, 0.2, 0.3], center_of_mass: [0, 0, 0.1]}
  rod: {capsule: {radius: 0.1, length: 1.0}, mass: 1.0}
  rock: {hull: {points: [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}, density: 2500}
bodies:
  - {shape: rock, position: [-2, 0, 1], orientation: [2, 0, 0, 0], velocity: [3, 0, 0], spin: [0, 0, 1]}
  - {shape: block, static: true, velocity: [0, 0, 0]}
)",
                                    4);
  EXPECT_EQ(scene.name, "all kinds");
  EXPECT_EQ(scene.step->frames, 240);
  EXPECT_EQ(*scene.gravity, Vec3(0, 0, -9.81));
  EXPECT_EQ(*scene.restitution, 0.5);
  EXPECT_EQ(scene.ccd.tolerance, 1e-5);
  EXPECT_EQ(scene.ccd.max_iterations, 77);
  EXPECT_EQ(scene.solver.method, "dantzig");
  ASSERT_EQ(scene.shapes.size(), 4u);
  EXPECT_EQ(std::get<fc::SphereSpec>(scene.shapes[0].geometry).radius, 0.5);
  EXPECT_EQ(*scene.shapes[0].density, 1000);
  EXPECT_EQ(*scene.shapes[0].restitution, 1);
  EXPECT_EQ(std::get<fc::BoxSpec>(scene.shapes[1].geometry).size, Vec3(1, 2, 3));
  EXPECT_EQ((*scene.shapes[1].inertia)(0, 1), 0.1);
  EXPECT_EQ((*scene.shapes[1].inertia)(2, 0), 0.2);
  EXPECT_EQ((*scene.shapes[1].inertia)(1, 2), 0.3);
  EXPECT_EQ(scene.shapes[1].center_of_mass->z(), 0.1);
  EXPECT_EQ(std::get<fc::CapsuleSpec>(scene.shapes[2].geometry).length, 1);
  EXPECT_EQ(std::get<fc::HullSpec>(scene.shapes[3].geometry).points.size(), 4u);
  EXPECT_EQ(scene.shapes[3].where.line, 11);
  ASSERT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(scene.bodies[0].shape, 3);
  EXPECT_EQ(scene.bodies[0].orientation.w(), 1);  // normalised
  EXPECT_EQ(scene.bodies[0].spin, Vec3(0, 0, 1));
  EXPECT_TRUE(scene.bodies[1].is_static);
}

TEST(Scene, LeavesOutWhatTheFileLeavesOut) {
  const fc::Scene scene = read_text(two_balls, 1);
  EXPECT_EQ(scene.name, "scene");  // the file's name
  EXPECT_FALSE(scene.step || scene.gravity || scene.restitution || scene.motions || scene.linear ||
               scene.lcp);
  EXPECT_FALSE(scene.shapes[0].mass || scene.shapes[0].density || scene.shapes[0].inertia);
  EXPECT_EQ(scene.interval, 1);
  EXPECT_EQ(scene.ccd.tolerance, 1e-6);
  EXPECT_EQ(scene.bodies[1].orientation.w(), 1);
  EXPECT_EQ(scene.bodies[1].velocity, Vec3::Zero());
}

TEST(Scene, ChoicesAreWords) {
  EXPECT_EQ(read_text(two_balls, 1).ccd.bound, "second_order");
  EXPECT_EQ(read_text(two_balls, 1, {"ccd.bound=naive"}).ccd.bound, "naive");
}

// The table says in words what the structs say in C++.
TEST(Scene, DefaultsAreThoseOfTheTable) {
  EXPECT_EQ(std::stod(fc::find_scene_key("ccd.tolerance")->fallback), fc::CcdSpec().tolerance);
  EXPECT_EQ(std::stoi(fc::find_scene_key("ccd.max_iterations")->fallback), fc::CcdSpec().max_iterations);
  EXPECT_EQ(fc::find_scene_key("ccd.bound")->fallback, fc::CcdSpec().bound);
  EXPECT_EQ(fc::find_scene_key("solver.method")->fallback, fc::SolverSpec().method);
  EXPECT_EQ(std::stod(fc::find_scene_key("interval")->fallback), fc::Scene().interval);
}

TEST(Scene, MarksEveryKey) {
  const fc::Scene scene = read_text("ccd:\n  tolerance: 1e-4\n" + two_balls, 1);
  ASSERT_TRUE(scene.mark("ccd.tolerance"));
  EXPECT_EQ(scene.mark("ccd.tolerance")->line, 2);
  EXPECT_EQ(scene.mark("ccd.tolerance")->column, 3);
  EXPECT_EQ(scene.mark("bodies.1.position")->line, 6);
  EXPECT_EQ(scene.mark("shapes.ball.sphere")->line, 3);
  EXPECT_FALSE(scene.mark("gravity"));
}

TEST(Scene, GridsCountXFastest) {
  const fc::Scene scene = read_text(one_ball, 4, {"bodies.0.grid={count: [3, 2, 2], spacing: [1, 10, 100]}"});
  ASSERT_EQ(scene.bodies.size(), 12u);
  EXPECT_EQ(scene.bodies[1].position, Vec3(1, 0, 1));
  EXPECT_EQ(scene.bodies[3].position, Vec3(0, 10, 1));
  EXPECT_EQ(scene.bodies[11].position, Vec3(2, 10, 101));
}

TEST(Scene, NamesMayBeOdd) {
  const fc::Scene scene = read_text(
      "name: 'a/b: \"c\" [é]'\nshapes: {'': {sphere: {radius: 1}}, 'x.y z': {sphere: {radius: 2}}}\n"
      "bodies: [{shape: x.y z}, {shape: x.y z, position: [9, 0, 0]}]\n",
      1, {"shapes.x.y z.sphere.radius=3"});
  EXPECT_EQ(scene.name, "a/b: \"c\" [é]");
  EXPECT_EQ(std::get<fc::SphereSpec>(scene.shapes[1].geometry).radius, 3);
}

TEST(Scene, ByteOrderMarkAndCarriageReturnsAreText) {
  std::string text = "\xEF\xBB\xBF" + one_ball;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, 1, '\r');
  EXPECT_EQ(read_text(text, 4).step->frames, 100);
}

TEST(Scene, AliasesShareAValue) {
  const fc::Scene scene = read_text(
      "shapes: {ball: {sphere: {radius: 0.5}}}\n"
      "bodies:\n  - {shape: ball, position: [0, 0, 0], velocity: &v [1, 2, 3]}\n"
      "  - {shape: ball, position: [3, 0, 0], velocity: *v}\n",
      1, {"bodies.0.velocity.1=7"});
  EXPECT_EQ(scene.bodies[0].velocity, Vec3(1, 7, 3));
  EXPECT_EQ(scene.bodies[1].velocity, Vec3(1, 2, 3));  // changed at one place only
}

TEST(Scene, ContactsAndLcps) {
  const fc::Scene touching = read_text(
      "shapes: {ball: {sphere: {radius: 0.5}, mass: 1}}\n"
      "bodies: [{shape: ball}, {shape: ball, position: [0, 0, 1]}]\n"
      "contacts: [{a: 0, b: 1, point: [0, 0, 0.5], normal: [0, 0, 4]}]\n",
      3);
  ASSERT_EQ(touching.contacts.size(), 1u);
  EXPECT_EQ(touching.contacts[0].normal, Vec3(0, 0, 1));
  EXPECT_EQ(touching.contacts[0].where.line, 3);
  const fc::Scene direct = read_text("lcp: {A: [[2, 1], [0, 2]], b: [-1, 1e-3]}\n", 3);
  EXPECT_EQ((*direct.lcp->matrix)(0, 1), 1);
  EXPECT_EQ((*direct.lcp->vector)[1], 1e-3);
  fc_test::write_file("A.mtx", "x");
  fc_test::write_file("b.mtx", "x");
  EXPECT_TRUE(read_text("lcp: {matrix: A.mtx, vector: b.mtx}\n", 3).lcp->matrix_file);
}

TEST(Scene, MeshesAreFoundInTheStatedOrder) {
  const std::string text = "shapes: {m: {mesh: m.obj, scale: 2}}\nbodies: [{shape: m}, {shape: m}]\n";
  fc_test::write_file("first/m.obj", "x");
  fc_test::write_file("second/m.obj", "x");
  const auto scene_file = fc_test::write_file("scenes/scene.yaml", text);
  const auto found = [&] {
    const fc::Scene scene =
        fc::read_scene({scene_file, {}, {fc_test::folder() / "first", fc_test::folder() / "second"}, 2});
    return std::get<fc::MeshSpec>(scene.shapes[0].geometry).file;
  };
  EXPECT_EQ(found(), fc_test::folder() / "first" / "m.obj");
  fc_test::write_file("scenes/m.obj", "x");
  EXPECT_EQ(found(), fc_test::folder() / "scenes" / "m.obj");  // beside the scene comes first
}

TEST(SceneSet, SetsWhatTheFileHasAndWhatItLeavesOut) {
  EXPECT_EQ(read_text(one_ball, 4, {"step.dt=0.1"}).step->frames, 10);
  EXPECT_EQ(read_text(one_ball, 4, {"ccd.tolerance=1e-3"}).ccd.tolerance, 1e-3);
  EXPECT_EQ(*read_text(one_ball, 4, {"gravity=[0, 0, -1]"}).gravity, Vec3(0, 0, -1));
  EXPECT_EQ(read_text(one_ball, 4, {"bodies.0.velocity=[1,0,0]"}).bodies[0].velocity, Vec3(1, 0, 0));
  EXPECT_EQ(read_text(one_ball, 4, {"restitution=0.1", "restitution=0.2"}).restitution, 0.2);  // in order
  const fc::Scene scene = read_text(one_ball, 4, {"gravity=[0, 0, -1]"});
  EXPECT_EQ(scene.mark("gravity")->text(), "--set gravity=[0, 0, -1]");
}

TEST(SceneSet, IsCheckedAsTheFileIs) {
  const auto set = [](const char* text) { return refusal(one_ball, 4, {text}); };
  EXPECT_EQ(set("gravty=1"), "--set gravty=1: unknown key 'gravty'; the nearest known key is 'gravity'");
  EXPECT_EQ(
      set("friction=0.5"),
      "--set friction=0.5: 'friction' comes with chapter 6 (friction); remove it, or run the scene with that chapter");
  EXPECT_EQ(set("restitution=2"),
            "--set restitution=2: 'restitution' is 2, out of range [0, 1]; write e.g. restitution: 0.5");
  EXPECT_EQ(set("step.dt="),
            "--set step.dt=: 'dt' must be a number in s, found nothing; write e.g. dt: 0.01");
  EXPECT_EQ(set("shapes.ball.density=5"),
            "--set shapes.ball.density=5: 'density' beside 'mass'; keep one of them");
  EXPECT_EQ(set("bodies.1.velocity=[1,0,0]"),
            "--set bodies.1.velocity=[1,0,0]: '1' is not an item of a list of 1; count its items from 0");
  EXPECT_EQ(set("step.dt.x=1"),
            "--set step.dt.x=1: 'x' would be inside the single value '0.01'; set the whole value instead");
  EXPECT_EQ(set("gravity=[0,0"),
            "--set gravity=[0,0: not valid YAML: end of sequence flow not found; check brackets, colons, "
            "quotes and indentation up to here");
  EXPECT_EQ(set("name='x"), "--set name='x: a quote begins here and never ends; close it");
  EXPECT_EQ(set("ccd={tolerance: 1, tolerance: 2}"),
            "--set ccd={tolerance: 1, tolerance: 2}: the key 'tolerance' is given twice; keep one of them");
  for (const char* text : {"gravity", "=1", "", ".=1", "a.=1", ".a=1", "a..b=1"}) {
    EXPECT_NE(set(text).find("not a key and a value; write e.g."), std::string::npos) << text;
  }
}

TEST(SceneSet, MendsAMissingKey) {
  const std::string without_dt = "step: {duration: 1}\n" + one_ball.substr(one_ball.find('\n') + 1);
  EXPECT_EQ(refusal(without_dt, 4), ":1:7: missing key 'dt' in 'step'; add e.g. dt: 0.01");
  EXPECT_EQ(read_text(without_dt, 4, {"step.dt=0.5"}).step->frames, 2);
}

TEST(Scene, ChaptersKnowTheirKeys) {
  EXPECT_EQ(refusal("interval: 2\n" + two_balls, 1), "accepted");
  EXPECT_EQ(refusal("interval: 2\n" + two_balls, 2), "accepted");
  EXPECT_NE(refusal("interval: 2\n" + two_balls, 3), "accepted");
  EXPECT_EQ(refusal("restitution: 1\n" + one_ball, 4), "accepted");
  EXPECT_EQ(refusal("restitution: 1\n" + one_ball, 5), "accepted");
}

}  // namespace
