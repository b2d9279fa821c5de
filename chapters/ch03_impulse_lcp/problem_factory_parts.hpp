// What the problem factory's files share: random numbers that are the same on every platform, and how an
// answer is planted.
#pragma once

#include <random>
#include <vector>

#include "ch03_impulse_lcp/problem_factory.hpp"

namespace fc::lcp::detail {

// The standard's distributions may differ from library to library; the engine does not.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform();                // [0, 1)
  double normal();                 // mean 0, variance 1 (Box and Muller 1958)
  int whole(int least, int most);  // least to most, both included
  double eighths() { return whole(1, 8) / 8.0; }
  template <class T>
  void shuffle(std::vector<T>& v) {
    for (int i = static_cast<int>(v.size()) - 1; i > 0; --i)
      std::swap(v[static_cast<std::size_t>(i)], v[static_cast<std::size_t>(whole(0, i))]);
  }

 private:
  std::mt19937_64 engine_;
};

// The power of two next to sqrt(A_ii); 1 where A_ii is 0.
VecX natural_scale(const MatX& A);

// G'G with G of whole numbers from -2 to 2, `rows` by n, no column zero: exact in double precision.
MatX whole_gram(Eigen::Index rows, Eigen::Index n, Random& random);

// b = w - A z, summed in extended precision and rounded once.
void set_b(KnownProblem& problem);

// Plants z and w in their natural scale, and b: `active` rows with z > 0, `degenerate` ones with z = w = 0,
// w > 0 in the others, in random order.
void plant(KnownProblem& problem, Eigen::Index active, Eigen::Index degenerate, Random& random);

// Each makes A, and states what holds for it and for its planted answer, by family.
KnownProblem random_problem(Family family, Eigen::Index n, Random& random);
KnownProblem contact_problem(Family family, Eigen::Index n, Random& random);
KnownProblem worst_case(Family family, Eigen::Index n);
KnownProblem bounded_problem(Family family, Eigen::Index n, Random& random);
KnownProblem insolvable_problem(Family family, Eigen::Index n, Random& random);

}  // namespace fc::lcp::detail
