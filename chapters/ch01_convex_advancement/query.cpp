#include "ch01_convex_advancement/query.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace fc::ca {
namespace {

bool finite(const Motion& m) {
  return m.position.allFinite() && m.rotation.allFinite() && m.velocity.allFinite() &&
         m.acceleration.allFinite() && m.spin.allFinite();
}

}  // namespace

void check_options(const AdvanceOptions& options) {
  if (!(options.interval >= 0) || !std::isfinite(options.interval))
    throw std::invalid_argument("advance: the interval is " + std::to_string(options.interval) +
                                " s, it must be finite and at least 0");
  if (!(options.tolerance >= 0) || !std::isfinite(options.tolerance))
    throw std::invalid_argument("advance: the tolerance is " + std::to_string(options.tolerance) +
                                " m, it must be finite and at least 0");
}

void check_query(const Motion& a, const Motion& b, const AdvanceOptions& options) {
  check_options(options);
  if (!finite(a) || !finite(b)) throw std::invalid_argument("advance: a motion is not finite");
}

void AdvanceResult::clear() {
  AdvanceResult fresh;
  fresh.features.swap(features);
  fresh.certificate.swap(certificate);
  fresh.certificate_leaves.swap(certificate_leaves);
  fresh.features.clear();
  fresh.certificate.clear();
  fresh.certificate_leaves.clear();
  *this = std::move(fresh);
}

const char* name_of(Status status) {
  switch (status) {
    case Status::contact:
      return "contact";
    case Status::separated:
      return "separated";
    case Status::touching_at_start:
      return "touching_at_start";
    case Status::penetrating_at_start:
      return "penetrating_at_start";
    case Status::unresolved:
      return "unresolved";
  }
  return "";
}

const char* name_of(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::vertex:
      return "vertex";
    case FeatureKind::edge:
      return "edge";
    case FeatureKind::face:
      return "face";
  }
  return "";
}

}  // namespace fc::ca
