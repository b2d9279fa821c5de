#include "ex03_islands.hpp"

#include <numeric>
#include <utility>

namespace fc::exercises {
namespace {

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace

Sets::Sets(int count) : parents_(at(count)), sizes_(at(count), 1) {
  std::iota(parents_.begin(), parents_.end(), 0);
}

int Sets::find(int number) {
  while (parents_[at(number)] != number) {
    int& parent = parents_[at(number)];
    parent = parents_[at(parent)];  // the grandparent: from now on the path is half as long
    number = parent;
    ++steps_;
  }
  return number;
}

bool Sets::join(int a, int b) {
  int large = find(a), small = find(b);
  if (large == small) return false;
  if (sizes_[at(large)] < sizes_[at(small)]) std::swap(large, small);
  parents_[at(small)] = large;
  sizes_[at(large)] += sizes_[at(small)];
  return true;
}

int Sets::size(int number) {
  return sizes_[at(find(number))];
}

std::vector<Island> islands_of(std::span<const char> fixed, std::span<const Touch> contacts) {
  const auto moves = [&](int body) { return fixed[at(body)] == 0; };
  Sets sets(static_cast<int>(fixed.size()));
  for (const Touch& c : contacts)
    if (moves(c.a) && moves(c.b)) sets.join(c.a, c.b);

  // Only now, when all have been joined, a root is a name.
  std::vector<Island> islands;
  std::vector<int> island_of(fixed.size(), -1);  // of each root
  for (int i = 0; i < static_cast<int>(contacts.size()); ++i) {
    const Touch& c = contacts[at(i)];
    if (!moves(c.a) && !moves(c.b)) continue;
    int& number = island_of[at(sets.find(moves(c.a) ? c.a : c.b))];
    if (number < 0) {
      number = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    Island& island = islands[at(number)];
    island.contacts.push_back(i);
    island.grounded |= !moves(c.a) || !moves(c.b);
  }
  for (int body = 0; body < static_cast<int>(fixed.size()); ++body) {
    const int number = moves(body) ? island_of[at(sets.find(body))] : -1;
    if (number >= 0) islands[at(number)].bodies.push_back(body);
  }
  return islands;
}

}  // namespace fc::exercises
