#include "ch04_multibody_stepping/live_hand.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "ch04_multibody_stepping/sleep.hpp"

namespace fc::world {
namespace {

// The spring is critically damped with this time constant: fast enough to feel held, and slow beside a frame of 1/60 s.
constexpr double kTime = 0.1;  // s

// The most that the hand pulls, in weights of the body: enough to lift it with a stack of its like. Without a limit, a body that
// is held back by a wall would be pressed against it ever harder.
constexpr double kMostWeights = 20;

constexpr double kLargest = 1e9;  // m, m/s: what a scene may have

// The acceleration that the hand's largest force gives the body. Without gravity there are no weights: then that of the spring
// when it is as long as the scene.
double most_acceleration(const World& world, const RigidBody& state, double size) {
  const double weight = world.effects.gravity ? world.gravity_on(state).norm() : 0;
  return weight > 0 ? kMostWeights * weight : size / (kTime * kTime);
}

// What an impulse at a point changes there: change of velocity = matrix * impulse. 1/kg.
Mat3 response(const RigidBody& state, const Vec3& arm) {
  Mat3 across;
  across << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
  return Mat3((state.inverse_mass * state.free_moves).asDiagonal()) -
         across * state.inverse_inertia_world() * across;
}

// The impulse that changes the point's velocity by this, as far as its degrees of freedom allow.
Vec3 impulse_for(const Mat3& response, const Vec3& change) {
  constexpr double kFree = 1e-9;  // of the freest direction: less is a direction that is fixed
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(response);
  const Vec3 weights = axes.eigenvalues();
  Vec3 impulse = Vec3::Zero();
  for (int k = 0; k < 3; ++k)
    if (weights[k] > kFree * weights.maxCoeff())
      impulse += axes.eigenvectors().col(k) * (axes.eigenvectors().col(k).dot(change) / weights[k]);
  return impulse;
}

// Sleepers that touch the body may lose what holds them.
void wake_around(World& world, int body) {
  if (!world.effects.sleep || !world.bodies[static_cast<std::size_t>(body)].asleep) return;
  std::vector<Bounds> boxes;
  for (int i = 0; i < static_cast<int>(world.bodies.size()); ++i)
    boxes.push_back(world.swept_bounds(i, 0, 0));
  world.schedule.begin(boxes);
  std::vector<int> woken = {body};
  StepReport ignored;  // the page shows no count of wakes
  wake(world, 0, woken, ignored);
}

}  // namespace

void check_vector(const Vec3& v, const char* what) {
  if (v.allFinite() && v.cwiseAbs().maxCoeff() <= kLargest) return;
  throw InputError(fmt::format("{} is out of range [-1e9, 1e9]; give smaller numbers", what));
}

void Hand::grab(const World& world, const Scene& scene, int body, const Vec3& point) {
  check_vector(point, "the grabbed point");
  if (body < 0 || body >= static_cast<int>(world.bodies.size()))
    throw InputError(fmt::format("there is no body {}; the bodies are numbered 0 to {}", body,
                                 static_cast<int>(world.bodies.size()) - 1));
  if (!world.is_dynamic(body))
    throw InputError(fmt::format("body {} is static or kinematic, and no pull moves it; grab another",
                                 scene.body_text(body)));
  const Body& grabbed = world.bodies[static_cast<std::size_t>(body)];
  const Vec3 arm = point - grabbed.state.position;
  const double reach = world.shapes[static_cast<std::size_t>(grabbed.shape)].reach;
  local_ = grabbed.state.orientation.conjugate() * Vec3(std::min(1.0, reach / arm.norm()) * arm);
  body_ = body;
  target_ = this->point(world);
}

void Hand::drag(const Vec3& to) {
  check_vector(to, "the point to drag to");
  if (body_ < 0) throw InputError("nothing is grabbed; grab a body first");
  target_ = to;
}

Vec3 Hand::point(const World& world) const {
  const RigidBody& state = world.bodies[static_cast<std::size_t>(body_)].state;
  return state.position + state.orientation * local_;
}

// With a stretch x and the point's velocity v, the spring asks for x'' = -x / T^2 - 2 v / T, and against gravity. Taken at the
// frame's end (implicit Euler), this is stable for every dt: v' = (v - dt x / T^2) / (1 + dt / T)^2. Here v and v' are the mean
// velocities of the last frame and of this one, half of dt g away from those between them, so that a body at rest has none.
// A stretch is cut to that of the largest force, so that a far target is approached at a bounded speed, too.
double Hand::pull(World& world, double dt, double size) const {
  if (body_ < 0) return 0;
  RigidBody state = world.bodies[static_cast<std::size_t>(body_)].state;
  const double most = most_acceleration(world, state, size), longest = most * kTime * kTime;
  const Vec3 at = point(world), arm = at - state.position, velocity = state.velocity_at(at);
  Vec3 stretch = at - target_;
  if (stretch.norm() > longest) stretch *= longest / stretch.norm();
  const double damped = 1 + dt / kTime;
  const Vec3 half = world.effects.gravity ? Vec3(0.5 * dt * world.gravity_on(state)) : Vec3(Vec3::Zero());
  const Vec3 change =
      (velocity - half - dt / (kTime * kTime) * stretch) / (damped * damped) - half - velocity;
  Vec3 impulse = impulse_for(response(state, arm), change);
  const double limit = dt * most * state.mass;
  if (impulse.norm() > limit) impulse *= limit / impulse.norm();
  const double before = state.kinetic_energy();
  state.velocity += state.inverse_mass * state.free_moves.cwiseProduct(impulse);
  state.spin += state.inverse_inertia_world() * arm.cross(impulse);
  wake_around(world, body_);
  world.set_motion(body_, state, 0);
  world.bodies[static_cast<std::size_t>(body_)].still = 0;
  return state.kinetic_energy() - before;
}

}  // namespace fc::world
