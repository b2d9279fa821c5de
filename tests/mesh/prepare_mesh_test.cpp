// prepare_mesh: what it removes, turns and counts.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/mesh/test_meshes.hpp"

namespace fc {
namespace {

using test::box_mesh;
using test::joined;
using test::reversed;
using test::unit_cube;

TEST(PrepareMesh, CleanCubeIsKeptAsItIs) {
  const PreparedMesh p = prepare_mesh(unit_cube());
  EXPECT_EQ(p.mesh.vertices, unit_cube().vertices);
  EXPECT_EQ(p.mesh.triangles, unit_cube().triangles);
  EXPECT_TRUE(p.report.solid);
  EXPECT_FALSE(p.report.inside_out);
  EXPECT_EQ(p.report.text(), "12 triangles, 8 vertices, closed, consistently oriented, 1 component");
}

TEST(PrepareMesh, MergesExactlyEqualPositionsOnly) {
  TriangleMesh soup = test::torn_apart(unit_cube());
  for (Vec3& v : soup.vertices) {
    if (v.x() == 0) v.x() = (&v - soup.vertices.data()) % 2 ? -0.0 : 0.0;
  }
  const PreparedMesh p = prepare_mesh(soup);
  EXPECT_EQ(p.report.vertices, 8);
  EXPECT_EQ(p.report.merged_vertices, 28);
  EXPECT_TRUE(p.report.solid);

  TriangleMesh apart = test::torn_apart(unit_cube());
  apart.vertices[0].y() += 1e-300;  // not merged: the mesh opens there
  const MeshReport report = prepare_mesh(apart).report;
  EXPECT_EQ(report.vertices, 9);
  EXPECT_FALSE(report.solid);
}

TEST(PrepareMesh, RemovesDegenerateTrianglesAndUnusedVertices) {
  TriangleMesh mesh = unit_cube();
  mesh.vertices.emplace_back(5, 5, 5);  // never used
  mesh.vertices.emplace_back(1, 1, 1);  // again
  mesh.triangles.push_back({3, 7, 9});  // two equal corners after merging
  mesh.triangles.push_back({2, 2, 5});
  const PreparedMesh p = prepare_mesh(mesh);
  EXPECT_EQ(p.mesh.triangles, unit_cube().triangles);
  EXPECT_EQ(p.report.degenerate_triangles, 2);
  EXPECT_EQ(p.report.merged_vertices, 2);
  EXPECT_TRUE(p.report.solid);
}

TEST(PrepareMesh, RemovesCollinearTrianglesThatRoundingHides) {
  // The corners are exactly on one line, although the differences round.
  TriangleMesh mesh;
  const double u = std::ldexp(1.0, -52);
  mesh.vertices = {{1, 1, 1}, {1 + u, 1 + u, 1 + u}, {3, 3, 3}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}};
  const PreparedMesh p = prepare_mesh(mesh);
  EXPECT_EQ(p.report.degenerate_triangles, 1);
  EXPECT_EQ(p.report.triangles, 2);
  // A sliver that is a triangle, if only just, stays.
  mesh.vertices[1].x() += u;
  EXPECT_EQ(prepare_mesh(mesh).report.degenerate_triangles, 0);
}

TEST(PrepareMesh, CollinearTriangleStillJoinsEdges) {
  // A tetrahedron with a vertex 4 in the middle of its edge 0-1; on one side of the edge the face is split
  // there, on the other it is not, and the triangle (0, 4, 1) of area zero joins the two. Nothing leaks.
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}};
  mesh.triangles = {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 1, 4}, {1, 2, 3}, {0, 3, 2}};
  const PreparedMesh p = prepare_mesh(mesh);
  EXPECT_TRUE(p.report.solid);
  EXPECT_EQ(p.report.degenerate_triangles, 1);
  EXPECT_EQ(p.report.triangles, 5);
  EXPECT_EQ(p.report.boundary_edges, 0);
  EXPECT_DOUBLE_EQ(signed_volume(p.mesh), 8.0 / 6);
}

TEST(PrepareMesh, RemovesDuplicatesInEitherOrientation) {
  TriangleMesh mesh = unit_cube();
  mesh.triangles.push_back({4, 6, 0});
  mesh.triangles.push_back({3, 1, 7});  // reversed
  const PreparedMesh p = prepare_mesh(mesh);
  EXPECT_EQ(p.report.duplicate_triangles, 2);
  EXPECT_EQ(p.mesh.triangles, unit_cube().triangles);
  EXPECT_TRUE(p.report.solid);
}

TEST(PrepareMesh, CountsHolesAndBoundaryEdges) {
  TriangleMesh mesh = unit_cube();
  mesh.triangles.erase(mesh.triangles.begin() + 10,
                       mesh.triangles.end());        // the side +z: one hole of 4 edges
  mesh.triangles.erase(mesh.triangles.begin() + 8);  // half of -z: a hole of 3 edges
  const MeshReport report = prepare_mesh(mesh).report;
  EXPECT_EQ(report.holes, 2);
  EXPECT_EQ(report.boundary_edges, 7);
  EXPECT_FALSE(report.solid);
  EXPECT_EQ(report.text(),
            "9 triangles, 8 vertices, a surface without an inside, 1 component, 2 holes, 7 boundary edges");
}

TEST(PrepareMesh, ReportsFlippedTriangles) {
  TriangleMesh mesh = unit_cube();
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  const PreparedMesh p = prepare_mesh(mesh);
  EXPECT_EQ(p.report.flipped_edges, 3);
  EXPECT_FALSE(p.report.solid);
  EXPECT_EQ(p.mesh.triangles, mesh.triangles);  // reported, not mended
}

TEST(PrepareMesh, CountsNonManifoldEdges) {
  TriangleMesh mesh = unit_cube();
  mesh.vertices.emplace_back(2, 2, 2);
  mesh.triangles.push_back({1, 7, 8});  // a fin on the diagonal of +x
  const MeshReport fin = prepare_mesh(mesh).report;
  EXPECT_EQ(fin.nonmanifold_edges, 1);
  EXPECT_EQ(fin.boundary_edges, 2);
  EXPECT_EQ(fin.components, 1);
  EXPECT_FALSE(fin.solid);

  // Two cubes that share an edge only: four triangles there, and still a solid.
  const MeshReport two = prepare_mesh(joined(unit_cube(), box_mesh({1, 1, 0}, {2, 2, 1}))).report;
  EXPECT_EQ(two.nonmanifold_edges, 1);
  EXPECT_TRUE(two.solid);
}

TEST(PrepareMesh, FlatClosedSurfaceHasNoInside) {
  TriangleMesh flat;  // a tetrahedron pressed into a plane
  flat.vertices = {{0, 0, 0.1}, {1, 0, 0.1}, {1, 1, 0.1}, {0, 1, 0.1}};
  flat.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  // Tilted, its volume in doubles is no longer exactly zero, but only rounding.
  flat = test::moved(flat, {Quat(0.3, -1, 2, 0.5).normalized().toRotationMatrix(), Vec3(1, 2, 3)});
  const MeshReport report = prepare_mesh(flat).report;
  EXPECT_EQ(report.boundary_edges, 0);
  EXPECT_FALSE(report.solid);
}

TEST(PrepareMesh, TurnsAnInsideOutMesh) {
  const PreparedMesh p = prepare_mesh(reversed(unit_cube()));
  EXPECT_TRUE(p.report.inside_out);
  EXPECT_TRUE(p.report.solid);
  EXPECT_EQ(p.mesh.triangles, unit_cube().triangles);
  EXPECT_EQ(
      p.report.text(),
      "12 triangles, 8 vertices, closed, consistently oriented, 1 component, 1 inside-out component turned");
}

TEST(PrepareMesh, KeepsCavities) {
  const TriangleMesh hollow =
      joined(box_mesh({0, 0, 0}, {3, 3, 3}), reversed(box_mesh({1, 1, 1}, {2, 2, 2})));
  const PreparedMesh p = prepare_mesh(hollow);
  EXPECT_TRUE(p.report.solid);
  EXPECT_FALSE(p.report.inside_out);
  EXPECT_EQ(p.report.components, 2);
  EXPECT_DOUBLE_EQ(signed_volume(p.mesh), 26);

  const PreparedMesh turned = prepare_mesh(reversed(hollow));  // all of it inside out
  EXPECT_EQ(turned.report.reversed_components, 2);
  EXPECT_EQ(turned.mesh.triangles, hollow.triangles);
}

TEST(PrepareMesh, TurnsAComponentThatCannotBeACavity) {
  const TriangleMesh right = joined(box_mesh({0, 0, 0}, {3, 3, 3}), box_mesh({5, 0, 0}, {6, 1, 1}));
  const TriangleMesh small_wrong =
      joined(box_mesh({0, 0, 0}, {3, 3, 3}), reversed(box_mesh({5, 0, 0}, {6, 1, 1})));
  const TriangleMesh large_wrong =
      joined(reversed(box_mesh({0, 0, 0}, {3, 3, 3})), box_mesh({5, 0, 0}, {6, 1, 1}));
  for (const TriangleMesh& wrong : {small_wrong, large_wrong}) {
    const PreparedMesh p = prepare_mesh(wrong);
    EXPECT_EQ(p.report.reversed_components, 1);
    EXPECT_EQ(p.mesh.triangles, right.triangles);
  }
}

// Shuffled, torn apart, turned and moved: the same mesh is found again.
RC_GTEST_PROP(PrepareMesh, FindsTheSameMeshHoweverItIsWritten, ()) {
  auto random = test::random_engine();
  const TriangleMesh sphere = test::sphere_mesh(1, *rc::gen::inRange(3, 12));
  TriangleMesh soup = test::torn_apart(*rc::gen::arbitrary<bool>() ? test::reversed(sphere) : sphere);
  std::shuffle(soup.triangles.begin(), soup.triangles.end(), random);
  const PreparedMesh p = prepare_mesh(soup);
  RC_ASSERT(p.report.solid);
  RC_ASSERT(p.mesh.vertices.size() == sphere.vertices.size());
  RC_ASSERT(test::closed_and_oriented(p.mesh));
  RC_ASSERT(std::abs(signed_volume(p.mesh) - signed_volume(sphere)) < 1e-13);
  const PreparedMesh again = prepare_mesh(p.mesh);
  RC_ASSERT(again.mesh.vertices == p.mesh.vertices);
  RC_ASSERT(again.mesh.triangles == p.mesh.triangles);
}

// Random triangles taken out: the counts of edges agree with counting them one pair at a time.
RC_GTEST_PROP(PrepareMesh, EdgeCountsAgreeWithBruteForce, ()) {
  auto random = test::random_engine();
  TriangleMesh mesh = test::sphere_mesh(1, 6);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  mesh.triangles.resize(mesh.triangles.size() - *rc::gen::inRange(0, 60));
  for (int i = 0; i < 5; ++i) std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  int boundary = 0, flipped = 0;
  const int n = static_cast<int>(mesh.triangles.size());
  for (int t = 0; t < n; ++t) {
    for (int i = 0; i < 3; ++i) {
      const int from = mesh.triangles[t][i], to = mesh.triangles[t][(i + 1) % 3];
      bool lonely = true;
      for (int s = 0; s < n; ++s) {
        for (int k = 0; k < 3; ++k) {
          const int f = mesh.triangles[s][k], o = mesh.triangles[s][(k + 1) % 3];
          if (s != t && ((f == to && o == from) || (f == from && o == to))) lonely = false;
          if (s > t && f == from && o == to) ++flipped;
        }
      }
      boundary += lonely;
    }
  }
  const MeshReport report = prepare_mesh(mesh).report;
  RC_ASSERT(report.boundary_edges == boundary);
  RC_ASSERT(report.flipped_edges == flipped);
  RC_ASSERT((report.holes > 0) == (boundary > 0));
  RC_ASSERT(!report.solid);
}

TEST(PrepareMesh, BunnyIsOneSolid) {
  if (!std::filesystem::exists(test::kBunny)) GTEST_SKIP() << "skipped: no " << test::kBunny;
  const PreparedMesh p = prepare_mesh(load_mesh(test::kBunny));
  EXPECT_EQ(p.report.text(), "69,666 triangles, 34,835 vertices, closed, consistently oriented, 1 component");
  EXPECT_TRUE(test::closed_and_oriented(p.mesh));
}

}  // namespace
}  // namespace fc
