#include "tests/bench/ch05_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <variant>

#include "ch04_multibody_stepping/broad_phase.hpp"
#include "tests/support/chain_link.hpp"

namespace fc::bench {
namespace {

constexpr double kSide = 0.5, kEnvelope = 2e-3;  // m
constexpr double kSpacing = 0.95;                // m: a box may turn in it as it likes

int add_box(Scene& scene, const Vec3& size, double mass) {
  ShapeSpec shape;
  shape.geometry = BoxSpec{size};
  if (mass > 0) shape.mass = mass;
  scene.shapes.push_back(shape);
  return static_cast<int>(scene.shapes.size()) - 1;
}

void add_body(Scene& scene, int shape, const Vec3& position, bool is_static,
              const Quat& orientation = Quat::Identity()) {
  BodySpec body;
  body.shape = shape;
  body.position = position;
  body.orientation = orientation;
  body.is_static = is_static;
  scene.bodies.push_back(body);
}

Scene empty(const char* name) {
  Scene scene;
  scene.name = name;
  scene.gravity = Vec3(0, 0, -9.81);
  scene.envelope = kEnvelope;
  return scene;
}

// A floor and four walls, so far apart inside.
void add_pit(Scene& scene, double along_x, double along_y, double height) {
  const int floor = add_box(scene, Vec3(along_x + 2, along_y + 2, 1), 0);
  const int side = add_box(scene, Vec3(1, along_y + 2, height), 0);
  const int front = add_box(scene, Vec3(along_x, 1, height), 0);
  add_body(scene, floor, Vec3(0, 0, -0.5), true);
  for (const double sign : {-1.0, 1.0}) {
    add_body(scene, side, Vec3(sign * (0.5 * along_x + 0.5), 0, 0.5 * height), true);
    add_body(scene, front, Vec3(0, sign * (0.5 * along_y + 0.5), 0.5 * height), true);
  }
}

Vec3 size_of(const Scene& scene, std::size_t body) {
  return std::get<BoxSpec>(scene.shapes[static_cast<std::size_t>(scene.bodies[body].shape)].geometry).size;
}

}  // namespace

Scene heap(int nx, int ny, int layers) {
  Scene scene = empty("heap");
  add_pit(scene, nx * kSpacing + 0.3, ny * kSpacing + 0.3, layers * kSpacing + 4);
  const int box = add_box(scene, Vec3::Constant(kSide), 1);
  std::mt19937 random(1);
  const auto uniform = [&] { return 2.0 * random() / std::mt19937::max() - 1; };
  for (int k = 0; k < layers; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        Eigen::Vector4d q;
        do q = {uniform(), uniform(), uniform(), uniform()};
        while (q.squaredNorm() > 1 || q.squaredNorm() < 0.01);
        q.normalize();
        const Vec3 place((i - 0.5 * (nx - 1)) * kSpacing, (j - 0.5 * (ny - 1)) * kSpacing,
                         0.6 + k * kSpacing);
        add_body(scene, box, place + 0.02 * Vec3(uniform(), uniform(), 0), false,
                 Quat(q[0], q[1], q[2], q[3]));
      }
  return scene;
}

Scene wall(int columns, int rows) {
  Scene scene = empty("wall");
  add_pit(scene, columns * (kSide + 0.01) + 0.01, kSide + 0.02, rows * kSide + 2);
  const int box = add_box(scene, Vec3::Constant(kSide), 1);
  for (int k = 0; k < rows; ++k)
    for (int i = 0; i < columns; ++i)
      add_body(scene, box, Vec3((i - 0.5 * (columns - 1)) * (kSide + 0.01), 0, (k + 0.5) * kSide), false);
  return scene;
}

Scene stack(int boxes) {
  Scene scene = empty("stack");
  const int floor = add_box(scene, Vec3(10, 10, 1), 0), box = add_box(scene, Vec3::Constant(kSide), 1);
  add_body(scene, floor, Vec3(0, 0, -0.5), true);
  for (int k = 0; k < boxes; ++k) add_body(scene, box, Vec3(0, 0, (k + 0.5) * kSide), false);
  return scene;
}

Scene chain(int links, const std::filesystem::path& file) {
  fc_test::write_chain_link(file, 16, 16);
  Scene scene = empty("chain");
  scene.envelope = 0;
  ShapeSpec link;
  link.geometry = MeshSpec{file};
  link.density = 7680;
  scene.shapes.push_back(link);
  const Quat turned(Eigen::AngleAxisd(0.5 * M_PI, Vec3::UnitX()));
  for (int i = 0; i < links; ++i)
    add_body(scene, 0, Vec3(1.099 * i, 0, 0), i == 0 || i == links - 1,
             i % 2 == 1 ? turned : Quat::Identity());
  return scene;
}

Scene rings(int count) {
  constexpr double kScale = 0.3, kRoom = 0.8;  // m: a ring may turn in its place as it likes
  Scene scene = empty("rings");
  add_pit(scene, 2 * kRoom + 0.1, 2 * kRoom + 0.1, 0.25 * count * kRoom + 4);
  ShapeSpec ring;
  ring.geometry = MeshSpec{FC_SOURCE_DIR "/chapters/ch04_multibody_stepping/scenes/parts/ring.obj", kScale};
  ring.density = 500;
  scene.shapes.push_back(ring);
  const int shape = static_cast<int>(scene.shapes.size()) - 1;
  for (int i = 0; i < count; ++i) {
    const Vec3 place((i % 2 - 0.5) * kRoom, (i / 2 % 2 - 0.5) * kRoom, 0.5 + i / 4 * kRoom);
    add_body(scene, shape, place, false,
             Quat(Eigen::AngleAxisd(1.3 * i, Vec3(1, 0.3 * i, 0.5).normalized())));
  }
  return scene;
}

Scene bunny_in_a_bowl() {
  return read_scene({FC_SOURCE_DIR "/chapters/ch05_resting_contact/scenes/bowl.yaml", {}, {}, 5});
}

double deepest_overlap(const Scene& scene, const std::vector<RigidBody>& states) {
  std::vector<Mat3> axes;
  std::vector<Vec3> halves;
  std::vector<world::Bounds> bounds;
  for (std::size_t i = 0; i < states.size(); ++i) {
    axes.push_back(states[i].orientation.toRotationMatrix());
    halves.push_back(0.5 * size_of(scene, i));
    const Vec3 reach = axes[i].cwiseAbs() * halves[i];
    bounds.push_back({states[i].position - reach, states[i].position + reach});
  }
  world::BoundsTree tree;
  tree.build(bounds);
  double deepest = 0;
  tree.overlapping_pairs([&](int x, int y) {
    const auto a = static_cast<std::size_t>(x), b = static_cast<std::size_t>(y);
    if (scene.bodies[a].is_static && scene.bodies[b].is_static) return;
    const Vec3 apart = states[b].position - states[a].position;
    double least = std::numeric_limits<double>::infinity();
    const auto along = [&](const Vec3& axis) {
      const double length = axis.norm();
      if (length < 1e-9) return;
      const double reach = (axes[a].transpose() * axis).cwiseAbs().dot(halves[a]) +
                           (axes[b].transpose() * axis).cwiseAbs().dot(halves[b]);
      least = std::min(least, (reach - std::abs(apart.dot(axis))) / length);
    };
    for (int i = 0; i < 3; ++i) {
      along(axes[a].col(i));
      along(axes[b].col(i));
      for (int k = 0; k < 3; ++k) along(axes[a].col(i).cross(axes[b].col(k)));
    }
    deepest = std::max(deepest, least);
  });
  return deepest;
}

}  // namespace fc::bench
