// Every scene of the gallery through the executable: what it wrote is read back, and no two bodies overlap in
// any frame, says a second opinion. Also: laws that hold whatever the scene.
#include <nlohmann/json.hpp>

#include "demo/demo_run.hpp"
#include "support/independent_gap.hpp"
#include "support/worlds.hpp"

namespace {

using namespace fc_test;
using namespace independent;
namespace fs = std::filesystem;

const fs::path scenes = FC_SOURCE_DIR "/chapters/ch04_multibody_stepping/scenes";

// A touch may be this much of an overlap: rounding of poses that are written with 17 digits, at some metres.
constexpr double kTouch = 1e-13;

std::vector<fs::path> gallery() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(scenes))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

Rounded shape_of(const fc::ShapeSpec& spec) {
  const auto& g = spec.geometry;
  if (const auto* ball = std::get_if<fc::SphereSpec>(&g)) return rounded_ball(ball->radius);
  if (const auto* rod = std::get_if<fc::CapsuleSpec>(&g)) return rounded_rod(rod->radius, rod->length);
  if (const auto* block = std::get_if<fc::BoxSpec>(&g)) return rounded_block(fc_test::vec(block->size));
  if (const auto* hull = std::get_if<fc::HullSpec>(&g)) {
    std::vector<Vec> points;
    for (const fc::Vec3& p : hull->points) points.push_back(fc_test::vec(p));
    return rounded_hull(points);
  }
  return rounded_mesh(read_obj(std::get<fc::MeshSpec>(g).file));
}

class Gallery : public testing::TestWithParam<fs::path> {};

TEST_P(Gallery, NothingOverlapsInAnyFrame) {
  const std::string name = GetParam().stem();
  if (contents(GetParam()).find("bunny.obj") != std::string::npos) FC_SKIP_WITHOUT_THE_BUNNY();
  const auto folder = scratch(name);
  const Outcome outcome = run(FC_BIN_DIR "/ch04_multibody_stepping " + GetParam().string() +
                              " --poses --quiet --out " + folder.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const fc::Scene scene = fc::read_scene({GetParam(), {}, {}, 4});
  std::vector<Rounded> shapes;
  for (const fc::ShapeSpec& spec : scene.shapes) shapes.push_back(shape_of(spec));

  const int bodies = static_cast<int>(scene.bodies.size());
  const auto frames = read_poses(read_table(folder / "poses.csv"), bodies);
  ASSERT_EQ(static_cast<int>(frames.size()), scene.step->frames + 1);
  const auto meets = [&](int a, int b) {
    const fc::BodySpec &one = scene.bodies[a], &other = scene.bodies[b];
    const bool yield = !(one.is_static || one.is_kinematic) || !(other.is_static || other.is_kinematic);
    return yield && !one.is_sensor && !other.is_sensor;
  };
  std::int64_t looked = 0;
  for (std::size_t frame = 0; frame < frames.size(); ++frame)
    for (int a = 0; a < bodies; ++a)
      for (int b = a + 1; b < bodies; ++b) {
        const Rounded &one = shapes[scene.bodies[a].shape], &other = shapes[scene.bodies[b].shape];
        const State &at_a = frames[frame][a], &at_b = frames[frame][b];
        const double reach = one.core.reach + one.radius + other.core.reach + other.radius;
        const double slack = norm(one.core.centroid) + norm(other.core.centroid);
        if (!meets(a, b) || norm(at_a.position - at_b.position) > 1.05 * reach + 2 * slack) continue;
        ++looked;
        ASSERT_TRUE(apart(one, at_a, other, at_b, kTouch))
            << name << ": bodies " << a << " and " << b << " overlap in frame " << frame;
      }
  EXPECT_GT(looked, 0) << "nothing ever came near anything";

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

// The second opinion can tell.
TEST(GalleryCheck, FindsAnOverlap) {
  const Rounded ball = rounded_ball(0.5), rod = rounded_rod(0.2, 1), block = rounded_block({1, 1, 1});
  const Rounded hull = rounded_hull({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}});
  EXPECT_EQ(hull.core.mesh.triangles.size(), 8U);
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
  EXPECT_FALSE(apart(rounded_hull({{.1, 0, 0}, {0, .1, 0}, {0, 0, .1}, {0, 0, 0}}), at(0, 0, 0), block,
                     at(0, 0, 0), 0));
}

}  // namespace
