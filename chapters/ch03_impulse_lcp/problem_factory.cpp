#include "ch03_impulse_lcp/problem_factory.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "ch03_impulse_lcp/problem_factory_parts.hpp"

namespace fc::lcp {
namespace detail {

double Random::uniform() {
  return static_cast<double>(engine_() >> 11) * 0x1p-53;
}

double Random::normal() {
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

int Random::whole(int least, int most) {
  return least + static_cast<int>(uniform() * (most - least + 1));
}

VecX natural_scale(const MatX& A) {
  VecX d(A.rows());
  for (Eigen::Index i = 0; i < d.size(); ++i)
    d[i] = A(i, i) > 0 ? std::exp2(std::round(0.5 * std::log2(A(i, i)))) : 1.0;
  return d;
}

MatX whole_gram(Eigen::Index rows, Eigen::Index n, Random& random) {
  MatX G(rows, n);
  for (double& x : G.reshaped()) x = random.whole(-2, 2);
  for (Eigen::Index j = 0; j < n; ++j)
    if (G.col(j).isZero(0)) G(0, j) = 1;
  return G.transpose() * G;
}

void set_b(KnownProblem& problem) {
  problem.b.resize(problem.w.size());
  for (Eigen::Index i = 0; i < problem.b.size(); ++i) {
    long double sum = problem.w[i];
    for (Eigen::Index j = 0; j < problem.b.size(); ++j)
      sum -= static_cast<long double>(problem.A(i, j)) * problem.z[j];
    problem.b[i] = static_cast<double>(sum);
  }
}

void plant(KnownProblem& problem, Eigen::Index active, Eigen::Index degenerate, Random& random) {
  const VecX scale = natural_scale(problem.A);
  const Eigen::Index n = scale.size();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) order[static_cast<std::size_t>(i)] = i;
  random.shuffle(order);
  problem.z = problem.w = VecX::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index i = order[static_cast<std::size_t>(k)];
    if (k < active)
      problem.z[i] = random.eighths() / scale[i];
    else if (k >= active + degenerate)
      problem.w[i] = random.eighths() * scale[i];
  }
  set_b(problem);
}

}  // namespace detail

std::string_view name(Family family) {
  constexpr std::array<std::string_view, kFamilies.size()> kNames = {"random_spd",
                                                                     "spd_1e4",
                                                                     "spd_1e8",
                                                                     "spd_1e12",
                                                                     "all_active",
                                                                     "degenerate",
                                                                     "rank_deficient",
                                                                     "duplicate_contacts",
                                                                     "stack",
                                                                     "stack_1e4",
                                                                     "stack_1e8",
                                                                     "tower_1e8",
                                                                     "chain_1e8",
                                                                     "ball_heap",
                                                                     "box_heap",
                                                                     "graded",
                                                                     "hilbert",
                                                                     "murty",
                                                                     "fathi",
                                                                     "fathi_shifted",
                                                                     "csizmadia",
                                                                     "murty_reversed",
                                                                     "fathi_reversed",
                                                                     "fathi_shifted_reversed",
                                                                     "csizmadia_reversed",
                                                                     "positive_definite",
                                                                     "triangular",
                                                                     "boxed",
                                                                     "boxed_deficient",
                                                                     "infeasible",
                                                                     "squeezed"};
  return kNames.at(static_cast<std::size_t>(family));
}

double planted_floor(const KnownProblem& problem) {
  if (problem.exact || !problem.solvable) return 0;
  const double n = static_cast<double>(problem.b.size());
  return 0.5 * std::numeric_limits<double>::epsilon() +
         2 * n * static_cast<double>(std::numeric_limits<long double>::epsilon());
}

KnownProblem make_problem(Family family, Eigen::Index n, std::uint64_t seed) {
  const bool fours = (family >= Family::duplicate_contacts && family <= Family::stack_1e8) ||
                     family == Family::boxed || family == Family::boxed_deficient;
  if (n < 4 || n > 10'000 || (fours && n % 4 != 0)) {
    throw std::invalid_argument("a problem of the family " + std::string(name(family)) + " cannot have " +
                                std::to_string(n) + " rows; 4 to 10000" + (fours ? ", a multiple of 4" : "") +
                                " are needed");
  }
  // Different families with the same seed have nothing in common.
  detail::Random random(seed * kFamilies.size() + static_cast<std::uint64_t>(family));
  const auto make = [&] {
    if (family >= Family::infeasible) return detail::insolvable_problem(family, n, random);
    if (family >= Family::boxed) return detail::bounded_problem(family, n, random);
    if (family >= Family::murty && family <= Family::csizmadia_reversed) return detail::worst_case(family, n);
    if (family >= Family::duplicate_contacts && family <= Family::box_heap)
      return detail::contact_problem(family, n, random);
    return detail::random_problem(family, n, random);
  };
  KnownProblem problem = make();
  problem.family = family;
  problem.seed = seed;
  return problem;
}

}  // namespace fc::lcp
