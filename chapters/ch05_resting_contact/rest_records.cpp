#include "ch05_resting_contact/rest_records.hpp"

#include "ch05_resting_contact/contacts.hpp"

namespace fc::resting {

world::ImpactRecord record_of(double time, const lcp::Contact& contact, const Vec3& before, const Vec3& after,
                              const Vec3& impulse, world::ContactKind kind) {
  const Vec3& n = contact.normal;
  const double normal = n.dot(impulse);
  world::ImpactRecord record{time, contact, {0, 0, n.dot(before), n.dot(after), normal}, kind};
  record.tangential = impulse - normal * n;
  record.slip_before = before - n.dot(before) * n;
  record.slip_after = after - n.dot(after) * n;
  return record;
}

void RestRecords::clear() {
  records_.clear();
  last_of_.clear();
  work_ = 0;
}

void RestRecords::add(const world::ImpactRecord& record, std::uint64_t key, bool ends_plan) {
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
    work_ += record.tangential.dot(ends_plan ? reported.slip : record.slip_after);
    reported.record.slip_after = record.slip_after;
    if (!ends_plan) reported.slip = record.slip_after;
    return;
  }
  work_ += record.tangential.dot(record.slip_after);
  records_.push_back({record, record.slip_after, key, last});
  last = size() - 1;
}

void RestRecords::report(const world::OnImpact& listener) const {
  for (const Reported& reported : records_) listener(reported.record);
}

}  // namespace fc::resting
