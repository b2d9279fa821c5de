// Piles: rows solved by sweeps against Dantzig's method; energy; heaps in which nothing overlaps.
#include <gtest/gtest.h>

#include <random>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/delassus.hpp"
#include "ch05_resting_contact/gauss_seidel.hpp"
#include "ch05_resting_contact/pile_list.hpp"
#include "oracles.hpp"
#include "support/gallery.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;
using fc::resting::GaussSeidel;
using fc::resting::Twist;

struct Pile {
  std::vector<fc::RigidBody> bodies;
  std::vector<fc::lcp::Contact> contacts;
  std::vector<double> approach_limits;

  explicit Pile(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return 2.0 * random() / std::mt19937::max() - 1; };
    bodies.resize(12);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i].position = Vec3(uniform(), uniform(), static_cast<double>(i));
      if (i > 0) bodies[i].set_mass(fc::box_mass(Vec3(1, 1, 1), 1 + 0.5 * uniform()));
      bodies[i].velocity = i == 0 ? Vec3(Vec3::Zero()) : Vec3(uniform(), uniform(), uniform() - 1);
      bodies[i].spin = i == 0 ? Vec3(Vec3::Zero()) : Vec3(uniform(), uniform(), uniform());
      for (int k = 0; i > 0 && k < 4; ++k) {
        const int below = static_cast<int>(i) - 1;
        contacts.push_back({below, static_cast<int>(i), bodies[i].position + Vec3(uniform(), uniform(), -0.5),
                            Vec3(0.3 * uniform(), 0.3 * uniform(), 1).normalized(), 1e-4});
        approach_limits.push_back(0.1 * (1 + uniform()));
      }
    }
  }

  // Both problems begin with the bodies' velocities; `less`: m/s, by which the paths may close in less than velocities.
  GaussSeidel solver(double guess = 0, double less = 0) const {
    GaussSeidel result;
    for (const fc::RigidBody& body : bodies)
      result.add_body(body, {body.velocity, body.spin}, {body.velocity, body.spin});
    for (std::size_t i = 0; i < contacts.size(); ++i)
      result.add(contacts[i], approach_limits[i], approach_limits[i] - less,
                 guess * static_cast<double>(i % 5), 0);
    return result;
  }

  fc::VecX exact_speeds(double less) const {  // J v+ + approach_limit - less
    const fc::lcp::ImpactProblem problem = fc::lcp::assemble(bodies, contacts);
    fc::VecX b = problem.b;
    for (std::size_t i = 0; i < approach_limits.size(); ++i)
      b[static_cast<Eigen::Index>(i)] += approach_limits[i] - less;
    const fc::lcp::Lcp rows{problem.A, b};
    fc::lcp::DantzigSolver dantzig;
    fc::lcp::LcpResult exact;
    dantzig.solve(rows, {}, exact);
    EXPECT_EQ(exact.status, fc::lcp::Status::solved);
    return rows.A * exact.z + rows.b;
  }

  std::vector<fc::RigidBody> with(const std::vector<Twist>& twists) const {
    std::vector<fc::RigidBody> moved = bodies;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      moved[i].velocity = twists[i].linear;
      moved[i].spin = twists[i].angular;
    }
    return moved;
  }
};

double energy(const std::vector<fc::RigidBody>& bodies) {
  double sum = 0;
  for (std::size_t i = 1; i < bodies.size(); ++i) sum += bodies[i].kinetic_energy();
  return sum;
}

// After many sweeps both problems are solved as Dantzig's method solves them, also from a bad guess, within single
// precision.
TEST(GaussSeidel, AgreesWithDantzig) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Pile pile(seed);
    GaussSeidel solver = pile.solver(seed % 2 == 0 ? 0.3 : 0, 0.05);
    solver.run(20'000);
    EXPECT_LE(solver.residual(), 1e-5) << seed;
    std::vector<Twist> velocities, paths;
    solver.work_out_velocities(velocities);
    solver.work_out_paths(paths);
    for (const bool is_path : {false, true}) {
      const fc::VecX exact = pile.exact_speeds(is_path ? 0.05 : 0);
      const std::vector<fc::RigidBody> bodies = pile.with(is_path ? paths : velocities);
      for (std::size_t i = 0; i < pile.contacts.size(); ++i)
        EXPECT_NEAR(fc::lcp::contact_velocity(bodies, pile.contacts[i]) + pile.approach_limits[i] -
                        (is_path ? 0.05 : 0),
                    exact[static_cast<Eigen::Index>(i)], 5e-3)
            << seed << " row " << i << (is_path ? " of paths" : " of velocities");
    }
  }
}

// Stopped after any number of sweeps, from any guess: no kinetic energy is made, but for the rounding of single precision.
TEST(GaussSeidel, NeverMakesEnergy) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Pile pile(seed);
    GaussSeidel solver = pile.solver(seed % 4);
    solver.run(1 + static_cast<int>(seed % 20));
    std::vector<Twist> velocities, paths;
    solver.work_out_velocities(velocities);
    solver.work_out_paths(paths);
    EXPECT_LE(energy(pile.with(velocities)), energy(pile.bodies) * (1 + 1e-5)) << seed;
    for (int i = 0; i < solver.rows(); ++i) EXPECT_GE(solver.impulse(i), 0);
  }
}

// Impulses act on both bodies with the same numbers, whatever their precision: momentum is conserved.
TEST(GaussSeidel, KeepsMomentum) {
  Pile pile(7);
  pile.contacts.erase(pile.contacts.begin(), pile.contacts.begin() + 4);  // the floor's
  GaussSeidel solver = pile.solver();
  solver.run(10);
  std::vector<Twist> velocities, paths;
  solver.work_out_velocities(velocities);
  solver.work_out_paths(paths);
  Vec3 before = Vec3::Zero(), after = Vec3::Zero(), turn = Vec3::Zero();
  for (std::size_t i = 1; i < pile.bodies.size(); ++i) {
    const fc::RigidBody& body = pile.bodies[i];
    const Vec3 change = body.mass * (velocities[i].linear - body.velocity);
    before += body.mass * body.velocity;
    after += body.mass * velocities[i].linear;
    turn += body.position.cross(change) + body.inertia_world() * (velocities[i].angular - body.spin);
  }
  EXPECT_GT((velocities[5].linear - pile.bodies[5].velocity).norm(), 0.01);
  EXPECT_LE((after - before).norm(), 1e-13);
  EXPECT_LE(turn.norm(), 1e-13);
}

// A dropped row pushes nothing, and the others are solved without it.
TEST(GaussSeidel, ForgetsWhatIsDropped) {
  const Pile pile(3);
  GaussSeidel all = pile.solver(), dropped = pile.solver();
  dropped.run(50);
  int most = 0;
  for (int i = 0; i < dropped.rows(); ++i)
    if (dropped.impulse(i) > dropped.impulse(most)) most = i;
  ASSERT_GT(dropped.impulse(most), 0);
  dropped.drop(most);
  dropped.run_velocities(20'000);
  EXPECT_EQ(dropped.impulse(most), 0);
  all.drop(most);
  all.run(20'000);
  for (int i = 0; i < all.rows(); ++i) EXPECT_NEAR(all.impulse(i), dropped.impulse(i), 1e-3) << i;
}

// Of a long list rows go in step. Each still has its own number, and what pushes in one pile does not depend on others beside it.
TEST(GaussSeidel, RowsOfALongListKeepTheirNumbers) {
  constexpr int kPiles = 40, kSweeps = 20'000, kAtOnce = 500;  // 440 pairs
  GaussSeidel together;
  std::vector<double> alone;
  for (int p = 0; p < kPiles; ++p) {
    const Pile pile(static_cast<unsigned>(p) + 1);
    GaussSeidel one = pile.solver();
    one.run(kSweeps);
    for (int i = 0; i < one.rows(); ++i) alone.push_back(one.impulse(i));
    const int first = together.bodies();
    for (const fc::RigidBody& body : pile.bodies)
      together.add_body(body, {body.velocity, body.spin}, {body.velocity, body.spin});
    for (std::size_t i = 0; i < pile.contacts.size(); ++i) {
      fc::lcp::Contact contact = pile.contacts[i];
      contact.body_a += first;
      contact.body_b += first;
      together.add(contact, pile.approach_limits[i], pile.approach_limits[i], 0, 0);
    }
    if (p == kPiles / 2) together.run(kAtOnce);  // rows that come later are put behind those that are there
  }
  together.run(kSweeps);
  ASSERT_EQ(together.rows(), static_cast<int>(alone.size()));
  for (int i = 0; i < together.rows(); ++i)
    EXPECT_NEAR(together.impulse(i), alone[static_cast<std::size_t>(i)], 2e-3) << "row " << i;
}

// While a heap falls and bounces each frame has two plans at least; when it has become slow, one for most frames.
TEST(Heap, HasOnePlanAFrameWhenItIsSlow) {
  Simulation sim(fc::read_scene({FC_SOURCE_DIR "/chapters/ch05_resting_contact/scenes/heap.yaml", {}, {}, 5}),
                 1 / 60.0);
  const auto whole_frames = [&](double seconds) {
    int count = 0;
    for (const double end = sim.time() + seconds; sim.time() < end - 1e-9;) {
      sim.step();
      count += sim.last.plans == 1;
      EXPECT_GT(sim.smallest_gap, 0);
    }
    return count;
  };
  sim.run(0.7);
  EXPECT_LE(whole_frames(0.5), 3);
  sim.run(1.8);
  EXPECT_GE(whole_frames(1), 40);
  EXPECT_EQ(sim.lost, 0);
}

// An island that takes too much is a pile for 8 frames, then 16 and so on, up to 256; frames in which nobody tries to follow it do not
// count, one in which it is followed within its budget ends that.
TEST(PileList, WaitsTwiceAsLongEachTime) {
  fc::resting::PileList piles(1);
  fc::resting::Island island;
  island.members.push_back({0, {}, true});
  island.members[0].state.velocity = Vec3(1, 0, 0);
  const auto follow = [&](double work) { piles.add_work(island, work, 10, 0); };
  const auto frames_as_pile = [&] {
    int count = 0;
    for (piles.next_frame(); piles.is_spent(island); piles.next_frame()) ++count;
    return count;
  };
  for (const int wanted : {8, 16, 32, 64, 128, 256, 256}) {
    follow(11);
    EXPECT_TRUE(piles.is_spent(island));
    EXPECT_EQ(frames_as_pile(), wanted);
    for (int frame = 0; frame < 3; ++frame) piles.next_frame();
  }
  follow(9);
  EXPECT_FALSE(piles.is_spent(island));
  piles.next_frame();
  follow(11);
  EXPECT_EQ(frames_as_pile(), 8);
  piles.next_frame();
  island.members[0].state.velocity = Vec3::Zero();
  piles.add_work(island, 11, 10, 1);  // it stands at the frame's end
  EXPECT_FALSE(piles.is_spent(island));
}

// Heaps: nothing overlaps in any frame, by the independent overlap check; energy only goes down, but for what the
// correction of gaps adds and reports.
TEST(Heap, NothingOverlaps) {
  const std::filesystem::path scenes = FC_SOURCE_DIR "/chapters/ch05_resting_contact/scenes";
  for (const std::string scene : {"heap", "mixed"}) {
    const auto folder = scratch(scene), file = scenes / (scene + ".yaml");
#ifdef FC_SANITIZED
    const auto overrides = seconds_of("1.5");
#else
    const auto overrides = seconds_of("3.5");  // the last second in whole frames
#endif
    ASSERT_EQ(run(FC_BIN_DIR "/ch05_resting_contact " + file.string() + options_of(overrides) +
                  " --poses --quiet --out " + folder.string())
                  .exit_code,
              0)
        << scene;
    if (scene == "heap") expect_no_overlap(file, overrides, 5, folder);
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
    EXPECT_LE(risen, 1e-9 * cell(0, "energy")) << scene << ": J, that no correction reports";
    EXPECT_EQ(lost, 0) << scene << ": s";
  }
}

}  // namespace
