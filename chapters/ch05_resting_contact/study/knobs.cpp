// What the width of the envelope and the length of a frame bring, and what they cost.
#include <cmath>

#include "ch05_resting_contact/study/parts.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::resting {
namespace {

Setting with(Scene scene, double h, double dt) {
  scene.envelope = h;
  return {.scene = scene, .dt = dt};
}

TableWriter table_of(const std::filesystem::path& file) {
  return {file,
          {{"envelope", "m"},
           {"dt", "s"},
           {"slope_error", "m"},
           {"slope_drift", "m"},
           {"ball_error", "m"},
           {"rest_error", "s"},
           {"narrow_rest_error", "s"},
           {"force_error", ""},
           {"stack_drift", "m"},
           {"stack_lift", "m"},
           {"landed_force_error", ""},
           {"landed_drift", "m"},
           {"lost", "s"},
           {"heap_shortened", ""},
           {"stack_rows", ""},
           {"stack_queries", ""},
           {"heap_rows", ""},
           {"heap_queries", ""},
           {"slope_ns", ""},
           {"stack_ns", ""},
           {"heap_ns", ""}}};
}

// `narrow`: the envelope that takes over when the ball's remaining bounces would end within a frame.
void row(TableWriter& table, double h, double dt, int repeats) {
  const double narrow = 0.9 * kGravity * dt * dt * (1 - kRestitution) / 2;
  const SlopeResult slope = measure_slope(with(slope_scene(), h, dt), repeats);
  const BallResult ball = measure_ball(with(ball_scene(), h, dt), repeats);
  const BallResult narrow_ball = measure_ball(with(ball_scene(), narrow, dt), 1);
  const StackResult stack = measure_stack(with(stack_scene(0), h, dt), repeats);
  const StackResult landed = measure_stack(with(stack_scene(0.01), h, dt), 1);
  Setting pit = with(heap_scene(3, 4), h, dt);
  pit.seconds = 2;
  const Run heap = run(pit, 1);
  table.row({h,
             dt,
             slope.way_error,
             slope.drift,
             ball.height_error,
             std::abs(ball.rest_error),
             std::abs(narrow_ball.rest_error),
             stack.force_error,
             stack.drift,
             stack.place_error,
             landed.force_error,
             landed.drift,
             slope.run.lost + ball.run.lost + stack.run.lost + landed.run.lost,
             heap.shortened,
             stack.run.rows,
             stack.run.queries,
             heap.rows,
             heap.queries,
             slope.run.second_ns(2),
             stack.run.second_ns(3),
             heap.second_ns(pit.seconds)});
}

}  // namespace

void study_knobs(const StudyOptions& options) {
  constexpr double kWidths[] = {1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2};  // m
  constexpr int kRates[] = {15, 30, 60, 120, 240, 480, 960};                // 1/s
  Progress progress("knobs", std::ssize(kWidths) + std::ssize(kRates), options.quiet);
  std::int64_t done = 0;
  TableWriter envelope = table_of(options.out / "envelope.csv");
  for (const double h : kWidths) {
    row(envelope, h, kFrame, options.repeats);
    progress.update(++done);
  }
  envelope.close();
  TableWriter step = table_of(options.out / "step.csv");
  for (const int rate : kRates) {
    row(step, kEnvelope, 1.0 / rate, options.repeats);
    progress.update(++done);
  }
  step.close();
}

}  // namespace fc::resting
