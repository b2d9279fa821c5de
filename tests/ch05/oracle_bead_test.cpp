// A bead that slides without friction in a valley and in a bowl: closed forms of a path with a corner, and of
// the pendulum.
#include <gtest/gtest.h>

#include <numbers>

#include "oracles.hpp"

namespace {

using namespace fc_test;
using fc::Vec3;
using independent::Vec;

constexpr double kGravity = 10, kRadius = 1, kEnvelope = 4e-4;  // m/s^2, m, m
constexpr double kGap = 0.5 * kEnvelope;                        // m, the gap of resting bodies

std::string head(const std::string& shapes) {
  return "step: {dt: 0.01, duration: 1}\ngravity: [0, 0, -10]\nenvelope: " + number(kEnvelope) +
         "\nshapes:\n  bead: {sphere: {radius: " + number(kRadius) + "}, mass: 2}\n" + shapes + "bodies:\n";
}
std::string place(const Vec3& x) {
  return "[" + number(x.x()) + ", " + number(x.y()) + ", " + number(x.z()) + "]";
}

// Two planes that meet at the bottom, each at the angle alpha to the horizontal. Down one, with g sin(alpha);
// at the bottom the bead keeps what of its velocity lies along the other, cos(2 alpha) of it; up that one,
// and so on. So the k-th swing is cos(2 alpha)^(2k) as high as the first, and takes cos(2 alpha)^k of its
// time: everything is known in closed form, corners included.
struct Valley {
  double alpha, start;  // rad; m, along the slope, from the bottom
  double acceleration() const { return kGravity * std::sin(alpha); }
  double keeps() const { return std::cos(2 * alpha); }
  // How far the bead is from the bottom at t, along the slope: positive on the right.
  double at(double t) const {
    double side = 1, v = std::sqrt(2 * acceleration() * start), quarter = v / acceleration();
    if (t <= quarter) return start - 0.5 * acceleration() * t * t;
    t -= quarter;
    for (;;) {
      side = -side;
      v *= keeps();
      quarter = v / acceleration();
      if (t <= 2 * quarter) return side * (v * t - 0.5 * acceleration() * t * t);
      t -= 2 * quarter;
    }
  }
};

TEST(Bead, InAValleyOfTwoPlanes) {
  const Valley valley{std::numbers::pi / 9, 1};
  const double c = std::cos(valley.alpha), s = std::sin(valley.alpha);
  // Slabs of 4 m, their upper sides on the two planes.
  const auto slab = [&](double side) {
    const Vec3 along(side * c, 0, s), up(-side * s, 0, c), middle = 1.9 * along - 0.1 * up;
    return "  - {shape: slab, static: true, position: " + place(middle) + ", orientation: [" +
           number(std::cos(0.5 * valley.alpha)) + ", 0, " + number(-side * std::sin(0.5 * valley.alpha)) +
           ", 0]}\n";
  };
  const Vec3 bottom(0, 0, (kRadius + kGap) / c);  // of the path of the bead's centre
  const std::string text = head("  slab: {box: {size: [4, 2, 0.2]}}\n") + slab(1) + slab(-1) +
                           "  - {shape: bead, position: " + place(bottom + valley.start * Vec3(c, 0, s)) +
                           "}\n";
  for (const double dt : {1 / 60.0, 1 / 120.0, 1 / 240.0}) {
    Simulation sim(text, dt);
    double off = 0, rise = 0, error = 0, energy = sim.energy();
    while (sim.time() < 3) {
      sim.step();
      rise = std::max(rise, sim.energy() - energy - sim.last.correction_energy);
      energy = sim.energy();
      const Vec3 x = sim.body(2).position - bottom;
      const double distance = x.x() >= 0 ? x.dot(Vec3(c, 0, s)) : x.dot(Vec3(c, 0, -s));
      error = std::max(error, std::abs(distance - valley.at(sim.time())));
      off = std::max(off, std::abs(std::abs(x.x()) * s - x.z() * c));
    }
    EXPECT_LE(error, 6 * kGap) << "m along the slope, over three corners, with frames of " << dt << " s";
    EXPECT_LE(off, kGap) << "m: it never leaves the two planes, with frames of " << dt << " s";
    EXPECT_LE(rise, 1e-12 * energy) << "J in a frame, beyond what corrections of gaps added";
    EXPECT_EQ(sim.lost, 0) << "s";
  }
}

// A trough: `facets` strips, each tangent in its middle to a circle of radius R about the y axis, across the
// angles -reach to reach from the bottom; closed into a solid below.
independent::Mesh trough(double radius, double reach, int facets, double length) {
  independent::Mesh mesh;
  const double turn = 2 * reach / facets, corner = radius / std::cos(0.5 * turn), floor = -radius - 0.5;
  for (int i = 0; i <= facets; ++i) {
    const double phi = -reach + turn * i, x = corner * std::sin(phi), z = -corner * std::cos(phi);
    for (const double y : {-0.5 * length, 0.5 * length}) mesh.vertices.push_back({x, y, z});
    for (const double y : {-0.5 * length, 0.5 * length}) mesh.vertices.push_back({x, y, floor});
  }
  const auto quad = [&](int a, int b, int c, int d) {  // anticlockwise as seen from outside
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  };
  for (int i = 0; i < facets; ++i) {
    const int p = 4 * i, q = p + 4;    // each: upper front, upper back, lower front, lower back
    quad(p, q, q + 1, p + 1);          // above
    quad(p + 2, p + 3, q + 3, q + 2);  // below
    quad(p + 2, q + 2, q, p);          // in front
    quad(p + 3, p + 1, q + 1, q + 3);  // behind
  }
  const int e = 4 * facets;
  quad(0, 1, 3, 2);
  quad(e, e + 2, e + 3, e + 1);
  return mesh;
}

// The period of a pendulum of length l that swings to phi: 4 sqrt(l/g) K(sin(phi/2)), by the
// arithmetic-geometric mean.
double period(double length, double phi) {
  double a = 1, b = std::cos(0.5 * phi);
  while (std::abs(a - b) > 1e-15 * a) {
    const double mean = 0.5 * (a + b);
    b = std::sqrt(a * b);
    a = mean;
  }
  return 2 * std::numbers::pi / a * std::sqrt(length / kGravity);
}

struct Swing {
  std::vector<double> crossings;  // s, of the bottom
  double energy = 0;              // of the start's, after the last crossing, both counted from the bottom
  double rise = 0;                // J in a frame, the largest, beyond what corrections of gaps added
  double off = 0;                 // m, from the circle
  double lost = 0;                // s
  double gap = INFINITY;          // m, to the facet below, the smallest
};

Swing swing(const std::filesystem::path& bowl, double length, double phi, double dt, std::size_t crossings,
            double delta) {
  Simulation sim(head("  bowl: {mesh: " + bowl.string() + "}\n") +
                     "  - {shape: bowl, static: true}\n  - {shape: bead, position: " +
                     place(length * Vec3(std::sin(phi), 0, -std::cos(phi))) + "}\n",
                 dt);
  Swing result;
  const double deepest = -sim.body(1).mass * kGravity * length, start = sim.energy() - deepest;
  double before = sim.body(1).position.x(), energy = sim.energy();
  while (result.crossings.size() < crossings && sim.time() < 20) {
    sim.step();
    const Vec3 x = sim.body(1).position;
    result.rise = std::max(result.rise, sim.energy() - energy - sim.last.correction_energy);
    energy = sim.energy();
    result.off = std::max(result.off, std::abs(Vec3(x.x(), 0, x.z()).norm() - length));
    const double at = std::atan2(x.x(), -x.z()), facet = delta * std::round(at / delta);
    result.gap = std::min(result.gap, length + kGap - Vec3(x.x(), 0, x.z()).norm() * std::cos(at - facet));
    if (x.x() * before < 0) result.crossings.push_back(sim.time() - dt * x.x() / (x.x() - before));
    before = x.x();
  }
  result.energy = (energy - deepest) / start;
  result.lost = sim.lost;
  return result;
}

// What is not exact here, and by how much. A bead without bounce loses the part sin^2 of its energy whenever
// its velocity is turned by an angle: by delta = 2 mrad at each corner of a facet, which makes up to delta
// phi of a swing, 0.2 %; and by phi' dt in a frame, which is of first order in the step. Half of that is had
// again from corrections of gaps at small amplitudes, where the gap's half millimetre is a hundredth of the
// height. A lower amplitude makes the period shorter by phi^2/16 of it, at most 6 %, in proportion to what is
// lost. Facets make the path shorter than the circle by delta^2/24: nothing. The bead's position is half a
// step ahead, as on a slope.
TEST(Bead, InATroughIsAPendulum) {
  constexpr double kTroughRadius = 11, kReach = 1.3;
  constexpr int kFacets = 1301;
  const auto file = scratch("trough") / "trough.obj";
  independent::write_obj(trough(kTroughRadius, kReach, kFacets, 4), file);
  const double length = kTroughRadius - kRadius - kGap, delta = 2 * kReach / kFacets;
  ASSERT_NEAR(period(length, 1e-4) / (2 * std::numbers::pi * std::sqrt(length / kGravity)), 1, 1e-8);
  ASSERT_NEAR(period(length, 1) / period(length, 1e-4), 1.0663, 1e-4);
  for (const double phi : {0.1, 1.0}) {
    const double exact = period(length, phi);
    double last_loss = 0;
    for (const double dt : kFrames) {
      const Swing s = swing(file, length, phi, dt, 3, delta);
      const std::string with = " at " + number(phi) + " rad, with frames of " + number(dt) + " s";
      ASSERT_EQ(s.crossings.size(), 3U) << with;
      const double loss = 1 - s.energy, T = s.crossings[2] - s.crossings[0];
      RecordProperty("loss" + with, number(loss));
      EXPECT_NEAR(s.crossings[0], exact / 4, 0.6 * dt) << "s: a quarter of a period" << with;
      EXPECT_NEAR(T / exact, 1, 5e-4 + 0.5 * phi * phi * dt) << "the period" << with;
      EXPECT_GE(loss, 0) << "energy in five quarters of a period" << with;
      EXPECT_LE(loss, 0.012 + 12 * phi * phi * dt) << "energy in five quarters of a period" << with;
      EXPECT_LE(s.off, kGap + length * delta * delta / 8) << "m off its circle" << with;
      EXPECT_GT(s.gap, 0) << "m, between the bead and the facet below" << with;
      EXPECT_LE(s.rise, 1e-12 * length) << "J in a frame" << with;
      EXPECT_EQ(s.lost, 0) << "s" << with;
      if (phi == 1 && last_loss > 0) {
        EXPECT_LE(loss, 0.6 * last_loss) << "half the step, about half the loss" << with;
      }
      last_loss = loss;
    }
  }
}

// Thrown up along a slope of 30 degrees and a little down onto it, it lands in the middle of the first frame,
// loses what of its velocity is normal to the slope, and slides on. Along the slope nothing but gravity acts,
// in flight, on the slope, and in the frame in which it lands: without that it would go up for nothing.
TEST(Bead, LandsOnASlopeThatItGoesUp) {
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  const Vec3 along(c, 0, s), up(-s, 0, c);
  for (const double dt : {1 / 60.0, 1 / 120.0, 1 / 240.0}) {
    const double normal_speed = -0.3, high = 0.5 * dt * (0.3 + 0.25 * kGravity * c * dt);
    Simulation sim(head("  slab: {box: {size: [40, 4, 1]}}\n") +
                       "  - {shape: slab, static: true, position: " + place(-0.5 * up) + ", orientation: [" +
                       number(std::cos(std::numbers::pi / 12)) + ", 0, " +
                       number(-std::sin(std::numbers::pi / 12)) +
                       ", 0]}\n  - {shape: bead, position: " + place((kRadius + kGap + high) * up) +
                       ", velocity: " + place(4 * along + normal_speed * up) + "}\n",
                   dt);
    double rise = 0, energy = sim.energy(), error = 0;
    while (sim.time() < 1.2) {
      sim.step();
      rise = std::max(rise, sim.energy() - energy - sim.last.correction_energy);
      energy = sim.energy();
      const double t = sim.time();
      error =
          std::max(error, std::abs(sim.body(1).position.dot(along) - (4 * t - 0.5 * kGravity * s * t * t)));
    }
    EXPECT_LE(rise, 1e-12 * energy) << "J in a frame, with frames of " << dt << " s";
    EXPECT_LE(error, 0.6 * kGravity * s * 1.2 * dt)
        << "m: half a step ahead at most, with frames of " << dt << " s";
    EXPECT_NEAR(sim.body(1).velocity.dot(along), 4 - kGravity * s * sim.time(), 1e-9)
        << "m/s, with frames of " << dt << " s";
    EXPECT_EQ(sim.lost, 0) << "s";
  }
}

}  // namespace
