#include "ch05_resting_contact/rest_records.hpp"

#include <algorithm>

namespace fc::resting {

double reported_time(double now, double dt) {
  constexpr double kBeforeEnd = 1e-9;  // of a frame
  return std::min(now, (1 - kBeforeEnd) * dt);
}

void RestRecords::add(Instant& instant, const InstantResult& result) {
  world::StepReport& report = instant.report;
  report.contacts += result.contacts;
  report.lcp_rows += result.rows;
  report.lcp_residual = std::max(report.lcp_residual, result.residual);
  report.kinematic_work += result.kinematic_work;
  report.energy_gain = std::max(report.energy_gain, result.energy_gain);
  for (std::size_t i = 0; i < result.records.size(); ++i) {
    const world::ImpactRecord& record = result.records[i];
    if (record.kind == world::ContactKind::rest) {
      add(record, result.keys[i], true);
      continue;
    }
    ++report.impacts;
    impact_work_ += std::min(0.0, 0.5 * record.tangential.dot(record.slip_before + record.slip_after));
    if (instant.listeners.impact) instant.listeners.impact(record);
  }
}

void RestRecords::add(Instant& instant, const RunningPlan& plan, double dt) {
  const bool whole = instant.now >= plan.end;
  const double share = (instant.now - plan.start) / (plan.end - plan.start),
               end = reported_time(instant.now, dt);
  for (const PlannedRow& row : plan.what->rows) {
    const Vec3 acted = whole ? row.impulse : Vec3(share * row.early);
    if (acted.dot(row.contact.normal) > 0) {
      world::ImpactRecord record = record_of(row.arrives ? end : plan.start, row.contact, row.before,
                                             row.after, acted, world::ContactKind::rest);
      record.patch = row.patch;
      add(record, row.key, false);
    }
    if (!whole || !(row.back.dot(row.contact.normal) > 0)) continue;
    ++instant.report.impacts;
    instant.listeners.impact(
        record_of(end, row.contact, row.before, row.after, row.back, world::ContactKind::impact));
  }
  instant.report.kinematic_work += whole ? plan.what->kinematic_work : share * plan.what->early_work;
}

// `key` names the point among those of its two bodies. The record is added to what is known of the point, if its normal
// has not changed. ends_plan: the instant at a plan's end did it, as the other half of what the plan did.
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
  last = static_cast<int>(records_.size()) - 1;
}

void RestRecords::report(const world::OnImpact& listener) const {
  for (const Reported& reported : records_) listener(reported.record);
}

}  // namespace fc::resting
