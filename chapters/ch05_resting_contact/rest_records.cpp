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
    Told& told = records_[at(i)];
    if (told.key != key || (told.record.contact.normal - record.contact.normal).norm() > kSameNormal)
      continue;
    told.record.impulse.impulse += record.impulse.impulse;
    told.record.impulse.v_after = record.impulse.v_after;
    told.record.tangential += record.tangential;
    told.record.slip_after = record.slip_after;
    return;
  }
  records_.push_back({record, key, last});
  last = size() - 1;
}

void RestRecords::tell(const world::OnImpact& listener) const {
  for (const Told& told : records_) listener(told.record);
}

}  // namespace fc::resting
