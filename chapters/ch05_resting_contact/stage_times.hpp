// Where the time of a frame goes, besides chapter 4's stages.
#pragma once

#include "common/stopwatch.hpp"

namespace fc::resting {

struct StageTimes {
  std::int64_t contacts_ns = 0;     // the contacts of islands are searched
  std::int64_t solver_ns = 0;       // impulses: of instants, plans and piles
  std::int64_t instants_ns = 0;     // of solver_ns: of instants
  std::int64_t corrections_ns = 0;  // of gaps
  std::int64_t proofs_ns = 0;       // of paths, and their shortening

  void add(const StageTimes& more) {
    contacts_ns += more.contacts_ns;
    solver_ns += more.solver_ns;
    instants_ns += more.instants_ns;
    corrections_ns += more.corrections_ns;
    proofs_ns += more.proofs_ns;
  }
};

}  // namespace fc::resting
