// Boxes: that they hold what is below them, and that what four lanes of floats prove is true in long double.
#include <gtest/gtest.h>

#include "ch02_hull_hierarchy/box_steps.hpp"
#include "tests/support/free_bodies.hpp"
#include "tests/support/random_engine.hpp"
#include "tests/support/test_models.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;
using namespace fc::test;

TriangleMesh scaled(TriangleMesh mesh, double scale) {
  for (Vec3& p : mesh.vertices) p *= scale;
  return mesh;
}
TriangleMesh random_mesh(Random& random) {
  switch (integer(random, 0, 4)) {
    case 0:
      return bumpy_ball(random, 8);
    case 1:
      return ring(1, 0.3, 9, 6);
    case 2:
      return star(6, magnitude(random, 1e-7, 1));
    case 3:
      return box_core({1, 0.3, 0.01});
    default:
      return triangle_soup(random, 50);
  }
}

Vec3 lane(const Lanes3& x, int k) {
  return {x.x[k], x.y[k], x.z[k]};
}

// The points of all leaves below a box.
std::vector<Vec3> points_below(const BoxTree& tree, NodeId node) {
  const BoxQuad& quad = tree.quads[node >> 2];
  const int first = quad.first_leaf[node & 3], last = first + quad.leaf_count[node & 3];
  return {tree.points.begin() + tree.leaf_start[first], tree.points.begin() + tree.leaf_start[last]};
}
std::vector<NodeId> all_nodes(const BoxTree& tree) {
  std::vector<NodeId> nodes;
  for (int q = 0; q < static_cast<int>(tree.quads.size()); ++q)
    for (int k = 0; k < 4 && tree.quads[q].child[k] != 0; ++k) nodes.push_back(4 * q + k);
  return nodes;
}

TEST(BoxTree, BoxesHoldWhatIsBelowThem) {
  Random random(1);
  for (int round = 0; round < 60; ++round) {
    const bool convex = integer(random, 0, 4) == 0;
    const TriangleMesh mesh = scaled(random_mesh(random), magnitude(random, 1e-6, 1e6));
    const BoxTree tree = build_box_tree(build_feature_mesh(mesh, true), convex);
    std::vector<int> seen(tree.leaves(), 0);
    for (const NodeId node : all_nodes(tree)) {
      const BoxQuad& quad = tree.quads[node >> 2];
      const int k = node & 3, child = quad.child[k];
      const Vec3 u = lane(quad.axis[0], k), v = lane(quad.axis[1], k);
      Mat3 basis;
      basis << u, v, Eigen::Vector3f(u.cast<float>().cross(v.cast<float>())).cast<double>();
      ASSERT_NEAR(basis.determinant(), 1, 1e-5);
      ASSERT_LE((basis.transpose() * basis - Mat3::Identity()).cwiseAbs().maxCoeff(), 1e-6);
      const Eigen::Matrix<Long, 3, 3> inverse = basis.cast<Long>().inverse();
      for (const Vec3& p : points_below(tree, node)) {
        const Eigen::Matrix<Long, 3, 1> s = inverse * (p.cast<Long>() - lane(quad.center, k).cast<Long>());
        for (int axis = 0; axis < 3; ++axis) ASSERT_LE(std::abs(s[axis]), Long(lane(quad.half, k)[axis]));
        ASSERT_LE((p - lane(quad.center, k)).norm(), double(quad.radius[k]));
      }
      if (child < 0) {
        ++seen.at(~child);
        ASSERT_EQ(quad.first_leaf[k], ~child);
        ASSERT_EQ(quad.leaf_count[k], 1);
        continue;
      }
      int next = quad.first_leaf[k];  // the children share the leaves among them
      for (int i = 0; i < 4 && tree.quads[child].child[i] != 0; ++i) {
        ASSERT_EQ(tree.quads[child].first_leaf[i], next);
        next += tree.quads[child].leaf_count[i];
      }
      ASSERT_EQ(next, quad.first_leaf[k] + quad.leaf_count[k]);
    }
    for (const int n : seen) ASSERT_EQ(n, 1);
    if (convex) continue;
    std::vector<int> items = tree.leaf_item;
    std::sort(items.begin(), items.end());
    for (int t = 0; t < static_cast<int>(items.size()); ++t) ASSERT_EQ(items[t], t);
  }
}

RC_GTEST_PROP(BoxSteps, TheGapKeepsItsTarget, ()) {
  Random random = random_engine();
  const double size = magnitude(random, 1e-4, 1e4), speed = size * magnitude(random, 1e-2, 10);
  const auto some = [&](double most) -> Vec3 {
    if (integer(random, 0, 3) == 0) return Vec3::Zero();
    return magnitude(random, 1e-4, 1) * most * unit_vector(random);
  };
  const TriangleMesh mesh_a = scaled(random_mesh(random), size),
                     mesh_b = scaled(random_mesh(random), size * magnitude(random, 0.01, 1));
  const BoxTree a = build_box_tree(build_feature_mesh(mesh_a, true), false),
                b = build_box_tree(build_feature_mesh(mesh_b, true), false);
  ca::Motion ma = motion(some(size), rotation(random), some(speed), some(10), some(speed));
  ca::Motion mb = motion(some(3 * size), rotation(random), some(speed), some(10), some(speed));
  if (integer(random, 0, 1) == 1) add_random_effects(random, ma, mb);
  const double reach_a = ca::reach_of(mesh_a.vertices), reach_b = ca::reach_of(mesh_b.vertices);
  const double t = integer(random, 0, 1) * uniform(random, 0, 0.5), end = t + uniform(random, 0.1, 1);
  const ca::PairPose pose(ma, mb, t);
  const PairViews views = views_of(pose, ma, reach_a, mb, reach_b, t);
  const float target = static_cast<float>(size * magnitude(random, 1e-7, 1e-3));
  const std::vector<NodeId> nodes_b = all_nodes(b);
  for (int round = 0; round < 60; ++round) {
    const int quad = integer(random, 0, static_cast<int>(a.quads.size()) - 1);
    const NodeId other = nodes_b[integer(random, 0, static_cast<int>(nodes_b.size()) - 1)];
    const Eigen::Vector3f hint = unit_vector(random).cast<float>();
    const BoxSteps steps =
        box_steps(a.quads[quad], b, other, views.a, hint, {target, target, float_above(end - t)});
    Solid below_b;
    below_b.core.vertices = points_below(b, other);
    for (int k = 0; k < 4 && a.quads[quad].child[k] != 0; ++k) {
      Solid below_a;
      below_a.core.vertices = points_below(a, 4 * quad + k);
      const Vec3 n_own = lane(steps.normal, k);
      RC_ASSERT(std::abs(n_own.norm() - 1) < 1e-6);
      const Vec3 n = (views.a.rotation.transpose() * n_own).normalized();
      RC_ASSERT(true_support_gap(below_a, ma, below_b, mb, t, n) >= Long(steps.gap[k]));
      RC_ASSERT(steps.time[k] >= 0);
      RC_ASSERT(steps.time[k] == 0 || steps.gap[k] > target);
      const Long h = std::min<Long>(steps.time[k], end - t);
      for (int i = 1; i <= 10 && h > 0; ++i)
        RC_ASSERT(true_support_gap(below_a, ma, below_b, mb, Long(t) + h * i / 10, n) >= Long(target));
    }
  }
}

}  // namespace
