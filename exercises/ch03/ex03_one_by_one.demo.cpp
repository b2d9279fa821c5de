// Demo of exercise 3.3: a break shot at pool, one contact after the other and all at once. Writes balls.csv.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "ch03_impulse_lcp/impact.hpp"
#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex03_one_by_one.hpp"

namespace {

using namespace fc;

struct Scene {
  std::vector<RigidBody> bodies;
  std::vector<lcp::Contact> contacts;
};

// Fifteen balls of 57 mm in a triangle, and the cue ball below its tip, all touching. Half of the list of
// contacts runs from left to right, so the list itself is not symmetric.
Scene rack() {
  const double diameter = 0.057;
  Scene scene;
  const auto add = [&](double x, double y) {
    RigidBody body;
    body.position = diameter * Vec3(x, y, 0);
    body.set_mass(sphere_mass(diameter / 2, 1700));
    scene.bodies.push_back(body);
  };
  const double up = std::sqrt(0.75);
  add(0, -1);
  for (int row = 0; row < 5; ++row)
    for (int k = 0; k <= row; ++k) add(k - row / 2.0, row * up);
  scene.bodies[0].velocity = {0, 5, 0};
  for (int i = 0; i < 16; ++i)
    for (int k = i + 1; k < 16; ++k) {
      const Vec3 &a = scene.bodies[static_cast<std::size_t>(i)].position,
                 &b = scene.bodies[static_cast<std::size_t>(k)].position;
      if ((b - a).norm() < 1.001 * diameter)
        scene.contacts.push_back({i, k, (a + b) / 2, (b - a).normalized(), 0, 0.95});
    }
  return scene;
}

// How far the velocities are from their own mirror image, m/s: the largest difference between a ball and its
// mirror image.
double asymmetry(const Scene& scene) {
  double worst = 0;
  for (const RigidBody& p : scene.bodies)
    for (const RigidBody& q : scene.bodies) {
      const Vec3 mirror(-q.position.x(), q.position.y(), 0), v(-q.velocity.x(), q.velocity.y(), 0);
      if ((p.position - mirror).norm() < 1e-6) worst = std::max(worst, (p.velocity - v).norm());
    }
  return worst;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch03_ex03";
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "balls.csv",
                      {{"method", ""}, {"x", "m"}, {"y", "m"}, {"vx", "m/s"}, {"vy", "m/s"}});
    for (const std::string method : {"all at once", "in turn", "the fastest first"}) {
      Scene scene = rack();
      int hits = 0;
      if (method == "all at once") {
        hits = static_cast<int>(lcp::resolve_impact(scene.bodies, scene.contacts).impulses.size());
      } else {
        const auto choice = method == "in turn" ? exercises::Choice::in_turn : exercises::Choice::fastest;
        hits = exercises::resolve_one_by_one(scene.bodies, scene.contacts, choice, 1e-9, 100000).hits;
      }
      double energy = 0;
      for (const RigidBody& body : scene.bodies) {
        table.row({method, body.position.x(), body.position.y(), body.velocity.x(), body.velocity.y()});
        energy += body.kinetic_energy();
      }
      std::printf("%s: %d impulses, %.4f J, and up to %.4f m/s between a ball and its mirror image\n",
                  method.c_str(), hits, energy, asymmetry(scene));
    }
    table.close();
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch03_ex03_one_by_one.py %s\n", folder.string().c_str());
}
