// Public frictional contact problems, of Siconos (see the folder's README). Skipped where the data is not there; no
// guarantee of the chapter depends on this test alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "ch03_impulse_lcp/matrix_market.hpp"
#include "ch06_friction/friction_solver.hpp"
#include "cones.hpp"

namespace fc::friction {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  const char* data = std::getenv("FC_DATA");
  return (data ? fs::path(data) : fs::path(FC_SOURCE_DIR) / ".." / "shared" / "data") / "friction";
}

// A is the mean of the file's matrix and its transpose: what an engine assembled differs a little.
OwnProblem read(const std::string& name) {
  const std::string base = (data_folder() / name).string();
  const MatX A = lcp::read_matrix_market(base + ".A.mtx");
  return {0.5 * (A + A.transpose()), lcp::read_matrix_market(base + ".b.mtx"),
          lcp::read_matrix_market(base + ".mu.mtx")};
}

void keeps_the_law(const OwnProblem& p, const ConeResult& result) {
  EXPECT_LE(result.residual, 1e-10);
  EXPECT_LE(broken_law(p, result.r, result.u), 1e-9 * size_of(p, result.r));
  EXPECT_LE(energy_change(p, result.r),
            -0.5 * result.r.dot(p.A * result.r) + 1e-8 * size_of(p, result.r) * result.r.lpNorm<1>());
}

class PublicFriction : public testing::TestWithParam<const char*> {};

TEST_P(PublicFriction, IsSolvedAndNoWrongAnswerCalledSolved) {
  if (!fs::is_directory(data_folder())) GTEST_SKIP() << "no public data";
  const OwnProblem p = read(GetParam());
  for (const Method method : kMethods) {
    SCOPED_TRACE(name(method));
    const ConeResult result = solve(p, method);
    if (method == Method::combined) {
      EXPECT_EQ(result.status, Status::solved);
    }
    if (result.status == Status::solved) keeps_the_law(p, result);
  }
}

INSTANTIATE_TEST_SUITE_P(UpToSixtyContacts, PublicFriction,
                         testing::Values("Rover11211", "Rover4396", "Rover1039", "NESpheres_10_1",
                                         "OneObject-i100000-499", "BoxesStack1-i100000-32",
                                         "Confeti-ex03-Fc3D-SBM"));

// Sweeps go in circles for ever, and are stopped by relaxation at what is no answer; the default gets out.
TEST(PublicFrictionHard, PlainSweepsCycleOnOneBodyWithManyPoints) {
  if (!fs::is_directory(data_folder())) GTEST_SKIP() << "no public data";
  const OwnProblem p = read("OneObject-i100000-499");
  const ConeResult sweeps = solve(p, Method::gauss_seidel, {.limit = 300});
  EXPECT_EQ(sweeps.status, Status::limit);
  EXPECT_LT(sweeps.relaxation, 1);
  EXPECT_LE(solve(p).steps, 60);
}

// A heap of 225 contacts: sweeps alone get near it.
TEST(PublicFrictionHard, SweepsComeNearAHeapOfCapsules) {
  if (!fs::is_directory(data_folder())) GTEST_SKIP() << "no public data";
  const OwnProblem p = read("Capsules-i101-404");
  const ConeResult result = solve(p, Method::gauss_seidel, {.limit = 200});
  EXPECT_LE(result.residual, 1e-5);
}

}  // namespace
}  // namespace fc::friction
