#include "suite.hpp"

#include "ch01_convex_advancement/replay.hpp"

namespace suite {
namespace {

using fc::Vec3;
using fc::ca::AdvanceResult;
using fc::ca::Status;
using truth::Real;

constexpr int kMostLooks = 20'000;

fc::ca::ConvexCore core_of(const truth::Shape& shape) {
  std::vector<Vec3> points;
  for (const truth::V& p : shape.points) points.push_back(p.cast<double>());
  return fc::ca::ConvexCore(std::move(points), {shape.disks.begin(), shape.disks.end()});
}

fc::ca::Motion motion_of(const truth::Flight& flight) {
  fc::RigidBody body;
  body.position = flight.position;
  body.orientation = flight.orientation;
  body.velocity = flight.velocity;
  body.spin = flight.spin;
  return fc::ca::Motion(body, flight.acceleration);
}

fc::ca::ReplayShape replay_shape(const truth::Shape& shape) {
  return {shape.points, shape.disks, {}, {}, shape.radius, shape.reach()};
}

std::string check_start(const Query& q, const AdvanceResult& r) {
  const truth::Gap start = truth::gap(q.a, q.b, 0);
  if (r.toc != 0) return "toc is not 0";
  if (r.gap_lower > static_cast<double>(start.upper)) return "gap_lower above the true gap at the start";
  if (r.status == Status::penetrating_at_start)
    return start.lower > 0 ? "penetrating_at_start, but the bodies are apart" : "";
  return start.lower > r.tolerance ? "touching_at_start, but the bodies are apart" : "";
}

// What does not hold at toc.
std::string check_toc(const Query& q, const AdvanceResult& r) {
  const truth::Gap g = truth::gap(q.a, q.b, r.toc);
  if (r.gap_lower > g.upper) return "gap_lower above the true gap";
  if (r.gap_upper < g.lower - 1e-3 * r.tolerance) return "gap_upper below the true gap";
  if (r.status == Status::contact) {
    if (!(r.toc > 0)) return "contact at toc = 0";
    if (r.gap_upper > r.tolerance) return "contact with gap_upper above the tolerance";
    if (g.lower > r.tolerance) return "false contact";
  }
  if (r.status == Status::separated && r.toc != q.options.interval)
    return "separated, but toc is not the end";
  return "";
}

std::string check_monotonicity(const Query& q, const AdvanceResult& r) {
  const AdvanceResult finer = ask(q, r.tolerance / 8);
  if (finer.status == Status::unresolved || finer.tolerance > r.tolerance / 7) return "";
  if (r.status == Status::separated && finer.status != Status::separated)
    return "separated, but a contact to an eighth of the tolerance";
  return finer.toc < r.toc ? "earlier to an eighth of the tolerance" : "";
}

std::string check_certificate(const Query& q, const AdvanceResult& r) {
  const fc::ca::ReplayShape a = replay_shape(q.a.shape), b = replay_shape(q.b.shape);
  const fc::ca::ReplayQuery query{a, b, motion_of(q.a.flight), motion_of(q.b.flight), q.options.interval};
  const fc::ca::ReplayAnswer answer{r.status, r.toc / q.options.interval, r.gap_lower, r.gap_upper};
  const auto wrong = fc::ca::replay(query, answer, r.certificate);
  return wrong.empty() ? "" : "certificate row " + std::to_string(wrong[0].row) + ": " + wrong[0].what;
}

}  // namespace

AdvanceResult ask(const Query& q, double tolerance) {
  const fc::ca::ConvexCore a = core_of(q.a.shape), b = core_of(q.b.shape);
  fc::ca::AdvanceOptions options = q.options;
  options.tolerance = tolerance;
  return fc::ca::advance(a.convex(static_cast<double>(q.a.shape.radius)), motion_of(q.a.flight),
                         b.convex(static_cast<double>(q.b.shape.radius)), motion_of(q.b.flight), options);
}

AdvanceResult ask(const Query& q) {
  return ask(q, q.options.tolerance);
}

Verdict check(const Query& q, std::uint64_t number) {
  const AdvanceResult r = ask(q);
  Verdict verdict;
  verdict.status = r.status;
  if (r.status == Status::penetrating_at_start || r.status == Status::touching_at_start) {
    verdict.wrong = check_start(q, r);
    return verdict;
  }
  const truth::FirstTime first = truth::first_time(q.a, q.b, r.toc, 0, 0, kMostLooks);
  verdict.looks = first.looks;
  if (r.toc > 0 && first.upper <= r.toc)
    verdict.wrong = r.status == Status::separated ? "missed" : "late";
  else
    verdict.undecided = r.toc > 0 && first.verdict != truth::FirstTime::Verdict::never;
  verdict.uncertified = r.status == Status::contact && !(r.gap_lower > 0);
  if (verdict.wrong.empty()) verdict.wrong = check_toc(q, r);
  if (verdict.wrong.empty() && number % 3 == 0) verdict.wrong = check_monotonicity(q, r);
  if (verdict.wrong.empty() && q.options.certificate) verdict.wrong = check_certificate(q, r);
  return verdict;
}

}  // namespace suite
