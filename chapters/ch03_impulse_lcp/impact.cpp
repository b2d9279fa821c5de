#include "ch03_impulse_lcp/impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/delassus.hpp"

namespace fc::lcp {
namespace {

// An approach slower than this, relative to the speeds that cancel in it, is round-off: about 4,500 epsilon,
// which leaves room for a badly conditioned matrix. Consequence: at 10 m/s two bodies may be left approaching
// at 1e-11 m/s, which takes a day to close a tolerance of 1e-6 m.
constexpr double kApproachRounding = 1e-12;
// The largest residual of a solve that is used, and the same for the velocities that the bodies then have.
// Dantzig's method gives about 1e-16; iterative solvers can reach this. Consequence: a contact may end up to
// this fraction of the speeds slower than the law says; anything still approaching faster than
// kApproachRounding is solved again.
constexpr double kResidual = 1e-10;

// The former state of a body that takes part.
struct Saved {
  std::size_t body;
  Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();
};

std::vector<Saved> save(std::span<const RigidBody> bodies, std::span<const Contact> contacts) {
  std::vector<Saved> saved;
  for (const Contact& contact : contacts) {
    for (const int body : {contact.body_a, contact.body_b}) saved.push_back({static_cast<std::size_t>(body)});
  }
  std::sort(saved.begin(), saved.end(), [](const Saved& p, const Saved& q) { return p.body < q.body; });
  const auto same = [](const Saved& p, const Saved& q) { return p.body == q.body; };
  saved.erase(std::unique(saved.begin(), saved.end(), same), saved.end());
  for (Saved& s : saved) {
    s.velocity = bodies[s.body].velocity;
    s.spin = bodies[s.body].spin;
  }
  return saved;
}

void restore(std::span<RigidBody> bodies, const std::vector<Saved>& saved) {
  for (const Saved& s : saved) {
    bodies[s.body].velocity = s.velocity;
    bodies[s.body].spin = s.spin;
  }
}

double kinetic_energy(std::span<const RigidBody> bodies, const std::vector<Saved>& saved) {
  double sum = 0;
  for (const Saved& s : saved) {
    if (!bodies[s.body].is_static()) sum += bodies[s.body].kinetic_energy();
  }
  return sum;
}

// The largest speed of a touching point if nothing cancelled in it.
double speed_scale(std::span<const RigidBody> bodies, std::span<const Contact> contacts) {
  double scale = 0;
  for (const Contact& contact : contacts) {
    for (const int index : {contact.body_a, contact.body_b}) {
      const RigidBody& body = bodies[static_cast<std::size_t>(index)];
      scale =
          std::max(scale, body.velocity.norm() + body.spin.norm() * (contact.point - body.position).norm());
    }
  }
  return scale;
}

double fastest_approach(std::span<const RigidBody> bodies, std::span<const Contact> contacts) {
  double fastest = 0;
  for (const Contact& contact : contacts) fastest = std::max(fastest, -contact_velocity(bodies, contact));
  return fastest;
}

// One solve of the instant with the restitutions that the contacts carry; `scale` (m/s) grows with the
// speeds. Returns the solver's status, or `limit` if its answer does not hold; velocities change only if it
// returns `solved`.
Status solve_once(std::span<RigidBody> bodies, std::span<const Contact> contacts,
                  const ImpactOptions& options, double& scale, ImpactResult& result) {
  const ImpactProblem problem = assemble(bodies, contacts);
  const Lcp rows{problem.A, problem.b};
  const LcpResult lcp = options.solver ? options.solver(rows) : solve_dantzig(rows);
  result.rows += static_cast<int>(problem.b.size());
  result.pivots += lcp.pivots;
  result.failed_pivots = lcp.pivots;
  result.failed_residual = lcp.residual;
  if (lcp.status != Status::solved) return lcp.status;
  const double achieved = residual(rows, lcp.z, evaluate(problem.A, problem.b, lcp.z));
  if (!(achieved <= kResidual) || !acceptable(rows, lcp.z, lcp.w)) return Status::limit;

  const std::vector<Saved> before = save(bodies, contacts);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double impulse = lcp.z[static_cast<Eigen::Index>(i)];
    if (impulse > 0) apply_impulse(bodies, contacts[i], impulse);
  }
  scale = std::max(scale, speed_scale(bodies, contacts));

  // Check the bodies, not the algebra: their velocities now must fulfil the law. Where a heavy body lies on a
  // light one, impulses of almost equal size cancel in the light one, which leaves their round-off: another
  // solve in the same instant removes it.
  const double cancelled = (problem.A.cwiseAbs() * lcp.z).maxCoeff();
  const double allowed = kResidual * scale + 8 * std::numeric_limits<double>::epsilon() * cancelled *
                                                 static_cast<double>(contacts.size());
  const std::size_t first = result.impulses.size();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double v_before = problem.v_before[row], v_after = contact_velocity(bodies, contacts[i]);
    if (!(v_after + contacts[i].restitution * v_before >= -allowed)) {
      result.impulses.resize(first);
      restore(bodies, before);
      return Status::limit;
    }
    if (lcp.z[row] <= 0) continue;
    result.impulses.push_back({static_cast<int>(i), result.solves, v_before, v_after, lcp.z[row]});
  }
  for (std::size_t k = first; k < result.impulses.size(); ++k) {
    const Impulse& p = result.impulses[k];
    const Contact& contact = contacts[static_cast<std::size_t>(p.contact)];
    const double work = kinematic_work(bodies, contact, p.impulse);
    result.kinematic_work += work;
    result.energy_identity += 0.5 * (1 - contact.restitution) * p.impulse * p.v_before + work;
  }
  result.worst_residual = std::max(result.worst_residual, achieved);
  ++result.solves;
  return Status::solved;
}

void set_restitution(std::vector<Contact>& contacts, double restitution) {
  for (Contact& contact : contacts) contact.restitution = restitution;
}

}  // namespace

void apply_impulse(std::span<RigidBody> bodies, const Contact& contact, double impulse) {
  apply_impulse(bodies, contact, Vec3(impulse * contact.normal));
}

void apply_impulse(std::span<RigidBody> bodies, const Contact& contact, const Vec3& impulse) {
  for (const bool on_b : {false, true}) {
    RigidBody& body = bodies[static_cast<std::size_t>(on_b ? contact.body_b : contact.body_a)];
    if (body.is_static()) continue;
    const Vec3 push = on_b ? impulse : Vec3(-impulse);
    body.velocity += body.inverse_mass * push.cwiseProduct(body.free_moves);
    if (!(on_b ? contact.turns_b : contact.turns_a)) continue;
    body.spin += body.inverse_inertia_world() * (contact.point - body.position).cross(push);
  }
}

double kinematic_work(std::span<const RigidBody> bodies, const Contact& contact, const Vec3& impulse) {
  double work = 0;
  for (const bool on_b : {false, true}) {
    const RigidBody& body = bodies[static_cast<std::size_t>(on_b ? contact.body_b : contact.body_a)];
    if (!body.is_static()) continue;
    const double along = impulse.dot(body.velocity_at(contact.point));
    work += on_b ? -along : along;
  }
  return work;
}

double approach_rounding(std::span<const RigidBody> bodies, std::span<const Contact> contacts) {
  return kApproachRounding * speed_scale(bodies, contacts);
}

ImpactResult resolve_impact(std::span<RigidBody> bodies, std::span<const Contact> contacts,
                            const ImpactOptions& options) {
  if (options.max_solves < 2) {
    throw std::invalid_argument("resolve_impact: max_solves is " + std::to_string(options.max_solves) +
                                "; 2 or more are needed, since the last is solved without restitution");
  }
  check_contacts(bodies, contacts);
  ImpactResult result;
  const std::vector<Saved> saved = save(bodies, contacts);
  const double energy_before = kinetic_energy(bodies, saved);

  std::vector<Contact> law(contacts.begin(), contacts.end());  // with the restitutions of the present solve
  // Round-off is measured against the fastest speeds of the instant: where all of them cancel, as in a
  // landing without bounce, the rest is round-off of the speeds before.
  double scale = speed_scale(bodies, law);
  while (result.solves < options.max_solves && fastest_approach(bodies, law) > kApproachRounding * scale) {
    if (result.solves == options.max_solves - 1) set_restitution(law, 0);
    result.status = solve_once(bodies, law, options, scale, result);
    if (result.status == Status::solved) continue;

    // With one restitution for all a solution always exists; with mixed ones it need not.
    const auto [smallest, largest] =
        std::minmax_element(law.begin(), law.end(),
                            [](const Contact& p, const Contact& q) { return p.restitution < q.restitution; });
    if (smallest->restitution < largest->restitution) {
      result.restitution_lowered = true;
      set_restitution(law, smallest->restitution);
      continue;
    }
    break;
  }

  result.fastest_approach = fastest_approach(bodies, law);
  if (result.fastest_approach > kResidual * scale && result.status == Status::solved) {
    result.status = Status::limit;
  }
  if (result.status != Status::solved) {
    restore(bodies, saved);
    result.impulses.clear();
    result.energy_identity = result.kinematic_work = 0;
    return result;
  }
  result.energy_change = kinetic_energy(bodies, saved) - energy_before;
  return result;
}

}  // namespace fc::lcp
