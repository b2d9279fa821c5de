#include "ch05_resting_contact/study/moreau_jean.hpp"

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "common/stopwatch.hpp"

namespace fc::resting {
namespace {

constexpr double kPush =
    0.2;  // of the smaller reach: two bodies are pushed apart this far before they are examined
constexpr double kSlack = 1e-4;  // m, by which the gap along a face's plane may be smaller than the best one

bool far_apart(const world::Bounds& a, const world::Bounds& b, double far) {
  return ((a.low - b.high).array() > far).any() || ((b.low - a.high).array() > far).any();
}

Quat turned(const Quat& orientation, const Vec3& by) {  // rad, world axes
  const double angle = by.norm();
  if (angle == 0) return orientation;
  return (Quat(Eigen::AngleAxisd(angle, by / angle)) * orientation).normalized();
}

}  // namespace

Facing::Facing(const world::World& world) {
  for (const hulls::Model& model : world.models) face_lists_.push_back(build_face_list(model.mesh));
}

const Manifold* Facing::find(const world::World& world, int a, int b, double far) {
  if (far_apart(world.swept_bounds(a, 0, 0), world.swept_bounds(b, 0, 0), far)) return nullptr;
  ++searches_;
  const ca::Convex core_a = world.model_of(a).leaf(0), core_b = world.model_of(b).leaf(0);
  const Pose pose_a = world.bodies[a].state.pose(), pose_b = world.bodies[b].state.pose();
  const ca::PairPose pose(pose_a, pose_b);
  const auto [place, first] = normals_.try_emplace({a, b});
  if (first) place->second = hulls::leaf_distance(core_a, core_b, pose, world.tolerance).normal;
  const double reach_a = world.shapes[world.bodies[a].shape].reach,
               reach_b = world.shapes[world.bodies[b].shape].reach;
  const Vec3 push = kPush * std::min(reach_a, reach_b) * place->second;
  ca::GjkResult nearest =
      ca::distance(core_a, core_b, ca::PairPose(pose_a, Pose{pose_b.rotation, pose_b.position + push}), {});
  place->second = nearest.normal;
  nearest.lower = ca::support_gap(core_a, core_b, pose, nearest.normal);
  nearest.point_b -= push;
  find_manifold({world.model_of(a), face_lists_[static_cast<std::size_t>(world.bodies[a].shape)]},
                {world.model_of(b), face_lists_[static_cast<std::size_t>(world.bodies[b].shape)]}, pose,
                nearest, kSlack, far, manifold_);
  return &manifold_;
}

double smallest_gap(Facing& facing, const world::World& world, double far) {
  double smallest = std::numeric_limits<double>::infinity();
  const int count = static_cast<int>(world.bodies.size());
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      if (!world.is_dynamic(a) && !world.is_dynamic(b)) continue;
      if (const Manifold* manifold = facing.find(world, a, b, far))
        smallest = std::min(smallest, manifold->gap);
    }
  return smallest;
}

void MoreauJean::find_contacts(const world::World& world) {
  contacts_.clear();
  double fastest = 0;  // m/s, of two points
  for (const world::Body& body : world.bodies)
    fastest = std::max(fastest,
                       body.state.velocity.norm() + world.shapes[body.shape].reach * body.state.spin.norm());
  const int count = static_cast<int>(bodies_.size());
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      if (!world.is_dynamic(a) && !world.is_dynamic(b)) continue;
      const Manifold* manifold = facing_.find(world, a, b, 2 * fastest * dt_ + world.tolerance);
      if (manifold == nullptr) continue;
      for (int i = 0; i < manifold->count; ++i) {
        const ManifoldPoint& p = manifold->points[static_cast<std::size_t>(i)];
        const RigidBody &at_a = bodies_[static_cast<std::size_t>(a)],
                        &at_b = bodies_[static_cast<std::size_t>(b)];
        const Vec3 middle = 0.5 * (at_a.pose() * p.point_a + at_b.pose() * p.point_b);
        const lcp::Contact contact = {a,
                                      b,
                                      middle,
                                      manifold->normal,
                                      p.gap,
                                      world.restitution_of(a, b),
                                      world.turns(a),
                                      world.turns(b)};
        if (p.gap + std::min(0.0, dt_ * lcp::contact_velocity(bodies_, contact)) <= world.tolerance)
          contacts_.push_back(contact);
      }
    }
}

MoreauJean::Report MoreauJean::step(world::World& world, const world::OnImpact& impact) {
  const Stopwatch watch;
  Report report;
  const std::int64_t before = facing_.searches();
  bodies_.clear();
  for (const world::Body& body : world.bodies) bodies_.push_back(body.state);
  find_contacts(world);

  // ANCHOR: moreau_jean
  VecX bounce(static_cast<Eigen::Index>(contacts_.size()));  // e v-
  for (Eigen::Index i = 0; i < bounce.size(); ++i) {
    const lcp::Contact& c = contacts_[static_cast<std::size_t>(i)];
    bounce[i] = c.restitution * lcp::contact_velocity(bodies_, c);
  }
  for (RigidBody& body : bodies_)
    if (world.effects.gravity && !body.is_static()) body.velocity += dt_ * world.gravity_on(body);
  const lcp::ImpactProblem rows = lcp::assemble(bodies_, contacts_);
  const VecX b = rows.v_before + bounce;
  lcp::LcpResult result;
  if (!contacts_.empty()) solver_.solve({rows.A, b}, {}, result);
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    lcp::apply_impulse(bodies_, contacts_[i], result.z[static_cast<Eigen::Index>(i)]);
  for (RigidBody& body : bodies_) {
    if (body.is_static()) continue;
    body.position += dt_ * body.velocity;  // v+
    body.orientation = turned(body.orientation, dt_ * body.spin);
  }
  // ANCHOR_END: moreau_jean
  FC_CHECK(contacts_.empty() || result.status == lcp::Status::solved,
           "the contacts of a frame could not be solved");
  for (std::size_t i = 0; i < bodies_.size(); ++i)
    if (!bodies_[i].is_static()) world.bodies[i].state = bodies_[i];
  for (std::size_t i = 0; impact && i < contacts_.size(); ++i)
    if (const double j = result.z[static_cast<Eigen::Index>(i)]; j > 0)
      impact({0, contacts_[i], {static_cast<int>(i), 0, 0, 0, j}});
  report.rows = static_cast<int>(contacts_.size());
  report.residual = result.residual;
  report.searches = facing_.searches() - before;
  report.ns = watch.ns();
  return report;
}

}  // namespace fc::resting
