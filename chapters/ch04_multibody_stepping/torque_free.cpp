// The letters below: I1 <= I2 <= I3 the moments, a_i = 1/I_i, L_i the angular momentum along axis i.
//
// Where L lies decides which axis it circles: the first if 2E > L^2/I2, the third if 2E < L^2/I2. Call that
// one c, the middle one m, the other one o, in a right-handed order, and let A = |a_c - a_m| and
// B = |a_m - a_o|. With the constants
//   P = (A+B) L_c^2 + B L_m^2,   Q = A L_m^2 + (A+B) L_o^2,   S = A L_c^2 - B L_o^2 > 0
// (|2E - a_o L^2|, |2E - a_c L^2|, |2E - a_m L^2|, but summed without cancellation), Euler's equations give
//   L_c = +-sqrt(P/(A+B)) dn u,   L_m = sqrt(Q/A) sn u,   L_o = sqrt(Q/(A+B)) cn u,   du/dt = +-sqrt(A P),
// of parameter m = B Q/(A P), and 1 - m = (A+B) S/(A P). Axis c turns about L at the rate
//   |L| (a_m L_m^2 + a_o L_o^2)/(L_m^2 + L_o^2),
// whose integral is its mean value times t, less or plus the phase of Jacobi's Theta(u + i b | m), where
//   b = F(atan sqrt(P/Q) | 1-m),   K' - b = F(atan sqrt(A/B) | 1-m).
#include "ch04_multibody_stepping/torque_free.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "ch04_multibody_stepping/elliptic.hpp"

namespace fc::world {

namespace {

using Long = long double;
using LongVec = Eigen::Matrix<Long, 3, 1>;

constexpr double eps = std::numeric_limits<double>::epsilon();

Long square(Long x) {
  return x * x;
}

void check(const Mat3& rotation, const Vec3& spin) {
  if (!(rotation.transpose() * rotation).isIdentity(1e-9) || !(rotation.determinant() > 0)) {
    const Mat3& r = rotation;
    throw std::invalid_argument(
        fmt::format("the orientation with rows ({}, {}, {}), ({}, {}, {}), ({}, {}, {}) is not a rotation",
                    r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)));
  }
  if (!spin.allFinite())
    throw std::invalid_argument(
        fmt::format("the spin ({}, {}, {}) rad/s is not finite", spin.x(), spin.y(), spin.z()));
}

}  // namespace

// The start, with the axes in the order c, m, o, moments in units of the largest and spins in units of |w|.
struct TorqueFree::Start {
  std::array<int, 3> axis{0, 1, 2};  // c, m, o, as principal axes
  Long flip = 1;                     // the sign with which axis o is taken: the order stays right-handed
  LongVec a, l;                      // 1 / moments; the angular momentum
  Long spin, momentum;               // |w| in rad/s; |L|
  Long A, B, P, Q, S;
  bool constant;  // L and w are parallel

  Start(const Vec3& moments, const LongVec& spin_principal) : spin(spin_principal.norm()) {
    const LongVec exact = moments.cast<Long>(), unit = exact / exact[2];
    const LongVec w = spin_principal / spin;
    l = unit.cwiseProduct(w);
    momentum = l.norm();
    for (int i = 0; i < 3; ++i)  // leans by less than its own rounding
      if (std::abs(w[i]) <= 8 * eps && std::abs(l[i]) <= 8 * eps * momentum) l[i] = 0;
    momentum = l.norm();
    a = unit.cwiseInverse();
    // From the given moments, so that the differences of almost equal ones keep their digits.
    A = (exact[1] - exact[0]) / exact[2] / (unit[0] * unit[1]);
    B = (exact[2] - exact[1]) / exact[2] / (unit[1] * unit[2]);
    S = A * square(l[0]) - B * square(l[2]);
    constant = A * l[0] * l[1] == 0 && B * l[1] * l[2] == 0 && (A + B) * l[2] * l[0] == 0;
    if (S < 0) {
      std::swap(axis[0], axis[2]);
      std::swap(a[0], a[2]);
      std::swap(l[0], l[2]);
      std::swap(A, B);
      l[2] = -l[2];
      S = -S;
      flip = -1;
    }
    P = (A + B) * square(l[0]) + B * square(l[1]);
    Q = A * square(l[1]) + (A + B) * square(l[2]);
  }
  LongVec w() const { return a.cwiseProduct(l); }
};

struct TorqueFree::State {
  Vec3 l;               // L's direction, in the axes c, m, o
  double across;        // its part across c
  double cosine, sine;  // of the turn about L
};

TorqueFree::TorqueFree(const PrincipalInertia& inertia, const Mat3& rotation, const Vec3& spin) {
  check(rotation, spin);
  if (spin.isZero(0)) {
    set_constant(rotation, spin);
    return;
  }
  const LongVec spin_body = rotation.cast<Long>().transpose() * spin.cast<Long>();
  const Start start(inertia.moments, inertia.axes.cast<Long>().transpose() * spin_body);
  set_axes(inertia, start);
  if (start.constant) {
    const LongVec w = start.spin * start.w();
    set_constant(rotation, rotation * (body_ * w.cast<double>()));
    return;
  }
  constant_ = false;
  set_bounds(start);
  set_series(start);
  const State now = state_at(0);  // turns world_, still the identity, to where the body is
  world_ = rotation * body_ * world_frame(now).transpose();
}

void TorqueFree::set_constant(const Mat3& rotation, const Vec3& spin_world) {
  along_ = spin_world.stableNorm();
  margin_ = 32 * eps * along_;
  spin_bound_ = along_ + margin_;
  if (along_ > 0) {
    world_.col(0) = spin_world / along_;
    world_.col(1) = world_.col(0).unitOrthogonal();
    world_.col(2) = world_.col(0).cross(world_.col(1));
  }
  body_ = rotation.transpose() * world_;
}

void TorqueFree::set_axes(const PrincipalInertia& inertia, const Start& start) {
  for (int i = 0; i < 3; ++i) body_.col(i) = inertia.axes.col(start.axis[i]);
  if (start.flip < 0) body_.col(2) = -body_.col(2);
  rates_ = (start.spin * start.momentum * start.a).cast<double>();
}

// w is longest, and farthest from L, where L_m = 0: there L_c^2 = P/(A+B) and L_o^2 = Q/(A+B). Its part
// across L is |L x w|/|L| = (A+B) |L_c L_o|/|L|.
//
// Its change has the components a_c B L_m L_o, a_m (A+B) L_o L_c, a_o A L_c L_m, up to signs. With y = sn^2 u
// its square is a quadratic polynomial on 0 <= y <= 1, in units of a_m^2 P Q
//   f(y) = m (a_c/a_m)^2 B/(A+B) y(1-y) + (1-y)(1-my) + (a_o/a_m)^2 A/(A+B) y(1-my).
// One of the two fractions with squares belongs to the first axis and is
//   (a1/a2)^2 (a2 - a3)/(a1 - a3) <= 1   if and only if   1/a3 <= 1/a1 + 1/a2,   that is I3 <= I1 + I2;
// in the other, a_c or a_o is a3 <= a_m. So f'(0) <= m + 1 - (1 + m) = 0 and f(1) <= 1 - m, and f is largest
// at y = 0, where L_m = 0 again. (Should rounding have made I3 a little too large, f <= that fraction.)
void TorqueFree::set_bounds(const Start& start) {
  const auto& [A, B, P, Q] = std::tie(start.A, start.B, start.P, start.Q);
  const LongVec squares = start.a.cwiseProduct(start.a);
  const Long fastest = start.spin * std::sqrt((squares[0] * P + squares[2] * Q) / (A + B));
  margin_ = static_cast<double>(32 * eps * fastest);
  spin_bound_ = static_cast<double>(fastest) + margin_;
  along_ = static_cast<double>(start.spin * start.w().dot(start.l) / start.momentum);
  across_ = static_cast<double>(start.spin * std::sqrt(P * Q) / start.momentum);

  const Long first = start.flip > 0 ? squares[0] * B : squares[2] * A;  // a1^2 (a2 - a3)
  const Long most = P * Q * std::max(squares[1], first / (A + B));
  spin_change_bound_ = static_cast<double>((1 + 32 * eps) * square(start.spin) * std::sqrt(most));
}

void TorqueFree::set_series(const Start& start) {
  const auto& [A, B, P, Q] = std::tie(start.A, start.B, start.P, start.Q);
  const Long sum = A + B, L = start.momentum;
  // A start exactly on the separatrix would need infinitely long to turn over; one within 1e-30 needs K = 36.
  const Long m = B * Q / (A * P), m1 = std::clamp(sum * start.S / (A * P), Long(1e-30), Long(1));
  const Long K = complete_integral(std::sqrt(m1), 1, 1, 1);
  const Long b = std::sqrt(P / (P + Q)) * carlson_rf(Q / (P + Q), Q / (A * L * L), 1);
  const Long rest = B > 0 ? std::sqrt(A / sum) * carlson_rf(B / sum, B * L * L / P, 1)
                          : std::numeric_limits<Long>::infinity();
  series_ = ThetaSeries(m, K, b, rest);
  side_ = start.l[0] < 0 ? -1 : 1;
  const LongVec most(side_ * std::sqrt(P / sum), std::sqrt(Q / A), std::sqrt(Q / sum));
  size_ = (most / L).cast<double>();

  const Long sn = start.l[1] / most[1], cn = start.l[2] / most[2], dn = start.l[0] / most[0];
  const Long quarter = std::abs(sn) * carlson_rf(cn * cn, dn * dn, 1);  // F of the angle folded to a quarter
  phase_start_ = static_cast<double>(std::copysign(cn < 0 ? 2 * K - quarter : quarter, sn));
  phase_rate_ = static_cast<double>(start.flip * side_ * start.spin * std::sqrt(A * P));
  const Long turned = complete_integral(std::sqrt(m1), sum / A, start.a[2], start.a[1] * sum / A);
  precession_ = static_cast<double>(start.spin * L * turned / K);
}

TorqueFree::State TorqueFree::state_at(double t) const {
  const ThetaSeries::Values v = series_.at(phase_start_ + phase_rate_ * t);
  State state;
  state.l = Vec3(v.dn, v.sn, v.cn).cwiseProduct(size_);
  state.l /= state.l.norm();
  state.across = std::sqrt(state.l[1] * state.l[1] + state.l[2] * state.l[2]);
  const double angle = precession_ * t + side_ * v.angle;
  const double cosine = std::cos(angle), sine = std::sin(angle), back = -side_ * v.imaginary;
  const double scale = 1 / std::sqrt(v.real * v.real + back * back);
  state.cosine = scale * (v.real * cosine - back * sine);
  state.sine = scale * (v.real * sine + back * cosine);
  return state;
}

Mat3 TorqueFree::turned(double cosine, double sine) const {
  Mat3 frame;
  frame.col(0) = world_.col(0);
  frame.col(1) = cosine * world_.col(1) + sine * world_.col(2);
  frame.col(2) = cosine * world_.col(2) - sine * world_.col(1);
  return frame;
}

// The axes c, m, o in the world: c x L stays perpendicular to L and turns about it.
Mat3 TorqueFree::world_frame(const State& state) const {
  const Vec3& l = state.l;
  Mat3 frame;  // rows: L's direction, c x L, and their product, in the axes c, m, o
  frame.row(0) = l;
  frame.row(1) << 0, -l[2] / state.across, l[1] / state.across;
  frame.row(2) << state.across, -l[0] * l[1] / state.across, -l[0] * l[2] / state.across;
  return turned(state.cosine, state.sine) * frame;
}

Mat3 TorqueFree::rotation_at(double t) const {
  if (constant_) return turned(std::cos(along_ * t), std::sin(along_ * t)) * body_.transpose();
  return world_frame(state_at(t)) * body_.transpose();
}

Vec3 TorqueFree::spin_at(double t) const {
  if (constant_) return along_ * world_.col(0);
  const State state = state_at(t);
  return world_frame(state) * rates_.cwiseProduct(state.l);
}

void turn_freely(ca::Motion& motion, const PrincipalInertia& inertia) {
  const TorqueFree turning(inertia, motion.rotation, motion.spin);
  motion.free = turning.constant_spin() ? nullptr : std::make_shared<TorqueFree>(turning);
  motion.free_start = 0;
  motion.free_rate = 1;
}

}  // namespace fc::world
