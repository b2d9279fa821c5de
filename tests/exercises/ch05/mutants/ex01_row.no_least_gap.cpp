// Caught by: Ex01Row.HowFarAGapIsDisplaced
// A fifth of what lacks, however near it is.
#include "ex01_row.hpp"

#include <algorithm>

namespace fc::exercises {

bool is_impact(const Envelope& envelope, const Ball& ball, bool lasts) {
  return !lasts && ball.gap <= 0.5 * envelope.width && -ball.velocity > envelope.width / envelope.dt;
}

double approach_limit(const Envelope& envelope, double gap) {
  return std::max(0.0, gap - 0.5 * envelope.width) / envelope.dt;
}

double displacement(const Envelope& envelope, double gap) {
  const double rest_gap = 0.5 * envelope.width;
  if (gap >= rest_gap) return 0;
  return envelope.share * (rest_gap - gap);
}

Frame rest(const Envelope& envelope, double gravity, Ball& ball) {
  const double half = 0.5 * envelope.dt * gravity, falling = ball.velocity - half;
  Frame frame;
  ball.velocity = std::max(falling, -approach_limit(envelope, ball.gap));
  frame.push = ball.mass * (ball.velocity - falling);
  ball.gap += envelope.dt * ball.velocity;

  frame.displaced = displacement(envelope, ball.gap);  // of the gap as it would be at the plan's end
  ball.gap += frame.displaced;
  frame.energy = ball.mass * gravity * frame.displaced;

  ball.velocity -= half;
  const bool lasts = frame.push > 0, fast = -ball.velocity > envelope.width / envelope.dt;
  const bool is_there = ball.gap <= (fast && !lasts ? 0.5 : 1) * envelope.width;
  if (!is_there || ball.velocity >= 0) return frame;
  const double after = is_impact(envelope, ball, lasts) ? -ball.restitution * ball.velocity : 0;
  frame.stop = ball.mass * (after - ball.velocity);
  ball.velocity = after;
  return frame;
}

}  // namespace fc::exercises
