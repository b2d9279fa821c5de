// Cylinders, cones and compounds: where they touch, and when.
#include <gtest/gtest.h>

#include "ch02_hull_hierarchy/advance.hpp"
#include "ch02_hull_hierarchy/features.hpp"
#include "ch02_hull_hierarchy/inside.hpp"
#include "ch02_hull_hierarchy/replay.hpp"
#include "tests/support/test_models.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;
using namespace fc::test;
using ca::FeaturePair;

constexpr double tolerance = 1e-6;

template <class Geometry>
Model model_of(Geometry geometry) {
  ShapeSpec spec;
  spec.name = "shape";
  spec.geometry = std::move(geometry);
  return build_model(build_shape(spec, 0));
}
Model box(double x, double y, double z) {
  return model_of(BoxSpec{{x, y, z}});
}
PartSpec part(const Vec3& size, const Vec3& position) {
  PartSpec part;
  part.geometry = BoxSpec{size};
  part.position = position;
  return part;
}

// B stands at `at` over A; both are turned as one.
std::vector<FeaturePair> touching(const Model& a, const Model& b, const Vec3& at, const Quat& turn_b,
                                  const Quat& both = Quat::Identity()) {
  const ca::Motion ma = motion(Vec3::Zero(), both), mb = motion(both * at, both * turn_b);
  return contact_features(a, b, ca::PairPose(ma, mb, 0), ma.position, tolerance);
}

// All along z (turned by `both`), each as far apart as it says.
void expect_upright(const std::vector<FeaturePair>& found, int count, double gap, const Quat& both) {
  ASSERT_EQ(static_cast<int>(found.size()), count);
  for (const FeaturePair& f : found) {
    EXPECT_LT((f.normal - both * Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_NEAR(f.gap, gap, 1e-12);
    EXPECT_LT((f.point_b - f.point_a - f.gap * f.normal).norm(), 1e-12);
  }
}

const Quat kOnItsSide(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitY()));

TEST(Curved, ACylinderStandsOnEightPointsOfItsRimAndLiesOnTwo) {
  const Model floor = box(4, 4, 1), cylinder = model_of(CylinderSpec{0.3, 1.2});
  Random random(3);
  for (int round = 0; round < 5; ++round) {
    const Quat both = round ? rotation(random) : Quat::Identity();
    const auto standing = touching(floor, cylinder, {0.2, 0.1, 0.5 + 0.6 + 4e-7}, Quat::Identity(), both);
    expect_upright(standing, 8, 4e-7, both);
    for (const FeaturePair& f : standing)
      EXPECT_NEAR((both.conjugate() * f.point_a - Vec3(0.2, 0.1, 0.5)).norm(), 0.3, 1e-12);
    const auto lying = touching(floor, cylinder, {0.2, 0.1, 0.5 + 0.3 + 4e-7}, kOnItsSide, both);
    expect_upright(lying, 2, 4e-7, both);
    EXPECT_NEAR((lying[0].point_a - lying[1].point_a).norm(), 1.2, 1e-12);
    expect_upright(touching(cylinder, floor, {0, 0, 0.5 + 0.6 + 4e-7}, Quat::Identity(), both), 8, 4e-7,
                   both);
  }
}

TEST(Curved, ATiltedCylinderStandsOnItsLowestPoint) {
  const Model floor = box(4, 4, 1), cylinder = model_of(CylinderSpec{0.3, 1.2});
  for (const double tilt : {1e-5, 1e-3, 0.05, 0.4, 1.0}) {
    const Quat turn(Eigen::AngleAxisd(tilt, Vec3(1, 2, 0).normalized()));
    const double low = 0.6 * std::cos(tilt) + 0.3 * std::sin(tilt);
    const auto found = touching(floor, cylinder, {0, 0, 0.5 + low + 4e-7}, turn);
    expect_upright(found, 1, 4e-7, Quat::Identity());
  }
}

TEST(Curved, AConeStandsOnItsBaseLiesOnItsSideAndHangsByItsApex) {
  const Model floor = box(4, 4, 1), cone = model_of(ConeSpec{0.3, 0.4});  // its side is 0.5 m long
  const double base = 0.1, apex = 0.3;                                    // m from the centre of mass
  expect_upright(touching(floor, cone, {0, 0, 0.5 + base + 4e-7}, Quat::Identity()), 8, 4e-7,
                 Quat::Identity());
  const Quat down(Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()));
  expect_upright(touching(floor, cone, {0, 0, 0.5 + apex + 4e-7}, down), 1, 4e-7, Quat::Identity());
  // The side's normal is (0.8, 0, 0.6): turned to point down.
  const Quat aside = Quat::FromTwoVectors(Vec3(0.8, 0, 0.6), -Vec3::UnitZ());
  const double height = Vec3(0.8, 0, 0.6).dot(Vec3(0, 0, apex));
  const auto lying = touching(floor, cone, {0, 0, 0.5 + height + 4e-7}, aside);
  expect_upright(lying, 2, 4e-7, Quat::Identity());
  EXPECT_NEAR((lying[0].point_a - lying[1].point_a).norm(), 0.5, 1e-12);
}

TEST(Curved, PartOverAnEdgeTheBorderCarries) {
  const Model block = box(1, 1, 1), cylinder = model_of(CylinderSpec{0.3, 1});
  const auto standing = touching(block, cylinder, {0.5, 0, 1 + 4e-7}, Quat::Identity());
  ASSERT_GE(standing.size(), 3u);
  int on_border = 0;
  for (const FeaturePair& f : standing) {
    EXPECT_LE(f.point_a.x(), 0.5 + 1e-9);
    EXPECT_LE((f.point_a - Vec3(0.5, 0, 0.5)).norm(), 0.3 + 1e-9);
    EXPECT_NEAR(f.gap, 4e-7, 1e-12);
    on_border += std::abs(f.point_a.x() - 0.5) < 1e-8;
  }
  EXPECT_EQ(on_border, 2);
  const auto lying = touching(block, cylinder, {0.4, 0, 0.8 + 4e-7}, kOnItsSide);
  expect_upright(lying, 2, 4e-7, Quat::Identity());
  EXPECT_NEAR((lying[0].point_a - lying[1].point_a).norm(), 0.6, 1e-9);  // from -0.1 to the edge
}

TEST(Curved, TwoCylindersCrossAtAPointOrLieAlongALine) {
  const Model cylinder = model_of(CylinderSpec{0.3, 2});
  const Quat across(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitX()));
  const ca::Motion first = motion(Vec3::Zero(), kOnItsSide);
  const auto at = [&](const Quat& turn, double x) {
    const ca::Motion second = motion({x, 0, 0.6 + 4e-7}, turn);
    return contact_features(cylinder, cylinder, ca::PairPose(first, second, 0), Vec3::Zero(), tolerance);
  };
  const auto crossing = at(across, 0.25);
  expect_upright(crossing, 1, 4e-7, Quat::Identity());
  EXPECT_LT((crossing[0].point_a - Vec3(0.25, 0, 0.3)).norm(), 1e-9);
  const auto along = at(kOnItsSide, 0.5);
  expect_upright(along, 2, 4e-7, Quat::Identity());
  EXPECT_NEAR((along[0].point_a - along[1].point_a).norm(), 1.5, 1e-9);
}

// A box of many triangles: a cylinder feels the face, not the lines that are drawn on it.
TEST(Curved, LinesDrawnOnAMeshAreNoEdges) {
  TriangleMesh mesh;
  for (int y = 0; y <= 4; ++y)
    for (int x = 0; x <= 4; ++x) mesh.vertices.emplace_back(x - 2.0, y - 2.0, 0);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      const int i = 5 * y + x;
      mesh.triangles.push_back({i, i + 1, i + 6});
      mesh.triangles.push_back({i, i + 6, i + 5});
    }
  Shape sheet;
  sheet.kind = Shape::Kind::mesh;
  sheet.core = mesh;
  sheet.solid = false;
  const Model floor = build_model(sheet), cylinder = model_of(CylinderSpec{0.3, 1.2});
  const auto lying = touching(floor, cylinder, {0.1, 0.05, 0.3 + 4e-7}, kOnItsSide);
  ASSERT_GE(lying.size(), 2u);
  double low = 9, high = -9;
  for (const FeaturePair& f : lying) {
    EXPECT_LT((f.normal - Vec3::UnitZ()).norm(), 1e-12);
    EXPECT_NEAR(f.gap, 4e-7, 1e-12);
    low = std::min(low, f.point_a.x());
    high = std::max(high, f.point_a.x());
  }
  EXPECT_NEAR(low, -0.5, 1e-9);
  EXPECT_NEAR(high, 0.7, 1e-9);
}

// Two boxes side by side are one plank: a cube that stands over the seam feels no edge there.
TEST(Compound, ASeamIsNoEdge) {
  CompoundSpec spec;
  spec.parts = {part({1, 1, 1}, {-0.5, 0, 0}), part({1, 1, 1}, {0.5, 0, 0})};
  const Model plank = model_of(spec), cube = box(0.2, 0.2, 0.2), rod = model_of(CylinderSpec{0.1, 0.2});
  for (const double aside : {-3e-7, 0.0, 3e-7, 0.05})
    for (const Model* upper : {&cube, &rod}) {
      const auto found = touching(plank, *upper, {0.1 + aside, 0, 0.6 + 4e-7}, Quat::Identity());
      ASSERT_GE(found.size(), 4u);
      for (const FeaturePair& f : found) {
        EXPECT_LT((f.normal - Vec3::UnitZ()).norm(), 1e-12) << aside;
        EXPECT_NEAR(f.gap, 4e-7, 1e-12);
      }
    }
}

// An L of two boxes, as a compound and as a mesh: the same first contact with a box that comes from anywhere.
TEST(Compound, CollidesAsTheUnionOfItsParts) {
  CompoundSpec spec;
  spec.parts = {part({1, 0.4, 0.4}, {0.5, 0.2, 0.2}), part({0.4, 1, 0.4}, {0.2, 0.5, 0.2})};  // they overlap
  TriangleMesh mesh;
  const double corners[6][2] = {{0, 0}, {1, 0}, {1, 0.4}, {0.4, 0.4}, {0.4, 1}, {0, 1}};
  for (const double z : {0.0, 0.4})
    for (const auto& c : corners) mesh.vertices.emplace_back(c[0], c[1], z);
  for (int k = 1; k < 5; ++k) {
    mesh.triangles.push_back({0, k + 1, k});
    mesh.triangles.push_back({6, 6 + k, 7 + k});
  }
  for (int k = 0; k < 6; ++k) {
    const int next = (k + 1) % 6;
    mesh.triangles.push_back({k, next, 6 + next});
    mesh.triangles.push_back({k, 6 + next, 6 + k});
  }
  ShapeSpec compound_spec;
  compound_spec.geometry = spec;
  Shape compound = build_shape(compound_spec, 0), solid;
  solid.kind = Shape::Kind::mesh;
  solid.core = mesh;
  for (Vec3& v : solid.core.vertices) v -= compound.mass.center_of_mass;
  solid.reach = compound.reach;
  const Model parts = build_model(compound), whole = build_model(solid);
  EXPECT_EQ(check_tree(parts), "");
  const std::vector<Model> others = {box(0.5, 0.3, 0.2), model_of(CylinderSpec{0.2, 0.5}),
                                     model_of(ConeSpec{0.3, 0.5})};
  Random random(11);
  int contacts = 0;
  for (int round = 0; round < 60; ++round) {
    const Model& other = others[static_cast<std::size_t>(round % 3)];
    RigidBody still, flying;
    still.orientation = rotation(random);
    still.spin = 3 * unit_vector(random);
    flying.position = 2 * unit_vector(random);
    flying.orientation = rotation(random);
    flying.spin = 2 * unit_vector(random);
    flying.velocity = -2 * flying.position + 0.3 * unit_vector(random);
    const ca::Motion ma(still), mb(flying);
    ca::AdvanceOptions options;
    options.certificate = true;
    const auto one = advance(parts, ma, other, mb, options), two = advance(whole, ma, other, mb, options);
    EXPECT_EQ(one.status, two.status) << round;
    EXPECT_NEAR(one.toc, two.toc, 2e-6) << round;
    contacts += one.status == ca::Status::contact;
    EXPECT_EQ(one.features.empty(), one.status != ca::Status::contact) << round;
    const ca::ReplayAnswer answer{one.status, one.toc, one.gap_lower, one.gap_upper};
    const auto wrong = replay({parts, other, ma, mb, 1}, answer, one.certificate, one.certificate_leaves);
    EXPECT_TRUE(wrong.empty()) << round << ": " << wrong.front().what;
  }
  EXPECT_GT(contacts, 30);
}

}  // namespace
