#include "ch05_resting_contact/work_budget.hpp"

#include <algorithm>
#include <utility>

namespace fc::resting {
namespace {

// An island stands if its bodies are slower than this part of the rest speed.
constexpr double kStands = 1e-3;

// How long an island is a pile after it has spent its budget, at first and at most.
constexpr int kLeastFrames = 8, kMostFrames = 64;

}  // namespace

void WorkBudget::next_frame() {
  for (Account& account : bodies_) {
    account.work = 0;
    if (std::exchange(account.spent, false))
      account.waits = account.waited = std::clamp(2 * account.waited, kLeastFrames, kMostFrames);
    else if (account.waits > 0)
      --account.waits;
    else
      account.waited = 0;
  }
}

void WorkBudget::add(const Island& island, double work, double most, double rest_speed) {
  const bool stands = std::all_of(island.members.begin(), island.members.end(), [&](const Member& member) {
    return !member.dynamic || member.state.velocity.norm() < kStands * rest_speed;
  });
  for (const Member& member : island.members) {
    if (!member.dynamic) continue;
    Account& account = bodies_[at(member.number)];
    account.work += work;
    account.spent = account.work > most && !stands;
  }
}

bool WorkBudget::is_spent(const Island& island) const {
  return std::any_of(island.members.begin(), island.members.end(), [&](const Member& member) {
    const Account& account = bodies_[at(member.number)];
    return member.dynamic && (account.spent || account.waits > 0);
  });
}

}  // namespace fc::resting
