#include "ch02_hull_hierarchy/study/tree.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace fc::hulls {
namespace {

constexpr double kRounding = 16 * std::numeric_limits<double>::epsilon();

// A node's volume: the hull of some points, rounded.
struct Rounded {
  std::vector<Vec3> points;
  double radius = 0;  // m
};

// Columns: the principal axes of the points, the longest last.
Mat3 principal_axes(std::span<const Vec3> points) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : points) mean += p / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - mean) * (p - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Mat3>(spread).eigenvectors();
}

Rounded box_around(std::span<const Vec3> points) {
  const Mat3 axes = principal_axes(points);
  Eigen::AlignedBox3d range;
  for (const Vec3& p : points) range.extend(axes.transpose() * p);
  Rounded box;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 at = range.min();
    for (int k = 0; k < 3; ++k)
      if ((corner >> k) & 1) at[k] = range.max()[k];
    box.points.emplace_back(axes * at);
  }
  return box;
}

// Along the longest principal axis, through the middle of the points as seen along it; the segment is as
// short as that line allows.
Rounded capsule_around(std::span<const Vec3> points) {
  const Mat3 axes = principal_axes(points);
  Eigen::AlignedBox3d range;
  for (const Vec3& p : points) range.extend(axes.transpose() * p);
  const Vec3 along = axes.col(2), middle = axes * range.center();
  const auto apart = [&](const Vec3& p) { return (p - middle - along.dot(p - middle) * along).norm(); };
  double radius = 0;
  for (const Vec3& p : points) radius = std::max(radius, apart(p));
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : points) {
    const double at = along.dot(p - middle), d = apart(p),
                 cap = std::sqrt(std::max(0.0, radius * radius - d * d));
    low = std::min(low, at + cap);
    high = std::max(high, at - cap);
  }
  if (low > high) low = high = 0.5 * (low + high);
  Rounded capsule{{middle + low * along, middle + high * along}, 0};
  for (const Vec3& p : points) {
    const double at = std::clamp(along.dot(p - middle), low, high);
    capsule.radius = std::max(capsule.radius, (p - middle - at * along).norm());
  }
  return capsule;
}

Rounded fewer_points(std::span<const Vec3> points, int most) {
  std::vector<int> kept;
  for (const Vec3& direction : even_directions(most)) kept.push_back(ca::support(points, direction));
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  Rounded hull;
  for (const int i : kept) hull.points.push_back(points[i]);
  const ca::PairPose still{ca::Motion{}, ca::Motion{}, 0};
  const double reach = ca::reach_of(points);
  const ca::Convex core{hull.points, 0, reach, hull.points[0]};
  for (const Vec3& p : points)
    hull.radius = std::max(
        hull.radius, ca::distance(core, {{&p, 1}, 0, reach, p}, still, {1e-12 * reach, 1e-2, 128}).upper);
  return hull;
}

Rounded volume_of(const HullNode& node, const StudyTreeOptions& options) {
  const std::span<const Vec3> points = node.points;
  Rounded volume{node.points, 0};
  if (node.leaf()) return {volume.points, node.slack};
  if (options.volume == Volume::sphere) volume = {{node.center}, node.radius};
  if (options.volume == Volume::swept_sphere) volume = capsule_around(points);
  if (options.volume == Volume::box) volume = box_around(points);
  if (options.volume == Volume::hull && static_cast<int>(points.size()) > options.most_points)
    volume = fewer_points(points, options.most_points);
  // Covers the rounding of what was computed above.
  if (options.volume != Volume::hull || volume.radius > 0)
    volume.radius += kRounding * (node.center.norm() + node.radius);
  volume.radius += node.slack;
  return volume;
}

Lists single_triangles(const FeatureMesh& mesh) {
  Lists lists;
  lists.items.resize(mesh.triangles.size());
  std::iota(lists.items.begin(), lists.items.end(), 0);
  for (int t = 0; t < static_cast<int>(lists.items.size()); ++t) lists.start.push_back(t + 1);
  return lists;
}

}  // namespace

const char* name_of(Volume volume) {
  static constexpr const char* names[] = {"sphere", "swept sphere", "box", "hull"};
  return names[static_cast<int>(volume)];
}
const char* name_of(Leaves leaves) {
  return leaves == Leaves::pieces ? "pieces" : "triangles";
}

HullModel build_study_model(const Model& model, const Lists& pieces, const StudyTreeOptions& options) {
  HullModel result;
  result.radius = model.radius;
  result.reach = model.reach;
  result.pieces = options.leaves == Leaves::pieces ? pieces : single_triangles(model.mesh);
  result.tree = clear::hull_tree(points_of_pieces(model.mesh, result.pieces));
  for (HullNode& node : result.tree.nodes) {
    Rounded volume = volume_of(node, options);
    node.slack = volume.radius;
    node.points = std::move(volume.points);
  }
  return result;
}

double overhang(const HullModel& volumes, const HullModel& hulls, int node, const Vec3& direction) {
  const auto reach = [&](const HullModel& model) {
    const HullNode& n = model.tree.nodes[node];
    return n.points[ca::support(n.points, direction)].dot(direction) + n.slack;
  };
  return reach(volumes) - reach(hulls);
}

Vec3 thin_direction(std::span<const Vec3> points) {
  return principal_axes(points).col(0);
}

std::vector<Vec3> even_directions(int count) {
  std::vector<Vec3> directions;
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));  // the golden angle
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z);
    directions.emplace_back(r * std::cos(turn * i), r * std::sin(turn * i), z);
  }
  return directions;
}

}  // namespace fc::hulls
