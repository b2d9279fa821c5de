#include "ch05_resting_contact/pile_list.hpp"

#include <algorithm>
#include <utility>

namespace fc::resting {
namespace {

constexpr int kCalm = 3;  // frames

}  // namespace

void PileList::begin(std::size_t bodies, std::vector<std::vector<int>> found) {
  calm_.resize(bodies, 0);
  for (int& frames : calm_) ++frames;
  piles_.clear();
  pile_of_.assign(bodies, -1);
  for (const std::vector<int>& pile : found) unite(pile);
}

void PileList::begin_instant() {
  for (Pile& pile : piles_) pile.done = false;
}

PileList::Pile* PileList::of(int body) {
  const int pile = pile_of_[static_cast<std::size_t>(body)];
  return pile < 0 ? nullptr : &piles_[static_cast<std::size_t>(pile)];
}

void PileList::unite(std::span<const int> bodies) {
  int number = -1;
  for (const int body : bodies) number = std::max(number, pile_of_[static_cast<std::size_t>(body)]);
  if (number < 0) {
    number = static_cast<int>(piles_.size());
    piles_.emplace_back();
  }
  Pile& pile = piles_[static_cast<std::size_t>(number)];
  for (const int body : bodies) {
    const int other = pile_of_[static_cast<std::size_t>(body)];
    if (other == number) continue;
    std::vector<int> joining = {body};
    if (other >= 0) joining = std::exchange(piles_[static_cast<std::size_t>(other)].bodies, {});
    for (const int joins : joining) pile_of_[static_cast<std::size_t>(joins)] = number;
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
                     [&](int body) { return calm_[static_cast<std::size_t>(body)] > kCalm; });
}

void PileList::was_shortened(const Pile& pile) {
  for (const int body : pile.bodies) calm_[static_cast<std::size_t>(body)] = 0;
}

}  // namespace fc::resting
