#include "ch01_convex_advancement/show_advance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ch01_convex_advancement/advance.hpp"

namespace fc::ca {
namespace {

using algorithm::Role;
using algorithm::Step;

// A long certificate is shown by its first and its last advances.
constexpr std::size_t kFirst = 14, kLast = 8;
constexpr int kSamples = 32;   // of the curve of the true gap
constexpr double kDisc = 0.8;  // of the smaller body's reach: a plane is drawn as a disc of this radius

// What is drawn of a pair at one time (s, from pair.from on).
struct Picture {
  const ShownPair& pair;
  double t;
  PairPose pose{pair.motion_a, pair.motion_b, t};
  Vec3 origin = pair.motion_a.position_at(t);
  GjkResult nearest = distance(pair.a, pair.b, pose, {});

  // The point where the extreme plane of a body cuts the line through the middle of the witness points.
  Vec3 on_plane(bool of_a, const Vec3& n) const {
    const Mat3& turn = of_a ? pose.rotation_a : pose.rotation_b;
    const Convex& shape = of_a ? pair.a : pair.b;
    const Vec3 out = of_a ? n : Vec3(-n);
    const Vec3 centre = of_a ? origin : Vec3(origin + pose.offset_world);
    const Vec3 farthest = centre + turn * support(shape, turn.transpose() * out).point + shape.radius * out;
    const Vec3 middle = origin + 0.5 * (nearest.point_a + nearest.point_b);
    return middle + n.dot(farthest - middle) * n;
  }

  void add_witnesses(Step& step) const {
    if (nearest.status == GjkResult::Status::overlapping) return;  // then there are none
    const Vec3 a = origin + nearest.point_a, b = origin + nearest.point_b;
    step.draw.push_back(algorithm::point(a, Role::a));
    step.draw.push_back(algorithm::point(b, Role::b));
    step.draw.push_back(algorithm::line({a, b}, Role::now));
  }

  void add_slab(Step& step, const Vec3& n) const {
    const double radius = kDisc * std::min(pair.a.reach + pair.a.radius, pair.b.reach + pair.b.radius);
    step.draw.push_back(algorithm::plane(on_plane(true, n), n, radius, Role::a));
    step.draw.push_back(algorithm::plane(on_plane(false, n), n, radius, Role::b));
  }

  void add_poses(Step& step) const {
    step.poses = {pose_at(pair.number_a, pair.motion_a, t), pose_at(pair.number_b, pair.motion_b, t)};
  }
};

// The true gap over time, and under it what the advances from `first` up to `rows` have proved.
algorithm::Chart gap_chart(const ShownPair& pair, const AdvanceResult& result, std::size_t first,
                           std::size_t rows, double frame_start) {
  const double start = frame_start + pair.from;
  algorithm::Chart chart{"time [s]", "gap [m]", false, {}, {}};
  algorithm::Curve truth{"gap", Role::past, {}}, proved{"proved", Role::good, {}},
      now{"this advance", Role::now, {}};
  for (int k = 0; k <= kSamples; ++k) {
    const double begin = result.certificate[first].t;
    const double t = begin + (result.toc - begin) * k / kSamples;
    const GjkResult g = distance(pair.a, pair.b, PairPose(pair.motion_a, pair.motion_b, t), {});
    truth.points.push_back({start + t, g.upper});
  }
  for (std::size_t k = first; k < rows; ++k) {
    const CertificateRow& row = result.certificate[k];
    algorithm::Curve& curve = k + 1 == rows ? now : proved;
    if (k + 1 == rows && !proved.points.empty()) proved.points.push_back({start + row.t, row.gap_lower});
    curve.points.push_back({start + row.t, row.gap_lower});
    curve.points.push_back({start + row.t + row.advance, row.gap_lower - row.speed_bound * row.advance});
  }
  chart.curves = {truth, proved, now};
  std::erase_if(chart.curves, [](const algorithm::Curve& c) { return c.points.empty(); });
  return chart;
}

Step advance_step(const ShownPair& pair, const AdvanceResult& result, std::size_t k, double frame_start) {
  const CertificateRow& row = result.certificate[k];
  const double at = frame_start + pair.from + row.t;
  Step step;
  // The row's own speed is that of its straight line, which is steeper where the frame ends first.
  const MovingPair bodies(MotionBound::projected, pair.a, pair.motion_a, pair.b, pair.motion_b);
  const double speed =
      std::min(row.speed_bound, bodies.closing_speed_bound(row.normal, row.t, row.t + row.advance));
  const bool to_the_end = row.t + row.advance >= pair.to - pair.from;
  step.text = fmt::format("Advance {}, at {:.7g} s. The slab between the two bodies is {} m wide. ", k + 1,
                          at, algorithm::number(row.gap_lower));
  step.text +=
      speed > 0 ? fmt::format("They close in at no more than {} m/s along its normal, so they cannot meet ",
                              algorithm::number(speed))
                : std::string("Along its normal they do not close in, so they cannot meet ");
  step.text += to_the_end ? "in this frame." : fmt::format("before {:.7g} s.", at + row.advance);
  const Picture picture{pair, row.t};
  picture.add_poses(step);
  picture.add_witnesses(step);
  picture.add_slab(step, row.normal);
  step.chart = gap_chart(pair, result, k > 0 ? k - 1 : 0, k + 1, frame_start);  // ever nearer to the end
  return step;
}

std::string ending(const ShownPair& pair, const AdvanceResult& result, double frame_start) {
  const double at = frame_start + pair.from + result.toc;
  switch (result.status) {
    case Status::contact:
      return fmt::format(
          "At {:.7g} s the two nearest points are {} m apart, less than the {} m at which a pair counts as in "
          "contact. Until then nothing has touched: proved by {}.",
          at, algorithm::number(result.gap_upper), algorithm::number(result.tolerance),
          algorithm::count(result.iterations, "advance"));
    case Status::separated:
      return fmt::format(
          "The frame ends at {:.6g} s with a gap of {} m. The two bodies did not meet: proved by {}.", at,
          algorithm::number(result.gap_upper), algorithm::count(result.iterations, "advance"));
    case Status::touching_at_start:
    case Status::penetrating_at_start:
      return fmt::format(
          "The two bodies are {} m apart already, less than the {} m at which a pair counts as in "
          "contact: there is nothing to advance.",
          algorithm::number(result.gap_upper), algorithm::number(result.tolerance));
    case Status::unresolved:
      break;
  }
  return fmt::format(
      "The search stops at {:.6g} s: the pair is proved clear until then, and no step gets any "
      "farther.",
      at);
}

}  // namespace

algorithm::BodyPose pose_at(int number, const Motion& motion, double t) {
  const Pose pose = motion.pose_at(t);
  return {number, pose.position, Quat(pose.rotation)};
}

AdvanceResult certified_advance(const ShownPair& pair) {
  AdvanceOptions options;
  options.interval = pair.to - pair.from;
  options.tolerance = pair.tolerance;
  options.certificate = true;
  return advance(pair.a, pair.motion_a, pair.b, pair.motion_b, options);
}

std::vector<Step> show_advance(const ShownPair& pair, const AdvanceResult& result, double frame_start) {
  std::vector<Step> steps;
  const Picture start{pair, 0};
  Step first;
  first.text =
      fmt::format("Bodies {} and {} at {:.7g} s. Their nearest points are {} m apart.", pair.number_a,
                  pair.number_b, frame_start + pair.from, algorithm::number(start.nearest.upper));
  start.add_poses(first);
  start.add_witnesses(first);
  steps.push_back(first);
  const std::size_t rows = result.certificate.size();
  for (std::size_t k = 0; k < rows; ++k) {
    if (rows > kFirst + kLast && k >= kFirst && k + kLast < rows) continue;
    steps.push_back(advance_step(pair, result, k, frame_start));
  }
  Step last;
  last.text = ending(pair, result, frame_start);
  if (rows > kFirst + kLast)
    last.text += fmt::format(" {} advances in the middle are not shown.", rows - kFirst - kLast);
  const Picture end{pair, result.toc};
  end.add_poses(last);
  end.add_witnesses(last);
  if (rows > 0) last.chart = gap_chart(pair, result, 0, rows, frame_start);
  steps.push_back(last);
  return steps;
}

}  // namespace fc::ca
