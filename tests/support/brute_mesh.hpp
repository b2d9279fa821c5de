// Two moving meshes by brute force: all pairs of triangles, in long double, and proofs that hold between the sampled
// times. Shares nothing with the engine but the data of a motion.
#pragma once

#include <cstdint>

#include "tests/support/test_models.hpp"

namespace fc::test {

struct Apart {
  Long distance = 0;                  // m
  Vec<Long> way = Vec<Long>::Zero();  // from the first's nearest point to the second's
};

inline Vec<Long> nearest_on_segment(const Vec<Long>& p, const Vec<Long>& a, const Vec<Long>& b) {
  const Vec<Long> e = b - a;
  const Long length2 = e.squaredNorm();
  if (length2 == 0) return a;
  return a + std::clamp((p - a).dot(e) / length2, Long(0), Long(1)) * e;
}

// Distance of two triangles, which may have no area: 0 where an edge of one pierces the other, else the
// smallest over all pairs of a vertex and a face, and of two edges.
inline Apart triangles_apart(const Triangle<Long>& s, const Triangle<Long>& t) {
  if (triangles_cross(s, t)) return {};
  Apart best{std::numeric_limits<Long>::infinity(), Vec<Long>::Zero()};
  const auto take = [&](const Vec<Long>& way) {
    const Long d = way.norm();
    if (d < best.distance) best = {d, way};
  };
  const auto over_face = [](const Vec<Long>& p, const Triangle<Long>& f, auto use) {
    if (point_triangle_inside(p, f) == std::numeric_limits<Long>::infinity()) return;
    const Vec<Long> n = (f[1] - f[0]).cross(f[2] - f[0]).normalized();
    use(n.dot(f[0] - p) * n);  // from p to the face
  };
  for (int i = 0; i < 3; ++i) {
    over_face(s[i], t, [&](const Vec<Long>& way) { take(way); });
    over_face(t[i], s, [&](const Vec<Long>& way) { take(-way); });
    for (int k = 0; k < 3; ++k) {
      const Vec<Long>&a = s[i], &b = s[(i + 1) % 3], &c = t[k], &d = t[(k + 1) % 3];
      take(nearest_on_segment(a, c, d) - a);
      take(c - nearest_on_segment(c, a, b));
      const Vec<Long> u = b - a, v = d - c, n = u.cross(v);
      const Long size2 = n.squaredNorm();
      if (size2 == 0) continue;
      const Long x = (c - a).cross(v).dot(n) / size2, y = (c - a).cross(u).dot(n) / size2;
      if (x > 0 && x < 1 && y > 0 && y < 1) take(n.dot(c - a) / size2 * n);
    }
  }
  return best;
}

// A mesh on its way, and for each triangle a ball that holds it.
struct BruteBody {
  TriangleMesh mesh;
  ca::Motion motion;
  bool solid = true;
  Long radius = 0;  // m, rounding

  struct Ball {
    Vec3 center;    // m, shape axes
    double radius;  // m
    double far;     // m, of the center from the centre of mass
  };
  std::vector<Ball> balls{};
  double reach = 0;  // m

  BruteBody(TriangleMesh m, const ca::Motion& moves, bool is_solid = true, double rounding = 0)
      : mesh(std::move(m)), motion(moves), solid(is_solid), radius(rounding) {
    for (const auto& [i, j, k] : mesh.triangles) {
      const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
      const Vec3 middle = (a + b + c) / 3;
      balls.push_back(
          {middle, std::max({(a - middle).norm(), (b - middle).norm(), (c - middle).norm()}), middle.norm()});
    }
    for (const Vec3& v : mesh.vertices) reach = std::max(reach, v.norm());
  }
  Triangle<Long> triangle(int t, const LongPose& pose) const {
    const auto& [i, j, k] = mesh.triangles[t];
    return {pose * mesh.vertices[i], pose * mesh.vertices[j], pose * mesh.vertices[k]};
  }
};

struct Proof {
  bool proved = true;
  Long time = 0;      // s, if not: where it failed
  Long distance = 0;  // m, there
  std::int64_t looks = 0;
};

class BrutePair {
 public:
  BrutePair(BruteBody a, BruteBody b) : a_(std::move(a)), b_(std::move(b)) {}
  const BruteBody& a() const { return a_; }
  const BruteBody& b() const { return b_; }

  // The distance of the surfaces, less the rounding radii, at a time.
  Long distance(Long t) const {
    const Placed now(*this, t);
    double most = std::numeric_limits<double>::infinity();  // the middles of triangles lie on them
    for (const Vec3& x : now.a)
      for (const Vec3& y : now.b) most = std::min(most, (x - y).squaredNorm());
    most = std::sqrt(most) * (1 + 1e-12) + rounding(t);
    std::vector<std::pair<double, Pair>> near;
    for (int i = 0; i < static_cast<int>(now.a.size()); ++i)
      for (int k = 0; k < static_cast<int>(now.b.size()); ++k) {
        const double radii = a_.balls[i].radius + b_.balls[k].radius, limit = most + radii;
        if ((now.a[i] - now.b[k]).squaredNorm() > limit * limit) continue;
        near.push_back({(now.a[i] - now.b[k]).norm() - radii, {i, k}});
      }
    std::sort(near.begin(), near.end());
    Long best = std::numeric_limits<Long>::infinity();
    for (const auto& [low, pair] : near) {
      if (low - rounding(t) > best) break;
      best = std::min(best, apart(pair, now).distance);
    }
    return best - a_.radius - b_.radius;
  }

  // Whether, at a time, a vertex of one lies inside the other, which is a solid, and deeper than `depth` (m)
  // below its surface (rounding radii aside).
  bool inside(Long t, Long depth) const {
    const LongPose pa = long_pose(a_.motion, t, a_.motion.position),
                   pb = long_pose(b_.motion, t, a_.motion.position);
    const auto within = [&](const BruteBody& in, const LongPose& p, const BruteBody& out, const LongPose& q) {
      if (!out.solid) return false;
      for (const Vec3& v : in.mesh.vertices) {
        const Vec<Long> y = p * v, x = q.rotation.transpose() * (y - q.position);
        if (x.norm() > out.reach || windings(out.mesh, x.cast<double>()) < 0.4) continue;
        Long below = std::numeric_limits<Long>::infinity();
        for (int k = 0; k < static_cast<int>(out.mesh.triangles.size()); ++k)
          below = std::min(below, triangles_apart({y, y, y}, out.triangle(k, q)).distance);
        if (below > depth) return true;
      }
      return false;
    };
    return within(a_, pa, b_, pb) || within(b_, pb, a_, pa);
  }

  // That the distance exceeds `floor` (m) all the time from `begin` to `end` (s). Each window of time is examined in
  // its middle. A pair of triangles is proved if it is farther apart there than it can come in half the window: at most
  // the largest speed between two of its points, times that. Or, which is sharper, if the vertices stay on their sides
  // along the line that joins the nearest points; a point x moves along n by n.(v + w x x) dt, and at most |n x w| |w x
  // x| dt^2 / 2 more. Pairs that are not proved go on in two halves of the window.
  Proof prove_clear(Long begin, Long end, Long floor = 0) const {
    std::vector<Pair> all;
    for (int i = 0; i < static_cast<int>(a_.balls.size()); ++i)
      for (int k = 0; k < static_cast<int>(b_.balls.size()); ++k) all.push_back({i, k});
    Proof proof;
    window((begin + end) / 2, (end - begin) / 2, all, floor, proof);
    return proof;
  }

 private:
  using Pair = std::pair<int, int>;
  static constexpr std::int64_t kMostLooks = 400'000'000;  // pairs in windows
  static constexpr int kFew = 64;  // pairs; below, only what is asked for is put in place

  struct Placed {
    LongPose pose_a, pose_b;
    std::vector<Vec3> a, b;  // the middles of the balls, seen from A's first position; none: not asked for

    Placed(const BrutePair& pair, Long t, bool middles = true)
        : pose_a(long_pose(pair.a_.motion, t, pair.a_.motion.position)),
          pose_b(long_pose(pair.b_.motion, t, pair.a_.motion.position)) {
      if (!middles) return;
      const auto put = [](const BruteBody& body, const LongPose& pose, std::vector<Vec3>& to) {
        const Mat3 rotation = pose.rotation.cast<double>();
        const Vec3 position = pose.position.cast<double>();
        for (const BruteBody::Ball& ball : body.balls) to.push_back(rotation * ball.center + position);
      };
      put(pair.a_, pose_a, a);
      put(pair.b_, pose_b, b);
    }
    Vec3 middle_a(const BruteBody& body, int i) const {
      return a.empty() ? Vec3((pose_a * body.balls[i].center).cast<double>()) : a[i];
    }
    Vec3 middle_b(const BruteBody& body, int k) const {
      return b.empty() ? Vec3((pose_b * body.balls[k].center).cast<double>()) : b[k];
    }
  };

  // What the places of the balls' middles, in doubles, may be off.
  double rounding(Long t) const {
    const double travelled = (b_.motion.position - a_.motion.position).norm() +
                             static_cast<double>(t) * (a_.motion.velocity.norm() + b_.motion.velocity.norm());
    return 1e-14 * (travelled + a_.reach + b_.reach);
  }
  Apart apart(const Pair& pair, const Placed& now) const {
    return triangles_apart(a_.triangle(pair.first, now.pose_a), b_.triangle(pair.second, now.pose_b));
  }
  static Vec<Long> velocity(const ca::Motion& m, Long t) {
    return m.velocity.cast<Long>() + t * m.acceleration.cast<Long>();
  }

  bool window(Long middle, Long half, const std::vector<Pair>& pairs, Long floor, Proof& proof) const {
    const Placed now(*this, middle, pairs.size() > kFew);
    const Long need = floor + a_.radius + b_.radius;
    const ca::Motion &ma = a_.motion, &mb = b_.motion;
    const Vec3 closing = (velocity(ma, middle) - velocity(mb, middle)).cast<double>();
    const double rate_a = ma.spin.norm(), rate_b = mb.spin.norm(), h = static_cast<double>(half);
    const double pull = (ma.acceleration - mb.acceleration).norm();
    const Vec3 center_a = now.pose_a.position.cast<double>(), center_b = now.pose_b.position.cast<double>();
    const double slack = rounding(middle + half) + 1e-15 * h * (closing.norm() + pull);
    std::vector<Pair> left;
    for (const Pair& pair : pairs) {
      const BruteBody::Ball &ball_a = a_.balls[pair.first], &ball_b = b_.balls[pair.second];
      const Vec3 x = now.middle_a(a_, pair.first), y = now.middle_b(b_, pair.second);
      const Vec3 speed = closing + ma.spin.cross(x - center_a) - mb.spin.cross(y - center_b);
      const double reach = h * (speed.norm() + rate_a * ball_a.radius + rate_b * ball_b.radius +
                                h * (rate_a * rate_a * ball_a.far + rate_b * rate_b * ball_b.far + pull)) +
                           slack;
      const double radii = ball_a.radius + ball_b.radius;
      if ((x - y).norm() - radii > reach + static_cast<double>(need)) continue;
      if (reach > 2 * radii || !done(pair, now, middle, half, need, reach, proof)) left.push_back(pair);
      if (!proof.proved) return false;
    }
    proof.looks += static_cast<std::int64_t>(pairs.size());
    if (left.empty()) return true;
    if (proof.looks > kMostLooks || half < 1e-18L) {
      proof = {false, middle, distance(middle), proof.looks};
      return false;
    }
    return window(middle - half / 2, half / 2, left, floor, proof) &&
           window(middle + half / 2, half / 2, left, floor, proof);
  }

  bool done(const Pair& pair, const Placed& now, Long t, Long half, Long need, double reach,
            Proof& proof) const {
    const Triangle<Long> s = a_.triangle(pair.first, now.pose_a), r = b_.triangle(pair.second, now.pose_b);
    const Apart d = triangles_apart(s, r);
    if (d.distance <= need) {
      proof = {false, t, d.distance - a_.radius - b_.radius, proof.looks};
      return false;
    }
    if (d.distance > need + reach) return true;
    const Vec<Long> n = d.way.normalized();
    const auto along = [&](const ca::Motion& m, const Vec<Long>& center, const Triangle<Long>& corners) {
      std::array<std::array<Long, 3>, 3> result;  // of each corner: place, speed, half the change of speed
      const Vec<Long> w = m.spin.cast<Long>(), v = velocity(m, t);
      for (int i = 0; i < 3; ++i) {
        const Vec<Long> turning = w.cross(corners[i] - center);
        result[i] = {n.dot(corners[i]), n.dot(v + turning), n.cross(w).norm() * turning.norm() / 2};
      }
      return result;
    };
    const auto side_a = along(a_.motion, now.pose_a.position, s),
               side_b = along(b_.motion, now.pose_b.position, r);
    const Long fall = std::abs(n.dot((a_.motion.acceleration - b_.motion.acceleration).cast<Long>())) / 2;
    for (const auto& [place_a, speed_a, bend_a] : side_a)
      for (const auto& [place_b, speed_b, bend_b] : side_b)
        if (place_b - place_a - half * std::abs(speed_b - speed_a) - half * half * (bend_a + bend_b + fall) <=
            need)
          return false;
    return true;
  }

  BruteBody a_, b_;
};

}  // namespace fc::test
