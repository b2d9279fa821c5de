// Exercise 6.2: where a block stops, with a box, a pyramid and a cone.
#pragma once

#include <Eigen/Core>

namespace fc::exercises {

using Vec2 = Eigen::Vector2d;

// A block slides on a level floor and does not turn. v: m/s, its velocity, in the floor's axes; mu > 0; g: m/s^2, > 0.
// All functions return how far it slides until it stands, m: a vector from its present place. 0 if it stands already.
// Of all friction forces that are allowed, the one acts that takes most power: the largest -f·v.

// Coulomb: |f| <= mu m g.
Vec2 stop_by_cone(const Vec2& v, double mu, double g);

// |f_1| <= mu m g and |f_2| <= mu m g: a limit for each tangent, as in boxed solvers.
Vec2 stop_by_box(const Vec2& v, double mu, double g);

// f inside a regular polygon with `corners` corners, at the angles 2 pi k / corners from the first axis, mu m g from
// its centre: a pyramid in place of the cone. corners: even, >= 4; else std::invalid_argument is thrown.
Vec2 stop_by_pyramid(const Vec2& v, double mu, double g, int corners);

// How wrong a stop point is.
struct Error {
  double angle = 0;   // rad, in (-pi, pi]: from v to the displacement, counter-clockwise; 0 is exact
  double length = 1;  // the length of the displacement over the exact one
};
// v: not 0.
Error error_of(const Vec2& way, const Vec2& v, double mu, double g);

// The least number of corners (even, >= 4) for which friction deviates by at most `angle` (rad, in (0, pi/2]) from the
// true direction, at any instant of any slide.
int corners_for(double angle);

}  // namespace fc::exercises
