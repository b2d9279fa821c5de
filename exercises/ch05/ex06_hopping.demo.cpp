// Exercise 5.6, to be seen: a box that falls and bounces, one that rests while another falls on it, one that touches
// without gravity, and the accounts of five boxes that fall. Writes hopping.csv.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex06_hopping.hpp"

namespace {

using namespace fc::exercises;

constexpr double kWidth = 0.001, kFrame = 1. / 60, kGravity = 9.81;
constexpr int kFrames = 120;

double energy(const Pile& pile) {  // J
  double sum = 0;
  for (const Box& box : pile.boxes)
    sum += box.mass * (0.5 * box.velocity * box.velocity + pile.gravity * box.bottom);
  return sum;
}

// N s, of all boxes: by how much m dv + m g dt is not the sum of a box's impulses.
double unexplained(const Pile& before, const Pile& after, const Report& report) {
  double worst = 0;
  for (int i = 0; i < std::ssize(after.boxes); ++i) {
    double sum =
        after.boxes[i].mass * (after.boxes[i].velocity - before.boxes[i].velocity + after.gravity * kFrame);
    for (const Impulse& impulse : report.impulses)
      sum += impulse.amount * ((impulse.box == i + 1) - (impulse.box == i));
    worst += std::abs(sum);
  }
  return worst;
}

// The height of a box that falls and bounces at h/4, m, in closed form.
double bouncing(double height, double e, double t) {
  const double fall = std::sqrt(2 * height / kGravity);
  if (t < fall) return height - 0.5 * kGravity * t * t;
  t -= fall;
  double speed = e * kGravity * fall;
  while (speed > 1e-3 && t > 2 * speed / kGravity) {
    t -= 2 * speed / kGravity;
    speed *= e;
  }
  return speed > 1e-3 ? speed * t - 0.5 * kGravity * t * t : 0;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch05_ex06";
  Pile bounce{{{1, 0.1, 0.3, 0, 0.7}}, kGravity, kWidth};
  Pile hit{{{2, 0.1, 0.5 * kWidth, 0, 0.9}, {1, 0.1, 0.1 + 2.5 * kWidth, 0, 0.9}}, kGravity, kWidth};
  Pile touch{{{1, 0.1, 0, 0, 0}}, 0, kWidth};
  Pile fall{{}, kGravity, kWidth};
  for (int i = 0; i < 5; ++i) fall.boxes.push_back({1. + i % 2, 0.1, 0.05 + 0.13 * i, 0, 0.5});
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "hopping.csv", {{"t", "s"},
                                               {"height", "m"},
                                               {"closed form", "m"},
                                               {"resting velocity", "m/s"},
                                               {"touching gap", "m"},
                                               {"momentum", "N s"}});
    double momentum = 0, made = 0, widest = 0;
    for (int frame = 0; frame <= kFrames; ++frame) {
      const double t = frame * kFrame;
      table.row({t, gap_below(bounce, 0), bouncing(0.3 - 0.25 * kWidth, 0.7, t) + 0.25 * kWidth,
                 hit.boxes[0].velocity, gap_below(touch, 0), momentum});
      for (Pile* pile : {&bounce, &hit, &touch, &fall}) {
        const Pile before = *pile;
        const Report report = step(*pile, kFrame);
        for (const Impulse& impulse : report.impulses) widest = std::max(widest, impulse.gap);
        made += std::max(0.0, energy(*pile) - energy(before) - report.lifted);
        if (pile == &fall) momentum += unexplained(before, fall, report);
      }
    }
    table.close();
    std::printf("five boxes that fall for %.0f s: %.2g N s that nothing explains\n", kFrames * kFrame,
                momentum);
    std::printf("energy that nothing explains, of all scenes: %.2g J\n", made);
    std::printf("the widest gap across which an impulse acted: %.3g h\n", widest / kWidth);
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch05_ex06_hopping.py %s\n", folder.string().c_str());
}
