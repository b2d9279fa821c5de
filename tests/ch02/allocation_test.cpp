// What a search takes from the heap: nothing, once its memory has grown.
#include "tests/support/allocation_counter.hpp"

#include <gtest/gtest.h>

#include "ch02_hull_hierarchy/advance.hpp"
#include "tests/support/test_models.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;
using namespace fc::test;

TEST(MeshAllocation, ASearchTakesNothingFromTheHeap) {
  Random random(23);
  const Model a = model_of(bumpy_ball(random, 14)), b = model_of(ring(1, 0.3, 24, 9)),
              c = model_of(capsule(0.2, 1));
  SearchMemory memory;
  ca::AdvanceResult result;
  ca::AdvanceOptions options;
  options.features = options.end_distance = false;
  int hits = 0;
  for (int round = 0; round < 60; ++round) {
    const Vec3 from = 3 * unit_vector(random), aim = unit_vector(random);
    const ca::Motion ma = motion(Vec3::Zero(), rotation(random), Vec3::Zero(), 2 * unit_vector(random));
    const ca::Motion mb = motion(from, rotation(random), aim - from, 2 * unit_vector(random));
    const Model& other = round % 2 ? b : c;
    for (const bool warm : {false, true}) {
      const std::int64_t before = allocations();
      advance(a, ma, other, mb, options, memory, result);
      if (warm) {
        EXPECT_EQ(allocations() - before, 0) << "query " << round;
      }
    }
    hits += result.status == ca::Status::contact;
  }
  EXPECT_GT(hits, 20);
}

}  // namespace
