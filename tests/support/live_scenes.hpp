// Live scenes for the tests of chapters 4 to 6: opened from a text, with an account of energies and a check of overlaps that share
// nothing with the engine.
#pragma once

#include <fmt/format.h>

#include <random>

#include "ch04_multibody_stepping/live.hpp"
#include "ch04_multibody_stepping/run.hpp"
#include "common/live/copies.hpp"
#include "support/run_files.hpp"

namespace fc_test {

// Gaps are computed from sums of some metres.
inline constexpr double kRounding = 1e-14;  // m

// A floor, a wall, a ball and boxes. `rules`: further keys, a line each.
inline std::string corner_scene(const std::string& rules, int boxes) {
  return "name: corner\nstep: {dt: 0.01, duration: 0.6}\ngravity: [0, 0, -9.81]\n" + rules +
         "shapes:\n  floor: {box: {size: [20, 20, 1]}}\n  wall: {box: {size: [1, 20, 8]}}\n"
         "  block: {box: {size: [0.4, 0.5, 0.6]}, density: 500}\n  ball: {sphere: {radius: 0.3}, density: 800}\n"
         "bodies:\n  - {shape: floor, static: true, position: [0, 0, -0.5]}\n"
         "  - {shape: wall, static: true, position: [3.5, 0, 4]}\n"
         "  - {shape: ball, position: [-2, 0, 0.31]}\n"
         "  - {shape: block, grid: {count: [" +
         std::to_string(boxes) + ", 2, 1], spacing: [0.8, 0.9, 1]}, position: [-1, 0, 0.301]}\n";
}

struct LiveScene {
  std::filesystem::path file;
  int chapter;
  std::unique_ptr<fc::live::Simulation> live;

  LiveScene(const std::string& text, const fc::world::LiveChapter& chapter_of)
      : file(scratch("live") / "scene.yaml"), chapter(chapter_of.number) {
    std::ofstream(file) << text;
    live = fc::world::make_live({file, {}, {}, chapter}, chapter_of);
  }
  fc::live::Simulation* operator->() const { return live.get(); }
};

inline double sum_of(const fc::live::Snapshot& now) {
  double sum = 0;
  for (const auto& [name, energy] : now.account) sum += energy;
  return sum;
}
inline double entry(const fc::live::Snapshot& now, const std::string& name) {
  for (const auto& [known, energy] : now.account)
    if (known == name) return energy;
  return 0;
}

// Watches a live scene: the account has to be closed at every frame, up to the round-off of sums, and of solvers that find
// impulses to a part in 10^10: a part in 10^9 of all that was ever booked.
class Bookkeeper {
 public:
  explicit Bookkeeper(const fc::live::Snapshot& start)
      : start_(start.energy - sum_of(start)), last_(start), size_(scale(start)) {}
  void look(const fc::live::Snapshot& now) {
    for (const auto& [name, energy] : now.account) size_ += std::abs(energy - entry(last_, name));
    size_ = std::max(size_, scale(now));
    last_ = now;
    EXPECT_NEAR(now.energy, start_ + sum_of(now), 1e-9 * size_) << "frame " << now.frame;
  }

 private:
  static double scale(const fc::live::Snapshot& now) { return now.kinetic + std::abs(now.potential); }
  double start_;
  fc::live::Snapshot last_;
  double size_;
};

// A ball or a box where it is: the shape's frame is at the centre of mass.
struct Block {
  fc::Vec3 at, half;  // m, of its core (a ball's: 0)
  fc::Mat3 axes;
  double radius = 0;
};
inline Block block_of(const fc::ShapeSpec& shape, const fc::live::Pose& pose) {
  Block block{pose.position, fc::Vec3::Zero(), pose.orientation.toRotationMatrix()};
  if (const auto* ball = std::get_if<fc::SphereSpec>(&shape.geometry))
    block.radius = ball->radius;
  else
    block.half = 0.5 * std::get<fc::BoxSpec>(shape.geometry).size;
  return block;
}

// The largest gap of the two along any direction that can separate them: normals of faces, products of edges, and the line from
// a ball's centre to the nearest point of the other core. m; of disjoint ones > 0.
inline double gap_of(const Block& a, const Block& b) {
  std::vector<fc::Vec3> directions;
  for (int i = 0; i < 3; ++i) {
    directions.insert(directions.end(), {a.axes.col(i), b.axes.col(i)});
    for (int j = 0; j < 3; ++j) directions.emplace_back(a.axes.col(i).cross(b.axes.col(j)));
  }
  for (const auto& [ball, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    const fc::Vec3 local = other->axes.transpose() * (ball->at - other->at);
    const fc::Vec3 nearest = local.cwiseMax(-other->half).cwiseMin(other->half);
    if (ball->half.isZero(0)) directions.emplace_back(other->axes * (local - nearest));
  }
  double widest = -std::numeric_limits<double>::infinity();
  for (const fc::Vec3& direction : directions) {
    if (direction.norm() < 1e-9) continue;
    const fc::Vec3 n = direction.normalized();
    widest = std::max(widest, std::abs(n.dot(b.at - a.at)) - a.half.dot((a.axes.transpose() * n).cwiseAbs()) -
                                  b.half.dot((b.axes.transpose() * n).cwiseAbs()) - a.radius - b.radius);
  }
  return widest;
}

// The scene as a run of the saved text sees it; chapter: that may read it.
inline fc::Scene scene_of(const std::string& text, int chapter) {
  return fc::read_scene_text(text, {"saved.yaml", {}, {}, chapter});
}

inline void expect_apart(const fc::Scene& scene, const fc::live::Snapshot& now) {
  ASSERT_EQ(now.poses.size(), scene.bodies.size());
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    blocks.push_back(block_of(scene.shapes[static_cast<std::size_t>(scene.bodies[i].shape)], now.poses[i]));
  for (std::size_t a = 0; a < blocks.size(); ++a)
    for (std::size_t b = a + 1; b < blocks.size(); ++b) {
      if (scene.bodies[a].is_static && scene.bodies[b].is_static) continue;
      ASSERT_GT(gap_of(blocks[a], blocks[b]), -kRounding)
          << "bodies " << a << " and " << b << " overlap in frame " << now.frame;
    }
}

// Everything a page sees of a frame, but for times, to the last bit.
inline std::string bits(const fc::live::Snapshot& now) {
  std::string text = fmt::format("{} {} {} {}\n", now.energy, now.kinetic, now.potential, now.min_gap);
  for (const fc::live::Pose& pose : now.poses) {
    const fc::Vec3& x = pose.position;
    const fc::Quat& q = pose.orientation;
    text += fmt::format("{} {} {} {} {} {} {}\n", x.x(), x.y(), x.z(), q.w(), q.x(), q.y(), q.z());
  }
  return text;
}

inline std::string refusal(const std::function<void()>& command) {
  try {
    command();
    return "";
  } catch (const fc::InputError& error) {
    return error.what();
  }
}

// A page's user who grabs, drags, drops and throws at random, for `frames` frames; the account is closed at each, and nothing
// overlaps at every `look`-th. Throws may be refused.
inline void play(const LiveScene& scene, int frames, int look, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto place = [&] { return fc::Vec3(uniform(-3, 5), uniform(-3, 3), uniform(-1, 3)); };
  Bookkeeper book(scene->snapshot());
  int thrown = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const fc::live::Snapshot now = scene->snapshot();
    const int body = static_cast<int>(uniform(0, static_cast<double>(now.poses.size())));
    if (uniform(0, 1) < 0.02 && body > 1)
      scene->grab(body, now.poses[static_cast<std::size_t>(body)].position + 0.2 * fc::Vec3::Random());
    if (now.grabbed >= 0 && uniform(0, 1) < 0.1) scene->drag(place());
    if (uniform(0, 1) < 0.005) scene->drop();
    if (thrown < 5 && uniform(0, 1) < 0.01 &&
        refusal([&] { scene->throw_ball(place() + fc::Vec3(0, 0, 2), 3 * fc::Vec3::Random()); }).empty())
      ++thrown;
    scene->step();
    book.look(scene->snapshot());
    if (frame % look == 0) expect_apart(scene_of(scene->save().text, scene.chapter), scene->snapshot());
  }
  EXPECT_NE(entry(scene->snapshot(), "hand"), 0);
  EXPECT_LE(entry(scene->snapshot(), "impacts"), 0);
}

// Lifts body 4 by a point (arm: m, from its centre), and throws a ball at it; 50 frames.
inline void pull_and_throw(const LiveScene& scene, const fc::Vec3& arm) {
  scene->grab(4, scene->snapshot().poses[4].position + arm);
  scene->drag({0, 0, 2});
  for (int frame = 0; frame < 40; ++frame) scene->step();
  scene->throw_ball({-3, 0, 3}, {5, 0, 0});
  for (int frame = 0; frame < 10; ++frame) scene->step();
}

inline void expect_stages_add_up(const LiveScene& scene) {
  for (int frame = 0; frame < 50; ++frame) {
    scene->step();
    const auto now = scene->snapshot();
    double sum = 0;
    for (const auto& [stage, time] : now.stages) {
      EXPECT_GE(time, 0) << stage;
      sum += time;
    }
    EXPECT_NEAR(sum, now.step_ms, 1e-9 + 1e-3 * now.step_ms);
  }
}

// Saves, and runs the saved text from a file: the same poses in all frames.
inline void expect_saved_runs_alike(
    const LiveScene& scene,
    const std::function<void(const fc::Scene&, const fc::RunContext&, fc::Summary&)>& run) {
  const auto folder = scratch("saved");
  const std::string text = scene->save().text;
  std::ofstream(folder / "scene.yaml") << text;
  const fc::Scene saved = fc::read_scene({folder / "scene.yaml", {}, {}, scene.chapter});
  fc::RunContext context;
  context.chapter = "test";
  context.out_dir = folder;
  context.poses = context.quiet = true;
  fc::Summary summary;
  run(saved, context, summary);
  const Table poses = read_table(folder / "poses.csv");
  const int bodies = static_cast<int>(saved.bodies.size());
  ASSERT_EQ(poses.rows(), (saved.step->frames + 1) * bodies);
  for (int frame = 0; frame <= saved.step->frames; ++frame) {
    const fc::live::Snapshot now = scene->snapshot();
    for (int body = 0; body < bodies; ++body) {
      const int row = frame * bodies + body;
      const fc::live::Pose& pose = now.poses[static_cast<std::size_t>(body)];
      ASSERT_EQ(poses.at(row, "px"), pose.position.x()) << "frame " << frame << ", body " << body;
      ASSERT_EQ(poses.at(row, "py"), pose.position.y());
      ASSERT_EQ(poses.at(row, "pz"), pose.position.z());
      ASSERT_EQ(poses.at(row, "qw"), pose.orientation.w());
      ASSERT_EQ(poses.at(row, "qx"), pose.orientation.x());
      ASSERT_EQ(poses.at(row, "qy"), pose.orientation.y());
      ASSERT_EQ(poses.at(row, "qz"), pose.orientation.z());
    }
    scene->step();
  }
}

// Drags the body into the wall, for a second, and looks at every frame.
inline void expect_outside_of_wall(const LiveScene& scene, int body) {
  const fc::Scene bodies = scene_of(scene->save().text, scene.chapter);
  scene->grab(body, scene->snapshot().poses[static_cast<std::size_t>(body)].position);
  Bookkeeper book(scene->snapshot());
  double farthest = -10;
  for (int frame = 0; frame < 100; ++frame) {
    scene->drag({6, 0, 1});  // behind the wall
    scene->step();
    const fc::live::Snapshot now = scene->snapshot();
    expect_apart(bodies, now);
    book.look(now);
    farthest = std::max(farthest, now.poses[static_cast<std::size_t>(body)].position.x());
  }
  EXPECT_GT(farthest, 2.5) << "it never came to the wall";
}

// A scene beside its copy.
struct TwoScenes {
  explicit TwoScenes(const LiveScene& of) : scene(*of.live), copies(scene) {}

  void step() {
    copies.step([] { return false; });
  }
  fc::live::TwinState twin() const { return copies.twin(scene.snapshot()).value(); }

  fc::live::Simulation& scene;
  fc::live::Copies copies;
};

inline void expect_alike(const TwoScenes& two) {
  const fc::live::TwinState twin = two.twin();
  ASSERT_EQ(bits(twin.now), bits(two.scene.snapshot())) << "frame " << twin.now.frame;
  ASSERT_EQ(twin.distance.metres, 0);
  ASSERT_FALSE(twin.failed.has_value());
}

// The same is done to both: hand, ball, save and reset. They are alike to the last digit in more than 200 frames.
inline void expect_copy_alike(const LiveScene& of, const fc::Vec3& arm) {
  for (int frame = 0; frame < 30; ++frame) of->step();
  TwoScenes two(of);
  EXPECT_TRUE(two.copies.begin_twin().rebuilt);
  const auto run = [&](int frames) {
    for (int frame = 0; frame < frames; ++frame) {
      two.step();
      ASSERT_NO_FATAL_FAILURE(expect_alike(two));
    }
  };
  run(60);
  two.copies.grab(4, of->snapshot().poses[4].position + arm);
  two.copies.drag({0, 0, 2});
  run(40);
  two.copies.throw_ball({-3, 0, 3}, {5, 0, 0});
  run(60);
  EXPECT_EQ(two.twin().now.grabbed, 4);
  EXPECT_GT(entry(two.twin().now, "hand"), 0);
  two.copies.save();  // lets go
  EXPECT_EQ(two.twin().now.grabbed, -1);
  run(50);
  two.copies.reset();
  EXPECT_EQ(two.twin().now.frame, 0);
  run(20);
}

// The largest distance in `frames` frames, after one key of the copy was set and a ball was thrown. Both accounts stay closed, and
// their times meet.
inline double farthest_with(const LiveScene& of, const std::string& key, const std::string& value,
                            int frames) {
  TwoScenes two(of);
  two.copies.begin_twin();
  two.copies.set(key, value, true);
  two.copies.throw_ball({-3, 0, 3}, {5, 0, -4});
  Bookkeeper of_scene(two.scene.snapshot()), of_twin(two.twin().now);
  double farthest = 0;
  for (int frame = 0; frame < frames; ++frame) {
    two.step();
    const fc::live::TwinState twin = two.twin();
    EXPECT_FALSE(twin.failed.has_value()) << *twin.failed;
    EXPECT_TRUE(std::isfinite(twin.distance.metres)) << "frame " << frame;
    EXPECT_NEAR(twin.now.t, two.scene.snapshot().t, 1e-11);
    of_scene.look(two.scene.snapshot());
    of_twin.look(twin.now);
    farthest = std::max(farthest, twin.distance.metres);
  }
  return farthest;
}

}  // namespace fc_test
