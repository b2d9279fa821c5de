// Exercise 6.1, to be seen: Painlevé's rod, which closes in slowly while it slides; and the direction of friction at a
// contact that is easier to move along one tangent than along the other. Writes rod.csv and directions.csv.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex01_one_contact.hpp"

namespace {

using namespace fc::mine;
using fc::Mat3, fc::Vec3;

const char* name(Kind kind) {
  return kind == Kind::open ? "open" : kind == Kind::stick ? "stick" : "slip";
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch06_ex01";
  Mat3 rod, oblique;
  rod << 1.6, -1.2, 0, -1.2, 3.4, 0, 0, 0, 4;  // 1/kg; tan θ = 2, 1 kg
  oblique << 2, 0.6, 0.2, 0.6, 1, 0.5, 0.2, 0.5, 5;
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "rod.csv", {{"mu", ""}, {"slip", "m/s"}, {"kind", ""}, {"normal", "N s"}});
    for (const double mu : {0.5, 1.2, 1.5}) {
      for (int k = -100; k <= 100; ++k) {
        const double slip = 0.01 * k;
        const Answer answer = solve_contact(rod, {-0.01, slip, 0}, mu);
        table.row({mu, slip, name(answer.kind), answer.r[0]});
      }
    }
    table.close();
    TableWriter directions(
        folder / "directions.csv",
        {{"slip", "m/s"}, {"kind", ""}, {"friction 1", ""}, {"friction 2", ""}, {"turned", "degrees"}});
    double most = 0;
    for (const double slip : {0.3, 1.0, 3.0}) {
      for (int k = 0; k < 72; ++k) {
        const double angle = 2 * std::numbers::pi * k / 72;
        const Vec3 q(-1, slip * std::cos(angle), slip * std::sin(angle));
        const Answer answer = solve_contact(oblique, q, 0.5);
        const Vec3 r = answer.r / answer.r[0];
        const double turned =
            std::atan2(r[2] * q[1] - r[1] * q[2], -r[1] * q[1] - r[2] * q[2]) * 180 / std::numbers::pi;
        if (answer.kind == Kind::slip) most = std::max(most, std::abs(turned));
        directions.row({slip, name(answer.kind), r[1], r[2], turned});
      }
    }
    directions.close();
    std::printf("friction is turned by up to %.1f degrees against the slip before the impulse\n", most);
    const Answer dead = solve_contact(rod, {-1e-9, -1, 0}, 1.5);
    std::printf("Painlevé's rod, 1 m/s along and 1 nm/s down, mu = 1.5: %s, with %.4f N s\n", name(dead.kind),
                dead.r[0]);
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch06_ex01_one_contact.py %s\n", folder.string().c_str());
}
