// Checks certificates: is every row's claim true, and do the rows prove the answer?
//
// Nothing here uses GJK, the motion bounds or double precision: it does not matter by which formula a row was
// made, only whether it is true. All arithmetic is in long double (64 bits of mantissa or more). Its rounding
// is bounded in replay.cpp and subtracted; it is 2000 times smaller than the rounding term that chapter 1 has
// already subtracted from its gaps. Interval arithmetic would prove no more with more code.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "ch01_convex_advancement/linear.hpp"
#include "ch01_convex_advancement/query.hpp"
#include "common/shape.hpp"

namespace fc::ca {

using Long = long double;
using LongVec = Eigen::Matrix<Long, 3, 1>;

// The convex hull of points, each with a disk across its axis and a ball of its own; the whole is rounded by
// a further ball.
struct ReplayShape {
  std::vector<LongVec> points;  // m, about the centre of mass, body axes
  std::vector<Long> disks;      // m, the radius of each point's disk; empty: no disks
  std::vector<LongVec> axes;    // unit, across which the disks lie; empty: all across z
  std::vector<Long> balls;      // m, the radius of each point's own ball; empty: none
  Long radius = 0;              // m, of the ball that rounds all
  Long reach = 0;               // m, the largest distance from the centre of mass, without that ball

  LongVec axis_of(std::size_t point) const { return axes.empty() ? LongVec(LongVec::UnitZ()) : axes[point]; }
};
ReplayShape replay_shape(const Shape& shape);

// The query, as the program reads it, with the poses and velocities at its start.
struct ReplayQuery {
  const ReplayShape& shape_a;
  const ReplayShape& shape_b;
  Motion motion_a, motion_b;
  double interval;  // s
};

// The answer: a row of queries.csv.
struct ReplayAnswer {
  Status status;
  double toc;  // as a fraction of the interval
  double gap_lower, gap_upper;
};

// For a fixed n (unit, from A to B), shows that the gap along n, h seconds after t, is at least the straight
// line gap - speed h, for every h in [0, duration].
//
// A point r of a body (from its centre of mass, world axes at t) moves along n by
//   h n.v + h^2/2 n.a + h n.(w x r)  and a rest of at most  h^2/2 |n x w| |w x r| ,
// so the support function in the direction n + h (n x w) gives the whole body's farthest point after h
// seconds up to that rest. What remains of the gap above the line is concave in h: if it is >= 0 at both ends
// of a step, it is >= 0 between them. Steps are halved until both ends prove it. The error of a step shrinks with
// its square, so whatever is true by more than rounding is shown in the end.
struct ReplayProof {
  bool proved = false;
  Long reached = 0;  // s, after t: proved until here
  Long gap = 0;      // m, along n at that time
  int evaluations = 0;
};
ReplayProof prove_above(const ReplayQuery& query, const LongVec& n, Long t, Long gap, Long speed,
                        Long duration);

// One thing that is wrong: with a row of the certificate, or (row = -1) with the answer.
struct Refusal {
  int row;
  std::string what;
};

// What is wrong with a row on its own, whenever it starts; or "".
std::string replay_row(const ReplayQuery& query, const CertificateRow& row);
// What is wrong with an answer, whatever its rows say; or "".
std::string replay_answer(double interval, const ReplayAnswer& answer, bool has_rows);

// Everything that is wrong with an answer and its certificate; empty if each row is true and all of them
// together prove the pair clear from 0 to toc. The certificate does not show that the pair is within the
// tolerance at toc: features.csv has two points of the surfaces for that.
std::vector<Refusal> replay(const ReplayQuery& query, const ReplayAnswer& answer,
                            const std::vector<CertificateRow>& rows);
// The same for corners that fly straight: along a fixed n their gap is concave in time, so the two ends of a
// row prove the whole row.
std::vector<Refusal> replay(const LinearQuery& query, double interval, const ReplayAnswer& answer,
                            const std::vector<CertificateRow>& rows);

}  // namespace fc::ca
