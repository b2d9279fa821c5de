#include "ch05_resting_contact/rest_records.hpp"

namespace fc::resting {

world::ImpactRecord record_of(double time, const lcp::Contact& contact, const Vec3& before, const Vec3& after,
                              const Vec3& impulse, world::ContactKind kind) {
  const Vec3& n = contact.normal;
  const double normal = n.dot(impulse);
  world::ImpactRecord record{time, contact, {0, 0, n.dot(before), n.dot(after), normal}, kind};
  record.tangential = impulse - normal * n;
  record.slip_before = (before - n.dot(before) * n).norm();
  record.slip_after = (after - n.dot(after) * n).norm();
  return record;
}

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
    reported.record.tangential += record.tangential;
    reported.record.slip_after = record.slip_after;
    return;
  }
  records_.push_back({record, key, last});
  last = size() - 1;
}

void RestRecords::report(const world::OnImpact& listener) const {
  for (const Reported& reported : records_) listener(reported.record);
}

}  // namespace fc::resting
