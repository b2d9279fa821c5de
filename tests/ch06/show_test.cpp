// The account of a frame with friction, and accounts of scenes of chapters 4 to 6, as the page gets them.
#include "ch06_friction/show_cones.hpp"

#include "ch06_friction/coulomb_law.hpp"
#include "ch06_friction/rubbing.hpp"
#include "support/check_document.hpp"

namespace {

using namespace fc;
using namespace fc::friction;
using namespace fc_test;
using algorithm::Mark;
using algorithm::Role;

const std::filesystem::path chapters = std::filesystem::path(FC_SOURCE_DIR) / "chapters";

// Whether a point lies in the cone that the mesh draws: on the inner side of each of its sides.
bool is_inside(const Mark& cone, const Vec3& point) {
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 1; i < cone.points.size(); ++i)
    middle += cone.points[i] / static_cast<double>(cone.points.size() - 1);
  for (const auto& t : cone.triangles) {
    const Vec3& top = cone.points[static_cast<std::size_t>(t[0])];
    const Vec3 n = (cone.points[static_cast<std::size_t>(t[1])] - top)
                       .cross(cone.points[static_cast<std::size_t>(t[2])] - top)
                       .normalized();
    const double inner = n.dot(middle - top), there = n.dot(point - top);
    if (there * (inner > 0 ? 1 : -1) < -1e-9) return false;
  }
  return true;
}

TEST(ShownCones, ImpulsesLieInsideTheConesThatAreDrawn) {
  int inside = 0, slips = 0, sticks = 0;
  for (const char* name : {"slope", "slide", "mixed_slope", "card_house"}) {
    const Scene scene = with_envelope(
        read_scene({chapters / "ch06_friction/scenes" / (std::string(name) + ".yaml"), {}, {}, 6}));
    world::World world = world::build_world(scene);
    CoulombLaw{world};
    for (int frame = 0; frame < 12; ++frame) {
      const resting::RestWatch watch =
          resting::watched_frame(scene, world, std::make_unique<CoulombLaw>(world));
      for (const algorithm::Part& part : show_cones(world, watch, 0))
        for (const algorithm::Step& step : part.steps) {
          const Mark* cone = nullptr;
          for (const Mark& mark : step.draw) {
            if (mark.kind == Mark::Kind::mesh) cone = &mark;
            if (mark.kind != Mark::Kind::arrow || mark.role != Role::force) continue;
            ASSERT_NE(cone, nullptr);
            EXPECT_EQ(cone->points[0], mark.points[0]);
            EXPECT_TRUE(is_inside(*cone, mark.points[1])) << name;
            ++inside;
            slips += cone->role == Role::now;
            sticks += cone->role == Role::good;
          }
          if (!step.bars) continue;
          for (const algorithm::Bar& bar : step.bars->rows) {
            EXPECT_LE(bar.value, 1 + 1e-6) << name;
            if (bar.role == Role::good) {
              EXPECT_LT(bar.value, 1) << name;
            }
          }
        }
    }
  }
  EXPECT_GT(inside, 200);
  EXPECT_GT(slips, 20);
  EXPECT_GT(sticks, 20);
}

TEST(ShownCones, AConeHoldsItsEdgeAndNothingBeyond) {
  const Mark cone = cone_mesh(Vec3::Zero(), Vec3::UnitZ(), 0.5, 2, Role::good);
  for (int i = 0; i < 100; ++i) {
    const double angle = 0.0628 * i;
    const Vec3 around(std::cos(angle), std::sin(angle), 0);
    EXPECT_TRUE(is_inside(cone, Vec3(0, 0, 2) + 0.9999 * around));
    EXPECT_FALSE(is_inside(cone, Vec3(0, 0, 2) + 1.03 * around));
  }
  EXPECT_EQ(grip_of(Vec3(0, 0, 0), Vec3::UnitZ(), 0.5), Grip::open);
  EXPECT_EQ(grip_of(Vec3(0.2, 0, 1), Vec3::UnitZ(), 0.5), Grip::sticks);
  EXPECT_EQ(grip_of(Vec3(0.5, 0, 1), Vec3::UnitZ(), 0.5), Grip::slips);
}

TEST(ShownCones, SweepsComeNearerToTheLaw) {
  const Scene scene =
      with_envelope(read_scene({chapters / "ch06_friction/scenes/card_house.yaml", {}, {}, 6}));
  world::World world = world::build_world(scene);
  const resting::RestWatch watch = resting::watched_frame(scene, world, std::make_unique<CoulombLaw>(world));
  int looked = 0;
  for (const resting::SeenPush* push : pushes_that_count(watch)) {
    const auto residuals = residuals_of(world, *push);
    if (push->corrects || residuals.size() < 3) continue;
    ++looked;
    EXPECT_LT(residuals.back().residual, 0.5 * residuals.front().residual);
  }
  EXPECT_GT(looked, 0);
}

// As a page asks for it, some frames into the scene.
void look_at(const std::filesystem::path& file, int frames) {
  const auto scene = world::make_live({chapters / file, {}, {}, 6}, live_chapter());
  for (int frame = 0; frame <= frames; ++frame) {
    if (frame == 0 || frame == frames / 2 || frame == frames) {
      const live::Snapshot before = scene->snapshot();
      const Json document =
          check_document(scene->algorithm(), static_cast<int>(before.poses.size()), file.stem());
      EXPECT_EQ(document.at("frame"), before.frame + 1);
      const live::Snapshot after = scene->snapshot();
      for (std::size_t i = 0; i < before.poses.size(); ++i)
        ASSERT_EQ(before.poses[i].position, after.poses[i].position) << "the scene moved";
    }
    if (frame < frames) scene->step();
  }
}

TEST(ShownGallery, EveryDocumentIsValid) {
  for (const char* name : {"bounce", "break", "cradle", "dominoes", "gas", "gears", "paddle", "pi", "rings",
                           "tops", "tumbling_boxes"})
    look_at(std::filesystem::path("ch04_multibody_stepping/scenes") / (std::string(name) + ".yaml"), 40);
  for (const char* name : {"ball", "bowl", "islands", "mixed", "slope", "stack", "turned", "valley"})
    look_at(std::filesystem::path("ch05_resting_contact/scenes") / (std::string(name) + ".yaml"), 20);
  for (const char* name :
       {"arch", "billiards", "card_house", "conveyor", "dominoes", "orbit", "planks", "slide"})
    look_at(std::filesystem::path("ch06_friction/scenes") / (std::string(name) + ".yaml"), 12);
}

// Only parts for what the scene has.
TEST(ShownGallery, PartsFollowTheEffects) {
  const auto chapters_of = [](const std::string& file) {
    const auto scene = world::make_live({chapters / file, {}, {}, 6}, live_chapter());
    for (int frame = 0; frame < 3; ++frame) scene->step();
    std::set<int> list;
    const Json document = Json::parse(scene->algorithm());
    for (const Json& part : document.at("parts")) list.insert(part.at("chapter").get<int>());
    return list;
  };
  const std::set<int> balls = chapters_of("ch04_multibody_stepping/scenes/gas.yaml");
  EXPECT_FALSE(balls.contains(2) || balls.contains(5) || balls.contains(6));
  const std::set<int> meshes = chapters_of("ch04_multibody_stepping/scenes/rings.yaml");
  EXPECT_FALSE(meshes.contains(5) || meshes.contains(6));
  const std::set<int> rests = chapters_of("ch05_resting_contact/scenes/stack.yaml");
  EXPECT_TRUE(rests.contains(5) && !rests.contains(6) && !rests.contains(2));
  const std::set<int> rubs = chapters_of("ch06_friction/scenes/card_house.yaml");
  EXPECT_TRUE(rubs.contains(5) && rubs.contains(6));
}

}  // namespace
