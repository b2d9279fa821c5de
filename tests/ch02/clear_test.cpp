// The clear tree and search against the fast ones: never late, and where the fast search is.
#include <gtest/gtest.h>

#include "ch02_hull_hierarchy/advance.hpp"
#include "ch02_hull_hierarchy/features.hpp"
#include "ch02_hull_hierarchy/hull_model.hpp"
#include "ch02_hull_hierarchy/study/motions.hpp"
#include "ch02_hull_hierarchy/toc_by_pieces.hpp"
#include "tests/support/test_models.hpp"

namespace {

using namespace fc;
using namespace fc::hulls;

struct Meshes {
  std::string name;
  TriangleMesh mesh;
};

std::vector<Meshes> meshes() {
  test::Random random(11);
  return {{"L prism", test::l_prism()},
          {"ring", test::ring(1, 0.4, 12, 8)},
          {"star", test::star(5, 0.5)},
          {"bumpy ball", test::bumpy_ball(random, 12)}};
}

double size_of_model(const Model& model) {
  Eigen::AlignedBox3d box;
  for (const Vec3& p : model.mesh.vertices) box.extend(p);
  return box.sizes().maxCoeff();
}

Model ready(const TriangleMesh& mesh, const clear::Pieces& pieces) {
  Model model = test::model_of(mesh);
  add_hulls(model, pieces);
  return model;
}

TEST(ClearSearch, IsNeverLateAndWhereTheFastSearchIs) {
  const clear::Pieces pieces;
  for (const auto& [name, mesh] : meshes()) {
    SCOPED_TRACE(name);
    const Model model = ready(mesh, pieces);
    const double size = size_of_model(model), tolerance = 1e-6 * size;
    StudyMotions source(model, size, 21);
    int hits = 0;
    for (int k = 0; k < 24; ++k) {
      SCOPED_TRACE(k);
      MotionPair m = k % 3 == 0 ? source.close() : source.far();
      if (k % 4 == 1) m.b.acceleration = Vec3(0.1, 0, -0.5);
      TocOptions options;
      options.target = 0.5 * tolerance;
      options.slack = 0.25 * tolerance;
      options.tolerance = options.start = tolerance;
      const TimeOfContact fast = time_of_contact(model, m.a, model, m.b, options);
      const TimeOfContact found = toc_by_pieces(model, m.a, model, m.b, options, pieces);
      ASSERT_EQ(found.status, fast.status);
      EXPECT_LE(found.start_gap, model_distance(model, model, ca::PairPose(m.a, m.b, 0), tolerance).upper);
      if (fast.status == TimeOfContact::Status::clear) continue;
      ++hits;
      // When the true gap comes down to almost zero, neither search is late.
      options.target = 1e-9 * size;
      options.slack = 1e-10 * size;
      options.tolerance = options.start = 2e-9 * size;
      const TimeOfContact truth = time_of_contact(model, m.a, model, m.b, options);
      ASSERT_LE(found.time, truth.time);
      ASSERT_LE(found.pair.gjk.upper, tolerance);
      ASSERT_GE(found.pair.gjk.upper, 0.4 * tolerance) << "nearer than the target";
    }
    EXPECT_GT(hits, 6);
  }
}

TEST(ClearSearch, AnswersAdvance) {
  const clear::Pieces pieces;
  const Model model = ready(test::star(5, 0.5), pieces);
  StudyMotions source(model, size_of_model(model), 5);
  int hits = 0;
  for (int k = 0; k < 12; ++k) {
    const MotionPair m = source.far();
    ca::AdvanceOptions options;
    SearchMemory fast, clear;
    clear.pieces = &pieces;
    ca::AdvanceResult one, other;
    advance(model, m.a, model, m.b, options, fast, one);
    advance(model, m.a, model, m.b, options, clear, other);
    ASSERT_EQ(one.status, other.status);
    if (one.status != ca::Status::contact) continue;
    ++hits;
    EXPECT_NEAR(one.toc, other.toc, 1e-5);
    ASSERT_EQ(one.features.size(), other.features.size());
    for (std::size_t i = 0; i < one.features.size(); ++i) {
      EXPECT_EQ(one.features[i].id_a, other.features[i].id_a);
      EXPECT_EQ(one.features[i].id_b, other.features[i].id_b);
    }
  }
  EXPECT_GT(hits, 3);
}

TEST(ClearSearch, ConvexShapesAreOnePiece) {
  const clear::Pieces pieces;
  Model ball = test::model_of(test::sphere(0.5));
  add_hulls(ball, pieces);
  ca::Motion still, flies;
  flies.position = Vec3(-3, 0.2, 0);
  flies.velocity = Vec3(4, 0, 0);
  TocOptions options;
  const TimeOfContact fast = time_of_contact(ball, flies, ball, still, options);
  const TimeOfContact found = toc_by_pieces(ball, flies, ball, still, options, pieces);
  ASSERT_EQ(found.status, TimeOfContact::Status::reached);
  EXPECT_NEAR(found.time, fast.time, 1e-6);
}

TEST(ClearSearch, RefusesWhatItCannotDo) {
  const clear::Pieces pieces;
  const Model model = ready(test::l_prism(), pieces), bare = test::model_of(test::l_prism());
  ca::Motion still, drags;
  drags.drag = 0.1;
  EXPECT_THROW(toc_by_pieces(bare, still, model, still, {}, pieces), std::invalid_argument);
  EXPECT_THROW(toc_by_pieces(model, drags, model, still, {}, pieces), std::invalid_argument);
}

}  // namespace
