#include "ch06_friction/augmented_lagrangian.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ch06_friction/cone.hpp"

namespace fc::friction {
namespace {

// σ over the trace of a contact's block. In the first round: kFirst over the residual before it, at least kSoftest.
// Each round is stiffer by kStiffer, up to kStiff; and up to kStiffest if the residual does not fall below its
// kSlow-fold.
constexpr double kFirst = 0.1, kSoftest = 10, kStiffer = 10, kStiff = 1e5, kStiffest = 1e8, kSlow = 0.3;

// Newton steps in a round. The round ends when a step gains less than kMinimal of φ, over σ²: an error in velocities is
// one of σ times that in impulses.
constexpr int kSteps = 20;
constexpr double kMinimal = 1e-14;

// Line search: the share of the slope that a step must gain, and the shortest step. A loss within the round-off of φ is
// none; and a step that gains no more than that round-off must gain no more than kFalls of the step before.
constexpr double kArmijo = 1e-4, kShortestStep = 1e-3, kRounding = 1e-13, kFalls = 0.25;

// Of at least kMany contacts, a guess with a larger residual than kBadGuess is a bad one. Then kStuckRounds rounds treat every
// contact as stuck, with the stiffness kStuck and kSofter times that along the surface; what they find is the new guess, unless
// more than the share kMaySlide of the contacts would need more friction than they have.
constexpr std::size_t kMany = 600;
constexpr double kBadGuess = 1e-5, kStuck = 1e7, kSofter = 1e-2, kMaySlide = 1.0 / 16;
constexpr int kStuckRounds = 3;

// From this residual on, contacts inside their cones by more than this share are held where they are: see settle(). Tried again
// when the residual is so much smaller.
constexpr double kSettles = 1e-5, kWellInside = 1e-6, kSettlesAgain = 1e-2;
constexpr int kSettlingRounds = 6, kSettlingSteps = 2;

// Rounds may go on for ever: the residual must fall to this share within kIdleRounds.
constexpr double kProgress = 0.5;
constexpr int kIdleRounds = 6;

// Aitken's rule: the shifts are extrapolated if their change is the last change times a factor between these.
constexpr double kSame = 0.05, kGrows = 0.95;

AugmentedLagrangian::Piece piece_of_cone(const Vec3& x, double mu) {
  AugmentedLagrangian::Piece result;
  const double slip = x.tail<2>().norm();
  if (mu * slip <= -x[0]) return result;  // open
  if (mu > 0 && slip <= mu * x[0]) {      // sticks
    result.D.setIdentity();
    result.impulse = x;
    return result;
  }
  result.impulse = project_onto_cone(x, mu);  // slides
  if (slip == 0) {
    result.D(0, 0) = 1;
    return result;
  }
  const Eigen::Vector2d along = x.tail<2>() / slip, across(-along.y(), along.x());
  const Vec3 edge = Vec3(1, mu * along.x(), mu * along.y()) / std::hypot(1, mu);
  result.D = edge * edge.transpose();
  result.D.block<2, 2>(1, 1) += mu * result.impulse[0] / slip * across * across.transpose();
  return result;
}

}  // namespace

AugmentedLagrangian::AugmentedLagrangian(std::span<const MovedBody> bodies, std::span<ContactBlock> blocks,
                                         BodyMatrix& matrix)
    : blocks_(blocks),
      shift_(blocks.size(), 0),
      shift_change_(blocks.size(), 0),
      slopes_(blocks.size()),
      matrix_(matrix) {
  std::vector<int> place(bodies.size(), -1);
  std::vector<Mat3> turn_root(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].moves()) continue;
    place[i] = size_++;
    turn_root[i] = Eigen::SelfAdjointEigenSolver<Mat3>(bodies[i].turn).operatorSqrt();
  }
  const auto part = [&](int body, const Mat3& frame, const Vec3& arm, double sign) {
    Mat36 g = Mat36::Zero();
    if (place[index(body)] < 0) return g;
    g.leftCols<3>() = sign * frame.transpose() * bodies[index(body)].move.cwiseSqrt().asDiagonal();
    g.rightCols<3>() = -sign * frame.transpose() * cross_matrix(arm) * turn_root[index(body)];
    return g;
  };
  for (const ContactBlock& block : blocks) {
    place_a_.push_back(place[index(block.a)]);
    place_b_.push_back(place[index(block.b)]);
    a_.push_back(part(block.a, block.frame, block.arm_a, -1));
    b_.push_back(part(block.b, block.frame, block.arm_b, 1));
    guess_.push_back(block.r);
    const std::pair<int, int> link(place_a_.back(), place_b_.back());
    if (std::min(link.first, link.second) >= 0 && (links_.empty() || links_.back() != link))
      links_.push_back(link);
  }
  stiffness_.resize(blocks.size());
}

AugmentedLagrangian::Piece AugmentedLagrangian::piece(std::size_t k, const Vec3& x) const {
  Piece result;
  if (!inside_.empty()) {
    result.D.diagonal() << (inside_[k] != 0), (inside_[k] > 1), (inside_[k] > 1);
    result.impulse = inside_[k] ? Vec3(result.D * x) : guess_[k];
    return result;
  }
  if (sticks_ || !holds_.empty()) {  // normals push, tangents take whatever impulse they need
    const double push = x[0] > 0, hold = sticks_ ? blocks_[k].mu > 0 : holds_[k] != 0;
    result.D.diagonal() << push, hold, hold;
    result.impulse = result.D * x;
    return result;
  }
  return piece_of_cone(x, blocks_[k].mu);
}

// u(y), m/s. For tangents that are held: what they have moved.
Vec3 AugmentedLagrangian::velocity(std::size_t k, const VecX& y) const {
  Vec3 u = blocks_[k].start;
  if (!holds_.empty()) u.tail<2>().setZero();
  if (place_a_[k] >= 0) u += a_[k] * y.segment<6>(6 * place_a_[k]);
  if (place_b_[k] >= 0) u += b_[k] * y.segment<6>(6 * place_b_[k]);
  return u;
}

Vec3 AugmentedLagrangian::argument(std::size_t k, const VecX& y) const {
  return guess_[k] - stiffness_[k].cwiseProduct(velocity(k, y) + Vec3(shift_[k], 0, 0));
}

void AugmentedLagrangian::add_impulse(std::size_t k, const Vec3& r, VecX& y) const {
  if (place_a_[k] >= 0) y.segment<6>(6 * place_a_[k]) += a_[k].transpose() * r;
  if (place_b_[k] >= 0) y.segment<6>(6 * place_b_[k]) += b_[k].transpose() * r;
}

double AugmentedLagrangian::value(const VecX& y) const {
  double sum = y.squaredNorm();
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const Vec3 r = piece(k, argument(k, y)).impulse;
    sum += r.dot(r.cwiseQuotient(stiffness_[k]));
  }
  return 0.5 * sum;
}

// The gradient of φ at y. Its second derivative is factored, unless it is the one that was factored last: it is, while no
// contact changes between open, stick and slip and none slips.
VecX AugmentedLagrangian::linearise(const VecX& y) {
  VecX gradient = y;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const Piece p = piece(k, argument(k, y));
    add_impulse(k, -p.impulse, gradient);
    slopes_[k] = stiffness_[k].asDiagonal() * p.D;
  }
  if (slopes_ != factored_) factor();
  return gradient;
}

void AugmentedLagrangian::factor() {
  ++factors_;
  factored_ = slopes_;
  matrix_.start(size_, links_);
  for (int i = 0; i < size_; ++i) matrix_.add(i, i, Mat6::Identity());
  Mat6 of_a = Mat6::Zero(), of_b = Mat6::Zero(),
       between = Mat6::Zero();  // of a pair, whose contacts follow each other
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const int a = place_a_[k], b = place_b_[k];
    const Mat36 of_slope = slopes_[k] * b_[k];
    of_a.noalias() += a_[k].transpose() * (slopes_[k] * a_[k]);
    of_b.noalias() += b_[k].transpose() * of_slope;
    between.noalias() += a_[k].transpose() * of_slope;
    if (k + 1 < blocks_.size() && place_a_[k + 1] == a && place_b_[k + 1] == b) continue;
    if (a >= 0) matrix_.add(a, a, of_a);
    if (b >= 0) matrix_.add(b, b, of_b);
    if (a >= 0 && b >= 0) matrix_.add(a, b, between);
    of_a.setZero();
    of_b.setZero();
    between.setZero();
  }
  matrix_.factor();
}

// ANCHOR: minimise
void AugmentedLagrangian::minimise(VecX& y) {
  const double minimal = kMinimal / (stiff_ * stiff_);
  double phi = value(y), last = std::numeric_limits<double>::infinity();
  VecX before = y;
  for (int step = 0; step < kSteps; ++step) {
    const VecX gradient = linearise(y), change = -matrix_.solve(gradient);
    const double slope = gradient.dot(change);  // < 0
    if (!(-slope > minimal * phi)) return;
    if (-slope < kRounding * phi && -slope > kFalls * last) {
      if (-slope > last) y = before;
      return;
    }
    last = -slope;
    before = y;
    double part = 1, next = value(y + change);
    while (next > phi + kArmijo * part * slope + kRounding * phi && part > kShortestStep) {
      part *= 0.5;
      next = value(y + part * change);
    }
    y += part * change;
    phi = next;
  }
}
// ANCHOR_END: minimise

// Sets s from the velocities; every second time it is extrapolated, if it changes by a steady factor.
void AugmentedLagrangian::shift(const VecX& y, int round) {
  if (!holds_.empty()) return;
  double product = 0, size = 0;
  std::vector<double> next(blocks_.size());
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    next[k] = blocks_[k].mu * velocity(k, y).tail<2>().norm();
    product += (next[k] - shift_[k]) * shift_change_[k];
    size += shift_change_[k] * shift_change_[k];
  }
  const double factor = size > 0 ? product / size : 0;
  jumped_ = round > 1 && !jumped_ && std::abs(factor) > kSame && factor < kGrows;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    shift_change_[k] = next[k] - shift_[k];
    shift_[k] = jumped_ ? std::max(0.0, next[k] + factor / (1 - factor) * shift_change_[k]) : next[k];
  }
}

// Applies the guesses; returns y.
VecX AugmentedLagrangian::start_round() {
  VecX y = VecX::Zero(6 * size_);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    add_impulse(k, guess_[k], y);
    const double size = blocks_[k].delassus.trace();
    stiffness_[k].setConstant(size > 0 ? stiff_ / size : 1);
    if (sticks_) stiffness_[k].tail<2>() *= kSofter;
  }
  return y;
}

// Makes the contacts stiffer, as long as that helps. False: they were already too stiff for round-off.
bool AugmentedLagrangian::adapt(double now, double before) {
  if (now > before && stiff_ >= kStiff) {
    stiffest_ = stiff_ / kStiffer;
    stiff_ = std::min(kStiff, stiffest_);
    return false;
  }
  if (stiff_ < kStiff || (now > kSlow * before && stiff_ < stiffest_)) stiff_ *= kStiffer;
  return true;
}

// A start for what stands: forces that carry it if nothing can slide, and of these, which are many, some with little friction.
// So most are well inside their cones, where P_K does not change with every step. Returns the residual of the guess.
double AugmentedLagrangian::stick(double before, const std::function<double()>& left) {
  const std::vector<Vec3> guess = guess_;
  guess_.assign(blocks_.size(), Vec3::Zero());
  stiff_ = kStuck;
  sticks_ = true;
  for (int round = 0; round < kStuckRounds; ++round) {
    VecX y = start_round();
    minimise(y);
    for (std::size_t k = 0; k < blocks_.size(); ++k) guess_[k] = piece(k, argument(k, y)).impulse;
  }
  sticks_ = false;
  std::size_t outside = 0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const double mu = blocks_[k].mu;
    outside += guess_[k].tail<2>().norm() > mu * guess_[k][0];
    guess_[k] = project_onto_cone(guess_[k], mu);
  }
  const bool stands = static_cast<double>(outside) <= kMaySlide * static_cast<double>(blocks_.size());
  if (!stands) guess_ = guess;
  for (std::size_t k = 0; k < blocks_.size(); ++k) blocks_[k].r = guess_[k];
  return stands ? left() : before;
}

// ANCHOR: settle
// What sticks, sticks: the contacts inside their cones do not move, all others keep their impulses. That is linear, so its rounds
// share one factor, and each takes off two digits. Returns the least residual; the guesses are those that leave it.
double AugmentedLagrangian::settle(double best, const std::function<double()>& left) {
  inside_.assign(blocks_.size(), 0);
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const double mu = blocks_[k].mu;
    const Vec3& r = guess_[k];
    if (r[0] > 0 && mu == 0) inside_[k] = 1;
    if (r[0] > 0 && mu > 0 && r.tail<2>().norm() < (1 - kWellInside) * mu * r[0]) inside_[k] = 2;
  }
  const double stiff = std::exchange(stiff_, kStiff);
  const std::vector<double> shift = std::exchange(shift_, std::vector<double>(blocks_.size(), 0));
  std::vector<Vec3> best_guess = guess_;
  for (int round = 0; round < kSettlingRounds; ++round) {
    VecX y = start_round();
    for (int step = 0; step < kSettlingSteps; ++step)
      y -= matrix_.solve(linearise(y));  // one, but for round-off
    for (std::size_t k = 0; k < blocks_.size(); ++k)
      blocks_[k].r = guess_[k] = project_onto_cone(piece(k, argument(k, y)).impulse, blocks_[k].mu);
    const double now = left();
    if (!(now < best)) break;
    best = now;
    best_guess = guess_;
  }
  inside_.clear();
  guess_ = best_guess;
  stiff_ = stiff;
  shift_ = shift;
  return best;
}
// ANCHOR_END: settle

// ANCHOR: rounds
double AugmentedLagrangian::run(int most, double enough, const std::function<double()>& left) {
  double best = left();
  if (holds_.empty() && blocks_.size() >= kMany && best > kBadGuess) best = stick(best, left);
  double before = best, progress = best, settles = kSettles;
  std::vector<Vec3> best_r = guess_;
  stiff_ = holds_.empty() ? std::clamp(kFirst / best, kSoftest, kStiff)
                          : kStiff;  // nothing slides, and no shift has to settle
  stiffest_ = kStiffest;
  for (int round = 0, idle = 0; round < most && best > enough && idle < kIdleRounds; ++round) {
    VecX y = start_round();
    shift(y, round);
    minimise(y);
    for (std::size_t k = 0; k < blocks_.size(); ++k)
      blocks_[k].r = guess_[k] = piece(k, argument(k, y)).impulse;
    const double now = left();
    if (now < best) {
      best = now;
      best_r = guess_;
    }
    if (holds_.empty() && best > enough && now == best && best < settles) {
      const std::vector<Vec3> guess = guess_;
      best = settle(best, left);
      best_r = std::exchange(guess_, guess);
      settles = kSettlesAgain * best;
    }
    ++idle;
    if (best < kProgress * progress) {
      progress = best;
      idle = 0;
    }
    if (!adapt(now, before)) {
      guess_ = best_r;
      std::fill(shift_change_.begin(), shift_change_.end(), 0);
    }
    before = now;
  }
  for (std::size_t k = 0; k < blocks_.size(); ++k) blocks_[k].r = best_r[k];
  return left();
}
// ANCHOR_END: rounds

}  // namespace fc::friction
