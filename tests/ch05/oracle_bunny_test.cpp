// The bunny of 69,666 triangles at rest on a floor.
#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "oracles.hpp"

namespace {

using namespace fc_test;
using fc::Quat;
using fc::Vec3;
using independent::Mesh;
using independent::Vec;

Vec3 eigen(const Vec& x) {
  return {x.x, x.y, x.z};
}

// A face of the mesh's convex hull on which a body with its centre of mass at `centre` stands, found by
// rolling: from the face that is down, over the edge beyond which the centre lies, until it lies over the
// face. It comes lower each time. Faces are found by wrapping: the next point around an edge is the one that
// no other point is beyond.
struct Face {
  Vec3 a, b, c, normal;  // anticlockwise as seen from outside; unit, outward
  double height = 0;     // m, of the centre over it
  double margin = 0;     // m, of the centre's projection inside of the nearest edge
};

Vec3 wrapped(const std::vector<Vec3>& points, const Vec3& a, const Vec3& b) {
  Vec3 best = a;
  for (const Vec3& p : points) {
    if ((b - a).cross(p - a).squaredNorm() < 1e-18) continue;
    if (best == a || (b - a).cross(best - a).dot(p - a) > 0) best = p;
  }
  return best;
}

Face face_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& centre, Vec3& over_a, Vec3& over_b) {
  Face face{a, b, c, (b - a).cross(c - a).normalized(), 0, INFINITY};
  face.height = face.normal.dot(a - centre);
  for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const double inside = face.normal.cross(q - p).normalized().dot(centre - p);
    if (inside >= face.margin) continue;
    face.margin = inside;
    over_a = p;
    over_b = q;
  }
  return face;
}

Face stable_face(const std::vector<Vec3>& points, const Vec3& centre, const Vec3& down) {
  Vec3 a = points[0];
  for (const Vec3& p : points)
    if (p.dot(down) > a.dot(down)) a = p;
  const Vec3 b = wrapped(points, a, a + down.unitOrthogonal()), c = wrapped(points, a, b);
  Vec3 over_a, over_b;
  Face face = face_of(a, b, c, centre, over_a, over_b);
  while (face.margin < 0)
    face = face_of(over_b, over_a, wrapped(points, over_b, over_a), centre, over_a, over_b);
  return face;
}

// The bunny stands on three corners: each carries the share that the centre of mass has of it (its
// barycentric coordinate), and nothing else does. It comes down flat, or tilted by 10 mrad, and then it rocks
// first. Without friction nothing stops a turn about the vertical (and constant spin between impacts makes a
// little of one): a bunny that rocked may turn slowly on its feet.
TEST(Bunny, StandsOnThreePoints) {
  FC_SKIP_WITHOUT_THE_BUNNY();
  const Mesh mesh = independent::read_obj(bunny_file);
  const independent::Solid solid = independent::make_solid(mesh, 1000);
  std::vector<Vec3> points;
  for (const Vec& x : mesh.vertices) points.push_back(eigen(x));
  const Face face = stable_face(points, eigen(solid.centroid), Vec3(0, -1, 0));
  ASSERT_GT(face.margin, 0.01) << "m: a bunny on its feet";
  const double weight = 10 * solid.mass;
  for (const double tilt : {0.0, 0.01})
    for (const double dt : kFrames) {
      const std::string with = " tilted by " + number(tilt) + " rad, with frames of " + number(dt) + " s";
      const Quat turn = Quat(Eigen::AngleAxisd(tilt, Vec3(0.6, 0.8, 0))) *
                        Quat::FromTwoVectors(face.normal, -Vec3::UnitZ());
      double lowest = INFINITY;
      for (const Vec3& p : points) lowest = std::min(lowest, (turn * p).z());
      Simulation sim(
          "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -10]\nenvelope: 1.0e-3\nshapes:\n"
          "  bunny: {mesh: bunny.obj, density: 1000}\n  floor: {box: {size: [6, 6, 1]}}\nbodies:\n"
          "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n  - {shape: bunny, position: [0, 0, " +
              number(0.002 - lowest) + "], orientation: [" + number(turn.w()) + ", " + number(turn.x()) +
              ", " + number(turn.y()) + ", " + number(turn.z()) + "]}\n",
          dt);
      const fc::RigidBody& bunny = sim.world.bodies[1].state;
      ASSERT_NEAR(bunny.mass, solid.mass, 1e-9 * solid.mass);
      const Vec3 start = bunny.position;
      double rise = 0, energy = sim.energy();
      while (sim.time() < 3) {
        sim.step();
        rise = std::max(rise, sim.energy() - energy - sim.last.correction_energy);
        energy = sim.energy();
      }
      EXPECT_LE(rise, 1e-12 * weight) << "J in a frame" << with;

      // Where it stands, and what it stands on.
      struct Push {
        Vec3 at, force;  // m, from the centre of mass; N
      };
      std::vector<Push> pushes;
      const Vec3 centre = bunny.position;
      sim.step({.impact = [&](const fc::world::ImpactRecord& r) {
        pushes.push_back({r.contact.point - centre, r.impulse.impulse / dt * r.contact.normal});
      }});
      ASSERT_GE(pushes.size(), 3U) << with;
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      for (const Push& push : pushes) {
        force += push.force;
        moment += push.at.cross(push.force);
        const Vec3 corner = bunny.orientation.conjugate() * push.at + eigen(solid.centroid);
        double share = 0;  // of the weight
        const std::array<Vec3, 3> corners{face.a, face.b, face.c};
        for (int i = 0; i < 3; ++i) {
          const Vec3 &p = corners[i], &q = corners[(i + 1) % 3], &r = corners[(i + 2) % 3];
          if ((p - corner).norm() > 1e-3) continue;
          const Vec3 over = eigen(solid.centroid) + face.height * face.normal;
          share = (q - over).cross(r - over).dot(face.normal) / (q - p).cross(r - p).dot(face.normal);
        }
        EXPECT_NEAR(push.force.z() / weight, share, 1e-6) << with;
        EXPECT_GE(push.force.z(), 0) << with;
      }
      EXPECT_LE((force - weight * Vec3::UnitZ()).norm(), 1e-6 * weight) << "N" << with;
      EXPECT_LE(moment.norm(), 1e-6 * weight * solid.reach) << "N m about the centre of mass" << with;
      double area = 0, most = 0;  // of the triangle of support, and whether the centre lies in it
      for (std::size_t i = 0; i < pushes.size(); ++i)
        for (std::size_t j = i + 1; j < pushes.size(); ++j)
          for (std::size_t k = j + 1; k < pushes.size(); ++k) {
            const Vec3 p = pushes[i].at, q = pushes[j].at, r = pushes[k].at;
            const double whole = (q - p).cross(r - p).z();
            area = std::max(area, std::abs(whole));
            const double least =
                std::min({p.cross(q).z() / whole, q.cross(r).z() / whole, r.cross(p).z() / whole});
            most = std::max(most, least);
          }
      EXPECT_GT(area, 0.01) << "m^2: three points that are not on a line" << with;
      EXPECT_GT(most, 0.01) << "the centre of mass is over them" << with;
      EXPECT_NEAR(centre.z(), face.height + 0.0005, 2e-6) << "m: gaps are in the envelope's middle" << with;

      // Ten seconds.
      const Quat settled = bunny.orientation;
      const double kinetic = sim.kinetic(), spin = bunny.spin.z();
      sim.run(10);
      EXPECT_LE((bunny.position - centre).norm(), 1e-9) << "m of drift in ten seconds" << with;
      EXPECT_LE((centre - start).head<2>().norm(), 1e-9) << "m: no force is horizontal" << with;
      const Vec3 down = settled.conjugate() * Vec3::UnitZ();
      EXPECT_LE((bunny.orientation * down).head<2>().norm() * solid.reach, 1e-9) << "m of tilt" << with;
      EXPECT_LE(sim.kinetic(), kinetic * (1 + 1e-9)) << "J" << with;
      EXPECT_NEAR(bunny.spin.z(), spin, 1e-12) << "rad/s" << with;
      EXPECT_LE(bunny.spin.head<2>().norm() + bunny.velocity.norm(), 1e-12) << with;
      EXPECT_LE(std::abs(spin), 0.1 * tilt) << "rad/s: of a turn on its feet" << with;
      if (tilt == 0) {
        EXPECT_EQ(sim.kinetic(), 0) << "J" << with;
        EXPECT_LE(bunny.orientation.angularDistance(settled) * solid.reach, 1e-9) << "m" << with;
      }
      EXPECT_EQ(sim.lost, 0) << "s" << with;
      EXPECT_GT(sim.smallest_gap, 0) << "m" << with;
    }
}

}  // namespace
