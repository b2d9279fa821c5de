// Random numbers for RapidCheck properties.
#pragma once

#include <rapidcheck/gtest.h>

#include <random>

namespace fc::test {

// A generator of numbers that RapidCheck chose: a failing case shrinks to its seed.
inline std::mt19937_64 random_engine() {
  return std::mt19937_64(*rc::gen::inRange<std::uint64_t>(0, 1'000'000));
}

}  // namespace fc::test
