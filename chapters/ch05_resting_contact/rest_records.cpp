#include "ch05_resting_contact/rest_records.hpp"

namespace fc::resting {

void RestRecords::clear() {
  records_.clear();
  last_of_.clear();
}

void RestRecords::add(const world::ImpactRecord& record, std::uint64_t key) {
  constexpr double kSameNormal = 1e-14;
  const auto a = static_cast<std::uint64_t>(record.contact.body_a),
             b = static_cast<std::uint64_t>(record.contact.body_b);
  int& last = last_of_.try_emplace(a << 32 | b, -1).first->second;
  for (int i = last; i >= 0; i = records_[at(i)].next) {
    Told& told = records_[at(i)];
    if (told.key != key || (told.record.contact.normal - record.contact.normal).norm() > kSameNormal)
      continue;
    told.record.impulse.impulse += record.impulse.impulse;
    told.record.impulse.v_after = record.impulse.v_after;
    return;
  }
  records_.push_back({record, key, last});
  last = size() - 1;
}

void RestRecords::tell(const world::OnImpact& listener) const {
  for (const Told& told : records_) listener(told.record);
}

}  // namespace fc::resting
