// Of a frame: bodies in crowds.
#include <algorithm>

#include "ch05_resting_contact/resting.hpp"
#include "common/stopwatch.hpp"

namespace fc::resting {
namespace {

// If no point of a crowd is faster than this part of the envelope in a frame, it stands still: its impulses
// are not more exact than that.
constexpr double kStillCrowd = 1e-3;

// Of the envelope: in a crowd a gap may shrink to this, and is brought back to it, so that what pushes one
// gap does not push all.
constexpr double kLowInCrowd = 0.35;

}  // namespace

void Resting::add_row(int contact) {
  ShellContact& c = shell_.contacts()[at(contact)];
  row_[at(contact)] = crowd_.add(c.contact, allowed(c), c.impulse);
  contact_of_.push_back(contact);
}

void Resting::solve_crowd(world::World& world, RestReport& report) {
  if (crowd_.rows() == 0) return;
  const Stopwatch watch;
  const double residual = crowd_.solve(options_.crowded, report.sweeps);
  report.largest_island = std::max(report.largest_island, crowd_.rows());
  report.step.contacts += crowd_.rows();
  report.step.lcp_rows += crowd_.rows();
  ++report.step.solves;
  report.step.lcp_residual = std::max(report.step.lcp_residual, residual);
  double fastest = 0;  // m in this frame
  for (int body = 0; body < static_cast<int>(crowded_.size()); ++body) {
    if (!crowded_[at(body)]) continue;
    const Crowd::Twist& twist = crowd_.velocity(body);
    fastest = std::max(fastest, dt_ * (twist.linear.norm() + tracks_[at(body)].reach * twist.angular.norm()));
  }
  for (int body = 0; body < static_cast<int>(crowded_.size()); ++body)
    if (crowded_[at(body)]) move_in_crowd(world, body, fastest < kStillCrowd * shell_.envelope());
  report.step.lcp_ns += watch.ns();
}

// Whether the body has an impulse (1), and one that carries it (2).
int Resting::pushed(const world::World& world, int body) {
  const Vec3 gravity = world.effects.gravity.value_or(Vec3(Vec3::Zero()));
  int how = 0;
  crowd_.rows_of(body, [&](int row) {
    if (how == 2 || !(crowd_.impulse(row) > 0)) return;
    const lcp::Contact& c = shell_.contacts()[at(contact_of_[at(row)])].contact;
    how = world::bears_weight(c.normal, gravity) ? 2 : 1;
  });
  return how;
}

// The body's way as the crowd's rows have it now.
void Resting::move_in_crowd(world::World& world, int number, bool stands) {
  const int how = pushed(world, number);
  RigidBody state = start_[at(number)];
  const Crowd::Twist velocity = crowd_.velocity(number), displacement = crowd_.displacement(number);
  const bool still = stands && how == 2;
  state.velocity = still ? Vec3(Vec3::Zero()) : velocity.linear;
  state.spin = still ? Vec3(Vec3::Zero()) : velocity.angular;
  world::Body& body = world.bodies[number];
  const bool held = body.held;
  take_course(world, number, how > 0, how == 2, state);
  body.held = held;
  body.steered = !displacement.linear.isZero(0) || !displacement.angular.isZero(0);
  body.steer_velocity = displacement.linear / dt_;
  body.steer_spin = displacement.angular / dt_;
  follow(world, number);
}

void Resting::move_touched(world::World& world) {
  const std::vector<int> touched = crowd_.take_touched();
  if (touched.empty()) return;
  for (const int body : touched) move_in_crowd(world, body, false);
}

void Resting::steer_crowd(world::World& world, RestReport& report) {
  slacks_.resize(at(crowd_.rows()));
  for (int row = 0; row < crowd_.rows(); ++row) {
    const double gap = end_gaps_[at(contact_of_[at(row)])], low = kLowInCrowd * shell_.envelope();
    slacks_[at(row)] = gap >= low ? gap - low : -std::min(low - gap, shell_.envelope());
  }
  CrowdOptions rough = options_.crowded;
  rough.enough = 0.05 * shell_.envelope();
  rough.most_passes = 20;
  rough.farthest = kMostSteered * shell_.envelope();
  crowd_.displace(slacks_, rough, report.steering_sweeps);
  move_touched(world);
}

}  // namespace fc::resting
