// Contact patches at a frame's start, and the paths of the first plans, drawn.
#pragma once

#include "ch05_resting_contact/contacts.hpp"
#include "common/algorithm.hpp"

namespace fc::resting {

struct PatchPoint {
  Vec3 on_a = Vec3::Zero(), on_b = Vec3::Zero(), normal = Vec3::Zero();  // m, world; unit, from A to B
  double gap = 0;                                                        // m
};
// Two bodies in contact.
struct PatchOfPair {
  int a = 0, b = 0;
  double gap = 0;  // m, certified
  std::vector<PatchPoint> points;
};
// All pairs nearer than the margin (m), in the order of their bodies; the world is between two frames.
std::vector<PatchOfPair> patches_now(const world::World& world, double margin);

// Which test proves that two bodies keep apart.
enum class Proof { speed, planes, advancement, none };
struct PathProof {
  int a = 0, b = 0;
  Proof proof = Proof::none;
  double slack = 0;  // m, by which the gap stays above what is required, as far as it is proved
};
// For pairs of bodies with plans, and of these with bodies that cannot be moved, as they stand in `bodies` at their times; `end`:
// s in the frame. In the order in which check_path() tries the tests.
std::vector<PathProof> proofs_of(const world::World& world, const std::vector<world::Body>& bodies,
                                 double end, double margin);

std::vector<algorithm::Step> show_paths(const world::World& world, const std::vector<world::Body>& bodies,
                                        double end, double margin, double t0);

}  // namespace fc::resting
