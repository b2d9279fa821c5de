// Exercise 5.1, to be seen: how gaps come to half of the envelope, on the moon; beside it Baumgarte's method, which
// turns what a gap lacks into a velocity. Writes row.csv.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex01_row.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch05_ex01";
  const exercises::Envelope envelope{0.005, 1. / 60};
  constexpr double kMoon = 1.62;  // m/s^2
  constexpr int kFrames = 60;
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(
        folder / "row.csv",
        {{"way", ""}, {"start", "m"}, {"t", "s"}, {"gap", "m"}, {"kinetic", "J"}, {"lifted", "J"}});
    for (const double part : {0.0, 0.125, 0.375, 0.75, 1.0}) {
      exercises::Ball ball{1, part * envelope.width, 0, 0};
      double lifted = 0;
      for (int k = 0; k <= kFrames; ++k) {
        table.row({"displacements", part * envelope.width, k * envelope.dt, ball.gap,
                   0.5 * ball.velocity * ball.velocity, lifted});
        lifted += exercises::rest(envelope, kMoon, ball).energy;
      }
    }
    for (const double part : {0.0, 0.125, 0.375}) {
      double gap = part * envelope.width, velocity = 0;
      for (int k = 0; k <= kFrames; ++k) {
        table.row({"Baumgarte", part * envelope.width, k * envelope.dt, gap, 0.5 * velocity * velocity, 0.0});
        const double lacks = 0.5 * envelope.width - gap;
        const double least =
            (lacks > 0 ? 0.8 : 1) * lacks / envelope.dt;  // stiff, as one is tempted to choose it
        velocity = std::max(velocity - envelope.dt * kMoon, least);
        gap += envelope.dt * velocity;
      }
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch05_ex01_row.py %s\n", folder.string().c_str());
}
