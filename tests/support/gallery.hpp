// The independent overlap check on what a scene's run wrote: does anything overlap, in any frame?
#pragma once

#include "demo/demo_run.hpp"
#include "support/independent_gap.hpp"
#include "support/worlds.hpp"

namespace fc_test {

// A touch may be this much of an overlap: rounding of poses that are written with 17 digits, at some metres.
inline constexpr double kTouch = 1e-13;

inline independent::Rounded shape_of(const fc::ShapeSpec& spec) {
  const auto& g = spec.geometry;
  if (const auto* ball = std::get_if<fc::SphereSpec>(&g)) return independent::rounded_ball(ball->radius);
  if (const auto* rod = std::get_if<fc::CapsuleSpec>(&g))
    return independent::rounded_rod(rod->radius, rod->length);
  if (const auto* block = std::get_if<fc::BoxSpec>(&g))
    return independent::rounded_block(fc_test::vec(block->size));
  if (const auto* hull = std::get_if<fc::HullSpec>(&g)) {
    std::vector<independent::Vec> points;
    for (const fc::Vec3& p : hull->points) points.push_back(fc_test::vec(p));
    return independent::rounded_hull(points);
  }
  const fc::MeshSpec& spec_of_mesh = std::get<fc::MeshSpec>(g);
  independent::Mesh mesh = independent::read_obj(spec_of_mesh.file);
  for (independent::Vec& x : mesh.vertices) x = spec_of_mesh.scale * x;
  return independent::rounded_mesh(mesh);
}

// The seconds of a scene that are run: all of them, or fewer under sanitizers.
inline std::vector<std::string> seconds_of([[maybe_unused]] const char* sanitized) {
#ifdef FC_SANITIZED
  return {std::string("step.duration=") + sanitized};
#else
  return {};
#endif
}
inline std::string options_of(const std::vector<std::string>& overrides) {
  std::string options;
  for (const std::string& set : overrides) options += " --set " + set;
  return options;
}

// Reads poses.csv in `folder`, which a run of the scene (as read for `chapter`, with these values set) wrote.
inline void expect_no_overlap(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                              int chapter, const std::filesystem::path& folder) {
  using namespace independent;
  const std::string name = file.stem();
  const fc::Scene scene = fc::read_scene({file, overrides, {}, chapter});
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
        const double reach = one.reach + one.radius + other.reach + other.radius;
        if (!meets(a, b) || norm(at_a.position - at_b.position) > 1.05 * reach) continue;
        ++looked;
        ASSERT_TRUE(apart(one, at_a, other, at_b, kTouch))
            << name << ": bodies " << a << " and " << b << " overlap in frame " << frame;
      }
  EXPECT_GT(looked, 0) << "nothing ever came near anything";
}

}  // namespace fc_test
