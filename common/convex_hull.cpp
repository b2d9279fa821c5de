#include "common/convex_hull.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "common/polygons.hpp"

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace fc {
namespace {

// Qhull insists on a stream for its messages; this one discards them.
FILE* silence() {
  static const std::unique_ptr<FILE, int (*)(FILE*)> sink(
      std::fopen("/dev/null", "w"), [](FILE* file) { return file ? std::fclose(file) : 0; });
  return sink ? sink.get() : stderr;
}

// One run of Qhull. The points are moved and scaled into the unit cube first, because Qhull's own rounding
// estimates grow with the largest coordinate; indices are unaffected.
class QhullRun {
 public:
  QhullRun(std::span<const Vec3> points, const char* options) {
    Eigen::AlignedBox3d box;
    for (const Vec3& p : points) box.extend(p);
    const Vec3 middle = box.center();
    const double size = box.sizes().maxCoeff();
    coordinates_.reserve(3 * points.size());
    for (const Vec3& p : points) {
      for (int axis = 0; axis < 3; ++axis) coordinates_.push_back((p[axis] - middle[axis]) / size);
    }
    qh_zero(&qh_, silence());
    char command[32];
    std::snprintf(command, sizeof command, "qhull %s", options);
    const int code = qh_new_qhull(&qh_, 3, static_cast<int>(points.size()), coordinates_.data(), False,
                                  command, nullptr, silence());
    succeeded_ = code == qh_ERRnone;
  }
  ~QhullRun() {
    qh_freeqhull(&qh_, !qh_ALL);
    int still_in_use = 0, bytes = 0;
    qh_memfreeshort(&qh_, &still_in_use, &bytes);
  }
  QhullRun(const QhullRun&) = delete;
  QhullRun& operator=(const QhullRun&) = delete;

  bool succeeded() const { return succeeded_; }

  std::vector<int> vertices() {
    std::vector<int> indices;
    vertexT* vertex;
    for (vertex = qh_.vertex_list; vertex && vertex->next; vertex = vertex->next) {
      indices.push_back(qh_pointid(&qh_, vertex->point));
    }
    std::sort(indices.begin(), indices.end());
    return indices;
  }

  // The facets, coplanar ones merged, as polygons whose corners are indices of points, counter-clockwise seen
  // from outside. Empty if the rim of a merged facet is not one ring.
  std::optional<PolygonSoup> facets() {
    PolygonSoup soup;
    for (facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next) {
      const std::vector<int> corners = facet->simplicial ? simplex_corners(facet) : ring_corners(facet);
      if (corners.size() < 3) return std::nullopt;
      soup.corners.insert(soup.corners.end(), corners.begin(), corners.end());
      soup.sizes.push_back(static_cast<int>(corners.size()));
    }
    return soup;
  }

 private:
  int id(void* vertex) { return qh_pointid(&qh_, static_cast<vertexT*>(vertex)->point); }

  // Qhull sorts a facet's vertices by their age; `toporient` says which way round that is.
  std::vector<int> simplex_corners(facetT* facet) {
    std::vector<int> corners;
    for (int i = 0; i < qh_setsize(&qh_, facet->vertices); ++i)
      corners.push_back(id(facet->vertices->e[i].p));
    if (facet->toporient && corners.size() == 3) std::swap(corners[1], corners[2]);
    return corners;
  }

  // A merged facet's rim consists of ridges, in no order: each leads from one corner to the next.
  std::vector<int> ring_corners(facetT* facet) {
    std::map<int, int> next;
    const int ridges = qh_setsize(&qh_, facet->ridges);
    for (int i = 0; i < ridges; ++i) {
      auto* ridge = static_cast<ridgeT*>(facet->ridges->e[i].p);
      int from = id(ridge->vertices->e[0].p), to = id(ridge->vertices->e[1].p);
      if (ridge->top == facet) std::swap(from, to);
      next[from] = to;
    }
    std::vector<int> corners;
    if (static_cast<int>(next.size()) != ridges || ridges < 3) return {};
    int at = next.begin()->first;
    do {
      corners.push_back(at);
      const auto step = next.find(at);
      if (step == next.end()) return {};
      at = step->second;
    } while (at != corners.front() && static_cast<int>(corners.size()) < ridges);
    return at == corners.front() && static_cast<int>(corners.size()) == ridges ? corners : std::vector<int>{};
  }

  qhT qh_;
  std::vector<double> coordinates_;
  bool succeeded_ = false;
};

// Each directed edge once, and each with its opposite: closed and consistently oriented.
bool is_closed(const std::vector<std::array<int, 3>>& triangles) {
  std::map<std::pair<int, int>, int> uses;
  for (const auto& t : triangles) {
    for (int i = 0; i < 3; ++i) ++uses[{t[i], t[(i + 1) % 3]}];
  }
  return std::all_of(uses.begin(), uses.end(), [&](const auto& edge) {
    return edge.second == 1 && uses.contains({edge.first.second, edge.first.first});
  });
}

// The mesh of these triangles with only the points that they use, in the order of `points`.
TriangleMesh compact(std::span<const Vec3> points, std::vector<std::array<int, 3>> triangles) {
  std::vector<int> renumbered(points.size(), -1);
  for (const auto& t : triangles) {
    for (int i : t) renumbered[i] = 0;
  }
  TriangleMesh mesh;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (renumbered[i] < 0) continue;
    renumbered[i] = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(points[i]);
  }
  for (auto& t : triangles) {
    for (int& i : t) i = renumbered[i];
  }
  mesh.triangles = std::move(triangles);
  return mesh;
}

// The facets as a mesh, if it is closed and no triangle faces inward.
std::optional<TriangleMesh> convex_mesh(std::span<const Vec3> points, PolygonSoup facets) {
  facets.vertices.assign(points.begin(), points.end());
  std::vector<std::array<int, 3>> triangles = triangulate(std::move(facets)).triangles;
  if (!is_closed(triangles)) return std::nullopt;
  TriangleMesh mesh = compact(points, std::move(triangles));
  Eigen::AlignedBox3d box;
  for (const Vec3& v : mesh.vertices) box.extend(v);
  const double size = box.sizes().maxCoeff();
  Vec3 inside = Vec3::Zero();
  for (const Vec3& v : mesh.vertices)
    inside += (v - box.center()) / static_cast<double>(mesh.vertices.size());
  inside += box.center();
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
    const Vec3 normal = (b - a).cross(c - a);
    if (normal.dot(inside - a) > kHullRounding * size * size * size) return std::nullopt;
  }
  return signed_volume(mesh) > 0 ? std::optional(std::move(mesh)) : std::nullopt;
}

bool spans_a_volume_perhaps(std::span<const Vec3> points) {
  if (points.size() < 4) return false;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : points) {
    if (!p.allFinite()) return false;
    box.extend(p);
  }
  return (box.sizes().array() > 0).all() && box.sizes().allFinite();
}

}  // namespace

std::vector<int> hull_vertices(std::span<const Vec3> points) {
  if (spans_a_volume_perhaps(points)) {
    QhullRun qhull(points, "Pp");
    if (qhull.succeeded()) return qhull.vertices();
  }
  std::vector<int> all(points.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::optional<TriangleMesh> hull_mesh(std::span<const Vec3> points) {
  if (!spans_a_volume_perhaps(points)) return std::nullopt;
  std::vector<Vec3> corners;
  {
    QhullRun qhull(points, "Pp");
    if (!qhull.succeeded()) return std::nullopt;
    auto facets = qhull.facets();
    if (facets) {
      if (auto mesh = convex_mesh(points, std::move(*facets))) return mesh;
    }
    for (int i : qhull.vertices()) corners.push_back(points[i]);
  }
  // Rounding gave facets that do not fit together. Qhull's joggled input, the corners moved by about their
  // rounding errors, has triangles only, which always fit.
  QhullRun joggled(corners, "QJ Pp");
  if (!joggled.succeeded()) return std::nullopt;
  auto facets = joggled.facets();
  return facets ? convex_mesh(corners, std::move(*facets)) : std::nullopt;
}

}  // namespace fc
