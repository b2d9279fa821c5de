#include "ch03_impulse_lcp/show_impulses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ch03_impulse_lcp/clear/dantzig.hpp"
#include "ch03_impulse_lcp/delassus.hpp"

namespace fc::lcp {
namespace {

using algorithm::Role;
using algorithm::Step;

constexpr double kNothing = 1e-10;      // of the largest entry: a w below this counts as 0
constexpr std::size_t kMostShown = 60;  // contacts that are drawn, and bodies

std::size_t place(int index) {
  return static_cast<std::size_t>(index);
}

// What a row does: the state that the method gives it.
struct RowState {
  const char* name;
  Role role;
};
RowState state_of(double z, double w, double slack) {
  if (z > 0 && w < -slack) return {"being raised", Role::now};
  if (z > 0) return {"pushes", Role::good};
  if (w < -slack) return {"closes in", Role::bad};
  return {"parts", Role::past};
}

int closing(const VecX& w, double slack) {
  return static_cast<int>((w.array() < -slack).count());
}

std::string closing_text(int n) {
  if (n == 0) return "No contact closes in any more.";
  return n == 1 ? "One contact still closes in." : fmt::format("{} contacts still close in.", n);
}

algorithm::Bars bars_of(const ShownContacts& shown, const Pivot& pivot, double slack) {
  algorithm::Bars bars{"impulse z of each contact; beside it w", "N s", {}};
  for (Eigen::Index i = 0; i < pivot.z.size(); ++i) {
    const RowState state = state_of(pivot.z[i], pivot.w[i], slack);
    bars.rows.push_back(
        {contact_name(shown, static_cast<std::size_t>(i)), pivot.z[i], state.role,
         fmt::format("w = {} m/s: {}", algorithm::number(std::abs(pivot.w[i]) < slack ? 0 : pivot.w[i]),
                     state.name)});
  }
  return bars;
}

// What the k-th exchange did.
std::string pivot_text(const ShownContacts& shown, const std::vector<Pivot>& pivots, std::size_t k,
                       double slack) {
  const Pivot &before = pivots[k - 1], &now = pivots[k];
  std::string text = fmt::format("Pivot {}. ", k);
  for (Eigen::Index i = 0; i < now.z.size(); ++i) {
    const std::string name = contact_name(shown, static_cast<std::size_t>(i));
    const bool had = before.z[i] > 0, has = now.z[i] > 0;
    if (had && !has) text += fmt::format("The impulse at {} has come down to 0, and it may part. ", name);
    if (had == has && !has) continue;
    const bool raised = has && now.w[i] < -slack, stopped = has && !raised && before.w[i] < -slack;
    if (stopped)
      text += fmt::format("An impulse of {} N s stops {}. ", algorithm::number(now.z[i]), name);
    else if (raised)
      text +=
          fmt::format("The impulse at {} is raised to {} N s; another row has to change before it goes on. ",
                      name, algorithm::number(now.z[i]));
    else if (!had && has)
      text += fmt::format("Now {} closes in, too, and gets an impulse of its own. ", name);
  }
  if (before.z == now.z)
    text +=
        "Another contact would close in as soon as the impulse grows. Its row is exchanged first; nothing changes yet. ";
  return text + closing_text(closing(now.w, slack));
}

std::vector<Vec3> along_normals(const ShownContacts& shown, const VecX& z) {
  std::vector<Vec3> impulses;
  for (std::size_t i = 0; i < shown.contacts.size(); ++i)
    impulses.push_back(z[static_cast<Eigen::Index>(i)] * shown.contacts[i].normal);
  return impulses;
}

// m/s
double fastest_of(std::span<const RigidBody> before, std::span<const RigidBody> after) {
  double fastest = 0;
  for (const auto& bodies : {before, after})
    for (const RigidBody& body : bodies) fastest = std::max(fastest, body.velocity.norm());
  return fastest;
}

Step velocity_step(const ShownContacts& shown, std::span<const RigidBody> before,
                   std::span<const RigidBody> after, const ImpactResult& result) {
  Step step;
  step.text = fmt::format(
      "The velocities before (pale) and after {}. The kinetic energy of these bodies changes by {} J.",
      algorithm::count(static_cast<int>(result.impulses.size()), "impulse"),
      algorithm::number(result.energy_change));
  const double fastest = fastest_of(before, after);
  add_velocities(shown, before, fastest, Role::past, step);
  add_velocities(shown, after, fastest, Role::now, step);
  algorithm::Bars bars{"velocity along the normal, after; negative: closes in", "m/s", {}};
  for (std::size_t i = 0; i < std::min(shown.contacts.size(), kMostShown); ++i)
    bars.rows.push_back(
        {contact_name(shown, i), contact_velocity(after, shown.contacts[i]), Role::good,
         fmt::format("before {}", algorithm::number(contact_velocity(before, shown.contacts[i])))});
  step.bars = bars;
  return step;
}

Step contacts_step(const ShownContacts& shown) {
  Step step;
  int closes = 0;
  for (const Contact& contact : shown.contacts) closes += contact_velocity(shown.bodies, contact) < 0 ? 1 : 0;
  step.text = fmt::format(
      "Everything that touches at this instant, and is connected through bodies that can move, is one problem: {}, of "
      "which {} in. The arrows are the normals, from the first body to the second.",
      algorithm::count(static_cast<int>(shown.contacts.size()), "contact"),
      closes == 1 ? "1 closes" : fmt::format("{} close", closes));
  add_contacts(shown, step);
  add_velocities(shown, shown.bodies, fastest_of(shown.bodies, shown.bodies), Role::past, step);
  algorithm::Bars bars{"velocity along the normal; negative: closes in", "m/s", {}};
  for (std::size_t i = 0; i < std::min(shown.contacts.size(), kMostShown); ++i) {
    const double v = contact_velocity(shown.bodies, shown.contacts[i]);
    bars.rows.push_back({contact_name(shown, i), v, v < 0 ? Role::bad : Role::past,
                         fmt::format("restitution {}", algorithm::number(shown.contacts[i].restitution))});
  }
  step.bars = bars;
  return step;
}

}  // namespace

std::vector<Pivot> pivots_of(const MatX& A, const VecX& b, int most) {
  if (b.size() > most) return {};
  const LcpResult all = clear::dantzig(A, b, 0);
  if (all.status != Status::solved) return {};
  std::vector<Pivot> pivots{{VecX::Zero(b.size()), b}};
  for (int k = 1; k < all.pivots; ++k) {  // stopped after k exchanges
    const LcpResult stopped = clear::dantzig(A, b, k);
    pivots.push_back({stopped.z, stopped.w});
  }
  if (all.pivots > 0) pivots.push_back({all.z, all.w});
  return pivots;
}

std::string contact_name(const ShownContacts& shown, std::size_t i) {
  const Contact& contact = shown.contacts[i];
  return fmt::format("contact {} (bodies {} and {})", i + 1, shown.numbers[place(contact.body_a)],
                     shown.numbers[place(contact.body_b)]);
}

void add_contacts(const ShownContacts& shown, Step& step) {
  for (std::size_t i = 0; i < std::min(shown.contacts.size(), kMostShown); ++i) {
    const Contact& contact = shown.contacts[i];
    step.draw.push_back(algorithm::point(contact.point, Role::now));
    step.draw.push_back(
        algorithm::arrow(contact.point, contact.point + 0.35 * shown.arrow * contact.normal, Role::b));
    if (shown.contacts.size() <= 12)
      step.draw.push_back(algorithm::label(contact.point, fmt::format("{}", i + 1)));
  }
}

void add_impulses(const ShownContacts& shown, std::span<const Vec3> impulses, Role role, Step& step) {
  double largest = 0;
  for (const Vec3& impulse : impulses) largest = std::max(largest, impulse.norm());
  if (largest == 0) return;
  int drawn = 0;
  for (std::size_t i = 0; i < impulses.size(); ++i) {
    if (impulses[i].norm() <= kNothing * largest || ++drawn > static_cast<int>(kMostShown)) continue;
    const Vec3& at = shown.contacts[i].point;
    step.draw.push_back(algorithm::arrow(at, at + shown.arrow / largest * impulses[i], role));
  }
}

void add_velocities(const ShownContacts& shown, std::span<const RigidBody> bodies, double fastest, Role role,
                    Step& step) {
  if (fastest == 0) return;
  for (std::size_t i = 0; i < std::min(bodies.size(), kMostShown); ++i) {
    const RigidBody& body = bodies[i];
    if (body.velocity.norm() <= 1e-3 * fastest) continue;
    step.draw.push_back(
        algorithm::arrow(body.position, body.position + shown.arrow / fastest * body.velocity, role));
  }
}

std::vector<Step> show_pivots(const ShownContacts& shown, const MatX& A, const VecX& b) {
  const std::vector<Pivot> pivots = pivots_of(A, b);
  std::vector<Step> steps;
  if (pivots.empty()) return steps;
  const double slack = kNothing * b.lpNorm<Eigen::Infinity>();
  for (std::size_t k = 0; k < pivots.size(); ++k) {
    Step step;
    step.text = k == 0 ? fmt::format(
                             "Dantzig's method begins without impulses. {} w < 0: they are taken one by "
                             "one.",
                             closing(b, slack) == 1 ? "One contact has"
                                                    : fmt::format("{} contacts have", closing(b, slack)))
                       : pivot_text(shown, pivots, k, slack);
    add_contacts(shown, step);
    add_impulses(shown, along_normals(shown, pivots[k].z), Role::force, step);
    step.bars = bars_of(shown, pivots[k], slack);
    steps.push_back(step);
  }
  return steps;
}

std::vector<Step> show_impact(const ShownContacts& shown, const ImpactOptions& options,
                              const std::string& solver) {
  std::vector<Step> steps{contacts_step(shown)};
  std::vector<RigidBody> after(shown.bodies.begin(), shown.bodies.end());
  const ImpactResult result = resolve_impact(after, shown.contacts, options);
  if (result.status != Status::solved) {
    steps.push_back(
        {fmt::format("The solver ends with the status {}: no velocity changes.", name(result.status))});
    return steps;
  }
  if (result.solves == 0) {
    steps.back().text += " Nothing approaches: there is nothing to solve.";
    return steps;
  }
  const ImpactProblem problem = assemble(shown.bodies, shown.contacts);
  std::vector<Step> pivots = show_pivots(shown, problem.A, problem.b);
  if (pivots.empty())
    pivots.push_back({fmt::format("{} rows are too many to show pivot by pivot; the method used {}.",
                                  shown.contacts.size(), algorithm::count(result.pivots, "pivot"))});
  else if (solver != "dantzig")
    pivots.back().text +=
        fmt::format(" The scene's solver is {}, which reaches the same velocities in its own way.", solver);
  if (result.solves > 1)
    pivots.back().text +=
        fmt::format(" Bodies that parted now meet others: {} in the same instant.",
                    result.solves == 2 ? "another solve follows"
                                       : fmt::format("{} more solves follow", result.solves - 1));
  steps.insert(steps.end(), pivots.begin(), pivots.end());

  Step impulses;
  std::vector<Vec3> total(shown.contacts.size(), Vec3::Zero());
  for (const Impulse& p : result.impulses)
    total[place(p.contact)] += p.impulse * shown.contacts[place(p.contact)].normal;
  double largest = 0;
  for (const Vec3& impulse : total) largest = std::max(largest, impulse.norm());
  impulses.text =
      fmt::format("The impulses of the step itself: the largest is {} N s.", algorithm::number(largest));
  if (total.size() > 1)
    impulses.text +=
        " Where there are more contacts than the velocities need, other impulses have the same effect.";
  add_impulses(shown, total, Role::force, impulses);
  steps.push_back(impulses);
  steps.push_back(velocity_step(shown, shown.bodies, after, result));
  return steps;
}

}  // namespace fc::lcp
