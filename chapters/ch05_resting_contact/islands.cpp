#include "ch05_resting_contact/islands.hpp"

#include <numeric>

namespace fc::resting {

Joined::Joined(std::size_t bodies) : parent_(bodies) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

int Joined::root(int body) {
  int at = body;
  for (; parent_[static_cast<std::size_t>(at)] != at; at = parent_[static_cast<std::size_t>(at)]) {
    int& parent = parent_[static_cast<std::size_t>(at)];
    parent = parent_[static_cast<std::size_t>(parent)];  // half the way, for whoever comes next
  }
  return at;
}

std::vector<std::vector<int>> islands_of(const world::World& world, const std::vector<ShellContact>& shell,
                                         const std::vector<char>& taken) {
  Joined joined(world.bodies.size());
  for (std::size_t i = 0; i < shell.size(); ++i) {
    const lcp::Contact& c = shell[i].contact;
    if (taken[i] && world.yields(c.body_a) && world.yields(c.body_b)) joined.join(c.body_a, c.body_b);
  }
  std::vector<std::vector<int>> islands;
  std::vector<int> island_of(world.bodies.size(), -1);
  for (std::size_t i = 0; i < shell.size(); ++i) {
    if (!taken[i]) continue;
    const lcp::Contact& c = shell[i].contact;
    int& island =
        island_of[static_cast<std::size_t>(joined.root(world.yields(c.body_a) ? c.body_a : c.body_b))];
    if (island < 0) {
      island = static_cast<int>(islands.size());
      islands.emplace_back();
    }
    islands[static_cast<std::size_t>(island)].push_back(static_cast<int>(i));
  }
  return islands;
}

Island::Island(const std::vector<RigidBody>& states, const std::vector<ShellContact>& shell,
               const std::vector<int>& members, std::vector<int>& place) {
  const auto local = [&](int body) {
    int& at = place[static_cast<std::size_t>(body)];
    if (at < 0) {
      at = static_cast<int>(numbers.size());
      numbers.push_back(body);
      bodies.push_back(states[static_cast<std::size_t>(body)]);
    }
    return at;
  };
  for (const int i : members) {
    contacts.push_back(shell[static_cast<std::size_t>(i)].contact);
    contacts.back().body_a = local(contacts.back().body_a);
    contacts.back().body_b = local(contacts.back().body_b);
    contacts.back().restitution = 0;  // who bounces is said by how fast it may close in
  }
  for (const int body : numbers) place[static_cast<std::size_t>(body)] = -1;
}

}  // namespace fc::resting
