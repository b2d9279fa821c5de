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
    Reported& reported = records_[at(i)];
    if (reported.key != key || (reported.record.contact.normal - record.contact.normal).norm() > kSameNormal)
      continue;
    reported.record.impulse.impulse += record.impulse.impulse;
    reported.record.impulse.v_after = record.impulse.v_after;
    return;
  }
  records_.push_back({record, key, last});
  last = size() - 1;
}

void RestRecords::report(const world::OnImpact& listener) const {
  for (const Reported& reported : records_) listener(reported.record);
}

}  // namespace fc::resting
