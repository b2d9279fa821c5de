// Exercise 3.2, to be seen: what one product with A costs, with the matrix and without it. Writes cost.csv.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <vector>

#include "ch03_impulse_lcp/delassus.hpp"
#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex02_without_the_matrix.hpp"

namespace {

using namespace fc;

struct Scene {
  std::vector<RigidBody> bodies;
  std::vector<lcp::Contact> contacts;
};

RigidBody ball(const Vec3& place) {
  RigidBody body;
  body.position = place;
  body.set_mass(sphere_mass(0.5, 2));
  return body;
}
Scene row_of_balls(int contacts) {
  Scene scene;
  for (int i = 0; i <= contacts; ++i) scene.bodies.push_back(ball({i + 0.0, 0, 0}));
  for (int i = 0; i < contacts; ++i)
    scene.contacts.push_back({i, i + 1, {i + 0.5, 0, 0}, Vec3::UnitX(), 0, 0});
  return scene;
}
// The plate is free, so each ball feels all others.
Scene balls_on_a_plate(int contacts) {
  Scene scene;
  scene.bodies.resize(1);
  scene.bodies[0].set_mass(box_mass({100, 100, 0.1}, 1));
  for (int i = 0; i < contacts; ++i) {
    const double angle = 2 * std::numbers::pi * i / contacts;
    const Vec3 place(40 * std::cos(angle), 30 * std::sin(angle), 0.05);
    scene.bodies.push_back(ball(place + Vec3(0, 0, 0.5)));
    scene.contacts.push_back({0, i + 1, place, Vec3::UnitZ(), 0, 0});
  }
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch03_ex02";
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(
        folder / "cost.csv",
        {{"scene", ""}, {"contacts", ""}, {"entries of A", ""}, {"kicks", ""}, {"difference", "m/s"}});
    for (const bool on_a_plate : {false, true})
      for (int n = 4; n <= 2048; n *= 2) {
        const Scene scene = on_a_plate ? balls_on_a_plate(n) : row_of_balls(n);
        const std::string name = on_a_plate ? "balls on a free plate" : "a row of balls";
        const MatX A = lcp::assemble(scene.bodies, scene.contacts).A;
        const VecX z = VecX::LinSpaced(n, 0, 1);
        exercises::Masses masses(scene.bodies);
        const VecX w = exercises::delassus_times(masses, scene.contacts, z);
        const double difference = (w - A * z).lpNorm<Eigen::Infinity>();
        const std::int64_t entries = (A.array() != 0).count(), kicks = masses.kicks();
        table.row({name, std::int64_t{n}, entries, kicks, difference});
        if (n == 2048)
          std::printf("%s, %d contacts: %ld entries of A, or %ld kicks; the two differ by %.1e m/s\n",
                      name.c_str(), n, static_cast<long>(entries), static_cast<long>(kicks), difference);
      }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch03_ex02_without_the_matrix.py %s\n", folder.string().c_str());
}
