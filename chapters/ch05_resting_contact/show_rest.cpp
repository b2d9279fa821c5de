#include "ch05_resting_contact/show_rest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ch03_impulse_lcp/delassus.hpp"
#include "ch05_resting_contact/show_paths.hpp"
#include "common/convex_hull.hpp"

namespace fc::resting {
namespace {

using algorithm::Role;
using algorithm::Step;

constexpr std::size_t kMostPatches = 5, kMostEnvelopes = 4, kMostIslands = 3;
constexpr std::size_t kMostCorners = 64;    // of a shape whose envelope is drawn
constexpr std::size_t kMostPivotRows = 24;  // of an island that is shown pivot by pivot

// A body with a layer of `width` (m) around it: the hull of its corners, each moved out along a few directions. Empty where that
// is no body with few corners.
std::optional<algorithm::Mark> envelope_mesh(const world::World& world, int body, double width, Role role) {
  const world::Body& b = world.bodies[at(body)];
  const Shape& shape = world.shapes[at(b.shape)];
  if (!shape.convex() || !shape.disks.empty() || shape.core.vertices.size() > kMostCorners) return {};
  const Pose pose = b.state.pose();
  std::vector<Vec3> points;
  for (const Vec3& corner : shape.core.vertices)
    for (int i = 0; i < 27; ++i) {
      const Vec3 out(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (!out.isZero(0)) points.push_back(pose * Vec3(corner + (shape.radius + width) * out.normalized()));
    }
  const std::optional<TriangleMesh> hull = hull_mesh(points);
  if (!hull) return {};
  std::vector<std::array<int, 3>> triangles;
  for (const auto& t : hull->triangles) triangles.push_back({t[0], t[1], t[2]});
  return algorithm::mesh(hull->vertices, triangles, role);
}

Step envelope_step(const world::World& world, const std::vector<PatchOfPair>& patches, double margin,
                   double dt) {
  Step step;
  step.text = fmt::format(
      "The envelope is {} m wide: bodies nearer than that are in contact, and rest {} m apart. {} of bodies {} in contact "
      "now. Only an approach faster than {} m/s (envelope / frame) bounces.",
      algorithm::number(margin), algorithm::number(0.5 * margin),
      algorithm::count(static_cast<int>(patches.size()), "pair"), patches.size() == 1 ? "is" : "are",
      algorithm::number(margin / dt));
  std::vector<int> drawn;
  for (const PatchOfPair& patch : patches)
    for (const int body : {patch.a, patch.b}) {
      if (drawn.size() == kMostEnvelopes || std::count(drawn.begin(), drawn.end(), body) > 0) continue;
      if (const auto mesh = envelope_mesh(world, body, 0.5 * margin, drawn.empty() ? Role::a : Role::b)) {
        step.draw.push_back(*mesh);
        drawn.push_back(body);
      }
    }
  return step;
}

Step patch_step(const PatchOfPair& patch, double margin, double arrow) {
  Step step;
  step.text =
      fmt::format("Bodies {} and {} face each other at {}; the certified gap is {} m, of {} m at rest.",
                  patch.a, patch.b, algorithm::count(static_cast<int>(patch.points.size()), "point"),
                  algorithm::number(patch.gap), algorithm::number(0.5 * margin));
  algorithm::Bars bars{"gap at each point of the patch", "m", {}};
  std::vector<Vec3> outline;
  for (std::size_t i = 0; i < patch.points.size(); ++i) {
    const PatchPoint& p = patch.points[i];
    const Vec3 middle = 0.5 * (p.on_a + p.on_b);
    outline.push_back(middle);
    step.draw.push_back(algorithm::point(p.on_a, Role::a));
    step.draw.push_back(algorithm::point(p.on_b, Role::b));
    step.draw.push_back(algorithm::arrow(middle, middle + 0.3 * arrow * p.normal, Role::now));
    bars.rows.push_back({fmt::format("point {}", i + 1), p.gap, p.gap <= margin ? Role::good : Role::past,
                         p.gap <= margin ? "in contact" : "beyond"});
  }
  if (outline.size() >= 3) step.draw.push_back(algorithm::line(outline, Role::now, true));
  step.bars = bars;
  return step;
}

std::string bodies_text(const std::vector<int>& numbers) {
  constexpr std::size_t kNamed = 8;
  std::vector<int> first(numbers.begin(),
                         numbers.begin() + static_cast<std::ptrdiff_t>(std::min(kNamed, numbers.size())));
  std::sort(first.begin(), first.end());
  return fmt::format("bodies {}{}", fmt::join(first, ", "),
                     numbers.size() > kNamed ? fmt::format(" and {} more", numbers.size() - kNamed) : "");
}

// One answer of the law.
void add_push(const world::World& world, const SeenPush& push, bool by_pivots, double t0,
              std::vector<Step>& steps) {
  const lcp::ShownContacts shown = push.shown(world);
  Step step;
  const char* what =
      push.corrects ? "Corrections of gaps: impulses that change the path alone"
      : push.is_instant()
          ? "The instant: impulses after which nothing closes in"
          : "The plan's pushes: impulses that act evenly until its end, after which each gap is kept";
  double largest = 0, tightest = std::numeric_limits<double>::infinity();
  for (const Vec3& impulse : push.impulses) largest = std::max(largest, impulse.norm());
  for (const double limit : push.limits) tightest = std::min(tightest, limit);
  step.text = fmt::format("{}, at {:.6g} s. The island has {} and {}; the largest impulse is {} N s.", what,
                          t0 + push.time, bodies_text(push.numbers),
                          algorithm::count(static_cast<int>(push.contacts.size()), "contact"),
                          algorithm::number(largest));
  if (by_pivots && push.contacts.size() > kMostPivotRows)
    step.text += fmt::format(" More than {} contacts are not shown pivot by pivot.", kMostPivotRows);
  if (!push.is_instant())
    step.text += fmt::format(" The tightest contact may close in at {} m/s.", algorithm::number(tightest));
  if (!push.result.solved) step.text += " This was not solved: something else is tried.";
  step.poses = push.poses();
  lcp::add_contacts(shown, step);
  lcp::add_impulses(shown, push.impulses, push.result.solved ? Role::force : Role::bad, step);
  algorithm::Bars bars{"impulse of each contact", "N s", {}};
  for (std::size_t i = 0; i < std::min<std::size_t>(push.impulses.size(), 24); ++i) {
    const double along = push.impulses[i].dot(push.contacts[i].normal);
    bars.rows.push_back({lcp::contact_name(shown, i), along, along > 0 ? Role::good : Role::past,
                         fmt::format("limit {} m/s", algorithm::number(push.limits[i]))});
  }
  step.bars = bars;
  steps.push_back(step);
  if (!by_pivots || push.contacts.size() > kMostPivotRows) return;
  const lcp::ImpactProblem problem = lcp::assemble(push.before, push.contacts);
  const VecX b = problem.v_before + Eigen::Map<const VecX>(push.limits.data(), problem.v_before.size());
  for (Step& pivot : lcp::show_pivots(shown, problem.A, b)) {
    pivot.poses = push.poses();
    steps.push_back(std::move(pivot));
  }
}

algorithm::Part show_islands(const world::World& world, const RestWatch& watch, bool normals_only,
                             double t0) {
  algorithm::Part part{3, "islands, and the impulses of each", {}};
  const std::vector<const SeenPush*> pushes = pushes_that_count(watch);
  std::vector<std::vector<int>> islands;
  bool by_pivots = normals_only;
  for (const SeenPush* push : pushes) {
    const bool is_known = std::find(islands.begin(), islands.end(), push->numbers) != islands.end();
    if (!is_known && islands.size() == kMostIslands) continue;
    if (!is_known) islands.push_back(push->numbers);
    add_push(world, *push, by_pivots && !push->corrects, t0, part.steps);
    if (!push->corrects) by_pivots = false;  // one island pivot by pivot is enough
  }
  return part;
}

Step frame_step(const world::World& world, const RestWatch& watch) {
  Step step;
  std::vector<lcp::Contact> contacts;
  std::vector<Vec3> impulses;
  std::vector<int> bodies;
  double largest = 0;
  int impacts = 0;
  for (const world::ImpactRecord& record : watch.records) {
    impacts += record.kind == world::ContactKind::impact ? 1 : 0;
    contacts.push_back(record.contact);
    impulses.push_back(record.impulse.impulse * record.contact.normal + record.tangential);
    largest = std::max(largest, impulses.back().norm());
    for (const int body : {record.contact.body_a, record.contact.body_b}) bodies.push_back(body);
  }
  step.text = fmt::format(
      "The whole frame: {} of contacts that last, {} of impacts; the largest is {} N s. It took {}, with {} to be proved.",
      algorithm::count(static_cast<int>(watch.records.size()) - impacts, "impulse"), impacts,
      algorithm::number(largest), algorithm::count(watch.report.plans, "plan"),
      algorithm::count(watch.report.checked, "path"));
  if (watch.report.sweeps > 0)
    step.text += fmt::format(" There is a pile, solved by {} sweeps to a residual of {}.",
                             watch.report.sweeps, algorithm::number(watch.report.step.lcp_residual));
  const std::vector<RigidBody> none;
  lcp::add_impulses({none, bodies, contacts, world::arrow_length(world, bodies)}, impulses, Role::force,
                    step);
  for (std::size_t i = 0; i < world.bodies.size() && step.poses.size() < 120; ++i)
    if (!world.bodies[i].state.is_static())
      step.poses.push_back(
          {static_cast<int>(i), world.bodies[i].state.position, world.bodies[i].state.orientation});
  return step;
}

}  // namespace

algorithm::Document show_rest(const Scene& scene, world::World& world, std::int64_t before, double t0,
                              std::unique_ptr<ContactLaw> law, const MoreParts& more) {
  const double dt = scene.step->dt, margin = envelope_of(scene, world, dt);
  const bool normals_only = law == nullptr;
  if (!law) law = std::make_unique<NormalLaw>();
  algorithm::Document document{static_cast<int>(before) + 1, t0, t0 + dt, {}};
  world.rest_gap = 0.5 * margin;  // as the step sets it: pairs stop earlier than in chapter 4
  const world::ShownSearches searches(world, dt);

  algorithm::Part part{5, "envelope, patches, plans and proofs", {}};
  const std::vector<PatchOfPair> patches = patches_now(world, margin);
  part.steps.push_back(envelope_step(world, patches, margin, dt));
  for (std::size_t i = 0; i < std::min(patches.size(), kMostPatches); ++i)
    part.steps.push_back(
        patch_step(patches[i], margin, world::arrow_length(world, {patches[i].a, patches[i].b})));

  const RestWatch watch = watched_frame(scene, world, std::move(law));
  searches.add_parts(world, watch.frame, t0, document);
  algorithm::Part islands = show_islands(world, watch, normals_only, t0);
  if (!islands.steps.empty()) document.parts.push_back(std::move(islands));
  document.parts.push_back(world::show_events(world, watch.frame, dt, t0));
  for (Step& step : show_paths(world, watch.planned, watch.plan_end, margin, t0))
    part.steps.push_back(std::move(step));
  part.steps.push_back(frame_step(world, watch));
  part.steps.back().text +=
      " All this is worked out anew from where the bodies stand: the step itself remembers contacts and "
      "plans of the frame before, and then finds the same with less work, or other impulses of equal effect.";
  document.parts.push_back(std::move(part));
  if (more)
    for (algorithm::Part& added : more(world, watch, t0)) document.parts.push_back(std::move(added));
  return document;
}

algorithm::Document show_frame(const Scene& scene, world::World& world, std::int64_t before, double t0) {
  return scene.envelope ? show_rest(scene, world, before, t0) : world::show_frame(scene, world, before, t0);
}

}  // namespace fc::resting
