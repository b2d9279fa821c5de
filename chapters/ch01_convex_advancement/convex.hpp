// Convex cores and their support mappings: all that GJK ever asks of a shape.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "common/types.hpp"

namespace fc::ca {

class SupportTable;

// A convex core, and the radius of the ball that rounds it. The core is the convex hull of points (points
// inside do no harm), each of which may carry a disk about itself, in the plane across the axis. A cylinder
// is two points with equal disks, a cone a point with a disk and its apex with none. Coordinates are in the
// body's axes, about its centre of mass. The rounding radius never enters GJK: it is subtracted from the
// distance afterwards. A view: it owns nothing (ConvexCore does).
struct Convex {
  std::span<const Vec3> points;     // m, at least one
  double radius = 0;                // m
  double reach = 0;                 // m, the largest distance of the core from its centre of mass
  Vec3 center = Vec3::Zero();       // m, somewhere in the middle: GJK's first direction joins the two centres
  std::span<const double> disks{};  // m, the radius of each point's disk; empty: no disks
  const SupportTable* table = nullptr;  // of the same points; none: every point is looked at
  Vec3 axis = Vec3::UnitZ();            // unit: the disks lie across it
};

// A point of a core, and the number of that point, or of the point whose disk it is on.
struct SupportPoint {
  Vec3 point;  // m
  int index;
};

// A point of the core that lies farthest along the direction (any length but 0), up to the rounding of the
// products that are compared.
inline SupportPoint support(const Convex& core, const Vec3& direction);

// The number of the point that lies farthest along the direction; the first of several.
inline int support(std::span<const Vec3> points, const Vec3& direction) {
  int best = 0;
  double most = points[0].dot(direction);
  for (int i = 1; i < static_cast<int>(points.size()); ++i) {
    const double value = points[i].dot(direction);
    if (value > most) {
      most = value;
      best = i;
    }
  }
  return best;
}

// Answers support queries of many points by looking at a few. The directions are sorted into the cells of a
// cube's surface, each side a grid; a cell lists every point that is the farthest along any of its
// directions. So the answer is the same as from looking at all points, whatever the points are: unlike
// climbing along a hull's edges, this has no local maxima that rounding could make.
class SupportTable {
 public:
  explicit SupportTable(std::span<const Vec3> points);

  // How many points a query looks at: the mean over the cells.
  double mean_listed() const {
    return static_cast<double>(listed_.size()) / static_cast<double>(start_.size() - 1);
  }

  int support(std::span<const Vec3> points, const Vec3& d) const {
    const Vec3 size = d.cwiseAbs();
    int axis = size.x() >= size.y() ? 0 : 1;
    if (size.z() > size[axis]) axis = 2;
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;  // the other two, ascending
    const double scale = half_ / size[axis];
    const int row = std::min(static_cast<int>(half_ + d[u] * scale), cells_ - 1);
    const int column = std::min(static_cast<int>(half_ + d[v] * scale), cells_ - 1);
    const int cell = ((2 * axis + (d[axis] < 0)) * cells_ + row) * cells_ + column;
    const int* at = listed_.data() + start_[cell];
    const int* const end = listed_.data() + start_[cell + 1];
    int best = *at;
    double most = points[best].dot(d);
    while (++at != end) {
      const double value = points[*at].dot(d);
      const bool more = value > most;
      most = more ? value : most;
      best = more ? *at : best;
    }
    return best;
  }

 private:
  int cells_ = 1;    // on each edge of a side
  double half_ = 1;  // half of that
  std::vector<int> start_,
      listed_;  // the points of cell c are listed_[start_[c]] ... listed_[start_[c + 1] - 1]
};

SupportPoint support_of_disks(const Convex& core, const Vec3& direction);

inline SupportPoint support(const Convex& core, const Vec3& direction) {
  if (!core.disks.empty()) return support_of_disks(core, direction);
  const int best =
      core.table != nullptr ? core.table->support(core.points, direction) : support(core.points, direction);
  return {core.points[best], best};
}

// The largest |point|, in m: what Convex::reach must be for a core without disks, and for one with.
double reach_of(std::span<const Vec3> points);
double reach_of(std::span<const Vec3> points, std::span<const double> disks, const Vec3& axis);

// The largest distance in m of a point of the core from the line through the centre of mass along a unit
// axis (body axes): no larger than the reach.
double reach_across(const Convex& core, const Vec3& axis);

// Owns what a Convex refers to.
class ConvexCore {
 public:
  // points: n, m, about the centre of mass; disks: n radii >= 0 in m, or none.
  explicit ConvexCore(std::vector<Vec3> points, std::vector<double> disks = {});
  Convex convex(double radius) const;

 private:
  std::vector<Vec3> points_;
  std::vector<double> disks_;
  std::vector<SupportTable> table_;  // one or none
  double reach_ = 0;
  Vec3 center_ = Vec3::Zero();
};

}  // namespace fc::ca
