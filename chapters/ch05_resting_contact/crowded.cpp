// Of a frame: bodies in crowds.
#include <algorithm>

#include "ch05_resting_contact/resting.hpp"
#include "common/stopwatch.hpp"

namespace fc::resting {
namespace {

// If no point of a crowd is faster than this part of the envelope in a frame, it stands still: its impulses
// are not more exact than that.
constexpr double kStillCrowd = 1e-3;

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
  mark_pushed(world);
  for (int body = 0; body < static_cast<int>(crowded_.size()); ++body)
    if (crowded_[at(body)]) move_in_crowd(world, body, fastest < kStillCrowd * shell_.envelope());
  report.step.lcp_ns += watch.ns();
}

// Which bodies of the crowd have an impulse (1), and which one that carries them (2).
void Resting::mark_pushed(const world::World& world) {
  const Vec3 gravity = world.effects.gravity.value_or(Vec3(Vec3::Zero()));
  pushed_.assign(world.bodies.size(), 0);
  for (int row = 0; row < crowd_.rows(); ++row) {
    if (!(crowd_.impulse(row) > 0)) continue;
    const lcp::Contact& c = shell_.contacts()[at(contact_of_[at(row)])].contact;
    const char how = world::bears_weight(c.normal, gravity) ? 2 : 1;
    for (const int body : {c.body_a, c.body_b}) pushed_[at(body)] = std::max(pushed_[at(body)], how);
  }
}

// The body's way as the crowd's rows have it now.
void Resting::move_in_crowd(world::World& world, int number, bool stands) {
  const char pushed = pushed_[at(number)];
  RigidBody state = start_[at(number)];
  const Crowd::Twist &velocity = crowd_.velocity(number), &displacement = crowd_.displacement(number);
  const bool still = stands && pushed == 2;
  state.velocity = still ? Vec3(Vec3::Zero()) : velocity.linear;
  state.spin = still ? Vec3(Vec3::Zero()) : velocity.angular;
  take_course(world, number, pushed > 0, pushed == 2, state);
  world::Body& body = world.bodies[number];
  body.steered = !displacement.linear.isZero(0) || !displacement.angular.isZero(0);
  body.steer_velocity = displacement.linear / dt_;
  body.steer_spin = displacement.angular / dt_;
  follow(world, number);
}

void Resting::move_touched(world::World& world) {
  const std::vector<int> touched = crowd_.take_touched();
  if (touched.empty()) return;
  mark_pushed(world);
  for (const int body : touched) move_in_crowd(world, body, false);
}

void Resting::steer_crowd(world::World& world, RestReport& report) {
  slacks_.resize(at(crowd_.rows()));
  for (int row = 0; row < crowd_.rows(); ++row) slacks_[at(row)] = slack(end_gaps_[at(contact_of_[at(row)])]);
  CrowdOptions rough = options_.crowded;
  rough.enough = 0.02 * shell_.envelope();
  rough.farthest = kMostSteered * shell_.envelope();
  crowd_.displace(slacks_, rough, report.steering_sweeps);
  move_touched(world);
}

}  // namespace fc::resting
