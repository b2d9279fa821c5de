#include "ex03_one_by_one.hpp"

namespace fc::exercises {
namespace {

// By how much 1 N s along the contact's normal changes one body's share of the contact's velocity, 1/kg.
double response(const RigidBody& body, const lcp::Contact& contact) {
  const Vec3 arm = (contact.point - body.position).cross(contact.normal);
  return body.inverse_mass + arm.dot(body.inverse_inertia_world() * arm);
}

void push(RigidBody& body, const Vec3& point, const Vec3& impulse) {
  body.velocity += body.inverse_mass * impulse;
  body.spin += body.inverse_inertia_world() * (point - body.position).cross(impulse);
}

bool can_move(const RigidBody& body) {
  return body.inverse_mass > 0;
}

void hit(RigidBody& a, RigidBody& b, const lcp::Contact& contact, double v) {
  const double j = -(1 + contact.restitution) * v / (response(a, contact) + response(b, contact));
  push(a, contact.point, -j * contact.normal);
  push(b, contact.point, j * contact.normal);
}

}  // namespace

Sequence resolve_one_by_one(std::span<RigidBody> bodies, std::span<const lcp::Contact> contacts,
                            Choice choice, double slowest, int most) {
  Sequence sequence;
  const int n = static_cast<int>(contacts.size());
  // m/s, negative: approaching. What no impulse changes does not count.
  const auto velocity = [&](int i) {
    const lcp::Contact& c = contacts[static_cast<std::size_t>(i)];
    const bool served = can_move(bodies[static_cast<std::size_t>(c.body_a)]) ||
                        can_move(bodies[static_cast<std::size_t>(c.body_b)]);
    return served ? lcp::contact_velocity(bodies, c) : 0;
  };

  int next = 0;  // where the search begins
  while (true) {
    // Find who is hit: the first from `next` on, or the fastest of all. Going round once is enough to know
    // that nobody is left.
    int chosen = -1;
    double v = -slowest;
    for (int k = 0; k < n; ++k) {
      const int i = choice == Choice::in_turn ? (next + k) % n : k;
      if (velocity(i) >= v) continue;
      chosen = i;
      v = velocity(i);
      if (choice == Choice::in_turn) break;
    }
    if (chosen < 0) {
      sequence.status = lcp::Status::solved;
      return sequence;
    }
    if (sequence.hits == most) return sequence;

    const lcp::Contact& contact = contacts[static_cast<std::size_t>(chosen)];
    hit(bodies[static_cast<std::size_t>(contact.body_a)], bodies[static_cast<std::size_t>(contact.body_b)],
        contact, v);
    ++sequence.hits;
    next = (chosen + 1) % n;
  }
}

}  // namespace fc::exercises
