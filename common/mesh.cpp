// Finds what is wrong with a mesh, and prepares it: merges vertices, removes triangles, counts edges,
// reverses what faces the wrong way.
#include "common/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "common/exact_collinear.hpp"
#include "common/mesh_overlap.hpp"

namespace fc {
namespace {

using Triangle = std::array<int, 3>;

struct PositionHash {
  std::size_t operator()(const Vec3& p) const {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double coordinate = p[axis] + 0.0;  // -0 becomes 0: equal positions must hash alike
      std::uint64_t bits = 0;
      std::memcpy(&bits, &coordinate, sizeof bits);
      hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;  // Fibonacci hashing
      hash ^= hash >> 29;
    }
    return hash;
  }
};

// Sets that merge ("union-find"); a set is named by one of its members.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(int i, int j) { parent_[find(i)] = find(j); }

 private:
  std::vector<int> parent_;
};

// Triangles joined over edges of two. Each has a side: whether it faces like the triangle that names its set,
// or against it. The smaller set joins the larger one, which keeps the paths to the name short.
class Sides {
 public:
  explicit Sides(std::size_t count) : up_(count), against_(count, 0), size_(count, 1), torn_(count, false) {
    std::iota(up_.begin(), up_.end(), 0);
  }
  void join(int i, int j, bool opposed) {
    auto [name, side_i] = find(i);
    auto [other, side_j] = find(j);
    const int side = side_i ^ side_j ^ static_cast<int>(opposed);
    if (name == other) {
      torn_[name] = torn_[name] || side != 0;
      return;
    }
    if (size_[name] < size_[other]) std::swap(name, other);
    up_[other] = name;
    against_[other] = side;
    size_[name] += size_[other];
    torn_[name] = torn_[name] || torn_[other];
  }
  // How many triangles face against most of their set, and how many sets cannot be oriented at all.
  std::pair<int, int> flipped_and_one_sided() const {
    std::vector<int> opposed(up_.size(), 0);
    for (int i = 0; i < static_cast<int>(up_.size()); ++i) {
      const auto [name, side] = find(i);
      opposed[name] += side;
    }
    int flipped = 0, one_sided = 0;
    for (int i = 0; i < static_cast<int>(up_.size()); ++i) {
      if (up_[i] != i) continue;
      if (torn_[i])
        ++one_sided;
      else
        flipped += std::min(opposed[i], size_[i] - opposed[i]);
    }
    return {flipped, one_sided};
  }

 private:
  std::pair<int, int> find(int i) const {  // the name of its set, and 1 if it faces against that one
    int side = 0;
    for (; up_[i] != i; i = up_[i]) side ^= against_[i];
    return {i, side};
  }

  std::vector<int> up_, against_, size_;  // size_ and torn_: of the one that names a set
  std::vector<bool> torn_;
};

// The triangles with each corner replaced by the first vertex at the same position.
std::vector<Triangle> merge_equal_positions(const TriangleMesh& mesh) {
  std::unordered_map<Vec3, int, PositionHash> first_at;
  first_at.reserve(mesh.vertices.size());
  std::vector<int> first(mesh.vertices.size());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    first[i] = first_at.try_emplace(mesh.vertices[i], static_cast<int>(i)).first->second;
  }
  std::vector<Triangle> triangles = mesh.triangles;
  for (Triangle& t : triangles) {
    for (int& corner : t) corner = first[corner];
  }
  return triangles;
}

// Whether two triangles with the same corners go round the same way.
bool same_way(const Triangle& t, const Triangle& u) {
  const auto at = std::find(u.begin(), u.end(), t[0]) - u.begin();
  return u[(at + 1) % 3] == t[1];
}

// Removes triangles whose three corners an earlier one has already, round the same way or, if `opposed`,
// either way; returns how many.
int remove_duplicates(std::vector<Triangle>& triangles, bool opposed) {
  struct Key {
    Triangle corners;  // ascending
    bool backward;
    int index;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Triangle ascending = triangles[i];
    std::sort(ascending.begin(), ascending.end());
    keys[i] = {ascending, !opposed && !same_way(ascending, triangles[i]), static_cast<int>(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<bool> remove(triangles.size(), false);
  for (std::size_t k = 1; k < keys.size(); ++k)
    remove[keys[k].index] =
        keys[k].corners == keys[k - 1].corners && keys[k].backward == keys[k - 1].backward;
  std::size_t i = 0;
  return static_cast<int>(std::erase_if(triangles, [&](const Triangle&) { return remove[i++]; }));
}

bool two_equal_corners(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

// Zero area: exactly collinear corners, or so thin that the normal computed in doubles vanishes.
bool without_area(const TriangleMesh& mesh, const Triangle& t) {
  const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
  return (b - a).cross(c - a).isZero(0) || exactly_collinear(a, b, c);
}

// What the edges say about a set of triangles.
struct Topology {
  int boundary_edges = 0, holes = 0, nonmanifold_edges = 0, flipped_edges = 0;
  int flipped_triangles = 0, one_sided = 0;
  bool closed = true;  // each edge is used as often in one direction as in the other
  int components = 0;
  std::vector<int> component;  // of each triangle
};

struct EdgeUse {
  int low, high;  // vertices, low < high
  int triangle;
  bool forward;  // the triangle runs from low to high
};

std::vector<EdgeUse> sorted_edges(const std::vector<Triangle>& triangles) {
  std::vector<EdgeUse> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const int from = triangles[t][i], to = triangles[t][(i + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), static_cast<int>(t), from < to});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return edges;
}

Topology examine(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  Topology result;
  const std::vector<EdgeUse> edges = sorted_edges(triangles);
  Sets components(triangles.size()), rims(vertex_count);
  Sides sides(triangles.size());
  std::vector<int> on_boundary;  // one vertex of each boundary edge
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    const EdgeUse& edge = edges[begin];
    int uses = 0, forward = 0;
    for (; end < edges.size() && edges[end].low == edge.low && edges[end].high == edge.high; ++end) {
      ++uses;
      forward += edges[end].forward;
      components.join(edges[end].triangle, edge.triangle);
    }
    result.closed = result.closed && 2 * forward == uses;
    result.nonmanifold_edges += uses > 2;
    result.flipped_edges += uses == 2 && forward != 1;
    if (uses == 2) sides.join(edge.triangle, edges[end - 1].triangle, forward != 1);
    if (uses == 1) {
      ++result.boundary_edges;
      rims.join(edge.low, edge.high);
      on_boundary.push_back(edge.low);
    }
  }
  for (int& v : on_boundary) v = rims.find(v);
  std::sort(on_boundary.begin(), on_boundary.end());
  result.holes = static_cast<int>(std::unique(on_boundary.begin(), on_boundary.end()) - on_boundary.begin());

  std::tie(result.flipped_triangles, result.one_sided) = sides.flipped_and_one_sided();

  std::vector<int> number(triangles.size(), -1);  // of the component that a triangle names
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    int& n = number[components.find(static_cast<int>(t))];
    if (n < 0) n = result.components++;
    result.component.push_back(n);
  }
  return result;
}

// One closed component's signed volume, how much of that may be rounding, and its bounding box.
struct Part {
  double volume = 0;    // m^3
  double rounding = 0;  // m^3
  Eigen::AlignedBox3d box;
};

std::vector<Part> measure_parts(const TriangleMesh& mesh, const Topology& topology) {
  std::vector<Part> parts(topology.components);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int v : mesh.triangles[t]) parts[topology.component[t]].box.extend(mesh.vertices[v]);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Part& part = parts[topology.component[t]];
    const Vec3 o = part.box.center();
    const auto& [i, j, k] = mesh.triangles[t];
    const Vec3 a = mesh.vertices[i] - o, b = mesh.vertices[j] - o, c = mesh.vertices[k] - o;
    part.volume += a.dot(b.cross(c)) / 6;
    part.rounding += 8 * std::numeric_limits<double>::epsilon() * a.norm() * b.norm() * c.norm();
  }
  return parts;
}

// Which components face inwards although they bound no cavity (the rule stands at prepare_mesh).
std::vector<bool> components_to_turn(std::vector<Part> parts) {
  const double total = std::accumulate(parts.begin(), parts.end(), 0.0,
                                       [](double sum, const Part& part) { return sum + part.volume; });
  std::vector<bool> turn(parts.size(), total < 0);
  if (total < 0) {
    for (Part& part : parts) part.volume = -part.volume;
  }
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].volume >= 0) continue;
    const bool perhaps_a_cavity = std::any_of(parts.begin(), parts.end(), [&](const Part& other) {
      return other.volume > 0 && other.box.contains(parts[i].box);
    });
    if (!perhaps_a_cavity) turn[i] = !turn[i];
  }
  return turn;
}

// Decides whether a closed mesh is a solid, and turns it the right way round. True if it has an inside.
bool orient_solid(TriangleMesh& mesh, const Topology& topology, MeshReport& report) {
  const std::vector<Part> parts = measure_parts(mesh, topology);
  // A closed surface that is folded flat encloses nothing.
  const bool encloses = std::any_of(parts.begin(), parts.end(),
                                    [](const Part& part) { return std::abs(part.volume) > part.rounding; });
  if (!encloses) return false;
  const std::vector<bool> turn = components_to_turn(parts);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (turn[topology.component[t]]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  report.reversed_components = static_cast<int>(std::count(turn.begin(), turn.end(), true));
  report.inside_out = report.reversed_components > 0;
  return signed_volume(mesh) > 0;
}

void drop_unused_vertices(TriangleMesh& mesh) {
  std::vector<int> renumbered(mesh.vertices.size(), -1);
  for (const Triangle& t : mesh.triangles) {
    for (int v : t) renumbered[v] = 0;
  }
  int kept = 0;
  for (std::size_t v = 0; v < renumbered.size(); ++v) {
    if (renumbered[v] < 0) continue;
    mesh.vertices[kept] = mesh.vertices[v];
    renumbered[v] = kept++;
  }
  mesh.vertices.resize(kept);
  for (Triangle& t : mesh.triangles) {
    for (int& v : t) v = renumbered[v];
  }
}

}  // namespace

PreparedMesh prepare_mesh(const TriangleMesh& mesh) {
  PreparedMesh result{mesh, {}};
  TriangleMesh& out = result.mesh;
  MeshReport& report = result.report;
  out.triangles = merge_equal_positions(mesh);
  report.degenerate_triangles = static_cast<int>(std::erase_if(out.triangles, two_equal_corners));
  report.duplicate_triangles = remove_duplicates(out.triangles, false);
  // Both sides of a wall between two parts of a solid stay; a sheet with two sides is one sheet.
  if (!examine(out.triangles, out.vertices.size()).closed)
    report.duplicate_triangles += remove_duplicates(out.triangles, true);

  // A triangle on one line has no area, but it may join a long edge to two short ones: it still counts for
  // the edges.
  const Topology topology = examine(out.triangles, out.vertices.size());
  report.boundary_edges = topology.boundary_edges;
  report.holes = topology.holes;
  report.nonmanifold_edges = topology.nonmanifold_edges;
  report.flipped_edges = topology.flipped_edges;
  report.flipped_triangles = topology.flipped_triangles;
  report.one_sided = topology.one_sided;
  report.components = topology.components;
  report.solid = topology.closed && !out.triangles.empty() && orient_solid(out, topology, report);
  if (report.solid) report.overlapping = count_overlapping(out, topology.component, topology.components);

  report.degenerate_triangles +=
      static_cast<int>(std::erase_if(out.triangles, [&](const Triangle& t) { return without_area(out, t); }));
  drop_unused_vertices(out);
  report.vertices = static_cast<int>(out.vertices.size());
  report.triangles = static_cast<int>(out.triangles.size());
  report.merged_vertices = static_cast<int>(mesh.vertices.size() - out.vertices.size());
  return result;
}

}  // namespace fc
