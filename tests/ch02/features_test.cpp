// Contact features of pairs whose contacts are known: how many, which, where, and their normals to 1e-12.
#include "ch02_hull_hierarchy/features.hpp"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "tests/support/test_models.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;
using namespace fc::test;
using ca::FeatureKind;
using ca::FeaturePair;
constexpr double tolerance = 1e-6;
constexpr FeatureKind vertex = FeatureKind::vertex, edge = FeatureKind::edge, face = FeatureKind::face;

std::vector<FeaturePair> features_of(const Model& a, const ca::Motion& ma, const Model& b,
                                     const ca::Motion& mb) {
  return contact_features(a, b, ca::PairPose(ma, mb, 0), ma.position, tolerance);
}

// Both bodies turned and moved as one, anywhere: the features turn with them, the counts stay. `b` stands at
// `at` above (along z) A, with the gap, whose every contact has the normal z.
void expect_contacts(const Model& a, const Model& b, const Vec3& at, const Quat& orientation, double gap,
                     int count, FeatureKind kind_a, FeatureKind kind_b) {
  Random random(1);
  for (int round = 0; round < 6; ++round) {
    const Quat q = round ? rotation(random) : Quat::Identity();
    const Vec3 shift = round > 3 ? Vec3(1e4 * unit_vector(random)) : Vec3::Zero();
    const bool has_face = kind_a == face || kind_b == face;
    const double turn = has_face    ? 1e-12
                        : round > 3 ? 1e-10
                                    : 1e-11;  // 1e4 m away positions are known to 2e-12 m
    const double near = 4e-12 * (round > 3 ? 10 : 1);
    const ca::Motion ma = motion(shift, q), mb = motion(shift + q * at, q * orientation);
    const std::vector<FeaturePair> found = features_of(a, ma, b, mb);
    ASSERT_EQ(static_cast<int>(found.size()), count) << "round " << round;
    for (const FeaturePair& f : found) {
      EXPECT_LT((f.normal - q * Vec3::UnitZ()).norm(), turn);
      EXPECT_EQ(std::tuple(f.kind_a, f.kind_b), std::tuple(kind_a, kind_b));
      EXPECT_NEAR(f.gap, gap, near);
      EXPECT_NEAR(f.normal.dot(f.point_b - f.point_a), f.gap, near);
      EXPECT_LT((f.point_b - f.point_a - f.gap * f.normal).norm(), near);
    }
    const std::vector<FeaturePair> swapped = features_of(b, mb, a, ma);
    ASSERT_EQ(static_cast<int>(swapped.size()), count);
    for (const FeaturePair& f : swapped) {
      EXPECT_LT((f.normal + q * Vec3::UnitZ()).norm(), turn);
      EXPECT_EQ(std::tuple(f.kind_a, f.kind_b), std::tuple(kind_b, kind_a));
    }
    const std::vector<FeaturePair> again = features_of(a, ma, b, mb);
    for (int k = 0; k < count; ++k) {
      EXPECT_EQ(again[k].point_a, found[k].point_a);
      EXPECT_EQ(std::tuple(again[k].id_a, again[k].id_b), std::tuple(found[k].id_a, found[k].id_b));
    }
    for (int k = 1; k < count; ++k) {  // sorted, nothing twice
      EXPECT_LT(std::tuple(found[k - 1].kind_a, found[k - 1].id_a, found[k - 1].kind_b, found[k - 1].id_b),
                std::tuple(found[k].kind_a, found[k].id_a, found[k].kind_b, found[k].id_b));
      for (int m = 0; m < k; ++m) EXPECT_GT((found[k].point_a - found[m].point_a).norm(), tolerance);
    }
  }
}

Quat about(const Vec3& axis, double angle) {
  return Quat(Eigen::AngleAxisd(angle, axis.normalized()));
}
const Model cube = model_of(box({1, 1, 1}));
const Model small = model_of(box({0.4, 0.3, 0.2}));
const double quarter = std::numbers::pi / 4;

TEST(Features, ASmallBoxStandsOnItsFourCorners) {
  for (const double gap : {0.0, 5e-7, -5e-7, 1e-12})
    for (const double turn : {0.0, 0.5})
      expect_contacts(cube, small, {0.1, -0.05, 0.6 + gap}, about({0, 0, 1}, turn), gap, 4, face, vertex);
}

TEST(Features, BoxesOfOneSizeStackOnFourPoints) {
  for (const double gap : {0.0, 3e-7}) {
    const ca::Motion a = motion({0, 0, 0}), b = motion({0, 0, 1 + gap});
    const std::vector<FeaturePair> found = features_of(cube, a, cube, b);
    ASSERT_EQ(found.size(), 4u);
    std::set<std::pair<double, double>> corners;
    for (const FeaturePair& f : found) {
      EXPECT_LT((f.normal - Vec3::UnitZ()).norm(), 1e-15);
      EXPECT_NEAR(f.gap, gap, 1e-15);
      corners.insert({f.point_a.x(), f.point_a.y()});
    }
    EXPECT_EQ(corners,
              (std::set<std::pair<double, double>>{{-0.5, -0.5}, {-0.5, 0.5}, {0.5, -0.5}, {0.5, 0.5}}));
  }
}

TEST(Features, EdgesAndCorners) {
  const double half = std::sqrt(0.5);
  for (const double gap : {0.0, 4e-7}) {
    // A roof below, another one across it.
    const Model beam = model_of(
        hull({{-1, 0, 0}, {1, 0, 0}, {-1, 0.5, -0.5}, {1, 0.5, -0.5}, {-1, -0.5, -0.5}, {1, -0.5, -0.5}}));
    expect_contacts(beam, cube, {0, 0, half + gap}, about({0, 1, 0}, quarter), gap, 1, edge, edge);
    // A cube on its corner.
    const Quat corner = Quat::FromTwoVectors(Vec3(1, 1, 1), -Vec3::UnitZ());
    expect_contacts(cube, cube, {0.1, 0.2, 0.5 + std::sqrt(0.75) + gap}, corner, gap, 1, face, vertex);
    // A cube on an edge: its two ends.
    expect_contacts(model_of(box({4, 4, 1})), cube, {0.1, 0.2, 0.5 + half + gap}, about({0, 1, 0}, quarter),
                    gap, 2, face, vertex);
  }
}

TEST(Features, CrossedBeamsTouchAtFourCrossings) {
  const Model along = model_of(box({3, 0.4, 0.2})), across = model_of(box({0.4, 3, 0.2}));
  for (const double gap : {0.0, 4e-7})
    expect_contacts(along, across, {0.1, 0.2, 0.2 + gap}, Quat::Identity(), gap, 4, edge, edge);
}

TEST(Features, RoundShapes) {
  const Model ball = model_of(sphere(0.3)), rod = model_of(capsule(0.1, 0.6));
  for (const double gap : {0.0, 5e-7, -5e-7}) {
    expect_contacts(cube, ball, {0.1, 0.2, 0.8 + gap}, about({1, 2, 3}, 1), gap, 1, face, vertex);
    expect_contacts(ball, ball, {0, 0, 0.6 + gap}, about({1, 2, 3}, 1), gap, 1, vertex, vertex);
    expect_contacts(cube, rod, {0.1, 0.05, 0.6 + gap}, about({0, 1, 0}, 2 * quarter), gap, 2, face,
                    vertex);                                                                     // lies
    expect_contacts(cube, rod, {0.1, 0.05, 0.9 + gap}, Quat::Identity(), gap, 1, face, vertex);  // stands
    const Model lying = model_of(
        hull({{-1, 0, 0}, {1, 0, 0}, {-1, 0.5, -0.5}, {1, 0.5, -0.5}, {-1, -0.5, -0.5}, {1, -0.5, -0.5}}));
    expect_contacts(lying, ball, {0.2, 0, 0.3 + gap}, Quat::Identity(), gap, 1, edge, vertex);
    expect_contacts(lying, rod, {0.2, 0, 0.1 + gap}, about({1, 0, 0}, 2 * quarter), gap, 1, edge, edge);
    const Model tip = model_of(hull({{0, 0, 0}, {1, 0, -1}, {-1, 1, -1}, {-1, -1, -1}}));
    expect_contacts(tip, ball, {0, 0, 0.3 + gap}, Quat::Identity(), gap, 1, vertex, vertex);
    expect_contacts(tip, rod, {0, 0, 0.1 + gap}, about({1, 0, 0}, 2 * quarter), gap, 1, vertex, edge);
    expect_contacts(tip, cube, {0.1, 0.2, 0.5 + gap}, Quat::Identity(), gap, 1, vertex, face);
  }
}

// A floor whose faces are needles, as solid and as a mere surface: the normal is a face's, never one between
// needles.
TEST(Features, NeedlesAndMeshes) {
  const TriangleMesh floor = prism({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {1e-9, -1 + 1e-7}, 1);
  for (const bool solid : {true, false})
    for (const double gap : {0.0, 5e-7}) {
      expect_contacts(model_of(floor, solid), small, {0.1, -0.3, 0.6 + gap}, about({0, 0, 1}, 0.4), gap, 4,
                      face, vertex);
      const Quat corner = Quat::FromTwoVectors(Vec3(1, 1, 1), -Vec3::UnitZ());
      expect_contacts(model_of(floor, solid), cube, {0.1, 0.2, 0.5 + std::sqrt(0.75) + gap}, corner, gap, 1,
                      face, vertex);
    }
  // An L lies on all its six corners (and perhaps on vertices that are only drawn on its face).
  const std::vector<FeaturePair> found =
      features_of(model_of(box({9, 9, 1})), motion({0, 0, -0.5}), model_of(l_prism()), motion({0, 0, 0.25}));
  for (const auto& [x, y] :
       std::vector<std::pair<double, double>>{{-0.5, -0.5}, {1, -0.5}, {1, 0}, {0, 0}, {0, 1}, {-0.5, 1}})
    EXPECT_TRUE(std::any_of(found.begin(), found.end(),
                            [&](const FeaturePair& f) {
                              return (f.point_a - Vec3(x, y, 0)).norm() < 1e-12 &&
                                     (f.normal - Vec3::UnitZ()).norm() < 1e-12;
                            }))
        << x << ", " << y;
  EXPECT_LE(found.size(), 7u);
}

}  // namespace
