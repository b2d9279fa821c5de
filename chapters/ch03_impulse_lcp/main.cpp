// Chapter 3: solves the impact of bodies that touch, or an LCP given directly.
#include <fmt/format.h>

#include <chrono>
#include <optional>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "ch03_impulse_lcp/matrix_market.hpp"
#include "ch03_impulse_lcp/solver.hpp"
#include "ch03_impulse_lcp/unsolved.hpp"
#include "common/pair_rules.hpp"
#include "common/program.hpp"
#include "common/shape.hpp"

namespace {

using namespace fc;
using namespace fc::lcp;

std::int64_t now_ns() {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
}

struct TimedResult {
  LcpResult lcp;
  std::int64_t ns = 0;
};

TimedResult solve_timed(const Lcp& problem, Method method, const SolverSpec& spec) {
  const std::int64_t start = now_ns();
  LcpResult lcp = solve(problem, method, {.limit = spec.limit, .tolerance = spec.tolerance});
  return {std::move(lcp), now_ns() - start};
}

TimedResult solve_timed(const Lcp& problem, const SolverSpec& spec) {
  return solve_timed(problem, method_named(spec.method), spec);
}

// solution.csv, solvers.csv (with every other method's row, if the scene asks for them) and their part of the
// summary.
void write_solution(const Lcp& problem, const TimedResult& solved, const SolverSpec& spec,
                    const RunContext& context, Summary& summary) {
  const LcpResult& lcp = solved.lcp;
  // z and w, and where there is no solution, the proof: y >= 0 with A'y <= 0 and b'y < 0.
  const bool proved = lcp.status == Status::no_solution;
  std::vector<Column> columns = {{"row", ""}, {"z", ""}, {"w", ""}};
  if (proved) columns.push_back({"y", ""});
  TableWriter solution(context.out_dir / "solution.csv", columns);
  for (Eigen::Index i = 0; i < lcp.z.size(); ++i) {
    std::vector<Cell> cells = {std::int64_t{i}, lcp.z[i], lcp.w[i]};
    if (proved) cells.emplace_back(lcp.certificate[i]);
    solution.row(cells);
  }
  solution.close();
  summary.add("solver", spec.method);
  summary.add("status", name(lcp.status));
  summary.add("rows", std::int64_t{lcp.z.size()});
  const Method chosen = method_named(spec.method);
  summary.add(counted_by(spec.method), std::int64_t{lcp.pivots});
  summary.add("residual", lcp.residual, "1");

  TableWriter solvers(
      context.out_dir / "solvers.csv",
      {{"solver", ""}, {"status", ""}, {"pivots_or_sweeps", ""}, {"residual", ""}, {"wall_ns", ""}});
  const auto add = [&](std::string_view method, const TimedResult& result) {
    solvers.row({std::string(method), name(result.lcp.status), std::int64_t{result.lcp.pivots},
                 result.lcp.residual, result.ns});
  };
  add(spec.method, solved);
  for (const Method method : kMethods) {
    if (!spec.compare || method == chosen) continue;
    const TimedResult other = solve_timed(problem, method, spec);
    add(name(method), other);
    summary.add(std::string(name(method)),
                fmt::format("{}, residual {:.2g}, {} pivots, sweeps or steps", name(other.lcp.status),
                            other.lcp.residual, other.lcp.pivots));
  }
  solvers.close();
}

// A vector in a Matrix Market file: one column of n numbers.
VecX read_vector(const std::filesystem::path& file, Eigen::Index n) {
  const MatX column = read_matrix_market(file);
  if (column.cols() != 1 || column.rows() != n) {
    throw InputError({file.string(), 0, 0},
                     fmt::format("{} by {} numbers, but the matrix has {} rows; one column of {} is needed",
                                 column.rows(), column.cols(), n, n));
  }
  return column;
}

struct GivenLcp {
  MatX A;
  VecX b;
  std::optional<VecX> solution;
};

GivenLcp read_lcp_of(const LcpSpec& spec) {
  GivenLcp given;
  given.A = spec.matrix ? *spec.matrix : read_matrix_market(*spec.matrix_file);
  const auto n = given.A.rows();
  if (n != given.A.cols()) {
    const SourceMark where = spec.matrix_file ? SourceMark{spec.matrix_file->string(), 0, 0} : spec.where;
    throw InputError(where,
                     fmt::format("the matrix of an LCP is square, this one is {} by {}", n, given.A.cols()));
  }
  given.b = spec.vector ? *spec.vector : read_vector(*spec.vector_file, n);
  if (spec.solution_file) given.solution = read_vector(*spec.solution_file, n);
  return given;
}

int run_lcp(const LcpSpec& spec, const SolverSpec& solver, const RunContext& context, Summary& summary) {
  const auto [A, b, known] = read_lcp_of(spec);
  const TimedResult solved = solve_timed({A, b}, solver);
  write_solution({A, b}, solved, solver, context, summary);
  if (known && b.size() > 0) {
    // Velocities, not impulses: of a singular matrix z is not unique, w is.
    summary.add("largest difference of w from the given solution",
                (solved.lcp.w - evaluate(A, b, *known)).lpNorm<Eigen::Infinity>());
  }
  summary.counter(solver.method, 1, solved.ns);
  if (solved.lcp.status == Status::no_solution)  // after the tables are written
    throw SceneFailure(
        "there is no solution: the column y of solution.csv proves it, A'y <= 0 and b'y < 0; "
        "change A or b",
        "lcp");
  if (solved.lcp.status != Status::solved)
    throw unsolved(solver, solved.lcp.status, solved.lcp.pivots, solved.lcp.residual);
  return 0;
}

struct Totals {
  double kinetic = 0;
  Vec3 momentum = Vec3::Zero(), angular_momentum = Vec3::Zero();
};

Totals totals(const std::vector<RigidBody>& bodies) {
  Totals sum;
  for (const RigidBody& body : bodies) {
    if (body.is_static()) continue;
    sum.kinetic += body.kinetic_energy();
    sum.momentum += body.momentum();
    sum.angular_momentum += body.angular_momentum();
  }
  return sum;
}

void add_totals(const std::string& when, const Totals& sum, Summary& summary) {
  summary.add("kinetic energy " + when, sum.kinetic, "J");
  for (int k = 0; k < 3; ++k)
    summary.add(fmt::format("momentum {} {}", "xyz"[k], when), sum.momentum[k], "kg m/s");
  for (int k = 0; k < 3; ++k) {
    summary.add(fmt::format("angular momentum {} {}", "xyz"[k], when), sum.angular_momentum[k], "kg m^2/s");
  }
}

void write_contacts(const std::vector<Contact>& contacts, const ImpactResult& impact,
                    const RunContext& context) {
  TableWriter table(context.out_dir / "contacts.csv", {{"t", "s"},
                                                       {"body_a", ""},
                                                       {"body_b", ""},
                                                       {"x", "m"},
                                                       {"y", "m"},
                                                       {"z", "m"},
                                                       {"nx", ""},
                                                       {"ny", ""},
                                                       {"nz", ""},
                                                       {"gap", "m"},
                                                       {"v_before", "m/s"},
                                                       {"v_after", "m/s"},
                                                       {"impulse", "N s"}});
  for (const Impulse& p : impact.impulses) {
    const Contact& c = contacts[static_cast<std::size_t>(p.contact)];
    table.row({0.0, std::int64_t{c.body_a}, std::int64_t{c.body_b}, c.point.x(), c.point.y(), c.point.z(),
               c.normal.x(), c.normal.y(), c.normal.z(), c.gap, p.v_before, p.v_after, p.impulse});
  }
  table.close();
}

int run_contacts(const Scene& scene, const RunContext& context, Summary& summary) {
  // Build the bodies, and the contacts with the restitution of each pair.
  const std::vector<Shape> shapes = build_shapes(scene, true);
  std::vector<RigidBody> bodies;
  const PairRules rules(scene);
  const auto shape_of = [&](int body) { return scene.bodies[static_cast<std::size_t>(body)].shape; };
  for (const BodySpec& spec : scene.bodies)
    bodies.push_back(make_body(shapes[static_cast<std::size_t>(spec.shape)], spec));
  std::vector<Contact> contacts;
  for (const ContactSpec& spec : scene.contacts) {
    const double restitution = rules.restitution(shapes, shape_of(spec.body_a), shape_of(spec.body_b));
    contacts.push_back({spec.body_a, spec.body_b, spec.point, spec.normal, 0.0, restitution});
  }

  // Resolve the impact, keeping the first solve that succeeded, or the first of all, for the tables.
  ImpactProblem problem = assemble(bodies, contacts);
  std::optional<TimedResult> shown;
  std::int64_t solver_runs = 0, solver_ns = 0;
  const ImpactOptions options{.solver = [&](const Lcp& rows) {
    const TimedResult solved = solve_timed(rows, scene.solver);
    if (!shown || (shown->lcp.status != Status::solved && solved.lcp.status == Status::solved)) {
      shown = solved;
      problem.A = rows.A;
      problem.b = rows.b;
    }
    ++solver_runs;
    solver_ns += solved.ns;
    return solved.lcp;
  }};
  const Totals before = totals(bodies);
  const std::int64_t start = now_ns();
  const ImpactResult impact = resolve_impact(bodies, contacts, options);
  const std::int64_t impact_ns = now_ns() - start;
  const Lcp rows{problem.A, problem.b};
  if (!shown) shown = solve_timed(rows, scene.solver);  // nothing approaches: the answer is z = 0

  write_solution(rows, *shown, scene.solver, context, summary);
  write_matrix_market(context.out_dir / "A.mtx", problem.A);
  write_matrix_market(context.out_dir / "b.mtx", problem.b);
  write_contacts(contacts, impact, context);
  summary.add("solves in the same instant", std::int64_t{impact.solves});
  summary.add("impulses", static_cast<std::int64_t>(impact.impulses.size()));
  if (impact.restitution_lowered)
    summary.add("restitution", "mixed, without solution: the smallest was used for all");
  add_totals("before", before, summary);
  add_totals("after", totals(bodies), summary);
  summary.add("change of kinetic energy", impact.energy_change, "J");
  summary.add("change that the law predicts", impact.energy_identity, "J");
  summary.add("fastest approach left", impact.fastest_approach, "m/s");
  summary.counter("impact", impact.solves, impact_ns);
  summary.counter(scene.solver.method, solver_runs, solver_ns);
  if (impact.status != Status::solved)
    throw unsolved(scene.solver, impact.status, impact.failed_pivots, impact.failed_residual);
  return 0;
}

std::vector<Effect> explain(const Scene& scene) {
  const auto line = [](const SourceMark& mark) { return "declared at line " + std::to_string(mark.line); };
  const std::string solver = "solver (" + scene.solver.method + ")";
  if (scene.lcp) return {{"lcp", line(scene.lcp->where), solver, 1}};
  std::vector<Effect> effects;
  if (!scene.contacts.empty()) {
    effects.push_back({"contacts", line(scene.contacts.front().where), "Delassus matrix, " + solver, 1});
  }
  if (const auto mark = scene.mark("restitution")) {
    effects.push_back({"restitution", line(*mark), "right-hand side (1 + epsilon) v", 0});
  } else {
    for (const ShapeSpec& shape : scene.shapes) {
      if (!shape.restitution) continue;
      effects.push_back({"restitution", line(shape.where), "right-hand side (1 + epsilon) v", 0});
      break;
    }
    if (effects.empty() || effects.back().name != "restitution")
      if (const auto pairs = scene.mark("pairs"))
        effects.push_back({"restitution", line(*pairs), "right-hand side (1 + epsilon) v", 0});
  }
  for (const BodySpec& body : scene.bodies) {
    if (body.free_moves.isOnes(0) && body.free_turns.isOnes(0)) continue;
    effects.push_back({"fixed degrees of freedom", line(body.where), "zeros in the inverse masses", 0});
    break;
  }
  return effects;
}

void check(const Scene& scene) {
  if (scene.lcp) read_lcp_of(*scene.lcp);
  if (!scene.lcp) build_shapes(scene, true);
}

int run(const Scene& scene, const RunContext& context, Summary& summary) {
  return scene.lcp ? run_lcp(*scene.lcp, scene.solver, context, summary)
                   : run_contacts(scene, context, summary);
}

}  // namespace

int main(int argc, char** argv) {
  return run_program(
      argc, argv,
      {.number = 3,
       .name = "ch03_impulse_lcp",
       .purpose =
           "Finds the impulses of bodies that hit each other at many contacts at once, or solves "
           "a linear complementarity problem, by Dantzig's method or, with solver: {method: ...}, another; "
           "solver: {compare: true} runs them all. The LCP of a scene with contacts is written as A.mtx, "
           "b.mtx.",
       .example = "build/bin/ch03_impulse_lcp chapters/ch03_impulse_lcp/scenes/newtons_cradle.yaml",
       .explain = explain,
       .run = run,
       .check = check});
}
