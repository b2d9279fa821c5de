// The factory's worst cases of pivoting, and problems without a solution.
#include <stdexcept>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/problem_factory_parts.hpp"

namespace fc::lcp::detail {
namespace {

// 1 on the diagonal, `below` under it (Murty 1978 has 2, Csizmadia -1).
MatX lower_triangle(Eigen::Index n, double below) {
  MatX A = MatX::Identity(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < i; ++j) A(i, j) = below;
  return A;
}

// Fathi 1979: L L' of Murty's L, so symmetric positive definite; `first` of a larger one's rows left out.
MatX fathi(Eigen::Index n, Eigen::Index first) {
  const MatX L = lower_triangle(n + first, 2);
  return (L * L.transpose()).bottomRightCorner(n, n);
}

void reverse(KnownProblem& p) {
  p.A = p.A.reverse().eval();
  p.b = p.b.reverse().eval();
  p.z = p.z.reverse().eval();
  p.w = p.w.reverse().eval();
}

}  // namespace

KnownProblem worst_case(Family family, Eigen::Index n) {
  KnownProblem p;
  p.rank = n;
  p.z = VecX::Unit(n, 0);
  p.w = VecX::Ones(n);
  p.w[0] = 0;
  switch (family) {
    case Family::murty:
    case Family::murty_reversed:
      p.A = lower_triangle(n, 2);  // b = -1 everywhere
      p.symmetric = p.semidefinite = false;
      break;
    case Family::fathi:
    case Family::fathi_reversed:
      p.A = fathi(n, 0);  // b = -1 everywhere
      break;
    case Family::fathi_shifted:
    case Family::fathi_shifted_reversed:
      p.A = fathi(n, 1);  // b = -5 everywhere
      break;
    default:
      p.A = lower_triangle(n, -1);  // b = -1, 2, 0, 3, 1, 4, 2, 5, ...
      p.symmetric = p.semidefinite = false;
      for (Eigen::Index i = 0; i < n; ++i) {
        p.z[i] = i % 2 == 0 ? 1 : 0;
        p.w[i] = 1 - p.z[i];
      }
  }
  set_b(p);
  if (family >= Family::murty_reversed) reverse(p);
  return p;
}

KnownProblem insolvable_problem(Family family, Eigen::Index n, Random& random) {
  KnownProblem p;
  p.solvable = p.p_matrix = false;
  if (family == Family::infeasible) {
    // The last column of G is what makes G y = 0 with y = (whole numbers, 1).
    p.rank = n / 2;
    p.certificate = VecX::Ones(n);
    MatX G(p.rank, n);
    for (double& x : G.reshaped()) x = random.whole(-2, 2);
    for (Eigen::Index j = 0; j + 1 < n; ++j) p.certificate[j] = random.whole(0, 2);
    G.col(n - 1) = -G.leftCols(n - 1) * p.certificate.head(n - 1);
    p.A = G.transpose() * G;
    p.b.resize(n);
    for (double& x : p.b) x = random.whole(-8, 8);
    p.b[n - 1] -= p.certificate.dot(p.b) + 1;  // b'y = -1
    return p;
  }
  // Balls of 1 kg between two walls. The approach speeds sum up to 0, since the walls are at rest.
  // Restitution demands more where balls approach than it yields where they part.
  const auto balls = static_cast<int>(n) - 1;
  std::vector<RigidBody> bodies(static_cast<std::size_t>(n) + 1);
  for (int k = 1; k <= balls; ++k) {
    RigidBody& ball = bodies[static_cast<std::size_t>(k)];
    ball.position.x() = k;
    ball.velocity.x() = random.whole(-8, 8) / 8.0;
    ball.set_mass({1, Vec3::Zero(), 0.1 * Mat3::Identity()});
  }
  bodies[1].velocity.x() = 1;  // not all at rest
  std::vector<Contact> contacts;
  for (int k = 0; k <= balls; ++k) {
    Contact contact{k, k + 1, Vec3(k + 0.5, 0, 0), Vec3::UnitX(), 0, 0};
    if (contact_velocity(bodies, contact) < 0) contact.restitution = random.whole(1, 4) / 4.0;
    contacts.push_back(contact);
  }
  ImpactProblem impact = assemble(bodies, contacts);
  p.A = std::move(impact.A);
  p.b = std::move(impact.b);
  p.certificate = VecX::Ones(n);
  p.rank = n - 1;
  return p;
}

}  // namespace fc::lcp::detail
