#include "support/mesh_truth.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <numbers>
#include <numeric>

namespace truth {
namespace {

using Matrix = Eigen::Matrix<Real, 3, 3>;

static_assert(LDBL_MANT_DIG >= 64);
constexpr Real kRounding = 64 * LDBL_EPSILON;  // of a few dozen sums and products, relative to their sizes

// --------------------------------------------------------------------------------------- two triangles

// The best of several directions, and the shortest of several ways from a to b.
struct Nearest {
  const Triangle &a, &b;
  Gap gap{};
  std::array<V, 42> directions{};  // not unit: of the nearest points of every pair of features
  int count = 0;

  Real support_gap(const V& n) const {  // n unit
    return std::min({n.dot(b[0]), n.dot(b[1]), n.dot(b[2])}) -
           std::max({n.dot(a[0]), n.dot(a[1]), n.dot(a[2])});
  }
  void try_direction(const V& d) {
    const Real size = d.norm();
    if (!(size > 0)) return;
    const V n = d / size;
    const Real lower = support_gap(n);
    if (!(lower > gap.lower)) return;
    gap.lower = lower;
    gap.normal = n;
  }
  // A way from a point of a to a point of b, and the direction in which it would point without rounding.
  void way(const V& from_a_to_b, const V& direction) {
    const Real size = from_a_to_b.norm();
    const bool shortest = size < gap.upper;
    directions[count++] = direction;
    if (shortest) {
      gap.upper = size;
      std::swap(directions[0], directions[count - 1]);
    }
  }
  static V along(const V& d, const V& reference) { return d.dot(reference) < 0 ? V(-d) : d; }

  void vertex_edge(const V& p, const V& from, const V& to, Real sign) {
    const V e = to - from;
    const Real size2 = e.squaredNorm();
    const Real s = size2 > 0 ? (p - from).dot(e) / size2 : 0;
    const V x = s <= 0 ? from : s >= 1 ? to : V(from + s * e);
    const V d = sign * (x - p);
    way(d, s > 0 && s < 1 ? V(d - e * (d.dot(e) / size2)) : d);
  }
  void edge_edge(const V& p, const V& u, const V& q, const V& v) {
    const V n = u.cross(v);
    const Real size2 = n.squaredNorm();
    if (!(size2 > 0)) return;
    const V o = q - p;
    const Real s = o.cross(v).dot(n) / size2, r = o.cross(u).dot(n) / size2;
    if (!(s >= 0 && s <= 1 && r >= 0 && r <= 1)) return;
    const V d = (q + r * v) - (p + s * u);
    way(d, along(n, d));
  }
  void vertex_face(const V& p, const Triangle& t, Real sign) {
    const V n = (t[1] - t[0]).cross(t[2] - t[0]);
    const Real size2 = n.squaredNorm();
    if (!(size2 > 0)) return;
    for (int k = 0; k < 3; ++k)
      if (n.cross(t[(k + 1) % 3] - t[k]).dot(p - t[k]) < 0) return;
    const V d = sign * (n.dot(t[0] - p) / size2) * n;
    way(d, d.squaredNorm() > 0 ? d : n);
  }
  // Whether the edge goes through the triangle.
  static bool pierces(const V& from, const V& to, const Triangle& t) {
    const V n = (t[1] - t[0]).cross(t[2] - t[0]);
    const Real at_from = n.dot(from - t[0]), at_to = n.dot(to - t[0]);
    if (!((at_from >= 0 && at_to <= 0) || (at_from <= 0 && at_to >= 0)) || at_from == at_to) return false;
    const V x = from + (to - from) * (at_from / (at_from - at_to));
    for (int k = 0; k < 3; ++k)
      if (n.cross(t[(k + 1) % 3] - t[k]).dot(x - t[k]) < 0) return false;
    return true;
  }
  bool cross() const {
    for (int k = 0; k < 3; ++k)
      if (pierces(a[k], a[(k + 1) % 3], b) || pierces(b[k], b[(k + 1) % 3], a)) return true;
    return false;
  }
};

// The depth of two triangles' overlap: least over the sides of their difference, whose normals are those of
// the triangles and of pairs of edges. Negative: apart.
Real triangle_depth(const Triangle& a, const Triangle& b) {
  const auto edge = [](const Triangle& t, int k) { return V(t[(k + 1) % 3] - t[k]); };
  const Nearest nearest{a, b};
  Real least = kInfinity;
  const auto side = [&](const V& d) {
    if (const Real size = d.norm(); size > 0)
      least = std::min({least, -nearest.support_gap(d / size), -nearest.support_gap(-d / size)});
  };
  side(edge(a, 0).cross(edge(a, 1)));
  side(edge(b, 0).cross(edge(b, 1)));
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) side(edge(a, i).cross(edge(b, k)));
  return least;
}

// --------------------------------------------------------------------------------------- two bodies

Matrix axes_at(const Flight& flight, Real t) {
  Eigen::Quaternion<Real> q = flight.orientation.cast<Real>();
  const V spin = flight.spin.cast<Real>();
  const Real rate = spin.norm();
  if (rate > 0) {
    const V axis = std::sin(rate * t / 2) / rate * spin;
    q = Eigen::Quaternion<Real>(std::cos(rate * t / 2), axis.x(), axis.y(), axis.z()) * q;
  }
  return q.normalized().toRotationMatrix();
}

struct Pair {
  const MeshShape &a, &b;
  const Flight &flight_a, &flight_b;
  V position, velocity, acceleration;  // B's less A's
  V spin_a, spin_b;
  Real rate_a, rate_b, radii;

  Pair(const MeshBody& body_a, const MeshBody& body_b)
      : a(*body_a.shape),
        b(*body_b.shape),
        flight_a(body_a.flight),
        flight_b(body_b.flight),
        position(flight_b.position.cast<Real>() - flight_a.position.cast<Real>()),
        velocity(flight_b.velocity.cast<Real>() - flight_a.velocity.cast<Real>()),
        acceleration(flight_b.acceleration.cast<Real>() - flight_a.acceleration.cast<Real>()),
        spin_a(flight_a.spin.cast<Real>()),
        spin_b(flight_b.spin.cast<Real>()),
        rate_a(spin_a.norm()),
        rate_b(spin_b.norm()),
        radii(a.radius + b.radius) {}
};

// Both bodies at one time, from A's centre of mass.
struct Scene {
  const Pair& pair;
  Matrix axes_a, axes_b;
  V offset, velocity;
  Real noise;  // m, how far a computed gap can be off

  Scene(const Pair& p, Real t)
      : pair(p),
        axes_a(axes_at(p.flight_a, t)),
        axes_b(axes_at(p.flight_b, t)),
        offset(p.position + t * (p.velocity + t / 2 * p.acceleration)),
        velocity(p.velocity + t * p.acceleration),
        noise(kRounding * (p.position.norm() + t * (p.velocity.norm() + t * p.acceleration.norm()) + p.radii +
                           (1 + t * p.rate_a) * p.a.reach + (1 + t * p.rate_b) * p.b.reach)) {}

  Triangle triangle_a(int t) const {
    const auto& [i, j, k] = pair.a.triangles[t];
    return {axes_a * pair.a.vertices[i], axes_a * pair.a.vertices[j], axes_a * pair.a.vertices[k]};
  }
  Triangle triangle_b(int t) const {
    const auto& [i, j, k] = pair.b.triangles[t];
    return {axes_b * pair.b.vertices[i] + offset, axes_b * pair.b.vertices[j] + offset,
            axes_b * pair.b.vertices[k] + offset};
  }
  Gap triangles(int a, int b) const {
    Gap g = triangle_gap(triangle_a(a), triangle_b(b), noise);
    g.lower -= pair.radii;
    g.upper -= pair.radii;
    return g;
  }
  V middles(const Ball& a, const Ball& b) const { return axes_b * b.middle + offset - axes_a * a.middle; }
  Real balls(const Ball& a, const Ball& b) const {  // a lower bound
    return middles(a, b).norm() - a.radius - b.radius - pair.radii - noise;
  }
};

// The larger ball's two, each with the other ball.
template <class Visit>
void open(const MeshShape& a, const MeshShape& b, int i, int k, Visit visit) {
  const Ball &p = a.balls[i], &q = b.balls[k];
  if (q.one() || (!p.one() && p.radius >= q.radius)) {
    visit(p.left, k);
    visit(p.right, k);
  } else {
    visit(i, q.left);
    visit(i, q.right);
  }
}

void nearest_pair(const Scene& scene, int i, int k, Gap& least) {
  const MeshShape &a = scene.pair.a, &b = scene.pair.b;
  if (a.balls[i].one() && b.balls[k].one()) {
    const Gap g = scene.triangles(a.balls[i].triangle, b.balls[k].triangle);
    if (g.lower < least.lower) {
      least.lower = g.lower;
      least.normal = g.normal;
    }
    least.upper = std::min(least.upper, g.upper);
    return;
  }
  struct Next {
    int i, k;
    Real lower;
  };
  std::array<Next, 2> next{};
  int count = 0;
  open(a, b, i, k, [&](int p, int q) { next[count++] = {p, q, scene.balls(a.balls[p], b.balls[q])}; });
  if (next[1].lower < next[0].lower) std::swap(next[0], next[1]);
  for (const Next& n : next)
    if (n.lower <= least.upper) nearest_pair(scene, n.i, n.k, least);
}

void deepest_pair(const Scene& scene, int i, int k, Real& depth) {
  const Ball &p = scene.pair.a.balls[i], &q = scene.pair.b.balls[k];
  if (scene.balls(p, q) > 0) return;
  if (!p.one() || !q.one()) {
    open(scene.pair.a, scene.pair.b, i, k, [&](int m, int n) { deepest_pair(scene, m, n, depth); });
    return;
  }
  const Triangle a = scene.triangle_a(p.triangle), b = scene.triangle_b(q.triangle);
  const Real own = triangle_depth(a, b);
  if (own < kInfinity) depth = std::max(depth, own - scene.noise);  // infinity: a point or a segment
}

// --------------------------------------------------------------------------------------- an interval

struct Waiting {
  int i, k;  // balls
  V normal;  // of the gap at some time nearby; zero: not known yet
};

struct Proof {
  const Pair& pair;
  Real level;
  std::int64_t most_looks;
  Clear result{};

  // How much the gap of two balls along n can change within `half` seconds.
  Real change(const Scene& scene, const Ball& p, const Ball& q, const V& n, Real half) const {
    return half * (std::abs(n.dot(scene.velocity)) + half / 2 * std::abs(n.dot(pair.acceleration)) +
                   n.cross(pair.spin_a).norm() * p.reach + n.cross(pair.spin_b).norm() * q.reach);
  }
  // At least that, whatever n is.
  Real most_change(const Scene& scene, const Ball& p, const Ball& q, Real half) const {
    return half * (scene.velocity.norm() + half / 2 * pair.acceleration.norm() + pair.rate_a * p.reach +
                   pair.rate_b * q.reach);
  }

  // The least gap of two triangles along n within `half` seconds of the scene's time. A corner x moves along
  // n with n.v + (n x w).r, and |n.(w x (w x r))| <= |n x w| |w| |r| is what that can change per second. The
  // lowest of B's corners less the highest of A's, at their present speeds, is concave over time: lowest at
  // an end.
  Real least_gap(const Scene& scene, const Ball& p, const Ball& q, const Triangle& ta, const Triangle& tb,
                 const V& n, Real half) const {
    const V turn_a = n.cross(pair.spin_a), turn_b = n.cross(pair.spin_b);
    const Real bend = turn_a.norm() * pair.rate_a * p.reach + turn_b.norm() * pair.rate_b * q.reach +
                      std::abs(n.dot(pair.acceleration));
    const Real drift = n.dot(scene.velocity);
    Real least = kInfinity;
    for (const Real h : {-half, half}) {
      Real high = -kInfinity, low = kInfinity;
      for (const V& x : ta) high = std::max(high, n.dot(x) + h * turn_a.dot(x));
      for (const V& x : tb) low = std::min(low, n.dot(x) + h * (drift + turn_b.dot(x - scene.offset)));
      least = std::min(least, low - high);
    }
    return least - half * half / 2 * bend - pair.radii - scene.noise;
  }

  enum class Look { clear, hit, open, halve };

  Look look_at_triangles(const Scene& scene, Waiting& w, Real half) const {
    const Ball &p = pair.a.balls[w.i], &q = pair.b.balls[w.k];
    const Triangle ta = scene.triangle_a(p.triangle), tb = scene.triangle_b(q.triangle);
    if (w.normal.squaredNorm() > 0 && least_gap(scene, p, q, ta, tb, w.normal, half) > level)
      return Look::clear;
    const Gap g = triangle_gap(ta, tb, scene.noise);
    if (g.upper - pair.radii <= level) return Look::hit;
    w.normal = g.normal;
    return least_gap(scene, p, q, ta, tb, w.normal, half) > level ? Look::clear : Look::halve;
  }
  Look look(const Scene& scene, Waiting& w, Real half) const {
    const Ball &p = pair.a.balls[w.i], &q = pair.b.balls[w.k];
    const V d = scene.middles(p, q);
    const Real room = d.norm() - p.radius - q.radius - pair.radii - scene.noise - level;
    const Real most = most_change(scene, p, q, half);
    if (room > most) return Look::clear;
    if (room > 0 && room > change(scene, p, q, d.normalized(), half)) return Look::clear;
    if (p.one() && q.one()) return look_at_triangles(scene, w, half);
    return most > p.radius + q.radius ? Look::halve : Look::open;
  }

  // True: clear. `waiting` holds all pairs that are not proved clear yet.
  bool clear(Real from, Real to, std::vector<Waiting> waiting) {
    const Real middle = from + (to - from) / 2;
    const Real half = std::max(to - middle, middle - from);
    const Scene scene(pair, middle);
    ++result.halved;
    std::vector<Waiting> remaining;
    while (!waiting.empty()) {
      Waiting w = waiting.back();
      waiting.pop_back();
      if (++result.looks > most_looks) return stop(Clear::Verdict::undecided, from);
      switch (look(scene, w, half)) {
        case Look::clear:
          break;
        case Look::hit:
          return stop(Clear::Verdict::hit, middle);
        case Look::open:
          open(pair.a, pair.b, w.i, w.k, [&](int i, int k) { waiting.push_back({i, k, V::Zero()}); });
          break;
        case Look::halve:
          remaining.push_back(w);
          break;
      }
    }
    if (remaining.empty()) return true;
    if (half <= 4 * LDBL_EPSILON * middle) return stop(Clear::Verdict::undecided, from);
    return clear(from, middle, remaining) && clear(middle, to, std::move(remaining));
  }
  bool stop(Clear::Verdict verdict, Real time) {
    result.verdict = verdict;
    result.time = time;
    return false;
  }
};

// --------------------------------------------------------------------------------------- one shape

struct BallMaker {
  MeshShape& shape;
  std::vector<int> order;  // of the triangles
  std::vector<V> middles;

  explicit BallMaker(MeshShape& s) : shape(s), order(s.triangles.size()) {
    std::iota(order.begin(), order.end(), 0);
    for (const auto& [i, j, k] : s.triangles)
      middles.push_back((s.vertices[i] + s.vertices[j] + s.vertices[k]) / 3);
    shape.balls.reserve(2 * order.size());
    make(0, static_cast<int>(order.size()));
  }
  int make(int begin, int end) {
    Ball ball;
    Eigen::AlignedBox<Real, 3> box, box_of_middles;
    for (int t = begin; t < end; ++t) {
      box_of_middles.extend(middles[order[t]]);
      for (const int v : shape.triangles[order[t]]) box.extend(shape.vertices[v]);
    }
    ball.middle = box.center();
    for (int t = begin; t < end; ++t)
      for (const int v : shape.triangles[order[t]]) {
        ball.radius = std::max(ball.radius, (shape.vertices[v] - ball.middle).norm());
        ball.reach = std::max(ball.reach, shape.vertices[v].norm());
      }
    const int number = static_cast<int>(shape.balls.size());
    shape.balls.push_back(ball);
    if (end - begin == 1) {
      shape.balls[number].triangle = order[begin];
      return number;
    }
    int axis = 0;
    box_of_middles.sizes().maxCoeff(&axis);
    const int half = (begin + end) / 2;
    std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end,
                     [&](int s, int t) { return middles[s][axis] < middles[t][axis]; });
    const int left = make(begin, half), right = make(half, end);
    shape.balls[number].left = left;
    shape.balls[number].right = right;
    return number;
  }
};

bool a_part_inside(const MeshShape& inner, const Matrix& axes, const V& offset, const MeshShape& outer) {
  if (!outer.solid) return false;
  for (const int v : inner.parts) {
    const V x = axes * inner.vertices[v] + offset;  // in the outer one's axes
    if (x.norm() <= outer.reach && windings(outer, x) > Real(0.5)) return true;
  }
  return false;
}

}  // namespace

MeshShape::MeshShape(const std::vector<Eigen::Vector3d>& positions,
                     const std::vector<std::array<int, 3>>& corners, double rounding, bool has_inside)
    : triangles(corners), radius(rounding), solid(has_inside) {
  for (const Eigen::Vector3d& v : positions) vertices.push_back(v.cast<Real>());
  for (const auto& t : triangles)
    for (const int v : t) reach = std::max(reach, vertices[v].norm());
  BallMaker maker(*this);
  std::vector<int> parent(vertices.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const auto& [i, j, k] : triangles) {
    parent[root(i)] = root(j);
    parent[root(j)] = root(k);
  }
  for (const auto& t : triangles)
    if (const int r = root(t[0]); parent[r] == r) parts.push_back(r);
  std::sort(parts.begin(), parts.end());
  parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
}

Gap triangle_gap(const Triangle& a, const Triangle& b, Real noise) {
  Nearest nearest{a, b};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3;
      nearest.vertex_edge(a[i], b[k], b[l], 1);
      nearest.vertex_edge(b[i], a[k], a[l], -1);
      nearest.edge_edge(a[i], a[j] - a[i], b[k], b[l] - b[k]);
    }
    nearest.vertex_face(a[i], b, 1);
    nearest.vertex_face(b[i], a, -1);
  }
  // The shortest way's direction will do, unless it is badly known.
  Gap& g = nearest.gap;
  for (int i = 0; i < nearest.count && !(g.lower >= g.upper - noise); ++i) {
    nearest.try_direction(nearest.directions[i]);
    nearest.try_direction(-nearest.directions[i]);
  }
  if (!(g.lower > 0) && nearest.cross()) g.upper = 0;
  g.lower -= noise;
  if (g.upper > 0) g.upper += noise;
  return g;
}

Gap gap(const MeshBody& a, const MeshBody& b, Real t, Search search) {
  const Pair pair(a, b);
  const Scene scene(pair, t);
  Gap least;
  least.lower = kInfinity;
  if (search == Search::balls) {
    nearest_pair(scene, 0, 0, least);
  } else {
    for (int i = 0; i < static_cast<int>(pair.a.triangles.size()); ++i)
      for (int k = 0; k < static_cast<int>(pair.b.triangles.size()); ++k) {
        const Gap g = scene.triangles(i, k);
        if (g.lower < least.lower) {
          least.lower = g.lower;
          least.normal = g.normal;
        }
        least.upper = std::min(least.upper, g.upper);
      }
  }
  return least;
}

Real depth(const MeshBody& a, const MeshBody& b, Real t) {
  const Pair pair(a, b);
  Real deepest = 0;
  deepest_pair(Scene(pair, t), 0, 0, deepest);
  return deepest;
}

Clear clear_between(const MeshBody& a, const MeshBody& b, Real from, Real to, Real level,
                    std::int64_t most_looks) {
  const Pair pair(a, b);
  Proof proof{pair, level, most_looks};
  if (proof.clear(from, to, {{0, 0, V::Zero()}})) {
    proof.result.verdict = Clear::Verdict::clear;
    proof.result.time = to;
  }
  return proof.result;
}

Real windings(const MeshShape& shape, const V& point) {
  Real angle = 0;
  for (const auto& [i, j, k] : shape.triangles) {
    const V a = shape.vertices[i] - point, b = shape.vertices[j] - point, c = shape.vertices[k] - point;
    const Real la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return angle / (2 * std::numbers::pi_v<Real>);
}

bool one_inside_other(const MeshBody& a, const MeshBody& b, Real t) {
  const Pair pair(a, b);
  const Scene scene(pair, t);
  const Matrix b_to_a = scene.axes_a.transpose() * scene.axes_b;
  const V offset_in_a = scene.axes_a.transpose() * scene.offset,
          offset_in_b = -(scene.axes_b.transpose() * scene.offset);
  return a_part_inside(pair.b, b_to_a, offset_in_a, pair.a) ||
         a_part_inside(pair.a, b_to_a.transpose(), offset_in_b, pair.b);
}

}  // namespace truth
