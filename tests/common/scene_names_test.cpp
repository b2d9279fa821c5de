// Names of bodies, turns by axis and angle, and what two shapes do to each other.
#include <gtest/gtest.h>

#include <cmath>

#include <numbers>

#include "common/pair_rules.hpp"
#include "common/scene.hpp"
#include "scene_files.hpp"

namespace {

using fc::Vec3;
using fc_test::one_ball;
using fc_test::read_text;
using fc_test::refusal;
using fc_test::two_balls;

const std::string two_shapes =
    "step: {dt: 0.01, duration: 1}\n"
    "shapes:\n"
    "  ice: {sphere: {radius: 0.5}, mass: 1, restitution: 0.9}\n"
    "  steel: {sphere: {radius: 0.5}, mass: 1, restitution: 0.2}\n"
    "bodies:\n"
    "  - {shape: ice}\n"
    "  - {shape: steel, position: [3, 0, 0]}\n";

TEST(SceneRotation, IsTheTurnAboutAnAxis) {
  const fc::Scene scene = read_text(two_balls, 1,
                                    {"bodies.0.rotation={axis: [0, 0, 5], degrees: 90}",
                                     "bodies.1.rotation={axis: [1, 1, 1], degrees: 480}"});
  EXPECT_LT((scene.bodies[0].orientation * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), 1e-15);  // right-handed
  EXPECT_LT((scene.bodies[1].orientation * Vec3(1, 0, 0) - Vec3(0, 1, 0)).norm(), 1e-15);  // 120 degrees more
  EXPECT_NEAR(scene.bodies[1].orientation.norm(), 1, 1e-15);
}

TEST(SceneRotation, IsRefusedBesideAnOrientationAndWithoutAnAxis) {
  EXPECT_EQ(refusal("shapes: {ball: {sphere: {radius: 0.5}}}\n"
                    "bodies:\n"
                    "  - {shape: ball, orientation: [1, 0, 0, 0], rotation: {axis: [0, 0, 1], degrees: 1}}\n"
                    "  - {shape: ball}\n",
                    1),
            ":3:46: 'rotation' beside 'orientation'; keep one of them");
  const auto set = [](const char* text) { return refusal(two_balls, 1, {text}); };
  EXPECT_NE(set("bodies.0.rotation={axis: [0, 0, 0], degrees: 1}").find("'axis' is zero; write a direction"),
            std::string::npos);
  EXPECT_NE(set("bodies.0.rotation={axis: [0, 0, 1]}").find("missing key 'degrees'"), std::string::npos);
  EXPECT_NE(set("bodies.0.rotation={axis: [0, 0, 1], degrees: .inf}").find("not a finite number"),
            std::string::npos);
}

TEST(SceneNames, AreUniqueAndNoNumbers) {
  const fc::Scene scene = read_text(two_balls, 1, {"bodies.1.name=door"});
  EXPECT_EQ(scene.body_text(0), "0");
  EXPECT_EQ(scene.body_text(1), "1 ('door')");
  const auto text = [](const std::string& first, const std::string& second) {
    return "shapes: {ball: {sphere: {radius: 0.5}}}\nbodies:\n  - {shape: ball, name: " + first +
           "}\n  - {shape: ball, name: " + second + "}\n";
  };
  EXPECT_EQ(refusal(text("a", "b"), 1), "accepted");
  EXPECT_EQ(refusal(text("a", "a"), 1), ":4:25: body 0 is named 'a' already; give each its own name");
  EXPECT_EQ(refusal(text("a", "'7'"), 1),
            ":4:25: '7' is a number, as every body has one; give it a name of letters");
  EXPECT_EQ(refusal(text("a", "world"), 1),
            ":4:25: 'world' is what bodies are joined to; give the body another name");
  EXPECT_NE(refusal(one_ball, 4, {"bodies.0.name=a", "bodies.0.grid={count: [2, 1, 1], spacing: [2, 0, 0]}"})
                .find("would be the name of every body of the grid"),
            std::string::npos);
}

TEST(SceneNames, CallTheBodiesOfContacts) {
  const std::string text =
      "shapes: {ball: {sphere: {radius: 0.5}, mass: 1}}\n"
      "bodies: [{shape: ball, name: low}, {shape: ball, position: [0, 0, 1], name: high}]\n"
      "contacts: [{a: low, b: 1, point: [0, 0, 0.5], normal: [0, 0, 1]}]\n";
  EXPECT_EQ(read_text(text, 3).contacts[0].body_a, 0);
  EXPECT_EQ(read_text(text, 3, {"contacts.0.b=high"}).contacts[0].body_b, 1);
  EXPECT_EQ(refusal(text, 3, {"contacts.0.a=hihg"}),
            "--set contacts.0.a=hihg: no body is named 'hihg'; the nearest name is 'high'");
  EXPECT_EQ(refusal(text, 3, {"contacts.0.a=2"}),
            "--set contacts.0.a=2: there is no body 2; the bodies are numbered 0 to 1");
  EXPECT_NE(refusal(text, 3, {"contacts.0.a=1.5"}).find("'a' must be an integer"), std::string::npos);
  EXPECT_NE(refusal(text, 3, {"contacts.0.b=low"}).find("a body cannot touch itself"), std::string::npos);
}

TEST(ScenePairs, StandInsteadOfTheRule) {
  const fc::Scene plain = read_text(two_shapes, 4);
  const std::vector<fc::Shape> shapes = fc::build_shapes(plain, true);
  EXPECT_EQ(fc::PairRules(plain).restitution(shapes, 0, 1), 0.9);
  const fc::Scene scene = read_text(
      two_shapes, 4, {"pairs=[{a: steel, b: ice, restitution: 0.1}, {a: ice, b: ice, restitution: 0}]"});
  const fc::PairRules rules(scene);
  EXPECT_EQ(rules.restitution(shapes, 0, 1), 0.1);
  EXPECT_EQ(rules.restitution(shapes, 1, 0), 0.1);
  EXPECT_EQ(rules.restitution(shapes, 0, 0), 0);
  EXPECT_EQ(rules.restitution(shapes, 1, 1), 0.2);  // not in the list
}

TEST(ScenePairs, FrictionIsTheGeometricMeanUnlessThePairSaysMore) {
  const auto friction = [](const std::vector<std::string>& set, int a, int b) {
    const fc::Scene scene = read_text(two_shapes, 6, set);
    return fc::PairRules(scene).friction(fc::build_shapes(scene, true), a, b);
  };
  EXPECT_EQ(friction({}, 0, 1), 0);
  EXPECT_EQ(friction({"friction=0.3"}, 0, 1), 0.3);
  EXPECT_EQ(friction({"friction=0.9", "shapes.ice.friction=0.4"}, 0, 1), std::sqrt(0.9 * 0.4));
  EXPECT_EQ(friction({"friction=0.9", "shapes.ice.friction=0"}, 0, 1), 0);
  const std::vector<std::string> pair = {"friction=0.9", "pairs=[{a: ice, b: steel, friction: 0.02}]"};
  EXPECT_EQ(friction(pair, 1, 0), 0.02);
  EXPECT_EQ(friction(pair, 1, 1), 0.9);
  const fc::Scene scene = read_text(two_shapes, 6, pair);  // a pair without restitution keeps the rule
  EXPECT_EQ(fc::PairRules(scene).restitution(fc::build_shapes(scene, true), 0, 1), 0.9);
}

TEST(ScenePairs, AreCheckedAsTheRest) {
  const auto with = [](const std::string& pairs, int chapter = 4) {
    return refusal("pairs:\n  - " + pairs + "\n" + two_shapes, chapter);
  };
  EXPECT_EQ(with("{a: ice, b: steel, restitution: 0.1}"), "accepted");
  EXPECT_EQ(with("{a: ice, b: stel, restitution: 0.1}"),
            ":2:17: no shape is named 'stel'; the nearest name under 'shapes' is 'steel'");
  EXPECT_NE(with("{a: ice, b: steel, restitution: 0.1}\n  - {a: steel, b: ice, restitution: 0.2}")
                .find("the pair of 'steel' and 'ice' stands at"),
            std::string::npos);
  EXPECT_EQ(
      with("{a: ice, b: steel, restitution: 0.1, friction: 0.2}"),
      ":2:42: 'friction' comes with chapter 6 (friction); remove it, or run the scene with that chapter");
  EXPECT_NE(with("{a: ice, b: steel}").find("missing key 'restitution' in 'pairs.0'"), std::string::npos);
  EXPECT_NE(with("{a: ice, b: steel, restitution: 2}").find("out of range [0, 1]"), std::string::npos);
  EXPECT_EQ(
      refusal("pairs: [{a: ball, b: ball, restitution: 0}]\n" + two_balls, 2),
      ":1:1: 'pairs' comes with chapter 3 (impulse LCP); remove it, or run the scene with that chapter");
}

}  // namespace
