// Crowds: rows solved by sweeps against Dantzig's method; energy; heaps in which nothing overlaps.
#include "ch05_resting_contact/crowd.hpp"

#include <gtest/gtest.h>

#include <random>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/delassus.hpp"
#include "support/gallery.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;
using fc::resting::Crowd;
using fc::resting::CrowdOptions;
using Exact = fc::resting::Rows<double>;

struct Pile {
  std::vector<fc::RigidBody> bodies;
  std::vector<fc::lcp::Contact> contacts;
  std::vector<double> allowed, reaches;

  explicit Pile(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return 2.0 * random() / std::mt19937::max() - 1; };
    bodies.resize(12);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i].position = Vec3(uniform(), uniform(), static_cast<double>(i));
      if (i > 0) bodies[i].set_mass(fc::box_mass(Vec3(1, 1, 1), 1 + 0.5 * uniform()));
      bodies[i].velocity = i == 0 ? Vec3(Vec3::Zero()) : Vec3(uniform(), uniform(), uniform() - 1);
      bodies[i].spin = i == 0 ? Vec3(Vec3::Zero()) : Vec3(uniform(), uniform(), uniform());
      reaches.push_back(1);
      for (int k = 0; i > 0 && k < 4; ++k) {
        const int below = static_cast<int>(i) - 1;
        contacts.push_back({below, static_cast<int>(i), bodies[i].position + Vec3(uniform(), uniform(), -0.5),
                            Vec3(0.3 * uniform(), 0.3 * uniform(), 1).normalized(), 1e-4});
        allowed.push_back(0.1 * (1 + uniform()));
      }
    }
  }
  template <class Rows>
  double energy(const Rows& crowd) const {
    double sum = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      fc::RigidBody body = bodies[i];
      body.velocity = crowd.velocity(static_cast<int>(i)).linear;
      body.spin = crowd.velocity(static_cast<int>(i)).angular;
      sum += body.kinetic_energy();
    }
    return sum;
  }
};

// To the residual that was asked for, the velocities are Dantzig's; and so they are from a bad guess.
TEST(Crowd, AgreesWithDantzig) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Pile pile(seed);
    const fc::lcp::ImpactProblem problem = fc::lcp::assemble(pile.bodies, pile.contacts);
    fc::VecX b = problem.b;
    for (std::size_t i = 0; i < pile.allowed.size(); ++i) b[static_cast<Eigen::Index>(i)] += pile.allowed[i];
    const fc::lcp::Lcp rows{problem.A, b};
    fc::lcp::DantzigSolver dantzig;
    fc::lcp::LcpResult exact;
    dantzig.solve(rows, {}, exact);
    ASSERT_EQ(exact.status, fc::lcp::Status::solved) << seed;
    const fc::VecX w = rows.A * exact.z + rows.b;

    const auto agrees = [&](auto crowd, double residual, double tolerance) {
      crowd.begin(pile.bodies, pile.reaches);
      for (std::size_t i = 0; i < pile.contacts.size(); ++i)
        crowd.add(pile.contacts[i], pile.allowed[i], seed % 2 == 0 ? 0.3 * static_cast<double>(i % 5) : 0);
      CrowdOptions options;
      options.most_sweeps = 20'000;
      options.residual = 0.01 * residual;
      int sweeps = 0;
      EXPECT_LE(crowd.solve(options, sweeps), residual) << seed;
      for (int i = 0; i < crowd.rows(); ++i)
        EXPECT_NEAR(crowd.speed(i) + pile.allowed[static_cast<std::size_t>(i)], w[i], tolerance)
            << seed << " row " << i;
    };
    agrees(Exact(), 1e-9, 1e-6);
    agrees(Crowd(), 1e-5, 1e-3);
  }
}

// Stopped after any number of sweeps, from any guess: no kinetic energy is made, but for the rounding of the
// numbers that it is done with.
template <class Rows>
void never_makes_energy(double rounding) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Pile pile(seed);
    Rows crowd;
    crowd.begin(pile.bodies, pile.reaches);
    const double before = pile.energy(crowd);
    std::mt19937 random(seed);
    for (std::size_t i = 0; i < pile.contacts.size(); ++i)
      crowd.add(pile.contacts[i], pile.allowed[i], 5.0 * random() / std::mt19937::max());
    CrowdOptions options;
    options.most_sweeps = 1 + static_cast<int>(seed % 40);
    options.residual = 0;
    int sweeps = 0;
    crowd.solve(options, sweeps);
    EXPECT_LE(pile.energy(crowd), before * (1 + rounding)) << seed;
    for (int i = 0; i < crowd.rows(); ++i) EXPECT_GE(crowd.impulse(i), 0);
  }
}

TEST(Crowd, NeverMakesEnergy) {
  never_makes_energy<Exact>(1e-12);
  never_makes_energy<Crowd>(1e-6);
}

// Impulses act on both bodies with the same numbers, whatever those were found with: momentum stays.
TEST(Crowd, KeepsMomentum) {
  const Pile pile(7);
  Crowd crowd;
  crowd.begin(pile.bodies, pile.reaches);
  for (std::size_t i = 4; i < pile.contacts.size(); ++i)
    crowd.add(pile.contacts[i], 0, 0);  // not the floor's
  int sweeps = 0;
  crowd.solve({}, sweeps);
  Vec3 before = Vec3::Zero(), after = Vec3::Zero(), turn = Vec3::Zero();
  for (std::size_t i = 1; i < pile.bodies.size(); ++i) {
    const fc::RigidBody& body = pile.bodies[i];
    const Crowd::Twist& twist = crowd.velocity(static_cast<int>(i));
    const Vec3 change = body.mass * (twist.linear - body.velocity);
    before += body.mass * body.velocity;
    after += body.mass * twist.linear;
    turn += body.position.cross(change) + body.inertia_world() * (twist.angular - body.spin);
  }
  EXPECT_GT((crowd.velocity(5).linear - pile.bodies[5].velocity).norm(), 0.01);
  EXPECT_LE((after - before).norm(), 1e-13);
  EXPECT_LE(turn.norm(), 1e-13);
}

// Rows that come later are solved from where all others are: the velocities are those of all rows at once.
TEST(Crowd, RowsComeLater) {
  const Pile pile(3);
  Exact crowd, fresh;
  crowd.begin(pile.bodies, pile.reaches);
  fresh.begin(pile.bodies, pile.reaches);
  const auto add = [&](Exact& rows, std::size_t i) { rows.add(pile.contacts[i], pile.allowed[i], 0); };
  CrowdOptions options;
  options.most_sweeps = options.most_passes = 20'000;
  options.residual = options.enough = 1e-12;
  int sweeps = 0;
  for (std::size_t i = 0; i < pile.contacts.size(); ++i) add(fresh, i);
  fresh.solve(options, sweeps);
  for (std::size_t i = 0; i + 6 < pile.contacts.size(); ++i) add(crowd, i);
  crowd.solve(options, sweeps);
  std::vector<int> late;
  for (std::size_t i = pile.contacts.size() - 6; i < pile.contacts.size(); ++i) {
    late.push_back(crowd.rows());
    add(crowd, i);
  }
  crowd.relax(late, options, sweeps);
  for (int i = 0; i < static_cast<int>(pile.bodies.size()); ++i)
    EXPECT_LE((crowd.velocity(i).linear - fresh.velocity(i).linear).norm(), 1e-6) << i;
  EXPECT_FALSE(crowd.take_touched().empty());
}

// Displacements open every gap that lacks something, and velocities do not hear of it.
TEST(Crowd, DisplacesWithoutVelocities) {
  const Pile pile(4);
  Crowd crowd;
  crowd.begin(pile.bodies, pile.reaches);
  for (std::size_t i = 0; i < pile.contacts.size(); ++i) crowd.add(pile.contacts[i], pile.allowed[i], 0);
  std::vector<double> slack(pile.contacts.size(), 1e-3);
  slack[2] = slack[17] = -2e-3;
  CrowdOptions options;
  options.most_passes = 20'000;
  options.enough = 1e-9;
  int sweeps = 0;
  crowd.displace(slack, options, sweeps);
  for (std::size_t i = 0; i < pile.contacts.size(); ++i) {
    std::vector<fc::RigidBody> moved = pile.bodies;
    for (std::size_t k = 0; k < moved.size(); ++k) {
      moved[k].velocity = crowd.displacement(static_cast<int>(k)).linear;
      moved[k].spin = crowd.displacement(static_cast<int>(k)).angular;
    }
    EXPECT_GE(fc::lcp::contact_velocity(moved, pile.contacts[i]) + slack[i], -1e-6) << i;
  }
  for (std::size_t k = 0; k < pile.bodies.size(); ++k)
    EXPECT_EQ(crowd.velocity(static_cast<int>(k)).linear, pile.bodies[k].velocity);
}

// Heaps: nothing overlaps in any frame, says the second opinion; energy only goes down, but for what the
// correction of gaps adds and tells.
TEST(Heap, NothingOverlaps) {
  const std::filesystem::path scenes = FC_SOURCE_DIR "/chapters/ch05_resting_contact/scenes";
  for (const std::string scene : {"heap", "mixed"}) {
    const auto folder = scratch(scene), file = scenes / (scene + ".yaml");
    ASSERT_EQ(
        run(FC_BIN_DIR "/ch05_resting_contact " + file.string() + " --poses --quiet --out " + folder.string())
            .exit_code,
        0)
        << scene;
    if (scene == "heap") expect_no_overlap(file, {}, 5, folder);
    const Table steps = read_table(folder / "steps.csv");
    const auto cell = [&](int row, const char* name) {
      return std::stod(
          steps.cells[static_cast<std::size_t>(row)][static_cast<std::size_t>(steps.column(name))]);
    };
    double risen = 0, lost = 0;
    for (int row = 1; row < steps.rows(); ++row) {
      risen += std::max(0.0, cell(row, "energy") - cell(row - 1, "energy") - cell(row, "correction_energy"));
      lost += cell(row, "lost_time");
      EXPECT_GT(cell(row, "min_gap"), 0) << scene;
    }
    EXPECT_LE(risen, 1e-9 * cell(0, "energy")) << scene << ": J, that no correction tells";
    EXPECT_EQ(lost, 0) << scene << ": s";
  }
}

}  // namespace
