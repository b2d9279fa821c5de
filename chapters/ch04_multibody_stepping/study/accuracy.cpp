// What accuracy costs: a bouncing ball, event by event and by Moreau's time stepping; and a few tumbling blocks,
// compared with their own most accurate run.
#include <algorithm>
#include <cmath>

#include "ch04_multibody_stepping/study/parts.hpp"
#include "common/program.hpp"
#include "common/stopwatch.hpp"
#include "common/table.hpp"

namespace fc::world {

// ANCHOR: moreau
// Moreau (1988), for a ball on a floor: the positions at half a step decide which bodies are in contact; all velocities
// change at once, by Newton's law where a contact closes in. The time of contact is never computed.
void moreau_step(double dt, double gravity, double restitution, double& height, double& speed) {
  height += 0.5 * dt * speed;
  const double free_speed = speed - gravity * dt;
  const bool contact = height <= 0;
  speed = contact ? std::max(free_speed, -restitution * speed) : free_speed;
  height += 0.5 * dt * speed;
}
// ANCHOR_END: moreau

namespace {

constexpr double kGravity = 9.81, kHeight = 2, kRestitution = 0.8, kEnd = 2.5;  // m/s^2, m, 1, s

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

// Height of the ball's lowest point above the floor at time t, before the bounces pile up.
double exact_height(double t) {
  double fall = std::sqrt(2 * kHeight / kGravity), speed = kGravity * fall;
  if (t < fall) return kHeight - 0.5 * kGravity * t * t;
  t -= fall;
  for (speed *= kRestitution; t > 2 * speed / kGravity; speed *= kRestitution) t -= 2 * speed / kGravity;
  return t * (speed - 0.5 * kGravity * t);
}

Scene bouncing_ball(double tolerance) {
  Scene scene;
  scene.gravity = Vec3(0, 0, -kGravity);
  scene.restitution = kRestitution;
  scene.ccd.tolerance = tolerance;
  ShapeSpec ball, floor;
  ball.name = "ball";
  ball.geometry = SphereSpec{0.5};
  ball.mass = 1;
  floor.name = "floor";
  floor.geometry = BoxSpec{Vec3(4, 4, 1)};
  scene.shapes = {ball, floor};
  BodySpec above, below;
  above.position = Vec3(0, 0, 0.5 + kHeight);
  below.shape = 1;
  below.is_static = true;
  below.position = Vec3(0, 0, -0.5);
  scene.bodies = {above, below};
  return scene;
}

double moreau_height(double dt, std::int64_t& steps) {
  double height = kHeight, speed = 0;
  steps = static_cast<std::int64_t>(std::llround(kEnd / dt));
  for (std::int64_t k = 0; k < steps; ++k) moreau_step(dt, kGravity, kRestitution, height, speed);
  return height;
}

void study_bounces(const StudyOptions& options) {
  TableWriter table(options.out / "bounces.csv", {{"method", ""},
                                                  {"knob", ""},  // tolerance [m] or step [s]
                                                  {"error", "m"},
                                                  {"work", ""},  // queries or steps
                                                  {"median_ns", ""}});
  const double exact = exact_height(kEnd);
  for (double tolerance = 1e-2; tolerance > 5e-12; tolerance /= 10) {
    std::vector<double> times;
    double height = 0;
    std::int64_t queries = 0;
    for (int repeat = 0; repeat < options.repeats; ++repeat) {
      World world = build_world(bouncing_ball(tolerance));
      const Stopwatch watch;
      queries = step(world, kEnd).queries;
      times.push_back(static_cast<double>(watch.ns()));
      height = world.bodies[0].state.position.z() - 0.5;
    }
    table.row({std::string("events"), tolerance, std::abs(height - exact), queries, median(times)});
  }
  for (int power = 5; power <= 22; ++power) {
    const double dt = kEnd / std::ldexp(1.0, power);
    std::vector<double> times;
    double height = 0;
    std::int64_t steps = 0;
    for (int repeat = 0; repeat < options.repeats; ++repeat) {
      const Stopwatch watch;
      height = moreau_height(dt, steps);
      times.push_back(static_cast<double>(watch.ns()));
    }
    table.row({std::string("moreau"), dt, std::abs(height - exact), steps, median(times)});
  }
  table.close();
}

// Eight blocks that tumble and collide.
Scene tumbling(double tolerance) {
  Scene scene = gas(Kind::block, 8, 7);
  scene.ccd.tolerance = tolerance;
  scene.gyroscopic = true;
  return scene;
}

struct Flight {
  std::vector<Vec3> places;
  std::int64_t advances = 0;
  int impacts = 0;
  double ns = 0;
};

Flight fly(const Scene& scene, double seconds, int frames, int repeats) {
  Flight flight;
  std::vector<double> times;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    World world = build_world(scene);
    const Run run = run_frames(world, seconds / frames, frames);
    times.push_back(run.total_ns());
    flight.places.clear();
    for (const Body& body : world.bodies) flight.places.push_back(body.state.position);
    flight.advances = run.sum.advances;
    flight.impacts = run.sum.impacts;
  }
  flight.ns = median(times);
  return flight;
}

double distance(const Flight& a, const Flight& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.places.size(); ++i)
    worst = std::max(worst, (a.places[i] - b.places[i]).norm());
  return worst;
}

// Every impact multiplies an error by some factor (chaos): so the runs compared here are short.
void study_trajectories(const StudyOptions& options) {
  TableWriter table(
      options.out / "trajectories.csv",
      {{"knob", ""}, {"value", ""}, {"impacts", ""}, {"error", "m"}, {"advances", ""}, {"median_ns", ""}});
  constexpr double kSeconds = 0.8, kBest = 1e-11, kUsual = 1e-9;
  const Flight best = fly(tumbling(kBest), kSeconds, 1, options.repeats);
  const auto row = [&](const char* knob, const std::string& value, const Flight& flight) {
    table.row({std::string(knob), value, std::int64_t{flight.impacts}, distance(flight, best),
               flight.advances, flight.ns});
  };
  for (const char* tolerance : {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-7", "1e-8", "1e-9", "1e-10"})
    row("tolerance [m]", tolerance, fly(tumbling(std::stod(tolerance)), kSeconds, 48, options.repeats));
  for (const int frames : {1, 4, 16, 48, 192, 768})
    row("frames", std::to_string(frames), fly(tumbling(kUsual), kSeconds, frames, options.repeats));
  for (const bool gyroscopic : {true, false}) {
    Scene scene = tumbling(kUsual);
    scene.gyroscopic = gyroscopic;
    row("motion", gyroscopic ? "torque-free" : "constant spin", fly(scene, kSeconds, 48, options.repeats));
  }
  for (const char* method : {"dantzig", "lemke", "interior_point", "pgs"}) {
    Scene scene = tumbling(kUsual);
    scene.solver.method = method;
    row("solver", method, fly(scene, kSeconds, 48, options.repeats));
  }
  table.close();
}

}  // namespace

void study_accuracy(const StudyOptions& options) {
  Progress progress("accuracy", 2, options.quiet);
  study_bounces(options);
  progress.update(1);
  study_trajectories(options);
  progress.update(2);
}

}  // namespace fc::world
