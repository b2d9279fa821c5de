// The queries of bench_ch02: two bunnies, the same for every engine, and the same as in the chapter's study.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "ch02_hull_hierarchy/advance.hpp"
#include "ch02_hull_hierarchy/study/mesh.hpp"
#include "ch02_hull_hierarchy/study/motions.hpp"

namespace fc::bench {

using hulls::coarser;
using hulls::size_of;
using BunnyPair = hulls::MotionPair;
using BunnyPairs = hulls::StudyMotions;

inline Shape bunny_shape() {
  return hulls::mesh_shape(hulls::kBunny);
}

}  // namespace fc::bench
