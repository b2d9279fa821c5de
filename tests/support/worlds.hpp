// Worlds from a scene's text, and engine states for the independent overlap check.
#pragma once

#include <gtest/gtest.h>

#include "ch04_multibody_stepping/world.hpp"
#include "support/replay.hpp"
#include "support/run_files.hpp"

namespace fc_test {

inline fc::Scene read_scene_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const auto file = scratch("scenes") / "scene.yaml";
  std::ofstream(file) << text;
  return fc::read_scene({file, overrides, {}, 4});
}

inline fc::world::World make_world(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return fc::world::build_world(read_scene_text(text, overrides));
}

inline independent::Vec vec(const fc::Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

// The states of all bodies at a time in the frame.
inline std::vector<independent::State> states_of(const fc::world::World& world, double time) {
  std::vector<independent::State> states;
  for (int i = 0; i < static_cast<int>(world.bodies.size()); ++i) {
    const fc::RigidBody body = world.state_at(i, time);
    const fc::Quat& q = body.orientation;
    const bool moves = !body.is_static();
    states.push_back(
        {vec(fc::frame_position(world.shapes[world.bodies[i].shape], body)),
         {q.w(), q.x(), q.y(), q.z()},
         vec(body.velocity),
         vec(body.spin),
         moves ? vec(world.effects.gravity.value_or(fc::Vec3(fc::Vec3::Zero()))) : independent::Vec{}});
  }
  return states;
}

// What one instant changed, by the independent overlap check's own sums.
struct Jump {
  double time = 0;  // s, in the run
  independent::Totals before, after;
  double energy_law = 0;  // J, 1/2 sum (1 - epsilon) j v-, from the contacts' rows
  int points = 0,
      rows = 0;  // with an impulse: points, and rows, which count a point again for each further solve
};

struct Film {
  independent::Watch watch;
  std::vector<Jump> jumps;
  std::vector<fc::world::StepReport> reports;
  double moved_by_impacts =
      0;  // m, the largest distance between a body just before and just after an instant
};

// Runs the world for this many frames; follows every body by own motion from one instant to the next, and looks for
// overlaps at `samples` times in each piece. A frame in which a body was frozen is examined only at its ends.
inline Film film(fc::world::World& world, const std::vector<independent::Solid>& solids, double dt,
                 int frames, int samples, independent::How how) {
  Film film;
  for (int frame = 0; frame < frames; ++frame) {
    const double start = frame * dt;
    std::vector<independent::Segment> segments{{start, start + dt, states_of(world, 0)}};
    std::vector<Jump> jumps;
    double law = 0, moved_by_impacts = 0;
    int rows = 0, points = 0;
    const auto on_impact = [&](const fc::world::ImpactRecord& record) {
      law += 0.5 * (1 - record.contact.restitution) * record.impulse.impulse * record.impulse.v_before;
      ++rows;
      points += record.impulse.solve == 0;
    };
    const auto on_instant = [&](const fc::world::World& now, double time) {
      segments.back().end = start + time;
      const auto before =
          independent::moved(solids, segments.back().states, segments.back().end - segments.back().begin);
      const auto after = states_of(now, time);
      for (std::size_t i = 0; i < solids.size(); ++i)
        moved_by_impacts = std::max(moved_by_impacts, independent::distance(solids[i], before[i], after[i]));
      if (rows > 0)
        jumps.push_back({start + time, totals(solids, before), totals(solids, after), law, points, rows});
      law = 0;
      rows = points = 0;
      segments.push_back({start + time, start + dt, after});
    };
    film.reports.push_back(fc::world::step(world, dt, {on_impact, on_instant, {}}));
    const auto end = states_of(world, 0);
    if (film.reports.back().lost_time > 0) {
      independent::watch(solids, {start + dt, start + dt, end}, 0, how, film.watch);
      continue;
    }
    for (const independent::Segment& segment : segments)
      independent::watch(solids, segment, samples, how, film.watch);
    const auto last =
        independent::moved(solids, segments.back().states, segments.back().end - segments.back().begin);
    for (std::size_t i = 0; i < solids.size(); ++i)
      moved_by_impacts = std::max(moved_by_impacts, independent::distance(solids[i], last[i], end[i]));
    film.moved_by_impacts = std::max(film.moved_by_impacts, moved_by_impacts);
    film.jumps.insert(film.jumps.end(), jumps.begin(), jumps.end());
  }
  return film;
}

// Energy never rises at an impact and follows the law; momenta change by at most 1e-10 of their parts' sizes.
inline void expect_laws(const Film& film, bool no_static_bodies = true) {
  for (const Jump& jump : film.jumps) {
    const double scale = jump.before.kinetic + jump.after.kinetic;
    EXPECT_LE(jump.after.kinetic, jump.before.kinetic + 1e-13 * scale) << "at t = " << jump.time << " s";
    EXPECT_NEAR(jump.after.kinetic - jump.before.kinetic, jump.energy_law, 1e-11 * scale)
        << "at t = " << jump.time << " s";
    if (!no_static_bodies) continue;
    EXPECT_LE(norm(jump.after.linear - jump.before.linear), 1e-10 * jump.before.linear_size) << jump.time;
    EXPECT_LE(norm(jump.after.angular - jump.before.angular), 1e-10 * jump.before.angular_size) << jump.time;
  }
  EXPECT_LE(film.moved_by_impacts, 1e-11);
  for (const fc::world::StepReport& report : film.reports) {
    EXPECT_LE(report.lcp_residual, 1e-10);
    EXPECT_EQ(report.max_penetration, 0);
    EXPECT_GT(report.min_gap, 0);
  }
}

}  // namespace fc_test
