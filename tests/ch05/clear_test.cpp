// The clear version of chapter 5's step, beside the fast one: the laws that both must keep, and where bodies are.
#include "ch05_resting_contact/clear/clear_resting.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <tuple>

#include "ch02_hull_hierarchy/model_distance.hpp"
#include "ch03_impulse_lcp/solver.hpp"
#include "ch05_resting_contact/resting.hpp"
#include "support/worlds.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;
using fc::resting::ClearResting;
using fc::resting::Resting;

// The laws in a frame: the worst violation of each.
struct Laws {
  double newton = 0;  // of each body, as a share of the momenta that took part
  double rise =
      0;  // of energy, beyond what corrections lift and kinematic bodies do, as a share of what there was
  double reported = 0;  // J, of corrections
  double overlap = 0;   // m, at a frame's end
  double across = 0;    // of the margin: the widest gap over which an impulse acts
  double lost = 0;      // s
  double ms = 0;        // of the whole run
  int plans = 0, halved = 0;
  int impacts = 0;  // points at which something met
};

// One of the two versions.
template <class Planner>
struct Watched {
  fc::world::World world;
  double dt;
  Planner planner;
  Laws worst;

  template <class... More>
  explicit Watched(const fc::Scene& scene, const More&... more)
      : world(fc::world::build_world(scene)), dt(scene.step->dt), planner(scene, world, dt, more...) {}

  double energy(double* size = nullptr) const {
    double sum = 0;
    for (const auto& b : world.bodies) {
      if (b.state.is_static()) continue;
      const double kinetic = b.state.kinetic_energy();
      const double potential =
          world.effects.gravity ? -b.state.mass * world.effects.gravity->dot(b.state.position) : 0;
      sum += kinetic + potential;
      if (size) *size += kinetic + std::abs(potential);
    }
    return sum;
  }

  double overlap() const {  // m, the deepest; 0 if there is none
    double depth = 0;
    for (int a = 0; a < static_cast<int>(world.bodies.size()); ++a)
      for (int b = a + 1; b < static_cast<int>(world.bodies.size()); ++b) {
        if (!world.is_dynamic(a) && !world.is_dynamic(b)) continue;
        const fc::ca::PairPose pose(world.bodies[a].state.pose(), world.bodies[b].state.pose());
        const auto gap = fc::hulls::model_distance(world.model_of(a), world.model_of(b), pose, 1e-9, 1e-6);
        depth = std::max(depth, -gap.lower);
      }
    return depth;
  }

  void frame() {
    double size = 0;
    const double before = energy(&size);
    std::vector<Vec3> momentum, impulse(world.bodies.size(), Vec3::Zero());
    std::vector<double> pushed(world.bodies.size(), 0.0);
    for (const auto& b : world.bodies) momentum.push_back(b.state.momentum());
    double work = 0;  // J, of kinematic bodies, which go straight on
    const auto report = planner.step(
        world, {[&](const fc::world::ImpactRecord& r) {
          worst.impacts += r.kind == fc::world::ContactKind::impact;
          const Vec3 j = r.impulse.impulse * r.contact.normal;
          for (const bool of_b : {false, true}) {
            const auto body = static_cast<std::size_t>(of_b ? r.contact.body_b : r.contact.body_a);
            const Vec3 own = of_b ? j : Vec3(-j);
            impulse[body] += own;
            pushed[body] += j.norm();
            if (world.bodies[body].state.is_static()) work -= own.dot(world.bodies[body].state.velocity);
          }
          worst.across = std::max(worst.across, r.contact.gap / planner.envelope());
        }});
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      const fc::RigidBody& s = world.bodies[i].state;
      if (s.is_static()) continue;
      const Vec3 weight =
          world.effects.gravity ? Vec3(s.mass * dt * *world.effects.gravity) : Vec3(Vec3::Zero());
      const double all = momentum[i].norm() + weight.norm() + pushed[i];
      if (all > 0)
        worst.newton =
            std::max(worst.newton, (s.momentum() - momentum[i] - weight - impulse[i]).norm() / all);
    }
    const double rise = energy() - before - work - report.correction_energy;
    if (size > 0) worst.rise = std::max(worst.rise, rise / size);
    worst.reported += report.correction_energy;
    worst.overlap = std::max(worst.overlap, overlap());
    worst.lost += report.step.lost_time;
    worst.ms += 1e-6 * static_cast<double>(report.step.step_ns);
    worst.plans += report.plans;
    if constexpr (std::is_same_v<Planner, ClearResting>) worst.halved += report.halved;
  }
};

struct Both {
  Watched<ClearResting> clear;
  Watched<Resting> fast;
  double apart = 0, turned = 0;  // m, rad: the worst of any body at any frame's end
  double faster = 0;             // m/s: of any body at the last frame's end

  explicit Both(const fc::Scene& scene) : clear(scene), fast(scene) {}
  void run(int frames) {
    for (int f = 0; f < frames; ++f) {
      clear.frame();
      fast.frame();
      faster = 0;
      for (std::size_t i = 0; i < clear.world.bodies.size(); ++i) {
        const fc::RigidBody &c = clear.world.bodies[i].state, &q = fast.world.bodies[i].state;
        apart = std::max(apart, (c.position - q.position).norm());
        faster = std::max(faster, (c.velocity - q.velocity).norm());
        turned = std::max(turned, c.orientation.angularDistance(q.orientation));
      }
    }
  }
};

std::string text(const Laws& w) {
  return fmt::format(
      "newton {:.1e} rise {:.1e} reported {:.1e} J overlap {:.1e} across {:.4f} lost {:.1e} plans {} halved {} {:.0f} ms",
      w.newton, w.rise, w.reported, w.overlap, w.across, w.lost, w.plans, w.halved, w.ms);
}

int from_environment(const char* name, int otherwise) {
  const char* asked = std::getenv(name);
  return asked ? std::atoi(asked) : otherwise;
}

// The laws that are violated; empty if all is well. The energy may rise by the error of second order that a plan makes,
// as every step does (frames are up to 30 ms long here, and turn bodies by up to a tenth of a radian).
std::string broken(const Laws& w) {
  constexpr double kSecondOrder = 5e-4;
  std::string faults;
  if (!(w.overlap <= 1e-12)) faults += fmt::format(" an overlap of {:.2g} m;", w.overlap);
  if (!(w.rise <= kSecondOrder)) faults += fmt::format(" energy rises by {:.2g};", w.rise);
  if (!(w.newton <= 1e-10)) faults += fmt::format(" Newton's law is off by {:.2g};", w.newton);
  if (!(w.across <= 1)) faults += fmt::format(" an impulse across {:.3g} margins;", w.across);
  if (w.lost > 0) faults += fmt::format(" {:.2g} s are lost;", w.lost);
  return faults;
}

struct Random {
  std::mt19937_64 engine;
  double operator()(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  }
  double log(double low, double high) { return std::exp((*this)(std::log(low), std::log(high))); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine); }
  bool chance(double share) { return (*this)(0, 1) < share; }
  std::string vector(int n, double size) {
    std::string text = "[";
    for (int i = 0; i < n; ++i) text += (i ? ", " : "") + fmt::format("{}", (*this)(-size, size));
    return text + "]";
  }
};

// 2 to 9 convex bodies that fall on a floor or into a pit, as in random_scenes_test.cpp.
std::string random_scene(unsigned seed) {
  Random random{std::mt19937_64(seed)};
  const int count = 2 + random.below(8);
  const bool pit = random.chance(0.3), mixed = random.chance(0.3);
  const double dt = random.log(1.0 / 240, 0.03), restitution = random.chance(0.3) ? 0 : random(0, 1);
  const double heaviest = random.chance(0.5) ? 1 : random.log(1, 1e3);
  std::string shapes = "  floor: {box: {size: [40, 40, 1]}}\n  wall: {box: {size: [1, 8, 8]}}\n", bodies;
  for (int i = 0; i < count; ++i) {
    const std::array<std::string, 8> kinds{
        "box: {size: [0.5, 0.4, 0.3]}",
        "box: {size: [0.8, 0.5, 0.05]}",
        "sphere: {radius: 0.3}",
        "capsule: {radius: 0.12, length: 0.5}",
        "hull: {points: [[0.4, 0, 0], [-0.4, 0, 0], [0, 0.3, 0], [0, -0.3, 0], [0, 0, 0.3], [0.1, 0, -0.3]]}",
        "hull: {points: [[0.3, 0.3, 0.3], [-0.3, -0.3, 0.3], [-0.3, 0.3, -0.3], [0.3, -0.3, -0.3]]}",
        "cylinder: {radius: 0.25, length: 0.4}",
        "cone: {radius: 0.25, length: 0.5}"};
    shapes +=
        fmt::format("  s{}: {{{}, mass: {}{}}}\n", i, kinds[static_cast<std::size_t>(random.below(8))],
                    random.log(1, heaviest), mixed ? fmt::format(", restitution: {}", random(0, 1)) : "");
    bodies += fmt::format(
        "  - {{shape: s{}, position: [{}, {}, {}], orientation: {}, velocity: [{}, {}, {}], spin: {}}}\n", i,
        1.1 * (i % 3 - 1), 1.1 * (i / 3 - 1), 0.6 + 0.2 * random(0, 1), random.vector(4, 1),
        random(-0.5, 0.5), random(-0.5, 0.5), random(-2, 0.5), random.vector(3, 3));
  }
  bodies += "  - {shape: floor, static: true, position: [0, 0, -0.5]}\n";
  if (pit)
    for (const double x : {-2.3, 2.3})
      bodies += fmt::format("  - {{shape: wall, static: true, position: [{}, 0, 3.9]}}\n", x);
  return fmt::format(
      "step: {{dt: {}, duration: 1.5}}\nrestitution: {}\nenvelope: {}\nccd: {{tolerance: 1.0e-7}}\n"
      "gravity: [0, 0, -9.81]\nshapes:\n{}bodies:\n{}",
      dt, restitution, random.log(1e-4, 5e-3), shapes, bodies);
}

fc::Scene read_rest_scene(const std::string& text) {
  const auto file = scratch("scenes") / "scene.yaml";
  std::ofstream(file) << text;
  return fc::read_scene({file, {}, {}, 5});
}

std::filesystem::path gallery(const std::string& name) {
  return std::filesystem::path(FC_SOURCE_DIR) / "chapters/ch05_resting_contact/scenes" / (name + ".yaml");
}

// A scene with a floor whose upper side is at 0, frames of 1/60 s and an envelope of 0.5 mm.
std::string on_a_floor(const std::string& shapes, const std::string& bodies, const std::string& more = "") {
  return "step: {dt: 0.016666666666666666, duration: 2}\ngravity: [0, 0, -10]\nenvelope: 5.0e-4\n" + more +
         "shapes:\n  floor: {box: {size: [40, 40, 1]}}\n" + shapes +
         "bodies:\n  - {shape: floor, static: true, position: [0, 0, -0.5]}\n" + bodies;
}

const std::string box = "  box: {box: {size: [1, 1, 1]}, mass: 2}\n",
                  ball = "  ball: {sphere: {radius: 0.5}, mass: 2}\n";

struct Smooth {
  std::string name;
  fc::Scene scene;
  double apart, turned;  // m, rad: allowed
};

// Scenes in which small differences stay small.
std::vector<Smooth> smooth_scenes() {
  const auto text = [](const std::string& t) { return read_rest_scene(t); };
  std::vector<Smooth> list;
  for (const auto& [name, apart] :
       {std::pair("slope", 5e-6), std::pair("stack", 5e-6), std::pair("valley", 0.01),
        std::pair("turned", 5e-6), std::pair("islands", 5e-4), std::pair("one_frame", 5e-4)})
    list.push_back({name, fc::read_scene({gallery(name), {}, {}, 5}), apart, 1e-6});
  // Bodies that hit corners diverge: in half a second they do so only a little.
  list.push_back({"knocked",
                  fc::read_scene({gallery("knocked"), {"step.duration=0.4666666666666667"}, {}, 5}), 5e-3,
                  1e-2});
  list.push_back(
      {"a box that glides and turns",
       text(on_a_floor(box,
                       "  - {shape: box, position: [0, 0, 0.501], velocity: [2, 1, 0], spin: [0, 0, 3]}\n")),
       5e-5, 1e-9});
  list.push_back({"a ball that comes to rest",
                  text(on_a_floor(ball, "  - {shape: ball, position: [0, 0, 0.8], velocity: [1, 0, 0]}\n",
                                  "restitution: 0.5\n")),
                  1e-9, 1e-9});
  list.push_back(
      {"a heavy box on a light one",
       text(on_a_floor(
           box + "  heavy: {box: {size: [1, 1, 1]}, mass: 2000}\n",
           "  - {shape: box, position: [0, 0, 0.5]}\n  - {shape: heavy, position: [0.2, 0.1, 1.5]}\n")),
       1e-5, 1e-5});
  // The first two bounce, the second and the third do not: without the cap it would end with more energy (README).
  list.push_back(
      {"a ball that hits a row, with two restitutions",
       text(on_a_floor(
           ball + "  bouncy: {sphere: {radius: 0.5}, mass: 2, restitution: 1}\n",
           "  - {shape: bouncy, position: [-2, 0, 0.5], velocity: [3, 0, 0]}\n  - {shape: ball, position: [0, 0, 0.5]}\n"
           "  - {shape: ball, position: [1.0002, 0, 0.5]}\n")),
       1e-3, 1e-9});
  list.push_back({"a box that glides against a wall",
                  text(on_a_floor(box + "  wall: {box: {size: [1, 8, 8]}}\n",
                                  "  - {shape: wall, static: true, position: [3, 0, 4.01]}\n"
                                  "  - {shape: box, position: [0, 0, 0.5], velocity: [3.1, 0, 0]}\n")),
                  5e-4, 1e-9});
  list.push_back(
      {"a box that lands on another",
       text(on_a_floor(
           box, "  - {shape: box, position: [0, 0, 0.5]}\n  - {shape: box, position: [0.1, 0, 1.7]}\n")),
       2e-4, 1e-9});
  list.push_back(
      {"a box that falls over an edge",
       text(on_a_floor(
           box + "  table: {box: {size: [2, 2, 2]}}\n",
           "  - {shape: table, static: true, position: [0, 0, 1]}\n  - {shape: box, position: [0.8, 0, 2.5], velocity: [0.4, 0, 0]}\n")),
       5e-4, 5e-4});
  list.push_back(
      {"a box that a paddle pushes",
       text(on_a_floor(box + "  paddle: {box: {size: [0.6, 0.6, 0.6]}}\n",
                       "  - {shape: paddle, kinematic: true, position: [-2, 0.1, 0.5], velocity: [1, 0, 0]}\n"
                       "  - {shape: box, position: [0, 0, 0.5]}\n")),
       5e-4, 1e-9});
  list.push_back(
      {"a plank that tips onto its side",
       text(on_a_floor("  plank: {box: {size: [1, 0.5, 0.2]}, mass: 2}\n",
                       "  - {shape: plank, position: [0, 0, 0.6], orientation: [0.8, 0, 0.6, 0]}\n")),
       1e-2, 1e-2});
  return list;
}

TEST(Clear, GoesWhereTheFastVersionGoes) {
  for (const Smooth& smooth : smooth_scenes()) {
    Both both(smooth.scene);
    both.run(smooth.scene.step->frames);
    EXPECT_LE(both.apart, smooth.apart) << "m, " << smooth.name << "\n  clear " << text(both.clear.worst);
    EXPECT_LE(both.turned, smooth.turned) << "rad, " << smooth.name << "\n  clear " << text(both.clear.worst);
    EXPECT_LE(both.faster, 0.03) << "m/s, " << smooth.name;
    EXPECT_EQ(broken(both.clear.worst), "") << smooth.name;
  }
}

// A resting body does not bounce, although each plan ends with half of gravity's speed, faster than margin / dt; nor
// does it hop when something hits it.
TEST(Clear, WhatLastsIsNoImpact) {
  Both stack(fc::read_scene({gallery("stack"), {"restitution=0.5", "step.duration=0.3"}, {}, 5}));
  stack.run(18);
  EXPECT_EQ(stack.clear.worst.impacts, 0) << "ten boxes that stand";
  EXPECT_EQ(stack.fast.worst.impacts, 0);
  Both hit(read_rest_scene(on_a_floor(box + ball,
                                      "  - {shape: box, position: [0, 0, 0.50025]}\n"
                                      "  - {shape: ball, position: [0, 0, 1.6], velocity: [0, 0, -1]}\n",
                                      "restitution: 0.5\n")));
  hit.run(30);
  EXPECT_LE(hit.apart, 2e-3) << "m, clear and fast: a box that is hit, and stays where it is";
  EXPECT_LE(hit.clear.worst.impacts, 40) << "not one in each frame";
  EXPECT_GT(hit.clear.worst.impacts, 0);
}

// FC_SCENES=1000 runs that many; FC_FIRST=n begins with seed n.
TEST(Clear, KeepsTheLawsInRandomScenes) {
  const int first = from_environment("FC_FIRST", 1), count = from_environment("FC_SCENES", 20);
  for (int seed = first; seed < first + count; ++seed) {
    const fc::Scene scene = read_rest_scene(random_scene(static_cast<unsigned>(seed)));
    Watched<ClearResting> watched(scene);
    std::string error;
    try {
      for (int f = 0; f < scene.step->frames; ++f) watched.frame();
    } catch (const std::exception& e) {
      error = e.what();
    }
    EXPECT_EQ(error, "") << "seed " << seed;
    EXPECT_EQ(broken(watched.worst), "") << "seed " << seed << "\n  " << text(watched.worst);
  }
}

// Piles take long: only as many frames as a test has time for, and chapter 3's fast method.
TEST(Clear, KeepsTheLawsInTheGallery) {
  fc::resting::clear::Pieces pieces;
  pieces.world.lcp.dantzig = [](const fc::MatX& A, const fc::VecX& b, int) { return fc::lcp::solve({A, b}); };
  for (const auto& [name, frames] :
       {std::pair("mixed", 42), std::pair("heap", 40), std::pair("cylinders", 8)}) {
    Watched<ClearResting> watched(fc::read_scene({gallery(name), {}, {}, 5}), pieces);
    for (int f = 0; f < frames; ++f) watched.frame();
    EXPECT_EQ(broken(watched.worst), "") << name << "\n  " << text(watched.worst);
    EXPECT_GT(watched.worst.plans, 20) << name << ": there was something to do";
  }
}

TEST(Clear, RefusesWhatItDoesNotDo) {
  const auto start = [](const fc::Scene& scene) { Watched<ClearResting> watched(scene); };
  EXPECT_THROW(start(fc::read_scene({gallery("bowl"), {}, {}, 5})), fc::InputError) << "meshes";
  const std::string body = "  - {shape: ball, position: [0, 0, 0.8]}\n";
  EXPECT_NO_THROW(start(read_rest_scene(on_a_floor(ball, body))));
  for (const char* more :
       {"drag: {linear: 0.1}\n", "sleep: {after: 0.5, speed: 0.01}\n", "gyroscopic: true\n"})
    EXPECT_THROW(start(read_rest_scene(on_a_floor(ball, body, more))), fc::InputError) << more;
}

// Runs a scene of the gallery for 1.2 s.
fc_test::Outcome run_program(const std::string& scene, const std::string& options,
                             const std::filesystem::path& out) {
  return fc_test::run(FC_BIN_DIR "/ch05_resting_contact " + gallery(scene).string() +
                      " --quiet --poses --set step.duration=1.2 " + options + " --out " + out.string());
}

// With the solution as the learner's file the run is the book's, to the byte.
TEST(ClearProgram, RunsOnTheLearnersPiece) {
  const auto mine = scratch("mine"), clear_out = scratch("clear"), mine_out = scratch("mine_out");
  const std::filesystem::path solution = FC_SOURCE_DIR "/solutions/ch05/ex07_resting_step.cpp";
  std::filesystem::copy_file(FC_BIN_DIR "/../pieces/book/ch05_ex07.so", mine / "ch05_ex07.so");
  std::ofstream(mine / "ch05_ex07.source") << solution.string() << "\n" << fc_test::contents(solution);
  setenv("FC_MINE", mine.c_str(), 1);
  for (const std::string scene : {"stack", "knocked"}) {
    const auto of_clear = run_program(scene, "--clear", clear_out),
               of_mine = run_program(scene, "--mine", mine_out);
    EXPECT_EQ(of_clear.exit_code, 0) << of_clear.err;
    EXPECT_EQ(of_mine.exit_code, 0) << of_mine.err;
    for (const char* file : {"poses.csv", "contacts.csv"})
      EXPECT_TRUE(fc_test::contents(clear_out / file) == fc_test::contents(mine_out / file))
          << scene << ": " << file << " differs";
    EXPECT_GT(fc_test::contents(clear_out / "contacts.csv").size(), 1000u) << scene << ": something pushes";
  }
  unsetenv("FC_MINE");
}

TEST(ClearProgram, RefusesInALine) {
  const auto out = scratch("refused");
  for (const auto& [scene, options, what] :
       {std::tuple("bowl", "--clear", "meshes"),
        std::tuple("stack", "--clear --set sleep.after=1 --set sleep.speed=0.1", "sleep"),
        std::tuple("stack", "--clear --set solver.method=pgs", "solvers other")}) {
    const auto outcome = run_program(scene, options, out);
    EXPECT_EQ(outcome.exit_code, 2) << what;
    EXPECT_NE(outcome.err.find(std::string("the clear version does not handle ") + what), std::string::npos)
        << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
}

}  // namespace
