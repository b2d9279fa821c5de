// The scenes of the study, and how they are run.
#include <cmath>
#include <numeric>
#include <random>

#include "ch04_multibody_stepping/record.hpp"
#include "ch04_multibody_stepping/study/parts.hpp"

namespace fc::world {
namespace {

constexpr double kSpacing = 1.6;  // m, of the grid; bodies reach 0.5 m
constexpr int kHullPoints = 32;

ShapeSpec shape_of(Kind kind) {
  ShapeSpec shape;
  shape.name = "body";
  shape.mass = 1;
  if (kind == Kind::ball) shape.geometry = SphereSpec{0.5};
  if (kind == Kind::block) shape.geometry = BoxSpec{Vec3(0.6, 0.55, 0.5)};
  if (kind == Kind::hull) {
    HullSpec hull;  // points of a spiral on a ball
    for (int i = 0; i < kHullPoints; ++i) {
      const double z = 1 - (2 * i + 1.0) / kHullPoints, angle = i * 2.399963;  // the golden angle, rad
      const double r = std::sqrt(1 - z * z);
      hull.points.push_back(0.5 * Vec3(r * std::cos(angle), r * std::sin(angle), z));
    }
    shape.geometry = hull;
  }
  return shape;
}

}  // namespace

Scene gas(Kind kind, int bodies, std::uint64_t seed) {
  Scene scene;
  scene.name = "gas";
  scene.restitution = 1;
  scene.shapes.push_back(shape_of(kind));
  const int side = static_cast<int>(std::ceil(std::cbrt(static_cast<double>(bodies))));
  const double room = side * kSpacing, wall = 1;
  for (int axis = 0; axis < 3; ++axis) {
    ShapeSpec shape;
    shape.name = std::string("wall ") + "xyz"[axis];
    Vec3 size = Vec3::Constant(room + 2 * wall);
    size[axis] = wall;
    shape.geometry = BoxSpec{size};
    scene.shapes.push_back(shape);
    for (const int end : {-1, 1}) {
      BodySpec body;
      body.shape = axis + 1;
      body.is_static = true;
      body.position[axis] = end * 0.5 * (room + wall);
      scene.bodies.push_back(body);
    }
  }
  std::mt19937_64 engine(seed);
  const auto any = [&] {  // uniform in [-1, 1): the same on every machine, unlike std's distributions
    return std::ldexp(static_cast<double>(engine() >> 11), -52) - 1;
  };
  for (int i = 0; i < bodies; ++i) {
    BodySpec body;
    const Vec3 cell(i % side, i / side % side, i / (side * side));
    body.position = kSpacing * (cell - Vec3::Constant(0.5 * (side - 1)));
    body.velocity = Vec3(5 * any(), 5 * any(), 5 * any());
    if (kind != Kind::ball) body.spin = Vec3(3 * any(), 3 * any(), 3 * any());
    scene.bodies.push_back(body);
  }
  return scene;
}

double Run::total_ns() const {
  return std::accumulate(ns.begin(), ns.end(), 0.0);
}

Run run_frames(World& world, double dt, int frames) {
  Run run;
  run.sum.min_gap = std::numeric_limits<double>::infinity();
  const double before = totals_of(world).kinetic;
  for (int frame = 0; frame < frames; ++frame) {
    const StepReport r = step(world, dt);
    run.ns.push_back(static_cast<double>(r.step_ns));
    run.sum.impacts += r.impacts;
    run.sum.lcp_rows += r.lcp_rows;
    run.sum.solves += r.solves;
    run.sum.pairs += r.pairs;
    run.sum.queries += r.queries;
    run.sum.node_pairs += r.node_pairs;
    run.sum.advances += r.advances;
    run.sum.sightings += r.sightings;
    run.sum.falls_asleep += r.falls_asleep;
    run.sum.lost_time += r.lost_time;
    run.sum.min_gap = std::min(run.sum.min_gap, r.min_gap);
    run.sum.lcp_residual = std::max(run.sum.lcp_residual, r.lcp_residual);
  }
  run.energy_drift = std::abs(totals_of(world).kinetic / before - 1);
  return run;
}

}  // namespace fc::world
