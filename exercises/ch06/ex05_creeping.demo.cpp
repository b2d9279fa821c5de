// Exercise 6.5, to be seen: a cube on a slope, one that slides down, one that is corrected again and again, and a rod
// that is thrown. Writes creeping.csv.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "common/table.hpp"
#include "common/todo.hpp"
#include "ex05_creeping.hpp"

namespace {

using namespace fc::exercises;
using fc::Mat3, fc::Vec3;

constexpr double kFrame = 1. / 60, kGravity = 9.81;
constexpr int kFrames = 120;

double energy(const Scene& scene) {  // J
  const Body& body = scene.body;
  return 0.5 * body.mass * body.velocity.squaredNorm() + 0.5 * body.inertia * body.spin.squaredNorm() -
         body.mass * scene.gravity.dot(body.centre);
}

// A cube of 1 kg, 0.2 m wide, on a floor that is tilted: tan = 3/4, or level.
Scene cube(double friction, bool tilted) {
  Scene scene;
  scene.floor.friction = friction;
  scene.body.inertia = 0.04 / 6;
  for (const double x : {-0.1, 0.1})
    for (const double y : {-0.1, 0.1})
      for (const double z : {-0.1, 0.1}) scene.body.feet.push_back({{x, y, z}});
  scene.body.centre = {0, 0, 0.1 + 0.5 * scene.margin};
  if (!tilted) return scene;
  Mat3 turn;
  turn << 0.8, 0, 0.6, 0, 1, 0, -0.6, 0, 0.8;
  scene.body.centre = turn * scene.body.centre;
  scene.body.turn = turn;
  scene.floor.normal = turn.col(2);
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fc;
  const std::filesystem::path folder = argc > 1 ? argv[1] : "out/ch06_ex05";
  const Vec3 down(0.8, 0, -0.6);
  Scene stands = cube(0.9, true), slides = cube(0.5, true), knocked = cube(0.8, false),
        thrown = cube(0.6, false);
  slides.body.velocity = down;
  // A rod of 2 m that leans by 45 degrees, and comes down on its end.
  thrown.floor.friction = 0.5;
  thrown.floor.restitution = 1;
  thrown.body.inertia = 1. / 3;
  const double half = std::sqrt(0.5);
  thrown.body.feet = {{{-half, 0, -half}}, {{half, 0, half}}};
  thrown.body.centre = {0, 0, half + 0.02};
  thrown.body.velocity = {0.625, 0, -1};
  try {
    std::filesystem::create_directories(folder);
    TableWriter table(folder / "creeping.csv",
                      {{"t", "s"}, {"stands", "m"}, {"slides", "m/s"}, {"walks", "m"}, {"made", "J"}});
    double walked = 0, made = 0;
    for (int frame = 0; frame <= kFrames; ++frame) {
      table.row({frame * kFrame, stands.body.centre.dot(down), slides.body.velocity.dot(down), walked, made});
      step(stands, kFrame);
      step(slides, kFrame);
      // Every fifth frame the cube sinks in on its left side, by 0.4 mm, turning about its right feet.
      if (frame % 5 == 0) {
        const Vec3 right = knocked.body.turn * Vec3(0.1, 0, -0.1);
        const Mat3 lean = Eigen::AngleAxisd(-0.002, Vec3::UnitY()).toRotationMatrix();
        knocked.body.centre += right - lean * right;
        knocked.body.turn = lean * knocked.body.turn;
      }
      const Vec3 before = place_of(knocked.body, 4);
      step(knocked, kFrame);
      walked += place_of(knocked.body, 4)[0] - before[0];
      const double had = energy(thrown);
      const double lifted = step(thrown, kFrame).lifted;
      made += std::max(0.0, energy(thrown) - had - lifted);
    }
    table.close();
    std::printf("the cube that should stand: %.3g m after %.0f s\n", stands.body.centre.dot(down),
                kFrames * kFrame);
    std::printf("the cube that is corrected walks %.3g mm\n", 1000 * walked);
    std::printf("energy that nothing explains, of the rod that is thrown: %.2g J\n", made);
  } catch (const TodoError& todo) {
    std::fprintf(stderr, "%s\n", todo.what());
    return 2;
  }
  std::printf("draw it: python3 plots/ch06_ex05_creeping.py %s\n", folder.string().c_str());
}
