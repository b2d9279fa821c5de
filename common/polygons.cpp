// Polygons into triangles, by cutting off ears.
#include "common/polygons.hpp"

#include <cstddef>
#include <utility>

namespace fc {
namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The polygon seen along its own (Newell's) normal, counter-clockwise.
std::vector<Vec2> flattened(const std::vector<Vec3>& vertices, const int* corners, int size) {
  const Vec3 origin = vertices[corners[0]];
  Vec3 normal = Vec3::Zero();
  for (int i = 0; i < size; ++i) {
    normal += (vertices[corners[i]] - origin).cross(vertices[corners[(i + 1) % size]] - origin);
  }
  int drop = 0;  // leaving out the coordinate along which the normal is longest keeps the shape, sheared
  normal.cwiseAbs().maxCoeff(&drop);
  const int u = (drop + 1) % 3, w = (drop + 2) % 3;
  const double mirror = normal[drop] < 0 ? -1 : 1;
  std::vector<Vec2> flat;
  for (int i = 0; i < size; ++i) {
    const Vec3 p = vertices[corners[i]] - origin;
    flat.emplace_back(p[u], mirror * p[w]);
  }
  return flat;
}

bool inside_or_on(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

// Whether the corner `at` of the remaining ring sticks out, with no other corner in its triangle. An ear has
// area: cutting a corner off a straight side would leave a triangle of area zero, and a gap beside it.
bool is_ear(const std::vector<Vec2>& flat, const std::vector<int>& ring, std::size_t at) {
  const std::size_t n = ring.size();
  const Vec2 &a = flat[ring[(at + n - 1) % n]], &b = flat[ring[at]], &c = flat[ring[(at + 1) % n]];
  if (!(cross(b - a, c - a) > 0)) return false;
  for (std::size_t k = 2; k + 1 < n; ++k) {
    const Vec2& p = flat[ring[(at + k) % n]];
    if (p == a || p == b || p == c) continue;  // a bridge to an inner rim passes the same point twice
    if (inside_or_on(p, a, b, c)) return false;
  }
  return true;
}

void split(const std::vector<Vec3>& vertices, const int* corners, int size, TriangleMesh& mesh) {
  if (size == 3) {
    mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  const std::vector<Vec2> flat = flattened(vertices, corners, size);
  std::vector<int> ring(size);
  for (int i = 0; i < size; ++i) ring[i] = i;
  const auto cut = [&](std::size_t at) {
    const std::size_t n = ring.size();
    mesh.triangles.push_back(
        {corners[ring[(at + n - 1) % n]], corners[ring[at]], corners[ring[(at + 1) % n]]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
  };
  std::size_t at = 1, without_ear = 0;
  while (ring.size() > 3) {
    at %= ring.size();
    if (is_ear(flat, ring, at)) {
      cut(at);
      without_ear = 0;
    } else if (++without_ear > ring.size()) {
      at = 1;  // it crosses itself, or has no area: any splitting is as good
      cut(at);
      without_ear = 0;
    } else {
      ++at;
    }
  }
  cut(1);
}

}  // namespace

TriangleMesh triangulate(PolygonSoup soup) {
  TriangleMesh mesh;
  mesh.triangles.reserve(soup.sizes.size());
  const int* corners = soup.corners.data();
  for (int size : soup.sizes) {
    split(soup.vertices, corners, size, mesh);
    corners += size;
  }
  mesh.vertices = std::move(soup.vertices);
  return mesh;
}

}  // namespace fc
