// Caught by: Ex06Creeping.LiftingIsTold
// What a gap lacks is asked of the velocity.
#include "ex05_creeping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fc::exercises {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr int kMostSweeps = 3000;
constexpr int kRounds = 8;            // of a contact in a sweep
constexpr int kPatience = 500;        // sweeps after which steps are halved: whole ones may go in circles
constexpr double kTolerance = 1e-15;  // of the largest velocity: sweeps that change less are the last ones
constexpr double kCorrect = 0.2;      // the part of what a gap lacks that one frame makes up
constexpr double kInside = 1 - 1e-9;  // of the cone: what is inside sticks

// The normal, and two tangents.
Mat3 axes_of(const Vec3& normal) {
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  Mat3 axes;
  axes.col(0) = normal;
  axes.col(1) = (Vec3::Unit(least) - normal[least] * normal).normalized();
  axes.col(2) = normal.cross(axes.col(1));
  return axes;
}

// Feet in contact, with what the formulas want of them. Vectors of rows have three for each: normal, tangent, tangent.
struct Contacts {
  std::vector<int> feet;
  std::vector<Vec3> arms;  // m, from the centre
  std::vector<Mat3> axes;
  MatX A;  // J M^-1 J', 1/kg

  Eigen::Index count() const { return std::ssize(feet); }
};

// J v, m/s (or J of a displacement, m).
VecX along_axes(const Contacts& contacts, const Vec3& velocity, const Vec3& spin) {
  VecX rows(3 * contacts.count());
  for (Eigen::Index i = 0; i < contacts.count(); ++i)
    rows.segment<3>(3 * i) = contacts.axes[i].transpose() * (velocity + spin.cross(contacts.arms[i]));
  return rows;
}

// Adds M^-1 J' r.
void give(const Body& body, const Contacts& contacts, const VecX& r, Vec3& velocity, Vec3& spin) {
  for (Eigen::Index i = 0; i < contacts.count(); ++i) {
    const Vec3 impulse = contacts.axes[i] * r.segment<3>(3 * i);
    velocity += impulse / body.mass;
    spin += contacts.arms[i].cross(impulse) / body.inertia;
  }
}

Contacts contacts_of(Scene& scene, double dt) {
  Contacts contacts;
  Body& body = scene.body;
  for (int i = 0; i < std::ssize(body.feet); ++i) {
    Foot& foot = body.feet[i];
    const double gap = gap_of(scene, i),
                 speed = scene.floor.normal.dot(velocity_of(body, i) + dt * scene.gravity);
    const bool touches = gap <= scene.margin || gap + dt * speed <= 0;
    if (touches) foot.axes = axes_of(scene.floor.normal);
    foot.touches = touches;
    if (!touches) continue;
    contacts.feet.push_back(i);
    contacts.arms.push_back(body.turn * foot.place);
    contacts.axes.push_back(foot.axes);
  }
  const Eigen::Index rows = 3 * contacts.count();
  contacts.A.resize(rows, rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();
    give(body, contacts, VecX::Unit(rows, k), velocity, spin);
    contacts.A.col(k) = along_axes(contacts, velocity, spin);
  }
  return contacts;
}

// What impulses are asked for. Normal impulses are given, or make the rows' velocities not negative. Each friction has its
// own limit, or mu times the normal impulse.
struct Limits {
  double mu = 0;
  VecX radii, normals;  // N s, one for each contact; or empty
};

// Impulses r with the velocities A r + b, found by sweeps, contact by contact, from a guess.
VecX solve(const MatX& A, const VecX& b, const Limits& limits, VecX r) {
  const Eigen::Index count = b.size() / 3;
  VecX u = A * r + b;
  for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
    const double relaxation = std::pow(0.5, sweep / kPatience);
    double change = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto columns = A.middleCols<3>(3 * i);
      const Mat3 block = columns.middleRows<3>(3 * i);
      const Vec3 old = r.segment<3>(3 * i);
      Vec3 now = old, velocity = u.segment<3>(3 * i);
      now[0] =
          limits.normals.size() > 0 ? limits.normals[i] : std::max(0.0, old[0] - velocity[0] / block(0, 0));
      velocity += block.col(0) * (now[0] - old[0]);

      // A step against the slip, and back onto the disc.
      const Vec2 slip = velocity.tail<2>();
      const double size = 1 / (block(1, 1) + block(2, 2));
      Vec2 friction = old.tail<2>() - size * slip;
      const double radius = limits.radii.size() > 0 ? limits.radii[i] : limits.mu * now[0];
      if (friction.norm() > radius) friction *= radius / friction.norm();
      now.tail<2>() = friction;

      const Vec3 step = relaxation * (now - old);
      r.segment<3>(3 * i) += step;
      u += columns * step;
      change = std::max(change, (block * (now - old)).lpNorm<Eigen::Infinity>());
    }
    if (change <= kTolerance * (b.lpNorm<Eigen::Infinity>() + u.lpNorm<Eigen::Infinity>())) break;
  }
  return r;
}

void report_pushes(const Contacts& contacts, const VecX& r, bool impact, Report& report) {
  for (Eigen::Index i = 0; i < contacts.count(); ++i)
    if (const Vec3 impulse = r.segment<3>(3 * i); !impulse.isZero(0))
      report.pushes.push_back({contacts.feet[i], contacts.axes[i] * impulse, impact});
}

void impact(Scene& scene, double dt, Report& report) {
  Body& body = scene.body;
  const Contacts contacts = contacts_of(scene, dt);
  const VecX before = along_axes(contacts, body.velocity, body.spin);
  const Eigen::Index count = contacts.count();
  VecX normals(count);
  bool hits = false;
  for (Eigen::Index i = 0; i < count; ++i) hits = hits || before[3 * i] < -scene.margin / dt;
  if (!hits) return;

  const MatX& A = contacts.A;
  const VecX first = solve(A, before, {scene.floor.friction, {}, {}}, VecX::Zero(3 * count));
  VecX given = VecX::Zero(3 * count);
  for (Eigen::Index i = 0; i < count; ++i) given[3 * i] = scene.floor.restitution * first[3 * i];
  const double taken = first.dot(A * first), costs = given.dot(A * given);
  given *= costs > taken ? std::sqrt(taken / costs) : 1;
  for (Eigen::Index i = 0; i < count; ++i) normals[i] = given[3 * i];
  const VecX r = first + solve(A, before + A * first, {0, scene.floor.friction * normals, normals}, given);
  give(body, contacts, r, body.velocity, body.spin);
  report_pushes(contacts, r, true, report);
}

void plan(Scene& scene, double dt, Report& report) {
  Body& body = scene.body;
  const double mu = scene.floor.friction, rest = 0.5 * scene.margin;
  const Contacts contacts = contacts_of(scene, dt);
  const Eigen::Index count = contacts.count();
  body.velocity += dt * scene.gravity;
  VecX b = along_axes(contacts, body.velocity, body.spin), guess(3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int foot = contacts.feet[i];
    b[3 * i] += (gap_of(scene, foot) - rest > 0 ? 1.0 : kCorrect) * (gap_of(scene, foot) - rest) / dt;
    guess.segment<3>(3 * i) = contacts.axes[i].transpose() * body.feet[foot].impulse;
  }
  const VecX r = solve(contacts.A, b, {mu, {}, {}}, guess);
  give(body, contacts, r, body.velocity, body.spin);
  report_pushes(contacts, r, false, report);

  // Gaps are put right. What sticks keeps its place.
  const VecX u = along_axes(contacts, body.velocity, body.spin);
  VecX lacks = VecX::Zero(3 * count), radii(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double lack = rest - (gap_of(scene, contacts.feet[i]) + dt * u[3 * i]);
    lacks[3 * i] = -(lack > 0 ? kCorrect * lack : lack);
    const bool sticks = r[3 * i] > 0 && r.segment<2>(3 * i + 1).norm() < kInside * mu * r[3 * i];
    radii[i] = sticks ? std::numeric_limits<double>::infinity() : 0;
  }
  Vec3 shift = Vec3::Zero(), turn = Vec3::Zero();
  give(body, contacts, solve(contacts.A, lacks, {0, radii, {}}, VecX::Zero(3 * count)), shift, turn);
  report.lifted -= body.mass * scene.gravity.dot(shift);

  body.centre += dt * body.velocity + shift;
  const Vec3 angle = dt * body.spin + turn;
  if (angle.norm() > 0)
    body.turn = Eigen::AngleAxisd(angle.norm(), angle.normalized()).toRotationMatrix() * body.turn;
  for (Foot& foot : body.feet) foot.impulse.setZero();
  for (Eigen::Index i = 0; i < count; ++i)
    body.feet[contacts.feet[i]].impulse = contacts.axes[i] * r.segment<3>(3 * i);
}

}  // namespace

Vec3 place_of(const Body& body, int foot) {
  return body.centre + body.turn * body.feet[foot].place;
}

Vec3 velocity_of(const Body& body, int foot) {
  return body.velocity + body.spin.cross(body.turn * body.feet[foot].place);
}

double gap_of(const Scene& scene, int foot) {
  return scene.floor.normal.dot(place_of(scene.body, foot));
}

// 1. Both tangents have one step size. With two, the sweeps end where friction is not against the slip.
// 2. Friction is limited by the push of this frame, not by the body's weight.
// 3. The axes turn with the floor. Those of the first touch are no tangents any more.
// 4. Corrections hold what sticks. Else each of them moves a foot along the floor a little, and the body walks.
// 5. Restitution in two stages. Newton's law (each foot leaves with e times the speed it came with) and Coulomb's make energy.
// 6. Gravity pulls along the floor, too, before friction is asked for. Else friction only stops what the last frame left over.
Report step(Scene& scene, double dt) {
  Report report;
  impact(scene, dt, report);
  plan(scene, dt, report);
  return report;
}

}  // namespace fc::exercises
