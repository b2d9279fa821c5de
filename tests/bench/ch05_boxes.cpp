#include "tests/bench/ch05_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "ch04_multibody_stepping/broad_phase.hpp"
#include "tests/support/chain_link.hpp"

namespace fc::bench {
namespace {

constexpr double kSide = 0.5, kEnvelope = 2e-3;  // m
constexpr double kSpacing = 0.95;                // m: a box has room to turn freely
constexpr double kApart = 0.01;                  // m: boxes that stand beside each other

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

// A floor and four walls, with this distance between opposite walls.
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

// Columns of boxes beside each other.
void add_columns(Scene& scene, int columns, int rows) {
  const int box = add_box(scene, Vec3::Constant(kSide), 1);
  for (int k = 0; k < rows; ++k)
    for (int i = 0; i < columns; ++i)
      add_body(scene, box, Vec3((i - 0.5 * (columns - 1)) * (kSide + kApart), 0, (k + 0.5) * kSide), false);
}

// Its top is at `height`.
void add_floor(Scene& scene, double along_x, double along_y, double height = 0) {
  add_body(scene, add_box(scene, Vec3(along_x, along_y, 1), 0), Vec3(0, 0, height - 0.5), true);
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
  add_pit(scene, columns * (kSide + kApart) + kApart, kSide + 0.02, rows * kSide + 2);
  add_columns(scene, columns, rows);
  return scene;
}

Scene stack(int boxes) {
  Scene scene = empty("stack");
  add_floor(scene, 10, 10);
  add_columns(scene, 1, boxes);
  return scene;
}

Scene free_wall(int columns, int rows) {
  Scene scene = empty("wall");
  add_floor(scene, columns * (kSide + kApart) + 10, 10);
  add_columns(scene, columns, rows);
  return scene;
}

Scene pyramid(int layers) {
  Scene scene = empty("pyramid");
  add_floor(scene, layers * (1 + kApart) + 10, 10);
  const int box = add_box(scene, Vec3::Ones(), 1);
  for (int k = 0; k < layers; ++k)
    for (int i = 0; i < layers - k; ++i)
      add_body(scene, box, Vec3((i - 0.5 * (layers - k - 1)) * (1 + kApart), 0, k + 0.5), false);
  return scene;
}

Scene arch(int stones) {
  constexpr double kRadius = 10, kThick = 2, kDeep = 2, kMargin = 2e-4;  // m
  const double half = 0.5 * M_PI / stones, inset = 0.25 * kMargin;
  Scene scene = empty("arch");
  scene.envelope = kMargin;
  add_floor(scene, 30, 10, -inset);
  HullSpec stone;
  // A joint's plane goes through the arch's axis, and a stone's side lies a quarter of the envelope beside it.
  for (const double side : {-1.0, 1.0})
    for (const double r : {kRadius - 0.5 * kThick, kRadius + 0.5 * kThick})
      for (const double y : {-0.5, 0.5})
        stone.points.emplace_back(side * (r * std::sin(half) - inset / std::cos(half)), y * kDeep,
                                  r * std::cos(half) - kRadius);
  ShapeSpec shape;
  shape.geometry = stone;
  shape.mass = 1;
  scene.shapes.push_back(shape);
  for (int k = 0; k < stones; ++k) {
    const double angle = (2 * k + 1 - stones) * half;  // from the vertical
    add_body(scene, 1, kRadius * Vec3(std::sin(angle), 0, std::cos(angle)), false,
             Quat(Eigen::AngleAxisd(angle, Vec3::UnitY())));
  }
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
  constexpr double kScale = 0.3, kRoom = 0.8;  // m: a ring has room to turn freely in its place
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

OverlapJudge::OverlapJudge(const Scene& scene, const std::vector<Shape>& shapes) : scene_(scene) {
  for (const Shape& shape : shapes) solids_.push_back(solid_of(shape));
}

OverlapJudge::Solid OverlapJudge::solid_of(const Shape& shape) {
  Solid solid;
  if (!shape.convex()) return solid;
  solid.corners = shape.core.vertices;
  const auto add = [](std::vector<Vec3>& list, const Vec3& line) {
    const Vec3 unit = line.normalized();
    if (std::none_of(list.begin(), list.end(), [&](const Vec3& v) { return v.cross(unit).norm() < 1e-9; }))
      list.push_back(unit);
  };
  std::map<std::pair<int, int>, Vec3> sides;  // of an edge: the normal of the first triangle
  for (const auto& t : shape.core.triangles) {
    const auto at = [&](int k) { return solid.corners[static_cast<std::size_t>(t[k % 3])]; };
    const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    add(solid.normals, normal);
    for (int k = 0; k < 3; ++k) {
      const auto [other, first] = sides.try_emplace(std::minmax(t[k], t[(k + 1) % 3]), normal);
      if (!first && other->second.cross(normal).norm() > 1e-9) add(solid.edges, at(k + 1) - at(k));
    }
  }
  return solid;
}

double OverlapJudge::overlap(const Placed& a, const Placed& b) {
  double least = std::numeric_limits<double>::infinity();
  const auto along = [&](const Vec3& axis) {
    const double length = axis.norm();
    if (length < 1e-9) return;
    const auto reach = [&](const Placed& body) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Vec3& corner : body.solid.corners) {
        low = std::min(low, corner.dot(axis));
        high = std::max(high, corner.dot(axis));
      }
      return std::pair(low, high);
    };
    const auto [low_a, high_a] = reach(a);
    const auto [low_b, high_b] = reach(b);
    const double apart = (b.position - a.position).dot(axis);
    least = std::min(least, std::min(high_a - low_b - apart, high_b - low_a + apart) / length);
  };
  for (const Vec3& normal : a.solid.normals) along(normal);
  for (const Vec3& normal : b.solid.normals) along(normal);
  for (const Vec3& edge : a.solid.edges)
    for (const Vec3& other : b.solid.edges) {
      if (least <= 0) return 0;
      along(edge.cross(other));
    }
  return std::max(0.0, least);
}

double OverlapJudge::deepest(const std::vector<RigidBody>& states) const {
  std::vector<Placed> placed(states.size());
  std::vector<world::Bounds> bounds;
  for (std::size_t i = 0; i < states.size(); ++i) {
    placed[i] = {solids_[static_cast<std::size_t>(scene_.bodies[i].shape)], states[i].position};
    const Mat3 turn = states[i].orientation.toRotationMatrix();
    Solid& solid = placed[i].solid;
    for (auto* list : {&solid.corners, &solid.normals, &solid.edges})
      for (Vec3& v : *list) v = turn * v;
    Eigen::AlignedBox3d box;
    for (const Vec3& corner : solid.corners) box.extend(states[i].position + corner);
    bounds.push_back({box.min(), box.max()});
  }
  world::BoundsTree tree;
  tree.build(bounds);
  double deepest = 0;
  tree.overlapping_pairs([&](int x, int y) {
    const auto a = static_cast<std::size_t>(x), b = static_cast<std::size_t>(y);
    if (scene_.bodies[a].is_static && scene_.bodies[b].is_static) return;
    deepest = std::max(deepest, overlap(placed[a], placed[b]));
  });
  return deepest;
}

}  // namespace fc::bench
