#include "ch03_impulse_lcp/delassus.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace fc::lcp {
namespace {

// The largest deviation of |n|^2 from 1, far above the round-off of a normalised vector. A normal that
// deviates more is a caller's mistake, and would silently scale impulses.
constexpr double kUnitNormal = 1e-9;

// One of the two bodies of a contact.
struct Side {
  int contact;       // the row
  double sign;       // +1 on B, -1 on A
  Vec3 normal;       // the row of J for the body's velocity, without the sign, along what is free
  Vec3 arm;          // r x n: the row of J for the body's spin
  Vec3 spin_change;  // I^-1 (r x n): what a unit impulse does to the spin
};

void check_contact(const Contact& contact, std::size_t index, std::size_t bodies) {
  const std::string where = "contact " + std::to_string(index) + ": ";
  const auto valid = [bodies](int body) { return body >= 0 && static_cast<std::size_t>(body) < bodies; };
  if (!valid(contact.body_a) || !valid(contact.body_b) || contact.body_a == contact.body_b) {
    throw std::invalid_argument(where + "bodies " + std::to_string(contact.body_a) + " and " +
                                std::to_string(contact.body_b) + " of " + std::to_string(bodies) +
                                "; two different bodies are needed");
  }
  if (!contact.point.allFinite()) throw std::invalid_argument(where + "the point is not finite");
  if (!(std::abs(contact.normal.squaredNorm() - 1) <= kUnitNormal)) {
    throw std::invalid_argument(where + "the normal's length is " + std::to_string(contact.normal.norm()) +
                                ", not 1");
  }
  if (!(contact.restitution >= 0 && contact.restitution <= 1)) {
    throw std::invalid_argument(where + "the restitution is " + std::to_string(contact.restitution) +
                                ", outside [0, 1]");
  }
}

// Adds to A the coupling of all contacts of one moving body.
void add_body(const RigidBody& body, const std::vector<Side>& sides, MatX& A) {
  for (std::size_t s = 0; s < sides.size(); ++s) {
    for (std::size_t t = 0; t <= s; ++t) {
      const Side& p = sides[s];
      const Side& q = sides[t];
      const double shared =
          p.sign * q.sign * (body.inverse_mass * p.normal.dot(q.normal) + p.arm.dot(q.spin_change));
      A(p.contact, q.contact) += shared;
      if (p.contact != q.contact) A(q.contact, p.contact) += shared;
    }
  }
}

}  // namespace

void check_contacts(std::span<const RigidBody> bodies, std::span<const Contact> contacts) {
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    check_contact(contacts[i], i, bodies.size());
    if (!std::isfinite(contact_velocity(bodies, contacts[i]))) {
      throw std::invalid_argument("contact " + std::to_string(i) + ": its velocity is not finite");
    }
  }
}

ImpactProblem assemble(std::span<const RigidBody> bodies, std::span<const Contact> contacts) {
  check_contacts(bodies, contacts);
  const auto n = static_cast<Eigen::Index>(contacts.size());
  ImpactProblem problem{MatX::Zero(n, n), VecX(n), VecX(n)};

  // Collect the contacts of each body that can move.
  std::vector<std::vector<Side>> sides(bodies.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& contact = contacts[i];
    const double v = contact_velocity(bodies, contact);
    const auto row = static_cast<Eigen::Index>(i);
    problem.v_before[row] = v;
    problem.b[row] = (1 + contact.restitution) * v;
    for (const bool on_b : {false, true}) {
      const auto index = static_cast<std::size_t>(on_b ? contact.body_b : contact.body_a);
      const RigidBody& body = bodies[index];
      if (body.is_static()) continue;
      Side side{static_cast<int>(i), on_b ? 1.0 : -1.0, contact.normal.cwiseProduct(body.free_moves),
                Vec3::Zero(), Vec3::Zero()};
      if (on_b ? contact.turns_b : contact.turns_a) {
        side.arm = (contact.point - body.position).cross(contact.normal);
        side.spin_change = body.inverse_inertia_world() * side.arm;
      }
      sides[index].push_back(side);
    }
  }

  for (std::size_t k = 0; k < bodies.size(); ++k) add_body(bodies[k], sides[k], problem.A);
  return problem;
}

DelassusOperator::DelassusOperator(std::span<const RigidBody> bodies, std::span<const Contact> contacts)
    : changes_(bodies.size()) {
  check_contacts(bodies, contacts);
  for (const Contact& contact : contacts) {
    const auto part = [&](int index, bool turns) -> Part {
      const RigidBody& body = bodies[static_cast<std::size_t>(index)];
      if (body.is_static()) return {-1, Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), 0};
      const Vec3 moves = contact.normal.cwiseProduct(body.free_moves);
      if (!turns) return {index, moves, Vec3::Zero(), Vec3::Zero(), body.inverse_mass};
      const Vec3 arm = (contact.point - body.position).cross(contact.normal);
      return {index, moves, arm, body.inverse_inertia_world() * arm, body.inverse_mass};
    };
    rows_.push_back(
        {contact.normal, part(contact.body_a, contact.turns_a), part(contact.body_b, contact.turns_b)});
  }
}

// ANCHOR: operator
void DelassusOperator::apply(const VecX& z, VecX& v) {
  for (Change& change : changes_) change = {Vec3::Zero(), Vec3::Zero()};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double impulse = z[static_cast<Eigen::Index>(i)];
    const auto push = [&](const Part& part, double along_n) {
      if (part.body < 0) return;
      Change& change = changes_[static_cast<std::size_t>(part.body)];
      change.velocity += along_n * part.inverse_mass * part.moves;
      change.spin += along_n * part.spin_change;
    };
    push(rows_[i].a, -impulse);
    push(rows_[i].b, impulse);
  }
  v.resize(size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto speed = [&](const Part& part) {
      if (part.body < 0) return 0.0;
      const Change& change = changes_[static_cast<std::size_t>(part.body)];
      return rows_[i].normal.dot(change.velocity) + part.arm.dot(change.spin);
    };
    v[static_cast<Eigen::Index>(i)] = speed(rows_[i].b) - speed(rows_[i].a);
  }
}
// ANCHOR_END: operator

VecX DelassusOperator::diagonal() const {
  VecX diagonal(size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    double sum = 0;
    for (const Part& part : {rows_[i].a, rows_[i].b}) {
      if (part.body >= 0)
        sum += part.inverse_mass * part.moves.squaredNorm() + part.arm.dot(part.spin_change);
    }
    diagonal[static_cast<Eigen::Index>(i)] = sum;
  }
  return diagonal;
}

}  // namespace fc::lcp
