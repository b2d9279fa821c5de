#include "ch02_hull_hierarchy/box_steps.hpp"

#include <limits>

namespace fc::hulls {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kUnit = 0x1p-24f;  // the rounding of a float, relative

// The rounding of a gap, relative to its terms: coordinates once, differences and extents in products and
// sums of up to ten terms.
constexpr float kGapRounding = 2 * 12 * kUnit;
constexpr float kPlaceRounding = 2 * 2 * kUnit;
// The rounding of a speed, relative to its terms, and of a step.
constexpr float kSpeedRounding = 32 * kUnit;
constexpr float kStepRounding = 128 * kUnit;
// The rounding of a cross product, relative to the product of the lengths: its terms may cancel.
constexpr float kCross = 8 * kUnit;

Lanes3 spread(const Vec3f& x) {
  return {all_lanes(x[0]), all_lanes(x[1]), all_lanes(x[2])};
}
Lanes norm(const Lanes3& a) {
  return sqrt(dot(a, a));
}

// A box of the other body, the same in every lane.
struct OtherBox {
  Lanes3 center;  // from the opened body's centre of mass
  Lanes3 arm;     // from its own
  Lanes3 axis[3];
  Lanes half[3];
  Lanes radius;
  Lanes sweep;  // m/s, |w x arm|, the most from now on
  Lanes bend;   // m/s^2, |dw/dt| |arm|

  OtherBox(const BoxQuad& quad, int lane, const OpenedView& view) {
    const auto get = [&](const Lanes3& lanes) { return Vec3(lanes.x[lane], lanes.y[lane], lanes.z[lane]); };
    const Vec3 c = view.other_axes * get(quad.center);
    const Vec3f u = (view.other_axes * get(quad.axis[0])).cast<float>(),
                v = (view.other_axes * get(quad.axis[1])).cast<float>();
    center = spread(Vec3f((view.other_place + c).cast<float>()));
    const Vec3f c_float = c.cast<float>();
    arm = spread(c_float);
    axis[0] = spread(u);
    axis[1] = spread(v);
    axis[2] = spread(Vec3f(u.cross(v)));
    half[0] = all_lanes(quad.half.x[lane]);
    half[1] = all_lanes(quad.half.y[lane]);
    half[2] = all_lanes(quad.half.z[lane]);
    radius = all_lanes(quad.radius[lane]);
    const float length = c_float.norm();
    sweep = all_lanes(view.other_spin.cross(c_float).norm() + kCross * view.other_spin.norm() * length +
                      view.other_wander * length);
    bend = all_lanes(view.other_spin_change * length);
  }
};

Lanes clamp(Lanes x, Lanes most) {
  return max(-most, min(most, x));
}

struct FourPairs {
  const BoxQuad& boxes;
  const OtherBox& other;
  const OpenedView& view;
  const StepLimits& limits;
  Lanes3 third;  // axis of the boxes
  Lanes3 spin, other_spin, velocity, acceleration;
  Lanes3 apart;                        // the other's centre less the box's
  Lanes sweep;                         // m/s, |w x c| of the boxes, the most from now on
  Lanes bend;                          // m/s^2, |dw/dt| |c| of both
  Lanes rate_noise, other_rate_noise;  // rad/s
  Lanes rounding;                      // m, of a gap
  Lanes noise;                         // m/s

  FourPairs(const BoxQuad& b, const OtherBox& o, const OpenedView& v, const StepLimits& l)
      : boxes(b),
        other(o),
        view(v),
        limits(l),
        third(cross(b.axis[0], b.axis[1])),
        spin(spread(v.spin)),
        other_spin(spread(v.other_spin)),
        velocity(spread(v.velocity)),
        acceleration(spread(v.acceleration)),
        apart(o.center - b.center),
        sweep(norm(cross(spin, b.center)) + kCross * v.spin.norm() * norm(b.center) +
              v.wander * norm(b.center)),
        bend(v.spin_change * norm(b.center) + o.bend),
        rate_noise(all_lanes(kCross * v.spin.norm() + v.wander)),
        other_rate_noise(all_lanes(kCross * v.other_spin.norm() + v.other_wander)) {
    const auto size = [](const Lanes3& a) { return abs(a.x) + abs(a.y) + abs(a.z); };
    rounding = kGapRounding * (size(apart) + 2 * (b.radius + o.radius)) +
               kPlaceRounding * (size(o.center) + size(b.center) + size(o.arm));
    noise = all_lanes(kSpeedRounding * (v.velocity.lpNorm<1>() + v.spin.lpNorm<1>() * v.reach +
                                        v.other_spin.lpNorm<1>() * v.other_reach));
  }

  // The line between a point of each box and a point of the other box, found by alternating projection.
  Lanes3 projected_normal() const {
    Lanes3 p = other.center, q = p;
    for (int turn = 0; turn < 2; ++turn) {
      const Lanes3 d = p - boxes.center;
      q = boxes.center + clamp(dot(d, boxes.axis[0]), boxes.half.x) * boxes.axis[0] +
          clamp(dot(d, boxes.axis[1]), boxes.half.y) * boxes.axis[1] +
          clamp(dot(d, third), boxes.half.z) * third;
      const Lanes3 e = q - other.center;
      p = other.center + clamp(dot(e, other.axis[0]), other.half[0]) * other.axis[0] +
          clamp(dot(e, other.axis[1]), other.half[1]) * other.axis[1] +
          clamp(dot(e, other.axis[2]), other.half[2]) * other.axis[2];
    }
    const Lanes3 n = p - q;
    const Lanes length = norm(n);
    // Boxes that overlap have no direction between them: any will do, since none gives a gap.
    return select(length > kUnit * (boxes.radius + other.radius), (1 / length) * n,
                  spread(Vec3f(Vec3f::UnitX())));
  }

  BoxSteps along(const Lanes3& n) const {
    BoxSteps steps;
    steps.normal = n;
    steps.gap = dot(n, apart) - abs(dot(n, boxes.axis[0])) * boxes.half.x -
                abs(dot(n, boxes.axis[1])) * boxes.half.y - abs(dot(n, third)) * boxes.half.z -
                abs(dot(n, other.axis[0])) * other.half[0] - abs(dot(n, other.axis[1])) * other.half[1] -
                abs(dot(n, other.axis[2])) * other.half[2] - rounding;
    // ANCHOR: lanes
    const Lanes room = steps.gap - limits.target;
    const Lanes3 turn = cross(n, spin), other_turn = cross(n, other_spin);
    const Lanes rate = norm(turn) + rate_noise, other_rate = norm(other_turn) + other_rate_noise;
    const Lanes straight = dot(n, velocity) + noise;
    const Lanes pull = max(dot(n, acceleration), all_lanes(0));
    const Lanes b = straight + dot(turn, boxes.center) - dot(other_turn, other.arm) + rate * boxes.radius +
                    other_rate * other.radius;
    const Lanes k = 0.5f * (rate * sweep + other_rate * other.sweep + pull + bend);
    const Lanes root = sqrt(b * b + 4 * k * room);
    const Lanes nearby = b < 0 ? (root - b) / (2 * k) : 2 * room / (b + root);
    const Lanes whole =
        straight + pull * limits.remaining + rate * view.reach + other_rate * view.other_reach;
    const Lanes linear = whole > 0 ? room / whole : all_lanes(kInfinity);
    const Lanes time = max(nearby, linear) * (1 - kStepRounding);
    // ANCHOR_END: lanes
    steps.time = steps.gap > limits.keep ? time : all_lanes(0);
    return steps;
  }
};

}  // namespace

PairViews views_at_rest(const ca::PairPose& pose) {
  const Vec3f none = Vec3f::Zero();
  const Mat3 to_a = pose.rotation_a.transpose(), to_b = pose.rotation_b.transpose();
  return {
      {to_a, pose.b_in_a.rotation, pose.b_in_a.position, none, none, none, none, 0, 0},
      {to_b, pose.b_in_a.rotation.transpose(), -(to_b * pose.offset_world), none, none, none, none, 0, 0}};
}

PairViews views_of(const ca::PairPose& pose, const ca::Motion& motion_a, double reach_a,
                   const ca::Motion& motion_b, double reach_b, double t) {
  PairViews views = views_at_rest(pose);
  const Vec3 acceleration = ca::relative_acceleration(motion_a, motion_b, t);
  const Vec3 velocity = ca::relative_velocity(motion_a, motion_b, t);
  const auto set = [&](OpenedView& view, const ca::Motion& own, double reach, const ca::Motion& other,
                       double other_reach, double sign) {
    view.spin = (view.rotation * own.spin_at(t)).cast<float>();
    view.other_spin = (view.rotation * other.spin_at(t)).cast<float>();
    const auto above = [](double x) { return x == 0 ? 0.0f : float_above(x); };
    view.wander = above(own.wander());
    view.other_wander = above(other.wander());
    view.spin_change = above(own.spin_change_bound());
    view.other_spin_change = above(other.spin_change_bound());
    view.velocity = (sign * (view.rotation * velocity)).cast<float>();
    view.acceleration = (sign * (view.rotation * acceleration)).cast<float>();
    view.reach = float_above(reach);
    view.other_reach = float_above(other_reach);
  };
  set(views.a, motion_a, reach_a, motion_b, reach_b, 1);
  set(views.b, motion_b, reach_b, motion_a, reach_a, -1);
  return views;
}

BoxSteps box_steps(const BoxQuad& boxes, const BoxTree& other_tree, NodeId other, const OpenedView& view,
                   const Vec3f& hint, const StepLimits& limits) {
  const OtherBox box(other_tree.quads[other >> 2], other & 3, view);
  const FourPairs pairs(boxes, box, view, limits);
  const BoxSteps first = pairs.along(pairs.projected_normal()), second = pairs.along(spread(hint));
  const LaneMask better =
      (second.time > first.time) | ((second.time == first.time) & (second.gap > first.gap));
  return {better ? second.time : first.time, better ? second.gap : first.gap,
          select(better, second.normal, first.normal)};
}

}  // namespace fc::hulls
