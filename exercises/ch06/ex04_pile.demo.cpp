// Exercise 6.4, to be seen: fifteen balls in a triangle, with much and with little friction, and a ball that slips
// until it rolls. Writes balls.csv and roll.csv.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex04_pile.hpp"

namespace {

using namespace fc::exercises;
using fc::Vec3;

constexpr double kStep = 1. / 120;

Pile triangle(int rows, double mu) {
  Pile pile;
  pile.planes = {{}};
  pile.mu = mu;
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < rows - row; ++k)
      pile.balls.push_back(
          {1, 0.1, {0.2 * k + 0.1 * row, 0, 0.1 + row * 0.1 * std::sqrt(3.0)}, Vec3::Zero(), Vec3::Zero()});
  return pile;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch06_ex04";
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "balls.csv", {{"mu", ""}, {"t", "s"}, {"ball", ""}, {"x", "m"}, {"z", "m"}});
    for (const double mu : {0.8, 0.5}) {
      Pile pile = triangle(5, mu);
      double most = 0;
      for (int k = 0; k <= 60; ++k) {
        for (std::size_t i = 0; k % 30 == 0 && i < pile.balls.size(); ++i)
          table.row({mu, k * kStep, static_cast<std::int64_t>(i), pile.balls[i].centre[0],
                     pile.balls[i].centre[2]});
        const double before = energy(pile);
        step(pile, kStep);
        most = std::max(most, energy(pile) - before);
      }
      const double way = (pile.balls.back().centre - triangle(5, mu).balls.back().centre).norm();
      std::printf("mu = %.1f: the top has moved by %.2g m, energy grew by %.1g J at most in a step\n", mu,
                  way, most);
    }
    table.close();
    TableWriter roll(folder / "roll.csv", {{"t", "s"}, {"velocity", "m/s"}, {"rim", "m/s"}});
    Pile pile;
    pile.planes = {{}};
    pile.mu = 0.2;
    pile.balls = {{1, 0.1, {0, 0, 0.1}, {3, 0, 0}, Vec3::Zero()}};
    for (int k = 0; k <= 90; ++k) {
      roll.row({k * kStep, pile.balls[0].velocity[0], pile.balls[0].spin[1] * 0.1});
      step(pile, kStep);
    }
    roll.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch06_ex04_pile.py %s\n", folder.string().c_str());
}
