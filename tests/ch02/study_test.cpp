// The study's search, with every combination of order, bound, volume and leaves: never late, and where
// time_of_contact is.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "ch02_hull_hierarchy/convex_pieces.hpp"
#include "ch02_hull_hierarchy/study/mesh.hpp"
#include "ch02_hull_hierarchy/study/motions.hpp"
#include "ch02_hull_hierarchy/study/search.hpp"
#include "tests/support/test_models.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;

constexpr std::array kOrders = {Order::global, Order::controlled, Order::depth_first, Order::best_first};
constexpr std::array kBounds = {Bound::naive, Bound::directional, Bound::second_order, Bound::points};
constexpr std::array kVolumes = {Volume::sphere, Volume::swept_sphere, Volume::box, Volume::hull};

TocOptions options_at(double tolerance) {
  TocOptions options;
  options.tolerance = options.start = tolerance;
  options.target = 0.5 * tolerance;
  options.slack = 0.25 * tolerance;
  return options;
}

TriangleMesh mesh_named(const std::string& name) {
  if (name == "ring") return test::ring(1, 0.4, 12, 8);
  if (name == "star") return test::star(5, 0.5);
  return test::l_prism();
}

int points_of(const HullModel& model, std::size_t node) {
  return static_cast<int>(model.tree.nodes[node].points.size());
}

class StudySearch : public ::testing::TestWithParam<std::string> {};

TEST_P(StudySearch, EveryCombinationFindsTheFirstContact) {
  const Model model = test::model_of(mesh_named(GetParam()));
  const Lists pieces = convex_pieces(model.mesh);
  Shape shape;
  shape.core.vertices = model.mesh.vertices;
  const double size = size_of(shape), tolerance = 1e-5 * size;
  StudyMotions source(model, size, 7);
  std::vector<MotionPair> motions;
  for (int i = 0; i < 4; ++i) motions.push_back(source.far());
  for (int i = 0; i < 3; ++i) motions.push_back(source.close());
  motions.back().b.acceleration = Vec3(0.1, 0, -0.5);
  std::vector<TimeOfContact> truth, found;
  for (const MotionPair& m : motions) {
    truth.push_back(time_of_contact(model, m.a, model, m.b, options_at(1e-11 * size)));
    found.push_back(time_of_contact(model, m.a, model, m.b, options_at(tolerance)));
  }
  int hits = 0;
  for (const Volume volume : kVolumes)
    for (const Leaves leaves : {Leaves::pieces, Leaves::triangles}) {
      const HullModel hulls = build_study_model(model, pieces, {volume, leaves, 8});
      for (const Order order : kOrders)
        for (const Bound bound : kBounds)
          for (std::size_t i = 0; i < motions.size(); ++i) {
            SCOPED_TRACE(std::string(name_of(order)) + ", " + name_of(bound) + ", " + name_of(volume) + ", " +
                         name_of(leaves) + ", motion " + std::to_string(i));
            const MotionPair& m = motions[i];
            const StudyTimeOfContact r =
                study_time_of_contact(hulls, m.a, hulls, m.b, options_at(tolerance), {order, bound});
            ASSERT_EQ(r.status, found[i].status);
            if (r.status != TimeOfContact::Status::reached) continue;
            ++hits;
            EXPECT_LE(r.time, truth[i].time);
            const ModelDistance d = model_distance(model, model, ca::PairPose(m.a, m.b, r.time), 1e-9 * size);
            EXPECT_LE(d.lower, tolerance);
            EXPECT_GE(d.upper, 0.4999 * tolerance);
            EXPECT_EQ(r.rounds > 0, order == Order::global || order == Order::controlled);
          }
    }
  EXPECT_GT(hits, 0);
}

INSTANTIATE_TEST_SUITE_P(Meshes, StudySearch, ::testing::Values("ring", "star", "l_prism"));

TEST(StudySearchLimits, GivesUpWithoutSayingMoreThanIsProved) {
  const Model model = test::model_of(test::ring(1, 0.4, 12, 8));
  const HullModel hulls = build_study_model(model, convex_pieces(model.mesh), {});
  MotionPair m;
  m.b.position = Vec3(5, 0.3, 0.2);
  m.b.velocity = Vec3(-6, 0, 0);
  const double truth = time_of_contact(model, m.a, model, m.b, options_at(1e-9)).time;
  for (const Order order : kOrders)
    for (const int most : {1, 5, 20}) {
      TocOptions options = options_at(1e-6);
      options.max_pairs = most;
      const StudyTimeOfContact r =
          study_time_of_contact(hulls, m.a, hulls, m.b, options, {order, Bound::naive});
      EXPECT_EQ(r.status, TimeOfContact::Status::limit) << name_of(order) << most;
      EXPECT_LE(r.time, truth);
    }
}

TEST(StudySearchVisits, EveryLookIsNoted) {
  const Model model = test::model_of(test::star(5, 0.5));
  const HullModel hulls = build_study_model(model, convex_pieces(model.mesh), {});
  MotionPair m;
  m.b.position = Vec3(4, 0.3, 0.2);
  m.b.velocity = Vec3(-6, 0, 0);
  for (const Order order : kOrders) {
    std::vector<Visit> visits;
    const StudyTimeOfContact r =
        study_time_of_contact(hulls, m.a, hulls, m.b, options_at(1e-6), {order, Bound::points, &visits});
    ASSERT_EQ(r.status, TimeOfContact::Status::reached);
    EXPECT_EQ(static_cast<std::int64_t>(visits.size()), r.node_pairs + r.leaf_pairs);
    EXPECT_TRUE(
        std::any_of(visits.begin(), visits.end(), [](const Visit& v) { return v.fate == Fate::reached; }));
  }
}

TEST(StudyTree, VolumesHoldWhatIsBelow) {
  const Model model = test::model_of(test::ring(1, 0.4, 30, 20));
  const Lists pieces = convex_pieces(model.mesh);
  for (const Leaves leaves : {Leaves::pieces, Leaves::triangles}) {
    const HullModel hulls = build_study_model(model, pieces, {Volume::hull, leaves});
    for (const Volume volume : kVolumes)
      for (const int most : {4, 8, 32}) {
        const HullModel volumes = build_study_model(model, pieces, {volume, leaves, most});
        double sum = 0;
        for (int n = 0; n < static_cast<int>(hulls.tree.nodes.size()); ++n)
          for (const Vec3& d : even_directions(50)) {
            const double over = overhang(volumes, hulls, n, d);
            ASSERT_GE(over, -1e-15) << name_of(volume) << " " << n;
            if (hulls.tree.nodes[n].leaf()) {
              ASSERT_EQ(over, 0);
            }
            sum += over;
          }
        if (volume != Volume::hull || most == 4) {
          EXPECT_GT(sum, 0);
        }
        if (volume != Volume::hull) continue;
        for (std::size_t n = 0; n < hulls.tree.nodes.size(); ++n) {
          const int before = points_of(hulls, n), now = points_of(volumes, n);
          EXPECT_TRUE(hulls.tree.nodes[n].leaf() || before <= most ? now == before : now <= most) << n;
        }
      }
  }
}

TEST(StudyMesh, DecimationStaysClosed) {
  const TriangleMesh mesh = test::ring(1, 0.4, 60, 40);
  for (const std::size_t target : {2000u, 500u, 100u}) {
    const PreparedMesh coarse = prepare_mesh(decimated(mesh, target));
    EXPECT_TRUE(coarse.report.solid);
    EXPECT_LE(coarse.mesh.triangles.size(), target + 1);
    EXPECT_GE(coarse.mesh.triangles.size(), target / 2);
  }
}

// The program: what it does with wrong words, and that a part writes its table.
int run_study(const std::string& arguments) {
  const int status = std::system((FC_BIN_DIR "/ch02_study " + arguments + " > /dev/null 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(StudyProgram, WritesTablesAndRefusesBadInput) {
  const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "ch02_study";
  std::filesystem::create_directories(folder);
  std::ofstream obj(folder / "ring.obj");
  const TriangleMesh mesh = test::ring(1, 0.4, 24, 16);
  for (const Vec3& v : mesh.vertices) obj << "v " << v.x() << " " << v.y() << " " << v.z() << "\n";
  for (const auto& [i, j, k] : mesh.triangles) obj << "f " << i + 1 << " " << j + 1 << " " << k + 1 << "\n";
  obj.close();
  const std::string out = " --out " + folder.string(), ring = " --mesh " + (folder / "ring.obj").string();
  EXPECT_EQ(run_study("--help"), 0);
  EXPECT_EQ(run_study("--part nothing" + out), 2);
  EXPECT_EQ(run_study("--part ideas --mesh nowhere.obj" + out), 2);
  for (const std::string part :
       {"ideas", "leaves", "tightness", "tolerance", "triangles", "approach", "discrete"}) {
    EXPECT_EQ(run_study("--part " + part + " --far 20 --close 3 --quiet" + ring + out), 0) << part;
    std::ifstream table(folder / (part + ".csv"));
    std::string line;
    int rows = -1;
    while (std::getline(table, line)) ++rows;
    EXPECT_GE(rows, 3) << part;
  }
  EXPECT_EQ(run_study("--part pictures --far 20 --close 1 --quiet" + ring + out), 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "hulls.csv") &&
              std::filesystem::exists(folder / "visits.csv"));
}

}  // namespace
