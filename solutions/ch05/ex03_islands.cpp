#include "ex03_islands.hpp"

#include <numeric>
#include <utility>

namespace fc::exercises {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace

Sets single_sets(int count) {
  Sets sets{std::vector<int>(at(count)), std::vector<int>(at(count), 1)};
  std::iota(sets.parents.begin(), sets.parents.end(), 0);
  return sets;
}

int find(Sets& sets, int number) {
  while (sets.parents[at(number)] != number) {
    int& parent = sets.parents[at(number)];
    parent = sets.parents[at(parent)];  // the grandparent: from now on the path is half as long
    number = parent;
    ++sets.steps;
  }
  return number;
}

bool join(Sets& sets, int a, int b) {
  int large = find(sets, a), small = find(sets, b);
  if (large == small) return false;
  if (sets.sizes[at(large)] < sets.sizes[at(small)]) std::swap(large, small);
  sets.parents[at(small)] = large;
  sets.sizes[at(large)] += sets.sizes[at(small)];
  return true;
}

int size(Sets& sets, int number) {
  return sets.sizes[at(find(sets, number))];
}

std::vector<Island> islands_of(std::span<const char> fixed, std::span<const Touch> contacts) {
  const auto moves = [&](int body) { return fixed[at(body)] == 0; };
  Sets sets = single_sets(static_cast<int>(fixed.size()));
  for (const Touch& c : contacts)
    if (moves(c.a) && moves(c.b)) join(sets, c.a, c.b);

  // Only now, when all have been joined, a root is a name.
  std::vector<Island> islands;
  std::vector<int> island_of(fixed.size(), -1);  // of each root
  for (int i = 0; i < static_cast<int>(contacts.size()); ++i) {
    const Touch& c = contacts[at(i)];
    if (!moves(c.a) && !moves(c.b)) continue;
    int& number = island_of[at(find(sets, moves(c.a) ? c.a : c.b))];
    if (number < 0) {
      number = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    Island& island = islands[at(number)];
    island.contacts.push_back(i);
    island.grounded |= !moves(c.a) || !moves(c.b);
  }
  for (int body = 0; body < static_cast<int>(fixed.size()); ++body) {
    const int number = moves(body) ? island_of[at(find(sets, body))] : -1;
    if (number >= 0) islands[at(number)].bodies.push_back(body);
  }
  return islands;
}

}  // namespace fc::exercises
