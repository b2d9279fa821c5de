// Caught by: Ex02WithoutTheMatrix.IsTheChaptersMatrix
// The arm begins at the world's origin.
#include "ex02_without_the_matrix.hpp"

#include <cmath>
#include <vector>

namespace fc::exercises {

VecX delassus_times(Masses& masses, std::span<const lcp::Contact> contacts, const VecX& z) {
  const auto bodies = static_cast<std::size_t>(masses.size());
  std::vector<Vec3> impulse(bodies, Vec3::Zero()), moment(bodies, Vec3::Zero());
  std::vector<char> touched(bodies, 0);

  // J' z: gather what the contacts do to each body.
  const auto push = [&](int body, const Vec3& point, const Vec3& j) {
    const auto k = static_cast<std::size_t>(body);
    impulse[k] += j;
    moment[k] += point.cross(j);
    touched[k] = 1;
  };
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Vec3 j = z[static_cast<Eigen::Index>(i)] * contacts[i].normal;
    push(contacts[i].body_b, contacts[i].point, j);
    push(contacts[i].body_a, contacts[i].point, -j);
  }

  // M^-1: each body answers once, to all of it together.
  std::vector<Kick> kicks(bodies);
  for (std::size_t k = 0; k < bodies; ++k) {
    const int body = static_cast<int>(k);
    if (touched[k] && !masses.is_static(body)) kicks[k] = masses.kick(body, impulse[k], moment[k]);
  }

  // J: read off how the contacts' velocities have changed.
  VecX w(z.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const auto change = [&](int body) -> Vec3 {
      const Kick& kick = kicks[static_cast<std::size_t>(body)];
      return kick.velocity + kick.spin.cross(contacts[i].point - masses.position(body));
    };
    w[static_cast<Eigen::Index>(i)] =
        contacts[i].normal.dot(change(contacts[i].body_b) - change(contacts[i].body_a));
  }
  return w;
}

double largest_eigenvalue(Masses& masses, std::span<const lcp::Contact> contacts, int products) {
  const auto n = static_cast<Eigen::Index>(contacts.size());
  if (n == 0) return 0;
  // Begin with no symmetry that the scene could have: what is orthogonal to the wanted vector stays so. The
  // golden ratio's multiples, modulo 1, look random and need no seed.
  VecX z(n);
  for (Eigen::Index i = 0; i < n; ++i) z[i] = std::fmod(0.6180339887 * static_cast<double>(i + 1), 1.0) - 0.4;
  z.normalize();
  double largest = 0;
  for (int k = 0; k < products; ++k) {
    const VecX w = delassus_times(masses, contacts, z);
    largest = std::max(largest, z.dot(w));  // Rayleigh's quotient is never above the largest eigenvalue
    const double length = w.norm();
    if (length == 0) break;
    z = w / length;
  }
  return largest;
}

}  // namespace fc::exercises
