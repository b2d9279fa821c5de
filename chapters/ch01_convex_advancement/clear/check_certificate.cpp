// 1.10, in its clear form: follows a certificate, look by look.
#include <fmt/format.h>

#include <cmath>

#include "ch01_convex_advancement/clear/pieces.hpp"
#include "ch01_convex_advancement/gjk.hpp"

namespace fc::ca::clear {

// ANCHOR: certificate
std::string check_certificate(const std::vector<CertificateRow>& rows, const Convex& a,
                              const Motion& motion_a, const Convex& b, const Motion& motion_b, double toc) {
  constexpr double kRounding =
      1e-12;  // relative: times and lengths that should be the same may differ by this
  double reached = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const CertificateRow& row = rows[k];
    if (!(std::abs(row.normal.norm() - 1) <= kRounding))
      return fmt::format("row {}: the normal's length is {}, not 1", k, row.normal.norm());
    if (!(std::abs(row.t - reached) <= kRounding * reached))
      return fmt::format("row {}: it starts at {} s, but the rows before it end at {} s", k, row.t, reached);
    if (!(row.speed_bound * row.advance <= row.gap_lower))
      return fmt::format("row {}: a gap of {} m does not last for {} s at {} m/s", k, row.gap_lower,
                         row.advance, row.speed_bound);

    // Follow it: look at the gap along n, and go as far as that gap cannot be used up.
    const Vec3& n = row.normal;
    const double rate = std::abs(n.dot(motion_a.velocity_at(row.t) - motion_b.velocity_at(row.t))) +
                        std::abs(n.dot(motion_a.acceleration - motion_b.acceleration)) * row.advance +
                        n.cross(motion_a.spin).norm() * a.reach + n.cross(motion_b.spin).norm() * b.reach;
    for (double h = 0, step = 0;; h += step) {
      h = std::min(h, row.advance);
      const PairPose pose(motion_a, motion_b, row.t + h);
      const double gap = support_gap(a, b, pose, n), promised = row.gap_lower - row.speed_bound * h;
      if (!(gap + rounding_term(a, b, pose) >= promised))
        return fmt::format("row {}: {} s later the gap along n is {} m, and the row promises {} m", k, h, gap,
                           promised);
      if (h == row.advance) break;
      step = rate > 0 ? gap / rate : row.advance;
      if (!(h + step > h)) return fmt::format("row {}: the bodies may touch {} s later", k, h);
    }
    reached = row.t + row.advance;
  }
  if (!(std::abs(toc - reached) <= kRounding * toc))
    return fmt::format("the rows prove the pair clear until {} s, but toc is {} s", reached, toc);
  return "";
}
// ANCHOR_END: certificate

}  // namespace fc::ca::clear
