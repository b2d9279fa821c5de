// Exercise 4.5, to be seen: the learner's steps and explicit ones, compared with the closed form. Writes tumble.csv.
#include <cstdio>
#include <filesystem>

#include "ch04_multibody_stepping/torque_free.hpp"
#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex05_tumble.hpp"

namespace {

using namespace fc;
using exercises::Tumbler;

// Uses the spin at the start for the whole step.
void explicit_step(Tumbler& body, double h) {
  const Vec3 spin = body.momentum.cwiseQuotient(body.moments);
  body.rotation = body.rotation * Eigen::AngleAxisd(h * spin.norm(), spin.normalized()).toRotationMatrix();
  body.momentum += h * body.momentum.cross(spin);
}
double energy(const Tumbler& body) {
  return 0.5 * body.momentum.dot(body.momentum.cwiseQuotient(body.moments));
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch04_ex05";
  constexpr double kSeconds = 10;
  const Vec3 spin(0.05, 2, 0.1);
  Tumbler start;
  start.moments = {5, 10, 13};
  start.momentum = start.moments.cwiseProduct(spin);
  const world::TorqueFree exact(Mat3(start.moments.asDiagonal()), Mat3::Identity(), spin);
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "tumble.csv", {{"step", "s"},
                                              {"error", ""},
                                              {"energy error", ""},
                                              {"explicit error", ""},
                                              {"explicit energy error", ""}});
    for (int steps = 64; steps <= 16384; steps *= 2) {
      const double h = kSeconds / steps;
      Tumbler learners = start, plain = start;
      for (int k = 0; k < steps; ++k) {
        exercises::step(learners, h);
        explicit_step(plain, h);
      }
      const Mat3 truth = exact.rotation_at(kSeconds);
      const auto off = [&](const Tumbler& body) { return std::abs(energy(body) / energy(start) - 1); };
      table.row({h, (learners.rotation - truth).norm(), off(learners), (plain.rotation - truth).norm(),
                 off(plain)});
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch04_ex05_tumble.py %s\n", folder.string().c_str());
}
