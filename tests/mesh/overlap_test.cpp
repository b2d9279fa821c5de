// Closed parts that share volume: counted where they do, and only there.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "common/mass_properties.hpp"
#include "tests/mesh/test_meshes.hpp"

namespace fc {
namespace {

using test::box_mesh;
using test::joined;
using test::moved;
using test::reversed;
using test::sphere_mesh;
using test::unit_cube;

int overlapping(const TriangleMesh& mesh) {
  const MeshReport report = prepare_mesh(mesh).report;
  EXPECT_TRUE(report.solid);
  return report.overlapping;
}

TriangleMesh box(double x0, double y0, double z0, double x1, double y1, double z1) {
  return box_mesh({x0, y0, z0}, {x1, y1, z1});
}

Pose at(const Vec3& where, const Quat& turn = Quat::Identity()) {
  return {turn.toRotationMatrix(), where};
}

TEST(Overlap, TwoCubesThatShareACorner) {
  const PreparedMesh two = prepare_mesh(joined(unit_cube(), box(0.5, 0.5, 0.5, 1.5, 1.5, 1.5)));
  EXPECT_EQ(two.report.overlapping, 2);
  EXPECT_NEAR(solid_mass(two.mesh, 1).mass, 2, 1e-15) << "the shared volume of 1/8 counts in each";
  EXPECT_EQ(
      two.report.text(),
      "24 triangles, 16 vertices, closed, consistently oriented, 2 components, 2 closed parts overlap (the "
      "shared volume is counted in each)");
}

TEST(Overlap, OneInsideAnother) {
  EXPECT_EQ(overlapping(joined(unit_cube(), box(0.4, 0.4, 0.4, 0.6, 0.6, 0.6))), 2);
  EXPECT_EQ(overlapping(joined(box(0.4, 0.4, 0.4, 0.6, 0.6, 0.6), unit_cube())), 2);
  EXPECT_EQ(overlapping(joined(sphere_mesh(1, 12), sphere_mesh(0.5, 8))), 2);
}

TEST(Overlap, CavitiesAndWhatLiesInThemAreNone) {
  const TriangleMesh shell = joined(sphere_mesh(3, 12), reversed(sphere_mesh(2, 10)));
  EXPECT_EQ(overlapping(shell), 0);
  EXPECT_EQ(overlapping(joined(shell, sphere_mesh(1, 8))), 0) << "a ball in a hollow shell";
  EXPECT_EQ(overlapping(joined(shell, moved(sphere_mesh(1, 8), at({1.5, 0, 0})))), 2)
      << "it sticks in the shell";
}

// The cavity is a cube from 1 to 2 in one from 0 to 3. A bar that fills a corner of the wall around it and more.
TEST(Overlap, InTheWallOfACavity) {
  const TriangleMesh hollow = joined(box(0, 0, 0, 3, 3, 3), reversed(box(1, 1, 1, 2, 2, 2)));
  EXPECT_EQ(overlapping(joined(hollow, box(1, 1, 1, 2, 2, 1.5))), 0) << "it fills half of the cavity";
  EXPECT_EQ(overlapping(joined(hollow, box(1, 1, 1.25, 2, 2, 1.5))), 0) << "it lies across the cavity";
  EXPECT_EQ(overlapping(joined(hollow, box(0.5, 0.5, 0.5, 2.5, 2.5, 2.5))), 2)
      << "its shell holds the cavity";
  EXPECT_EQ(overlapping(joined(hollow, box(1, 1, 1.25, 2.5, 2, 1.5))), 2) << "it goes through a wall";
}

TEST(Overlap, BarsThatCrossWithFlushFaces) {
  EXPECT_EQ(overlapping(joined(box(-2, -0.5, 0, 2, 0.5, 1), box(-0.5, -2, 0, 0.5, 2, 1))), 2)
      << "a plus sign";
  EXPECT_EQ(overlapping(joined(box(-2, -0.5, 0, 2, 0.5, 1), box(-0.5, -2, 0.25, 0.5, 2, 0.75))), 2);
  EXPECT_EQ(overlapping(joined(box(0, 0, 0, 3, 1, 1), box(2, 0, 0, 5, 1, 1))), 2) << "end in end";
  EXPECT_EQ(overlapping(joined(box(0, 0, 0, 3, 1, 1), box(1, 0.25, 0.25, 2, 0.75, 2))), 2)
      << "a peg in a bar";
  EXPECT_EQ(overlapping(joined(box(0, 0, 0, 1, 1, 1), box(0.25, 0.25, 0, 0.75, 0.75, 1))), 2)
      << "a filled hole";
}

TEST(Overlap, TouchingIsNone) {
  EXPECT_EQ(overlapping(joined(unit_cube(), box(0.25, 0.25, 1, 0.75, 0.75, 2))), 0) << "a face on a face";
  EXPECT_EQ(overlapping(joined(unit_cube(), box(1, 0.5, 0, 2, 1.5, 1))), 0);
  EXPECT_EQ(overlapping(joined(unit_cube(), box(1, 1, 0.5, 2, 2, 1.5))), 0) << "an edge on an edge";
  const TriangleMesh u =
      joined(joined(box(0, 0, 0, 1, 1, 3), box(2, 0, 0, 3, 1, 3)), box(1, 0.2, 0, 2, 0.8, 1));
  EXPECT_EQ(overlapping(joined(u, box(1, 0.3, 1, 2, 0.7, 2))), 0) << "a stone in a groove: four faces touch";
}

// Whatever the direction, a third of the cube's side in floats has rounded corners; touching stays touching.
TEST(Overlap, FlushPartsInFloatsAreNone) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    TriangleMesh mesh = joined(box(0, 0, 0, 1, 1, 1), box(0.1, 0.2, 1, 0.7, 0.9, 1.3));
    mesh = joined(mesh, box(1, 0.1, 0.3, 1.2, 0.8, 0.8));
    mesh = moved(mesh, at({0.3, -2.1, 4.7}, Quat(test::random_rotation(random))));
    for (Vec3& v : mesh.vertices) {
      for (double& x : v) {
        volatile float rounded = static_cast<float>(x);
        x = rounded;
      }
    }
    ASSERT_EQ(overlapping(mesh), 0) << trial;
  }
}

TEST(Overlap, ManyParts) {
  TriangleMesh chain;
  for (int i = 0; i < 40; ++i) chain = joined(chain, moved(unit_cube(), at({0.9 * i, 0, 0})));
  EXPECT_EQ(overlapping(chain), 40);
  TriangleMesh row;
  for (int i = 0; i < 40; ++i) row = joined(row, moved(unit_cube(), at({1.5 * i, 0, 0})));
  EXPECT_EQ(overlapping(row), 0);
  EXPECT_EQ(overlapping(joined(row, moved(unit_cube(), at({1.5 * 7 + 0.5, 0.5, 0.5})))), 2);
}

// Boxes on a lattice, turned together: whether two of them share volume is plain from their integers.
RC_GTEST_PROP(Overlap, AgreesWithBoxesOfIntegers, ()) {
  auto random = test::random_engine();
  std::uniform_int_distribution<int> corner(0, 5), size(1, 3), parts(2, 4);
  struct Block {
    std::array<int, 3> low, high;
  };
  std::vector<Block> blocks(parts(random));
  TriangleMesh mesh;
  for (Block& b : blocks) {
    for (int axis = 0; axis < 3; ++axis) {
      b.low[axis] = corner(random);
      b.high[axis] = b.low[axis] + size(random);
    }
    // Each with corners of its own, so that no two share an edge and count as one component.
    const TriangleMesh own =
        box_mesh(Vec3(b.low[0], b.low[1], b.low[2]), Vec3(b.high[0], b.high[1], b.high[2]));
    mesh = joined(mesh, own);
  }
  std::set<int> truth;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      bool shares = true;
      for (int axis = 0; axis < 3; ++axis)
        shares = shares && std::max(blocks[i].low[axis], blocks[k].low[axis]) <
                               std::min(blocks[i].high[axis], blocks[k].high[axis]);
      if (shares) truth.insert({static_cast<int>(i), static_cast<int>(k)});
    }
  }
  const MeshReport plain = prepare_mesh(mesh).report;
  RC_PRE(plain.components == static_cast<int>(blocks.size()) && plain.solid);
  RC_ASSERT(plain.overlapping == static_cast<int>(truth.size()));
  const TriangleMesh turned = moved(mesh, at({1, 2, 3}, Quat(test::random_rotation(random))));
  RC_ASSERT(prepare_mesh(turned).report.overlapping == static_cast<int>(truth.size()));
}

}  // namespace
}  // namespace fc
