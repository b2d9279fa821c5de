// The same scenes by three methods: from contact to contact (chapter 4), with an envelope, and by Moreau's
// and Jean's time stepping.
#include <cmath>

#include "ch05_resting_contact/study/parts.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::resting {
namespace {

constexpr double kApart = 0.01;  // m
constexpr Method kMethods[] = {Method::events, Method::envelope, Method::moreau};

class Tables {
 public:
  explicit Tables(const std::filesystem::path& out)
      : methods_(out / "methods.csv", {{"scene", ""},
                                       {"method", ""},
                                       {"place_error", "m"},
                                       {"gap", "m"},
                                       {"energy_error", "J"},
                                       {"lost", "s"},
                                       {"rows", ""},
                                       {"queries", ""},
                                       {"second_ns", ""}}),
        histories_(out / "histories.csv",
                   {{"scene", ""}, {"method", ""}, {"t", "s"}, {"gap", "m"}, {"lost", "s"}, {"top", "m"}}),
        weights_(out / "weights.csv", {{"scene", ""}, {"method", ""}, {"force_error", ""}, {"drift", "m"}}) {}
  // For measure_...(): writes one row for each frame. `top`: of the last body.
  Look history(const char* scene, Method method) {
    lost_ = 0;
    return [this, scene, method](const world::World& world, const Frame& frame) {
      lost_ += frame.lost;
      histories_.row({std::string(scene), std::string(name(method)), frame.t, frame.gap, lost_,
                      world.bodies.back().state.position.z()});
    };
  }
  void row(const char* scene, Method method, double place, double energy, const Run& run, double seconds) {
    methods_.row({std::string(scene), std::string(name(method)), place, run.gap, energy, run.lost, run.rows,
                  run.queries, run.second_ns(seconds)});
  }
  void weights(const char* scene, Method method, const StackResult& r) {
    weights_.row({std::string(scene), std::string(name(method)), r.force_error, r.drift});
  }
  void close() {
    methods_.close();
    histories_.close();
    weights_.close();
  }

 private:
  TableWriter methods_, histories_, weights_;
  double lost_ = 0;
};

void study_scenes(const StudyOptions& options) {
  Tables tables(options.out);
  const int n = options.repeats;
  for (const Method m : kMethods) {
    const BallResult r = measure_ball({.scene = ball_scene(), .method = m}, n, tables.history("ball", m));
    tables.row("ball", m, r.height_error, r.energy_error, r.run, 2);
  }
  for (const auto& [scene, apart] : {std::pair("stack", 0.0), std::pair("landing", kApart)})
    for (const Method m : kMethods) {
      const Look history = apart > 0 ? tables.history(scene, m) : [](const world::World&, const Frame&) {};
      const StackResult r = measure_stack({.scene = stack_scene(apart), .method = m}, n, history);
      tables.row(scene, m, r.place_error, r.energy_error, r.run, 3);
      tables.weights(scene, m, r);
    }
  for (const Method m : kMethods) {
    const SlopeResult r = measure_slope({.scene = slope_scene(), .method = m}, n);
    tables.row("slope", m, std::abs(r.way_error), r.energy_error, r.run, 2);
  }
  tables.close();
}

// The ball alone, against the length of the frame; the envelope is as wide as that allows.
void study_ball(const StudyOptions& options) {
  TableWriter table(options.out / "ball.csv", {{"method", ""},
                                               {"dt", "s"},
                                               {"height_error", "m"},
                                               {"rest_error", "s"},
                                               {"lost", "s"},
                                               {"queries", ""},
                                               {"second_ns", ""}});
  for (const Method m : kMethods)
    for (const int rate : {15, 30, 60, 120, 240, 480, 960, 1920}) {
      const double dt = 1.0 / rate;
      Setting setting{.scene = ball_scene(), .dt = dt, .method = m};
      setting.scene.envelope = std::max(1e-6, 0.9 * kGravity * dt * dt * (1 - kRestitution) / 2);
      const BallResult r = measure_ball(setting, options.repeats);
      table.row({std::string(name(m)), dt, r.height_error, std::abs(r.rest_error), r.run.lost, r.run.queries,
                 r.run.second_ns(2)});
    }
  table.close();
}

}  // namespace

void study_methods(const StudyOptions& options) {
  Progress progress("methods", 2, options.quiet);
  study_scenes(options);
  progress.update(1);
  study_ball(options);
  progress.update(2);
}

}  // namespace fc::resting
