#include "ch05_resting_contact/pile_list.hpp"

#include <algorithm>
#include <utility>

namespace fc::resting {
namespace {

// An island stands if its bodies are slower than this share of the rest speed.
constexpr double kStands = 1e-3;

// For how many frames an island is a pile after it has spent its budget: the first time, and at most.
constexpr int kLeastFrames = 8, kMostFrames = 256;

// A pile is calm if more frames than this have passed since one of its paths was shortened.
constexpr int kCalm = 2;

}  // namespace

void PileList::next_frame() {
  for (Account& account : accounts_) {
    ++account.calm;
    const bool tried = std::exchange(account.work, 0) > 0;
    if (std::exchange(account.spent, false))
      account.waits = account.waited = std::clamp(2 * account.waited, kLeastFrames, kMostFrames);
    else if (account.waits > 0)
      --account.waits;
    else if (tried)
      account.waited = 0;
  }
}

void PileList::begin(const std::vector<std::vector<int>>& found) {
  piles_.clear();
  pile_of_.assign(accounts_.size(), -1);
  for (const std::vector<int>& pile : found) unite(pile);
}

PileList::Pile* PileList::of(int body) {
  const int pile = pile_of_[at(body)];
  return pile < 0 ? nullptr : &piles_[at(pile)];
}

void PileList::unite(std::span<const int> bodies) {
  int number = -1;
  for (const int body : bodies) number = std::max(number, pile_of_[at(body)]);
  if (number < 0) {
    number = static_cast<int>(piles_.size());
    piles_.emplace_back();
  }
  Pile& pile = piles_[at(number)];
  for (const int body : bodies) {
    const int other = pile_of_[at(body)];
    if (other == number) continue;
    std::vector<int> joining = {body};
    if (other >= 0) joining = std::exchange(piles_[at(other)].bodies, {});
    for (const int joins : joining) pile_of_[at(joins)] = number;
    pile.bodies.insert(pile.bodies.end(), joining.begin(), joining.end());
  }
  std::sort(pile.bodies.begin(), pile.bodies.end());
  pile.done = false;
}

std::vector<std::vector<int>> PileList::large(std::size_t bodies) const {
  std::vector<std::vector<int>> found;
  for (const Pile& pile : piles_)
    if (pile.bodies.size() >= bodies) found.push_back(pile.bodies);
  return found;
}

bool PileList::is_calm(const Pile& pile) const {
  return std::all_of(pile.bodies.begin(), pile.bodies.end(),
                     [&](int body) { return accounts_[at(body)].calm > kCalm; });
}

void PileList::was_shortened(const Pile& pile) {
  for (const int body : pile.bodies) accounts_[at(body)].calm = 0;
}

void PileList::add_work(const Island& island, double work, double most, double rest_speed) {
  const bool stands = std::all_of(island.members.begin(), island.members.end(), [&](const Member& member) {
    return !member.dynamic || member.state.velocity.norm() < kStands * rest_speed;
  });
  for (const Member& member : island.members) {
    if (!member.dynamic) continue;
    Account& account = accounts_[at(member.number)];
    account.work += work;
    account.spent = account.work > most && !stands;
  }
}

bool PileList::is_spent(const Island& island) const {
  return std::any_of(island.members.begin(), island.members.end(), [&](const Member& member) {
    const Account& account = accounts_[at(member.number)];
    return member.dynamic && (account.spent || account.waits > 0);
  });
}

}  // namespace fc::resting
