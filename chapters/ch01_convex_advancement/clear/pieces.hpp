// Chapter 1's method in its clear form: five pieces, each of which is an exercise.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "ch01_convex_advancement/convex.hpp"
#include "ch01_convex_advancement/motion.hpp"
#include "ch01_convex_advancement/query.hpp"
#include "common/pieces.hpp"

namespace fc::ca::clear {

// 1.6: the point of a simplex that is closest to the origin.
struct ClosestPoint {
  std::array<double, 4> weight{};  // of each corner, >= 0, sum 1; 0: the corner is not needed
  Vec3 point = Vec3::Zero();       // m, sum of weight[i] * corner i
};
// simplex: 1 to 4 corners, m; flat and repeated ones, too.
using ClosestPointFunction = ClosestPoint(std::span<const Vec3> simplex);
ClosestPointFunction closest_point;

// 1.7: the distance of two convex shapes at one pose, with a bound on each side (GJK).
struct Gap {
  double lower = 0;             // m, certified: the gap along `normal`; <= 0 if no plane was found
  double upper = 0;             // m, the distance of the witness points; 0 if the cores overlap
  Vec3 normal = Vec3::UnitX();  // unit, world, from A to B
  Vec3 point_a = Vec3::Zero();  // witness points: m, world axes, from A's centre of mass
  Vec3 point_b = Vec3::Zero();
  int corners = 0;                             // of the simplex that has them: 1 vertex, 2 edge, 3 face
  std::array<SupportPoint, 4> from_a, from_b;  // where each corner came from, body axes
};
// Stops when upper - lower is at most `accuracy` (m), or no support point brings more.
using GapFunction = Gap(const Convex& a, const Convex& b, const PairPose& pose, double accuracy,
                        ClosestPointFunction* closest_point);
GapFunction gap;

// 1.8: a bound of the speed at which two bodies close in along a direction.
struct Mover {
  Vec3 velocity = Vec3::Zero();      // m/s, of the centre of mass, now
  Vec3 acceleration = Vec3::Zero();  // m/s^2, constant
  Vec3 spin = Vec3::Zero();          // rad/s, world, constant
  double reach = 0;                  // m, the largest distance of a point from the centre of mass
};
// n: unit, from A to B, world. Holds for every time from now until `duration` (s) later, in m/s; <= 0 proves that they do not
// close in along n.
using SpeedBoundFunction = double(const Vec3& n, const Mover& a, const Mover& b, double duration);
SpeedBoundFunction speed_bound;

// 1.9: the first contact of two moving convex shapes, as ca::advance promises it.
struct Pieces;
using AdvanceFunction = AdvanceResult(const Convex& a, const Motion& motion_a, const Convex& b,
                                      const Motion& motion_b, const AdvanceOptions& options,
                                      const Pieces& pieces);
AdvanceFunction advance;

// 1.10: whether the rows of a certificate prove that the pair is clear from 0 to toc (s); "" if they do, else what is wrong.
using CertificateFunction = std::string(const std::vector<CertificateRow>& rows, const Convex& a,
                                        const Motion& motion_a, const Convex& b, const Motion& motion_b,
                                        double toc);
CertificateFunction check_certificate;

struct Pieces {
  ClosestPointFunction* closest_point = clear::closest_point;
  GapFunction* gap = clear::gap;
  SpeedBoundFunction* speed_bound = clear::speed_bound;
  AdvanceFunction* advance = clear::advance;
  CertificateFunction* check_certificate = clear::check_certificate;
};
// In the order of the exercises; later chapters' slots begin with these.
std::vector<PieceSlot> slots(Pieces& pieces);

}  // namespace fc::ca::clear
