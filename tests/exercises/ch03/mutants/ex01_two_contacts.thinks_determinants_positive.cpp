// Caught by: Ex01TwoContacts.AMatrixOfNoFrictionlessWorld
// The sign of the determinant is forgotten.
#include "ex01_two_contacts.hpp"

namespace fc::exercises {

std::vector<Answer> solve_two(const Mat2& A, const Vec2& b) {
  std::vector<Answer> answers;

  // Nobody pushes.
  if (b[0] >= 0 && b[1] >= 0) answers.push_back({Vec2::Zero(), b});

  // One pushes: z_i = -b_i / A_ii and w_k = b_k + A_ki z_i. The signs are taken of the numerators, which are
  // exact; a quotient that was rounded would not say on which side of a tie it lies.
  for (const int i : {0, 1}) {
    const int k = 1 - i;
    const double pivot = A(i, i), sign = pivot < 0 ? -1 : 1;
    const double z = -b[i], w = pivot * b[k] - A(k, i) * b[i];
    if (pivot == 0 || sign * z <= 0 || sign * w < 0) continue;
    Answer answer{Vec2::Zero(), Vec2::Zero()};
    answer.z[i] = z / pivot;
    answer.w[k] = w / pivot;
    answers.push_back(answer);
  }

  // Both push: Cramer's rule. A tie, z_i = 0, is the answer of one of the cases above.
  const double det = A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0), sign = 1;
  const double z0 = A(0, 1) * b[1] - A(1, 1) * b[0], z1 = A(1, 0) * b[0] - A(0, 0) * b[1];
  if (det != 0 && sign * z0 > 0 && sign * z1 > 0) answers.push_back({Vec2(z0 / det, z1 / det), Vec2::Zero()});
  return answers;
}

}  // namespace fc::exercises
