// Public LCPs (see the README of the chapter for where they come from). Skipped where the data is not there;
// no guarantee of the chapter depends on this test alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "ch03_impulse_lcp/dantzig.hpp"
#include "ch03_impulse_lcp/matrix_market.hpp"

namespace fc::lcp {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  const char* data = std::getenv("FC_DATA");
  return (data ? fs::path(data) : fs::path(FC_SOURCE_DIR) / ".." / "shared" / "data") / "lcp";
}

// Beyond the class of Dantzig's method: neither positive semidefinite and symmetric nor a P-matrix.
bool beyond(const std::string& name) {
  static const std::set<std::string> names = {"lcp_CPS_2",
                                              "lcp_CPS_3",
                                              "lcp_CPS_4",
                                              "lcp_CPS_4bis",
                                              "lcp_Pang_isolated_sol",
                                              "lcp_enum_fails",
                                              "lcp_tobenna",
                                              "lcp_inf_sol_perturbed",
                                              "drake_10.2.3",
                                              "drake_10.2.4",
                                              "drake_10.2.9_l1",
                                              "drake_10.2.9_l16",
                                              "drake_10.2.9_l100"};
  return names.contains(name);
}

// Problems that have a solution and a matrix of the method's class must be solved, and so must the real contact
// problems with their slightly asymmetric matrices; all others must end in a status that says so.
void check(const fs::path& base) {
  const MatX A = read_matrix_market(base.string() + ".A.mtx");
  const VecX b = read_matrix_market(base.string() + ".b.mtx");
  const LcpResult result = solve_dantzig({A, b});
  if (beyond(base.filename().string())) {
    EXPECT_EQ(result.status, Status::unsuited);
    return;
  }
  if (!fs::exists(base.string() + ".z.mtx")) {
    EXPECT_EQ(result.status, Status::no_solution);
    return;
  }
  ASSERT_EQ(result.status, Status::solved);
  EXPECT_LE(result.residual, 1e-13);
  const VecX z = read_matrix_market(base.string() + ".z.mtx");
  const double difference = (result.w - evaluate(A, b, z)).lpNorm<Eigen::Infinity>();
  EXPECT_LE(difference, 1e-12 * b.lpNorm<Eigen::Infinity>());
}

class PublicLcp : public testing::TestWithParam<const char*> {};

TEST_P(PublicLcp, IsSolvedOrRefused) {
  const fs::path folder = data_folder() / GetParam();
  if (!fs::is_directory(folder)) GTEST_SKIP() << "no public data";
  int problems = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string path = entry.path().string(), ending = ".A.mtx";
    if (!path.ends_with(ending)) continue;
    SCOPED_TRACE(entry.path().filename());
    check(path.substr(0, path.size() - ending.size()));
    ++problems;
  }
  EXPECT_GT(problems, 0);
}

INSTANTIATE_TEST_SUITE_P(Sets, PublicLcp, testing::Values("siconos", "handbook", "families", "contact"),
                         [](const auto& set) { return std::string(set.param); });

}  // namespace
}  // namespace fc::lcp
