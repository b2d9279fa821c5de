#include "ch06_friction/study/tower_study.hpp"

#include <cmath>

#include "ch06_friction/contact_sweeps.hpp"

namespace fc::friction {
namespace {

constexpr int kSweeps[] = {1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000};
constexpr int kFirstSweeps = 40, kMostRounds = 20;
constexpr double kFrame = 1.0 / 60, kGravity = 9.81, kMu = 0.5;

// The last body is the floor.
std::vector<RigidBody> tower(int boxes) {
  std::vector<RigidBody> bodies(static_cast<std::size_t>(boxes) + 1);
  MassProperties mass;
  mass.mass = 1;
  mass.inertia = Mat3::Identity() / 6;
  for (int i = 0; i < boxes; ++i) {
    RigidBody& box = bodies[index(i)];
    box.set_mass(mass);
    box.position = Vec3(0, 0, 0.5 + i);
    box.velocity = Vec3(0, 0, -kGravity * kFrame);
  }
  return bodies;
}

void start(ContactSweeps& sweeps, const std::vector<RigidBody>& bodies) {
  sweeps.start(bodies);
  const int boxes = static_cast<int>(bodies.size()) - 1;
  for (int level = 0; level < boxes; ++level)
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5})
        sweeps.add({level == 0 ? boxes : level - 1, level, Vec3(x, y, level), Vec3::UnitZ()}, kMu,
                   Vec3::Zero(), Vec3::Zero());
  sweeps.take_work();
}

}  // namespace

std::vector<TowerRow> measure_tower(int boxes) {
  const std::vector<RigidBody> bodies = tower(boxes);
  const double weight = boxes * kGravity * kFrame;  // N s in the frame
  std::vector<TowerRow> rows;
  ContactSweeps sweeps;
  const auto add = [&](const std::string& method, int steps, double residual) {
    double under = 0;
    for (int corner = 0; corner < 4; ++corner) under += sweeps.impulse(corner).z();
    rows.push_back({boxes, method, steps, sweeps.take_work() / sweeps.contacts(), residual,
                    std::abs(under - weight) / weight});
  };
  for (const int count : kSweeps) {
    start(sweeps, bodies);
    add("sweeps", count, sweeps.run(count, 0));
  }
  for (int rounds = 1; rounds <= kMostRounds; ++rounds) {
    start(sweeps, bodies);
    sweeps.run(kFirstSweeps, 0);
    add("together", rounds, sweeps.run_together(rounds, 0));
  }
  return rows;
}

}  // namespace fc::friction
