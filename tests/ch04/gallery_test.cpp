// Every scene of the gallery through the executable: its output is read back, and the independent overlap check finds
// no overlap in any frame. Also: laws that hold in every scene.
#include <nlohmann/json.hpp>

#include "support/gallery.hpp"

namespace {

using namespace fc_test;
using namespace independent;
namespace fs = std::filesystem;

const fs::path scenes = FC_SOURCE_DIR "/chapters/ch04_multibody_stepping/scenes";

std::vector<fs::path> gallery() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(scenes))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class Gallery : public testing::TestWithParam<fs::path> {};

TEST_P(Gallery, NothingOverlapsInAnyFrame) {
  const std::string name = GetParam().stem();
  if (contents(GetParam()).find("bunny.obj") != std::string::npos) FC_SKIP_WITHOUT_THE_BUNNY();
  const auto folder = scratch(name);
  std::vector<std::string> overrides;  // the two that take longest: until some have met
  if (name == "hundred_bunnies") overrides = seconds_of("0.75");
  if (name == "bolt") overrides = seconds_of("1");
  const Outcome outcome = run(FC_BIN_DIR "/ch04_multibody_stepping " + GetParam().string() +
                              options_of(overrides) + " --poses --quiet --out " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_no_overlap(GetParam(), overrides, 4, folder);

  const Table steps = read_table(folder / "steps.csv");
  int impacts = 0;
  for (int row = 0; row < steps.rows(); ++row) {
    EXPECT_LE(steps.at(row, "lcp_residual"), 1e-12);
    EXPECT_LE(steps.at(row, "max_penetration"), kTouch);
    impacts += static_cast<int>(steps.at(row, "impacts"));
  }
  EXPECT_GT(impacts, 0) << "a scene without an impact teaches nothing here";
  const auto summary = nlohmann::json::parse(contents(folder / "summary.json"));
  const auto value = [&](const char* entry) { return summary["entries"][entry]["value"].get<double>(); };
  EXPECT_LE(value("worst momentum change at an impact"), 1e-12);
  const double energy = std::abs(steps.at(0, "kinetic")) + std::abs(steps.at(steps.rows() - 1, "kinetic"));
  EXPECT_LE(value("largest kinetic energy gain at an impact"), 1e-12 * (1 + energy));
  EXPECT_LE(value("worst deviation from the energy identity"), 1e-11 * (1 + energy));
  EXPECT_TRUE(fs::exists(folder / "motion.html"));
}

INSTANTIATE_TEST_SUITE_P(Scenes, Gallery, testing::ValuesIn(gallery()),
                         [](const auto& file) { return file.param.stem().string(); });

// The independent overlap check can detect an overlap.
TEST(GalleryCheck, FindsAnOverlap) {
  const Rounded ball = rounded_ball(0.5), rod = rounded_rod(0.2, 1), block = rounded_block({1, 1, 1});
  const Rounded hull = rounded_hull({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  EXPECT_EQ(hull.core.triangles.size(), 8U);
  const auto at = [](double x, double y, double z) { return State{{x, y, z}, {1, 0, 0, 0}, {}, {}, {}}; };
  EXPECT_TRUE(apart(ball, at(0, 0, 0), ball, at(1, 0, 0), 1e-13));
  EXPECT_FALSE(apart(ball, at(0, 0, 0), ball, at(1 - 1e-9, 0, 0), 1e-13));
  EXPECT_TRUE(apart(ball, at(0, 0, 0), block, at(1 + 1e-9, 0.3, 0.2), 0));
  EXPECT_FALSE(apart(ball, at(0, 0, 0), block, at(1 - 1e-9, 0.3, 0.2), 0));
  EXPECT_FALSE(apart(rounded_ball(0.1), at(0, 0, 0), block, at(0, 0, 0), 0)) << "inside";
  EXPECT_TRUE(apart(rod, at(0, 0, 0), rod, at(0.4 + 1e-9, 0, 0.3), 0));
  EXPECT_FALSE(apart(rod, at(0, 0, 0), rod, at(0.4 - 1e-9, 0, 0.3), 0));
  EXPECT_FALSE(apart(rod, at(0, 0, 0.7), rounded_block({2, 2, 0.01}), at(0, 0, 0.6), 0)) << "through a plate";
  EXPECT_TRUE(apart(hull, at(0, 0, 0), block, at(1.5 + 1e-9, 0, 0), 0));
  EXPECT_FALSE(apart(hull, at(0, 0, 0), block, at(1.5 - 1e-9, 0, 0), 0));
  // A mesh with many triangles, whose centre of mass is not its frame's origin, against a block.
  Mesh bumpy = bumpy_sphere(46, 44, 0.2);
  for (Vec& x : bumpy.vertices) x = x + Vec{3, 0, 0};
  const Rounded mesh = rounded_mesh(bumpy);
  ASSERT_TRUE(mesh.tree);
  EXPECT_FALSE(apart(mesh, at(0, 0, 0), block, at(3, 0, 0), 0)) << "inside";
  EXPECT_FALSE(apart(mesh, at(0, 0, 0), block, at(4.2, 0, 0), 0)) << "across the surface";
  EXPECT_TRUE(apart(mesh, at(0, 0, 0), block, at(0, 0, 0), 0)) << "where the mesh is not";
  EXPECT_FALSE(apart(mesh, at(0, 0, 0), mesh, at(0.5, 0, 0), 0));
  EXPECT_FALSE(apart(rounded_hull({{.1, 0, 0}, {0, .1, 0}, {0, 0, .1}, {0, 0, 0}}), at(0, 0, 0), block,
                     at(0, 0, 0), 0));
}

}  // namespace
