// Holds any answer of chapter 2 to brute force: what contract 1.5 promises, statement by statement.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "ch02_hull_hierarchy/advance.hpp"
#include "tests/support/brute_mesh.hpp"

namespace fc::test {

struct Body {
  TriangleMesh mesh;
  bool solid = true;
  double radius = 0;  // m, rounding: then the mesh is a convex core

  Body(TriangleMesh m, bool is_solid = true) : mesh(std::move(m)), solid(is_solid) {}
  Body(const Solid& convex) : mesh(convex.core), radius(convex.radius), convex_(true) {}
  const hulls::Model& model() const {  // built once
    if (!model_)
      model_ =
          std::make_shared<hulls::Model>(convex_ ? model_of(Solid{"", mesh, radius}) : model_of(mesh, solid));
    return *model_;
  }

 private:
  bool convex_ = false;
  mutable std::shared_ptr<const hulls::Model> model_;
};

struct Question {
  double tolerance = 1e-6;  // m
  double interval = 1;      // s
  int max_iterations = 10'000'000;
};

// Whether a point in the world lies on the surface, up to `near` (m).
inline bool on_surface(const BruteBody& body, Long t, const Vec3& origin, const Vec3& point, Long near) {
  const LongPose pose = long_pose(body.motion, t, origin);
  const Vec<Long> x = point.cast<Long>() - origin.cast<Long>();
  for (int k = 0; k < static_cast<int>(body.mesh.triangles.size()); ++k)
    if (std::abs(triangles_apart({x, x, x}, body.triangle(k, pose)).distance - body.radius) <= near)
      return true;
  return false;
}

// Features of a contact: on the surfaces, at most the tolerance apart along a unit normal from A to B, where
// their numbers say, no two the same; and one of them stops the approach.
inline void judge_features(const ca::AdvanceResult& r, const BrutePair& truth) {
  const BruteBody &a = truth.a(), &b = truth.b();
  const Vec3 origin = a.motion.position;
  const LongPose pose_a = long_pose(a.motion, r.toc, origin), pose_b = long_pose(b.motion, r.toc, origin);
  const double size = a.reach + b.reach + (origin.norm() + b.motion.position.norm()) +
                      r.toc * (a.motion.velocity.norm() + b.motion.velocity.norm());
  const double rounding = 1e-13 * size + 1e-2 * r.tolerance;
  ASSERT_FALSE(r.features.empty());
  double fastest = -std::numeric_limits<double>::infinity(), scale = 0;
  for (std::size_t i = 0; i < r.features.size(); ++i) {
    const ca::FeaturePair& f = r.features[i];
    EXPECT_NEAR(f.normal.norm(), 1, 1e-14);
    EXPECT_LE(std::abs(f.gap), r.tolerance);
    if (r.status == ca::Status::contact) {
      EXPECT_GT(f.gap, 0);
    }
    EXPECT_LT((f.point_b - f.point_a - f.gap * f.normal).norm(), rounding);
    EXPECT_TRUE(on_surface(a, r.toc, origin, f.point_a, rounding));
    EXPECT_TRUE(on_surface(b, r.toc, origin, f.point_b, rounding));
    const auto where = [&](ca::FeatureKind kind, int id, const BruteBody& body, const LongPose& pose,
                           const Vec3& core) {
      const Vec<Long> x = core.cast<Long>() - origin.cast<Long>();
      if (kind == ca::FeatureKind::vertex) {
        ASSERT_LT(id, static_cast<int>(body.mesh.vertices.size()));
        EXPECT_LE((pose * body.mesh.vertices[id] - x).norm(), rounding);
      } else if (kind == ca::FeatureKind::face) {
        ASSERT_LT(id, static_cast<int>(body.mesh.triangles.size()));
        EXPECT_LE(triangles_apart({x, x, x}, body.triangle(id, pose)).distance, rounding + 1e-9 * body.reach);
      }
    };
    where(f.kind_a, f.id_a, a, pose_a, f.point_a - static_cast<double>(a.radius) * f.normal);
    where(f.kind_b, f.id_b, b, pose_b, f.point_b + static_cast<double>(b.radius) * f.normal);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_FALSE((f.point_a - r.features[k].point_a).norm() <= r.tolerance &&
                   (f.normal - r.features[k].normal).norm() < 1e-6)
          << "features " << k << " and " << i << " say the same";
    const auto speed = [&](const BruteBody& body, const LongPose& pose, const Vec3& point) -> Vec3 {
      const Vec3 arm = (point.cast<Long>() - origin.cast<Long>() - pose.position).cast<double>();
      return body.motion.velocity + r.toc * body.motion.acceleration + body.motion.spin.cross(arm);
    };
    const Vec3 va = speed(a, pose_a, f.point_a), vb = speed(b, pose_b, f.point_b);
    fastest = std::max(fastest, f.normal.dot(va - vb));
    scale = std::max(scale, va.norm() + vb.norm());
  }
  if (r.status == ca::Status::contact) {
    EXPECT_GE(fastest, -1e-3 * scale) << "no feature approaches";
  }
}

inline void judge(const ca::AdvanceResult& r, const BrutePair& truth, const Question& question) {
  SCOPED_TRACE(std::string("judged: ") + ca::name_of(r.status) + ", toc " + std::to_string(r.toc));
  const BruteBody &a = truth.a(), &b = truth.b();
  const double size = a.reach + b.reach + (b.motion.position - a.motion.position).norm() +
                      question.interval * (a.motion.velocity - b.motion.velocity).norm();
  EXPECT_GE(r.tolerance, question.tolerance);
  EXPECT_LE(r.tolerance, std::max(question.tolerance, 1e-12 * size));
  EXPECT_TRUE(std::isfinite(r.gap_lower) && std::isfinite(r.gap_upper));
  const double rounding = 1e-14 * size;
  if (r.status == ca::Status::penetrating_at_start) {
    EXPECT_EQ(r.toc, 0);
    EXPECT_LE(r.gap_lower, 0);
    EXPECT_EQ(r.gap_upper, 0);
    EXPECT_TRUE(truth.distance(0) <= 0 || truth.inside(0, 0));
    return;
  }
  ASSERT_FALSE(truth.inside(0, r.tolerance)) << "a part of one starts inside the other";
  const Long gap = truth.distance(r.toc);
  EXPECT_LE(r.gap_lower, gap + rounding);
  EXPECT_GE(r.gap_upper, gap - rounding);
  if (r.status == ca::Status::touching_at_start) {
    EXPECT_EQ(r.toc, 0);
    EXPECT_LE(gap, r.tolerance);
    judge_features(r, truth);
    return;
  }
  if (r.status == ca::Status::separated) {
    EXPECT_EQ(r.toc, question.interval);
  }
  const Proof proof = truth.prove_clear(0, r.toc);
  EXPECT_TRUE(proof.proved) << "distance " << static_cast<double>(proof.distance) << " m at "
                            << static_cast<double>(proof.time) << " s, after " << proof.looks << " looks";
  if (r.status != ca::Status::contact) return;
  EXPECT_GT(r.gap_lower, 0);
  EXPECT_LE(r.gap_upper, r.tolerance);
  EXPECT_LE(gap, r.tolerance);
  judge_features(r, truth);
}

// The answer, judged; and again the same when asked again.
inline ca::AdvanceResult ask(const Body& a, const ca::Motion& motion_a, const Body& b,
                             const ca::Motion& motion_b, const Question& question = {}) {
  ca::AdvanceOptions options;
  options.interval = question.interval;
  options.tolerance = question.tolerance;
  options.max_iterations = question.max_iterations;
  const hulls::Model &model_a = a.model(), &model_b = b.model();
  const ca::AdvanceResult r = hulls::advance(model_a, motion_a, model_b, motion_b, options);
  judge(r, {{a.mesh, motion_a, a.solid, a.radius}, {b.mesh, motion_b, b.solid, b.radius}}, question);
  const ca::AdvanceResult again = hulls::advance(model_a, motion_a, model_b, motion_b, options);
  EXPECT_EQ(again.status, r.status);
  EXPECT_EQ(again.toc, r.toc);
  EXPECT_EQ(again.features.size(), r.features.size());
  return r;
}

// A contact, not later than the truth (s), and by no more earlier than the tolerance allows at this speed
// (m/s).
inline void expect_contact(const ca::AdvanceResult& r, double truth, double closing_speed) {
  EXPECT_EQ(r.status, ca::Status::contact);
  EXPECT_LE(r.toc, truth * (1 + 1e-14));
  EXPECT_GE(r.toc, truth - 1.001 * r.tolerance / closing_speed - 1e-13 * truth);
}

}  // namespace fc::test
