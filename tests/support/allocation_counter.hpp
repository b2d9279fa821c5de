// Counts what a program takes from the heap. Link allocation_counter.cpp into the test: it replaces operator
// new.
#pragma once

#include <cstdint>

namespace fc::test {

// How often operator new was called by this thread, since it began.
std::int64_t allocations();

}  // namespace fc::test
