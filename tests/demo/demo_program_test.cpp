// The demo at full size through its executable: these tests know only what it writes.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "demo_run.hpp"

namespace {

using namespace fc_test;
using independent::State, independent::Vec;

constexpr double restitution = 0.5, dt = 0.016666666666666666;
constexpr int frames = 240, triangles = 69666;

TEST(DemoProgram, KeepsTheContractTwice) {
  FC_SKIP_WITHOUT_THE_BUNNY();
  const DemoRun demo = run_demo("first");
  ASSERT_EQ(demo.outcome.exit_code, 0) << demo.outcome.err;
  EXPECT_EQ(demo.outcome.err, "");
  EXPECT_NE(demo.outcome.out.find("two_bunnies"), std::string::npos);

  EXPECT_EQ(
      demo.steps.header(),
      "step,t [s],kinetic [J],potential [J],energy [J],px [kg m/s],py [kg m/s],pz [kg m/s],lx [kg m²/s],"
      "ly [kg m²/s],lz [kg m²/s],contacts,impacts,min_gap [m],max_penetration [m],lcp_rows,lcp_residual,"
      "lost_time [s],ccd_ns,lcp_ns,step_ns");
  EXPECT_EQ(
      demo.contacts.header(),
      "t [s],body_a,body_b,x [m],y [m],z [m],nx,ny,nz,gap [m],v_before [m/s],v_after [m/s],impulse [N s]");
  EXPECT_EQ(demo.poses.header(),
            "t [s],body,px [m],py [m],pz [m],qw,qx,qy,qz,vx [m/s],vy [m/s],vz [m/s],wx [rad/s],wy [rad/s],wz "
            "[rad/s]");
  EXPECT_EQ(demo.steps.rows(), frames + 1);
  EXPECT_EQ(demo.poses.rows(), 2 * (frames + 1));
  for (const Table* table : {&demo.steps, &demo.contacts, &demo.poses}) EXPECT_TRUE(is_full(*table));

  int contacts = 0, impacts = 0;
  for (int row = 0; row <= frames; ++row) {
    EXPECT_EQ(demo.steps.at(row, "step"), row);
    EXPECT_NEAR(demo.steps.at(row, "t"), row * dt, 1e-12);
    EXPECT_EQ(demo.poses.at(2 * row, "t"), demo.steps.at(row, "t"));
    EXPECT_LE(demo.steps.at(row, "lcp_residual"), 1e-10);
    EXPECT_EQ(demo.steps.at(row, "max_penetration"), 0);
    EXPECT_EQ(demo.steps.at(row, "lost_time"), 0);
    EXPECT_GT(demo.steps.at(row, "min_gap"), 0);
    EXPECT_LE(demo.steps.at(row, "impacts"), demo.steps.at(row, "contacts"));
    EXPECT_LE(demo.steps.at(row, "ccd_ns") + demo.steps.at(row, "lcp_ns"), demo.steps.at(row, "step_ns"));
    contacts += static_cast<int>(demo.steps.at(row, "contacts"));
    impacts += static_cast<int>(demo.steps.at(row, "impacts"));
  }
  EXPECT_EQ(impacts, demo.contacts.rows());
  EXPECT_EQ(contacts, impacts);  // nobody separates here

  const auto summary = nlohmann::json::parse(contents(demo.folder / "summary.json"));
  ASSERT_TRUE(summary.contains("counters")) << summary.dump(1);
  EXPECT_GE(summary["counters"].size(), 2U);
  const std::string text = summary.dump();
  for (const char* stage : {"continuous collision queries", "LCP solves"})
    EXPECT_NE(text.find(stage), std::string::npos) << stage;

  const DemoRun again = run_demo("second");
  EXPECT_EQ(without_times(again.steps), without_times(demo.steps));
  EXPECT_EQ(contents(again.folder / "contacts.csv"), contents(demo.folder / "contacts.csv"));
  EXPECT_EQ(contents(again.folder / "poses.csv"), contents(demo.folder / "poses.csv"));

  std::vector<double> times;
  for (int row = 1; row <= frames; ++row)
    if (demo.steps.at(row, "contacts") > 0) times.push_back(1e-6 * demo.steps.at(row, "step_ns"));
  std::sort(times.begin(), times.end());
  std::cout << "frames with contact: " << times.size() << ", median " << times[times.size() / 2]
            << " ms, slowest " << times.back() << " ms\n";
}

// The states just before and after each instant: forward from the frame before, and back from the frame
// after, which is all that is needed while no frame of the demo has two instants.
TEST(DemoProgram, EveryInstantObeysTheLaws) {
  FC_SKIP_WITHOUT_THE_BUNNY();
  const DemoRun demo = run_demo("first");
  ASSERT_EQ(demo.outcome.exit_code, 0) << demo.outcome.err;
  ASSERT_EQ(demo.bunnies[0].mesh.triangles.size(), triangles);
  ASSERT_GE(demo.instants.size(), 2U) << "they collide, and collide again";
  int several_points = 0;
  for (std::size_t k = 0; k < demo.instants.size(); ++k) {
    const Instant& instant = demo.instants[k];
    ASSERT_TRUE(k == 0 || instant.frame > demo.instants[k - 1].frame) << "two instants in a frame";
    const auto before = independent::moved(demo.bunnies, demo.frames[instant.frame],
                                           instant.time - demo.steps.at(instant.frame, "t"));
    const auto after = independent::moved(demo.bunnies, demo.frames[instant.frame + 1],
                                          instant.time - demo.steps.at(instant.frame + 1, "t"));
    for (int body : {0, 1})
      EXPECT_LT(independent::distance(demo.bunnies[body], before[body], after[body]), 1e-12)
          << "an impact moves nobody";

    // All points of the instant are solved together: each sees the velocities before any of them, and all of
    // them keep Newton's law afterwards.
    double energy = 0;
    Vec push, twist;
    for (int row = instant.first; row < instant.last; ++row) {
      ASSERT_EQ(demo.contacts.at(row, "body_a"), 0);
      ASSERT_EQ(demo.contacts.at(row, "body_b"), 1);
      const Vec x{demo.contacts.at(row, "x"), demo.contacts.at(row, "y"), demo.contacts.at(row, "z")};
      const Vec n = vec(demo.contacts, row, "n");
      const double impulse = demo.contacts.at(row, "impulse");
      const auto closing = [&](const std::vector<State>& states) {
        return dot(n,
                   velocity_at(demo.bunnies[1], states[1], x) - velocity_at(demo.bunnies[0], states[0], x));
      };
      EXPECT_NEAR(norm(n), 1, 1e-14);
      EXPECT_GT(demo.contacts.at(row, "gap"), 0);
      EXPECT_LE(demo.contacts.at(row, "gap"), 1e-6);
      EXPECT_GT(impulse, 0);
      EXPECT_LT(closing(before), 0);
      EXPECT_NEAR(demo.contacts.at(row, "v_before"), closing(before), 1e-10);
      EXPECT_NEAR(demo.contacts.at(row, "v_after"), closing(after), 1e-10);
      EXPECT_NEAR(closing(after), -restitution * closing(before), 1e-10);
      energy += 0.5 * (1 - restitution) * impulse * demo.contacts.at(row, "v_before");
      push = push + impulse * n;
      twist = twist + cross(x - center(demo.bunnies[1], before[1]), impulse * n);
    }
    several_points += instant.last - instant.first >= 2;
    EXPECT_LT(norm(demo.bunnies[1].mass * (after[1].velocity - before[1].velocity) - push),
              1e-9 * norm(push));

    const independent::Totals from = totals(demo.bunnies, before), to = totals(demo.bunnies, after);
    EXPECT_LE(to.kinetic, from.kinetic);
    EXPECT_NEAR(to.kinetic - from.kinetic, energy, 1e-10 * from.kinetic);
    EXPECT_LE(norm(to.linear - from.linear), 1e-10 * from.linear_size);
    EXPECT_LE(norm(to.angular - from.angular), 1e-10 * from.angular_size);
  }
  EXPECT_GE(several_points, 1) << "two points at once";

  // They turn between their first and their last collision.
  const State &first = demo.frames[demo.instants.front().frame][1],
              &last = demo.frames[demo.instants.back().frame][1];
  EXPECT_GT(independent::distance(demo.bunnies[1], {{}, first.orientation, {}, {}, {}},
                                  {{}, last.orientation, {}, {}, {}}),
            0.1);

  // steps.csv says the same energies and momenta as the poses.
  for (int row = 0; row <= frames; ++row) {
    const independent::Totals sum = totals(demo.bunnies, demo.frames[row]);
    EXPECT_NEAR(demo.steps.at(row, "kinetic"), sum.kinetic, 1e-9 * sum.kinetic);
    EXPECT_LE(norm(vec(demo.steps, row, "p") - sum.linear), 1e-9 * sum.linear_size);
    EXPECT_LE(norm(vec(demo.steps, row, "l") - sum.angular), 1e-9 * sum.angular_size);
    EXPECT_EQ(demo.steps.at(row, "potential"), 0);
    EXPECT_LE(norm(vec(demo.steps, row, "p") - vec(demo.steps, 0, "p")), 1e-12 * sum.linear_size);
  }
}

TEST(DemoProgram, BunniesNeverOverlap) {
  FC_SKIP_WITHOUT_THE_BUNNY();
  const DemoRun demo = run_demo("first");
  ASSERT_EQ(demo.outcome.exit_code, 0) << demo.outcome.err;
  independent::Watch watch;
  std::size_t next = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const double begin = demo.steps.at(frame, "t"), end = demo.steps.at(frame + 1, "t");
    if (next == demo.instants.size() || demo.instants[next].frame != frame) {
      independent::watch(demo.bunnies, {begin, end, demo.frames[frame]}, 4, independent::How::tree, watch);
      continue;
    }
    const double t = demo.instants[next++].time;
    ASSERT_TRUE(next == demo.instants.size() || demo.instants[next].frame != frame)
        << "two instants in a frame";
    const auto after = independent::moved(demo.bunnies, demo.frames[frame + 1], t - end);
    independent::watch(demo.bunnies, {begin, t, demo.frames[frame]}, 100, independent::How::tree, watch);
    independent::watch(demo.bunnies, {t, end, after}, 100, independent::How::tree, watch);
  }
  ASSERT_EQ(next, demo.instants.size());
  EXPECT_EQ(watch.overlap, "");
  EXPECT_GT(watch.looks, 5 * frames);

  // The same poses, moved into each other by a millimetre along the contact's normal, are seen to overlap.
  // Moved apart from there by the gap and a little, they are not: what is seen is the gap, not the
  // millimetre.
  for (const Instant& instant : demo.instants) {
    auto states = independent::moved(demo.bunnies, demo.frames[instant.frame],
                                     instant.time - demo.steps.at(instant.frame, "t"));
    const Vec n = vec(demo.contacts, instant.first, "n"), there = states[1].position;
    for (const double deeper : {1e-3, 1e-4, 2e-6}) {
      states[1].position = there - deeper * n;
      EXPECT_NE(find_overlap(demo.bunnies, states, independent::How::tree), "")
          << deeper << " m at " << instant.time;
    }
    states[1].position = there;
    EXPECT_EQ(find_overlap(demo.bunnies, states, independent::How::tree), "");
  }
}

}  // namespace
