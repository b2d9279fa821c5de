#include "ch01_convex_advancement/study/pictures.hpp"

#include <cmath>
#include <numbers>
#include <tuple>

#include "ch01_convex_advancement/advance.hpp"
#include "ch01_convex_advancement/query_run.hpp"

namespace fc::ca {
namespace {

using Points = std::vector<Vec3>;

// Flat: all with z = 0.
const Points kLeft = {{-1.1, -0.55, 0}, {-0.1, -0.8, 0}, {0.55, -0.1, 0}, {0.15, 0.75, 0}, {-0.9, 0.6, 0}};
const Points kRight = {{1.35, 0.35, 0}, {2.3, -0.25, 0}, {2.75, 0.7, 0}, {1.9, 1.25, 0}};

// For GJK, which takes four iterations here, drops a corner, and meets a worse plane after a better one.
const Points kTriangle = {{1.1, -1.2, 0}, {1.0, -0.1, 0}, {-0.8, 0.1, 0}};
const Points kSquare = {{2.0, 0.1, 0}, {2.5, 0.7, 0}, {1.8, 1.3, 0}, {1.3, 0.6, 0}};

Convex flat(const Points& points) {
  return {points, 0, reach_of(points)};
}

PairPose at_rest() {
  return {Pose{Mat3::Identity(), Vec3::Zero()}, Pose{Mat3::Identity(), Vec3::Zero()}};
}

void write_corners(const std::filesystem::path& file, const Points& a, const Points& b) {
  TableWriter table(file, {{"body", ""}, {"x", "m"}, {"y", "m"}});
  for (const Vec3& p : a) table.row({std::string("a"), p.x(), p.y()});
  for (const Vec3& p : b) table.row({std::string("b"), p.x(), p.y()});
  table.close();
}

// A bar that turns about z; B is a wall to its right, so that n = x.
const Points kBar = {{-0.6, -0.2, 0}, {0.6, -0.2, 0}, {0.6, 0.2, 0}, {-0.6, 0.2, 0}};
constexpr double kSpin = 2;  // rad/s

Motion turning(double spin) {
  RigidBody body;
  body.spin = {0, 0, spin};
  return Motion(body);
}

}  // namespace

void draw_slabs(const std::filesystem::path& out) {
  write_corners(out / "slab_shapes.csv", kLeft, kRight);
  const Convex a = flat(kLeft), b = flat(kRight);
  const PairPose pose = at_rest();
  const GjkResult best = distance(a, b, pose, {1e-12, 0, 128});
  TableWriter planes(
      out / "slab_planes.csv",
      {{"nx", ""}, {"ny", ""}, {"gap", "m"}, {"ax", "m"}, {"ay", "m"}, {"bx", "m"}, {"by", "m"}});
  const auto angle_of = [](const Vec3& n) { return std::atan2(n.y(), n.x()); };
  for (const double lean : {-0.55, 0.0}) {
    const double angle = angle_of(best.normal) + lean;
    const Vec3 n(std::cos(angle), std::sin(angle), 0);
    const Vec3 ahead = support(a, n).point, behind = support(b, -n).point;
    planes.row({n.x(), n.y(), support_gap(a, b, pose, n), ahead.x(), ahead.y(), behind.x(), behind.y()});
  }
  planes.close();
  TableWriter turned(out / "slab_turned.csv", {{"angle", "rad"}, {"gap", "m"}});
  for (int k = -120; k <= 120; ++k) {
    const double angle = angle_of(best.normal) + k * std::numbers::pi / 180;
    turned.row(
        {angle - angle_of(best.normal), support_gap(a, b, pose, Vec3(std::cos(angle), std::sin(angle), 0))});
  }
  turned.close();
  TableWriter closest(out / "slab_closest.csv",
                      {{"distance", "m"}, {"ax", "m"}, {"ay", "m"}, {"bx", "m"}, {"by", "m"}});
  closest.row({best.upper, best.point_a.x(), best.point_a.y(), best.point_b.x(), best.point_b.y()});
  closest.close();
}

void draw_gjk(const std::filesystem::path& out) {
  write_corners(out / "gjk_shapes.csv", kTriangle, kSquare);
  const Convex a = flat(kTriangle), b = flat(kSquare);
  const PairPose pose = at_rest();
  TableWriter differences(out / "gjk_difference.csv", {{"x", "m"}, {"y", "m"}});
  for (const Vec3& q : kSquare)
    for (const Vec3& p : kTriangle) differences.row({q.x() - p.x(), q.y() - p.y()});
  differences.close();
  TableWriter steps(out / "gjk_steps.csv", {{"iteration", ""},
                                            {"x", "m"},  // the point of the simplex nearest to the origin
                                            {"y", "m"},
                                            {"sx", "m"},  // the point of B - A farthest against it
                                            {"sy", "m"},
                                            {"lower", "m"},
                                            {"upper", "m"}});
  TableWriter corners(out / "gjk_simplex.csv", {{"iteration", ""}, {"x", "m"}, {"y", "m"}});
  for (int k = 1;; ++k) {
    const GjkResult r = distance(a, b, pose, {0, 1e-12, k});
    const Vec3 x = r.point_b - r.point_a, n = x.normalized();
    const Vec3 s = support(b, -n).point - support(a, n).point;
    steps.row({std::int64_t{k}, x.x(), x.y(), s.x(), s.y(), r.lower, r.upper});
    for (int i = 0; i < r.cache.count; ++i) {
      const Vec3 corner = r.cache.b[i].point - r.cache.a[i].point;
      corners.row({std::int64_t{k}, corner.x(), corner.y()});
    }
    if (r.status == GjkResult::Status::separated) break;
  }
  steps.close();
  corners.close();
}

void draw_corners(const std::filesystem::path& out) {
  const Convex bar = flat(kBar);
  const Points wall = {{3, -2, 0}, {3, 2, 0}};
  const Convex still = flat(wall);
  const Motion turn = turning(kSpin), stand = turning(0);
  const Vec3 n = Vec3::UnitX();
  TableWriter bound(out / "corners_bound.csv", {{"spin", "rad/s"}, {"bound", "m/s"}, {"now", "m/s"}});
  const Vec3 across = n.cross(turn.spin);
  bound.row({kSpin,
             MovingPair(MotionBound::directional, bar, turn, still, stand).closing_speed_bound(n, 0, 2),
             across.dot(support(bar, across).point)});
  bound.close();
  TableWriter table(out / "corners_speed.csv",
                    {{"t", "s"}, {"corner", ""}, {"x", "m"}, {"y", "m"}, {"speed", "m/s"}});
  for (int k = 0; k <= 90; ++k) {
    const double t = k * std::numbers::pi / 180;  // half a turn
    for (std::size_t i = 0; i < kBar.size(); ++i) {
      const Vec3 r = turn.rotation_at(t) * kBar[i];
      table.row({t, static_cast<std::int64_t>(i), r.x(), r.y(), n.dot(turn.spin.cross(r))});
    }
  }
  table.close();
}

void draw_turned(const std::filesystem::path& out) {
  const Convex bar = flat(kBar);
  const Motion turn = turning(kSpin);
  const double start = -0.42;  // rad: how the bar lies now
  const Mat3 now = rotation_about(Vec3::UnitZ(), start);
  const Vec3 n = Vec3::UnitX(), across = n.cross(turn.spin);
  TableWriter table(out / "turned.csv", {{"h", "s"},
                                         {"dx", ""},  // n + h n x w
                                         {"dy", ""},
                                         {"corner", ""},     // ahead in that direction
                                         {"foretold", "m"},  // how far it is along n after h, by its velocity
                                         {"rest", "m"},      // what the turn can bend its path by
                                         {"true", "m"}});    // how far the bar reaches along n after h
  for (int k = 0; k <= 60; ++k) {
    const double h = 0.01 * k;
    const Vec3 d = n + h * across;
    const SupportPoint ahead = support(bar, now.transpose() * d);
    const Vec3 later = turn.rotation_at(h).transpose() * n;
    table.row({h, d.x(), d.y(), std::int64_t{ahead.index}, d.dot(now * ahead.point),
               0.5 * h * h * across.norm() * kSpin * bar.reach,
               n.dot(turn.rotation_at(h) * (now * support(bar, now.transpose() * later).point))});
  }
  table.close();
  TableWriter corners(out / "turned_corners.csv",
                      {{"spin", "rad/s"}, {"corner", ""}, {"x", "m"}, {"y", "m"}});
  for (std::size_t i = 0; i < kBar.size(); ++i) {
    const Vec3 r = now * kBar[i];
    corners.row({kSpin, static_cast<std::int64_t>(i), r.x(), r.y()});
  }
  corners.close();
}

void draw_flight(const Scene& scene, const std::filesystem::path& out) {
  const std::vector<Shape> shapes = build_shapes(scene, false);
  const Shape& shape_a = shapes[scene.bodies[0].shape];
  const Shape& shape_b = shapes[scene.bodies[1].shape];
  const ConvexCore core_a(shape_a.core.vertices, shape_a.disks), core_b(shape_b.core.vertices, shape_b.disks);
  const Convex a = core_a.convex(shape_a.radius), b = core_b.convex(shape_b.radius);
  const QueryMotions query = query_motions(scene, shapes).front();
  AdvanceOptions options;
  options.interval = scene.interval;
  options.tolerance = scene.ccd.tolerance;
  options.bound = motion_bound_named(scene.ccd.bound);
  options.certificate = true;
  const AdvanceResult answer = advance(a, query.a, b, query.b, options);

  TableWriter rows(out / "flight_rows.csv", {{"row", ""},
                                             {"t", "s"},
                                             {"nx", ""},
                                             {"ny", ""},
                                             {"nz", ""},
                                             {"gap_lower", "m"},
                                             {"speed_bound", "m/s"},
                                             {"advance", "s"}});
  TableWriter along(out / "flight_along.csv", {{"row", ""}, {"h", "s"}, {"gap", "m"}});
  std::int64_t number = 0;
  for (const CertificateRow& row : answer.certificate) {
    rows.row({number, row.t, row.normal.x(), row.normal.y(), row.normal.z(), row.gap_lower, row.speed_bound,
              row.advance});
    for (int k = 0; k <= 60; ++k) {
      const double h = 0.025 * k * row.advance;  // up to half as long again as the row promises
      along.row({number, h, support_gap(a, b, PairPose(query.a, query.b, row.t + h), row.normal)});
    }
    ++number;
  }
  rows.close();
  along.close();

  TableWriter distances(out / "flight_distance.csv", {{"t", "s"}, {"distance", "m"}});
  constexpr int kLooks = 400;
  for (int k = 0; k <= kLooks; ++k) {
    const double t = k * scene.interval / kLooks;
    distances.row({t, distance(a, b, PairPose(query.a, query.b, t), {1e-9, 0, 128}).upper});
  }
  distances.close();

  TableWriter poses(out / "flight_poses.csv", {{"t", "s"}, {"body", ""}, {"x", "m"}, {"y", "m"}, {"z", "m"}});
  std::vector<double> times;
  for (const CertificateRow& row : answer.certificate) times.push_back(row.t);
  times.push_back(answer.toc);
  for (const double t : times)
    for (const auto& [name, motion, shape] :
         {std::tuple{"a", &query.a, &shape_a}, std::tuple{"b", &query.b, &shape_b}})
      for (const Vec3& p : shape->core.vertices) {
        const Vec3 x = motion->pose_at(t) * p;
        poses.row({t, std::string(name), x.x(), x.y(), x.z()});
      }
  poses.close();
}

}  // namespace fc::ca
