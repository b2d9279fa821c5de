// First contacts of meshes: closed forms, nested bodies, dense sampling over all pairs of triangles, and the
// bunny.
#include "ch02_hull_hierarchy/advance.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <stdexcept>

#include "tests/support/independent_overlap.hpp"
#include "tests/support/test_models.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;
using namespace fc::test;
using ca::Status;

ca::AdvanceOptions within(double interval, double tolerance = 1e-6) {
  ca::AdvanceOptions options;
  options.interval = interval;
  options.tolerance = tolerance;
  options.max_iterations = 1'000'000;
  return options;
}

void expect_contact(const ca::AdvanceResult& r, double truth, double speed, double tolerance = 1e-6) {
  EXPECT_EQ(r.status, Status::contact);
  EXPECT_LE(r.toc, truth);
  EXPECT_GE(r.toc, truth - 1.01 * tolerance / speed);
  EXPECT_GT(r.gap_lower, 0);
  EXPECT_LE(r.gap_upper, tolerance);
  EXPECT_GE(r.features.size(), 1u);
}

TEST(MeshAdvance, TranslationHasClosedForms) {
  const Model l = model_of(l_prism()), surface = model_of(l_prism(), false), ball = model_of(sphere(0.1));
  const auto fly = [](const Vec3& from, const Vec3& v) { return motion(from, Quat::Identity(), v); };
  for (const Model* m : {&l, &surface}) {
    // Into the crook of the L: its hull is passed long before; the face x = 0 is met at last.
    expect_contact(advance(*m, motion({0, 0, 0}), ball, fly({1.5, 0.6, 0}, {-2, 0, 0}), within(1)), 1.4 / 2,
                   2);
    // Along both of the crook's faces, and out through the open side.
    EXPECT_EQ(advance(*m, motion({0, 0, 0}), ball, fly({0.5, 0.5, 2}, {0, 0, -4}), within(1)).status,
              Status::separated);
    // Onto the crook's corner edge, diagonally: both faces at once.
    expect_contact(advance(*m, motion({0, 0, 0}), ball, fly({0.9, 0.9, 0}, {-1, -1, 0}), within(1)), 0.8, 1);
  }
  const Model frame = model_of(ring(1, 0.3, 32, 8));
  const double hole = (1 - 0.3 * std::cos(std::numbers::pi / 8)) * std::cos(std::numbers::pi / 32);
  for (const double clearance : {1e-4, 0.01, 0.5}) {
    const Model bullet = model_of(sphere(hole - clearance));
    EXPECT_EQ(advance(frame, motion({0, 0, 0}), bullet, fly({0, 0, 5}, {0, 0, -10}), within(1)).status,
              Status::separated);
  }
  EXPECT_EQ(
      advance(frame, motion({0, 0, 0}), model_of(sphere(hole + 1e-4)), fly({0, 0, 5}, {0, 0, -10}), within(1))
          .status,
      Status::contact);
  // A fast plate through a mesh's thin wall.
  const Model wall = model_of(prism({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, {0.1, 0.2}, 1e-5));
  expect_contact(advance(wall, motion({0, 0, 0}), ball, fly({0.2, 0, 500}, {0, 0, -1000}), within(1)),
                 (500 - 0.1 - 5e-6) / 1000, 1000);
}

TEST(MeshAdvance, NestedBodies) {
  const Model shell = model_of(cube_with_cavity()), open = model_of(cube_with_cavity(), false);
  const Model ball = model_of(sphere(0.1)), bumpy = [] {
    Random random(3);
    TriangleMesh mesh = bumpy_ball(random, 6);
    for (Vec3& v : mesh.vertices) v *= 0.1;
    return model_of(mesh);
  }();
  for (const Model* m : {&ball, &bumpy}) {
    const ca::AdvanceResult inside = advance(shell, motion({0, 0, 0}), *m, motion({0.8, 0, 0}), within(1));
    EXPECT_EQ(inside.status, Status::penetrating_at_start);
    EXPECT_LE(inside.gap_lower, 0);
    EXPECT_EQ(inside.gap_upper, 0);
    EXPECT_EQ(advance(*m, motion({0.8, 0, 0}), shell, motion({0, 0, 0}), within(1)).status,
              Status::penetrating_at_start);
    EXPECT_EQ(advance(shell, motion({0, 0, 0}), *m, motion({0, 0, 0}), within(1)).status,
              Status::separated);  // in the cavity
    EXPECT_EQ(advance(open, motion({0, 0, 0}), *m, motion({0.8, 0, 0}), within(1)).status, Status::separated);
  }
  expect_contact(
      advance(shell, motion({0, 0, 0}), ball, motion({0, 0, 0}, Quat::Identity(), {0, 2, 0}), within(1)),
      0.25, 2);
  const Model twin = model_of(cube_with_cavity());
  EXPECT_EQ(advance(shell, motion({0, 0, 0}), twin, motion({0, 0, 0}), within(1)).status,
            Status::penetrating_at_start);
}

TEST(MeshAdvance, WrongArgumentsThrow) {
  const Model m = model_of(l_prism());
  const ca::Motion a = motion({0, 0, 0}), b = motion({5, 0, 0});
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1.0}) {
    EXPECT_THROW(advance(m, a, m, b, within(bad)), std::invalid_argument) << bad;
    EXPECT_THROW(advance(m, a, m, b, within(1, bad)), std::invalid_argument) << bad;
    if (bad == -1) continue;
    EXPECT_THROW(advance(m, motion({0, bad, 0}), m, b, within(1)), std::invalid_argument) << bad;
    EXPECT_THROW(advance(m, a, m, motion({5, 0, 0}, Quat::Identity(), {0, 0, 0}, {bad, 0, 0}), within(1)),
                 std::invalid_argument)
        << bad;
  }
}

// Random pairs of every kind, fast spins among them, against all pairs of triangles at many times.
TEST(MeshAdvance, AgainstDenseSampling) {
  Random random(20080101);
  std::map<Status, int> seen;
  for (int round = 0; round < 120; ++round) {
    struct Body {
      TriangleMesh core;
      double radius;
      Model model;
    };
    const auto any = [&]() -> Body {
      const auto mesh = [&](const TriangleMesh& m, bool solid) { return Body{m, 0, model_of(m, solid)}; };
      switch (integer(random, 0, 5)) {
        case 0:
          return mesh(bumpy_ball(random, 6), true);
        case 1:
          return mesh(ring(1, 0.3, 10, 6), true);
        case 2:
          return mesh(star(6, 0.2), true);
        case 3:
          return mesh(triangle_soup(random, 40), false);
        case 4:
          return mesh(l_prism(), integer(random, 0, 1) == 0);
        default: {
          const Solid s = random_solid(random, 1.5);
          return {s.core, s.radius, model_of(s)};
        }
      }
    };
    const Body a = any(), b = any();
    const Vec3 apart = uniform(random, 1.2, 3) * unit_vector(random);
    const auto spin = [&] { return Vec3(magnitude(random, 0.1, 30) * unit_vector(random)); };
    const auto fall = [&] { return Vec3(integer(random, 0, 1) * 3 * unit_vector(random)); };
    const ca::Motion ma = motion(unit_vector(random), rotation(random), unit_vector(random), spin(), fall());
    const ca::Motion mb =
        motion(ma.position + apart, rotation(random),
               ma.velocity - uniform(random, 0.3, 2.5) * apart + 0.5 * unit_vector(random), spin(), fall());
    const ca::AdvanceOptions options = within(uniform(random, 0.5, 1.5), magnitude(random, 1e-9, 1e-3));
    const ca::AdvanceResult r = advance(a.model, ma, b.model, mb, options);
    ++seen[r.status];
    const auto gap = [&](double t) {
      return soup_distance(placed<double>(a.core, long_pose(ma, t, ma.position)),
                           placed<double>(b.core, long_pose(mb, t, ma.position))) -
             a.radius - b.radius;
    };
    SCOPED_TRACE("round " + std::to_string(round) + ", " + name_of(r.status));
    if (r.status == Status::penetrating_at_start) continue;  // nothing more is said
    if (r.status == Status::touching_at_start) {
      EXPECT_LE(gap(0), r.tolerance);
      continue;
    }
    for (int k = 0; k <= 30; ++k) ASSERT_GE(gap(r.toc * k / 30), 0.4 * r.tolerance) << k;
    for (int k = 6; k < 40; k += 6) ASSERT_GE(gap(r.toc * (1 - std::ldexp(1, -k))), 0.4 * r.tolerance) << k;
    const double end = gap(r.toc);
    EXPECT_LE(r.gap_lower, end + 1e-15);
    if (r.status == Status::contact) {
      EXPECT_LE(end, r.tolerance);
      EXPECT_LE(r.gap_upper, r.tolerance);
      ASSERT_FALSE(r.features.empty());
      for (const ca::FeaturePair& f : r.features) {
        EXPECT_NEAR(f.normal.norm(), 1, 1e-14);
        EXPECT_LE(std::abs(f.gap), r.tolerance);
        EXPECT_LT((f.point_b - f.point_a - f.gap * f.normal).norm(), 1e-2 * r.tolerance + 1e-12);
      }
    } else {
      EXPECT_EQ(r.status, Status::separated);
    }
    const ca::AdvanceResult again = advance(a.model, ma, b.model, mb, options);
    EXPECT_EQ(again.toc, r.toc);
    EXPECT_EQ(again.features.size(), r.features.size());
  }
  EXPECT_GE(seen[Status::contact], 40);
  EXPECT_GE(seen[Status::separated], 5);
}

// Bunny against bunny: by a mesh reader, a tree and a triangle test that share nothing with the engine.
TEST(MeshAdvance, Bunnies) {
  const char* file = "/usr/share/glmark2/models/bunny.obj";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  const independent::Solid solid = independent::make_solid(independent::read_obj(file), 1);
  const PreparedMesh bunny = prepare_mesh(load_mesh(file));
  TriangleMesh centred = bunny.mesh;
  const Vec3 centroid(solid.centroid.x, solid.centroid.y, solid.centroid.z);
  for (Vec3& v : centred.vertices) v -= centroid;
  const Model model = model_of(centred);
  Random random(42);
  int contacts = 0;
  for (int round = 0; round < 60; ++round) {
    const bool close = round % 3 == 0;
    const Vec3 way = unit_vector(random);
    const double reach = model.reach;
    const Vec3 va = 0.2 * reach * unit_vector(random);
    const ca::Motion ma =
        motion(Vec3::Zero(), rotation(random), va, uniform(random, 0, 4) * unit_vector(random));
    const ca::Motion mb = motion((close ? 1.2 : 2.2) * reach * way, rotation(random),
                                 va - 1.5 * reach * way + 0.4 * reach * unit_vector(random),
                                 uniform(random, 0, 4) * unit_vector(random));
    const ca::AdvanceResult r = advance(model, ma, model, mb, within(1.5));
    SCOPED_TRACE("round " + std::to_string(round) + ", " + name_of(r.status));
    const auto state = [&](const ca::Motion& m, double t, const Vec3& push) {
      const Quat q(m.rotation_at(t));
      const Vec3 p = m.position_at(t) - q * centroid + push;
      return independent::State{{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}, {}, {}, {}};
    };
    const auto overlap = [&](double t, const Vec3& push) {
      return independent::overlap(solid, state(ma, t, Vec3::Zero()), solid, state(mb, t, push));
    };
    if (r.status == Status::penetrating_at_start) {
      EXPECT_TRUE(overlap(0, Vec3::Zero()));
      continue;
    }
    ASSERT_TRUE(r.status == Status::contact || r.status == Status::separated);
    for (int k = 1; k <= 20; ++k) ASSERT_FALSE(overlap(r.toc * k / 20, Vec3::Zero())) << k;
    if (r.status == Status::separated) continue;
    ++contacts;
    EXPECT_LE(r.gap_upper, 1e-6);
    EXPECT_GT(r.gap_lower, 0);
    ASSERT_FALSE(r.features.empty());
    EXPECT_TRUE(overlap(r.toc, -2e-6 * r.features[0].normal));  // it is a contact: 2 um nearer they overlap
  }
  EXPECT_GE(contacts, 20);
}

// A gap between half the tolerance and all of it, large for the bodies: at the start the pair is not advanced but
// opened.
TEST(MeshAdvance, BodiesSmallerThanTheToleranceTouchAtTheStart) {
  TriangleMesh grain = l_prism();
  for (Vec3& p : grain.vertices) p *= 1e-7;
  const Model a = model_of(grain);
  for (const double gap : {0.6e-6, 0.8e-6, 0.99e-6}) {
    const ca::AdvanceResult r = advance(
        a, motion({0, 0, 0}), a, motion({1.5e-7 + gap, 0, 0}, Quat::Identity(), {-1, 0, 0}), within(1));
    EXPECT_EQ(r.status, Status::touching_at_start);
  }
}

// The leaves that met last only bound how late the answer can be: it stays the same, whether or not they meet again.
TEST(FirstReach, CoherentQueriesHaveTheSameAnswers) {
  Random random(17);
  const Model a = model_of(bumpy_ball(random, 12)), b = model_of(ring(1, 0.3, 20, 9));
  SearchMemory coherent, plain;
  coherent.coherent = true;
  int hits = 0, again = 0;
  for (int round = 0; round < 40; ++round) {
    const Vec3 from = 2.6 * unit_vector(random), aim = 0.9 * unit_vector(random);
    const Quat turned = rotation(random);
    const Vec3 spin_a = uniform(random, 0, 2) * unit_vector(random),
               spin_b = uniform(random, 0, 2) * unit_vector(random);
    for (int frame = 0; frame < 4; ++frame) {  // nearly the same query, and at last another one
      const Vec3 shift = frame < 3 ? Vec3(1e-3 * frame * Vec3::UnitX()) : Vec3(unit_vector(random));
      const ca::Motion ma = motion(shift, Quat::Identity(), Vec3::Zero(), spin_a);
      const ca::Motion mb = motion(from, turned, aim - from, spin_b);
      TocOptions options;
      options.start = options.tolerance;
      const int last_a = coherent.last_a, last_b = coherent.last_b;
      const TimeOfContact x = time_of_contact(a, ma, b, mb, options, coherent),
                          y = time_of_contact(a, ma, b, mb, options, plain);
      ASSERT_EQ(x.status, y.status);
      if (x.status != TimeOfContact::Status::reached) continue;
      ++hits;
      again += coherent.last_a == last_a && coherent.last_b == last_b;
      options.target /= 64;
      options.slack /= 64;
      options.start = -1;
      ASSERT_LE(x.time, time_of_contact(a, ma, b, mb, options, plain).time);
      ASSERT_LE(x.pair.gjk.upper, options.tolerance);
      ASSERT_LE(x.node_pairs, y.node_pairs + 4 * 12);
    }
  }
  EXPECT_GT(hits, 60);
  EXPECT_GT(again, 20);
}

}  // namespace
