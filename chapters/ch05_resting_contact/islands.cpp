#include "ch05_resting_contact/islands.hpp"

#include <numeric>

namespace fc::resting {

std::vector<std::vector<int>> islands_of(const world::World& world, const std::vector<ShellContact>& shell,
                                         const std::vector<char>& taken) {
  std::vector<int> parent(world.bodies.size());  // a forest: two bodies of one tree are of one island
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int body) {
    for (; parent[body] != body; body = parent[body]) parent[body] = parent[parent[body]];
    return body;
  };
  for (std::size_t i = 0; i < shell.size(); ++i) {
    const lcp::Contact& c = shell[i].contact;
    if (taken[i] && world.yields(c.body_a) && world.yields(c.body_b)) parent[root(c.body_a)] = root(c.body_b);
  }
  std::vector<std::vector<int>> islands;
  std::vector<int> island_of(world.bodies.size(), -1);
  for (std::size_t i = 0; i < shell.size(); ++i) {
    if (!taken[i]) continue;
    const lcp::Contact& c = shell[i].contact;
    int& island = island_of[root(world.yields(c.body_a) ? c.body_a : c.body_b)];
    if (island < 0) {
      island = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    islands[island].push_back(static_cast<int>(i));
  }
  return islands;
}

Island::Island(const world::World& world, const std::vector<ShellContact>& shell,
               const std::vector<int>& members, std::vector<int>& place) {
  const auto local = [&](int body) {
    if (place[body] < 0) {
      place[body] = static_cast<int>(numbers.size());
      numbers.push_back(body);
      bodies.push_back(world.bodies[body].state);
      reaches.push_back(world.shapes[world.bodies[body].shape].reach);
    }
    return place[body];
  };
  for (const int i : members) {
    contacts.push_back(shell[i].contact);
    contacts.back().body_a = local(contacts.back().body_a);
    contacts.back().body_b = local(contacts.back().body_b);
  }
  for (const int body : numbers) place[body] = -1;
}

}  // namespace fc::resting
