#include "ch01_convex_advancement/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <functional>
#include <limits>

namespace fc::ca {
namespace {

static_assert(LDBL_MANT_DIG >= 64, "a replay in the program's own precision proves little");

constexpr int kMostEvaluations = 100'000;  // for one row; usually one or two suffice
// The error of a sum of a few dozen products of rotations, vectors and poses, as a share of the summed sizes.
constexpr Long kRounding = 64 * LDBL_EPSILON;
constexpr double kUnit = 16 * DBL_EPSILON;  // a unit vector that was turned has length 1 up to this
constexpr double kChain = 4 * DBL_EPSILON;  // two times that are meant to be the same may differ by this

// R^T d, where R turns the body's axes into the world's at t.
LongVec in_body_axes(const Motion& m, Long t, LongVec d) {
  const LongVec spin = m.spin.cast<Long>();
  const Long rate = spin.norm();
  if (rate > 0) {
    const LongVec axis = spin / rate;
    const Long s = std::sin(-rate * t), half = std::sin(rate * t / 2);
    d += s * axis.cross(d) + 2 * half * half * axis.cross(axis.cross(d));
  }
  return m.rotation.cast<Long>().transpose() * d;
}

// max d.x over the core; d in body axes, of any length.
Long support_value(const ReplayShape& shape, const LongVec& d) {
  Long most = -std::numeric_limits<Long>::infinity();
  for (std::size_t i = 0; i < shape.points.size(); ++i) {
    Long value = d.dot(shape.points[i]);
    if (!shape.disks.empty())
      value += shape.disks[i] * (d - d.dot(shape.axis_of(i)) * shape.axis_of(i)).norm();
    if (!shape.balls.empty()) value += shape.balls[i] * d.norm();
    most = std::max(most, value);
  }
  return most;
}

// No smaller than the core's largest distance from the line through the centre of mass along the spin.
Long reach_across(const ReplayShape& shape, const Motion& m) {
  const LongVec spin = m.rotation.cast<Long>().transpose() * m.spin.cast<Long>();
  if (spin.norm() == 0) return 0;
  Long most = 0;
  for (std::size_t i = 0; i < shape.points.size(); ++i)
    most = std::max(most, spin.normalized().cross(shape.points[i]).norm() +
                              (shape.disks.empty() ? 0 : shape.disks[i]) +
                              (shape.balls.empty() ? 0 : shape.balls[i]));
  return most;
}

// The pair along n from time t on: below(h) never exceeds the gap h seconds later.
class Outlook {
 public:
  // across_a, across_b (m): the cores' reach across their spins' axes.
  Outlook(const ReplayQuery& q, const LongVec& n, Long t, Long across_a, Long across_b) : q_(q) {
    const Motion &a = q.motion_a, &b = q.motion_b;
    const LongVec position = b.position.cast<Long>() - a.position.cast<Long>(),
                  velocity = b.velocity.cast<Long>() - a.velocity.cast<Long>(),
                  acceleration = b.acceleration.cast<Long>() - a.acceleration.cast<Long>();
    radii_ = q.shape_a.radius + q.shape_b.radius;
    offset_ = n.dot(position + t * (velocity + t / 2 * acceleration)) - radii_;
    speed_ = n.dot(velocity + t * acceleration);
    const LongVec cross_a = n.cross(a.spin.cast<Long>()), cross_b = n.cross(b.spin.cast<Long>());
    n_a_ = in_body_axes(a, t, n);
    n_b_ = in_body_axes(b, t, n);
    turn_a_ = in_body_axes(a, t, cross_a);
    turn_b_ = in_body_axes(b, t, cross_b);
    const Long rate_a = a.spin.cast<Long>().norm(), rate_b = b.spin.cast<Long>().norm();
    // Only what bends towards contact: then below() is concave.
    bend_ = (std::min(Long(0), n.dot(acceleration)) - cross_a.norm() * rate_a * across_a -
             cross_b.norm() * rate_b * across_b) /
            2;
    size_ = position.norm() + t * (velocity.norm() + t / 2 * acceleration.norm()) + radii_ +
            (1 + t * rate_a) * q.shape_a.reach + (1 + t * rate_b) * q.shape_b.reach;
    drift_ = velocity.norm() + t * acceleration.norm() + (1 + t * rate_a) * rate_a * q.shape_a.reach +
             (1 + t * rate_b) * rate_b * q.shape_b.reach;
  }

  Long below(Long h) const {
    const Long turned =
        support_value(q_.shape_a, n_a_ + h * turn_a_) + support_value(q_.shape_b, -(n_b_ + h * turn_b_));
    return offset_ + h * speed_ - turned + h * h * bend_ - kRounding * (size_ + h * drift_ - h * h * bend_);
  }

 private:
  const ReplayQuery& q_;
  Long radii_, offset_, speed_, bend_, size_, drift_;
  LongVec n_a_, n_b_, turn_a_, turn_b_;
};

std::string text(Long value, int digits = 9) {
  return fmt::format("{:.{}g}", value, digits);
}

// Proves what a row claims: prove_above() for some pair.
using RowProver = std::function<ReplayProof(const LongVec& n, Long t, Long gap, Long speed, Long duration)>;

// What is wrong with one row, or "".
std::string check_row(const RowProver& prove, const CertificateRow& row, Long reached_before) {
  if (std::abs(row.normal.norm() - 1) > kUnit)
    return fmt::format("the normal's length is {:.17g}, not 1", row.normal.norm());
  if (!(row.t >= 0) || !(row.advance >= 0)) return "the time or the advance is negative";
  if (Long(row.t) > reached_before * (1 + Long(kChain)))
    return fmt::format("it starts at {:.17g} s, but only the time until {:.17g} s is proved before it", row.t,
                       static_cast<double>(reached_before));
  if (Long(row.t) < reached_before * (1 - Long(kChain)))
    return fmt::format("it starts at {:.17g} s, before the end of the row before it, {:.17g} s", row.t,
                       static_cast<double>(reached_before));
  // A line that begins below 0 and rises may be true, but proves nothing.
  if (!(row.gap_lower >= 0)) return "gap_lower is negative, " + text(row.gap_lower) + " m: nothing is clear";
  const Long used = Long(row.speed_bound) * Long(row.advance) * (1 - LDBL_EPSILON);
  if (used > Long(row.gap_lower))
    return "the gap of " + text(row.gap_lower) + " m does not last for " + text(row.advance) + " s at " +
           text(row.speed_bound) + " m/s";
  const ReplayProof proof =
      prove(row.normal.cast<Long>().normalized(), row.t, row.gap_lower, row.speed_bound, row.advance);
  if (proof.proved) return "";
  if (proof.reached == 0)
    return "the gap along the normal is " + text(proof.gap) + " m, by " +
           text(Long(row.gap_lower) - proof.gap, 3) + " m less than gap_lower";
  if (proof.evaluations > kMostEvaluations)
    return "it could not be shown that the pair closes no faster than the speed bound from " +
           text(proof.reached) + " s later on";
  // Bodies: the row was true until then. Corners that fly straight: it is no longer.
  const Long left = Long(row.gap_lower) - Long(row.speed_bound) * proof.reached;
  const std::string later =
      "the pair closes faster than the speed bound: " + text(proof.reached) + " s later ";
  if (text(proof.gap) == text(left))
    return later + "the gap along the normal, " + text(proof.gap) + " m, falls below what the row leaves";
  return later + "the gap along the normal is " + text(proof.gap) + " m, and the row leaves " + text(left) +
         " m";
}

// What is wrong with the answer itself, or "".
std::string check_answer(double interval, const ReplayAnswer& answer, bool has_rows) {
  if (answer.gap_lower > answer.gap_upper) return "gap_lower is larger than gap_upper";
  switch (answer.status) {
    case Status::touching_at_start:
    case Status::penetrating_at_start:
      if (answer.toc != 0) return "toc must be 0 for this status";
      if (has_rows) return "nothing is proved for this status, but the certificate has rows";
      return "";
    case Status::separated:
      if (answer.toc != 1) return "toc must be 1 for this status";
      break;
    case Status::contact:
      if (!(answer.toc > 0)) return "a contact at toc = 0 must be touching_at_start";
      break;
    case Status::unresolved:
      break;
  }
  if (!(answer.toc >= 0 && answer.toc <= 1)) return "toc is not in [0, 1]";
  if (!has_rows && answer.toc * interval > 0) return "the certificate has no row for it";
  return "";
}

std::vector<Refusal> check_rows(const RowProver& prove, double interval, const ReplayAnswer& answer,
                                const std::vector<CertificateRow>& rows) {
  std::vector<Refusal> wrong;
  if (const std::string what = check_answer(interval, answer, !rows.empty()); !what.empty())
    return {{-1, what}};
  const int n = static_cast<int>(rows.size());
  const Long toc = Long(answer.toc) * Long(interval);
  Long reached = 0;
  for (int k = 0; k < n; ++k) {
    const CertificateRow& row = rows[k];
    if (const std::string what = check_row(prove, row, reached); !what.empty()) wrong.push_back({k, what});
    reached = Long(row.t) + Long(row.advance);
    // The next row, or toc, may begin a rounding later than this one ends: nothing may happen in between.
    const Long next = k + 1 < n ? Long(rows[k + 1].t) : toc;
    if (next > reached && next <= reached * (1 + Long(kChain)) &&
        !prove(row.normal.cast<Long>().normalized(), reached, 0, 0, next - reached).proved)
      wrong.push_back({k, "the pair may touch between the end of this row and the next"});
  }
  if (n == 0) return wrong;
  if (toc > reached * (1 + Long(kChain)))
    wrong.push_back({n - 1, fmt::format("it proves the pair clear until {:.17g} s only, but toc is {:.17g} s",
                                        static_cast<double>(reached), static_cast<double>(toc))});
  if (toc < reached * (1 - Long(kChain)))
    wrong.push_back({n - 1, fmt::format("it proves the pair clear until {:.17g} s, beyond toc, {:.17g} s",
                                        static_cast<double>(reached), static_cast<double>(toc))});
  return wrong;
}

// The smallest n.p of B - A's corners at t, less what rounding may have added.
Long linear_gap(const LinearQuery& q, double interval, const LongVec& n, Long t) {
  const int split = q.kind == LinearQuery::Kind::vertex_face ? 1 : 2;
  Long least = std::numeric_limits<Long>::infinity();
  for (int a = 0; a < split; ++a)
    for (int b = split; b < 4; ++b) {
      const LongVec start = q.start[b].cast<Long>() - q.start[a].cast<Long>(),
                    end = q.end[b].cast<Long>() - q.end[a].cast<Long>();
      const Long part = interval > 0 ? t / Long(interval) : 0;
      least = std::min(least, n.dot((1 - part) * start + part * end) -
                                  kRounding * (1 + part) * (start.norm() + end.norm()));
    }
  return least;
}

}  // namespace

ReplayShape replay_shape(const Shape& shape) {
  ReplayShape result;
  result.radius = shape.radius;
  result.disks.assign(shape.disks.begin(), shape.disks.end());
  for (std::size_t i = 0; i < shape.core.vertices.size(); ++i) {
    const LongVec p = shape.core.vertices[i].cast<Long>();
    const Long disk = result.disks.empty() ? 0 : result.disks[i];
    result.points.push_back(p);
    result.reach = std::max(result.reach, std::hypot(std::hypot(p.x(), p.y()) + disk, p.z()));
  }
  return result;
}

ReplayProof prove_above(const ReplayQuery& query, const LongVec& n, Long t, Long gap, Long speed,
                        Long duration) {
  ReplayProof proof;
  const Long across_a = reach_across(query.shape_a, query.motion_a),
             across_b = reach_across(query.shape_b, query.motion_b);
  Long step = duration;
  while (true) {
    const Outlook outlook(query, n, t + proof.reached, across_a, across_b);
    proof.gap = outlook.below(0);
    ++proof.evaluations;
    const Long line = gap - speed * proof.reached;
    const Long rounding = kRounding * (std::abs(gap) + std::abs(speed) * duration);
    if (proof.gap < line + rounding) return proof;
    if (proof.reached >= duration) break;
    step = std::min(step, duration - proof.reached);
    while (outlook.below(step) < line - speed * step + rounding) {
      step /= 2;
      if (++proof.evaluations > kMostEvaluations || step <= LDBL_EPSILON * duration) return proof;
    }
    ++proof.evaluations;
    proof.reached = step >= duration - proof.reached ? duration : proof.reached + step;
    step *= 2;
    if (proof.reached >= duration) break;
  }
  proof.proved = true;
  return proof;
}

std::string replay_row(const ReplayQuery& query, const CertificateRow& row) {
  const auto prove = [&](const LongVec& n, Long t, Long gap, Long speed, Long duration) {
    return prove_above(query, n, t, gap, speed, duration);
  };
  return check_row(prove, row, row.t);
}

std::string replay_answer(double interval, const ReplayAnswer& answer, bool has_rows) {
  return check_answer(interval, answer, has_rows);
}

std::vector<Refusal> replay(const ReplayQuery& query, const ReplayAnswer& answer,
                            const std::vector<CertificateRow>& rows) {
  if (!query.motion_a.steady() || !query.motion_b.steady())
    return {{-1, "a body turns freely, or feels drag: only constant spin and acceleration can be replayed"}};
  const auto prove = [&](const LongVec& n, Long t, Long gap, Long speed, Long duration) {
    return prove_above(query, n, t, gap, speed, duration);
  };
  return check_rows(prove, query.interval, answer, rows);
}

std::vector<Refusal> replay(const LinearQuery& query, double interval, const ReplayAnswer& answer,
                            const std::vector<CertificateRow>& rows) {
  const auto prove = [&](const LongVec& n, Long t, Long gap, Long speed, Long duration) {
    ReplayProof proof;
    for (const Long h : {Long(0), duration}) {
      proof.reached = h;
      proof.gap = linear_gap(query, interval, n, t + h);
      ++proof.evaluations;
      if (proof.gap < gap - speed * h + kRounding * (std::abs(gap) + std::abs(speed) * h)) return proof;
    }
    proof.proved = true;
    return proof;
  };
  return check_rows(prove, interval, answer, rows);
}

}  // namespace fc::ca
