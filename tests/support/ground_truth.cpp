#include "support/ground_truth.hpp"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <queue>

namespace truth {
namespace {

static_assert(LDBL_MANT_DIG >= 64);
constexpr Real kRounding = 64 * LDBL_EPSILON;  // of a few dozen sums and products, relative to their sizes
constexpr int kMostSearches = 200;

// A body at one time, its centre of mass at the origin.
struct Placed {
  const Shape& shape;
  Eigen::Matrix<Real, 3, 3> axes;  // body to world

  Placed(const Body& body, Real t) : shape(body.shape) {
    Eigen::Quaternion<Real> q = body.flight.orientation.cast<Real>();
    const V spin = body.flight.spin.cast<Real>();
    const Real rate = spin.norm();
    if (rate > 0) {
      const V axis = std::sin(rate * t / 2) / rate * spin;
      q = Eigen::Quaternion<Real>(std::cos(rate * t / 2), axis.x(), axis.y(), axis.z()) * q;
    }
    axes = q.normalized().toRotationMatrix();
  }

  // The core's farthest point along d, world axes.
  V farthest(const V& d) const {
    const V local = axes.transpose() * d;
    const Real across = std::hypot(local.x(), local.y());
    const V rim = across > 0 ? V(local.x() / across, local.y() / across, 0) : V(1, 0, 0);
    Real most = -kInfinity;
    V best = V::Zero();
    for (std::size_t i = 0; i < shape.points.size(); ++i) {
      const Real disk = shape.disks.empty() ? 0 : shape.disks[i];
      const Real value = local.dot(shape.points[i]) + disk * across;
      if (!(value > most)) continue;
      most = value;
      best = shape.points[i] + disk * rim;
    }
    return axes * best;
  }
};

// Up to four points, and the point of their hull that is nearest to the origin.
struct Simplex {
  std::array<V, 4> p{V::Zero(), V::Zero(), V::Zero(), V::Zero()};
  int count = 0;
  V nearest = V::Zero();

  // The weights of the point of the flat through the corners that is nearest to the origin.
  static std::array<Real, 4> weights(const std::array<V, 4>& c, int n) {
    const V e1 = c[1] - c[0], e2 = c[2] - c[0], e3 = c[3] - c[0], o = -c[0];
    Real w1 = 0, w2 = 0, w3 = 0;
    if (n == 2) w1 = o.dot(e1) / e1.squaredNorm();
    if (n == 3) {
      const V normal = e1.cross(e2);
      w1 = normal.dot(o.cross(e2)) / normal.squaredNorm();
      w2 = normal.dot(e1.cross(o)) / normal.squaredNorm();
    }
    if (n == 4) {
      const Real volume = e1.dot(e2.cross(e3));
      w1 = o.dot(e2.cross(e3)) / volume;
      w2 = e1.dot(o.cross(e3)) / volume;
      w3 = e1.dot(e2.cross(o)) / volume;
    }
    return {1 - w1 - w2 - w3, w1, w2, w3};
  }

  // Takes one more point in. Every choice of corners with it is tried: whatever has weights >= 0 is a point
  // of the hull; the nearest one is kept, with its corners. (Choices without it were tried before.)
  void add(const V& point) {
    p[count] = point;
    Simplex best;
    Real least = kInfinity;
    if (count > 0) {
      best = *this;
      least = nearest.squaredNorm();
    }
    for (int chosen = 1 << count; chosen < 2 << count; ++chosen) {
      std::array<V, 4> c{V::Zero(), V::Zero(), V::Zero(), V::Zero()};
      int n = 0;
      for (int i = 0; i <= count; ++i)
        if (chosen >> i & 1) c[n++] = p[i];
      const std::array<Real, 4> w = weights(c, n);
      V x = V::Zero();
      bool inside = true;
      for (int i = 0; i < n; ++i) {
        inside = inside && w[i] >= 0;  // false for what is not a number
        x += w[i] * c[i];
      }
      if (!inside || !(x.squaredNorm() < least)) continue;
      least = x.squaredNorm();
      best.p = c;
      best.count = n;
      best.nearest = x;
    }
    *this = best;
  }

  // How deep the origin lies within four corners: its distance to the nearest side, m; 0 for fewer.
  Real depth() const {
    if (count < 4) return 0;
    Real least = kInfinity;
    for (int i = 0; i < 4; ++i) {
      const V &a = p[(i + 1) % 4], &b = p[(i + 2) % 4], &c = p[(i + 3) % 4];
      const V side = (b - a).cross(c - a);
      least = std::min(least, std::abs(side.dot(a)) / side.norm());
    }
    return least;
  }

  // The direction of `nearest`, with the digits of the corners: it is the small difference of large numbers.
  V direction() const {
    V n = nearest;
    if (count == 2) {
      const V e = p[1] - p[0];
      n -= e * (n.dot(e) / e.squaredNorm());
    }
    if (count == 3) {
      n = (p[1] - p[0]).cross(p[2] - p[0]);
      if (n.dot(nearest) < 0) n = -n;
    }
    return n.norm() > 0 ? V(n.normalized()) : V(nearest.normalized());
  }
};

struct Pair {
  const Body &a, &b;
  V position, velocity, acceleration;  // B's less A's
  V spin_a, spin_b;
  Real reach_a, reach_b, radii;

  Pair(const Body& body_a, const Body& body_b)
      : a(body_a),
        b(body_b),
        position(b.flight.position.cast<Real>() - a.flight.position.cast<Real>()),
        velocity(b.flight.velocity.cast<Real>() - a.flight.velocity.cast<Real>()),
        acceleration(b.flight.acceleration.cast<Real>() - a.flight.acceleration.cast<Real>()),
        spin_a(a.flight.spin.cast<Real>()),
        spin_b(b.flight.spin.cast<Real>()),
        reach_a(a.shape.reach()),
        reach_b(b.shape.reach()),
        radii(a.shape.radius + b.shape.radius) {}

  // How far a computed gap can be off, m.
  Real noise(Real t) const {
    return kRounding * (position.norm() + t * (velocity.norm() + t * acceleration.norm()) + radii +
                        (1 + t * spin_a.norm()) * reach_a + (1 + t * spin_b.norm()) * reach_b);
  }

  Gap at(Real t, Real enough) const {
    const Placed placed_a(a, t), placed_b(b, t);
    const V offset = position + t * (velocity + t / 2 * acceleration);
    const Real off = noise(t);
    Gap result;
    Simplex simplex;
    V n = offset.norm() > 0 ? V(offset.normalized()) : V(V::UnitX());
    int idle = 0;
    Real nearest = kInfinity;
    for (int i = 0; i < kMostSearches && idle < 3; ++i) {
      const V p = offset + placed_b.farthest(-n) - placed_a.farthest(n);
      const Real lower = n.dot(p) - radii - off;
      if (lower > result.lower) {
        result.lower = lower;
        result.normal = n;
      }
      if (lower > enough || nearest - radii - result.lower <= 2 * off) break;
      simplex.add(p);
      const Real size = simplex.nearest.norm();
      idle = size < nearest ? 0 : idle + 1;
      nearest = std::min(nearest, size);
      if (simplex.count == 4 || size <= off) break;  // the cores meet, or nearly
      n = simplex.direction();
    }
    result.upper = simplex.depth() > off ? -radii : nearest - radii + off;
    return result;
  }

  // How much the gap along n can change within `half` seconds before or after t.
  Real change(const V& n, Real t, Real half) const {
    return half * (std::abs(n.dot(velocity + t * acceleration)) + half / 2 * std::abs(n.dot(acceleration)) +
                   n.cross(spin_a).norm() * reach_a + n.cross(spin_b).norm() * reach_b);
  }

  // At least change(), whatever n is.
  Real most_change(Real t, Real half) const {
    return half * (velocity.norm() + (t + half) * acceleration.norm() + spin_a.norm() * reach_a +
                   spin_b.norm() * reach_b);
  }
};

}  // namespace

Real Shape::reach() const {
  Real most = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const V& p = points[i];
    const Real disk = disks.empty() ? 0 : disks[i];
    most = std::max(most, std::hypot(std::hypot(p.x(), p.y()) + disk, p.z()));
  }
  return most;
}

Gap gap(const Body& a, const Body& b, Real t, Real enough) {
  return Pair(a, b).at(t, enough);
}

FirstTime first_time(const Body& a, const Body& b, Real end, Real level, Real width, int most_looks) {
  const Pair pair(a, b);
  FirstTime result;  // lower: farther away until here; upper: near enough at this time
  if (pair.at(0, level).upper <= level) return {FirstTime::Verdict::at, 0, 0, 1};
  const auto look = [&](Real t, Real enough) {
    ++result.looks;
    const Gap g = pair.at(t, enough);
    if (g.upper <= level) result.upper = std::min(result.upper, t);
    return g;
  };
  Real step = end;
  while (result.lower < end && !(result.upper - result.lower <= width)) {
    const Real left = std::min(end, result.upper) - result.lower;
    step = std::min(step, left);
    const Real half = step / 2, middle = result.lower + half;
    if (result.looks >= most_looks || half <= 4 * LDBL_EPSILON * middle) return result;  // undecided
    const Gap g = look(middle, level + pair.most_change(middle, half));
    if (g.lower - pair.change(g.normal, middle, half) > level) {
      result.lower = step < left ? result.lower + step : std::min(end, result.upper);
      step *= 2;
    } else {
      step = half;
      if (step <= width / 4) look(std::min(end, result.lower + width), kInfinity);
    }
  }
  result.verdict = result.lower < end ? FirstTime::Verdict::at : FirstTime::Verdict::never;
  return result;
}

Closest closest(const Body& a, const Body& b, Real end, Real width, int most_looks) {
  const Pair pair(a, b);
  struct Span {
    Real from, to, lower;
    bool operator<(const Span& other) const { return lower > other.lower; }  // the lowest comes first
  };
  Closest result;
  std::priority_queue<Span> spans;
  int looks = 0;
  const auto add = [&](Real from, Real to) {
    const Real middle = (from + to) / 2;
    const Gap g = pair.at(middle, kInfinity);
    ++looks;
    result.upper = std::min(result.upper, g.upper);
    spans.push({from, to, g.lower - pair.change(g.normal, middle, (to - from) / 2)});
  };
  add(0, end);
  result.upper = std::min({result.upper, pair.at(0, kInfinity).upper, pair.at(end, kInfinity).upper});
  while (spans.top().lower < result.upper - width && looks < most_looks) {
    const Span s = spans.top();
    spans.pop();
    add(s.from, (s.from + s.to) / 2);
    add((s.from + s.to) / 2, s.to);
  }
  result.lower = std::min(spans.top().lower, result.upper);
  return result;
}

}  // namespace truth
