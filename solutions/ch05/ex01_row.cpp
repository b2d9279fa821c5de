#include "ex01_row.hpp"

#include <algorithm>

namespace fc::exercises {

bool is_impact(const Envelope& envelope, const Ball& ball) {
  const double closing = -ball.velocity, way = std::max(envelope.width, ball.gap - 0.5 * envelope.width);
  return ball.restitution > 0 && closing > way / envelope.dt;
}

double allowed(const Envelope& envelope, double gap) {
  return std::max(0.0, gap - 0.5 * envelope.width) / envelope.dt;
}

double displacement(const Envelope& envelope, double gap) {
  const double middle = 0.5 * envelope.width;
  if (gap >= middle) return 0;
  return std::max(envelope.share * (middle - gap), envelope.least * envelope.width - gap);
}

Frame rest(const Envelope& envelope, double gravity, Ball& ball) {
  const double falling = ball.velocity - envelope.dt * gravity;
  Frame frame;
  ball.velocity = std::max(falling, -allowed(envelope, ball.gap));
  frame.impulse = ball.mass * (ball.velocity - falling);
  ball.gap += envelope.dt * ball.velocity;

  frame.displaced = displacement(envelope, ball.gap);  // of the gap as it would be at the frame's end
  ball.gap += frame.displaced;
  frame.energy = ball.mass * gravity * frame.displaced;
  return frame;
}

}  // namespace fc::exercises
