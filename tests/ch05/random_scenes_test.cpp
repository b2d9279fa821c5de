// Thousands of random scenes with an envelope: see random_scenes.hpp.
#include "random_scenes.hpp"

TEST(RandomScenes, KeepTheLaws) {
  fc_test::expect_laws_kept(fc_test::kScenes, 5, {}, {});
}
