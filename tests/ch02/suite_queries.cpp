// Random shapes and motions.
#include <filesystem>

#include "common/mass_properties.hpp"
#include "suite.hpp"
#include "tests/support/test_models.hpp"

namespace suite {
namespace {

using fc::TriangleMesh;
using fc::Vec3;
using fc::test::integer;
using fc::test::magnitude;
using fc::test::Random;
using fc::test::rotation;
using fc::test::uniform;
using fc::test::unit_vector;

// ------------------------------------------------------------------------------------------ shapes

// A sphere's mesh, each vertex at its own distance from the middle.
template <class Distance>
TriangleMesh ball(Random& random, int rings, Distance distance) {
  TriangleMesh mesh = fc::test::bumpy_ball(random, rings);
  for (Vec3& v : mesh.vertices) v = v.normalized() * distance(v.normalized());
  return mesh;
}

TriangleMesh lumpy_ball(Random& random, int rings) {
  std::vector<Vec3> lobes;
  for (int i = integer(random, 3, 9); i > 0; --i) lobes.push_back(unit_vector(random));
  const double sharpness = uniform(random, 3, 15);
  return ball(random, rings, [&](const Vec3& d) {
    double r = 0;
    for (const Vec3& l : lobes) r = std::max(r, std::exp(sharpness * (l.dot(d) - 1)));
    return 0.25 + 0.75 * r;
  });
}

TriangleMesh knot(int around, int across, double thickness) {
  TriangleMesh mesh;
  const auto curve = [](double u) {
    const double r = 1 + 0.4 * std::cos(3 * u);
    return Vec3(r * std::cos(2 * u), r * std::sin(2 * u), 0.4 * std::sin(3 * u));
  };
  for (int i = 0; i < around; ++i) {
    const double u = 2 * std::numbers::pi * i / around, h = 1e-4;
    const Vec3 along = (curve(u + h) - curve(u - h)).normalized();
    const Vec3 core(std::cos(2 * u), std::sin(2 * u), 0);  // of the torus that it winds around
    const Vec3 x = along.cross((curve(u) - core).cross(along)).cross(along).normalized(), y = along.cross(x);
    for (int k = 0; k < across; ++k) {
      const double v = 2 * std::numbers::pi * k / across;
      mesh.vertices.push_back(curve(u) + thickness * (std::cos(v) * x + std::sin(v) * y));
    }
  }
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < across; ++k) {
      const int j = (i + 1) % around * across, m = (k + 1) % across;
      mesh.triangles.push_back({i * across + k, j + k, j + m});
      mesh.triangles.push_back({i * across + k, j + m, i * across + m});
    }
  if (fc::signed_volume(mesh) < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TriangleMesh sheet(Random& random, int n) {
  TriangleMesh mesh;
  const double waves = uniform(random, 0, 12), height = uniform(random, 0, 0.2);
  const double roll = integer(random, 0, 2) ? 0 : uniform(random, 1, 5);  // rad
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k <= n; ++k) {
      const double x = 2.0 * i / n - 1, y = 2.0 * k / n - 1;
      const double z = height * std::sin(waves * x) * std::cos(waves * y);
      if (roll > 0)
        mesh.vertices.emplace_back((1 / roll + z) * std::sin(roll * x), y,
                                   (1 / roll + z) * std::cos(roll * x));
      else
        mesh.vertices.emplace_back(x, y, z);
    }
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const int c = i * (n + 1) + k, d = c + n + 1;
      mesh.triangles.push_back({c, d, d + 1});
      mesh.triangles.push_back({c, d + 1, c + 1});
    }
  return mesh;
}

// A plate of n times n cells without some that do not touch one another.
TriangleMesh plate(Random& random, int n, double thickness) {
  TriangleMesh mesh;
  std::vector<char> hole(n * n, 0);
  for (int i = 1; i + 1 < n; i += 2)
    for (int k = 1; k + 1 < n; k += 2) hole[i * n + k] = integer(random, 0, 1) == 0;
  const auto filled = [&](int i, int k) { return i >= 0 && k >= 0 && i < n && k < n && !hole[i * n + k]; };
  std::vector<int> number(2 * (n + 1) * (n + 1), -1);
  const auto vertex = [&](int i, int k, int top) {
    int& id = number[(i * (n + 1) + k) * 2 + top];
    if (id < 0) {
      id = static_cast<int>(mesh.vertices.size());
      mesh.vertices.emplace_back(2.0 * i / n - 1, 2.0 * k / n - 1, top ? thickness / 2 : -thickness / 2);
    }
    return id;
  };
  const auto quad = [&](int a, int b, int c, int d) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      if (!filled(i, k)) continue;
      const auto at = [&](int di, int dk, int top) { return vertex(i + di, k + dk, top); };
      quad(at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1));
      quad(at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0));
      if (!filled(i - 1, k)) quad(at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0));
      if (!filled(i + 1, k)) quad(at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1));
      if (!filled(i, k - 1)) quad(at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1));
      if (!filled(i, k + 1)) quad(at(0, 1, 0), at(0, 1, 1), at(1, 1, 1), at(1, 1, 0));
    }
  return mesh;
}

TriangleMesh moved(TriangleMesh mesh, double scale, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v = scale * v + by;
  return mesh;
}

TriangleMesh several(Random& random, int rings) {
  const TriangleMesh small = fc::test::bumpy_ball(random, rings);
  TriangleMesh mesh = fc::test::joined(moved(small, 0.5, Vec3::Zero()),
                                       moved(small, uniform(random, 0.1, 0.45), Vec3::Zero()), true);
  for (int i = integer(random, 1, 4), k = 0; k < i; ++k) {
    const Vec3 corner((k & 1) ? 0.7 : -0.7, (k & 2) ? 0.7 : -0.7, 0.3);
    mesh = fc::test::joined(
        mesh, moved(fc::test::bumpy_ball(random, rings), uniform(random, 0.1, 0.3), corner), false);
  }
  return mesh;
}

TriangleMesh coarse(Random& random) {
  if (integer(random, 0, 5) == 0) return fc::test::l_prism();
  if (integer(random, 0, 5) == 0) return fc::test::star(3, uniform(random, 0.05, 1));
  std::vector<Vec3> points;
  for (int i = integer(random, 4, 10); i > 0; --i)
    points.push_back(uniform(random, 0.5, 1) * unit_vector(random));
  return fc::hull_mesh(points).value();
}

// A root of the number of triangles, evenly over the exponents of 50 to 4,000.
int root_of_count(Random& random, double per_square) {
  return static_cast<int>(std::round(std::sqrt(magnitude(random, 50, 4000) / per_square)));
}

struct Made {
  TriangleMesh mesh;
  bool solid = true;
};

Made make(Random& random, Kind kind) {
  switch (kind) {
    case Kind::bumpy:
      return {fc::test::bumpy_ball(random, std::max(3, root_of_count(random, 4)))};
    case Kind::torus: {
      const int across = std::max(3, root_of_count(random, 6));
      return {fc::test::ring(1, uniform(random, 0.1, 0.7), std::max(4, 3 * across), across)};
    }
    case Kind::lumpy:
      return {lumpy_ball(random, std::max(4, root_of_count(random, 4)))};
    case Kind::knot: {
      const int across = std::clamp(root_of_count(random, 30), 3, 12);
      return {knot(std::max(24, 15 * across), across, uniform(random, 0.03, 0.15))};
    }
    case Kind::sheet:
      return {sheet(random, root_of_count(random, 2)), false};
    case Kind::soup:
      return {fc::test::triangle_soup(random, static_cast<int>(magnitude(random, 8, 400))), false};
    case Kind::plate:
      return {plate(random, 2 * std::max(1, root_of_count(random, 20)) + 1, magnitude(random, 1e-3, 0.5))};
    case Kind::components:
      return {several(random, std::max(3, root_of_count(random, 16)))};
    case Kind::coarse:
      return {coarse(random)};
    default: {  // slivers
      Made made{fc::test::bumpy_ball(random, std::max(3, root_of_count(random, 4)))};
      const Vec3 squeeze(1, integer(random, 0, 1) ? 1 : magnitude(random, 1e-3, 0.1),
                         magnitude(random, 1e-4, 0.1));
      for (Vec3& v : made.mesh.vertices) v = v.cwiseProduct(squeeze);
      return made;
    }
  }
}

Prepared prepare_solid(const fc::test::Solid& s) {
  TriangleMesh core = s.core;
  const bool closed = core.vertices.size() > 2;
  return {truth::MeshShape(core.vertices, core.triangles, s.radius, closed), fc::test::model_of(s), s.name};
}

Prepared random_shape(Random& random, Kind kind, double size) {
  const auto length = [&] {
    return size * (integer(random, 0, 4) ? uniform(random, 0.2, 1) : magnitude(random, 1e-3, 0.1));
  };
  switch (kind) {
    case Kind::sphere:
      return prepare_solid(fc::test::sphere(size * magnitude(random, 0.02, 0.5)));
    case Kind::capsule:
      return prepare_solid(
          fc::test::capsule(size * magnitude(random, 0.01, 0.3), size * uniform(random, 0.1, 1)));
    case Kind::box:
      return prepare_solid(fc::test::box(Vec3(length(), length(), length())));
    case Kind::hull:
      return prepare_solid(fc::test::random_hull(random, size / 2, integer(random, 5, 40)));
    default:
      break;
  }
  Made made = make(random, kind);
  if (integer(random, 0, 5) == 0) made.solid = false;  // only its surface
  Vec3 middle = Vec3::Zero();
  double reach = 0;
  for (const Vec3& v : made.mesh.vertices) middle += v / static_cast<double>(made.mesh.vertices.size());
  if (integer(random, 0, 3) == 0)
    middle += uniform(random, 0, 1) * unit_vector(random);  // turns about elsewhere
  for (Vec3& v : made.mesh.vertices) {
    v -= middle;
    reach = std::max(reach, v.norm());
  }
  for (Vec3& v : made.mesh.vertices) v *= size / 2 / reach;
  const std::string what = std::string(name_of(kind)) + (made.solid ? "" : " surface") + " of " +
                           std::to_string(made.mesh.triangles.size());
  return prepare(made.mesh, made.solid, what);
}

// ------------------------------------------------------------------------------------------ motions

double extent(const truth::MeshShape& shape) {
  return static_cast<double>(shape.reach + shape.radius);
}

// The body's farthest point along n, from its centre of mass.
Vec3 farthest(const truth::MeshShape& shape, const truth::Flight& flight, const Vec3& n) {
  const truth::V local = (flight.orientation.toRotationMatrix().transpose() * n).cast<truth::Real>();
  truth::V best = shape.vertices[0];
  for (const truth::V& v : shape.vertices)
    if (local.dot(v) > local.dot(best)) best = v;
  return flight.orientation.toRotationMatrix() * best.cast<double>() + static_cast<double>(shape.radius) * n;
}

struct Teller {
  Random& random;
  Query& q;
  double size = q.a->shape.reach > 0 ? extent(q.a->shape) : 1;
  double reach = extent(q.a->shape) + extent(q.b->shape);

  Vec3 spin(double low, double high) const {
    return integer(random, 0, 5) ? Vec3(magnitude(random, low, high) * unit_vector(random))
                                 : Vec3(Vec3::Zero());
  }
  void spins(double low, double high) const {
    q.flight_a.spin = spin(low, high);
    q.flight_b.spin = spin(low, high);
  }

  void orient() const {
    for (truth::Flight* f : {&q.flight_a, &q.flight_b})  // one time in four along the axes
      f->orientation = integer(random, 0, 3) ? rotation(random) : fc::Quat::Identity();
  }

  // Towards each other from 0.6 to 3 reaches apart, not quite centrally.
  void approach() const {
    const Vec3 apart = reach * uniform(random, 0.6, 3) * unit_vector(random);
    q.flight_a.position = size * unit_vector(random);
    q.flight_b.position = q.flight_a.position + apart;
    q.flight_a.velocity = size * uniform(random, 0, 5) * unit_vector(random);
    q.flight_b.velocity = q.flight_a.velocity - apart * uniform(random, 0.3, 2.5) +
                          uniform(random, 0, 0.8) * reach * unit_vector(random);
  }

  Vec3 direction() const {
    return integer(random, 0, 1) ? unit_vector(random) : Vec3(Vec3::Unit(integer(random, 0, 2)));
  }

  // B slides along a plane whose gap to A is `gap`, so that the points next to the plane meet after a part
  // `when` of the interval; if they spin, then about the plane's normal.
  void graze(double gap, double when) const {
    const Vec3 n = direction(), along = n.cross(unit_vector(random)).normalized();
    const Vec3 way = reach * uniform(random, 0.5, 4) * along;
    q.flight_b.position = q.flight_a.position + farthest(q.a->shape, q.flight_a, n) -
                          farthest(q.b->shape, q.flight_b, -n) + gap * n - when * way;
    q.flight_b.velocity = q.flight_a.velocity + way;
    if (integer(random, 0, 1) == 0) return;
    q.flight_a.spin = uniform(random, -3, 3) * n;
    q.flight_b.spin = uniform(random, -3, 3) * n;
  }

  // Moves B from far away straight towards A until they are about `gap` apart somewhere; returns the normal
  // there. May pass by: then it is some direction.
  Vec3 bring_near(double gap) const {
    const Vec3 way = unit_vector(random), side = 0.7 * size * uniform(random, 0, 1) * unit_vector(random);
    double s = 1.05 * reach;
    for (int i = 0; i < 40; ++i) {
      q.flight_b.position = q.flight_a.position + s * way + side;
      const truth::Gap g = truth::gap(q.body_a(), q.body_b(), 0);
      if (g.lower <= 1.5 * gap) return g.normal.cast<double>();
      s -= static_cast<double>(g.lower) - gap;
      if (s < -reach) break;
    }
    return way;
  }

  // From where they are, along the plane of normal n, a way of about `far` and some `closer` towards each
  // other, so that they are now where they would be after a part `when` of the interval.
  void slide(const Vec3& n, double far, double closer, double when) const {
    const Vec3 way = far * n.cross(unit_vector(random)).normalized() - closer * n;
    q.flight_b.velocity = q.flight_a.velocity + way;
    q.flight_b.position -= when * way;
  }

  // The smaller one's centre of mass where the larger one has most room of some places inside of it.
  void put_inside() const {
    const bool a_is_larger = q.a->shape.reach > q.b->shape.reach;
    const truth::MeshBody larger = a_is_larger ? q.body_a() : q.body_b();
    const truth::MeshShape point({Vec3::Zero()}, {{0, 0, 0}}, 0, false);
    truth::MeshBody place{&point, larger.flight};
    truth::Real most = 0;
    for (int i = 0; i < 50; ++i) {
      const Vec3 shift = extent(*larger.shape) * uniform(random, 0, 1) * unit_vector(random);
      place.flight.position = larger.flight.position + shift;
      const truth::Gap room = truth::gap(larger, place, 0);
      if (room.lower <= most || !truth::one_inside_other(larger, place, 0)) continue;
      most = room.lower;
      q.flight_b.position = q.flight_a.position + (a_is_larger ? shift : Vec3(-shift));
    }
  }

  void start() const {
    q.flight_b.velocity = q.flight_a.velocity + reach * uniform(random, 0, 2) * unit_vector(random);
    q.flight_b.position = q.flight_a.position;
    switch (integer(random, 0, 7)) {
      case 0:
        graze(size * (integer(random, 0, 2) ? -1 : 1) * magnitude(random, 1e-10, 0.3), 0);
        break;
      case 1:
        graze(0, 0);
        break;
      case 2:  // on top of each other
        if (integer(random, 0, 1)) q.flight_b.orientation = q.flight_a.orientation;
        break;
      case 3: {  // from tiny gaps to gaps
        const Vec3 n = bring_near(size * magnitude(random, 1e-9, 1e-2));
        q.flight_b.position -= n * size * (integer(random, 0, 1) ? 0 : magnitude(random, 1e-9, 1e-2));
        break;
      }
      case 4:
      case 5:
      case 6:
        put_inside();
        break;
      default:  // anywhere: inside, in a cavity, in a hole, across
        q.flight_b.position += 0.8 * size * uniform(random, 0, 1) * unit_vector(random);
        break;
    }
  }
};

void tell(const Teller& m) {
  Random& random = m.random;
  Query& q = m.q;
  m.orient();
  m.approach();
  switch (q.story) {
    case Story::translating:
      break;
    case Story::slow:
      m.spins(0.01, 1);
      break;
    case Story::fast:
      m.spins(6, 63);
      break;
    case Story::falling:
      m.spins(0.1, 6);
      q.flight_a.acceleration = m.reach * uniform(random, 0, 3) * unit_vector(random);
      q.flight_b.acceleration = m.reach * uniform(random, 0, 3) * unit_vector(random);
      if (integer(random, 0, 1)) {
        const Vec3 n = m.bring_near(m.size * magnitude(random, 1e-4, 0.3));
        m.slide(n, 0.3 * m.reach * uniform(random, 0, 1), -m.reach * uniform(random, 0, 1), 0);
        q.flight_b.acceleration = q.flight_a.acceleration - m.reach * uniform(random, 0, 4) * n;
      }
      break;
    case Story::turning: {
      const Vec3 n = m.bring_near(m.size * magnitude(random, 1e-3, 0.3));
      m.spins(0.1, 6);
      m.slide(n, 0.1 * m.size * uniform(random, 0, 1), m.size * uniform(random, -0.3, 0.1), 0);
      break;
    }
    case Story::grazing:
      m.graze(m.size * (integer(random, 0, 1) ? 1 : -1) * magnitude(random, 1e-8, 1e-3),
              uniform(random, 0, 1));
      break;
    case Story::sliding: {
      const double gap = m.size * magnitude(random, 1e-7, 1e-2);
      const Vec3 n = m.bring_near(gap);
      m.slide(n, m.size * magnitude(random, 1e-4, 1), gap * uniform(random, -1, 1), 0);
      q.flight_a.spin = magnitude(random, 1e-5, 1) * (integer(random, 0, 1) ? n : unit_vector(random));
      break;
    }
    case Story::near_miss:
      m.graze(m.size * magnitude(random, 1e-4, 0.1), 0.5);
      m.spins(0.1, 6);
      break;
    case Story::far: {
      m.spins(0.1, 6);
      const Vec3 shift = m.size * magnitude(random, 1e3, 1e6) * unit_vector(random);
      if (integer(random, 0, 1)) {
        q.flight_a.position += shift;
        q.flight_b.position += shift;
      } else {
        const Vec3 from = m.reach * magnitude(random, 10, 1e3) * unit_vector(random);
        q.flight_b.position = q.flight_a.position + from;
        q.flight_b.velocity = q.flight_a.velocity - from * uniform(random, 0.9, 1.5);
      }
      break;
    }
    case Story::start:
      m.start();
      if (integer(random, 0, 1)) m.spins(0.01, 3);
      break;
    case Story::parked:
      m.start();
      q.flight_a.velocity *= integer(random, 0, 1);
      q.flight_a.spin = q.flight_b.spin = Vec3::Zero();
      q.flight_b.velocity = q.flight_a.velocity;
      if (integer(random, 0, 1)) m.bring_near(m.size * magnitude(random, 1e-6, 1e-1));
      break;
  }
}

Random random_of(std::uint64_t seed, std::uint64_t number, std::uint64_t purpose) {
  std::seed_seq mixed{seed, seed >> 32, number, number >> 32, purpose};
  return Random(mixed);
}

// The same flights, faster or slower.
void stretch(Query& q, double interval) {
  for (truth::Flight* f : {&q.flight_a, &q.flight_b}) {
    f->velocity /= interval;
    f->spin /= interval;
    f->acceleration /= interval * interval;
  }
  q.options.interval = interval;
}

}  // namespace

const char* name_of(Kind kind) {
  static constexpr std::array names = {"bumpy",  "torus",   "lumpy",      "knot",   "sheet",
                                       "soup",   "plate",   "components", "coarse", "slivers",
                                       "sphere", "capsule", "box",        "hull"};
  return names[static_cast<int>(kind)];
}

const char* name_of(Story story) {
  static constexpr std::array names = {"translating", "slow",      "fast", "falling", "turning", "grazing",
                                       "sliding",     "near_miss", "far",  "start",   "parked"};
  return names[static_cast<int>(story)];
}

const char* name_of(Approach approach) {
  static constexpr std::array names = {"far", "near", "grazing"};
  return names[static_cast<int>(approach)];
}

Story story_of(std::uint64_t number) {
  return kStories[number % kStories.size()];
}

Approach approach_of(std::uint64_t number) {
  return static_cast<Approach>(number % 3);
}

Query Queries::at(std::uint64_t number) {
  const std::uint64_t pair = number / kStories.size();
  if (pair != pair_) {
    Random random = random_of(seed_, pair, 1);
    const double scale = integer(random, 0, 1) ? 1 : magnitude(random, 1e-3, 1e6);
    first_ = std::make_shared<Prepared>(random_shape(random, kMeshKinds[pair % kMeshKinds.size()], scale));
    const Kind kind = kKinds[pair / kMeshKinds.size() % kKinds.size()];
    second_ = std::make_shared<Prepared>(
        random_shape(random, kind,
                     scale * (integer(random, 0, 1) ? uniform(random, 0.3, 1) : magnitude(random, 0.02, 1))));
    pair_ = pair;
  }
  Random random = random_of(seed_, number, 2);
  const bool turned = integer(random, 0, 1) == 0;
  Query q;
  q.a = turned ? second_ : first_;
  q.b = turned ? first_ : second_;
  q.story = story_of(number);
  tell({random, q});
  stretch(q, integer(random, 0, 1) ? 1 : magnitude(random, 1e-3, 1e3));
  if (q.story == Story::parked && integer(random, 0, 9) == 0) q.options.interval = 0;
  q.options.tolerance = extent(first_->shape) * magnitude(random, 1e-9, 1e-4);
  q.limited = integer(random, 0, 19) == 0;
  q.options.max_iterations = q.limited ? integer(random, 1, 100) : 3'000'000;
  return q;
}

Query query_of_one_mesh(std::shared_ptr<const Prepared> mesh, std::uint64_t seed, std::uint64_t number) {
  Random random = random_of(seed, number, 3);
  Query q;
  q.a = q.b = std::move(mesh);
  const Teller m{random, q};
  q.flight_a.orientation = rotation(random);
  q.flight_b.orientation = rotation(random);
  m.approach();
  m.spins(0.1, 4);
  const double size = 2 * m.size;
  switch (approach_of(number)) {
    case Approach::far:
      break;
    case Approach::near: {
      const Vec3 n = m.bring_near(size * magnitude(random, 1e-3, 1.3e-2));
      m.slide(n, size * uniform(random, 0, 0.5), size * uniform(random, -0.05, 0.3), 0);
      break;
    }
    case Approach::grazing: {
      m.spins(1e-3, 0.5);
      const Vec3 n = m.bring_near(size * magnitude(random, 1e-7, 1e-3));
      m.slide(n, size * magnitude(random, 1e-3, 0.5), 0, integer(random, 0, 1) ? 0 : uniform(random, 0, 1));
      break;
    }
  }
  q.options.tolerance = integer(random, 0, 1) ? 1e-6 * size : size * magnitude(random, 1e-9, 1e-4);
  q.options.max_iterations = 10'000'000;
  return q;
}

std::shared_ptr<const Prepared> bunny() {
  const char* file = "/usr/share/glmark2/models/bunny.obj";
  if (!std::filesystem::exists(file)) return nullptr;
  TriangleMesh mesh = fc::prepare_mesh(fc::load_mesh(file)).mesh;
  const Vec3 middle = fc::solid_mass(mesh, 1).center_of_mass;
  for (Vec3& v : mesh.vertices) v -= middle;
  return std::make_shared<Prepared>(prepare(mesh, true, "bunny"));
}

}  // namespace suite
