// The first contact of two moving triangle meshes, slowly and reliably: the reference for chapter 2.
//
// Nothing of the library's collision code is used here. A mesh is its triangles (a point and a segment are
// triangles whose corners coincide), each rounded by a ball; poses are quaternions; all in long double. The
// arguments are those of ground_truth.hpp, for triangles:
//
//   a distance   of two triangles: the gap along any direction is a lower bound, the distance of any two
//                points an upper one. Of two meshes: the least over all pairs of triangles. Triangles are in
//                balls and those in larger balls; two balls are apart by their middles' distance less radii.
//   a time       a gap in the middle of an interval proves all of the interval clear for a pair of balls or
//                of triangles, if their points are too slow to use it up. If it proves nothing, balls that
//                are large against their way are opened, and for the pairs that remain the interval is
//                halved.
#pragma once

#include <array>
#include <vector>

#include "support/ground_truth.hpp"

namespace truth {

// A ball around some triangles, or around one.
struct Ball {
  V middle = V::Zero();  // m, body axes, about the centre of mass
  Real radius = 0;       // m
  Real reach = 0;        // m, the largest distance of its triangles' points from the centre of mass
  int left = -1, right = -1;
  int triangle = -1;  // of a ball around one
  bool one() const { return triangle >= 0; }
};

struct MeshShape {
  MeshShape() = default;
  // Vertices in m, body axes, about the centre of mass; `rounding` in m. solid: the surface is closed and
  // oriented, and what lies inside belongs to the body.
  MeshShape(const std::vector<Eigen::Vector3d>& positions, const std::vector<std::array<int, 3>>& corners,
            double rounding, bool has_inside);

  std::vector<V> vertices;
  std::vector<std::array<int, 3>> triangles;
  Real radius = 0;
  bool solid = false;
  Real reach = 0;           // m, without the rounding radius
  std::vector<Ball> balls;  // the first one holds everything
  std::vector<int> parts;   // a vertex of every connected part
};

struct MeshBody {
  const MeshShape* shape = nullptr;
  Flight flight;
};

using Triangle = std::array<V, 3>;
// The distance of two triangles, each of which may be a segment or a point; 0 if they cross. `noise` (m): how
// well the corners are known.
Gap triangle_gap(const Triangle& a, const Triangle& b, Real noise);

enum class Search { balls, every_pair };
// The distance of the two surfaces at time t (s), less the rounding radii. Inside or outside does not count.
Gap gap(const MeshBody& a, const MeshBody& b, Real t, Search search = Search::balls);

// How far one of them would have to be moved at least to end the overlap of the two triangles that overlap
// most, m; 0: none overlap. Overlaps of solids can be deeper than this, not less deep.
Real depth(const MeshBody& a, const MeshBody& b, Real t);

// Whether the distance is larger than `level` (m) during all of [from, to] (s).
struct Clear {
  enum class Verdict {
    clear,     // it is
    hit,       // it is not: at `time` it is at most `level`
    undecided  // proved until `time`
  };
  Verdict verdict = Verdict::undecided;
  Real time = 0;            // s
  std::int64_t looks = 0;   // pairs of balls and of triangles
  std::int64_t halved = 0;  // intervals
};
Clear clear_between(const MeshBody& a, const MeshBody& b, Real from, Real to, Real level,
                    std::int64_t most_looks = 20'000'000);

// How often a closed surface winds around a point (m, body axes): 1 inside, 0 outside and in a cavity.
Real windings(const MeshShape& shape, const V& point);

// Whether at time t a part of one lies inside the other one's solid, for surfaces that do not cross.
bool one_inside_other(const MeshBody& a, const MeshBody& b, Real t);

}  // namespace truth
