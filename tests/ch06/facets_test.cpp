// What accuracy costs: flat sides, by a block that slides freely on a plane; sweeps and all contacts at once, by towers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ch06_friction/study/facet_study.hpp"
#include "ch06_friction/study/tower_study.hpp"

namespace fc::friction {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

TEST(Facets, TheConeStopsWhereItShouldInEveryDirection) {
  const FacetErrors errors = facet_errors({}, 16, 100);
  EXPECT_LE(errors.direction, 1e-12);
  EXPECT_NEAR(errors.shortest, 1, 1e-12);
  EXPECT_NEAR(errors.longest, 1, 1e-12);
}

// The stopping point is as (cos², sin²) of the angle: worst 12.79° off at 23.5° from a tangent, and at 45° after 1/√2
// of the way.
TEST(Facets, ABoxTurnsASlideTowardsATangent) {
  for (const double degrees : {10.0, 23.5, 45.0}) {
    const double a = degrees * kDegree, c = std::cos(a), s = std::sin(a);
    const Eigen::Vector2d stop = stopping_point({Method::boxed}, a, 2000);
    EXPECT_NEAR((stop - Eigen::Vector2d(c * c, s * s)).norm(), 0, 2e-3) << degrees;
  }
  const FacetErrors errors = facet_errors({Method::boxed}, 181, 400);
  EXPECT_NEAR(errors.direction / kDegree, 12.79, 0.02);
  EXPECT_NEAR(errors.shortest, std::sqrt(0.5), 1e-3);
}

// Four sides with a corner on each tangent brake the larger component alone, until both are equal.
TEST(Facets, APyramidOfFourTurnsItTheOtherWay) {
  const FacetErrors errors = facet_errors({Method::pyramid, 4}, 91, 200);
  EXPECT_NEAR(errors.direction / kDegree, 12.79, 0.05);
  EXPECT_NEAR(errors.longest, std::sqrt(2.0), 2e-3);
  // v = (1, 0.8): 38.66° is exact.
  const double a = std::atan(0.8);
  const Eigen::Vector2d box = stopping_point({Method::boxed}, a, 2000),
                        flat = stopping_point({Method::pyramid, 4}, a, 500);
  EXPECT_NEAR(std::atan2(box[1], box[0]) / kDegree, 32.62, 0.05);
  EXPECT_NEAR(std::atan2(flat[1], flat[0]) / kDegree, 44.29, 0.1);
}

TEST(Facets, MoreSidesAreLessWrong) {
  const double eight = facet_errors({Method::pyramid, 8}, 31, 100).direction;
  const double sixteen = facet_errors({Method::pyramid, 16}, 31, 100).direction;
  EXPECT_NEAR(eight / kDegree, 5.8, 0.2);
  EXPECT_NEAR(sixteen / kDegree, 2.8, 0.2);
}

TEST(Towers, AreCarriedAtOnceAndNotBySweeps) {
  for (const int boxes : {5, 50}) {
    double after_sweeps = 1, at_once = 1;
    for (const TowerRow& row : measure_tower(boxes)) {
      if (row.method == "sweeps" && row.steps == 200) after_sweeps = row.force_error;
      if (row.method == "together") at_once = std::min(at_once, row.looks < 600 ? row.force_error : 1);
    }
    EXPECT_LE(at_once, 1e-6) << boxes;
    EXPECT_EQ(after_sweeps < 1e-3, boxes == 5) << after_sweeps;
    EXPECT_EQ(after_sweeps > 0.5, boxes == 50) << after_sweeps;
  }
}

}  // namespace
}  // namespace fc::friction
