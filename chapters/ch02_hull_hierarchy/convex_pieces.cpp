#include "ch02_hull_hierarchy/convex_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "ch01_convex_advancement/gjk.hpp"
#include "common/convex_hull.hpp"

namespace fc::hulls {
namespace {

// Height over longest side of a triangle. The normal of a flatter triangle is not exact enough to extend it to a
// plane.
constexpr double kNeedleHeight = 1e-4;
constexpr double kFlatThickness = 1e-9;  // of the piece's size; thinner pieces are checked as polygons

struct HullPlane {
  Vec3 normal;    // unit, outward
  double offset;  // normal.x = offset on the plane
};

// Which triangles lie near a box: a uniform grid of cells about twice as wide as a triangle.
class TriangleGrid {
 public:
  explicit TriangleGrid(const FeatureMesh& mesh) : mesh_(mesh), seen_(mesh.triangles.size(), 0) {
    Eigen::AlignedBox3d box;
    double sizes = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      box.extend(box_of(static_cast<int>(t)));
      sizes += box_of(static_cast<int>(t)).sizes().maxCoeff();
    }
    const double wanted = 2 * sizes / static_cast<double>(mesh.triangles.size());
    cell_ = std::max(wanted, box.sizes().maxCoeff() / 200);
    origin_ = box.min();
    for (int a = 0; a < 3; ++a) count_[a] = static_cast<int>(box.sizes()[a] / cell_) + 1;
    cells_.resize(static_cast<std::size_t>(count_[0]) * count_[1] * count_[2]);
    for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
      for_cells(box_of(t), [&](std::vector<int>& cell) { cell.push_back(t); });
  }

  // Calls visit(triangle) once for each triangle whose box meets the given one, until it returns true.
  // Returns whether it did.
  template <class Visit>
  bool any_near(const Eigen::AlignedBox3d& box, Visit visit) {
    ++round_;
    bool found = false;
    for_cells(box, [&](const std::vector<int>& cell) {
      for (const int t : cell) {
        if (found || seen_[t] == round_) continue;
        seen_[t] = round_;
        found = box.intersects(box_of(t)) && visit(t);
      }
    });
    return found;
  }

 private:
  Eigen::AlignedBox3d box_of(int t) const {
    Eigen::AlignedBox3d box;
    for (const int v : mesh_.triangles[t]) box.extend(mesh_.vertices[v]);
    return box;
  }
  int cell_of(double x, int axis) const {
    return std::clamp(static_cast<int>((x - origin_[axis]) / cell_), 0, count_[axis] - 1);
  }
  template <class Use>
  void for_cells(const Eigen::AlignedBox3d& box, Use use) {
    for (int z = cell_of(box.min().z(), 2); z <= cell_of(box.max().z(), 2); ++z)
      for (int y = cell_of(box.min().y(), 1); y <= cell_of(box.max().y(), 1); ++y)
        for (int x = cell_of(box.min().x(), 0); x <= cell_of(box.max().x(), 0); ++x)
          use(cells_[(static_cast<std::size_t>(z) * count_[1] + y) * count_[0] + x]);
  }

  const FeatureMesh& mesh_;
  Vec3 origin_ = Vec3::Zero();
  double cell_ = 1;
  std::array<int, 3> count_{};
  std::vector<std::vector<int>> cells_;
  std::vector<int> seen_;
  int round_ = 0;
};

// The planes that bound the hull of a few points: every plane through three of them that has the others on
// one side. Planes of nearly collinear points are left out, which can only make the region larger and the
// test below stricter.
std::vector<HullPlane> bounding_planes(const std::vector<Vec3>& points, double slack) {
  std::vector<HullPlane> planes;
  const int n = static_cast<int>(points.size());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      for (int k = j + 1; k < n; ++k) {
        const Vec3 u = points[j] - points[i], v = points[k] - points[i];
        const Vec3 cross = u.cross(v);
        if (cross.norm() <= kNeedleHeight * u.norm() * v.norm()) continue;
        const Vec3 normal = cross.normalized();
        const double offset = normal.dot(points[i]);
        double above = 0, below = 0;
        for (const Vec3& p : points) {
          above = std::max(above, normal.dot(p) - offset);
          below = std::max(below, offset - normal.dot(p));
        }
        if (above <= slack) planes.push_back({normal, offset});
        if (below <= slack) planes.push_back({-normal, -offset});
      }
  return planes;
}

// Whether a triangle reaches into the region normal.x < offset - depth of all planes: clip it by one plane
// after another.
bool reaches_inside(const std::vector<HullPlane>& planes, double depth, std::vector<Vec3> polygon) {
  std::vector<Vec3> kept;
  for (const HullPlane& plane : planes) {
    kept.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec3& p = polygon[i];
      const Vec3& q = polygon[(i + 1) % polygon.size()];
      const double at_p = plane.normal.dot(p) - plane.offset + depth;
      const double at_q = plane.normal.dot(q) - plane.offset + depth;
      if (at_p < 0) kept.push_back(p);
      if ((at_p < 0) != (at_q < 0)) kept.push_back(p + (q - p) * (at_p / (at_p - at_q)));
    }
    if (kept.size() < 3) return false;
    polygon.swap(kept);
  }
  return true;
}

struct Decomposition {
  const FeatureMesh& mesh;
  const PieceOptions& options;
  double slack;  // m, what counts as rounding
  TriangleGrid grid;
  std::vector<char> taken, alone;
  std::vector<int> piece;    // triangles of the piece that is growing, in the order they came
  std::vector<int> corners;  // its distinct vertices, in the order they came

  Decomposition(const FeatureMesh& m, const PieceOptions& o)
      : mesh(m), options(o), slack(0), grid(m), taken(m.triangles.size(), 0), alone(m.triangles.size(), 0) {
    slack = 16 * std::numeric_limits<double>::epsilon() * ca::reach_of(m.vertices);
    for (std::size_t t = 0; t < m.triangles.size(); ++t) {
      const auto& [i, j, k] = m.triangles[t];
      const Vec3 u = m.vertices[j] - m.vertices[i], v = m.vertices[k] - m.vertices[j],
                 w = m.vertices[i] - m.vertices[k];
      const double longest2 = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
      alone[t] = u.cross(v).norm() < kNeedleHeight * longest2;
    }
  }

  double height(int triangle, int vertex) const {  // of a vertex over a triangle's plane
    return mesh.normals[triangle].dot(mesh.vertices[vertex] - mesh.vertices[mesh.triangles[triangle][0]]);
  }
  bool stays_convex(int candidate) const {
    for (const int v : corners)
      if (height(candidate, v) > slack) return false;
    for (const int v : mesh.triangles[candidate])
      for (const int t : piece)
        if (height(t, v) > slack) return false;
    return true;
  }
  void take(int t) {
    piece.push_back(t);
    for (const int v : mesh.triangles[t])
      if (std::find(corners.begin(), corners.end(), v) == corners.end()) corners.push_back(v);
  }

  void grow(int seed) {
    piece.clear();
    corners.clear();
    take(seed);
    if (alone[seed]) return;
    for (std::size_t next = 0; next < piece.size(); ++next) {  // breadth first: pieces grow round
      for (int k = mesh.triangle_edges.start[piece[next]]; k < mesh.triangle_edges.start[piece[next] + 1];
           ++k) {
        const int edge = mesh.triangle_edges.items[k];
        for (int m = mesh.edge_triangles.start[edge]; m < mesh.edge_triangles.start[edge + 1]; ++m) {
          const int t = mesh.edge_triangles.items[m];
          if (static_cast<int>(piece.size()) >= options.max_triangles) return;
          if (taken[t] || alone[t] || std::find(piece.begin(), piece.end(), t) != piece.end()) continue;
          if (stays_convex(t)) take(t);
        }
      }
    }
  }

  // Whether the hull of the piece's corners lies in the solid.
  bool hull_inside() {
    if (piece.size() == 1) return true;
    std::vector<Vec3> points;
    Eigen::AlignedBox3d box;
    double area = 0;
    for (const int v : corners) {
      points.push_back(mesh.vertices[v]);
      box.extend(mesh.vertices[v]);
    }
    for (const int t : piece) {
      const auto& [i, j, k] = mesh.triangles[t];
      area += 0.5 * (mesh.vertices[j] - mesh.vertices[i]).cross(mesh.vertices[k] - mesh.vertices[i]).norm();
    }
    double thickness = 0;
    for (const int v : corners) thickness = std::max(thickness, -height(piece[0], v));
    if (thickness <= kFlatThickness * box.diagonal().norm()) return is_convex_polygon(points, area);
    const std::vector<HullPlane> planes = bounding_planes(points, slack);
    return !grid.any_near(box, [&](int t) {
      if (std::find(piece.begin(), piece.end(), t) != piece.end()) return false;
      const auto& [i, j, k] = mesh.triangles[t];
      return reaches_inside(planes, slack, {mesh.vertices[i], mesh.vertices[j], mesh.vertices[k]});
    });
  }

  // A flat piece is its hull if the areas agree; the hull's area is the volume of the prism of unit height
  // over it.
  bool is_convex_polygon(std::vector<Vec3> points, double area) const {
    const double rise = std::sqrt(area);
    const std::size_t n = points.size();
    for (std::size_t i = 0; i < n; ++i) points.push_back(points[i] + rise * mesh.normals[piece[0]]);
    const auto prism = hull_mesh(points);
    return prism && signed_volume(*prism) <= area * rise * (1 + 1e-9);
  }

  Lists run() {
    Lists pieces;
    for (int seed = 0; seed < static_cast<int>(mesh.triangles.size()); ++seed) {
      if (taken[seed]) continue;
      grow(seed);
      while (!hull_inside()) {  // give up the later half
        const std::vector<int> first_half(piece.begin(),
                                          piece.begin() + static_cast<int>(piece.size() + 1) / 2);
        piece.clear();
        corners.clear();
        for (const int t : first_half) take(t);
      }
      for (const int t : piece) taken[t] = 1;
      pieces.items.insert(pieces.items.end(), piece.begin(), piece.end());
      pieces.start.push_back(static_cast<int>(pieces.items.size()));
    }
    return pieces;
  }
};

}  // namespace

Lists convex_pieces(const FeatureMesh& mesh, const PieceOptions& options) {
  if (mesh.solid) return Decomposition(mesh, options).run();
  Lists each;
  each.items.resize(mesh.triangles.size());
  std::iota(each.items.begin(), each.items.end(), 0);
  for (int t = 1; t <= static_cast<int>(mesh.triangles.size()); ++t) each.start.push_back(t);
  return each;
}

}  // namespace fc::hulls
