// What is prepared before any query: adjacency, convex pieces, the tree of hulls; then distances at one pose.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "ch02_hull_hierarchy/hull_model.hpp"
#include "ch02_hull_hierarchy/inside.hpp"
#include "ch02_hull_hierarchy/model_distance.hpp"
#include "tests/support/test_models.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;
using namespace fc::test;

constexpr const char* bunny_file = "/usr/share/glmark2/models/bunny.obj";

int count(const Lists& lists) {
  return static_cast<int>(lists.start.size()) - 1;
}
std::vector<int> list(const Lists& lists, int i) {
  return {lists.items.begin() + lists.start[i], lists.items.begin() + lists.start[i + 1]};
}

std::vector<std::pair<std::string, TriangleMesh>> hard_meshes() {
  Random random(7);
  return {{"cube", box_core({0.5, 0.5, 0.5})},
          {"L", l_prism()},
          {"frame with a tunnel", ring(1, 0.3, 4, 4)},
          {"ring", ring(1, 0.4, 16, 10)},
          {"thin plate", prism({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {0.1, 0.2}, 1e-5)},
          {"thin L", prism({{-0.5, -0.5}, {1, -0.5}, {1, 0}, {0, 0}, {0, 1}, {-0.5, 1}}, {-0.2, -0.3}, 1e-6)},
          {"star", star(7, 0.2)},
          {"thin star", star(5, 1e-7)},
          {"cavity", cube_with_cavity()},
          {"bumpy", bumpy_ball(random, 10)}};
}

TEST(FeatureMesh, AdjacencyOfHardMeshes) {
  for (const auto& [name, core] : hard_meshes()) {
    SCOPED_TRACE(name);
    const FeatureMesh mesh = build_feature_mesh(core, true);
    std::set<std::pair<int, int>> edges;
    for (const auto& t : core.triangles)
      for (int k = 0; k < 3; ++k) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
    ASSERT_EQ(mesh.edges.size(), edges.size());
    ASSERT_EQ(count(mesh.edge_triangles), static_cast<int>(edges.size()));
    for (int e = 0; e < count(mesh.edge_triangles); ++e) {
      const auto [i, j] = mesh.edges[e].vertex;
      EXPECT_LT(i, j);
      EXPECT_TRUE(edges.contains({i, j}));
      const std::vector<int> sides = list(mesh.edge_triangles, e);
      EXPECT_EQ(sides.size(), 2u);  // closed
      for (const int t : sides) {
        const auto& corner = mesh.triangles[t];
        EXPECT_EQ(std::count(corner.begin(), corner.end(), i) + std::count(corner.begin(), corner.end(), j),
                  2);
        const std::vector<int> back = list(mesh.triangle_edges, t);
        EXPECT_EQ(std::count(back.begin(), back.end(), e), 1);
        const Vec3 in = mesh.inward(t, e), along = mesh.vertices[j] - mesh.vertices[i];
        EXPECT_NEAR(in.norm(), 1, 1e-14);
        EXPECT_NEAR(in.dot(along.normalized()), 0, 1e-12);
        EXPECT_NEAR(in.dot(mesh.normals[t]), 0, 1e-12);
        Vec3 middle = Vec3::Zero();
        for (const int v : corner) middle += mesh.vertices[v] / 3;
        EXPECT_GT(in.dot(middle - mesh.vertices[i]), 0);
      }
      for (const int v : {i, j}) {
        const std::vector<int> back = list(mesh.vertex_edges, v);
        EXPECT_EQ(std::count(back.begin(), back.end(), e), 1);
      }
    }
    EXPECT_EQ(mesh.vertex_edges.items.size(), 2 * edges.size());
  }
  const FeatureMesh cube = build_feature_mesh(box_core({1, 1, 1}), true);
  EXPECT_EQ(std::count_if(cube.edges.begin(), cube.edges.end(), [](const Edge& e) { return e.flat; }), 6);
  EXPECT_EQ(cube.edges.size(), 18u);
}

// Every triangle in one piece; sampled points of every piece's hull lie in the solid, or on its surface.
void check_pieces(const HullModel& model, const TriangleMesh& core, int samples, int every) {
  std::vector<int> uses(core.triangles.size(), 0);
  for (const int t : model.pieces.items) ++uses.at(t);
  for (const int n : uses) ASSERT_EQ(n, 1);
  Random random(3);
  const LongPose here{Eigen::Matrix<Long, 3, 3>::Identity(), Vec<Long>::Zero()};
  const Soup<double> surface = placed<double>(core, here);
  for (int piece = 0; piece < count(model.pieces); piece += every) {
    std::set<int> vertices;
    for (const int t : list(model.pieces, piece))
      vertices.insert(core.triangles[t].begin(), core.triangles[t].end());
    for (int k = 0; k < samples; ++k) {
      Vec3 x = Vec3::Zero();
      double sum = 0;
      for (const int v : vertices) {
        const double w = std::pow(uniform(random, 0, 1), integer(random, 1, 8));
        x += w * core.vertices[v];
        sum += w;
      }
      x /= sum;
      if (windings(core, x) >= 0.5) continue;
      const Soup<double> point{{x, x, x}};
      ASSERT_LE(soup_distance(point, surface), 1e-12 * model.reach) << "piece " << piece;
    }
  }
}

TEST(ConvexPieces, AddNothingOutsideTheSolid) {
  for (const auto& [name, core] : hard_meshes()) {
    SCOPED_TRACE(name);
    check_pieces(build_hull_model(model_of(core)), core, 60, 1);
  }
  EXPECT_EQ(count(build_hull_model(model_of(box_core({1, 1, 1}))).pieces), 1);
  EXPECT_LE(count(build_hull_model(model_of(l_prism())).pieces), 8);
  EXPECT_EQ(count(build_hull_model(model_of(l_prism(), false)).pieces),
            24);  // a surface: each triangle alone
}

TEST(ConvexPieces, OfTheBunny) {
  if (!std::filesystem::exists(bunny_file)) GTEST_SKIP() << bunny_file << " is not there";
  const PreparedMesh bunny = prepare_mesh(load_mesh(bunny_file));
  ASSERT_TRUE(bunny.report.solid);
  const HullModel model = build_hull_model(model_of(bunny.mesh));
  EXPECT_LT(count(model.pieces), static_cast<int>(bunny.mesh.triangles.size()) / 2);
  check_pieces(model, bunny.mesh, 1, count(model.pieces) / 300);
}

TEST(HullTree, ParentsContainTheirChildren) {
  Random random(5);
  auto meshes = hard_meshes();
  meshes.emplace_back("large", bumpy_ball(random, 30));
  for (const auto& [name, core] : meshes) {
    SCOPED_TRACE(name);
    const HullModel model = build_hull_model(model_of(core));
    std::vector<int> leaves(count(model.pieces), 0), parents(model.tree.nodes.size(), 0);
    for (const HullNode& node : model.tree.nodes) {
      for (const Vec3& x : node.points) ASSERT_LE((x - node.center).norm(), node.radius);
      const auto top = [&](const HullNode& n, const Vec3& d) {
        double most = -1e300;
        for (const Vec3& x : n.points) most = std::max(most, d.dot(x));
        return most;
      };
      if (node.leaf()) {
        ++leaves.at(node.piece);
        for (const int t : list(model.pieces, node.piece))
          for (const int v : core.triangles[t])
            for (int k = 0; k < 10; ++k) {
              const Vec3 d = unit_vector(random);
              ASSERT_GE(top(node, d), d.dot(core.vertices[v]) - 1e-14 * model.reach);
            }
        continue;
      }
      for (const int child : {node.left, node.right}) {
        ++parents.at(child);
        for (int k = 0; k < 60; ++k) {
          const Vec3 d = unit_vector(random);
          ASSERT_GE(top(node, d), top(model.tree.nodes[child], d) - 2e-14 * model.reach);
        }
      }
    }
    for (const int n : leaves) ASSERT_EQ(n, 1);
    ASSERT_EQ(parents[0], 0);
    for (std::size_t i = 1; i < parents.size(); ++i) ASSERT_EQ(parents[i], 1);
  }
}

TEST(ModelDistance, AgainstAllPairsOfTriangles) {
  Random random(11);
  const double tolerance = 1e-6;
  for (int round = 0; round < 60; ++round) {
    const auto any = [&]() -> std::pair<TriangleMesh, bool> {
      switch (integer(random, 0, 3)) {
        case 0:
          return {bumpy_ball(random, 8), true};
        case 1:
          return {ring(1, 0.4, 12, 8), true};
        case 2:
          return {star(6, 0.3), true};
        default:
          return {triangle_soup(random, 60), false};
      }
    };
    const auto [core_a, solid_a] = any();
    const auto [core_b, solid_b] = any();
    const Model a = model_of(core_a, solid_a), b = model_of(core_b, solid_b);
    const ca::Motion ma = motion(unit_vector(random), rotation(random));
    const ca::Motion mb =
        motion(ma.position + uniform(random, 1, 2.5) * unit_vector(random), rotation(random));
    const ca::PairPose pose(ma, mb, 0);
    const double truth = soup_distance(placed<double>(core_a, long_pose(ma, 0, ma.position)),
                                       placed<double>(core_b, long_pose(mb, 0, ma.position)));
    const ModelDistance d = model_distance(a, b, pose, tolerance);
    EXPECT_LE(d.lower, truth);
    if (truth == 0) {
      EXPECT_LE(d.upper, 1e-12);
      continue;
    }
    EXPECT_GE(d.upper, truth - 1e-12);
    EXPECT_LE(d.upper - d.lower, std::max(tolerance / 16, 1e-6 * truth) + 1e-12);
    ASSERT_GE(d.nearest.a, 0);
    EXPECT_LT(d.leaf_pairs, a.boxes.leaves() * b.boxes.leaves());
    for (const double cutoff : {0.5 * truth, 2 * truth}) {
      const ModelDistance c = model_distance(a, b, pose, tolerance, cutoff);
      EXPECT_LE(c.lower, truth);
      EXPECT_GE(c.lower, std::min(cutoff, d.lower) - 1e-12);
      if (cutoff > truth) {
        EXPECT_NEAR(c.upper, d.upper, 1e-9 + 2e-6 * truth);
      }
    }
    std::size_t near = 0;
    for (const LeafPair& pair : leaf_pairs_within(a, b, pose, 1.2 * truth, tolerance))
      near += pair.gjk.lower <= 1.2 * truth;
    EXPECT_GE(near, 1u);
  }
}

TEST(Inside, WindingNumbersAndNestedBodies) {
  const TriangleMesh hollow = cube_with_cavity();
  const FeatureMesh mesh = build_feature_mesh(hollow, true);
  EXPECT_NEAR(winding_number(mesh, {0, 0, 0}), 0, 1e-12);
  EXPECT_NEAR(winding_number(mesh, {0.8, 0, 0}), 1, 1e-12);
  EXPECT_NEAR(winding_number(mesh, {1.2, 0, 0}), 0, 1e-12);
  Random random(2);
  const TriangleMesh bumpy = bumpy_ball(random, 6);
  const FeatureMesh bumpy_mesh = build_feature_mesh(bumpy, true);
  for (int k = 0; k < 200; ++k) {
    const Vec3 x = uniform(random, 0, 1.2) * unit_vector(random);
    EXPECT_NEAR(winding_number(bumpy_mesh, x), windings(bumpy, x), 1e-9);
  }
  const Model shell = model_of(hollow), block = model_of(bumpy_ball(random, 6));
  const auto inside = [](const Model& a, const Model& b, const Vec3& at) {
    return one_inside_other(a, b, ca::PairPose(motion({0, 0, 0}), motion(at), 0), 1e-6);
  };
  const Model pebble = model_of(box({0.1, 0.1, 0.1})), ball = model_of(sphere(0.05));
  for (const Model* small : {&pebble, &ball}) {
    EXPECT_FALSE(inside(shell, *small, {0, 0, 0}));
    EXPECT_TRUE(inside(shell, *small, {0.8, 0, 0}));
    EXPECT_TRUE(inside(*small, shell, {-0.8, 0, 0}));
    EXPECT_FALSE(inside(shell, *small, {0, 0, 1.3}));
    EXPECT_TRUE(inside(block, *small, {0.1, 0.1, 0}));
    EXPECT_FALSE(inside(model_of(hollow, false), *small, {0.8, 0, 0}));  // a mere surface has no inside
  }
}

}  // namespace
