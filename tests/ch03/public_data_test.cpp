// Public LCPs (see the README of the chapter for where they come from). Skipped where the data is not there;
// no guarantee of the chapter depends on this test alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
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

// Symmetric positive semidefinite ones must be solved, asymmetric ones called unsuited; slightly indefinite
// ones (real contact problems, with round-off in the file) may be either, but never wrong.
void check(const fs::path& base) {
  const MatX A = read_matrix_market(base.string() + ".A.mtx");
  const VecX b = read_matrix_market(base.string() + ".b.mtx");
  const LcpResult result = solve_dantzig({A, b});
  const double asymmetry = (A - A.transpose()).lpNorm<Eigen::Infinity>() / A.lpNorm<Eigen::Infinity>();
  if (asymmetry > 1e-8) {
    EXPECT_EQ(result.status, Status::unsuited);
    return;
  }
  if (!fs::exists(base.string() + ".z.mtx")) {
    EXPECT_NE(result.status, Status::solved);
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
