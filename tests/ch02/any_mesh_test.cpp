// Any mesh, as a file may hold it: the report states the true numbers, and what collides are exactly the
// triangles of the file, whatever is wrong with it (contract 1.4).
#include <gtest/gtest.h>

#include "judge.hpp"
#include "tests/support/hard_meshes.hpp"

namespace {

using namespace fc;
using namespace fc::test;
using ca::AdvanceResult;
using ca::Status;

const Vec3 kStill = Vec3::Zero();

// What a mesh is, counted in the plainest way.
struct Wrong {
  std::string name;
  TriangleMesh mesh;
  int holes = 0, boundary_edges = 0, flipped = 0, one_sided = 0, degenerate = 0, duplicate = 0,
      components = 1, nonmanifold = 0, reversed = 0;
  bool solid = false;
};

TriangleMesh without(TriangleMesh mesh, const std::vector<int>& triangles) {  // descending
  for (const int t : triangles) mesh.triangles.erase(mesh.triangles.begin() + t);
  return mesh;
}
TriangleMesh with_flipped(TriangleMesh mesh, const std::vector<int>& triangles) {
  for (const int t : triangles) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  return mesh;
}
TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}
TriangleMesh shrunk(TriangleMesh mesh, double size) {
  for (Vec3& v : mesh.vertices) v *= size;
  return mesh;
}
TriangleMesh torn_apart(const TriangleMesh& mesh) {  // as an STL file has it
  TriangleMesh soup;
  for (const auto& [i, j, k] : mesh.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(), {mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]});
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}
TriangleMesh moebius_band(int around) {
  TriangleMesh mesh;
  for (int i = 0; i < around; ++i) {
    const double u = 2 * std::numbers::pi * i / around;
    for (const double side : {-0.4, 0.4}) {
      const double r = 1 + side * std::cos(u / 2);
      mesh.vertices.emplace_back(r * std::cos(u), r * std::sin(u), side * std::sin(u / 2));
    }
  }
  for (int i = 0; i < around; ++i) {
    const bool last = i + 1 == around;
    const int a = 2 * i, b = 2 * i + 1, c = last ? 1 : 2 * i + 2, d = last ? 0 : 2 * i + 3;
    mesh.triangles.insert(mesh.triangles.end(), {{a, c, d}, {a, d, b}});
  }
  return mesh;
}
TriangleMesh with_useless_triangles(TriangleMesh mesh) {  // 3 degenerate ones and 4 duplicates
  const auto t = mesh.triangles[0], s = mesh.triangles[5];
  const int middle = static_cast<int>(mesh.vertices.size());
  mesh.vertices.push_back((mesh.vertices[t[0]] + mesh.vertices[t[1]]) / 2);
  mesh.triangles.insert(mesh.triangles.end(),
                        {{t[0], t[0], t[1]}, {t[2], t[2], t[2]}, {s[1], s[2], s[1]}, t, s});
  mesh.triangles.insert(mesh.triangles.end(), {{t[1], t[2], t[0]}, {s[0], s[2], s[1]}});
  mesh.vertices[middle] = mesh.vertices[t[0]];  // an equal position, never used
  return mesh;
}

std::vector<Wrong> wrong_meshes() {
  const TriangleMesh tube = torus(0.7, 0.3, 16, 8), cube = box_core({0.7, 0.7, 0.7}),
                     gear_wheel = star(6, 0.4);
  const auto both = [](const TriangleMesh& a, const TriangleMesh& b) {
    return fc::test::joined(a, b, false);
  };
  const TriangleMesh small = shrunk(cube, 0.4), beside = moved_by(small, {1.3, 0, 0});
  Random random(4);
  return {
      {.name = "closed", .mesh = tube, .solid = true},
      {.name = "closed, inside out", .mesh = inside_out(tube), .reversed = 1, .solid = true},
      {.name = "closed, torn apart", .mesh = torn_apart(gear_wheel), .solid = true},
      {.name = "two holes", .mesh = without(tube, {100, 41, 40}), .holes = 2, .boundary_edges = 7},
      {.name = "a tube cut open",
       .mesh = without(tube, {15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0}),
       .holes = 2,
       .boundary_edges = 16},
      {.name = "a sheet", .mesh = tiled_floor(1.5, 5), .holes = 1, .boundary_edges = 20},
      {.name = "flipped", .mesh = with_flipped(tube, {3, 77, 78, 200}), .flipped = 4},
      {.name = "a flipped sheet",
       .mesh = with_flipped(tiled_floor(1.5, 5), {0, 20}),
       .holes = 1,
       .boundary_edges = 20,
       .flipped = 2},
      {.name = "a Moebius band", .mesh = moebius_band(24), .holes = 1, .boundary_edges = 48, .one_sided = 1},
      {.name = "useless triangles",
       .mesh = with_useless_triangles(tube),
       .degenerate = 3,
       .duplicate = 4,
       .solid = true},
      {.name = "a cavity", .mesh = both(cube, inside_out(small)), .components = 2, .solid = true},
      {.name = "a cavity, inside out",
       .mesh = both(inside_out(cube), small),
       .components = 2,
       .reversed = 2,
       .solid = true},
      {.name = "two parts",
       .mesh = both(small, moved_by(small, {0.9, 0, 0})),
       .components = 2,
       .solid = true},
      {.name = "two parts, one inside out",
       .mesh = both(small, inside_out(beside)),
       .components = 2,
       .reversed = 1,
       .solid = true},
      {.name = "a solid and a sheet",
       .mesh = both(shrunk(cube, 0.8), tiled_floor(2, 3)),
       .holes = 1,
       .boundary_edges = 12,
       .components = 2},
      {.name = "three walls at one edge",
       .mesh = {{{0, 0, -0.7}, {0, 0, 0.7}, {0.8, 0, 0}, {-0.4, 0.7, 0}, {-0.4, -0.7, 0}},
                {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}},
       .holes = 1,
       .boundary_edges = 6,
       .nonmanifold = 1},
      {.name = "a soup",
       .mesh = triangle_soup(random, 40),
       .holes = 40,
       .boundary_edges = 120,
       .components = 40},
      {.name = "one triangle",
       .mesh = {{{-0.5, -0.4, 0}, {0.6, -0.3, 0}, {0, 0.7, 0.2}}, {{0, 1, 2}}},
       .holes = 1,
       .boundary_edges = 3},
  };
}

TEST(AnyMesh, TheReportStatesTheTrueNumbers) {
  for (const Wrong& w : wrong_meshes()) {
    SCOPED_TRACE(w.name);
    const MeshReport r = prepare_mesh(w.mesh).report;
    EXPECT_EQ(r.holes, w.holes);
    EXPECT_EQ(r.boundary_edges, w.boundary_edges);
    EXPECT_EQ(r.flipped_triangles, w.flipped);
    EXPECT_EQ(r.one_sided, w.one_sided);
    EXPECT_EQ(r.degenerate_triangles, w.degenerate);
    EXPECT_EQ(r.duplicate_triangles, w.duplicate);
    EXPECT_EQ(r.components, w.components);
    EXPECT_EQ(r.nonmanifold_edges, w.nonmanifold);
    EXPECT_EQ(r.reversed_components, w.reversed);
    EXPECT_EQ(r.inside_out, w.reversed > 0);
    EXPECT_EQ(r.solid, w.solid);
    EXPECT_EQ(r.triangles,
              static_cast<int>(w.mesh.triangles.size()) - r.degenerate_triangles - r.duplicate_triangles);
    EXPECT_EQ(r.vertices + r.merged_vertices, static_cast<int>(w.mesh.vertices.size()));
  }
}

// The triangles of the file itself, not what was prepared from them, are what brute force looks at.
TEST(AnyMesh, CollidesExactlyAsItsTriangles) {
  Random random(14);
  int contacts = 0, free = 0;
  const std::vector<Wrong> meshes = wrong_meshes();
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (int round = 0; round < 4; ++round) {
      const Wrong& w = meshes[i];
      const Wrong& other = meshes[(7 * i + 5 * static_cast<std::size_t>(round)) % meshes.size()];
      SCOPED_TRACE(w.name + " and " + other.name + ", " + std::to_string(round));
      const PreparedMesh a = prepare_mesh(w.mesh), b = prepare_mesh(other.mesh);
      const Vec3 from = 2.4 * unit_vector(random);
      const ca::Motion ma = motion(kStill, rotation(random), kStill, 4 * unit_vector(random));
      const ca::Motion mb =
          motion(from, rotation(random), -1.6 * from + (round % 2 ? 0.8 : 3.5) * unit_vector(random),
                 8 * unit_vector(random), unit_vector(random));
      const AdvanceResult r =
          hulls::advance(model_of(a.mesh, a.report.solid), ma, model_of(b.mesh, b.report.solid), mb, {});
      judge(r, {{a.mesh, ma, a.report.solid}, {b.mesh, mb, b.report.solid}}, {});
      const BrutePair raw{{w.mesh, ma, false}, {other.mesh, mb, false}};
      if (r.status == Status::contact) {
        EXPECT_LE(raw.distance(r.toc), r.tolerance);
      }
      if (r.status != Status::penetrating_at_start) {
        EXPECT_TRUE(raw.prove_clear(0, r.toc).proved);
      }
      contacts += r.status == Status::contact;
      free += r.status == Status::separated;
    }
  EXPECT_GE(contacts, 30);
  EXPECT_GE(free, 5);
}

// A mesh without an inside is passed through its hole, and met from within; a solid is not.
TEST(AnyMesh, InsideIsForSolidsOnly) {
  const TriangleMesh bead = shrunk(box_core({1, 1, 1}), 0.05);
  for (const Wrong& w : wrong_meshes()) {
    SCOPED_TRACE(w.name);
    const PreparedMesh p = prepare_mesh(w.mesh);
    int inside = 0;
    for (const Vec3& place :
         {Vec3(0.7, 0, 0), Vec3(0, 0, 0.45), Vec3(0.05, 0.1, 0.12), Vec3(0, 0.7, 0), Vec3(0.9, 0, 0)}) {
      const ca::Motion here = motion(kStill), there = motion(place, Quat::Identity());
      const BrutePair truth{{p.mesh, here, p.report.solid}, {bead, there}};
      const AdvanceResult r =
          hulls::advance(model_of(p.mesh, p.report.solid), here, model_of(bead), there, {});
      const bool overlap = truth.distance(0) == 0, within = truth.inside(0, 0);
      EXPECT_EQ(r.status == Status::penetrating_at_start, overlap || within) << place.transpose();
      inside += within && !overlap;
    }
    if (!w.solid) {
      EXPECT_EQ(inside, 0);
    }
  }
}

// Two closed parts that share a wall, or only an edge or a corner.
TEST(AnyMesh, ASolidOfPartsThatTouch) {
  const TriangleMesh cube = box_core({0.5, 0.5, 0.5});
  for (const Vec3& shift : {Vec3(1, 1, 0), Vec3(1, 1, 1)}) {
    const PreparedMesh p = prepare_mesh(fc::test::joined(cube, moved_by(cube, shift), false));
    EXPECT_TRUE(p.report.solid);
    const TriangleMesh bead = shrunk(cube, 0.1);
    const auto from = [&](const Vec3& place, const Vec3& v) {
      return ask({p.mesh}, motion(kStill), bead, motion(place, Quat::Identity(), v));
    };
    EXPECT_EQ(from(shift + Vec3(0.1, 0.1, 0.1), kStill).status, Status::penetrating_at_start);
    EXPECT_EQ(from({0.1, 0.1, 0.1}, kStill).status, Status::penetrating_at_start);
    // Past the place where they touch, and into the crook there.
    EXPECT_EQ(from({0.6, 0.4, -2}, {0, 0, 1.4}).status, Status::separated);
    expect_contact(from({2.5, -0.2, 0}, {-3, 0, 0}), (2.5 - 0.5 - 0.05) / 3, 3);
  }
}

// Two closed parts that share a wall: each edge is used as often in one direction as in the other, so the
// mesh is a solid, and the wall's two sides are no duplicates.
TEST(AnyMesh, ASolidOfPartsThatShareAWall) {
  const TriangleMesh cube = box_core({0.5, 0.5, 0.5});
  TriangleMesh mirrored = inside_out(cube);
  for (Vec3& v : mirrored.vertices) v.x() = 1 - v.x();
  const PreparedMesh p = prepare_mesh(fc::test::joined(cube, mirrored, false));
  EXPECT_TRUE(p.report.solid);
  EXPECT_NEAR(signed_volume(p.mesh), 2, 1e-12);
  const TriangleMesh sliver = shrunk(cube, 1e-3);
  for (const double x : {0.3, 0.7})
    EXPECT_EQ(ask({p.mesh, p.report.solid}, motion(kStill), sliver, motion({x, 0.1, 0.1})).status,
              Status::penetrating_at_start);
}

}  // namespace
