#include "ex10_certificate.hpp"

#include "common/todo.hpp"

namespace fc::mine {

std::string check_certificate(const std::vector<ca::CertificateRow>& rows, const ca::Convex& a,
                              const ca::Motion& motion_a, const ca::Convex& b, const ca::Motion& motion_b,
                              double toc) {
  FC_TODO("1.10");
}

}  // namespace fc::mine
