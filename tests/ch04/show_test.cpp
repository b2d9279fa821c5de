// The account of a frame: watching changes nothing, and it counts what the step counts.
#include "ch04_multibody_stepping/show_frame.hpp"

#include "ch02_hull_hierarchy/show_search.hpp"
#include "motion/glb_reader.hpp"
#include "support/check_document.hpp"
#include "support/run_files.hpp"

namespace {

using namespace fc;
using namespace fc::world;
using namespace fc_test;

const std::filesystem::path scenes =
    std::filesystem::path(FC_SOURCE_DIR) / "chapters/ch04_multibody_stepping/scenes";

bool same(const RigidBody& x, const RigidBody& y) {
  return x.position == y.position && x.orientation.coeffs() == y.orientation.coeffs() &&
         x.velocity == y.velocity && x.spin == y.spin;
}

// Steps `frames` frames; beside each, the same frame is watched on a copy.
template <class Look>
void watch_frames(const std::string& name, int frames, const Look& look) {
  const Scene scene = read_scene({scenes / (name + ".yaml"), {}, {}, 4});
  World world = build_world(scene);
  for (int frame = 0; frame < frames; ++frame) {
    World copy = world;
    FrameWatch watch;
    watched_step(copy, scene.step->dt, watch);
    int instants = 0, impulses = 0;
    Listeners listeners;
    listeners.instant = [&](const World&, double) { ++instants; };
    listeners.impact = [&](const ImpactRecord&) { ++impulses; };
    const StepReport report = step(world, scene.step->dt, listeners);
    look(scene, watch, report, instants, impulses);
    for (std::size_t i = 0; i < world.bodies.size(); ++i)
      ASSERT_TRUE(same(world.bodies[i].state, copy.bodies[i].state)) << name << ", body " << i;
  }
}

TEST(ShownFrame, HasTheEventsOfTheStepAndChangesNothing) {
  int events = 0, contacts = 0;
  for (const char* name : {"gas", "cradle", "break", "paddle", "tumbling_boxes"})
    watch_frames(name, 40,
                 [&](const Scene& scene, const FrameWatch& watch, const StepReport& report, int instants,
                     int impulses) {
                   ASSERT_EQ(watch.contacts, instants) << name;
                   ASSERT_EQ(report.impacts, impulses);
                   int points = 0;
                   double last = 0;
                   for (const SeenEvent& event : watch.events) {
                     ASSERT_GE(event.time, last) << "events in order";
                     last = event.time;
                     ASSERT_LE(event.time, scene.step->dt);
                     if (event.kind == SeenEvent::Kind::contact) {
                       ASSERT_FALSE(event.instant.contacts.empty());
                     }
                     points += static_cast<int>(event.instant.contacts.size());
                     for (const int body : event.changed)
                       EXPECT_EQ(event.clocks[static_cast<std::size_t>(body)], event.time);
                   }
                   const bool all_kept =
                       watch.contacts + watch.others == static_cast<int>(watch.events.size());
                   if (all_kept && report.solves == instants) {
                     EXPECT_EQ(points, report.contacts) << name;
                   }
                   events += instants;
                   contacts += points;
                 });
  EXPECT_GT(events, 50);
  EXPECT_GT(contacts, 60);
}

TEST(ShownFrame, TheEarliestEventOfTheQueueComesNext) {
  int looked = 0;
  watch_frames("gas", 60, [&](const Scene&, const FrameWatch& watch, const StepReport&, int, int) {
    for (std::size_t k = 0; k + 1 < watch.events.size(); ++k) {
      if (watch.events[k + 1].queue.empty()) continue;
      ++looked;
      EXPECT_LE(watch.events[k + 1].time, watch.events[k + 1].queue.front().time);
    }
  });
  EXPECT_GT(looked, 5);
}

// Two bodies of chapter 2: the pairs of boxes lead from the roots down to the leaves that meet.
TEST(ShownSearch, EachPairOnTheWayToTheContactHoldsTheNextAndItsBoxHoldsItsLeaves) {
  const Scene scene = read_scene({scenes / "rings.yaml", {}, {}, 4});
  World world = build_world(scene);
  int searches = 0;
  for (int frame = 0; frame < 90 && searches < 4; ++frame) {
    World copy = world;
    FrameWatch watch;
    watched_step(copy, scene.step->dt, watch);
    for (const SeenEvent& event : watch.events) {
      if (event.kind != SeenEvent::Kind::contact || event.stalled) continue;
      const SeenSearch& s = event.search;
      hulls::ShownModels shown{s.a,    s.b, world.model_of(s.a), world.model_of(s.b), s.motion_a, s.motion_b,
                               s.from, {}};
      shown.options.interval = s.to - s.from;
      shown.options.target = 0.5 * world.tolerance;
      const hulls::CertifiedSearch search = hulls::certified_search(shown);
      if (search.found.status != hulls::TimeOfContact::Status::reached || search.found.time == 0) continue;
      ++searches;
      const auto rows = hulls::rows_to_contact(search);
      ASSERT_FALSE(rows.empty());
      const auto steps = hulls::show_search(shown, search, 0);
      EXPECT_GT(steps.size(), 2u);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        const ca::LeafBlock& block = search.rows.certificate_leaves[rows[k]];
        EXPECT_LE(search.rows.certificate[rows[k]].t, search.found.time);
        if (k > 0) {
          const ca::LeafBlock& before = search.rows.certificate_leaves[rows[k - 1]];
          EXPECT_GE(block.first_a, before.first_a);
          EXPECT_GE(block.first_b, before.first_b);
          EXPECT_LE(block.count_a * block.count_b, before.count_a * before.count_b);
        }
        // Every point of these leaves lies in the box.
        const std::vector<Vec3> box = hulls::box_of_leaves(shown.a.boxes, block.first_a, block.count_a);
        for (int leaf = block.first_a; leaf < block.first_a + block.count_a; ++leaf)
          for (const Vec3& p : shown.a.boxes.leaf_points(leaf))
            for (int axis = 0; axis < 3; ++axis) {
              const Vec3 edge = box[static_cast<std::size_t>(1 << axis)] - box[0];
              const double share = edge.dot(p - box[0]), slack = 1e-5 * (edge.squaredNorm() + 1e-3);
              EXPECT_GE(share, -slack);
              EXPECT_LE(share, edge.squaredNorm() + slack);
            }
      }
    }
    step(world, scene.step->dt);
  }
  EXPECT_GT(searches, 2);
}

TEST(ShownFrame, ARecordingHasTheFramesThatWereAskedFor) {
  const auto folder = scratch("recorded");
  const std::string program = std::string(FC_BIN_DIR) + "/ch04_multibody_stepping ";
  const std::string scene = (scenes / "cradle.yaml").string();
  const auto documents = [&](const std::string& options) {
    const Outcome outcome = run(program + scene + " --quiet --out " + folder.string() + " " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Glb(contents(folder / "motion.glb")).json.value("/extras/algorithm"_json_pointer, Json::array());
  };
  const Json first = documents("");
  ASSERT_EQ(first.size(), 1u);
  const Json document = check_document(first[0].dump(), 6, "cradle");
  EXPECT_LE(document.at("t0").get<double>(), 1.0 / 3);
  EXPECT_GE(document.at("t1").get<double>(), 1.0 / 3 - 1e-6);
  const Json two = documents("--algorithm 3,first");
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].at("frame"), 3);
  EXPECT_TRUE(documents("--algorithm none").empty());
  const Outcome wrong = run(program + scene + " --algorithm 0");
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("'0' is no frame"), std::string::npos) << wrong.err;
}

}  // namespace
