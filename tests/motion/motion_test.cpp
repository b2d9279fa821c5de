// Recorded motion: the file is right, shows what was recorded, and is the same each time.
#include "common/motion_recording.hpp"

#include <numbers>

#include "glb_reader.hpp"
#include "run_files.hpp"

namespace {

using namespace fc_test;
using fc::MotionRecording;
using fc::Quat;
using fc::RigidBody;
using fc::Vec3;

fc::Shape shape(fc::Shape::Kind kind) {
  fc::ShapeSpec spec;
  spec.name = "thing";
  if (kind == fc::Shape::Kind::sphere) spec.geometry = fc::SphereSpec{0.5};
  if (kind == fc::Shape::Kind::capsule) spec.geometry = fc::CapsuleSpec{0.5, 1};
  if (kind == fc::Shape::Kind::box) spec.geometry = fc::BoxSpec{Vec3(1, 2, 3)};
  spec.mass = 1;
  return fc::build_shape(spec, 0);
}

RigidBody body(const Vec3& position, const Vec3& velocity = Vec3::Zero(), const Vec3& spin = Vec3::Zero()) {
  RigidBody b;
  b.position = position;
  b.velocity = velocity;
  b.spin = spin;
  b.mass = b.inverse_mass = 1;
  return b;
}
RigidBody at(RigidBody b, double t) {
  b.position += t * b.velocity;
  if (b.spin.norm() > 0)
    b.orientation = Quat(Eigen::AngleAxisd(b.spin.norm() * t, b.spin.normalized())) * b.orientation;
  return b;
}

Glb written(MotionRecording& motion, const std::string& name = "motion") {
  const auto folder = scratch(name);
  motion.write(folder);
  return Glb(contents(folder / "motion.glb"));
}

// The pose of a node at t as a viewer finds it: straight, and the shorter way round, from key to key.
struct Shown {
  Vec3 position;
  Quat turn;
};
Shown shown(const Glb& glb, const std::string& node, double t) {
  const Glb::Track p = glb.track(node, "translation"), q = glb.track(node, "rotation");
  std::size_t k = 0;
  while (k + 1 < p.times.size() && p.times[k + 1] <= t) ++k;
  const std::size_t next = p.stepwise ? k : std::min(k + 1, p.times.size() - 1);
  const double s = next == k ? 0 : std::clamp((t - p.times[k]) / (p.times[next] - p.times[k]), 0.0, 1.0);
  const auto turn = [&](std::size_t i) {
    return Quat(q.values[4 * i + 3], q.values[4 * i], q.values[4 * i + 1], q.values[4 * i + 2]);
  };
  const auto place = [&](std::size_t i) {
    return Vec3(p.values[3 * i], p.values[3 * i + 1], p.values[3 * i + 2]);
  };
  return {(1 - s) * place(k) + s * place(next), turn(k).slerp(s, turn(next))};
}

std::string decoded(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int have = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    have += 6;
    if (have >= 8) bytes += static_cast<char>(bits >> (have -= 8) & 255);
  }
  return bytes;
}

TEST(Motion, ShowsAFlightWithAKinkAtTheImpact) {
  MotionRecording motion("flight", "test", 0.1);
  motion.add_shape(shape(fc::Shape::Kind::box));
  RigidBody flying = body({1, 2, 3}, {4, 0, 0}, {0, 0, 2}), resting = body({0, 0, 0});
  resting.inverse_mass = 0;
  motion.add_body(0, flying);
  motion.add_body(0, resting);
  const double impact = 0.537;
  RigidBody after = at(flying, impact);
  after.velocity = {0, -3, 0};
  after.spin = {0, 5, 0};
  for (int k = 0; k <= 10; ++k) {
    const double t = 0.1 * k;
    if (k == 6) {
      motion.key(0, impact, after);
      motion.contact(impact, {3, 2, 3}, Vec3::UnitX(), 7);
      motion.contact(impact, {3, 2.5, 3}, Vec3::UnitX(), 3.5);
    }
    motion.frame(t, {t < impact ? at(flying, t) : at(after, t - impact), resting});
    motion.value("energy", "kinetic", "J", 1.0 / (1 + k));
  }
  const Glb glb = written(motion);
  EXPECT_FALSE(glb.moves("body_1"));
  for (const double t : {0.0, 0.05, 0.3, 0.53, 0.537, 0.54, 0.6, 0.95, 1.0}) {
    const Shown seen = shown(glb, "body_0", t);
    const RigidBody truth = t < impact ? at(flying, t) : at(after, t - impact);
    EXPECT_LT((seen.position - truth.position).norm(), 2e-6) << t;
    EXPECT_LT(seen.turn.angularDistance(truth.orientation), 2e-6) << t;
  }
  const auto& extras = glb.json["scenes"][0]["extras"];
  EXPECT_EQ(glb.numbers(extras["impact_times"]), std::vector<double>{static_cast<double>(0.537f)});
  EXPECT_EQ(glb.numbers(extras["frame_times"]).size(), 11u);
  EXPECT_EQ(extras["series"][0]["name"], "kinetic");
  EXPECT_EQ(glb.numbers(extras["series"][0]["values"])[3], 0.25);

  // Arrows: hidden until the impact, then as long as their impulses are to each other, then hidden again.
  const double reach = std::sqrt(14.0) / 2;
  for (const auto& [slot, size] : {std::pair("contact_0", 1.0), std::pair("contact_1", 0.5)}) {
    const Glb::Track scale = glb.track(slot, "scale");
    EXPECT_TRUE(scale.stepwise);
    ASSERT_EQ(scale.times.size(), 3u);
    EXPECT_EQ(scale.times[0], 0);
    EXPECT_EQ(scale.times[1], static_cast<double>(0.537f));
    EXPECT_NEAR(scale.times[2], 0.537 + 0.6, 1e-6);
    EXPECT_EQ(scale.values[0], 0);
    EXPECT_NEAR(scale.values[3], 0.8 * size * reach, 1e-6);
    EXPECT_EQ(scale.values[6], 0);
    const Shown arrow = shown(glb, slot, 0.537 + 1e-6);
    EXPECT_LT((arrow.turn * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-6);  // along the normal
  }
}

TEST(Motion, FollowsABodyThatTurnsManyTimesInAFrame) {
  for (const double rate : {1.0, 30.0, 200.0, 900.0}) {  // rad/s, in frames of 1/60 s
    MotionRecording motion("spin", "test", 1.0 / 60);
    motion.add_shape(shape(fc::Shape::Kind::box));
    const RigidBody spinning = body({0, 0, 0}, {1, 0, 0}, rate * Vec3(1, 2, 2) / 3);
    motion.add_body(0, spinning);
    for (int k = 0; k <= 12; ++k) motion.frame(k / 60.0, {at(spinning, k / 60.0)});
    const Glb glb = written(motion);
    for (int i = 0; i <= 1000; ++i) {
      const double t = 0.2 * i / 1000;
      // Keys have float times: a fast body has turned a little before its key is due.
      EXPECT_LT(shown(glb, "body_0", t).turn.angularDistance(at(spinning, t).orientation), 1e-6 + 4e-8 * rate)
          << rate << " at " << t;
    }
    const Glb::Track track = glb.track("body_0", "rotation");
    for (std::size_t k = 1; k < track.times.size(); ++k) {
      EXPECT_GT(track.times[k], track.times[k - 1]);
      double dot = 0, size = 0;
      for (int i = 0; i < 4; ++i) {
        dot += track.values[4 * k + i] * track.values[4 * k - 4 + i];
        size += track.values[4 * k + i] * track.values[4 * k + i];
      }
      EXPECT_GT(dot, 0.7);  // less than a quarter turn, and no jump of the sign
      EXPECT_NEAR(size, 1, 1e-6);
    }
  }
}

TEST(Motion, DrawsEveryKindOfShapeOutwards) {
  for (const auto kind : {fc::Shape::Kind::sphere, fc::Shape::Kind::capsule, fc::Shape::Kind::box}) {
    MotionRecording motion("shape", "test", 1);
    motion.add_shape(shape(kind));
    motion.add_body(0, body({0, 0, 0}));
    motion.frame(0, {body({0, 0, 0})});
    const Glb glb = written(motion);
    const auto& primitive = glb.json["meshes"][0]["primitives"][0];
    const std::vector<double> x = glb.numbers(primitive["attributes"]["POSITION"]),
                              i = glb.numbers(primitive["indices"]);
    double volume = 0;
    const auto corner = [&](std::size_t k) { return Vec3(x[3 * i[k]], x[3 * i[k] + 1], x[3 * i[k] + 2]); };
    for (std::size_t k = 0; k < i.size(); k += 3)
      volume += corner(k).dot(corner(k + 1).cross(corner(k + 2))) / 6;
    const double pi = std::numbers::pi, ball = pi / 6;
    const double truth = kind == fc::Shape::Kind::sphere    ? ball
                         : kind == fc::Shape::Kind::capsule ? ball + pi / 4
                                                            : 6;
    EXPECT_NEAR(volume, truth, 0.03 * truth);
    if (!primitive["attributes"].contains("NORMAL")) continue;
    const std::vector<double> n = glb.numbers(primitive["attributes"]["NORMAL"]);
    for (std::size_t k = 0; k < n.size(); k += 3) {
      EXPECT_NEAR(Vec3(n[k], n[k + 1], n[k + 2]).norm(), 1, 1e-6);
      EXPECT_GT(Vec3(n[k], n[k + 1], n[k + 2]).dot(Vec3(x[k], x[k + 1], x[k + 2])), 0);
    }
  }
}

TEST(Motion, TellsImpactsFromContactsThatLast) {
  MotionRecording motion("rest", "test", 0.1);
  motion.add_shape(shape(fc::Shape::Kind::sphere));
  motion.add_body(0, body(Vec3::Zero()));
  motion.frame(0, {body(Vec3::Zero())});
  motion.contact(0.25, Vec3::Zero(), Vec3::UnitZ(), 2);
  for (int k = 3; k < 8; ++k) motion.contact(0.1 * k, Vec3::Zero(), Vec3::UnitZ(), 1, true);
  motion.frame(0.8, {body(Vec3::Zero())});
  const Glb glb = written(motion, "rest");
  const auto& extras = glb.json["scenes"][0]["extras"];
  EXPECT_EQ(glb.numbers(extras["impact_times"]), std::vector<double>{0.25});
  EXPECT_EQ(glb.json["nodes"].size(), 4u)
      << "the world, the body, the impact's arrow, and one that comes again";
}

TEST(Motion, ReusesHiddenArrows) {
  MotionRecording motion("arrows", "test", 0.1);
  motion.add_shape(shape(fc::Shape::Kind::sphere));
  motion.add_body(0, body({0, 0, 0}));
  for (int k = 0; k <= 100; ++k) {
    motion.frame(0.1 * k, {body({0, 0, 0})});
    if (k % 10 == 5) motion.contact(0.1 * k, {0, 0, 0}, Vec3::UnitY(), 1);
  }
  const Glb glb = written(motion);
  EXPECT_EQ(glb.track("contact_0", "scale").times.size(), 21u);
  EXPECT_THROW(glb.node("contact_1"), std::runtime_error);
}

TEST(Motion, OfAThousandBodiesIsSmallAndOfTooManyKeysIsThinnedOut) {
  for (const int frames : {600, 2500}) {
    MotionRecording motion("crowd", "test", 1.0 / 60);
    motion.add_shape(shape(fc::Shape::Kind::sphere));
    std::vector<RigidBody> bodies(1000, body({0, 0, 0}, {1, 0, 0}));
    for (const RigidBody& b : bodies) motion.add_body(0, b);
    for (int k = 0; k <= frames; ++k) {
      for (RigidBody& b : bodies) b.position.x() = k / 60.0;
      motion.frame(k / 60.0, bodies);
      motion.value("energy", "kinetic", "J", k);
    }
    const auto folder = scratch("crowd");
    const std::string remark = motion.write(folder);
    const std::string bytes = contents(folder / "motion.glb");
    const Glb glb(bytes);
    const std::vector<double> times = glb.numbers(glb.json["scenes"][0]["extras"]["frame_times"]);
    const std::vector<double> energy = glb.numbers(glb.json["scenes"][0]["extras"]["series"][0]["values"]);
    ASSERT_EQ(times.size(), energy.size());
    for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(60 * times[k], energy[k], 1e-3);
    EXPECT_EQ(remark.find("one of 4 frames is kept") != std::string::npos, frames == 2500) << remark;
    EXPECT_EQ(times.size(), frames == 600 ? 601u : 626u);
    EXPECT_NEAR(shown(glb, "body_999", 5).position.x(), 5, 1e-5);
    EXPECT_LT(bytes.size(), frames == 600 ? 25'000'000u : 33'000'000u);
  }
}

TEST(Motion, RefusesWhatIsNoNumber) {
  MotionRecording motion("nan", "test", 0.1);
  motion.add_shape(shape(fc::Shape::Kind::sphere));
  motion.add_body(0, body({0, 0, 0}));
  EXPECT_THROW(motion.add_body(1, body({0, 0, 0})), std::invalid_argument);
  EXPECT_THROW(motion.frame(0, {}), std::invalid_argument);
  EXPECT_THROW(motion.frame(0, {body({NAN, 0, 0})}), std::invalid_argument);
  EXPECT_THROW(motion.contact(0, {0, 0, 0}, {0, 0, INFINITY}, 1), std::invalid_argument);
  EXPECT_THROW(motion.value("energy", "kinetic", "J", NAN), std::invalid_argument);
}

// The executables
// ------------------------------------------------------------------------------------------------

const std::string source = FC_SOURCE_DIR, bin = FC_BIN_DIR;

TEST(MotionOfARun, IsThatOfItsTables) {
  const auto out = scratch("boxes");
  const Outcome done =
      run(bin + "/ch04_multibody_stepping " + source +
          "/chapters/ch04_multibody_stepping/scenes/cradle.yaml --poses --out " + out.string());
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NE(done.out.find("motion.html"), std::string::npos);
  const Glb glb(contents(out / "motion.glb"));
  const Table poses = read_table(out / "poses.csv"), contacts = read_table(out / "contacts.csv");
  for (int row = 0; row < poses.rows(); ++row) {
    const std::string node = "body_" + poses.cells[row][1];
    if (!glb.moves(node)) continue;
    const Vec3 x(poses.at(row, "px"), poses.at(row, "py"), poses.at(row, "pz"));
    EXPECT_LT((shown(glb, node, poses.at(row, "t")).position - x).norm(), 1e-5);
  }
  ASSERT_GT(contacts.rows(), 0);
  for (int row = 0; row < contacts.rows(); ++row) {
    const auto t = static_cast<double>(static_cast<float>(contacts.at(row, "t")));
    for (const char* side : {"body_a", "body_b"}) {
      const std::string node = "body_" + contacts.cells[row][contacts.column(side)];
      if (!glb.moves(node)) continue;
      const std::vector<double> times = glb.track(node, "translation").times;
      EXPECT_TRUE(std::find(times.begin(), times.end(), t) != times.end())
          << "no key at the impact at " << t << " s";
    }
  }
}

TEST(MotionOfARun, IsTheSameTwiceAndThePageHasTheSameBytes) {
  const std::string command = bin + "/ch01_convex_advancement " + source +
                              "/chapters/ch01_convex_advancement/scenes/spinning_box.yaml --quiet --out ";
  std::string former;
  for (int k = 0; k < 2; ++k) {
    const auto out = scratch("query");
    ASSERT_EQ(run(command + out.string()).exit_code, 0);
    const std::string glb = contents(out / "motion.glb"), page = contents(out / "motion.html");
    const std::string mark = "const recording = \"";
    const std::size_t start = page.find(mark) + mark.size();
    EXPECT_EQ(decoded(page.substr(start, page.find('"', start) - start)), glb);
    EXPECT_TRUE(k == 0 || glb == former);
    former = glb;
  }
  const Glb query(former);
  EXPECT_EQ(query.numbers(query.json["scenes"][0]["extras"]["impact_times"]).size(), 1u);
  EXPECT_NEAR(query.numbers(query.json["scenes"][0]["extras"]["frame_times"]).back(), 2 * 0.684195, 1e-5);
}

TEST(MotionOfARun, OfTheBunniesIsUnderThreeMegabytes) {
  if (!std::filesystem::exists("/usr/share/glmark2/models/bunny.obj"))
    GTEST_SKIP() << "no bunny.obj: install glmark2-data";
  const auto out = scratch("bunnies");
  ASSERT_EQ(
      run(bin + "/ch04_multibody_stepping " + source +
          "/chapters/ch04_multibody_stepping/scenes/two_bunnies.yaml --quiet --set step.duration=1 --out " +
          out.string())
          .exit_code,
      0);
  EXPECT_LT(std::filesystem::file_size(out / "motion.html"), 3'000'000u);
  const Glb glb(contents(out / "motion.glb"));
  EXPECT_EQ(glb.numbers(glb.json["scenes"][0]["extras"]["impact_times"]).size(), 3u);
}

}  // namespace
