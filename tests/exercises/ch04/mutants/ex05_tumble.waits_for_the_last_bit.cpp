// Caught by: Ex05Tumble.SolvesToRoundingAndThenStops
// Goes on until nothing changes any more; but the last bit goes to and fro.
#include "ex05_tumble.hpp"

#include <Eigen/LU>
#include <limits>

namespace fc::exercises {
namespace {

constexpr int kMostRounds = 60;
// A change by so many roundings of |L| is none: in the last bit the rounds may go to and fro for ever.
constexpr double kConverged = 0;

Mat3 cross_matrix(const Vec3& w) {
  Mat3 m;
  m << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return m;
}

}  // namespace

int step(Tumbler& body, double h) {
  // A fixed point: in the long run each round leaves a third of the error or less, since |h w| is at most 0.5.
  // (The first rounds may enlarge it, by as much as one moment is larger than another.)
  const double rounding = std::numeric_limits<double>::epsilon() * body.momentum.norm();
  Vec3 next = body.momentum, spin = Vec3::Zero();
  int rounds = 0;
  for (double change = 1; rounds < kMostRounds && change > kConverged * rounding; ++rounds) {
    const Vec3 middle = 0.5 * (body.momentum + next);
    spin = middle.cwiseQuotient(body.moments);
    const Vec3 better = body.momentum + h * middle.cross(spin);
    change = (better - next).norm();
    next = better;
  }
  // L1 - L0 = -h wm x (L0 + L1)/2 says that L1 = C' L0 with C = (1 - W)^-1 (1 + W), W = h/2 [wm]x: Cayley's
  // rotation. So R1 = R0 C keeps R L.
  const Mat3 half = 0.5 * h * cross_matrix(spin), one = Mat3::Identity();
  body.rotation = body.rotation * ((one - half).inverse() * (one + half));
  body.momentum = next;
  return rounds;
}

}  // namespace fc::exercises
