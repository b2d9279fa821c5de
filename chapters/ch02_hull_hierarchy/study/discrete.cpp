// Continuous against discrete detection: time, what is missed, how late, how many contacts.
#include <algorithm>
#include <cmath>

#include "ch02_hull_hierarchy/advance.hpp"
#include "ch02_hull_hierarchy/box_steps.hpp"
#include "ch02_hull_hierarchy/features.hpp"
#include "ch02_hull_hierarchy/study/parts.hpp"
#include "common/program.hpp"
#include "common/stopwatch.hpp"
#include "common/table.hpp"

namespace fc::hulls {
namespace {

// What a discrete check finds at one pose: whether any triangles cross (`all`: how many pairs). The same
// boxes and the same four lanes as the continuous search; the first pair of triangles that cross is enough.
struct Overlap {
  std::int64_t pairs = 0;  // of triangles that cross
  std::int64_t node_pairs = 0, leaf_pairs = 0;
};
Overlap overlap(const Model& a, const Model& b, const ca::PairPose& pose, double tiny, bool all) {
  Overlap result;
  const PairViews views = views_at_rest(pose);
  std::vector<std::pair<NodeId, NodeId>> stack{{0, 0}};
  while (!stack.empty()) {
    const auto [na, nb] = stack.back();
    stack.pop_back();
    const int child_a = a.boxes.child(na), child_b = b.boxes.child(nb);
    if (child_a < 0 && child_b < 0) {
      ++result.leaf_pairs;
      const ca::GjkResult g = ca::distance(a.leaf(~child_a), b.leaf(~child_b), pose, {tiny, 0.9, 128});
      result.pairs += g.status == ca::GjkResult::Status::overlapping;
      if (result.pairs > 0 && !all) break;
      continue;
    }
    const bool open_a = child_b < 0 || (child_a > 0 && a.boxes.radius(na) >= b.boxes.radius(nb));
    const int below = open_a ? child_a : child_b;
    const BoxQuad& quad = (open_a ? a : b).boxes.quads[below];
    const BoxSteps steps = box_steps(quad, open_a ? b.boxes : a.boxes, open_a ? nb : na,
                                     open_a ? views.a : views.b, Vec3f::UnitX(), {0, 0, 0});
    for (int lane = 0; lane < 4 && quad.child[lane] != 0; ++lane) {
      ++result.node_pairs;
      if (steps.gap[lane] > 0) continue;
      const NodeId child = 4 * below + lane;
      stack.emplace_back(open_a ? child : na, open_a ? nb : child);
    }
  }
  return result;
}

// The motion from time t on.
ca::Motion from(const ca::Motion& motion, double t) {
  ca::Motion later = motion;
  later.position = motion.position_at(t);
  later.rotation = motion.rotation_at(t);
  return later;
}

struct Contact {
  bool hit = false;
  double toc = 1;                                       // s
  std::int64_t features = 0;                            // at the tolerance ...
  std::int64_t more_features = 0;                       // ... and at a thousandth of the size
  std::int64_t features_ns = 0;                         // to find them all, at the tolerance
  Vec3 normal = Vec3::Zero();                           // of the first one, from A to B
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  // m, in the bodies' axes
};

Contact contact_of(const StudyCase& c, const MotionPair& m) {
  ca::AdvanceOptions asked;
  asked.tolerance = kStudyTolerance * c.size;
  const ca::AdvanceResult r = advance(c.model, m.a, c.model, m.b, asked);
  Contact contact;
  contact.hit = r.status == ca::Status::contact;
  if (!contact.hit) return contact;
  contact.toc = r.toc;
  contact.features = static_cast<std::int64_t>(r.features.size());
  const Stopwatch watch;
  contact_features(c.model, c.model, ca::PairPose(m.a, m.b, r.toc), m.a.position_at(r.toc), r.tolerance);
  contact.features_ns = watch.ns();
  contact.more_features = static_cast<std::int64_t>(
      contact_features(c.model, c.model, ca::PairPose(m.a, m.b, r.toc), m.a.position_at(r.toc), 1e-3 * c.size)
          .size());
  contact.normal = r.features.front().normal;
  contact.point_a =
      m.a.rotation_at(r.toc).transpose() * (r.features.front().point_a - m.a.position_at(r.toc));
  contact.point_b =
      m.b.rotation_at(r.toc).transpose() * (r.features.front().point_b - m.b.position_at(r.toc));
  return contact;
}

// How deep the bodies overlap at the first contact's points at time t, along its normal, m.
double depth(const Contact& contact, const MotionPair& m, double t) {
  const Vec3 a = m.a.position_at(t) + m.a.rotation_at(t) * contact.point_a;
  const Vec3 b = m.b.position_at(t) + m.b.rotation_at(t) * contact.point_b;
  return std::max(0.0, contact.normal.dot(a - b));
}

struct Cost {
  std::int64_t frames = 0, node_pairs = 0, leaf_pairs = 0, ns = 0;
  template <class Check>
  auto of(const Check& check) {
    const Stopwatch watch;
    const auto result = check();
    ns += watch.ns();
    ++frames;
    node_pairs += result.node_pairs;
    if constexpr (requires { result.leaf_pairs; })
      leaf_pairs += result.leaf_pairs;
    else
      leaf_pairs += result.distance_calls;
    return result;
  }
  double per_frame(std::int64_t n) const {
    return static_cast<double>(n) / static_cast<double>(std::max<std::int64_t>(1, frames));
  }
};

}  // namespace

void study_discrete(const StudyCase& c, const StudyOptions& options) {
  TableWriter table(options.out / "discrete.csv", {{"motions", ""},
                                                   {"frames", ""},
                                                   {"hits", ""},
                                                   {"missed", ""},
                                                   {"late", "s"},
                                                   {"late_max", "s"},
                                                   {"depth", "1"},
                                                   {"depth_p95", "1"},
                                                   {"crossing_pairs", ""},
                                                   {"crossing_pairs_p95", ""},
                                                   {"features", ""},
                                                   {"features_p95", ""},
                                                   {"features_1e-3", ""},
                                                   {"features_1e-3_p95", ""},
                                                   {"discrete_frames", ""},
                                                   {"continuous_frames", ""},
                                                   {"discrete_node_pairs", "1/frame"},
                                                   {"discrete_leaf_pairs", "1/frame"},
                                                   {"continuous_node_pairs", "1/frame"},
                                                   {"continuous_leaf_pairs", "1/frame"},
                                                   {"discrete_ns", "1/frame"},
                                                   {"all_pairs_ns", "1/hit"},
                                                   {"features_ns", "1/hit"},
                                                   {"continuous_ns", "1/frame"}});
  const double tiny = 1e-9 * c.size;
  ca::AdvanceOptions asked;
  asked.tolerance = kStudyTolerance * c.size;
  asked.features = asked.end_distance = false;
  SearchMemory memory;
  ca::AdvanceResult result;
  Progress progress("numbers of frames", static_cast<std::int64_t>(9 * c.families.size()), options.quiet);
  std::int64_t done = 0;
  for (const StudyCase::Family& family : c.families) {
    std::vector<Contact> contacts;
    std::vector<double> features, more_features;
    double features_ns = 0;
    for (const MotionPair& m : family.motions) {
      contacts.push_back(contact_of(c, m));
      if (!contacts.back().hit) continue;
      features.push_back(static_cast<double>(contacts.back().features));
      more_features.push_back(static_cast<double>(contacts.back().more_features));
      features_ns += static_cast<double>(contacts.back().features_ns);
    }
    for (int frames = 1; frames <= 256; frames *= 2) {
      Cost discrete, every_pair, continuous;
      std::int64_t missed = 0;
      std::vector<double> late, deep, pairs;
      for (std::size_t i = 0; i < family.motions.size(); ++i) {
        const MotionPair& m = family.motions[i];
        const Contact& contact = contacts[i];
        // Until the triangles cross, one check at each frame's end.
        double noticed = -1;
        for (int f = 1; f <= frames && noticed < 0; ++f) {
          const double t = static_cast<double>(f) / frames;
          const Overlap o =
              discrete.of([&] { return overlap(c.model, c.model, ca::PairPose(m.a, m.b, t), tiny, false); });
          if (o.pairs > 0) noticed = t;
        }
        if (noticed >= 0) {
          const Overlap o = every_pair.of(
              [&] { return overlap(c.model, c.model, ca::PairPose(m.a, m.b, noticed), tiny, true); });
          pairs.push_back(static_cast<double>(o.pairs));
          late.push_back(noticed - contact.toc);
          deep.push_back(depth(contact, m, noticed) / c.size);
        }
        missed += contact.hit && noticed < 0;
        // Until the first contact, one query for each frame.
        asked.interval = 1.0 / frames;
        for (int f = 0; f < frames; ++f) {
          const double t = static_cast<double>(f) / frames;
          const ca::Motion a = from(m.a, t), b = from(m.b, t);
          continuous.of([&]() -> const ca::AdvanceResult& {
            advance(c.model, a, c.model, b, asked, memory, result);
            return result;
          });
          if (result.status != ca::Status::separated) break;
        }
      }
      const auto whole = [](double x) { return static_cast<std::int64_t>(x); };
      table.row({family.name,
                 std::int64_t{frames},
                 static_cast<std::int64_t>(features.size()),
                 missed,
                 quantile(late, 0.5),
                 quantile(late, 1),
                 quantile(deep, 0.5),
                 quantile(deep, 0.95),
                 whole(quantile(pairs, 0.5)),
                 whole(quantile(pairs, 0.95)),
                 whole(quantile(features, 0.5)),
                 whole(quantile(features, 0.95)),
                 whole(quantile(more_features, 0.5)),
                 whole(quantile(more_features, 0.95)),
                 discrete.frames,
                 continuous.frames,
                 discrete.per_frame(discrete.node_pairs),
                 discrete.per_frame(discrete.leaf_pairs),
                 continuous.per_frame(continuous.node_pairs),
                 continuous.per_frame(continuous.leaf_pairs),
                 discrete.per_frame(discrete.ns),
                 every_pair.per_frame(every_pair.ns),
                 features_ns / std::max<double>(1, static_cast<double>(features.size())),
                 continuous.per_frame(continuous.ns)});
      progress.update(++done);
    }
  }
  table.close();
}

}  // namespace fc::hulls
