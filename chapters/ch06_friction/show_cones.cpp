#include "ch06_friction/show_cones.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch06_friction/contact_block.hpp"
#include "ch06_friction/coulomb_law.hpp"
#include "ch06_friction/friction_solver.hpp"
#include "ch06_friction/rubbing.hpp"

namespace fc::friction {
namespace {

using algorithm::Role;
using algorithm::Step;
using resting::at;
using resting::SeenPush;

constexpr std::size_t kMostCones = 24, kMostPushes = 3;
constexpr std::size_t kMostSolved = 40;  // contacts of an island whose sweeps are shown
constexpr int kSides = 16;               // of a cone as it is drawn
constexpr double kSticking = 1e-9;       // as the law has it: inside the cone by more than this share
constexpr double kOpenCone = 0.12;       // of an arrow: the height of a cone without an impulse

double mu_of(const world::World& world, const SeenPush& push, const lcp::Contact& contact) {
  const auto shape = [&](int body) { return world.bodies[at(push.numbers[at(body)])].shape; };
  return world.pair_rules.friction(world.shapes, shape(contact.body_a), shape(contact.body_b));
}

Vec3 along_surface_of(const Vec3& normal, const Vec3& v) {
  return v - normal.dot(v) * normal;
}

bool rubs(const world::World& world, const SeenPush& push) {
  return std::any_of(push.contacts.begin(), push.contacts.end(),
                     [&](const lcp::Contact& contact) { return mu_of(world, push, contact) > 0; });
}

struct GripLook {
  const char* name;
  Role role;
};
GripLook look_of(Grip grip) {
  if (grip == Grip::open) return {"open", Role::past};
  return grip == Grip::sticks ? GripLook{"sticks", Role::good} : GripLook{"slips", Role::now};
}

Step cone_step(const world::World& world, const SeenPush& push, double t0) {
  const lcp::ShownContacts shown = push.shown(world);
  double largest = 0;
  for (const Vec3& impulse : push.impulses) largest = std::max(largest, impulse.norm());
  const double scale = largest > 0 ? shown.arrow / largest : 0;
  Step step;
  step.poses = push.poses();
  algorithm::Bars bars{"how much of its friction each contact uses: |r_T| / (µ r_N)", "", {}};
  int count[3] = {};
  for (std::size_t i = 0; i < push.contacts.size(); ++i) {
    const lcp::Contact& contact = push.contacts[i];
    const Vec3& n = contact.normal;
    const double mu = mu_of(world, push, contact), along = push.impulses[i].dot(n);
    const Grip grip = grip_of(push.impulses[i], n, mu);
    ++count[static_cast<int>(grip)];
    if (i >= kMostCones) continue;
    const GripLook look = look_of(grip);
    const double height = grip == Grip::open ? kOpenCone * shown.arrow : scale * along;
    if (mu > 0) step.draw.push_back(cone_mesh(contact.point, n, mu, height, look.role));
    if (grip != Grip::open)
      step.draw.push_back(
          algorithm::arrow(contact.point, contact.point + scale * push.impulses[i], Role::force));
    const Vec3 slip = along_surface_of(n, lcp::relative_velocity(push.after, contact));
    const double used = mu > 0 && along > 0 ? along_surface_of(n, push.impulses[i]).norm() / (mu * along) : 0;
    bars.rows.push_back(
        {lcp::contact_name(shown, i), used, look.role,
         grip == Grip::slips ? fmt::format("slips, {} m/s", algorithm::number(slip.norm())) : look.name});
  }
  step.text = fmt::format(
      "{}, at {:.6g} s. Of {}, {} stick, {} slip and {} push nothing. Each impulse lies in its cone, as wide as µ: inside "
      "it the contact sticks, on its surface it slips against the impulse.",
      push.is_instant() ? "An instant" : "A plan's pushes", t0 + push.time,
      algorithm::count(static_cast<int>(push.contacts.size()), "contact"), count[1], count[2], count[0]);
  if (push.contacts.size() > kMostCones)
    step.text += fmt::format(" {} cones are not drawn.", push.contacts.size() - kMostCones);
  step.bars = bars;
  return step;
}

// The same problem as a matrix, three rows a contact.
struct RowsOfPush {
  MatX A;
  VecX b, mu;
  RowsOfPush(const world::World& world, const SeenPush& push) {
    const auto n = static_cast<Eigen::Index>(push.contacts.size());
    std::vector<lcp::Contact> rows;
    VecX offset(3 * n);
    mu.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const lcp::Contact& contact = push.contacts[k];
      const Mat3 frame = contact_frame(contact.normal);
      for (int axis = 0; axis < 3; ++axis) {
        rows.push_back(contact);
        rows.back().normal = frame.col(axis);
      }
      const Vec3 bend = push.bends.empty() ? Vec3(Vec3::Zero()) : push.bends[k];
      offset.segment<3>(3 * i) = frame.transpose() * (push.limits[k] * contact.normal + bend);
      mu[i] = mu_of(world, push, contact);
    }
    const lcp::ImpactProblem problem = lcp::assemble(push.before, rows);
    A = problem.A;
    b = problem.v_before + offset;
  }
};

Step residual_step(const world::World& world, const SeenPush& push) {
  algorithm::Curve curve{"sweeps, contact by contact", Role::now, {}};
  for (const ResidualAfter& r : residuals_of(world, push))
    if (r.residual > 0) curve.points.push_back({static_cast<double>(r.sweeps), r.residual});
  Step step;
  step.text = fmt::format(
      "The rounds of the solver: in each sweep every contact is solved as if all others were known. After {} sweeps "
      "the residual is {}; the step itself goes on with other methods, and reached {}.",
      curve.points.empty() ? 0 : static_cast<int>(curve.points.back()[0]),
      curve.points.empty() ? "0" : algorithm::number(curve.points.back()[1]),
      algorithm::number(push.result.residual));
  if (!curve.points.empty()) step.chart = algorithm::Chart{"sweeps", "residual", true, {curve}, {}};
  return step;
}

}  // namespace

Grip grip_of(const Vec3& impulse, const Vec3& normal, double mu) {
  const double along = impulse.dot(normal);
  if (!(along > 0)) return Grip::open;
  return along_surface_of(normal, impulse).norm() < (1 - kSticking) * mu * along ? Grip::sticks : Grip::slips;
}

algorithm::Mark cone_mesh(const Vec3& point, const Vec3& normal, double mu, double height, Role role) {
  const Mat3 frame = contact_frame(normal);
  const double radius = mu * height / std::cos(std::numbers::pi / kSides);
  std::vector<Vec3> points{point};
  std::vector<std::array<int, 3>> triangles;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2 * std::numbers::pi * i / kSides;
    points.push_back(point + height * normal +
                     radius * (std::cos(angle) * frame.col(1) + std::sin(angle) * frame.col(2)));
    triangles.push_back({0, 1 + i, 1 + (i + 1) % kSides});
  }
  return algorithm::mesh(std::move(points), std::move(triangles), role);
}

std::vector<ResidualAfter> residuals_of(const world::World& world, const SeenPush& push) {
  std::vector<ResidualAfter> list;
  if (push.contacts.size() > kMostSolved) return list;
  const RowsOfPush rows(world, push);
  const ConeProblem problem{rows.A, rows.b, rows.mu};
  for (const int sweeps : {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128}) {
    const ConeResult found = solve(problem, Method::gauss_seidel, {.limit = sweeps, .tolerance = 1e-14});
    list.push_back({sweeps, found.residual});
    if (found.status == Status::solved) break;
  }
  return list;
}

std::vector<algorithm::Part> show_cones(const world::World& world, const resting::RestWatch& watch,
                                        double t0) {
  algorithm::Part part{6, "friction: cones, stick and slip", {}};
  std::size_t shown = 0;
  for (const SeenPush* push : pushes_that_count(watch)) {
    if (push->corrects || !push->result.solved || !rubs(world, *push) || shown == kMostPushes) continue;
    part.steps.push_back(cone_step(world, *push, t0));
    if (shown++ == 0 && push->contacts.size() <= kMostSolved)
      part.steps.push_back(residual_step(world, *push));
  }
  if (shown == 0)
    part.steps.push_back(
        {"No contact with friction is solved by the exact law in this frame: either nothing touches, or all that "
         "touches is a pile, where contacts of two bodies share one patch, a disc and a twist."});
  return {part};
}

algorithm::Document show_frame(const Scene& scene, world::World& world, std::int64_t before, double t0) {
  if (!asks_for_friction(scene)) return resting::show_frame(scene, world, before, t0);
  return resting::show_rest(scene, world, before, t0, std::make_unique<CoulombLaw>(world), show_cones);
}

}  // namespace fc::friction
