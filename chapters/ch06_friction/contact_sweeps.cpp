#include "ch06_friction/contact_sweeps.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "ch06_friction/augmented_lagrangian.hpp"
#include "ch06_friction/cone.hpp"

namespace fc::friction {
namespace {

// After this many sweeps without progress, impulses go only a share of their way; not less than kLeastShare.
constexpr int kPatience = 50;
constexpr double kClearly = 0.9, kLeastShare = 1.0 / 16;

constexpr double kLooksOfAFactor = 20;

constexpr double kUnmoved = 1e-12;  // of the largest: directions in which no impulse moves anything

// The pseudo-inverse of a symmetric positive semidefinite matrix.
Eigen::Matrix2d inverse_where_it_moves(const Eigen::Matrix2d& D) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(D);
  Eigen::Vector2d inverse = Eigen::Vector2d::Zero();
  for (int k = 0; k < 2; ++k)
    if (const double x = eigen.eigenvalues()[k]; x > kUnmoved * eigen.eigenvalues()[1]) inverse[k] = 1 / x;
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

// Friction against d with the block's D, of at most `radius`: r_T = -(D + x I)^-1 d, with the least x >= 0 for which
// |r_T| <= radius.
Eigen::Vector2d disc_friction(const Eigen::Matrix2d& D, const Eigen::Vector2d& d, double radius) {
  constexpr int kMost = 60;
  if (!(radius > 0)) return Eigen::Vector2d::Zero();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(D);
  const Eigen::Vector2d along = eigen.eigenvectors().transpose() * d, delta = eigen.eigenvalues().cwiseMax(0);
  const auto at = [&](double x) -> Eigen::Vector2d {
    return -along.cwiseQuotient(delta + Eigen::Vector2d::Constant(x));
  };
  if (delta[0] > 0 && at(0).norm() <= radius) return eigen.eigenvectors() * at(0);
  double low = 0, high = along.norm() / radius;  // at(high) is short enough
  for (int i = 0; i < kMost; ++i) {
    const double middle = 0.5 * (low + high);
    (at(middle).norm() > radius ? low : high) = middle;
  }
  const Eigen::Vector2d r = at(high);
  return eigen.eigenvectors() * r;
}

}  // namespace

void ContactSweeps::start(std::span<const RigidBody> bodies, double least) {
  least_ = least;
  blocks_.clear();
  bodies_.clear();
  for (const RigidBody& body : bodies)
    bodies_.push_back({body.position, body.velocity, body.spin, body.velocity, body.spin,
                       body.inverse_mass * body.free_moves,
                       body.is_static() ? Mat3(Mat3::Zero()) : body.inverse_inertia_world()});
}

void ContactSweeps::add(const lcp::Contact& contact, double mu, const Vec3& offset, const Vec3& impulse) {
  const MovedBody &a = bodies_[index(contact.body_a)], &b = bodies_[index(contact.body_b)];
  const Mat3 frame = contact_frame(contact.normal);
  const Vec3 arm_a = contact.turns_a ? Vec3(contact.point - a.place) : Vec3(Vec3::Zero());
  const Vec3 arm_b = contact.turns_b ? Vec3(contact.point - b.place) : Vec3(Vec3::Zero());
  const auto part = [&](const MovedBody& mass, const Vec3& arm) -> Mat3 {
    const Mat3 turn = cross_matrix(arm);
    return Mat3(mass.move.asDiagonal()) - turn * mass.turn * turn;
  };
  const Mat3 whole = frame.transpose() * (part(a, arm_a) + part(b, arm_b)) * frame;
  const Mat3 delassus = 0.5 * (whole + whole.transpose());
  ContactBlock block{contact.body_a,
                     contact.body_b,
                     frame,
                     arm_a,
                     arm_b,
                     delassus,
                     OneContact(delassus, mu),
                     mu,
                     frame.transpose() * offset,
                     inverse_where_it_moves(delassus.block<2, 2>(1, 1)),
                     project_onto_cone(frame.transpose() * impulse, mu)};
  block.start = velocity(block);
  blocks_.push_back(block);
}

// Gives the bodies their velocities without impulses, and adds the impulses of all contacts.
void ContactSweeps::apply_impulses() {
  for (MovedBody& body : bodies_) {
    body.velocity = body.free_velocity;
    body.spin = body.free_spin;
  }
  for (const ContactBlock& block : blocks_)
    if (!block.r.isZero(0)) block.push(bodies_, block.r);
}

// Visits all contacts once. Returns the largest change of an impulse, as a velocity (m/s).
// ANCHOR: sweep
template <class Solve>
double ContactSweeps::sweep(bool backwards, double relaxation, const Solve& solve) {
  double largest = 0;
  work_ += contacts();
  for (int k = 0; k < contacts(); ++k) {
    const int i = backwards ? contacts() - 1 - k : k;
    ContactBlock& block = blocks_[index(i)];
    const Vec3 q = velocity(block) - block.delassus * block.r;  // the velocity without this contact's impulse
    const Vec3 change = relaxation * (solve(i, block, q) - block.r);
    if (change.isZero(0)) continue;
    block.push(bodies_, change);
    block.r += change;
    largest = std::max(largest, (block.delassus * change).norm());
  }
  return largest;
}
// ANCHOR_END: sweep

double ContactSweeps::largest_velocity() const {
  double largest = least_;
  for (const ContactBlock& block : blocks_) {
    const Vec3 now = velocity(block);
    largest = std::max({largest, block.start.norm(), (now - block.start).norm()});
  }
  return largest;
}

template <class Solve>
void ContactSweeps::run(int most, double tolerance, const Solve& solve) {
  apply_impulses();
  double relaxation = 1, best = std::numeric_limits<double>::infinity(), before = best;
  const double enough = tolerance * largest_velocity();
  for (int k = 0; k < most; ++k) {
    const double change = sweep(k % 2 == 1, relaxation, solve) / relaxation;
    if (change <= enough) return;
    best = std::min(best, change);
    if (k % kPatience != kPatience - 1) continue;
    if (best > kClearly * before) relaxation = std::max(0.5 * relaxation, kLeastShare);
    before = best;
  }
}

double ContactSweeps::run(int most, double tolerance) {
  run(most, tolerance, [](int, const ContactBlock& block, const Vec3& q) { return block.one.solve(q); });
  return residual();
}

// ANCHOR: held
double ContactSweeps::run_held(std::span<const char> holds, int most, double tolerance) {
  run(most, tolerance, [&](int i, const ContactBlock& block, const Vec3& q) -> Vec3 {
    const double a = block.delassus(0, 0);
    if (!holds[index(i)]) return {a > 0 ? std::max(0.0, -q[0] / a) : 0.0, 0, 0};
    // The tangents' velocity is that at the start, whatever the normal impulse is.
    const Eigen::Vector2d c = block.delassus.block<2, 1>(1, 0);
    const Eigen::Vector2d still = q.tail<2>() - block.start.tail<2>();
    const double effective = a - c.dot(block.inverse * c), speed = q[0] - c.dot(block.inverse * still);
    const double normal = effective > kUnmoved * a ? std::max(0.0, -speed / effective) : 0.0;
    const Eigen::Vector2d tangent = -(block.inverse * (still + normal * c));
    return {normal, tangent[0], tangent[1]};
  });
  return held_residual(holds);
}
// ANCHOR_END: held

double ContactSweeps::held_residual(std::span<const char> holds) const {
  double worst = 0;
  for (int i = 0; i < contacts(); ++i) {
    const ContactBlock& block = blocks_[index(i)];
    const Vec3 u = velocity(block);
    worst = std::max(worst, std::abs(std::min(block.delassus(0, 0) * block.r[0], u[0])));
    if (holds[index(i)]) worst = std::max(worst, (u - block.start).tail<2>().norm());
  }
  const double largest = largest_velocity();
  return largest > 0 ? worst / largest : 0;
}

double ContactSweeps::run_together(int most, double enough) {
  return together({}, most, enough, [&] { return residual(); });
}

double ContactSweeps::run_held_together(std::span<const char> holds, int most, double enough) {
  return together(holds, most, enough, [&] { return held_residual(holds); });
}

double ContactSweeps::together(std::span<const char> holds, int most, double enough,
                               const std::function<double()>& left) {
  AugmentedLagrangian method(bodies_, blocks_, matrix_);
  method.hold(holds);
  const double reached = method.run(most, enough, [&] {
    apply_impulses();
    return left();
  });
  work_ += kLooksOfAFactor * method.factors() * contacts();
  return reached;
}

void ContactSweeps::run_discs(std::span<const double> normals, int most, double tolerance) {
  run(most, tolerance, [&](int i, const ContactBlock& block, const Vec3& q) -> Vec3 {
    const double normal = normals[index(i)];
    const Eigen::Vector2d d = q.tail<2>() + normal * block.delassus.block<2, 1>(1, 0);
    const Eigen::Vector2d tangent = disc_friction(block.delassus.block<2, 2>(1, 1), d, block.mu * normal);
    return {normal, tangent[0], tangent[1]};
  });
}

double ContactSweeps::residual() const {
  double worst = 0;
  for (const ContactBlock& block : blocks_) {
    const Vec3 u = velocity(block);
    const double size = block.delassus.cwiseAbs().maxCoeff();
    if (size > 0) worst = std::max(worst, cone_violation(block.r, u, block.mu, size));
  }
  const double largest = largest_velocity();
  return largest > 0 ? worst / largest : 0;
}

}  // namespace fc::friction
