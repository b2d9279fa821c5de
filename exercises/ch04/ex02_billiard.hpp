// Exercise 4.2: billiards in an ellipse: the next bounce, not the last one again.
#pragma once

#include <Eigen/Core>

namespace fc::exercises {

using Vec2 = Eigen::Vector2d;

// The wall: x^2/a^2 + y^2/b^2 = 1.
struct Ellipse {
  double a = 1, b = 1;  // m, > 0
};

struct Bounce {
  double time = 0;            // s, from the start
  Vec2 place = Vec2::Zero();  // m, on the wall
};

// When and where a point that flies from `place` (m, inside or on the wall) with `velocity` (m/s, not zero, but perhaps
// tiny) next meets the wall. A place is on the wall if x^2/a^2 + y^2/b^2 is 1 up to rounding (2e-15), or more than 1. A
// start on the wall that leads inwards finds the other end of its chord, however short or long, and never the start
// again. A start that leads outwards, or along the wall within rounding, is at the wall now: time 0. The returned place
// satisfies the wall's equation to about 1e-15, however many bounces came before.
Bounce next_bounce(const Ellipse& wall, const Vec2& place, const Vec2& velocity);

// The velocity (m/s) after an elastic bounce at a place on the wall: the part along the wall is kept, the other part is
// reversed.
Vec2 reflect(const Ellipse& wall, const Vec2& place, const Vec2& velocity);

}  // namespace fc::exercises
