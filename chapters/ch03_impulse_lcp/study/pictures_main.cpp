// ch03_pictures: the numbers behind the text's drawings, computed by the chapter's own code.
#include <Eigen/LU>
#include <cmath>
#include <string>
#include <string_view>

#include "ch03_impulse_lcp/clear/dantzig.hpp"
#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "ch03_impulse_lcp/solver.hpp"
#include "common/study_program.hpp"
#include "common/table.hpp"

namespace {

using namespace fc;
using namespace fc::lcp;

// Bodies and contacts of a flat world: x to the right, z up.
struct Impact {
  std::vector<RigidBody> bodies;
  std::vector<Contact> contacts;
};

RigidBody body(double mass, double inertia, double x, double z, double vx, double vz) {
  RigidBody made;
  made.position = {x, 0, z};
  made.velocity = {vx, 0, vz};
  if (mass == 0) return made;  // static
  made.mass = mass;
  made.inverse_mass = 1 / mass;
  made.inertia_body = inertia * Mat3::Identity();
  made.inverse_inertia_body = made.inertia_body.inverse();
  return made;
}

// scenes/three_balls.yaml: 1, 2 and 1 kg in a row, the outer two towards the middle one.
Impact three_balls() {
  const double inertia = 0.1;  // of no effect: impulses go through the centres
  return {{body(1, inertia, 0, 0, 2, 0), body(2, inertia, 1, 0, 0, 0), body(1, inertia, 2, 0, -1, 0)},
          {{0, 1, {0.5, 0, 0}, Vec3::UnitX(), 0, 0.5}, {1, 2, {1.5, 0, 0}, Vec3::UnitX(), 0, 0.5}}};
}

// A cube of 1 m and 2 kg lands flat at 2 m/s: the two corners that a view from the side shows.
Impact flat_box() {
  return {{body(0, 0, 0, -0.5, 0, 0), body(2, 2.0 / 6, 0, 0.5, 0, -2)},
          {{0, 1, {-0.5, 0, 0}, Vec3::UnitZ(), 0, 0.5}, {0, 1, {0.5, 0, 0}, Vec3::UnitZ(), 0, 0.5}}};
}

// A plank of 3 m by 0.2 m and 1 kg lands flat on two posts, both on the left of its centre.
Impact plank() {
  return {{body(0, 0, 0, -0.5, 0, 0), body(1, (9 + 0.04) / 12, 0, 0.1, 0, -1)},
          {{0, 1, {-1.3, 0, 0}, Vec3::UnitZ(), 0, 0.5}, {0, 1, {-0.4, 0, 0}, Vec3::UnitZ(), 0, 0.5}}};
}

// The end of a stick of 1 m and 1 kg hits a ball of 0.5 m and 2 kg from above, off its top.
Impact stick_and_ball() {
  constexpr double kRadius = 0.5, kFromTop = 0.5;  // m, rad
  const Vec3 n(std::sin(kFromTop), 0, std::cos(kFromTop)), along(std::cos(0.5), 0, std::sin(0.5));
  const Vec3 p = kRadius * n, centre = p + 0.5 * along;
  return {
      {body(2, 0.4 * 2 * kRadius * kRadius, 0, 0, 0, 0), body(1, 1.0 / 12, centre.x(), centre.z(), -0.5, -2)},
      {{0, 1, p, n, 0, 0.5}}};
}

// The hits of a list of contacts that is served in turn from `first` on, until nothing approaches: exercise 3.3.
int serve_in_turn(Impact& impact, std::size_t first) {
  constexpr double kSlow = 1e-9;  // m/s
  const std::size_t n = impact.contacts.size();
  int hits = 0;
  for (std::size_t k = first, quiet = 0; quiet < n && hits < 1000; ++k, ++quiet) {
    const Contact& contact = impact.contacts[k % n];
    const double v = contact_velocity(impact.bodies, contact);
    if (v >= -kSlow) continue;
    const MatX a = assemble(impact.bodies, {&contact, 1}).A;
    apply_impulse(impact.bodies, contact, -(1 + contact.restitution) * v / a(0, 0));
    ++hits;
    quiet = 0;
  }
  return hits;
}

// one_by_one.csv: the velocities after each order of the same impact.
void write_orders(const std::filesystem::path& out) {
  TableWriter table(out / "one_by_one.csv", {{"scene", ""},
                                             {"order", ""},
                                             {"body", ""},
                                             {"vx", "m/s"},
                                             {"vz", "m/s"},
                                             {"spin", "rad/s"},
                                             {"hits", ""}});
  for (const std::string scene : {"box", "balls"})
    for (const std::string order : {"left first", "right first", "at once"}) {
      Impact impact = scene == "box" ? flat_box() : three_balls();
      int hits = 1;
      if (order == "at once")
        resolve_impact(impact.bodies, impact.contacts);
      else
        hits = serve_in_turn(impact, order == "left first" ? 0 : 1);
      for (std::size_t b = 0; b < impact.bodies.size(); ++b) {
        const RigidBody& moved = impact.bodies[b];
        table.row({scene, order, static_cast<std::int64_t>(b), moved.velocity.x(), moved.velocity.z(),
                   moved.spin.y(), std::int64_t{hits}});
      }
    }
  table.close();
}

// contact.csv: one contact, its point and normal, the arms, and its row.
void write_contact(const std::filesystem::path& out) {
  const Impact impact = stick_and_ball();
  const Contact& c = impact.contacts[0];
  const RigidBody &a = impact.bodies[0], &b = impact.bodies[1];
  const ImpactProblem row = assemble(impact.bodies, impact.contacts);
  TableWriter table(out / "contact.csv", {{"name", ""}, {"x", ""}, {"z", ""}});
  const auto add = [&](const char* name, const Vec3& v) { table.row({name, v.x(), v.z()}); };
  add("p", c.point);
  add("n", c.normal);
  add("c_A", a.position);
  add("c_B", b.position);
  add("v_B", b.velocity);
  add("r_A x n", Vec3(0, 0, (c.point - a.position).cross(c.normal).y()));  // about the axis into the picture
  add("r_B x n", Vec3(0, 0, (c.point - b.position).cross(c.normal).y()));
  add("a, v", Vec3(row.A(0, 0), 0, row.v_before[0]));
  table.close();
}

// drive.csv: a drive of the plank's z_2. At each of its values the row before is complementary; that defines a drive.
void write_drive(const std::filesystem::path& out) {
  const Impact impact = plank();
  const ImpactProblem problem = assemble(impact.bodies, impact.contacts);
  TableWriter table(out / "drive.csv", {{"z2", "N s"}, {"z1", "N s"}, {"w1", "m/s"}, {"w2", "m/s"}});
  const MatX first = problem.A.topLeftCorner(1, 1);
  const double last = solve({problem.A, problem.b}).z[1];
  constexpr int kSamples = 400;
  for (int k = 0; k <= kSamples; ++k) {
    const double z2 = last * k / kSamples;
    const VecX b = problem.b.head(1) + problem.A.topRightCorner(1, 1) * z2;
    const LcpResult answer = clear::dantzig(first, b, 0);
    const VecX w = evaluate(problem.A, problem.b, (VecX(2) << answer.z[0], z2).finished());
    table.row({z2, answer.z[0], w[0], w[1]});
  }
  table.close();
}

// problems.csv: the rows of the problems that are drawn, and their answers; y where there is no answer.
void write_problems(const std::filesystem::path& out) {
  TableWriter table(out / "problems.csv", {{"scene", ""},
                                           {"row", ""},
                                           {"A 1", "1/kg"},
                                           {"A 2", "1/kg"},
                                           {"b", "m/s"},
                                           {"z", "N s"},
                                           {"w", "m/s"},
                                           {"y", ""}});
  const auto add = [&](const char* scene, const MatX& A, const VecX& b) {
    const LcpResult answer = clear::dantzig(A, b, 0);
    for (Eigen::Index i = 0; i < 2; ++i) {
      const double y = answer.certificate.size() > 0 ? answer.certificate[i] : 0.0;
      table.row({scene, std::int64_t{i}, A(i, 0), A(i, 1), b[i], answer.z[i], answer.w[i], y});
    }
  };
  const Impact balls = three_balls();
  const ImpactProblem rows = assemble(balls.bodies, balls.contacts);
  add("balls", rows.A, rows.b);
  add("walls", MatX{{1, -1}, {-1, 1}}, VecX{{-2, 1}});  // scenes/no_solution.yaml
  table.close();
}

// One point of the central path: A z + b = w > 0, z > 0, z_i w_i = mu, by Newton's method from the point of a larger mu.
VecX central_point(const MatX& A, const VecX& b, double mu, VecX z) {
  for (int step = 0; step < 60; ++step) {
    const VecX w = A * z + b;
    const MatX slope = MatX(w.asDiagonal()) + z.asDiagonal() * A;
    const VecX dz = slope.partialPivLu().solve(VecX(VecX::Constant(z.size(), mu) - z.cwiseProduct(w)));
    double length = 1;
    while ((z + length * dz).minCoeff() <= 0 || (A * (z + length * dz) + b).minCoeff() <= 0) length /= 2;
    z += length * dz;
  }
  return z;
}

// paths.csv: where each method is after each of its steps on the three balls.
void write_paths(const std::filesystem::path& out) {
  const Impact impact = three_balls();
  const ImpactProblem problem = assemble(impact.bodies, impact.contacts);
  const Lcp rows{problem.A, problem.b};
  TableWriter table(out / "paths.csv", {{"method", ""},
                                        {"step", ""},
                                        {"z1", "N s"},
                                        {"z2", "N s"},
                                        {"w1", "m/s"},
                                        {"w2", "m/s"},
                                        {"residual", "1"}});
  const auto add = [&](std::string_view method, int step, const VecX& z) {
    const VecX w = evaluate(problem.A, problem.b, z);
    table.row({std::string(method), std::int64_t{step}, z[0], z[1], w[0], w[1], residual(rows, z, w)});
  };
  for (const Method method : {Method::dantzig, Method::lemke, Method::pgs}) {
    add(name(method), 0, VecX::Zero(2));
    const int steps = method == Method::pgs ? 10 : solve(rows, method).pivots;
    for (int step = 1; step <= steps; ++step) {
      const LcpResult there = method == Method::dantzig ? clear::dantzig(problem.A, problem.b, step)
                                                        : solve(rows, method, {.limit = step});
      add(name(method), step, there.z);
    }
  }
  VecX z = VecX::Constant(2, 6.0);  // A z + b > 0 here
  int step = 0;
  for (double mu = 20; mu > 1e-6; mu *= 0.8) {
    z = central_point(problem.A, problem.b, mu, z);
    add("interior_point", step++, z);
  }
  table.close();
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path out;
  bool quiet = false;
  fc::StudyProgram program;
  program.purpose = "Writes the numbers behind chapter 3's drawings into --out:";
  program.example = "build/bin/ch03_pictures --part all --out out/ch03_pictures";
  program.parts = {
      {"orders", "an impact, one contact after the other and all at once (one_by_one.csv)",
       [&] { write_orders(out); }},
      {"problems", "two rows with an answer, and two without (problems.csv)", [&] { write_problems(out); }},
      {"contact", "one contact, and its row (contact.csv)", [&] { write_contact(out); }},
      {"drive", "z and w during a drive (drive.csv)", [&] { write_drive(out); }},
      {"paths", "where four methods pass on two rows (paths.csv)", [&] { write_paths(out); }}};
  program.all = true;
  return fc::run_study(argc, argv, program, out, quiet);
}
