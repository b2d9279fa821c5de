// The options and the result of a continuous collision query, for shapes of any kind (chapters 1 and 2,
// contract 1.5).
#pragma once

#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "ch01_convex_advancement/motion_bound.hpp"
#include "common/types.hpp"

namespace fc::ca {

enum class Status {
  contact,               // gap_upper <= tolerance at toc
  separated,             // proved clear for the whole interval
  touching_at_start,     // the gap at t = 0 is at most the tolerance, and no overlap is deeper than the
                         // tolerance
  penetrating_at_start,  // the bodies overlap at t = 0 by more than the tolerance, as far as could be proved
  unresolved             // a limit was reached: proved clear until toc, nothing is known after it
};
const char* name_of(Status status);
inline std::ostream& operator<<(std::ostream& out, Status status) {
  return out << name_of(status);
}

enum class FeatureKind { vertex, edge, face };
const char* name_of(FeatureKind kind);
inline std::ostream& operator<<(std::ostream& out, FeatureKind kind) {
  return out << name_of(kind);
}

// One pair of features that are in contact, or nearest to it.
struct FeaturePair {
  Vec3 point_a = Vec3::Zero();  // m, world, on A's surface
  Vec3 point_b = Vec3::Zero();  // m, world, on B's surface
  Vec3 normal = Vec3::UnitX();  // unit, from A to B
  double gap = 0;               // m, along the normal
  FeatureKind kind_a = FeatureKind::vertex, kind_b = FeatureKind::vertex;
  int id_a = 0, id_b = 0;  // the vertex, edge or face (triangle) of the core's mesh; see the caller's text
};

// One advance: at time t the pair has at least gap_lower along `normal`, and h seconds later at least
// gap_lower - speed_bound h, for every h up to `advance`. Hence it is clear during that time: speed_bound *
// advance < gap_lower.
struct CertificateRow {
  double t;  // s
  Vec3 normal;
  double gap_lower;    // m
  double speed_bound;  // m/s
  double advance;      // s
};

// Leaves of A's hierarchy against leaves of B's (chapter 2): first_a ... first_a + count_a - 1, and so for B.
struct LeafBlock {
  int first_a, count_a, first_b, count_b;
};

struct AdvanceOptions {
  double interval = 1;      // s, the query is about t in [0, interval]
  double tolerance = 1e-6;  // m: `contact` means that the witness points are at most this far apart
  MotionBound bound = MotionBound::second_order;
  int max_iterations = 1'000'000;
  bool certificate = false;  // record every advance
  bool features = true;  // find all features in contact (chapter 2; chapter 1 has the witness points anyway)
  bool end_distance = true;  // where nothing was hit, find the distance at the end (chapter 2); if false,
                             // gap_lower is what the search has proved, and gap_upper infinite
  bool warm_start = true;    // GJK begins with the simplex of the pose before (chapter 1)
};

// Both throw std::invalid_argument for an interval or a tolerance that is negative or not finite; check_query
// also for a motion that is not finite.
void check_options(const AdvanceOptions& options);
void check_query(const Motion& a, const Motion& b, const AdvanceOptions& options);

struct AdvanceResult {
  Status status = Status::unresolved;
  double toc = 0;               // s, in [0, interval]; never later than the true first contact
  double gap_lower = 0;         // m, certified, at toc; negative if the start overlaps
  double gap_upper = 0;         // m, distance of the witness points at toc
  double tolerance = 0;         // m, as used: raised to 8 rounding terms where it was smaller
  std::int64_t iterations = 0;  // advances
  std::int64_t distance_calls = 0;
  std::int64_t gjk_iterations = 0;    // of all distance calls (chapter 1)
  std::int64_t node_pairs = 0;        // 1 for two convex bodies
  std::vector<FeaturePair> features;  // at toc, if status is contact or touching_at_start
  std::vector<CertificateRow> certificate;
  std::vector<LeafBlock>
      certificate_leaves;  // chapter 2: what each row is about; chapter 1: none, the whole bodies

  void clear();  // for the next query; keeps the storage
};

}  // namespace fc::ca
