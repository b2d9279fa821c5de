// The factory's contact problems: bodies and contacts as a world has them, A by the chapter's own assemble().
#include <cmath>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/problem_factory_parts.hpp"

namespace fc::lcp::detail {
namespace {

// m/s, what gravity adds to a speed in a step; z is this times the mass above.
constexpr double kLoad = 0.125;

struct Scene {
  std::vector<RigidBody> bodies;  // the first is the floor, or the wall
  std::vector<Contact> contacts;
};

MatX matrix(const Scene& scene) {
  return assemble(scene.bodies, scene.contacts).A;
}

// A cube of 1 m, or with `inertia` something else of that size; mass a power of two, so that all is exact.
RigidBody body(const Vec3& position, double mass, double inertia = 1.0 / 6) {
  RigidBody b;
  b.position = position;
  b.mass = mass;
  b.inverse_mass = 1 / mass;
  b.inertia_body = mass * inertia * Mat3::Identity();
  b.inverse_inertia_body = std::round(1 / inertia) / mass * Mat3::Identity();
  return b;
}

void touch(Scene& scene, int a, int b, const Vec3& point, const Vec3& normal) {
  scene.contacts.push_back({a, b, point, normal, 0, 0});
}

// kg: 1 for body 0, 2^doublings for the last, powers of two between.
double rising_mass(int k, int count, int doublings) {
  return count < 2 ? 1 : std::exp2(std::round(doublings * double(k) / (count - 1)));
}

// Around the face, so that 0 and 2, 1 and 3 are opposite.
Vec3 corner(int k) {
  return {k == 0 || k == 3 ? 0.5 : -0.5, k < 2 ? 0.5 : -0.5, 0};
}

KnownProblem duplicates(int n, Random& random) {
  Scene scene{{RigidBody{}, body({0, 0, 0.5}, 1)}, {}};
  for (int i = 0; i < n; ++i) touch(scene, 0, 1, corner(i % 4), Vec3::UnitZ());
  KnownProblem p;
  p.A = matrix(scene);
  p.rank = 3;
  p.p_matrix = false;
  plant(p, n / 2, 0, random);
  return p;
}

// Four contacts in each face; every face carries the bodies above it up to the next separating face. Of four
// faces one separates, one carries with all corners, two with opposite corners: loads turn no box.
KnownProblem stack(int n, int doublings, Random& random) {
  const int boxes = n / 4;
  Scene scene{{RigidBody{}}, {}};
  for (int k = 0; k < boxes; ++k) {
    scene.bodies.push_back(body({0, 0, k + 0.5}, rising_mass(k, boxes, doublings)));
    for (int c = 0; c < 4; ++c) touch(scene, k, k + 1, corner(c) + k * Vec3::UnitZ(), Vec3::UnitZ());
  }
  KnownProblem p;
  p.A = matrix(scene);
  p.rank = 3 * boxes;
  p.p_matrix = false;
  std::vector<int> faces(static_cast<std::size_t>(boxes));
  for (int k = 0; k < boxes; ++k) faces[static_cast<std::size_t>(k)] = k % 4;
  random.shuffle(faces);
  p.z = p.w = VecX::Zero(n);
  double load = 0;
  for (int k = boxes - 1; k >= 0; --k) {
    load += kLoad * scene.bodies[static_cast<std::size_t>(k) + 1].mass;
    const int face = faces[static_cast<std::size_t>(k)];
    for (int c = 0; c < 4; ++c) {
      const bool carries = face == 1 || (face > 1 && c % 2 == face % 2);
      (carries ? p.z : p.w)[4 * k + c] = !carries ? random.eighths() : load / (face == 1 ? 4 : 2);
    }
    if (face == 0) load = 0;
  }
  set_b(p);
  return p;
}

KnownProblem tower(int n, Random& random) {
  Scene scene{{RigidBody{}}, {}};
  std::vector<char> apart(static_cast<std::size_t>(n), 0);
  for (int k = 0; k < n; ++k) {
    scene.bodies.push_back(body({0, 0, k + 0.5}, rising_mass(k, n, 27), 0.1));
    touch(scene, k, k + 1, k * Vec3::UnitZ(), Vec3::UnitZ());
    apart[static_cast<std::size_t>(k)] = k < n / 4;
  }
  random.shuffle(apart);
  KnownProblem p;
  p.A = matrix(scene);
  p.rank = n;
  p.z = p.w = VecX::Zero(n);
  double load = 0;
  for (int k = n - 1; k >= 0; --k) {
    load += kLoad * scene.bodies[static_cast<std::size_t>(k) + 1].mass;
    const bool open = apart[static_cast<std::size_t>(k)];
    (open ? p.w : p.z)[k] = open ? random.eighths() : load;
    if (open) load = 0;
  }
  set_b(p);
  return p;
}

KnownProblem chain(int n, Random& random) {
  Scene scene{{RigidBody{}}, {}};
  for (int k = 0; k < n; ++k) {
    scene.bodies.push_back(k + 1 < n ? body({k + 1.0, 0, 0}, k % 2 == 0 ? 1 : 0x1p27, 0.1) : RigidBody{});
    touch(scene, k, k + 1, Vec3(k + 0.5, 0, 0), Vec3::UnitX());
  }
  KnownProblem p;
  p.A = matrix(scene);
  p.rank = n - 1;
  p.p_matrix = false;
  plant(p, n / 2, 0, random);
  return p;
}

Vec3 random_vector(double size, Random& random) {
  return size * Vec3(2 * random.uniform() - 1, 2 * random.uniform() - 1, 2 * random.uniform() - 1);
}

// The contacts of body b with an earlier one (or the floor): one point on the line of centres if either is a
// ball, else four around it, with a common normal that leans.
void meet(Scene& scene, int a, int b, const std::vector<char>& is_box, Random& random) {
  const Vec3 below = scene.bodies[static_cast<std::size_t>(b)].position;
  const Vec3 other =
      a == 0 ? Vec3(below.x(), below.y(), -0.5) : scene.bodies[static_cast<std::size_t>(a)].position;
  Vec3 normal = (below - other).normalized();
  const Vec3 middle = 0.5 * (below + other);
  if (!is_box[static_cast<std::size_t>(a)] || !is_box[static_cast<std::size_t>(b)])
    return touch(scene, a, b, middle, normal);
  normal = (normal + random_vector(0.1, random)).normalized();
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  for (int c = 0; c < 4; ++c)
    touch(scene, a, b, middle + 0.6 * (corner(c).x() * u + corner(c).y() * v), normal);
}

// Bodies of 1/8 to 8 kg on a disturbed grid over the floor; each meets the three before it.
KnownProblem heap(int n, bool boxes, Random& random) {
  const int side = std::max(2, static_cast<int>(std::ceil(std::cbrt(n / (boxes ? 7.0 : 3.0)))));
  Scene scene{{RigidBody{}}, {}};
  std::vector<char> is_box{1};
  for (int k = 0; static_cast<int>(scene.contacts.size()) < n; ++k) {
    const int x = k % side, y = k / side % side, z = k / (side * side);
    RigidBody b = body(Vec3(x, y, z + 0.5) + random_vector(0.1, random), std::exp2(random.whole(-3, 3)), 0.1);
    is_box.push_back(boxes && random.uniform() < 0.7);
    if (is_box.back()) {
      const Vec3 inertia = b.mass * (Vec3::Constant(0.15) + random_vector(0.05, random));
      b.inertia_body = inertia.asDiagonal();
      b.inverse_inertia_body = inertia.cwiseInverse().asDiagonal();
      b.orientation = Quat(1, random.uniform(), random.uniform(), random.uniform()).normalized();
    }
    scene.bodies.push_back(b);
    const int at = k + 1;
    meet(scene, z == 0 ? 0 : at - side * side, at, is_box, random);
    if (x > 0) meet(scene, at - 1, at, is_box, random);
    if (y > 0) meet(scene, at - side, at, is_box, random);
  }
  scene.contacts.resize(static_cast<std::size_t>(n));
  KnownProblem p;
  p.A = matrix(scene);
  p.rank = std::min(n, (boxes ? 6 : 3) * static_cast<int>(scene.bodies.size() - 1));
  p.p_matrix = p.exact = false;
  plant(p, n / 2, 0, random);
  return p;
}

}  // namespace

KnownProblem contact_problem(Family family, Eigen::Index rows, Random& random) {
  const int n = static_cast<int>(rows);
  switch (family) {
    case Family::duplicate_contacts:
      return duplicates(n, random);
    case Family::stack:
      return stack(n, 0, random);
    case Family::stack_1e4:
      return stack(n, 14, random);
    case Family::stack_1e8:
      return stack(n, 27, random);
    case Family::tower_1e8:
      return tower(n, random);
    case Family::chain_1e8:
      return chain(n, random);
    case Family::ball_heap:
      return heap(n, false, random);
    default:
      return heap(n, true, random);
  }
}

}  // namespace fc::lcp::detail
