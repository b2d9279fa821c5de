#include "ch05_resting_contact/show_paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "ch04_multibody_stepping/sensors.hpp"
#include "ch05_resting_contact/path.hpp"
#include "ch05_resting_contact/plan.hpp"

namespace fc::resting {
namespace {

using algorithm::Role;
using algorithm::Step;

constexpr std::size_t kMostPaths = 40, kMostProofs = 16;  // that are drawn
constexpr std::int64_t kMostNodes = 50'000;               // of one proof by advancement

// Pairs of bodies whose boxes, each about all that the body reaches in `length` seconds and `around` it (m), overlap.
template <class Visit>
void each_near_pair(const world::World& world, const std::vector<world::Bounds>& boxes, const Visit& visit) {
  world::BoundsTree tree;
  tree.build(boxes);
  std::vector<std::pair<int, int>> pairs;
  tree.overlapping_pairs([&](int a, int b) {
    if ((world.is_dynamic(a) || world.is_dynamic(b)) && !world::is_sensor_pair(world, a, b))
      pairs.emplace_back(std::min(a, b), std::max(a, b));
  });
  std::sort(pairs.begin(), pairs.end());
  for (const auto& [a, b] : pairs) visit(a, b);
}

Path path_from(const world::World& world, const world::Body& body, double length) {
  const double reach = world.shapes[at(body.shape)].reach;
  const bool goes = body.plan.number >= 0;
  return straight_path(body.state, goes ? body.plan.linear : Vec3(Vec3::Zero()),
                       goes ? body.plan.angular : Vec3(Vec3::Zero()), reach, length);
}

PathProof proof_of(const world::World& world, Contacts& contacts, int a, int b, const Path& path_a,
                   const Path& path_b, double length) {
  PathProof proof{a, b};
  PairContacts& pair = contacts.pair(a, b);
  contacts.update(world, pair, path_a.start, path_b.start);
  const double margin = contacts.margin();
  const double floor = pair.points.empty() ? kStop * margin : kFloor * margin;
  PathOptions options{.required_gap = std::min(floor, 0.5 * pair.gap), .most_pairs = kMostNodes};
  const double moves = length * ((path_b.velocity - path_a.velocity).norm() +
                                 path_a.spin_rate * path_a.reach + path_b.spin_rate * path_b.reach);
  if (pair.gap - moves >= options.required_gap) {
    proof.proof = Proof::speed;
    proof.slack = pair.gap - moves - options.required_gap;
    return proof;
  }
  options.by_planes = Contacts::convex(world, pair);
  PathVerdict verdict = check_path(world, contacts, pair, path_a, path_b, length, options);
  proof.proof = options.by_planes ? Proof::planes : Proof::advancement;
  if (!verdict.clear && options.by_planes) {
    options.by_planes = false;
    verdict = check_path(world, contacts, pair, path_a, path_b, length, options);
    proof.proof = Proof::advancement;
  }
  proof.slack = verdict.slack;
  if (!verdict.clear) proof.proof = Proof::none;
  return proof;
}

const char* name_of(Proof proof) {
  switch (proof) {
    case Proof::speed:
      return "by speed";
    case Proof::planes:
      return "by planes";
    case Proof::advancement:
      return "by advancement";
    case Proof::none:
      break;
  }
  return "not proved here";
}

}  // namespace

std::vector<PatchOfPair> patches_now(const world::World& world, double margin) {
  Contacts contacts(world, margin);
  std::vector<world::Bounds> boxes;
  for (int body = 0; body < static_cast<int>(world.bodies.size()); ++body) {
    boxes.push_back(world.swept_bounds(body, 0, 0));
    boxes.back().low -= Vec3::Constant(margin);
    boxes.back().high += Vec3::Constant(margin);
  }
  std::vector<PatchOfPair> patches;
  each_near_pair(world, boxes, [&](int a, int b) {
    PairContacts& pair = contacts.pair(a, b);
    const Pose pose_a = world.bodies[at(a)].state.pose(), pose_b = world.bodies[at(b)].state.pose();
    contacts.update(world, pair, pose_a, pose_b);
    if (pair.points.empty() || pair.gap > margin) return;
    PatchOfPair patch{a, b, pair.gap, {}};
    for (const ContactPoint& point : pair.points)
      patch.points.push_back({point.on_a(pose_a, pose_b), point.on_b(pose_a, pose_b),
                              point.normal_at(pose_a, pose_b), point.gap_at(pose_a, pose_b)});
    patches.push_back(std::move(patch));
  });
  return patches;
}

std::vector<PathProof> proofs_of(const world::World& world, const std::vector<world::Body>& bodies,
                                 double end, double margin) {
  Contacts contacts(world, margin);
  std::vector<Path> paths;
  std::vector<world::Bounds> boxes;
  for (const world::Body& body : bodies) {
    paths.push_back(path_from(world, body, end));
    const Path& path = paths.back();
    const Vec3 reach = Vec3::Constant(path.reach + margin);
    const Vec3 from = path.start.position, to = path.end.position;
    boxes.push_back({from.cwiseMin(to) - reach, from.cwiseMax(to) + reach});
  }
  std::vector<PathProof> proofs;
  each_near_pair(world, boxes, [&](int a, int b) {
    const auto follows = [&](int body) { return bodies[at(body)].plan.number >= 0; };
    const auto stands = [&](int body) { return follows(body) || bodies[at(body)].state.is_static(); };
    if (!stands(a) || !stands(b) || (!follows(a) && !follows(b))) return;
    const auto moves = [&](int body) {
      return bodies[at(body)].state.is_static() && !world.is_stationary(body);
    };
    if (moves(a) || moves(b))
      return;  // a kinematic body that moves: the plan looks at it, this drawing does not
    proofs.push_back(proof_of(world, contacts, a, b, paths[at(a)], paths[at(b)], end));
  });
  return proofs;
}

std::vector<Step> show_paths(const world::World& world, const std::vector<world::Body>& bodies, double end,
                             double margin, double t0) {
  std::vector<Step> steps;
  Step plan;
  std::size_t planned = 0;
  double farthest = 0;
  for (const world::Body& body : bodies) {
    if (body.plan.number < 0) continue;
    const Path path = path_from(world, body, end);
    farthest = std::max(farthest, (path.end.position - path.start.position).norm());
    if (++planned <= kMostPaths)
      plan.draw.push_back(algorithm::line({path.start.position, path.end.position}, Role::now));
  }
  if (planned == 0) {
    steps.push_back({"No body follows a plan at the start of this frame: all of them fly, or stand still."});
    return steps;
  }
  plan.text = fmt::format(
      "{} {} straight with constant spin until {:.6g} s, where the first plan ends; the farthest goes "
      "{} m. The lines are the paths of their centres.",
      planned, planned == 1 ? "body follows a plan:" : "bodies follow plans:", t0 + end,
      algorithm::number(farthest));
  steps.push_back(plan);

  const std::vector<PathProof> proofs = proofs_of(world, bodies, end, margin);
  Step step;
  int count[4] = {};
  for (const PathProof& proof : proofs) ++count[static_cast<int>(proof.proof)];
  step.text = fmt::format(
      "Each pair near these paths is proved to keep apart, by the first test that does: {} by the gap and the "
      "speed, {} by planes that go with a body, {} by advancement.",
      count[0], count[1], count[2]);
  if (count[3] > 0)
    step.text +=
        fmt::format(" {} are not proved by these tests alone: the plan has other ends there.", count[3]);
  algorithm::Bars bars{"how far above the least gap each pair is proved to stay", "m", {}};
  for (const PathProof& proof : proofs) {
    const bool is_good = proof.proof != Proof::none;
    if (bars.rows.size() < kMostProofs)
      bars.rows.push_back({fmt::format("bodies {} and {}", proof.a, proof.b), is_good ? proof.slack : 0,
                           is_good ? Role::good : Role::bad, name_of(proof.proof)});
    if (step.draw.size() < kMostPaths)
      step.draw.push_back(
          algorithm::line({bodies[at(proof.a)].state.position, bodies[at(proof.b)].state.position},
                          is_good ? Role::good : Role::bad));
  }
  if (!bars.rows.empty()) step.bars = bars;
  steps.push_back(step);
  return steps;
}

}  // namespace fc::resting
