// Random queries.
#include "suite.hpp"
#include "tests/support/random_shapes.hpp"

namespace suite {
namespace {

using fc::Vec3;
using fc::test::integer;
using fc::test::magnitude;
using fc::test::Random;
using fc::test::rotation;
using fc::test::uniform;
using fc::test::unit_vector;

double flat(Random& random) {  // a size from plump to flat
  return integer(random, 0, 4) ? uniform(random, 0.2, 1) : magnitude(random, 1e-4, 0.1);
}

truth::Shape random_shape(Random& random, Kind kind, double size) {
  truth::Shape shape;
  const auto add = [&](const Vec3& p) { shape.points.push_back((size * p).cast<truth::Real>()); };
  switch (kind) {
    case Kind::sphere:
      add(Vec3::Zero());
      shape.radius = size * uniform(random, 0.1, 0.5);
      break;
    case Kind::capsule: {
      const double half = uniform(random, 0.05, 0.4);
      add({0, 0, -half});
      add({0, 0, half});
      shape.radius = size * uniform(random, 0.02, 0.2);
      break;
    }
    case Kind::box: {
      const Vec3 half = 0.4 * Vec3(flat(random), flat(random), flat(random));
      for (int i = 0; i < 8; ++i)
        add({(i & 1) ? half.x() : -half.x(), (i & 2) ? half.y() : -half.y(), (i & 4) ? half.z() : -half.z()});
      break;
    }
    case Kind::hull: {
      const Vec3 squeeze(1, flat(random), flat(random));
      for (int i = integer(random, 4, 32); i > 0; --i)
        add(0.5 * uniform(random, 0.6, 1) * unit_vector(random).cwiseProduct(squeeze));
      break;
    }
    case Kind::cylinder:
    case Kind::cone: {
      const bool pointed = kind == Kind::cone;
      const double length = 0.8 * flat(random), radius = size * 0.4 * flat(random);
      add({0, 0, pointed ? -length / 4 : -length / 2});
      add({0, 0, pointed ? 3 * length / 4 : length / 2});
      shape.disks = {radius, pointed ? 0 : radius};
      break;
    }
  }
  return shape;
}

double extent(const truth::Shape& shape) {
  return static_cast<double>(shape.reach() + shape.radius);
}

// The body's farthest point along n, from its centre of mass.
Vec3 farthest(const truth::Body& body, const Vec3& n) {
  const fc::Mat3 axes = body.flight.orientation.toRotationMatrix();
  const Vec3 local = axes.transpose() * n;
  const Vec3 rim =
      local.head<2>().norm() > 0 ? Vec3(local.x(), local.y(), 0).normalized() : Vec3(Vec3::Zero());
  Vec3 best = Vec3::Zero();
  for (std::size_t i = 0; i < body.shape.points.size(); ++i) {
    const double disk = body.shape.disks.empty() ? 0 : static_cast<double>(body.shape.disks[i]);
    const Vec3 p = body.shape.points[i].cast<double>() + disk * rim;
    if (i == 0 || local.dot(p) > local.dot(best)) best = p;
  }
  return axes * best + static_cast<double>(body.shape.radius) * n;
}

struct Maker {
  Random& random;
  Query& q;
  double size, reach;

  Vec3 spin(double low, double high) const {
    return integer(random, 0, 5) ? Vec3(magnitude(random, low, high) * unit_vector(random))
                                 : Vec3(Vec3::Zero());
  }

  void orient() const {
    for (truth::Body* body : {&q.a, &q.b})  // one time in four along the axes: faces and edges are parallel
      body->flight.orientation = integer(random, 0, 3) ? rotation(random) : fc::Quat::Identity();
  }

  // Towards each other from 0.9 to 3 reaches apart, not quite centrally.
  void approach() const {
    const Vec3 apart = reach * uniform(random, 0.9, 3) * unit_vector(random);
    q.a.flight.position = size * unit_vector(random);
    q.b.flight.position = q.a.flight.position + apart;
    q.a.flight.velocity = size * uniform(random, 0, 5) * unit_vector(random);
    q.b.flight.velocity = q.a.flight.velocity - apart * uniform(random, 0.3, 2.5) +
                          uniform(random, 0, 0.8) * reach * unit_vector(random);
  }

  void spins(double low, double high) const {
    q.a.flight.spin = spin(low, high);
    q.b.flight.spin = spin(low, high);
  }

  // B slides along a plane whose gap to A is `gap`, so that the points next to the plane meet after a part
  // `when` of the interval; if they spin, then about the plane's normal.
  void graze(double gap, double when) const {
    const Vec3 n = integer(random, 0, 1) ? unit_vector(random) : Vec3(Vec3::Unit(integer(random, 0, 2)));
    const Vec3 along = n.cross(unit_vector(random)).normalized();
    const Vec3 way = reach * uniform(random, 0.5, 4) * along;
    q.b.flight.position = q.a.flight.position + farthest(q.a, n) - farthest(q.b, -n) + gap * n - when * way;
    q.b.flight.velocity = q.a.flight.velocity + way;
    if (integer(random, 0, 1) == 0) return;
    q.a.flight.spin = uniform(random, -3, 3) * n;
    q.b.flight.spin = uniform(random, -3, 3) * n;
  }

  // The balls around both bodies come as close as `gap`, halfway through.
  void pass(double gap) const {
    const Vec3 n = unit_vector(random), along = n.cross(unit_vector(random)).normalized();
    const Vec3 way = reach * uniform(random, 1, 6) * along;
    q.b.flight.position = q.a.flight.position + (extent(q.a.shape) + extent(q.b.shape) + gap) * n - 0.5 * way;
    q.b.flight.velocity = q.a.flight.velocity + way;
  }
};

void tell(const Maker& m, Story story) {
  Random& random = m.random;
  Query& q = m.q;
  m.orient();
  m.approach();
  switch (story) {
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
      q.a.flight.acceleration = m.reach * uniform(random, 0, 3) * unit_vector(random);
      q.b.flight.acceleration = m.reach * uniform(random, 0, 3) * unit_vector(random);
      break;
    case Story::grazing:
      m.graze(m.size * (integer(random, 0, 1) ? 1 : -1) * magnitude(random, 1e-8, 1e-3),
              uniform(random, 0, 1));
      break;
    case Story::near_miss:
      m.spins(0.1, 6);
      m.pass(m.reach * uniform(random, -0.3, 0.1));
      break;
    case Story::far: {
      m.spins(0.1, 6);
      const Vec3 shift = m.size * magnitude(random, 1e3, 1e6) * unit_vector(random);
      if (integer(random, 0, 1)) {
        q.a.flight.position += shift;
        q.b.flight.position += shift;
      } else {
        const Vec3 from = m.reach * magnitude(random, 10, 1e3) * unit_vector(random);
        q.b.flight.position = q.a.flight.position + from;
        q.b.flight.velocity = q.a.flight.velocity - from * uniform(random, 0.9, 1.5);
      }
      break;
    }
    case Story::tiny:
    case Story::huge:
      m.spins(0.1, 12);
      break;
    case Story::start:
      m.graze(m.size * (integer(random, 0, 2) ? -1 : 1) * magnitude(random, 1e-10, 0.3), 0);
      break;
  }
}

}  // namespace

const char* name_of(Story story) {
  static constexpr std::array names = {"translating", "slow", "fast", "falling", "grazing",
                                       "near_miss",   "far",  "tiny", "huge",    "start"};
  return names[static_cast<int>(story)];
}

Story story_of(std::uint64_t number) {
  return kStories[number % kStories.size()];
}

Query query_of(std::uint64_t seed, std::uint64_t number) {
  std::seed_seq mixed{seed, seed >> 32, number, number >> 32};
  Random random(mixed);
  const Story story = story_of(number);
  const std::uint64_t pair = number / kStories.size();
  double size = magnitude(random, 0.1, 10);
  if (story == Story::tiny) size = magnitude(random, 1e-6, 1e-5);
  if (story == Story::huge) size = magnitude(random, 1e5, 1e7);
  Query q;
  q.a.shape = random_shape(random, kKinds[pair % kKinds.size()], size);
  q.b.shape =
      random_shape(random, kKinds[pair / kKinds.size() % kKinds.size()],
                   size * (integer(random, 0, 3) ? uniform(random, 0.3, 1) : magnitude(random, 0.01, 1)));
  tell({random, q, size, extent(q.a.shape) + extent(q.b.shape)}, story);
  const double interval = integer(random, 0, 1) ? 1 : magnitude(random, 1e-3, 1e3);
  for (truth::Flight* f : {&q.a.flight, &q.b.flight}) {  // the same flight, faster or slower
    f->velocity /= interval;
    f->spin /= interval;
    f->acceleration /= interval * interval;
  }
  q.options.interval = interval;
  q.options.tolerance = size * magnitude(random, 1e-9, 1e-4);
  // Every bound, the default one most often.
  if (integer(random, 0, 2) == 0) q.options.bound = static_cast<fc::ca::MotionBound>(integer(random, 0, 2));
  q.options.max_iterations = 100'000;
  q.options.certificate = number % 4 == number / 40 % 4;  // every story and every pair in its turn
  return q;
}

}  // namespace suite
