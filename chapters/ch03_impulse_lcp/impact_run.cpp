#include "ch03_impulse_lcp/impact_run.hpp"

#include <fmt/format.h>

#include <optional>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch03_impulse_lcp/impact.hpp"
#include "ch03_impulse_lcp/matrix_market.hpp"
#include "ch03_impulse_lcp/solution_tables.hpp"
#include "ch03_impulse_lcp/unsolved.hpp"
#include "common/pair_rules.hpp"
#include "common/shape.hpp"

namespace fc::lcp {
namespace {

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

}  // namespace

int run_impact(const Scene& scene, const Solver& solve, const RunContext& context, Summary& summary) {
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

  // Resolve the impact. For the tables, keep the first solve that succeeded, or else the first.
  ImpactProblem problem = assemble(bodies, contacts);
  std::optional<TimedResult> shown;
  std::int64_t solver_runs = 0, solver_ns = 0;
  const ImpactOptions options{.solver = [&](const Lcp& rows) {
    const TimedResult solved = solve_timed(rows, solve);
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
  if (!shown) shown = solve_timed(rows, solve);  // nothing approaches: the answer is z = 0

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

}  // namespace fc::lcp
