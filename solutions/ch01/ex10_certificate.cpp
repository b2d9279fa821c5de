// The answer stands in the chapter: chapters/ch01_convex_advancement/clear/check_certificate.cpp.
#include "ex10_certificate.hpp"

namespace fc::mine {

std::string check_certificate(const std::vector<ca::CertificateRow>& rows, const ca::Convex& a,
                              const ca::Motion& motion_a, const ca::Convex& b, const ca::Motion& motion_b,
                              double toc) {
  return ca::clear::check_certificate(rows, a, motion_a, b, motion_b, toc);
}

}  // namespace fc::mine
