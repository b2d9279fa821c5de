// The hierarchy of hulls with other volumes, other leaves, or fewer points: what the study compares.
#pragma once

#include <ostream>
#include <string>

#include "ch02_hull_hierarchy/hull_model.hpp"

namespace fc::hulls {

// Every volume is a few points and a radius that rounds their hull, so GJK knows all of them.
enum class Volume {
  sphere,        // one point
  swept_sphere,  // two: a capsule
  box,           // eight: along the principal axes of what it holds
  hull           // the hull's points
};
enum class Leaves { pieces, triangles };
const char* name_of(Volume volume);
inline std::ostream& operator<<(std::ostream& out, Volume volume) {
  return out << name_of(volume);
}
const char* name_of(Leaves leaves);
inline std::ostream& operator<<(std::ostream& out, Leaves leaves) {
  return out << name_of(leaves);
}

struct StudyTreeOptions {
  Volume volume = Volume::hull;
  Leaves leaves = Leaves::pieces;
  int most_points = 1'000'000;  // of an inner node's hull (>= 4)
};

// The tree of `pieces` (of Leaves::pieces; else the triangles are the leaves, split alike), its inner nodes
// in other volumes. Leaves stay exact, and each node keeps the ball that the motion bounds need: from volume
// to volume only the gap differs. A hull of too many points keeps those that are farthest along `most_points`
// directions, and is rounded by how far the others stand out.
HullModel build_study_model(const Model& model, const Lists& pieces, const StudyTreeOptions& options);

// How far a node's volume reaches along a unit direction beyond what it contains (m, >= 0).
double overhang(const HullModel& volumes, const HullModel& hulls, int node, const Vec3& direction);

// The principal direction along which points extend least: across a patch of a surface.
Vec3 thin_direction(std::span<const Vec3> points);

// `count` directions, evenly spread over the sphere (a spiral).
std::vector<Vec3> even_directions(int count);

}  // namespace fc::hulls
