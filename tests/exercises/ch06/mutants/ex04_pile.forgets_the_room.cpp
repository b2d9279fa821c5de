// Caught by: Ex06Pile.OneContact
// A gap that may be used up is not used.
#include "ex04_pile.hpp"

#include <algorithm>
#include <cmath>

namespace fc::exercises {
namespace {

void give(Ball& ball, const Vec3& arm, const Vec3& impulse) {
  ball.velocity += impulse / ball.mass;
  ball.spin += arm.cross(impulse) / (0.4 * ball.mass * ball.radius * ball.radius);
}

}  // namespace

Vec3 solve_contact(double a, double d, const Vec3& q, const Vec3& normal, double room, double mu) {
  const double closing = q.dot(normal);
  const double push = std::max(0.0, -(closing + 0 * room) / a);
  const Vec3 stop = -(q - closing * normal) / d;
  const double size = stop.norm(), most = mu * push;
  return push * normal + (size > most ? most / size : 1.0) * stop;
}

double sweep(std::vector<Ball>& balls, std::vector<Contact>& contacts) {
  double largest = 0;
  for (Contact& contact : contacts) {
    Ball& b = balls[static_cast<std::size_t>(contact.b)];
    Ball* a = contact.a >= 0 ? &balls[static_cast<std::size_t>(contact.a)] : nullptr;
    const Vec3& n = contact.normal;
    const Vec3 arm_b = -b.radius * n, arm_a = a ? Vec3(a->radius * n) : Vec3(Vec3::Zero());
    const double mobility = 1 / b.mass + (a ? 1 / a->mass : 0);
    // r^2 / (2/5 m r^2) = 5/2 of 1/m: along a tangent an impulse moves and turns the ball.
    const double turning = 3.5 * mobility;

    // The velocity without this contact's impulse: what there is, less what the impulse has done.
    Vec3 q = b.velocity + b.spin.cross(arm_b);
    if (a) q -= a->velocity + a->spin.cross(arm_a);
    const Vec3 push = contact.impulse.dot(n) * n;
    q -= mobility * push + turning * (contact.impulse - push);

    const Vec3 now = solve_contact(mobility, turning, q, n, contact.room, contact.mu);
    const Vec3 change = now - contact.impulse;
    give(b, arm_b, change);
    if (a) give(*a, arm_a, -change);
    contact.impulse = now;
    const double along = change.dot(n);
    largest = std::max({largest, mobility * std::abs(along), turning * (change - along * n).norm()});
  }
  return largest;
}

}  // namespace fc::exercises
