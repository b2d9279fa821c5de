// Shapes and bodies from specifications.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "common/shape.hpp"
#include "tests/mesh/test_meshes.hpp"

namespace fc {
namespace {

using test::TemporaryFile;

ShapeSpec spec_of(decltype(ShapeSpec::geometry) geometry) {
  ShapeSpec spec;
  spec.name = "thing";
  spec.geometry = std::move(geometry);
  spec.where = {"scene.yaml", 4, 3};
  spec.geometry_where = {"scene.yaml", 5, 9};
  return spec;
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string text;
  for (const Vec3& v : mesh.vertices) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& [i, j, k] : mesh.triangles) text += fmt::format("f {} {} {}\n", i + 1, j + 1, k + 1);
  return text;
}

TriangleMesh open_box(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh = test::box_mesh(low, high);
  mesh.triangles.resize(10);  // without +z
  return mesh;
}

std::string refusal(const ShapeSpec& spec) {
  try {
    build_shape(spec, 0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(built without an error)";
}

TEST(BuildShape, Sphere) {
  ShapeSpec spec = spec_of(SphereSpec{0.5});
  spec.density = 1000;
  const Shape shape = build_shape(spec, 0.25);
  EXPECT_EQ(shape.kind, Shape::Kind::sphere);
  EXPECT_EQ(shape.core.vertices, std::vector<Vec3>{Vec3::Zero()});
  EXPECT_TRUE(shape.core.triangles.empty());
  EXPECT_EQ(shape.radius, 0.5);
  EXPECT_EQ(shape.reach, 0.5);
  EXPECT_TRUE(shape.convex() && shape.solid);
  EXPECT_DOUBLE_EQ(shape.mass.mass, 1000 * std::numbers::pi / 6);
  EXPECT_EQ(shape.mass_source, "density");
  EXPECT_EQ(shape.restitution, 0.25);
}

PartSpec part_of(decltype(PartSpec::geometry) geometry, const Vec3& position,
                 const Quat& turn = Quat::Identity()) {
  return {std::move(geometry), position, turn, {}};
}

TEST(BuildShape, CylinderAndConeHaveTheMassOfTheirFormulas) {
  const double pi = std::numbers::pi, r = 0.3, h = 0.8;
  ShapeSpec spec = spec_of(CylinderSpec{r, h});
  spec.density = 700;
  const Shape cylinder = build_shape(spec, 0);
  const double m = 700 * pi * r * r * h;
  EXPECT_NEAR(cylinder.mass.mass, m, 1e-12 * m);
  EXPECT_NEAR(cylinder.mass.inertia(2, 2), m * r * r / 2, 1e-12 * m);
  EXPECT_NEAR(cylinder.mass.inertia(0, 0), m * (3 * r * r + h * h) / 12, 1e-12 * m);
  EXPECT_NEAR(cylinder.reach, std::hypot(r, h / 2), 1e-15);
  EXPECT_LT((bounds_of(cylinder).max() - Vec3(r, r, h / 2)).norm(), 1e-15);
  spec.geometry = ConeSpec{r, h};
  const Shape cone = build_shape(spec, 0);
  EXPECT_NEAR(cone.mass.mass, m / 3, 1e-12 * m);
  EXPECT_NEAR(cone.mass.center_of_mass.z(), -h / 4, 1e-15);
  EXPECT_NEAR(cone.mass.inertia(2, 2), 0.3 * m / 3 * r * r, 1e-12 * m);
  EXPECT_NEAR(cone.mass.inertia(1, 1), m / 3 * (3.0 / 20 * r * r + 3.0 / 80 * h * h), 1e-12 * m);
  EXPECT_NEAR(cone.core.vertices[1].z(), 0.75 * h, 1e-15);  // the apex, from the centre of mass
}

TEST(BuildShape, ACompoundIsTheSumOfItsParts) {
  // A dumbbell: two balls and a bar along x.
  const Quat along_x(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));
  ShapeSpec spec =
      spec_of(CompoundSpec{{part_of(SphereSpec{0.2}, {-0.5, 1, 0}), part_of(SphereSpec{0.2}, {0.5, 1, 0}),
                            part_of(CylinderSpec{0.1, 1}, {0, 1, 0}, along_x)}});
  spec.density = 1000;
  const Shape shape = build_shape(spec, 0);
  const double pi = std::numbers::pi, ball = 1000 * 4.0 / 3 * pi * 0.008, bar = 1000 * pi * 0.01;
  EXPECT_NEAR(shape.mass.mass, 2 * ball + bar, 1e-10);
  EXPECT_LT((shape.mass.center_of_mass - Vec3(0, 1, 0)).norm(), 1e-14);
  const double along = 2 * 0.4 * ball * 0.04 + bar * 0.01 / 2;
  const double across = 2 * ball * (0.4 * 0.04 + 0.25) + bar * (3 * 0.01 + 1) / 12;
  EXPECT_LT((shape.mass.inertia - Mat3(Vec3(along, across, across).asDiagonal())).norm(), 1e-12 * across);
  EXPECT_EQ(shape.mass_source, "density, each part counted in full");
  EXPECT_FALSE(shape.convex());
  EXPECT_NEAR(shape.reach, 0.7, 1e-14);
  EXPECT_LT((bounds_of(shape).max() - Vec3(0.7, 0.2, 0.2)).norm(), 1e-14);
  // A brick in two halves is the brick.
  spec.geometry =
      CompoundSpec{{part_of(BoxSpec{{1, 2, 3}}, {0.5, 0, 0}), part_of(BoxSpec{{1, 2, 3}}, {1.5, 0, 0})}};
  const Shape halves = build_shape(spec, 0);
  EXPECT_LT((halves.mass.inertia - box_mass({2, 2, 3}, 1000).inertia).norm(), 1e-9);
  EXPECT_LT((halves.mass.center_of_mass - Vec3(1, 0, 0)).norm(), 1e-14);
}

TEST(MakeBody, FixedDegreesOfFreedomHaveNoInverseMass) {
  ShapeSpec spec = spec_of(BoxSpec{{1, 2, 3}});
  spec.mass = 4;
  spec.inertia = (Mat3() << 3, 0.5, 0.2, 0.5, 4, 0.1, 0.2, 0.1, 5).finished();
  const Shape shape = build_shape(spec, 0);
  BodySpec body;
  body.free_moves = {1, 0, 1};
  body.free_turns = {0, 1, 1};
  const RigidBody guided = make_body(shape, body);
  const Eigen::Matrix2d block = shape.mass.inertia.bottomRightCorner<2, 2>().inverse();
  EXPECT_LT((guided.inverse_inertia_body.bottomRightCorner<2, 2>() - block).norm(), 1e-15);
  EXPECT_EQ(guided.inverse_inertia_body.row(0).norm() + guided.inverse_inertia_body.col(0).norm(), 0);
  EXPECT_TRUE(guided.is_guided());
  EXPECT_FALSE(guided.is_static());
  body.free_moves = body.free_turns = Vec3::Zero();
  EXPECT_TRUE(make_body(shape, body).is_static());
}

TEST(BuildShape, BoxHasItsDocumentedOrder) {
  ShapeSpec spec = spec_of(BoxSpec{{2, 4, 6}});
  spec.mass = 12;
  spec.restitution = 0.75;
  const Shape shape = build_shape(spec, 0.25);
  ASSERT_EQ(shape.core.vertices.size(), 8u);
  for (int i = 0; i < 8; ++i) {
    EXPECT_EQ(shape.core.vertices[i], Vec3((i & 1) ? 1 : -1, (i & 2) ? 2 : -2, (i & 4) ? 3 : -3));
  }
  ASSERT_EQ(shape.core.triangles.size(), 12u);
  for (int t = 0; t < 12; ++t) {
    const auto& [i, j, k] = shape.core.triangles[t];
    const auto& v = shape.core.vertices;
    const Vec3 normal = (v[j] - v[i]).cross(v[k] - v[i]).normalized();
    EXPECT_EQ(normal, (t / 2 % 2 ? 1 : -1) * Vec3::Unit(t / 4)) << t;
  }
  EXPECT_TRUE(test::closed_and_oriented(shape.core));
  EXPECT_DOUBLE_EQ(shape.reach, std::sqrt(14));
  EXPECT_EQ(shape.mass.mass, 12);
  EXPECT_NEAR((shape.mass.inertia - Mat3(Vec3(52, 40, 20).asDiagonal())).norm(), 0, 1e-13);
  EXPECT_EQ(shape.mass_source, "mass");
  EXPECT_EQ(shape.restitution, 0.75);
}

TEST(BuildShape, Capsule) {
  const Shape shape = build_shape(spec_of(CapsuleSpec{0.1, 1}), 0);
  EXPECT_EQ(shape.core.vertices, (std::vector<Vec3>{{0, 0, -0.5}, {0, 0, 0.5}}));
  EXPECT_DOUBLE_EQ(shape.reach, 0.6);
  EXPECT_EQ(shape.mass.mass, 0);
  EXPECT_EQ(shape.mass_source, "none");
}

TEST(BuildShape, HullIsRecentredAboutItsCentreOfMass) {
  HullSpec hull{test::box_mesh({10, 20, 30}, {11, 22, 33}).vertices};
  hull.points.emplace_back(10.5, 21, 31);  // inside
  ShapeSpec spec = spec_of(hull);
  spec.density = 2;
  const Shape shape = build_shape(spec, 0);
  EXPECT_EQ(shape.core.vertices.size(), 8u);
  EXPECT_LT((shape.mass.center_of_mass - Vec3(10.5, 21, 31.5)).norm(), 1e-14);
  EXPECT_NEAR((shape.mass.inertia - box_mass({1, 2, 3}, 2).inertia).norm(), 0, 1e-13);
  EXPECT_NEAR(shape.reach, std::sqrt(14) / 2, 1e-14);
  EXPECT_LT((shape.core.vertices[0] - Vec3(-0.5, -1, -1.5)).norm(), 1e-14);
}

TEST(BuildShape, FlatHullIsRefusedAtItsLine) {
  EXPECT_EQ(refusal(spec_of(HullSpec{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 3, 0}}})),
            "scene.yaml:5:9: shape 'thing': the hull spans no volume; give at least four points that are not "
            "in one plane");
}

TEST(BuildShape, SolidMeshIsScaledAndFilled) {
  const TemporaryFile file("box.obj", obj_text(test::reversed(test::box_mesh({1, 1, 1}, {2, 3, 4}))));
  ShapeSpec spec = spec_of(MeshSpec{file.path, 2});
  spec.density = 3;
  const Shape shape = build_shape(spec, 0);
  EXPECT_FALSE(shape.convex());
  EXPECT_TRUE(shape.solid);
  EXPECT_TRUE(shape.report.inside_out);
  EXPECT_NEAR(shape.mass.mass, 3 * 48, 1e-12);
  EXPECT_LT((shape.mass.center_of_mass - Vec3(3, 4, 5)).norm(), 1e-14);
  EXPECT_NEAR(shape.reach, std::sqrt(14), 1e-14);
  EXPECT_EQ(shape.mass_source, "density");
}

TEST(BuildShape, OpenMeshFallsBackToItsFilledHull) {
  const TemporaryFile file("open.obj", obj_text(open_box({1, 1, 1}, {2, 3, 4})));
  ShapeSpec spec = spec_of(MeshSpec{file.path, 1});
  spec.density = 3;
  const Shape shape = build_shape(spec, 0);
  EXPECT_FALSE(shape.solid);
  EXPECT_EQ(shape.report.holes, 1);
  EXPECT_EQ(shape.mass_source, "density, of the convex hull");
  EXPECT_NEAR(shape.mass.mass, 18, 1e-13);
  EXPECT_LT((shape.mass.center_of_mass - Vec3(1.5, 2, 2.5)).norm(), 1e-14);
  spec.density.reset();
  spec.mass = 4;
  EXPECT_EQ(build_shape(spec, 0).mass_source, "mass, of the convex hull");
  EXPECT_NEAR((build_shape(spec, 0).mass.inertia - box_mass({1, 2, 3}, 4.0 / 6).inertia).norm(), 0, 1e-13);
  // No mass: the centre is the same, so that a query's body turns about it.
  spec.mass.reset();
  EXPECT_EQ(build_shape(spec, 0).mass.center_of_mass, shape.mass.center_of_mass);
  EXPECT_EQ(build_shape(spec, 0).mass.mass, 0);
}

TEST(BuildShape, ExplicitMassAndInertia) {
  const TemporaryFile file("open.obj", obj_text(open_box({1, 1, 1}, {2, 3, 4})));
  ShapeSpec spec = spec_of(MeshSpec{file.path, 1});
  spec.mass = 7;
  spec.inertia = Vec3(2, 3, 4).asDiagonal();
  Shape shape = build_shape(spec, 0);
  EXPECT_EQ(shape.mass_source, "mass and inertia");
  EXPECT_EQ(shape.mass.mass, 7);
  EXPECT_EQ(shape.mass.inertia, *spec.inertia);
  EXPECT_LT((shape.mass.center_of_mass - Vec3(1.5, 2, 2.5)).norm(), 1e-14);
  spec.center_of_mass = Vec3(1, 1, 1);
  shape = build_shape(spec, 0);
  EXPECT_EQ(shape.core.vertices[0], Vec3::Zero());
  EXPECT_DOUBLE_EQ(shape.reach, std::sqrt(14));
}

TEST(BuildShape, FlatSurface) {
  // A square and half of one: the centre is the mean over the area.
  const TemporaryFile file("flat.obj", "v 0 0 1\nv 2 0 1\nv 2 2 1\nv 0 2 1\nf 1 2 3 4\n");
  ShapeSpec spec = spec_of(MeshSpec{file.path, 1});
  EXPECT_LT((build_shape(spec, 0).mass.center_of_mass - Vec3(1, 1, 1)).norm(), 1e-15);
  spec.density = 1;
  EXPECT_EQ(refusal(spec),
            "scene.yaml:4:3: shape 'thing': the mesh is an open, flat surface, and no mass follows from "
            "it; give mass and inertia");
  spec.density.reset();
  spec.mass = 1;
  spec.inertia = Vec3(1, 1, 2).asDiagonal();
  EXPECT_EQ(build_shape(spec, 0).mass_source, "mass and inertia");
}

TEST(BuildShape, MeshWithoutAreaIsRefused) {
  const TemporaryFile file("line.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n");
  EXPECT_EQ(refusal(spec_of(MeshSpec{file.path, 1})),
            "scene.yaml:5:9: shape 'thing': every triangle of " + file.path.string() +
                " is degenerate; check the file's units and the scale");
}

TEST(BuildShape, ImpossibleInertiaIsRefused) {
  ShapeSpec spec = spec_of(SphereSpec{1});
  spec.mass = 1;
  const auto with = [&](const Mat3& inertia) {
    spec.inertia = inertia;
    return refusal(spec);
  };
  const std::string who = "scene.yaml:4:3: shape 'thing': the inertia ";
  Mat3 skewed = Mat3::Identity();
  skewed(0, 1) = 0.1;
  EXPECT_EQ(with(skewed), who + "is not symmetric; write [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]");
  EXPECT_EQ(with(Mat3::Zero()), who + "is not positive definite; all three principal moments must be > 0");
  EXPECT_EQ(with(Vec3(1, 1, -1).asDiagonal()),
            who + "is not positive definite; all three principal moments must be > 0");
  const std::string too_large =
      who +
      "belongs to no body: its largest principal moment exceeds the sum of the other two; check the numbers";
  EXPECT_EQ(with(Vec3(1, 1, 2.1).asDiagonal()), too_large);
  const Mat3 turn = Quat(1, 2, 3, 4).normalized().toRotationMatrix();
  EXPECT_EQ(with(turn * Vec3(1, 1, 2.1).asDiagonal() * turn.transpose()), too_large);
  EXPECT_EQ(with(turn * Vec3(1, 1, 2).asDiagonal() * turn.transpose()),
            "(built without an error)");                                                   // a plate
  EXPECT_EQ(with(Vec3(0.0833, 0.0833, 0.1667).asDiagonal()), "(built without an error)");  // a rounded plate
}

TEST(BuildShape, MassOutsideTheRangeOfDoublesIsRefused) {
  ShapeSpec spec = spec_of(SphereSpec{1e-120});
  spec.density = 1;
  EXPECT_EQ(refusal(spec),
            "scene.yaml:4:3: shape 'thing': its mass or inertia is too small or too large for a double; "
            "check the units");
  spec.geometry = SphereSpec{1e80};
  EXPECT_NE(refusal(spec).find("too small or too large"), std::string::npos);
}

TEST(BuildShapes, BodiesThatMoveNeedAMass) {
  Scene scene;
  scene.shapes = {spec_of(SphereSpec{1}), spec_of(BoxSpec{{1, 1, 1}})};
  scene.shapes[1].density = 1;
  scene.restitution = 0.5;
  BodySpec still, moving;
  still.shape = 0;
  still.is_static = true;
  moving.shape = 1;
  scene.bodies = {still, moving};
  EXPECT_EQ(build_shapes(scene, true)[1].restitution, 0.5);
  scene.bodies[1].shape = 0;
  EXPECT_NO_THROW(build_shapes(scene, false));
  try {
    build_shapes(scene, true);
    FAIL() << "a body without mass was accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "scene.yaml:4:3: shape 'thing' belongs to a body that moves, but has no mass; add "
                 "'density' or 'mass', or make the body 'static: true'");
  }
}

TEST(MakeBody, StaticBodiesHaveNoMass) {
  ShapeSpec spec = spec_of(BoxSpec{{1, 1, 1}});
  spec.density = 1;
  BodySpec body;
  body.velocity = {1, 2, 3};
  const Shape shape = build_shape(spec, 0);
  EXPECT_FALSE(make_body(shape, body).is_static());
  EXPECT_EQ(make_body(shape, body).velocity, body.velocity);
  EXPECT_NEAR((make_body(shape, body).inverse_inertia_body * shape.mass.inertia - Mat3::Identity()).norm(), 0,
              1e-15);
  body.is_static = true;
  EXPECT_TRUE(make_body(shape, body).is_static());
  EXPECT_EQ(make_body(shape, body).velocity, Vec3::Zero());
}

// Wherever the file puts its origin, the body's points are where the scene puts them.
RC_GTEST_PROP(MakeBody, CoreIsWhereTheShapesFrameSays, ()) {
  auto random = test::random_engine();
  HullSpec hull;
  for (int i = 0; i < 20; ++i) hull.points.push_back(test::random_vector(random, 1) + Vec3(5, -7, 3));
  ShapeSpec spec = spec_of(hull);
  if (*rc::gen::arbitrary<bool>()) spec.mass = 2;
  const Shape shape = build_shape(spec, 0);
  BodySpec placed;
  placed.orientation = Quat(test::random_rotation(random));
  placed.position = test::random_vector(random, 10);
  const RigidBody body = make_body(shape, placed);
  RC_ASSERT((frame_position(shape, body) - placed.position).norm() < 1e-13);
  for (const Vec3& v : shape.core.vertices) {
    const Vec3 in_frame = v + shape.mass.center_of_mass;
    RC_ASSERT((body.pose() * v - (placed.orientation * in_frame + placed.position)).norm() < 1e-13);
    RC_ASSERT(v.norm() <= shape.reach);
    double nearest = 1;
    for (const Vec3& p : hull.points) nearest = std::min(nearest, (p - in_frame).norm());
    RC_ASSERT(nearest < 1e-14);
  }
}

TEST(BuildShape, Bunny) {
  if (!std::filesystem::exists(test::kBunny)) GTEST_SKIP() << "skipped: no " << test::kBunny;
  ShapeSpec spec = spec_of(MeshSpec{test::kBunny, 1});
  spec.density = 1000;
  const Shape shape = build_shape(spec, 0);
  EXPECT_TRUE(shape.solid);
  EXPECT_EQ(shape.core.triangles.size(), 69666u);
  const MassProperties again = solid_mass(shape.core, 1000);
  EXPECT_LT(again.center_of_mass.norm(), 1e-13);
  EXPECT_LT((again.inertia - shape.mass.inertia).norm(), 1e-12 * again.inertia.norm());
}

}  // namespace
}  // namespace fc
