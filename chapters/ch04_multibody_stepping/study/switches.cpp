// What each effect costs, on one scene: a gas of blocks, or of balls, in a room.
#include <algorithm>
#include <functional>

#include "ch04_multibody_stepping/study/parts.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::world {
namespace {

constexpr double kFrameTime = 1.0 / 60;  // s
constexpr int kFramesCounted = 60, kBodies = 216;

struct Switch {
  const char* name;
  const char* scene;
  std::function<void(Scene&)> in_scene = {};
  std::function<void(Effects&)> in_world = {};
};

const std::vector<Switch> kSwitches = {
    {"none (restitution 1)", "blocks"},
    {"gravity", "blocks", [](Scene& s) { s.gravity = Vec3(0, 0, -9.81); }},
    {"gyroscopic", "blocks", [](Scene& s) { s.gyroscopic = true; }},
    {"drag", "blocks",
     [](Scene& s) {
       s.drag = DragSpec{0.1, 0.1};
     }},
    {"gravity, gyroscopic, drag", "blocks",
     [](Scene& s) {
       s.gravity = Vec3(0, 0, -9.81);
       s.gyroscopic = true;
       s.drag = DragSpec{0.1, 0.1};
     }},
    {"kinematic (one block)", "blocks",
     [](Scene& s) {
       s.bodies.back().is_kinematic = true;
       s.bodies.back().velocity = Vec3::Zero();
     }},
    {"sensor (one block)", "blocks", [](Scene& s) { s.bodies.back().is_sensor = true; }},
    {"sleep (nobody sleeps)", "blocks", [](Scene& s) { s.sleep = SleepSpec{}; }},
    {"swept detection off", "blocks", {}, [](Effects& e) { e.swept = false; }},
    {"none (restitution 1)", "balls"},
    {"rotation (arms of balls)", "balls", {}, [](Effects& e) { e.arms = true; }},
    {"swept detection off", "balls", {}, [](Effects& e) { e.swept = false; }},
    {"nothing moves", "balls",
     [](Scene& s) {
       for (BodySpec& body : s.bodies) body.velocity = Vec3::Zero();
     }},
};

}  // namespace

void study_switches(const StudyOptions& options) {
  TableWriter table(options.out / "switches.csv", {{"scene", ""},
                                                   {"switch", ""},
                                                   {"impacts", ""},
                                                   {"pairs", ""},
                                                   {"queries", ""},
                                                   {"advances", ""},
                                                   {"lcp_rows", ""},
                                                   {"frame_ns", ""},
                                                   {"impact_ns", ""}});
  Progress progress("switches", static_cast<std::int64_t>(kSwitches.size()), options.quiet);
  std::int64_t done = 0;
  for (const Switch& one : kSwitches) {
    Scene scene = gas(std::string(one.scene) == "balls" ? Kind::ball : Kind::block, kBodies, 1);
    if (one.in_scene) one.in_scene(scene);
    std::vector<double> times;
    Run run;
    for (int repeat = 0; repeat < options.repeats; ++repeat) {
      World world = build_world(scene);
      if (one.in_world) one.in_world(world.effects);
      run = run_frames(world, kFrameTime, kFramesCounted);
      times.push_back(run.total_ns());
    }
    std::sort(times.begin(), times.end());
    const double ns = times[times.size() / 2];
    table.row({std::string(one.scene), std::string(one.name), std::int64_t{run.sum.impacts}, run.sum.pairs,
               run.sum.queries, run.sum.advances, std::int64_t{run.sum.lcp_rows}, ns / kFramesCounted,
               ns / std::max(1, run.sum.impacts)});
    progress.update(++done);
  }
  table.close();
}

}  // namespace fc::world
