// Exercise 6.3, to be seen: how the residual falls, sweep by sweep, in three problems, one of which goes in circles;
// and a braking block on two feet. Writes sweeps.csv and block.csv.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex03_many_contacts.hpp"

namespace {

using namespace fc::exercises;
using fc::MatX, fc::Vec3, fc::VecX;

// Contacts of bodies with this number of degrees of freedom in all.
Problem random_problem(unsigned seed, int count, double mu, int freedoms) {
  std::mt19937_64 random(seed);
  const auto any = [&] { return 2 * static_cast<double>(random() >> 11) / 9007199254740992.0 - 1; };
  MatX J(3 * count, freedoms);
  for (Eigen::Index i = 0; i < J.size(); ++i) J.data()[i] = any();
  Problem problem{J * J.transpose() + 0.02 * MatX::Identity(3 * count, 3 * count), VecX(3 * count),
                  VecX::Constant(count, mu)};
  for (int i = 0; i < 3 * count; ++i) problem.b[i] = i % 3 == 0 ? -0.2 - std::abs(any()) : 2 * any();
  return problem;
}

// A block of 2 kg that slides in a plane, its feet 0.6 m apart and 0.5 m below its centre; with gravity for 1/60 s.
Problem block(double mu) {
  MatX J = MatX::Zero(6, 3);
  for (int i = 0; i < 2; ++i) {
    J.row(3 * i) << 0, 1, i == 0 ? 0.3 : -0.3;
    J.row(3 * i + 1) << 1, 0, -0.5;
  }
  MatX A = J * Vec3(0.5, 0.5, 4).asDiagonal() * J.transpose();
  A(2, 2) = A(5, 5) = 1;
  return {A, J * Vec3(5, -9.81 / 60, 0), VecX::Constant(2, mu)};
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch06_ex03";
  const Problem easy = random_problem(1, 3, 0.3, 12), circles = random_problem(77, 3, 1, 6);
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "sweeps.csv",
                      {{"sweeps", ""}, {"easy", ""}, {"block", ""}, {"circles", ""}, {"relaxation", ""}});
    for (int sweeps = 0; sweeps <= 400; ++sweeps) {
      const Result hard = solve(circles, 0, sweeps);
      table.row({static_cast<std::int64_t>(sweeps), solve(easy, 0, sweeps).residual,
                 solve(block(0.4), 0, sweeps).residual, hard.residual, hard.relaxation});
    }
    table.close();
    TableWriter feet(folder / "block.csv", {{"mu", ""}, {"rear", "N"}, {"front", "N"}, {"heat", "W"}});
    for (int k = 0; k <= 80; ++k) {
      const Problem problem = block(0.01 * k);
      const Result found = solve(problem, 1e-12, 2000);
      feet.row({0.01 * k, 60 * found.r[0], 60 * found.r[3], 60 * heat(problem, found.r)});
    }
    feet.close();
    const Result end = solve(circles, 1e-12, 2000);
    std::printf("three contacts with mu = 1: %s after %d sweeps, relaxed by %g\n",
                end.solved ? "solved" : "not solved", end.sweeps, end.relaxation);
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch06_ex03_many_contacts.py %s\n", folder.string().c_str());
}
