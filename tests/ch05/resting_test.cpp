// Resting contact against what is known of it: weights, slopes, the end of Zeno's bounces.
#include "ch05_resting_contact/resting.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "oracles.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;

const std::string head =
    "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -10]\nenvelope: 5.0e-4\nshapes:\n"
    "  box: {box: {size: [1, 1, 1]}, mass: 2}\n  ball: {sphere: {radius: 0.5}, mass: 2}\n"
    "  light: {box: {size: [1, 1, 1]}, mass: 1}\n  heavy: {box: {size: [1, 1, 1]}, mass: 1.0e6}\n"
    "  floor: {box: {size: [40, 40, 1]}}\nbodies:\n  - {shape: floor, static: true, position: [0, 0, "
    "-0.5]}\n";

// Ten minutes. It is lifted by half the envelope at the start, and from then on nothing moves at all.
TEST(Rest, ABoxStaysForTenMinutes) {
  for (const double dt : {1 / 240.0, 1 / 60.0, 1 / 30.0}) {
    Simulation s(head + "  - {shape: box, position: [0, 0, 0.5]}\n", dt);
    s.run(5);
    const Vec3 settled = s.body(1).position;
    EXPECT_NEAR(settled.z(), 0.50025, 1e-6) << "m: at the rest gap, h / 2";
    s.run(595);
    EXPECT_LE((s.body(1).position - settled).norm(), 1e-9) << "m of drift in ten minutes";
    EXPECT_EQ(s.kinetic(), 0) << "J";
    EXPECT_EQ(s.lost, 0) << "s: nothing is frozen any more";
    EXPECT_NEAR(s.corrected, 2 * 10 * 0.00025, 1e-5) << "J: what the lift took, and it is reported";
  }
}

// Each level carries all that is above it, however the corners share it.
TEST(Rest, StacksCarryTheirWeight) {
  for (const auto& [count, step] :
       {std::pair(10, 1 / 30.0), std::pair(10, 1 / 60.0), std::pair(10, 1 / 120.0), std::pair(50, 1 / 30.0),
        std::pair(50, 1 / 60.0), std::pair(50, 1 / 120.0)}) {
    Simulation s(head + "  - {shape: box, grid: {count: [1, 1, " + std::to_string(count) +
                     "], spacing: [0, 0, 1]}, position: [0, 0, 0.5]}\n",
                 step);
    s.run(4);
    std::vector<double> force(static_cast<std::size_t>(count + 1), 0);
    const double dt = s.dt;
    s.run(dt, {.impact = [&](const fc::world::ImpactRecord& r) {
            force[static_cast<std::size_t>(r.contact.body_a)] += r.impulse.impulse / dt;
          }});
    for (int level = 0; level < count; ++level)
      EXPECT_NEAR(force[static_cast<std::size_t>(level)], 20.0 * (count - level), 1e-6 * 20 * count)
          << "N under level " << level << " of " << count;
    EXPECT_LE(s.kinetic(), 1e-15) << "J";
    EXPECT_EQ(s.lost, 0);
    EXPECT_GT(s.last.smallest_gap, 2e-4) << "m: every gap is about h / 2";
    for (int i = 1; i <= count; ++i) EXPECT_NEAR(s.body(i).position.x(), 0, 1e-9) << "box " << i;
  }
}

// A million to one, both ways up.
TEST(Rest, MassRatiosBothWaysUp) {
  for (const char* order :
       {"  - {shape: light, position: [0, 0, 0.5]}\n  - {shape: heavy, position: [0, 0, 1.5]}\n",
        "  - {shape: heavy, position: [0, 0, 0.5]}\n  - {shape: light, position: [0, 0, 1.5]}\n"}) {
    for (const double step : {1 / 30.0, 1 / 60.0, 1 / 120.0}) {
      Simulation s(head + order, step);
      s.run(5);
      EXPECT_NEAR(s.body(1).position.z(), 0.5 + 0.00025, 2e-5) << order;
      EXPECT_NEAR(s.body(2).position.z(), 1.5 + 0.0005, 4e-5) << order;
      // Ten meganewtons on a kilogram: a normal that leans by 1e-12 pushes it sideways by 1e-5 N, without
      // friction.
      EXPECT_LE(s.body(1).velocity.norm() + s.body(2).velocity.norm(), 2e-3) << order;
      EXPECT_LE(std::abs(s.body(1).velocity.z()) + std::abs(s.body(2).velocity.z()), 1e-8) << order;
      EXPECT_EQ(s.lost, 0);
      EXPECT_LE(s.residual, 1e-10);
    }
  }
}

// Down a smooth slope of 30 degrees: g sin(30) t^2 / 2, whatever the frame is.
TEST(Slide, DownASmoothSlope) {
  for (const double dt : {1 / 30.0, 1 / 60.0, 1 / 120.0}) {
    Simulation s(
        "step: {dt: 0.01, duration: 1}\ngravity: [5, 0, -8.660254037844387]\nenvelope: 5.0e-4\nshapes:\n"
        "  box: {box: {size: [1, 1, 1]}, mass: 2}\n  floor: {box: {size: [400, 40, 1]}}\nbodies:\n"
        "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n  - {shape: box, position: [0, 0, "
        "0.50025]}\n",
        dt);
    s.run(2);
    EXPECT_NEAR(s.body(1).velocity.x(), 10, 1e-9) << "m/s";
    EXPECT_NEAR(s.body(1).position.x(), 0.5 * 5 * 4, 1e-9) << "m: exact where the acceleration is constant";
    EXPECT_NEAR(s.body(1).position.z(), 0.50025, 1e-8) << "m: it neither sinks nor takes off";
    EXPECT_LE(s.body(1).spin.norm(), 1e-9);
    EXPECT_EQ(s.lost, 0);
  }
}

// A ball's bounces end when they do on paper, within a few frames; no time is lost.
TEST(Zeno, ABallComesToRest) {
  for (const double dt : {1 / 60.0, 1 / 120.0, 1 / 240.0}) {
    // An envelope of g dt^2 (1 - e) / 2 takes over when the bounces that are left would end within a frame.
    const std::string envelope = std::to_string(0.9 * 10 * dt * dt * 0.5 / 2);
    Simulation s(
        "step: {dt: 0.01, duration: 1}\nccd: {tolerance: 1.0e-8}\ngravity: [0, 0, -10]\nenvelope: " +
            envelope +
            "\nrestitution: 0.5\nshapes:\n"
            "  ball: {sphere: {radius: 0.5}, mass: 2}\n  floor: {box: {size: [40, 40, 1]}}\nbodies:\n"
            "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n  - {shape: ball, position: [0, 0, "
            "1.5]}\n",
        dt);
    const double fall = std::sqrt(2 * 1 / 10.0), zeno = fall * 1.5 / 0.5;
    double rest = 0;
    for (double t = dt; t < 3; t += dt) {
      s.run(dt);
      if (s.kinetic() > 1e-12) rest = t;
    }
    EXPECT_NEAR(rest, zeno, 2 * dt) << "s: Zeno's time";
    EXPECT_EQ(s.lost, 0) << "s, with frames of " << dt << " s";
    EXPECT_NEAR(s.body(1).position.z(), 0.5 + 0.5 * s.resting.envelope(), 1e-5);
  }
}

// A box that lands flat without bounce lies still at once, and is not frozen.
TEST(Landing, WithoutBounceLosesNoTime) {
  Simulation s(head +
                   "  - {shape: box, position: [0, 0, 1.7]}\n  - {shape: box, position: [3, 0, 0.9], "
                   "orientation: [0.98, 0.1, 0.17, 0]}\n",
               1 / 60.0);
  s.run(3);
  EXPECT_EQ(s.lost, 0);
  EXPECT_NEAR(s.body(1).position.z(), 0.50025, 1e-5);
  EXPECT_LE(s.kinetic(), 1e-12);
  EXPECT_GT(s.smallest_gap, 0);
}

// Two stacks of three: both fall asleep, and cost no row; a ball wakes the stack that it falls on, and no other body;
// then that one sleeps again, with the ball on top. As an island, and as a pile.
TEST(Sleep, WakesWhoeverIsTouched) {
  for (const double most_work : {2e5, 0.0}) {
    Simulation s(
        "sleep: {after: 0.2, speed: 0.01}\n" + head +
            "  - {shape: box, grid: {count: [2, 1, 3], spacing: [5, 1, 1.0001]}, position: [0, 0, 0.5001]}\n"
            "  - {shape: ball, position: [5, 0, 8]}\n",
        1 / 60.0, {.most_work = most_work});
    s.run(0.8);
    EXPECT_EQ(s.last.step.lcp_rows, 0) << most_work;
    for (int body = 1; body <= 6; ++body)
      EXPECT_TRUE(s.world.bodies[body].asleep) << most_work << ": " << body;
    int wakes = 0;
    double force = 0;  // N, on the floor, in the last frame in which anybody was awake
    for (int frame = 0; frame < 90; ++frame) {
      double now = 0;
      s.run(1 / 60.0, {.impact = [&](const fc::world::ImpactRecord& impact) {
              if (impact.contact.body_a == 0) now += impact.impulse.impulse * 60;
            }});
      wakes += s.last.step.wakes;
      if (now > 0) force = now;
      for (const int body : {1, 3, 5}) ASSERT_TRUE(s.world.bodies[body].asleep) << most_work << ": " << body;
    }
    EXPECT_EQ(wakes, 3) << most_work;
    // A pile is solved to a residual of a thousandth.
    EXPECT_NEAR(force, 80, most_work == 0 ? 0.08 : 1e-3) << most_work << ": N, three boxes and the ball";
    for (int body = 1; body <= 7; ++body)
      EXPECT_TRUE(s.world.bodies[body].asleep) << most_work << ": " << body;
    EXPECT_EQ(s.lost, 0) << most_work;
    EXPECT_GT(s.smallest_gap, 0) << most_work;
  }
}

// Chapter 4's scenes with things that fall, in an envelope of the default width: nothing overlaps in any
// frame.
TEST(Program, NothingOverlapsInChapterFoursScenes) {
  const std::filesystem::path scenes = FC_SOURCE_DIR "/chapters/ch04_multibody_stepping/scenes";
  const std::vector<std::string> set = {"envelope=0", "ccd.tolerance=1.0e-7"};
  for (const std::string scene :
       {"tumbling_boxes", "bounce", "rain", "sleepers", "dominoes", "break", "cradle"}) {
    const auto folder = scratch(scene), file = scenes / (scene + ".yaml");
    ASSERT_EQ(run(FC_BIN_DIR "/ch05_resting_contact " + file.string() + " --poses --quiet --set " + set[0] +
                  " --set " + set[1] + " --out " + folder.string())
                  .exit_code,
              0)
        << scene;
    expect_no_overlap(file, set, 5, folder);
    const Table steps = read_table(folder / "steps.csv");
    for (const auto& row : steps.cells)
      EXPECT_EQ(std::stod(row[static_cast<std::size_t>(steps.column("lost_time"))]), 0) << scene;
  }
}

// Runs the stack for a tenth of a second into the folder.
std::string short_stack(const std::filesystem::path& folder) {
  return FC_BIN_DIR
         "/ch05_resting_contact " FC_SOURCE_DIR
         "/chapters/ch05_resting_contact/scenes/stack.yaml --quiet --set step.duration=0.1 --out " +
         folder.string();
}

// The envelope is checked before anything is written.
TEST(Program, ARefusedEnvelopeLeavesTheResultsOfTheRunBefore) {
  const auto folder = scratch("kept");
  const std::string stack = short_stack(folder);
  ASSERT_EQ(run(stack).exit_code, 0);
  const std::string before = fc_test::contents(folder / "steps.csv");
  const auto refused = run(stack + " --set envelope=1e-5");
  EXPECT_EQ(refused.exit_code, 2) << refused.err;
  EXPECT_EQ(fc_test::contents(folder / "steps.csv"), before);
}

// The scene's solver solves resting contacts, too: its residual, or its failure, is reported.
TEST(Program, TheScenesSolverSolvesRestingContacts) {
  const auto folder = scratch("solver");
  const std::string stack = short_stack(folder);
  ASSERT_EQ(run(stack).exit_code, 0);
  const std::string usual = fc_test::contents(folder / "contacts.csv");
  ASSERT_EQ(run(stack + " --set solver.method=lemke").exit_code, 0);
  EXPECT_NE(fc_test::contents(folder / "contacts.csv"), usual);
  const auto failed = run(stack + " --set solver.method=pgs --set solver.limit=2");
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_TRUE(
      failed.err.starts_with("--set solver.limit=2: solver.method pgs stopped after solver.limit = 2 sweeps"))
      << failed.err;
}

// Bodies that meet in the air fall on: nothing supports them. And a wall supports nothing.
TEST(Flight, IsNotCarriedByWhatItTouches) {
  const std::string shapes =
      "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -10]\nenvelope: 5.0e-4\nrestitution: 0.5\nshapes:\n"
      "  ball: {sphere: {radius: 0.5}, mass: 2}\n  wall: {box: {size: [1, 40, 400]}}\nbodies:\n";
  // The upper one is 1 mm above and comes down 10 mm/s faster.
  Simulation air(
      shapes + "  - {shape: ball}\n  - {shape: ball, position: [0, 0, 1.001], velocity: [0, 0, -0.01]}\n",
      0.1);
  air.run(0.5);
  const double centre = 0.5 * (air.body(0).position.z() + air.body(1).position.z());
  EXPECT_NEAR(centre, 0.5005 - 0.005 * 0.5 - 0.5 * 10 * 0.25, 1e-9) << "m: both fall freely";
  Simulation wall(shapes +
                      "  - {shape: ball, velocity: [0.004, 0, 0]}\n  - {shape: wall, static: true, position: "
                      "[1.0011, 0, 0]}\n",
                  0.1);
  wall.run(1);
  EXPECT_NEAR(wall.body(0).position.z(), -5, 1e-9) << "m: beside a wall it falls freely";
  EXPECT_LE(wall.body(0).position.x(), 0.0011) << "m: and does not go into it";
}

// An unsolved problem is not called solved, and nothing has moved.
TEST(IslandSolver, SaysWhenItGivesUp) {
  std::vector<fc::RigidBody> bodies(2);
  bodies[1].position = Vec3(0, 0, 0.5);
  bodies[1].set_mass(fc::box_mass(Vec3(1, 1, 1), 1));
  bodies[1].velocity = Vec3(0, 0, -1);
  // Pressed from both sides by bodies that do not give way: no velocity is right.
  const std::vector<fc::lcp::Contact> contacts = {{0, 1, Vec3::Zero(), Vec3::UnitZ()},
                                                  {0, 1, Vec3(0, 0, 1), -Vec3::UnitZ()}};
  const std::vector<double> approach_limits = {-1, -1};
  std::vector<double> z(2, 0);
  fc::resting::IslandSolver solver;
  EXPECT_FALSE(solver.solve(bodies, contacts, approach_limits, z, {}).solved);
  EXPECT_EQ(bodies[1].velocity, Vec3(0, 0, -1));
}

// contacts.csv without its last column, which says that each of them is an impact.
std::string without_kinds(const std::filesystem::path& file) {
  std::istringstream lines(contents(file));
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t comma = line.rfind(',');
    EXPECT_EQ(line.substr(comma), all.empty() ? ",kind" : ",impact");
    all += line.substr(0, comma) + "\n";
  }
  return all;
}

// A ball that falls bounces, bounces lower, and lies: impacts first, then contacts that last, and no impact
// after them.
TEST(Program, TellsImpactsFromContactsThatLast) {
  const auto folder = scratch("kinds");
  std::ofstream(folder / "scene.yaml")
      << "name: kinds\nstep: {dt: 0.016666666666666666, duration: 3}\ngravity: [0, 0, -9.81]\n"
         "restitution: 0.4\nenvelope: 5.0e-4\nshapes: {ball: {sphere: {radius: 0.5}, mass: 1}, floor: {box: "
         "{size: [4, 4, 1]}}}\nbodies: [{shape: ball, position: [0, 0, 1.5]}, {shape: floor, static: true, "
         "position: [0, 0, -0.5]}]\n";
  const Outcome outcome = run(FC_BIN_DIR "/ch05_resting_contact " + (folder / "scene.yaml").string() +
                              " --out " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Table contacts = read_table(folder / "contacts.csv"), steps = read_table(folder / "steps.csv");
  int impacts = 0, rests = 0, counted = 0;
  for (int row = 0; row < contacts.rows(); ++row) {
    const bool impact = contacts.cells[row][contacts.column("kind")] == "impact";
    ++(impact ? impacts : rests);
    if (!impact) continue;
    EXPECT_EQ(rests, 0) << "it lies since a frame, and met something at " << contacts.at(row, "t");
    EXPECT_GT(contacts.at(row, "v_after"), 0) << "m/s: it did not part";
  }
  for (int row = 0; row < steps.rows(); ++row) counted += static_cast<int>(steps.at(row, "impacts"));
  EXPECT_GT(impacts, 3);
  EXPECT_GT(rests, 60);
  EXPECT_EQ(counted, impacts);
}

// What corrections added is in steps.csv: boxes that touched are lifted, and that is all their energy; none of
// their paths is shortened.
TEST(Program, ReportsWhatCorrectionsAdd) {
  const auto folder = scratch("corrections");
  ASSERT_EQ(run(short_stack(folder) + " --set step.duration=1").exit_code, 0);
  const Table steps = read_table(folder / "steps.csv");
  double added = 0;
  for (int row = 0; row < steps.rows(); ++row) {
    added += steps.at(row, "correction_energy");
    EXPECT_EQ(steps.at(row, "shortened"), 0) << row;
    EXPECT_EQ(steps.at(row, "lost_impulse"), 0) << "N s, row " << row;
  }
  EXPECT_EQ(steps.at(0, "correction_energy"), 0) << "J, before the first frame";
  EXPECT_NEAR(added, steps.at(steps.rows() - 1, "energy") - steps.at(0, "energy"), 1e-6) << "J";
  EXPECT_GT(added, 0.1) << "J";
}

// Without the key everything is chapter 4's, to the byte; with it, chapter 4's scenes lose no time any more.
TEST(Program, WithoutAnEnvelopeIsChapterFour) {
  const auto folder = scratch("both");
  const std::string scenes = FC_SOURCE_DIR "/chapters/ch04_multibody_stepping/scenes/";
  for (const std::string scene : {"tumbling_boxes", "gas", "bounce"}) {
    ASSERT_EQ(run(FC_BIN_DIR "/ch04_multibody_stepping " + scenes + scene + ".yaml --poses --quiet --out " +
                  (folder / "four").string())
                  .exit_code,
              0);
    ASSERT_EQ(run(FC_BIN_DIR "/ch05_resting_contact " + scenes + scene + ".yaml --poses --quiet --out " +
                  (folder / "five").string())
                  .exit_code,
              0);
    EXPECT_EQ(contents(folder / "four" / "poses.csv"), contents(folder / "five" / "poses.csv")) << scene;
    EXPECT_EQ(contents(folder / "four" / "contacts.csv"), without_kinds(folder / "five" / "contacts.csv"))
        << scene;
    EXPECT_EQ(without_times(read_table(folder / "four" / "steps.csv")),
              without_times(read_table(folder / "five" / "steps.csv")));
  }
}

TEST(Program, RefusesAnEnvelopeThatIsTooThin) {
  const auto folder = scratch("thin");
  const Outcome outcome = run(FC_BIN_DIR "/ch05_resting_contact " FC_SOURCE_DIR
                                         "/chapters/ch05_resting_contact/scenes/stack.yaml --set "
                                         "envelope=1e-6 --out " +
                              folder.string());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("less than 100 tolerances"), std::string::npos) << outcome.err;
}

}  // namespace
