// The account of a frame with contacts that last: watching changes nothing, and what it says of patches, pushes and proofs is so.
#include "ch05_resting_contact/show_rest.hpp"

#include <cmath>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch05_resting_contact/path.hpp"
#include "ch05_resting_contact/show_paths.hpp"
#include "support/check_document.hpp"

namespace {

using namespace fc;
using namespace fc::resting;

const std::filesystem::path scenes =
    std::filesystem::path(FC_SOURCE_DIR) / "chapters/ch05_resting_contact/scenes";

// Runs `frames` frames, each by a step that remembers nothing, and beside it the watched one.
template <class Look>
void watch_frames(const std::string& name, int frames, const Look& look) {
  const Scene scene = read_scene({scenes / (name + ".yaml"), {}, {}, 5});
  world::World world = world::build_world(scene);
  for (int frame = 0; frame < frames; ++frame) {
    const world::World before = world;
    world::World copy = world;
    const RestWatch watch = watched_frame(scene, copy, std::make_unique<NormalLaw>());
    int instants = 0;
    world::Listeners listeners;
    listeners.instant = [&](const world::World&, double) { ++instants; };
    Resting resting(scene, world, scene.step->dt);
    const RestReport report = resting.step(world, listeners);
    look(before, watch, report, resting.envelope());
    for (std::size_t i = 0; i < world.bodies.size(); ++i) {
      ASSERT_EQ(world.bodies[i].state.position, copy.bodies[i].state.position) << name << ", body " << i;
      ASSERT_EQ(world.bodies[i].state.velocity, copy.bodies[i].state.velocity) << name << ", body " << i;
    }
  }
}

TEST(ShownRest, WatchingChangesNothingAndTheReportIsTheSteps) {
  int pushes = 0;
  for (const char* name : {"stack", "slope", "islands", "mixed"})
    watch_frames(name, 20,
                 [&](const world::World&, const RestWatch& watch, const RestReport& report, double) {
                   EXPECT_EQ(watch.report.plans, report.plans) << name;
                   EXPECT_EQ(watch.report.resting, report.resting) << name;
                   EXPECT_EQ(watch.report.step.impacts, report.step.impacts) << name;
                   pushes += static_cast<int>(watch.pushes.size());
                 });
  EXPECT_GT(pushes, 50);
}

TEST(ShownRest, PushesFulfilTheLaw) {
  int looked = 0;
  watch_frames("stack", 20, [&](const world::World&, const RestWatch& watch, const RestReport&, double) {
    for (const SeenPush* push : pushes_that_count(watch)) {
      if (!push->result.solved) continue;
      ++looked;
      for (std::size_t i = 0; i < push->contacts.size(); ++i) {
        EXPECT_GE(push->impulses[i].dot(push->contacts[i].normal), 0);
        EXPECT_GE(lcp::contact_velocity(push->after, push->contacts[i]) + push->limits[i], -1e-8);
      }
    }
  });
  EXPECT_GT(looked, 20);
}

TEST(ShownRest, PatchPointsAreAsFarApartAsTheirGap) {
  int points = 0;
  watch_frames("islands", 5,
               [&](const world::World& before, const RestWatch&, const RestReport&, double margin) {
                 for (const PatchOfPair& patch : patches_now(before, margin)) {
                   EXPECT_LE(patch.gap, margin);
                   for (const PatchPoint& p : patch.points) {
                     ++points;
                     EXPECT_NEAR(p.normal.dot(p.on_b - p.on_a), p.gap, 1e-12);
                     EXPECT_GE(p.gap, patch.gap - 1e-9) << "a point nearer than the certified gap";
                   }
                 }
               });
  EXPECT_GT(points, 20);
}

// Where a proof says that two bodies keep apart, their gap along the paths is never below zero: looked at closely.
TEST(ShownRest, ProvedPathsKeepApart) {
  int proved[4] = {};
  for (const char* name : {"stack", "islands", "turned", "slope"})
    watch_frames(
        name, 15, [&](const world::World& before, const RestWatch& watch, const RestReport&, double margin) {
          for (const PathProof& proof : proofs_of(before, watch.planned, watch.plan_end, margin)) {
            ++proved[static_cast<int>(proof.proof)];
            if (proof.proof == Proof::none) continue;
            EXPECT_GE(proof.slack, 0);
            const auto motion_of = [&](int body) {
              const world::Body& b = watch.planned[at(body)];
              const bool goes = b.plan.number >= 0;
              return straight_path(b.state, goes ? b.plan.linear : Vec3(Vec3::Zero()),
                                   goes ? b.plan.angular : Vec3(Vec3::Zero()), 1, watch.plan_end)
                  .motion;
            };
            for (int k = 0; k <= 8; ++k) {
              const ca::PairPose pose(motion_of(proof.a), motion_of(proof.b), watch.plan_end * k / 8);
              const auto gap =
                  hulls::model_distance(before.model_of(proof.a), before.model_of(proof.b), pose, 1e-9);
              EXPECT_GT(gap.upper, 0) << name << ": bodies " << proof.a << " and " << proof.b;
            }
          }
        });
  EXPECT_GT(proved[0] + proved[1] + proved[2], 100);
}

}  // namespace
