#include "suite.hpp"

#include <chrono>

#include "tests/support/test_models.hpp"

namespace suite {
namespace {

using fc::Vec3;
using fc::ca::AdvanceResult;
using fc::ca::FeaturePair;
using fc::ca::Status;
using truth::Real;

fc::ca::Motion motion_of(const truth::Flight& flight) {
  return fc::test::motion(flight.position, flight.orientation, flight.velocity, flight.spin,
                          flight.acceleration);
}

AdvanceResult ask(const Query& q, double tolerance, bool certificate = false) {
  fc::ca::AdvanceOptions options = q.options;
  options.tolerance = tolerance;
  options.certificate = certificate;
  return fc::hulls::advance(q.a->model, motion_of(q.flight_a), q.b->model, motion_of(q.flight_b), options);
}

Query swapped(const Query& q) {
  Query other = q;
  std::swap(other.a, other.b);
  std::swap(other.flight_a, other.flight_b);
  return other;
}

bool says_no_more_than_the_start(const AdvanceResult& r) {
  return r.status == Status::penetrating_at_start || r.status == Status::touching_at_start;
}

// The distance of a point (m, world) from a body's surface.
truth::Gap surface_gap(const truth::MeshBody& body, const truth::MeshShape& point, const Vec3& at, double t) {
  truth::MeshBody other{&point, {}};
  other.flight.position = at;
  return truth::gap(body, other, t);
}

// How well the library can know the distance at t, m.
double rounding(const Query& q, double t) {
  const truth::Flight &a = q.flight_a, &b = q.flight_b;
  const double way = (b.position - a.position).norm() + t * (b.velocity - a.velocity).norm() +
                     t * t * (b.acceleration - a.acceleration).norm();
  const double reaches =
      static_cast<double>(q.a->shape.reach + q.b->shape.reach + q.a->shape.radius + q.b->shape.radius);
  return 8 * std::numeric_limits<double>::epsilon() *
         (way + (1 + t * (a.spin.norm() + b.spin.norm())) * reaches);
}

// And a point of the world.
double rounding(const Query& q, double t, const Vec3& at) {
  double way = at.norm();
  for (const truth::Flight* f : {&q.flight_a, &q.flight_b})
    way += f->position.norm() + t * (f->velocity.norm() + t * f->acceleration.norm());
  return rounding(q, t) + 8 * std::numeric_limits<double>::epsilon() * way;
}

std::string check_features(const Query& q, const AdvanceResult& r) {
  static const truth::MeshShape point({Vec3::Zero()}, {{0, 0, 0}}, 0, false);
  if (r.features.empty()) return "no features";
  std::size_t looked_at = 0;
  for (const FeaturePair& f : r.features) {
    if (!(std::abs(f.normal.norm() - 1) <= 1e-12)) return "a normal that is not unit";
    if (!(std::abs(f.gap) <= r.tolerance)) return "a feature's gap beyond the tolerance";
    const double slack = 1e-2 * r.tolerance + rounding(q, r.toc, f.point_a);
    // The nearest points of two pieces are known to a sixteenth of the tolerance, so they may lie aside.
    const Vec3 way = f.point_b - f.point_a;
    if (!(std::abs(f.normal.dot(way) - f.gap) <= slack) ||
        !((way - f.gap * f.normal).norm() <= 0.4 * r.tolerance + slack))
      return "a feature's points do not lie along its normal from A to B";
    if (++looked_at > 8) continue;  // hundreds in a flat contact
    const truth::Gap on_a = surface_gap(q.body_a(), point, f.point_a, r.toc),
                     on_b = surface_gap(q.body_b(), point, f.point_b, r.toc);
    // Beyond a face's border by this much still counts as over the face.
    const Real border = slack + 2e-9L * (q.a->shape.reach + q.b->shape.reach);
    if (on_a.lower > border || on_a.upper < -border) return "a feature's point off A's surface";
    if (on_b.lower > border || on_b.upper < -border) return "a feature's point off B's surface";
  }
  return "";
}

// Whether, at the start, one of some vertices of a body lies deeper inside the other one than the tolerance.
bool deep_vertex(const truth::MeshBody& inner, const truth::MeshBody& outer, double tolerance) {
  if (!outer.shape->solid) return false;
  const std::size_t step = std::max<std::size_t>(1, inner.shape->vertices.size() / 50);
  for (std::size_t i = 0; i < inner.shape->vertices.size(); i += step) {
    const truth::MeshShape point({inner.shape->vertices[i].cast<double>()}, {{0, 0, 0}}, 0, false);
    const truth::MeshBody vertex{&point, inner.flight};
    if (truth::gap(vertex, outer, 0).lower > 1.01L * tolerance && truth::one_inside_other(vertex, outer, 0))
      return true;
  }
  return false;
}

struct Checker {
  const Query& q;
  Verdict& verdict;

  void wrong(const std::string& what) {
    if (verdict.wrong.empty()) verdict.wrong = what;
  }
  void expect(bool holds, const std::string& what) {
    if (!holds) wrong(what);
  }

  void clear(double from, double to, const std::string& what) {
    if (!(to > from)) return;
    const truth::Clear c = truth::clear_between(q.body_a(), q.body_b(), from, to, 0);
    verdict.looks += c.looks;
    if (c.verdict == truth::Clear::Verdict::hit)
      wrong(what + ": they meet before " + std::to_string(static_cast<double>(c.time)));
    if (c.verdict == truth::Clear::Verdict::undecided) verdict.undecided = true;
  }

  // What an answer that is about all of [0, toc] says of toc.
  void toc(const AdvanceResult& r, const std::string& who) {
    const truth::Gap g = truth::gap(q.body_a(), q.body_b(), r.toc);
    expect(r.toc >= 0 && r.toc <= q.options.interval, who + "toc outside of the interval");
    expect(g.upper > 0, who + "late: overlap at toc");
    expect(r.gap_lower <= g.upper, who + "gap_lower above the true gap");
    expect(r.gap_upper >= g.lower - 1e-3 * r.tolerance - rounding(q, r.toc),
           who + "gap_upper below the true gap");
    if (r.status == Status::contact) {
      expect(r.toc > 0, who + "contact at toc = 0");
      expect(r.gap_upper <= r.tolerance, who + "contact with gap_upper above the tolerance");
      expect(g.lower <= r.tolerance, who + "false contact");
      expect(r.gap_lower > 0, who + "contact whose gap_lower is not > 0");
    }
    if (r.status == Status::separated)
      expect(r.toc == q.options.interval, who + "separated, but toc is not the end");
  }

  void start(const AdvanceResult& r) {
    const truth::Gap g = truth::gap(q.body_a(), q.body_b(), 0);
    const bool inside = truth::one_inside_other(q.body_a(), q.body_b(), 0);
    if (says_no_more_than_the_start(r)) {
      expect(r.toc == 0, "the start, but toc is not 0");
      expect(r.gap_lower <= g.upper, "gap_lower above the true gap at the start");
    }
    if (r.status == Status::penetrating_at_start) {
      expect(g.lower <= 0 || inside, "penetrating_at_start, but the bodies are apart");
      expect(r.gap_lower <= 0, "penetrating_at_start, but gap_lower > 0");
    } else if (r.status == Status::touching_at_start) {
      expect(g.lower <= r.tolerance, "touching_at_start, but the surfaces are apart");
      expect(!(inside && g.lower > r.tolerance), "touching_at_start, but one is inside the other");
      expect(r.gap_upper >= g.lower - 1e-3 * r.tolerance - rounding(q, r.toc),
             "gap_upper below the true gap at the start");
      expect(truth::depth(q.body_a(), q.body_b(), 0) <= 1.01L * r.tolerance,
             "touching_at_start, but two triangles overlap by more than the tolerance");
      expect(!deep_vertex(q.body_a(), q.body_b(), r.tolerance) &&
                 !deep_vertex(q.body_b(), q.body_a(), r.tolerance),
             "touching_at_start, but a vertex is deeper inside than the tolerance");
    } else {
      expect(g.upper > 0, "the bodies overlap at the start");
      expect(!inside, "one is inside the other at the start");
    }
  }

  void again(const AdvanceResult& r) {
    const AdvanceResult s = ask(q, q.options.tolerance, true);
    bool same = r.status == s.status && r.toc == s.toc && r.gap_lower == s.gap_lower &&
                r.gap_upper == s.gap_upper && r.tolerance == s.tolerance && r.iterations == s.iterations &&
                r.node_pairs == s.node_pairs && r.features.size() == s.features.size();
    for (std::size_t i = 0; same && i < r.features.size(); ++i)
      same = r.features[i].point_a == s.features[i].point_a &&
             r.features[i].point_b == s.features[i].point_b && r.features[i].normal == s.features[i].normal &&
             r.features[i].id_a == s.features[i].id_a && r.features[i].id_b == s.features[i].id_b;
    expect(same, "asked again, another answer");
  }

  void finer(const AdvanceResult& r) {
    const AdvanceResult f = ask(q, r.tolerance / 8);
    if (f.status == Status::unresolved || f.tolerance > r.tolerance / 7) return;
    expect(!says_no_more_than_the_start(f), "finer: at the start now");
    expect(r.status != Status::separated || f.status == Status::separated,
           "separated, but a contact to an eighth of the tolerance");
    expect(f.toc >= r.toc, "earlier to an eighth of the tolerance");
    toc(f, "finer: ");
    clear(r.toc, f.toc, "finer");
  }

  void other_way_round(const AdvanceResult& r) {
    const Query other = swapped(q);
    const AdvanceResult s = ask(other, q.options.tolerance);
    expect(says_no_more_than_the_start(r) == says_no_more_than_the_start(s), "swapped: another start");
    if (says_no_more_than_the_start(r) || says_no_more_than_the_start(s)) return;
    toc(s, "swapped: ");
    clear(r.toc, s.toc, "swapped");
    if (s.status == Status::contact)
      if (const std::string what = check_features(other, s); !what.empty()) wrong("swapped: " + what);
  }
};

}  // namespace

Prepared prepare(const fc::TriangleMesh& mesh, bool solid, std::string what) {
  return {truth::MeshShape(mesh.vertices, mesh.triangles, 0, solid), fc::test::model_of(mesh, solid),
          std::move(what)};
}

Verdict check(const Query& q) {
  const auto seconds = [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
  const double begin = seconds();
  const AdvanceResult r = ask(q, q.options.tolerance);
  const double answered = seconds();
  Verdict verdict;
  verdict.status = r.status;
  verdict.limited = r.status == Status::unresolved && q.limited;
  Checker checker{q, verdict};
  checker.start(r);
  checker.expect(r.status != Status::unresolved || q.limited,
                 "unresolved, though there was no limit to speak of");
  if (!says_no_more_than_the_start(r)) {
    checker.toc(r, "");
    checker.clear(0, r.toc, r.status == Status::separated ? "missed" : "late");
    if (r.status != Status::unresolved) checker.finer(r);
  }
  if (r.status == Status::contact)
    if (const std::string what = check_features(q, r); !what.empty()) checker.wrong(what);
  checker.again(r);
  checker.other_way_round(r);
  verdict.asked = answered - begin;
  verdict.checked = seconds() - answered;
  return verdict;
}

}  // namespace suite
