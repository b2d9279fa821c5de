// The executable and the scenes that it refuses.
#include <gtest/gtest.h>

#include "events.hpp"

namespace {

using namespace fc_test;

std::string refusal(const std::string& text) {
  try {
    make_world(text);
    return "accepted";
  } catch (const fc::InputError& error) {
    const std::string what = error.what();
    return what.substr(what.find("scene.yaml"));
  }
}

const std::string shapes =
    "step: {dt: 0.01, duration: 0.05}\n"
    "shapes:\n"
    "  ball: {sphere: {radius: 0.5}, mass: 1}\n"
    "  cube: {box: {size: [4, 4, 4]}, mass: 1}\n"
    "bodies:\n"
    "  - {shape: ball}\n";  // line 6

TEST(Overlap, AtTheStartIsRefusedWithTheBodysLine) {
  EXPECT_EQ(refusal(shapes + "  - {shape: ball, position: [0.9, 0, 0]}\n"),
            "scene.yaml:7:5: bodies 0 and 1 overlap at the start: by 0.1 m along (1, 0, 0), more "
            "than the tolerance of 1e-06 m; move them apart");
  EXPECT_EQ(
      refusal(shapes +
              "  - {shape: ball, position: [5, 0, 0]}\n  - {shape: ball, position: [0, 0.999998, 0]}\n"),
      "scene.yaml:8:5: bodies 0 and 2 overlap at the start: by 2e-06 m along (0, 1, 0), more than "
      "the tolerance of 1e-06 m; move them apart");
}

TEST(Overlap, UpToTheToleranceIsATouch) {
  EXPECT_EQ(refusal(shapes + "  - {shape: ball, position: [1, 0, 0]}\n"), "accepted");
  EXPECT_EQ(refusal(shapes + "  - {shape: ball, position: [0.9999995, 0, 0]}\n"), "accepted");
}

TEST(Overlap, OfABallInsideABoxIsRefused) {
  EXPECT_EQ(refusal(shapes + "  - {shape: cube, position: [0.1, 0, 0]}\n"),
            "scene.yaml:7:5: bodies 0 and 1 overlap at the start: by 2.4 m along (1, 0, 0), more "
            "than the tolerance of 1e-06 m; move them apart");
}

TEST(Overlap, OfANestedMeshIsRefused) {
  const auto folder = scratch("nested");
  independent::write_obj(independent::bumpy_sphere(12, 12, 0.2), folder / "bumpy.obj");
  const std::string text =
      "step: {dt: 0.01, duration: 1}\n"
      "shapes:\n"
      "  shell: {mesh: " +
      (folder / "bumpy.obj").string() +
      ", density: 1}\n"
      "  core: {mesh: " +
      (folder / "bumpy.obj").string() +
      ", scale: 0.3, density: 1}\n"
      "bodies:\n"
      "  - {shape: shell}\n"
      "  - {shape: core}\n";
  EXPECT_EQ(refusal(text),
            "scene.yaml:7:5: bodies 0 and 1 overlap at the start: one lies inside the other by more "
            "than the tolerance of 1e-06 m; move them apart");
}

TEST(Overlap, OfBoxesIsToldWithTheShortestWayApart) {
  const std::string boxes =
      "step: {dt: 0.01, duration: 1}\nshapes: {box: {box: {size: [1, 1, 1]}, mass: 1}}\nbodies:\n"
      "  - {shape: box}\n";
  EXPECT_EQ(refusal(boxes + "  - {shape: box, position: [0.2, 0.1, 0.999]}\n"),
            "scene.yaml:5:5: bodies 0 and 1 overlap at the start: by 0.001 m along (0, 0, 1), more "
            "than the tolerance of 1e-06 m; move them apart");
  const std::string turned = "  - {shape: box, orientation: [0.9238795325112867, 0, 0, 0.3826834323650898]";
  EXPECT_NE(refusal(boxes + turned + ", position: [0, 0, -0.9]}\n").find("by 0.1 m along (0, 0, -1)"),
            std::string::npos);
  // A corner of the turned box, 10 mm deep in a side.
  EXPECT_NE(refusal(boxes + turned + ", position: [1.197106781, 0, 0]}\n").find("by 0.01 m along (1, 0, 0)"),
            std::string::npos);
}

TEST(Overlap, OfAMeshHasNoNumber) {
  const auto folder = scratch("crossing");
  independent::write_obj(independent::bumpy_sphere(12, 12, 0.2), folder / "bumpy.obj");
  const std::string text =
      "step: {dt: 0.01, duration: 1}\nshapes:\n  rock: {mesh: " + (folder / "bumpy.obj").string() +
      ", density: 1}\nbodies:\n  - {shape: rock}\n"
      "  - {shape: rock, position: [1, 0, 0]}\n";
  EXPECT_EQ(refusal(text),
            "scene.yaml:6:5: bodies 0 and 1 overlap at the start: their surfaces cross by more than the "
            "tolerance of 1e-06 m; move them apart");
}

TEST(Overlap, OfStaticBodiesIsNobodysBusiness) {
  auto world = make_world(shapes +
                          "  - {shape: cube, static: true, position: [5, 0, 0]}\n"
                          "  - {shape: cube, static: true, position: [5, 1, 0]}\n");
  EXPECT_EQ(world.bodies.size(), 3U);  // accepted
}

TEST(Mass, OfABodyThatMovesIsRequired) {
  std::string text = shapes;
  text.replace(text.find(", mass: 1"), 9, "");
  EXPECT_NE(refusal(text), "accepted");
}

class Program : public testing::Test {
 protected:
  void SetUp() override {
    folder = scratch("program");
    std::ofstream(folder / "two.yaml")
        << "gravity: [0, 0, -9.81]\nrestitution: 0.5\n"
        << shapes << "  - {shape: ball, position: [0, 0, 3], velocity: [0, 0, -100]}\n";
  }
  Outcome chapter(const std::string& arguments) const {
    return run("cd '" + folder.string() + "' && '" FC_BIN_DIR "/ch04_multibody_stepping' " + arguments);
  }
  std::filesystem::path folder;
};

bool one_line(const std::string& text) {
  return !text.empty() && text.find('\n') + 1 == text.size();
}

TEST_F(Program, WritesTheTables) {
  const Outcome outcome = chapter("two.yaml --poses");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto out = folder / "out" / "two";
  EXPECT_EQ(read_table(out / "steps.csv").rows(), 6);
  EXPECT_EQ(read_table(out / "poses.csv").rows(), 12);
  EXPECT_EQ(read_table(out / "contacts.csv").rows(), 1);
  EXPECT_TRUE(is_full(read_table(out / "steps.csv")));
  EXPECT_EQ(read_table(out / "steps.csv").cells[0][13], "inf") << "no pair was looked at in row 0";
  EXPECT_TRUE(std::filesystem::exists(out / "summary.json"));
}

TEST_F(Program, WithoutPosesAndQuiet) {
  const Outcome outcome = chapter("two.yaml --quiet --out elsewhere");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
  EXPECT_TRUE(std::filesystem::exists(folder / "elsewhere" / "steps.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder / "elsewhere" / "poses.csv"));
}

TEST_F(Program, ExplainsWhatEachLineAskedFor) {
  const Outcome outcome = chapter("two.yaml --explain");
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* part : {"collision", "gravity", "two.yaml:1:1", "restitution", "two.yaml:2:1"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
  EXPECT_FALSE(std::filesystem::exists(folder / "out")) << "it only explains";
  std::ofstream(folder / "still.yaml") << shapes;
  const std::string still = chapter("still.yaml --explain").out;
  EXPECT_EQ(still.find("gravity"), std::string::npos) << still;
  EXPECT_NE(still.find("spin"), std::string::npos) << "design 2.3: it says that the spin is constant\n"
                                                   << still;
}

// An effect that is off writes nothing and counts nothing; one that is on with a neutral value changes no
// byte of the tables.
TEST_F(Program, EffectsThatAreOffLeaveNoTrace) {
  ASSERT_EQ(chapter("two.yaml --poses --out plain").exit_code, 0);
  ASSERT_EQ(chapter("two.yaml --poses --out neutral --set drag.linear=0 --set sleep.after=1").exit_code, 0);
  for (const char* file : {"contacts.csv", "poses.csv"})
    EXPECT_EQ(contents(folder / "plain" / file), contents(folder / "neutral" / file)) << file;
  EXPECT_EQ(without_times(read_table(folder / "plain" / "steps.csv")),
            without_times(read_table(folder / "neutral" / "steps.csv")));
  const std::string plain = contents(folder / "plain" / "summary.json"),
                    neutral = contents(folder / "neutral" / "summary.json");
  for (const char* effect : {"drag", "sleep", "asleep", "gyroscopic", "kinematic", "sensor"})
    EXPECT_EQ(plain.find(effect), std::string::npos) << effect << "\n" << plain;
  for (const char* effect : {"drag (", "sleep ("})
    EXPECT_NE(neutral.find(effect), std::string::npos) << effect;
  EXPECT_FALSE(std::filesystem::exists(folder / "plain" / "sensors.csv"));
}

TEST_F(Program, WritesWhatSensorsSee) {
  std::ofstream(folder / "gate.yaml")
      << "step: {dt: 0.1, duration: 3}\nshapes:\n"
         "  ball: {sphere: {radius: 0.5}, mass: 1}\n  gate: {box: {size: [1, 4, 4]}}\n"
         "bodies:\n  - {shape: ball, velocity: [1, 0, 0]}\n"
         "  - {shape: gate, static: true, sensor: true, position: [3, 0, 0]}\n";
  const Outcome outcome = chapter("gate.yaml --out gate");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Table sensors = read_table(folder / "gate" / "sensors.csv");
  ASSERT_EQ(sensors.rows(), 1);
  EXPECT_EQ(sensors.header(), "t [s],sensor,body,x [m],y [m],z [m],nx,ny,nz,gap [m],speed [m/s]");
  EXPECT_NEAR(sensors.at(0, "t"), 2, 1e-5);
  EXPECT_NEAR(sensors.at(0, "speed"), -1, 1e-6);
  EXPECT_EQ(read_table(folder / "gate" / "contacts.csv").rows(), 0);
}

// A failure that a scene can cause names the key of the scene; what was simulated until then stays.
TEST_F(Program, AFailureNamesTheKeyToChange) {
  const Outcome outcome =
      chapter(FC_SOURCE_DIR
              "/chapters/ch04_multibody_stepping/scenes/tumbling_boxes.yaml --set solver.method=pgs "
              "--set solver.limit=5 --out failed");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(one_line(outcome.err)) << outcome.err;
  const std::string start =
      "--set solver.limit=5: solver.method pgs stopped after solver.limit = 5 sweeps with a residual of ";
  EXPECT_TRUE(outcome.err.starts_with(start)) << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("; raise it, or use dantzig\n")) << outcome.err;
  EXPECT_GT(read_table(folder / "failed" / "steps.csv").rows(), 1);
  EXPECT_TRUE(std::filesystem::exists(folder / "failed" / "motion.html"));
}

TEST_F(Program, ARefusedRunLeavesTheResultsOfTheOneBefore) {
  ASSERT_EQ(chapter("two.yaml --poses --out kept").exit_code, 0);
  const std::string before = contents(folder / "kept" / "poses.csv");
  EXPECT_EQ(chapter("two.yaml --out kept --set bodies.1.position=[0,0,0.5]").exit_code, 2);
  EXPECT_EQ(chapter("two.yaml --out kept --sweep bodies.1.position=[0,0,3],[0,0,0.5]").exit_code, 2);
  EXPECT_EQ(contents(folder / "kept" / "poses.csv"), before);
  int count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder / "kept")) ++count;
  EXPECT_EQ(count, 6) << "steps, contacts, poses, motion.glb, motion.html, summary.json";
}

TEST_F(Program, Sweeps) {
  const Outcome outcome = chapter("two.yaml --sweep restitution=0,0.5,1 --out swept");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Table sweep = read_table(folder / "swept" / "sweep.csv");
  EXPECT_EQ(sweep.rows(), 3);
  EXPECT_EQ(sweep.column("restitution"), 0);
  EXPECT_EQ(sweep.at(1, "restitution"), 0.5);
  EXPECT_LT(sweep.at(0, "kinetic energy at the end"), sweep.at(1, "kinetic energy at the end"));
  EXPECT_LT(sweep.at(1, "kinetic energy at the end"), sweep.at(2, "kinetic energy at the end"));
}

TEST_F(Program, RefusesBadInputWithCodeTwoAndOneLine) {
  for (const char* arguments : {"missing.yaml", "two.yaml --set gravty=[0,0,1]", "two.yaml --set step.dt=0",
                                "two.yaml --set friction=0.5", "two.yaml --set restitution=1.5",
                                "two.yaml --set bodies.1.position=[0,0,0.5]", "two.yaml --nonsense", ""}) {
    const Outcome outcome = chapter(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_TRUE(one_line(outcome.err)) << arguments << "\n" << outcome.err;
  }
}

}  // namespace
