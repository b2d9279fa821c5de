// Machine parts and traps: the meshes of chapter 2's hard cases. All are closed and face outward, unless it
// is said otherwise.
#pragma once

#include <functional>
#include <map>

#include "tests/support/test_models.hpp"

namespace fc::test {

using Outline = std::vector<std::array<double, 2>>;  // m, two coordinates of each point

// Columns of points (r, z) about the z axis, `around` of them, joined to a surface. A ring's column is a
// closed outline: up on the outside, down on the inside. If it is no ring, its column goes up, and both ends
// are closed towards the axis.
inline TriangleMesh lathe(int around, bool ring, const std::function<Outline(int)>& column) {
  TriangleMesh mesh;
  const int height = static_cast<int>(column(0).size());
  double bottom = 0, top = 0;
  for (int i = 0; i < around; ++i) {
    const double phi = 2 * std::numbers::pi * i / around;
    const Outline points = column(i);
    for (const auto& [r, z] : points) mesh.vertices.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
    bottom = points.front()[1];
    top = points.back()[1];
  }
  const auto at = [&](int i, int k) { return i % around * height + k % height; };
  for (int i = 0; i < around; ++i)
    for (int k = 0; k < (ring ? height : height - 1); ++k) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  if (ring) return mesh;
  const int low = static_cast<int>(mesh.vertices.size());
  mesh.vertices.emplace_back(0, 0, bottom);
  mesh.vertices.emplace_back(0, 0, top);
  for (int i = 0; i < around; ++i) {
    mesh.triangles.push_back({low, at(i + 1, 0), at(i, 0)});
    mesh.triangles.push_back({low + 1, at(i, height - 1), at(i + 1, height - 1)});
  }
  return mesh;
}

inline TriangleMesh torus(double big, double small, int around, int across) {
  return ring(big, small, around, across);
}
inline TriangleMesh cylinder_mesh(double radius, double length, int around) {
  return lathe(around, false, [&](int) { return Outline{{radius, -length / 2}, {radius, length / 2}}; });
}
// A round plate across z with a round hole; both are regular polygons with a corner on the x axis.
inline TriangleMesh plate_with_hole(double hole, double rim, double thickness, int around) {
  const double h = thickness / 2;
  return lathe(around, true, [&](int) { return Outline{{rim, -h}, {rim, h}, {hole, h}, {hole, -h}}; });
}

// A right-handed thread: the radius depends on z / pitch - phi / (2 pi) alone. `steps` of it make a turn,
// about z as well as along z, so that a screw motion by a step puts the thread onto itself.
struct Thread {
  double radius = 1, depth = 0.2, pitch = 0.6;  // m
  int steps = 16;

  double at(int phase) const {  // a trapezoid: root, flank, crest, flank
    const int k = ((phase % steps) + steps) % steps, quarter = steps / 4;
    if (k < quarter) return radius;
    if (k < 2 * quarter) return radius + depth * (k - quarter) / quarter;
    if (k < 3 * quarter) return radius + depth;
    return radius + depth * (steps - k) / quarter;
  }
};
inline TriangleMesh bolt(const Thread& thread, int turns) {
  return lathe(thread.steps, false, [&](int i) {
    Outline column;
    for (int k = 0; k <= turns * thread.steps; ++k)
      column.push_back({thread.at(k - i), thread.pitch * (double(k) / thread.steps - 0.5 * turns)});
    return column;
  });
}
// The same thread on the inside, wider by the clearance (m). Bolt and nut fit if both have an even number of
// turns, or both an odd one.
inline TriangleMesh nut(const Thread& thread, int turns, double clearance, double rim) {
  return lathe(thread.steps, true, [&](int i) {
    const double h = 0.5 * turns * thread.pitch;
    Outline column{{rim, -h}, {rim, h}};
    for (int k = turns * thread.steps; k >= 0; --k)
      column.push_back(
          {thread.at(k - i) + clearance, thread.pitch * (double(k) / thread.steps - 0.5 * turns)});
    return column;
  });
}

// A spur gear about z: a tooth at angle 0, `teeth` of them; tip and root are the angles in rad that half a
// tooth takes there.
inline TriangleMesh gear(int teeth, double root_radius, double tip_radius, double root, double tip,
                         double height) {
  Outline outline;
  for (int i = 0; i < teeth; ++i)
    for (const auto& [r, side] :
         Outline{{root_radius, -root}, {tip_radius, -tip}, {tip_radius, tip}, {root_radius, root}}) {
      const double phi = 2 * std::numbers::pi * i / teeth + side;
      outline.push_back({r * std::cos(phi), r * std::sin(phi)});
    }
  return prism(outline, {0, 0}, height);
}

// A box whose sides are cut into tiles of two triangles each.
inline TriangleMesh tiled_box(const Vec3& size, const std::array<int, 3>& tiles) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, int> number;
  const auto at = [&](const std::array<int, 3>& c) {
    const auto [place, fresh] = number.try_emplace(c, static_cast<int>(mesh.vertices.size()));
    if (fresh)
      mesh.vertices.emplace_back(size.x() * (double(c[0]) / tiles[0] - 0.5),
                                 size.y() * (double(c[1]) / tiles[1] - 0.5),
                                 size.z() * (double(c[2]) / tiles[2] - 0.5));
    return place->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, tiles[axis]}) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      for (int i = 0; i < tiles[u]; ++i)
        for (int k = 0; k < tiles[v]; ++k) {
          const auto corner = [&](int di, int dk) {
            std::array<int, 3> c{};
            c[axis] = side;
            c[u] = i + di;
            c[v] = k + dk;
            return at(c);
          };
          const int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          if (side > 0)
            mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
          else
            mesh.triangles.insert(mesh.triangles.end(), {{a, c, b}, {a, d, c}});
        }
    }
  return mesh;
}
// Its upper side alone, at z = 0: a surface with a rim.
inline TriangleMesh tiled_floor(double size, int tiles) {
  TriangleMesh mesh;
  for (int i = 0; i <= tiles; ++i)
    for (int k = 0; k <= tiles; ++k)
      mesh.vertices.emplace_back(size * (double(i) / tiles - 0.5), size * (double(k) / tiles - 0.5), 0);
  const auto at = [&](int i, int k) { return i * (tiles + 1) + k; };
  for (int i = 0; i < tiles; ++i)
    for (int k = 0; k < tiles; ++k) {
      mesh.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      mesh.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return mesh;
}

inline TriangleMesh moved_by(TriangleMesh mesh, const Vec3& shift) {
  for (Vec3& v : mesh.vertices) v += shift;
  return mesh;
}
// x becomes y, y becomes z, z becomes x: what was drawn in (x, y) now stands upright in (y, z), along x.
inline TriangleMesh upright(TriangleMesh mesh) {
  for (Vec3& v : mesh.vertices) v = Vec3(v.z(), v.x(), v.y());
  return mesh;
}
// Points down, its tip at the origin.
inline TriangleMesh spike(double radius, double height, int sides) {
  TriangleMesh mesh;
  for (int i = 0; i < sides; ++i) {
    const double phi = 2 * std::numbers::pi * (i + 0.5) / sides;
    mesh.vertices.emplace_back(radius * std::cos(phi), radius * std::sin(phi), height);
  }
  mesh.vertices.emplace_back(0, 0, 0);
  mesh.vertices.emplace_back(0, 0, height);
  for (int i = 0; i < sides; ++i) {
    const int k = (i + 1) % sides;
    mesh.triangles.push_back({sides, k, i});
    mesh.triangles.push_back({sides + 1, i, k});
  }
  return mesh;
}
// Its edge points down and lies along x through the origin.
inline TriangleMesh wedge(double half_width, double height, double length) {
  return upright(prism({{0, 0}, {half_width, height}, {-half_width, height}}, {0, 0.6 * height}, length));
}
// A block with a V-shaped crack along x in its upper side z = 0; the crack's bottom is at (y, z) = (0,
// -depth).
inline TriangleMesh crack(double half_width, double depth, double size) {
  const double s = size / 2;
  return upright(
      prism({{-s, -size}, {s, -size}, {s, 0}, {half_width, 0}, {0, -depth}, {-half_width, 0}, {-s, 0}},
            {0, -0.5 * (size + depth)}, size));
}
// A floor z = 0 with a wall that rises at x = 0 from it, on the side x > 0; 4 wide in y.
inline TriangleMesh floor_and_wall(double length, double height) {
  return upright(upright(
      prism({{-1, -length}, {0, -length}, {0, 0}, {height, 0}, {height, 1}, {-1, 1}}, {-0.5, 0.5}, 4)));
}

}  // namespace fc::test
