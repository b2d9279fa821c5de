#include "ch05_resting_contact/crowd_list.hpp"

#include <algorithm>
#include <utility>

namespace fc::resting {

void CrowdList::begin(std::size_t bodies, std::vector<std::vector<int>> found) {
  crowds_.clear();
  crowd_of_.assign(bodies, -1);
  for (const std::vector<int>& crowd : found) unite(crowd);
}

void CrowdList::begin_instant() {
  for (Crowd& crowd : crowds_) crowd.done = false;
}

CrowdList::Crowd* CrowdList::of(int body) {
  const int crowd = crowd_of_[static_cast<std::size_t>(body)];
  return crowd < 0 ? nullptr : &crowds_[static_cast<std::size_t>(crowd)];
}

void CrowdList::unite(std::span<const int> bodies) {
  int number = -1;
  for (const int body : bodies) number = std::max(number, crowd_of_[static_cast<std::size_t>(body)]);
  if (number < 0) {
    number = static_cast<int>(crowds_.size());
    crowds_.emplace_back();
  }
  Crowd& crowd = crowds_[static_cast<std::size_t>(number)];
  for (const int body : bodies) {
    const int other = crowd_of_[static_cast<std::size_t>(body)];
    if (other == number) continue;
    std::vector<int> joining = {body};
    if (other >= 0) joining = std::exchange(crowds_[static_cast<std::size_t>(other)].bodies, {});
    for (const int joins : joining) crowd_of_[static_cast<std::size_t>(joins)] = number;
    crowd.bodies.insert(crowd.bodies.end(), joining.begin(), joining.end());
  }
  std::sort(crowd.bodies.begin(), crowd.bodies.end());
  crowd.done = false;
}

}  // namespace fc::resting
