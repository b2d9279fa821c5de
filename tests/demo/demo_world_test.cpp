// The demo at full size through the library: between frames, too.
#include <gtest/gtest.h>

#include "demo_run.hpp"
#include "support/worlds.hpp"

namespace {

using namespace fc_test;

// The largest number of node pairs that one query for a pair's next contact may look at: the two trees together have
// some 72,000 nodes, and brute force would look at 5e9 pairs of triangles.
constexpr std::int64_t kMostNodePairs = 6000;

TEST(DemoWorld, KeepsTheLawsAtEveryInstantAndNeverOverlaps) {
  FC_SKIP_WITHOUT_THE_BUNNY();
  const fc::Scene scene = fc::read_scene({demo_scene, {}, {}, 4});
  fc::world::World world = fc::world::build_world(scene);
  const independent::Solid bunny = independent::make_solid(independent::read_obj(bunny_file), 1000);
  const std::vector<independent::Solid> bunnies{bunny, bunny};
  const fc::RigidBody& body = world.bodies[0].state;
  EXPECT_NEAR(body.mass, bunny.mass, 1e-10 * bunny.mass);
  for (int i = 0; i < 3; ++i)
    EXPECT_LT(norm(bunny.inertia[i] - vec(body.inertia_body.row(i).transpose())),
              1e-10 * body.inertia_body.norm());

  const Film seen = film(world, bunnies, scene.step->dt, scene.step->frames, 4, independent::How::tree);
  ASSERT_GE(seen.jumps.size(), 2U);
  EXPECT_EQ(seen.watch.overlap, "");
  expect_laws(seen);
  int several = 0;
  for (const Jump& jump : seen.jumps) several += jump.points >= 2;
  EXPECT_GE(several, 1);

  std::vector<double> times;
  std::int64_t queries = 0, pairs = 0;
  for (const fc::world::StepReport& report : seen.reports) {
    EXPECT_EQ(report.lost_time, 0);
    EXPECT_EQ(report.energy_gain, 0);
    EXPECT_LE(report.momentum_error, 1e-10);
    EXPECT_LE(report.node_pairs, kMostNodePairs * report.queries);
    queries += report.queries;
    pairs += report.node_pairs;
    if (report.contacts > 0) times.push_back(1e-6 * static_cast<double>(report.step_ns));
  }
  EXPECT_LE(queries, 2 * (static_cast<int>(seen.reports.size()) + static_cast<int>(seen.jumps.size())));
  std::sort(times.begin(), times.end());
  std::cout << seen.jumps.size() << " instants; " << queries << " queries, " << pairs
            << " node pairs; frames with contact " << times.size() << ", median " << times[times.size() / 2]
            << " ms\n";
}

// Four spheres with bumps and dents, 612 triangles each, fly at each other: every pair of triangles is looked
// at.
constexpr const char* small_meshes = R"(
step: {dt: 0.02, duration: 2}
restitution: 0.8
shapes:
  bumpy: {mesh: bumpy.obj, density: 500}
bodies:
  - {shape: bumpy, position: [-2.2, 0.3, 0.1], velocity: [3, 0, 0], spin: [0.3, 1, -2]}
  - {shape: bumpy, position: [0.2, -0.2, 0], orientation: [0.6, 0.3, 0.5, 0.1], spin: [1, 0, 1]}
  - {shape: bumpy, position: [2.6, 0.1, -0.4], orientation: [0.1, 0.3, 0.5, 0.7], velocity: [-2, 0, 0.2]}
  - {shape: bumpy, position: [0.3, 2.5, 0.2], orientation: [0.9, 0.3, 0, 0.7], velocity: [0, -1.5, 0], spin: [0, 0, 3]}
)";

TEST(SmallMeshes, NeverOverlapByBruteForce) {
  const auto folder = scratch("bumpy");
  const independent::Mesh mesh = independent::bumpy_sphere(18, 18, 0.25);
  ASSERT_EQ(mesh.triangles.size(), 612U);
  independent::write_obj(mesh, folder / "bumpy.obj");
  std::ofstream(folder / "scene.yaml") << small_meshes;
  const fc::Scene scene = fc::read_scene({folder / "scene.yaml", {}, {}, 4});
  fc::world::World world = fc::world::build_world(scene);
  const std::vector<independent::Solid> solids(4, independent::make_solid(mesh, 500));
  ASSERT_TRUE(world.shapes[0].solid);

  const Film seen = film(world, solids, 0.02, 50, 0, independent::How::every_pair);
  EXPECT_GE(seen.jumps.size(), 4U);
  EXPECT_EQ(seen.watch.overlap, "");
  expect_laws(seen);
  std::cout << seen.jumps.size() << " instants, " << seen.watch.looks << " looks\n";
}

TEST(SmallMeshes, OfFourThousandTrianglesDoNotOverlapWhereTheyCollide) {
  const auto folder = scratch("bumpy");
  const independent::Mesh mesh = independent::bumpy_sphere(46, 44, 0.2);
  ASSERT_EQ(mesh.triangles.size(), 3960U);
  independent::write_obj(mesh, folder / "bumpy.obj");
  std::ofstream(folder / "scene.yaml") << small_meshes;
  const fc::Scene scene = fc::read_scene({folder / "scene.yaml", {}, {}, 4});
  fc::world::World world = fc::world::build_world(scene);
  const std::vector<independent::Solid> solids(4, independent::make_solid(mesh, 500));
  int instants = 0;
  for (int frame = 0; frame < 50 && instants < 2; ++frame)
    fc::world::step(world, 0.02, {.instant = [&](const fc::world::World& now, double time) {
                      if (++instants > 2) return;
                      const auto states = states_of(now, time);
                      for (const double s : {-1e-7, 0.0, 1e-7})
                        EXPECT_EQ(find_overlap(solids, independent::moved(solids, states, std::max(s, 0.0)),
                                               independent::How::every_pair),
                                  "")
                            << s;
                    }});
  EXPECT_GE(instants, 2);
}

}  // namespace
