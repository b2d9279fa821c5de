#include "ch05_resting_contact/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "ch04_multibody_stepping/contact_search.hpp"

namespace fc::resting {
namespace {

// Parts of the margin: the relative motion of two bodies after which their contacts are searched again; by how much
// less than the best plane a face's plane may separate two bodies and still be taken, because its normal is exact; the
// widest gap at a point of a manifold.
constexpr double kSearchAgain = 1.0 / 4, kSlack = 1.0 / 64, kFar = 4;

// A pair whose certified gap is below this share of the margin is searched again, too.
constexpr double kLeastKnown = 1.0 / 16;

// The relative accuracy of the distance of meshes that are not in contact.
constexpr double kRough = 0.5;

// A pair that nothing queries is kept for this number of frames.
constexpr std::int64_t kKept = 16;

// The largest distance that a point of the smaller body has moved, seen from the larger one.
double moved(const Pose& from, const Pose& to, double reach) {
  constexpr double kFrobenius =
      0.7071067811865476;  // of a difference of rotations: from this norm to its largest stretch
  return (to.position - from.position).norm() + kFrobenius * reach * (to.rotation - from.rotation).norm();
}

// The pose of one body in another one's axes.
Pose seen_from(const Pose& viewer, const Pose& body) {
  return {viewer.rotation.transpose() * body.rotation,
          viewer.rotation.transpose() * (body.position - viewer.position)};
}

// A point of a convex body's surface (m, body axes), where a plane with this outward normal (unit, body axes) touches.
SurfacePoint surface_point(const hulls::Model& model, const Vec3& point, const Vec3& normal) {
  constexpr double kFlat = 0.1;  // the sine of the angle up to which a disk lies flat on the plane
  constexpr double kOnRim = 1e-9;
  SurfacePoint surface;
  surface.local = point - model.radius * normal;
  surface.radius = model.radius;
  if (!model.curved()) return surface;
  const Vec3 across = normal - normal.dot(model.axis) * model.axis;
  if (across.norm() < kFlat) return surface;
  for (std::size_t k = 0; k < model.disks.size(); ++k) {
    const Vec3 arm = surface.local - model.mesh.vertices[k];
    const bool on_rim = model.disks[k] > 0 && std::abs(arm.dot(model.axis)) < kOnRim * model.reach &&
                        (arm - model.disks[k] * across.normalized()).norm() < 1e-3 * model.disks[k];
    if (!on_rim) continue;
    surface.local = model.mesh.vertices[k];
    surface.rim = model.disks[k];
    surface.axis = model.axis;
    break;
  }
  return surface;
}

// Whether points face each other across no more than the gap along their plane: then no other plane separates the two
// better.
bool face_each_other(const Manifold& manifold, double rounding) {
  return std::any_of(
      manifold.points.begin(), manifold.points.begin() + manifold.count, [&](const ManifoldPoint& point) {
        return point.key != ManifoldPoint::kBroughtTogether && point.gap <= manifold.gap + rounding;
      });
}

ContactPoint contact_point(const hulls::Model& model_a, const hulls::Model& model_b, const Pose& a,
                           const Pose& b, const Manifold& manifold, const ManifoldPoint& from) {
  ContactPoint point;
  point.a = surface_point(model_a, from.point_a, a.rotation.transpose() * manifold.normal);
  point.b = surface_point(model_b, from.point_b, -(b.rotation.transpose() * manifold.normal));
  // A plane that is no face of B turns with A; but not with a ball.
  const bool ball_a = model_a.mesh.vertices.size() == 1, ball_b = model_b.mesh.vertices.size() == 1;
  point.balls = ball_a && ball_b;
  point.of_b = manifold.of_b || ball_a;
  point.local_normal = (point.of_b ? b : a).rotation.transpose() * manifold.normal;
  point.key = from.key;
  return point;
}

}  // namespace

Contacts::Contacts(const world::World& world, double margin) : margin_(margin) {
  for (std::size_t s = 0; s < world.shapes.size(); ++s)
    face_lists_.push_back(world.shapes[s].convex() ? build_face_list(world.models[s].mesh) : FaceList{});
}

PairContacts& Contacts::pair(int a, int b) {
  const auto low = static_cast<std::uint64_t>(std::min(a, b)),
             high = static_cast<std::uint64_t>(std::max(a, b));
  PairContacts& pair = pairs_[low << 32 | high];
  pair.a = std::min(a, b);
  pair.b = std::max(a, b);
  pair.used = frame_;
  return pair;
}

void Contacts::next_frame() {
  ++frame_;
  if (frame_ % kKept == 0)
    std::erase_if(pairs_, [&](const auto& p) { return p.second.used + kKept < frame_; });
}

void Contacts::update(const world::World& world, PairContacts& pair, const Pose& a, const Pose& b,
                      const SearchOptions& options) {
  const bool is_convex = convex(world, pair);
  const double reach = is_convex && options.reach > 0 ? options.reach : margin_,
               again = options.again > 0 ? options.again : kSearchAgain * margin_;
  const double reach_a = world.shapes[world.bodies[pair.a].shape].reach,
               reach_b = world.shapes[world.bodies[pair.b].shape].reach;
  pair.axis_known = false;
  if (pair.known) {
    const double distance = reach_a < reach_b ? moved(pair.searched, seen_from(b, a), reach_a)
                                              : moved(pair.searched, seen_from(a, b), reach_b);
    pair.gap = pair.searched_gap - distance;
    if (pair.gap > reach) {
      pair.points.clear();
      return;
    }
    if (is_convex) {
      pair.axis_gap = axis_gap(world, pair, a, b);
      pair.axis_known = true;
    }
    if (!pair.points.empty() && distance <= again) {
      if (is_convex) pair.gap = std::max(pair.gap, pair.axis_gap);
      // A bound that is too weak would let the path come nearer than it may.
      if (distance == 0 || pair.gap > kLeastKnown * margin_) return;
    }
    if (is_convex && pair.axis_gap > reach) {
      pair.searched = reach_a < reach_b ? seen_from(b, a) : seen_from(a, b);
      pair.searched_gap = pair.gap = pair.axis_gap;
      pair.points.clear();
      return;
    }
  }
  pair.gap = search(world, pair, a, b, reach);
  pair.searched = reach_a < reach_b ? seen_from(b, a) : seen_from(a, b);
  pair.searched_gap = pair.gap;
  pair.known = true;
}

double Contacts::least_gap(const world::World& world, const PairContacts& pair, const Pose& a,
                           const Pose& b) const {
  const hulls::Model &model_a = world.model_of(pair.a), &model_b = world.model_of(pair.b);
  const Vec3 apart = b.position - a.position;
  double gap = apart.norm() - model_a.reach - model_b.reach;
  if (pair.known) {
    const bool smaller_a = model_a.reach < model_b.reach;
    gap =
        std::max(gap, pair.searched_gap - (smaller_a ? moved(pair.searched, seen_from(b, a), model_a.reach)
                                                     : moved(pair.searched, seen_from(a, b), model_b.reach)));
  }
  if (!convex(world, pair)) return gap;
  const Vec3 axis = pair.known ? pair.axis_at(a, b) : apart.normalized();
  return std::max(gap, ca::support_gap(model_a.leaf(0), model_b.leaf(0), ca::PairPose(a, b), axis));
}

double Contacts::axis_gap(const world::World& world, const PairContacts& pair, const Pose& a,
                          const Pose& b) const {
  return ca::support_gap(world.model_of(pair.a).leaf(0), world.model_of(pair.b).leaf(0), ca::PairPose(a, b),
                         pair.axis_at(a, b));
}

// The plane of the pair's last search, in the form of GJK's result for an overlap: without witness points.
ca::GjkResult Contacts::known_plane(const world::World& world, const PairContacts& pair, const Pose& a,
                                    const Pose& b) const {
  ca::GjkResult plane;
  plane.status = ca::GjkResult::Status::overlapping;
  plane.normal = pair.axis_at(a, b);
  plane.lower = axis_gap(world, pair, a, b);
  return plane;
}

std::vector<ContactPoint> Contacts::points_at(const world::World& world, PairContacts& pair, const Pose& a,
                                              const Pose& b, double& gap) {
  PairContacts there = pair;
  gap = search(world, there, a, b, margin_);
  pair.simplex = there.simplex;
  return std::move(there.points);
}

ca::GjkResult Contacts::nearest(const world::World& world, PairContacts& pair,
                                const ca::PairPose& pose) const {
  const ca::Convex a = world.model_of(pair.a).leaf(0), b = world.model_of(pair.b).leaf(0);
  ca::GjkResult result = ca::distance(a, b, pose, {.absolute = world.tolerance / 16},
                                      pair.simplex.count > 0 ? &pair.simplex : nullptr);
  pair.simplex = result.cache;
  if (result.status != ca::GjkResult::Status::separated || result.lower < world.tolerance)
    result = hulls::leaf_distance(a, b, pose, world.tolerance);
  return result;
}

double Contacts::search(const world::World& world, PairContacts& pair, const Pose& a, const Pose& b,
                        double reach) {
  ++searched_;
  return convex(world, pair) ? search_convex(world, pair, a, b, reach) : search_mesh(world, pair, a, b);
}

// Adds a point. Its guess is the force of the same point before, or of the nearest one.
void Contacts::add(PairContacts& pair, const ContactPoint& point, const std::vector<ContactPoint>& before) {
  pair.points.push_back(point);
  double nearest = std::numeric_limits<double>::infinity();
  for (const ContactPoint& old : before) {
    const double distance = old.key == point.key ? -1 : (old.a.local - point.a.local).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    pair.points.back().force = old.force;
    pair.points.back().lasts = old.lasts;
  }
}

double Contacts::search_convex(const world::World& world, PairContacts& pair, const Pose& a, const Pose& b,
                               double reach) {
  const ca::PairPose pose(a, b);
  const ManifoldSide side_a{world.model_of(pair.a), face_lists_[at(world.bodies[pair.a].shape)]},
      side_b{world.model_of(pair.b), face_lists_[at(world.bodies[pair.b].shape)]};
  Manifold manifold;
  const auto find_points = [&](const ca::GjkResult& plane) {
    const double slack = std::clamp(0.25 * plane.lower, 0.0, kSlack * margin_);
    find_manifold(side_a, side_b, pose, plane, slack, kFar * margin_ + (reach - margin_), manifold);
  };
  const ca::GjkResult known = pair.known ? known_plane(world, pair, a, b) : ca::GjkResult{};
  bool found = pair.known && known.lower > 0 && known.lower <= reach;
  if (found) {
    find_points(known);
    found = face_each_other(manifold, world.tolerance / 16);
  }
  ca::GjkResult result = found ? known : nearest(world, pair, pose);
  // An overlap (of a pose that will never be reached) has no plane: the last plane will be near the next one.
  if (!found && !(result.lower > 0) && pair.known && known.lower > result.lower) result = known;
  pair.of_b = false;
  pair.axis = a.rotation.transpose() * result.normal;
  pair.axis_gap = result.lower;
  pair.axis_known = true;
  const std::vector<ContactPoint> before = std::exchange(pair.points, {});
  if (result.lower > reach) return result.lower;
  if (!found) find_points(result);
  pair.axis_gap = manifold.gap;
  pair.of_b = manifold.of_b;
  pair.axis = (manifold.of_b ? b : a).rotation.transpose() * manifold.normal;
  pair.points.reserve(at(manifold.count));
  for (int i = 0; i < manifold.count; ++i)
    add(pair, contact_point(side_a.model, side_b.model, a, b, manifold, manifold.points[at(i)]), before);
  return std::max(result.lower, manifold.gap);
}

double Contacts::search_mesh(const world::World& world, PairContacts& pair, const Pose& a, const Pose& b) {
  const ca::PairPose pose(a, b);
  const std::vector<ContactPoint> before = std::exchange(pair.points, {});
  const double gap = hulls::model_distance(world.model_of(pair.a), world.model_of(pair.b), pose,
                                           world.tolerance, std::numeric_limits<double>::infinity(), kRough)
                         .lower;
  if (gap > margin_) return gap;
  double of_features = gap;  // certified, too, but only to a sixteenth of the distance that is asked for
  for (const ca::FeaturePair& f : world::near_features(world, pair.a, pair.b, pose, a.position,
                                                       (1 + kSearchAgain) * margin_, &of_features)) {
    const bool of_b = f.kind_b == ca::FeatureKind::face;
    const auto key = static_cast<std::uint64_t>(f.kind_a) << 62 | static_cast<std::uint64_t>(f.kind_b) << 60 |
                     static_cast<std::uint64_t>(f.id_a) << 30 | static_cast<std::uint64_t>(f.id_b);
    ContactPoint point;
    point.a.local = a.rotation.transpose() * (f.point_a - a.position);
    point.b.local = b.rotation.transpose() * (f.point_b - b.position);
    point.local_normal = (of_b ? b : a).rotation.transpose() * f.normal;
    point.of_b = of_b;
    point.key = key;
    add(pair, point, before);
  }
  return std::max(gap, of_features);
}

}  // namespace fc::resting
