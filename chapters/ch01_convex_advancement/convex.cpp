#include "ch01_convex_advancement/convex.hpp"

#include <algorithm>
#include <limits>

#include "ch01_convex_advancement/rounding.hpp"

namespace fc::ca {
namespace {

// The number of points from which a table is worth its memory, about 5 numbers for each point.
constexpr std::size_t kTableFrom = 12;

// A square of directions: those from the cube's middle to a square on one of its sides. Their component along
// the side's axis is 1 or -1, those along u and v are within `half` of the middle's.
struct Square {
  Vec3 middle;
  int u, v;
  double half;

  // Whether the rival lies farther than p along every direction of the square, so that p need not be looked
  // at.
  bool hides(const Vec3& rival, const Vec3& p, double rounding) const {
    const Vec3 ahead = rival - p;
    return middle.dot(ahead) - half * (std::abs(ahead[u]) + std::abs(ahead[v])) > rounding;
  }
};

// The listed points that may be the farthest along some direction of the square.
std::vector<int> possible(std::span<const Vec3> points, const std::vector<int>& listed, const Square& square,
                          double rounding) {
  std::array<int, 5> rivals;  // the farthest along the middle and the corners
  for (int k = 0; k < 5; ++k) {
    Vec3 d = square.middle;
    if (k > 0) d[square.u] += k & 1 ? square.half : -square.half;
    if (k > 0) d[square.v] += k & 2 ? square.half : -square.half;
    rivals[k] = listed[0];
    for (const int i : listed)
      if (points[i].dot(d) > points[rivals[k]].dot(d)) rivals[k] = i;
  }
  std::vector<int> left;
  for (const int i : listed)
    if (std::none_of(rivals.begin(), rivals.end(),
                     [&](int rival) { return square.hides(points[rival], points[i], rounding); }))
      left.push_back(i);
  return left;
}

}  // namespace

SupportTable::SupportTable(std::span<const Vec3> points) {
  // Two or three cells for each point leave few points in a cell.
  while (6 * cells_ * cells_ < 2 * static_cast<int>(points.size())) cells_ *= 2;
  half_ = 0.5 * cells_;
  // A query finds its cell with an error of a few eps: squares are taken a little larger than they are.
  const double margin = 1e-12;
  const double rounding = 64 * kEpsilon * reach_of(points);
  std::vector<int> all(points.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);

  std::vector<std::vector<int>> lists(static_cast<std::size_t>(6 * cells_ * cells_));
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    // From the whole side down: each square takes its points from the square that it is a quarter of.
    std::vector<std::vector<int>> coarse{all};
    for (int cells = 1; cells <= cells_; cells *= 2) {
      std::vector<std::vector<int>> fine;
      for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column) {
          Square square{Vec3::Zero(), u, v, 1.0 / cells + margin};
          square.middle[axis] = side % 2 == 0 ? 1 : -1;
          square.middle[u] = (2 * row + 1.0) / cells - 1;
          square.middle[v] = (2 * column + 1.0) / cells - 1;
          const int above = cells == 1 ? 0 : (row / 2) * (cells / 2) + column / 2;
          fine.push_back(possible(points, coarse[above], square, rounding));
        }
      coarse = std::move(fine);
    }
    std::move(coarse.begin(), coarse.end(), lists.begin() + side * cells_ * cells_);
  }
  start_.push_back(0);
  for (const std::vector<int>& list : lists) {
    listed_.insert(listed_.end(), list.begin(), list.end());
    start_.push_back(static_cast<int>(listed_.size()));
  }
}

SupportPoint support_of_disks(const Convex& core, const Vec3& d) {
  const Vec3 sideways = d - d.dot(core.axis) * core.axis;
  const double across = std::hypot(sideways.x(), sideways.y(), sideways.z());
  int best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < static_cast<int>(core.points.size()); ++i) {
    const double value = core.points[i].dot(d) + core.disks[i] * across;
    if (value > most) {
      most = value;
      best = i;
    }
  }
  Vec3 point = core.points[best];
  if (across > 0) point += core.disks[best] / across * sideways;
  return {point, best};
}

double reach_of(std::span<const Vec3> points) {
  double reach2 = 0;
  for (const Vec3& p : points) reach2 = std::max(reach2, p.squaredNorm());
  return std::sqrt(reach2) * (1 + 4 * kEpsilon);
}

double reach_of(std::span<const Vec3> points, std::span<const double> disks, const Vec3& axis) {
  if (disks.empty()) return reach_of(points);
  double reach = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double along = axis.dot(points[i]), across = (points[i] - along * axis).norm();
    reach = std::max(reach, std::hypot(across + disks[i], along));
  }
  return reach * (1 + 8 * kEpsilon);
}

double reach_across(const Convex& core, const Vec3& axis) {
  double across = 0;
  for (std::size_t i = 0; i < core.points.size(); ++i)  // a disk's rim: at most its middle and its radius
    across = std::max(across, core.points[i].cross(axis).norm() + (core.disks.empty() ? 0 : core.disks[i]));
  return std::min(across * (1 + 8 * kEpsilon), core.reach);
}

ConvexCore::ConvexCore(std::vector<Vec3> points, std::vector<double> disks)
    : points_(std::move(points)), disks_(std::move(disks)) {
  Vec3 low = points_[0], high = points_[0];
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double disk = disks_.empty() ? 0 : disks_[i];
    const Vec3& p = points_[i];
    low = low.cwiseMin(p - Vec3(disk, disk, 0));
    high = high.cwiseMax(p + Vec3(disk, disk, 0));
    reach_ = std::max(reach_, std::hypot(std::hypot(p.x(), p.y()) + disk, p.z()) * (1 + 8 * kEpsilon));
  }
  center_ = 0.5 * (low + high);
  if (disks_.empty() && points_.size() >= kTableFrom) table_.emplace_back(points_);
}

Convex ConvexCore::convex(double radius) const {
  return {points_, radius, reach_, center_, disks_, table_.empty() ? nullptr : &table_[0]};
}

}  // namespace fc::ca
