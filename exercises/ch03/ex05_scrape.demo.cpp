// Demo of exercise 3.5: a ball is thrown at the floor with more and more speed along it. Writes scrape.csv.
#include <cstdio>
#include <filesystem>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex05_scrape.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch03_ex05";
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "scrape.csv", {{"friction", ""},
                                              {"speed before", "m/s"},
                                              {"speed after", "m/s"},
                                              {"slip after", "m/s"},
                                              {"friction impulse", "N s"}});
    for (const double friction : {0.1, 0.3, 0.5}) {
      for (int k = 0; k <= 80; ++k) {
        RigidBody ball;
        ball.position = {0, 0, 0.5};
        ball.velocity = {0.1 * k, 0, -1};
        ball.set_mass(sphere_mass(0.5, 2));
        const exercises::Touch touch{Vec3::Zero(), Vec3::UnitZ(), Vec3::UnitX(), 0.5, friction};
        const exercises::Scrape j = exercises::scrape(ball, touch);
        table.row({friction, 0.1 * k, ball.velocity.x(), ball.velocity_at(touch.point).x(), j.along});
      }
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch03_ex05_scrape.py %s\n", folder.string().c_str());
}
