#include "ch04_multibody_stepping/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace fc::world {
namespace {

std::vector<Column> steps_columns(const MoreColumns& more) {
  std::vector<Column> columns = {{"step", ""},       {"t", "s"},           {"kinetic", "J"},
                                 {"potential", "J"}, {"energy", "J"},      {"px", "kg m/s"},
                                 {"py", "kg m/s"},   {"pz", "kg m/s"},     {"lx", "kg m²/s"},
                                 {"ly", "kg m²/s"},  {"lz", "kg m²/s"},    {"contacts", ""},
                                 {"impacts", ""},    {"min_gap", "m"},     {"max_penetration", "m"},
                                 {"lcp_rows", ""},   {"lcp_residual", ""}, {"lost_time", "s"},
                                 {"ccd_ns", ""},     {"lcp_ns", ""},       {"step_ns", ""}};
  columns.insert(columns.end(), more.columns.begin(), more.columns.end());
  return columns;
}
std::vector<Column> contacts_columns(bool kinds, const MoreColumns& more) {
  std::vector<Column> columns = {{"t", "s"},        {"body_a", ""}, {"body_b", ""},      {"x", "m"},
                                 {"y", "m"},        {"z", "m"},     {"nx", ""},          {"ny", ""},
                                 {"nz", ""},        {"gap", "m"},   {"v_before", "m/s"}, {"v_after", "m/s"},
                                 {"impulse", "N s"}};
  if (kinds) columns.push_back({"kind", ""});
  columns.insert(columns.end(), more.contact_columns.begin(), more.contact_columns.end());
  return columns;
}
std::vector<Column> poses_columns() {
  return {{"t", "s"},    {"body", ""},  {"px", "m"},     {"py", "m"},     {"pz", "m"},
          {"qw", ""},    {"qx", ""},    {"qy", ""},      {"qz", ""},      {"vx", "m/s"},
          {"vy", "m/s"}, {"vz", "m/s"}, {"wx", "rad/s"}, {"wy", "rad/s"}, {"wz", "rad/s"}};
}

std::vector<Column> sensors_columns() {
  return {{"t", "s"}, {"sensor", ""}, {"body", ""}, {"x", "m"},   {"y", "m"},      {"z", "m"},
          {"nx", ""}, {"ny", ""},     {"nz", ""},   {"gap", "m"}, {"speed", "m/s"}};
}

}  // namespace

Totals totals_of(const World& world) {
  Totals totals;
  for (const Body& body : world.bodies) {
    if (body.state.is_static()) continue;
    totals.kinetic += body.state.kinetic_energy();
    if (world.effects.gravity)
      totals.potential -= body.state.mass * world.effects.gravity->dot(body.state.position);
    totals.momentum += body.state.momentum();
    totals.angular_momentum += body.state.angular_momentum();
  }
  return totals;
}

Recorder::Recorder(const Scene& scene, const World& world, const RunContext& context, bool kinds,
                   const MoreColumns& more)
    : kinds_(kinds),
      more_(more),
      steps_(context.out_dir / "steps.csv", steps_columns(more)),
      contacts_(context.out_dir / "contacts.csv", contacts_columns(kinds, more)),
      motion_(scene.name, context.chapter, scene.step->dt),
      folder_(context.out_dir),
      dt_(scene.step->dt) {
  if (context.poses) poses_.emplace(context.out_dir / "poses.csv", poses_columns());
  if (world.effects.sensors) sensors_.emplace(context.out_dir / "sensors.csv", sensors_columns());
  for (const Shape& shape : world.shapes) motion_.add_shape(shape);
  for (const Body& body : world.bodies) motion_.add_body(body.shape, body.state);
}

void Recorder::start(const World& world) {
  StepReport nothing;
  nothing.min_gap = std::numeric_limits<double>::infinity();
  steps_row(world, 0, 0, nothing);
  poses_rows(world, 0);
  motion_frame(world, 0, 0, 0, 0);
}

void Recorder::instant(const World& world, double time) {
  for (; impacts_seen_ < impacts_.size(); ++impacts_seen_) {
    const lcp::Contact& c = impacts_[impacts_seen_].contact;
    for (const int body : {c.body_a, c.body_b})
      kinks_.push_back({body, time, world.state_at(body, time - world.part_start)});
  }
}

void Recorder::frame(const World& world, int number, double t, const StepReport& report) {
  double impulse = 0;
  for (const ImpactRecord& record : impacts_) impulse += record.impulse.impulse;
  const int contacts = static_cast<int>(impacts_.size());
  write_impacts((number - 1) * dt_);
  write_sightings((number - 1) * dt_);
  steps_row(world, number, t, report);
  poses_rows(world, t);
  motion_frame(world, t, impulse, contacts, report.impacts);
  reports_.push_back(report);
}

void Recorder::write_impacts(double frame_start) {
  for (const Kink& kink : kinks_) motion_.key(kink.body, frame_start + kink.time, kink.state);
  for (const ImpactRecord& record : impacts_) {
    const double t = frame_start + record.time;
    const lcp::Contact& c = record.contact;
    const bool rests = record.kind == ContactKind::rest;
    if (!first_impact_ && !rests) first_impact_ = t;
    std::vector<Cell> row = {t,
                             std::int64_t{c.body_a},
                             std::int64_t{c.body_b},
                             c.point.x(),
                             c.point.y(),
                             c.point.z(),
                             c.normal.x(),
                             c.normal.y(),
                             c.normal.z(),
                             c.gap,
                             record.impulse.v_before,
                             record.impulse.v_after,
                             record.impulse.impulse};
    if (kinds_) row.emplace_back(rests ? "rest" : "impact");
    if (more_.contact_cells)
      for (const Cell& cell : more_.contact_cells(record)) row.push_back(cell);
    contacts_.row(row);
    motion_.contact(t, c.point, c.normal, record.impulse.impulse, rests);
  }
  kinks_.clear();
  impacts_.clear();
  impacts_seen_ = 0;
}

void Recorder::write_sightings(double frame_start) {
  for (const Sighting& s : sightings_)
    sensors_->row({frame_start + s.time, std::int64_t{s.sensor}, std::int64_t{s.body}, s.point.x(),
                   s.point.y(), s.point.z(), s.normal.x(), s.normal.y(), s.normal.z(), s.gap, s.speed});
  sightings_.clear();
}

std::string Recorder::close() {
  write_impacts(static_cast<double>(reports_.size()) * dt_);  // what a failed step has left
  write_sightings(static_cast<double>(reports_.size()) * dt_);
  if (sensors_) sensors_->close();
  steps_.close();
  contacts_.close();
  if (poses_) poses_->close();
  return motion_.write(folder_);
}

void Recorder::motion_frame(const World& world, double t, double impulse, int contacts, int impacts) {
  std::vector<RigidBody> states;
  for (const Body& body : world.bodies) states.push_back(body.state);
  motion_.frame(t, states);
  const Totals totals = totals_of(world);
  motion_.value("energy", "kinetic", "J", totals.kinetic);
  if (world.effects.gravity && !world.effects.gravity->isZero(0)) {
    motion_.value("energy", "potential", "J", totals.potential);
    motion_.value("energy", "total", "J", totals.kinetic + totals.potential);
  }
  motion_.value("impulse", "impulse in the frame", "N s", impulse);
  motion_.value("contacts", "contacts in the frame", "", contacts);
  if (kinds_) motion_.value("contacts", "impacts in the frame", "", impacts);
}

void Recorder::steps_row(const World& world, int number, double t, const StepReport& r) {
  const Totals e = totals_of(world);
  const Vec3 &p = e.momentum, &l = e.angular_momentum;
  std::vector<Cell> row = {std::int64_t{number},
                           t,
                           e.kinetic,
                           e.potential,
                           e.kinetic + e.potential,
                           p.x(),
                           p.y(),
                           p.z(),
                           l.x(),
                           l.y(),
                           l.z(),
                           std::int64_t{r.contacts},
                           std::int64_t{r.impacts},
                           r.min_gap,
                           r.max_penetration,
                           std::int64_t{r.lcp_rows},
                           r.lcp_residual,
                           r.lost_time,
                           r.ccd_ns,
                           r.lcp_ns,
                           r.step_ns};
  if (more_.cells)
    for (const Cell& cell : more_.cells()) row.push_back(cell);
  steps_.row(row);
}

void Recorder::poses_rows(const World& world, double t) {
  if (!poses_) return;
  for (std::int64_t i = 0; i < static_cast<std::int64_t>(world.bodies.size()); ++i) {
    const Body& body = world.bodies[i];
    const Vec3 x = frame_position(world.shapes[body.shape], body.state);
    const Quat& q = body.state.orientation;
    const Vec3 &v = body.state.velocity, &w = body.state.spin;
    poses_->row(
        {t, i, x.x(), x.y(), x.z(), q.w(), q.x(), q.y(), q.z(), v.x(), v.y(), v.z(), w.x(), w.y(), w.z()});
  }
}

void summarize(const Scene& scene, const World& world, const std::vector<StepReport>& reports,
               Summary& summary) {
  StepReport worst;
  worst.min_gap = std::numeric_limits<double>::infinity();
  double lost_time = 0, work = 0, slept = 0;
  std::int64_t pairs = 0, sightings = 0, falls_asleep = 0, wakes = 0;
  std::int64_t contacts = 0, impacts = 0, with_contact = 0, slow = 0, ccd_ns = 0, lcp_ns = 0, queries = 0,
               solves = 0, node_pairs = 0;
  int fewest = std::numeric_limits<int>::max(), most = 0;
  std::vector<std::int64_t> contact_ns;
  for (const StepReport& r : reports) {
    worst.min_gap = std::min(worst.min_gap, r.min_gap);
    worst.max_penetration = std::max(worst.max_penetration, r.max_penetration);
    worst.lcp_residual = std::max(worst.lcp_residual, r.lcp_residual);
    worst.momentum_error = std::max(worst.momentum_error, r.momentum_error);
    worst.energy_error = std::max(worst.energy_error, r.energy_error);
    worst.energy_gain = std::max(worst.energy_gain, r.energy_gain);
    lost_time += r.lost_time;
    work += r.kinematic_work;
    slept += r.slept_energy;
    pairs += r.pairs;
    sightings += r.sightings;
    falls_asleep += r.falls_asleep;
    wakes += r.wakes;
    contacts += r.contacts;
    impacts += r.impacts;
    ccd_ns += r.ccd_ns;
    lcp_ns += r.lcp_ns;
    queries += r.queries;
    node_pairs += r.node_pairs;
    solves += r.solves;
    if (r.step_ns > 1e9 / 30) ++slow;
    if (r.contacts == 0) continue;
    ++with_contact;
    fewest = std::min(fewest, r.contacts);
    most = std::max(most, r.contacts);
    contact_ns.push_back(r.step_ns);
  }
  std::sort(contact_ns.begin(), contact_ns.end());

  const Totals end = totals_of(world);
  summary.add("frames", static_cast<std::int64_t>(reports.size()));
  summary.add("frames with contact", with_contact);
  summary.add("contacts", contacts);
  summary.add("impacts", impacts);
  summary.add("kinetic energy at the end", end.kinetic, "J");
  summary.add("total energy at the end", end.kinetic + end.potential, "J");
  summary.add("smallest certified gap", worst.min_gap, "m");
  summary.add("largest penetration", worst.max_penetration, "m");
  summary.add("tolerance", world.tolerance, "m");
  if (world.tolerance > scene.ccd.tolerance)
    summary.add_note("tolerance was raised from",
                     fmt::format("{} m: rounding allows no less", scene.ccd.tolerance));
  summary.add("worst LCP residual", worst.lcp_residual);
  summary.add("worst momentum change at an impact", worst.momentum_error, "of the sum of sizes");
  summary.add("largest kinetic energy gain at an impact", worst.energy_gain, "J");
  summary.add("worst deviation from the energy identity", worst.energy_error, "J");
  summary.add("lost time", lost_time, "s");
  if (world.effects.kinematic) summary.add("work of kinematic bodies", work, "J");
  if (world.effects.sleep) {
    summary.add("bodies that fell asleep", falls_asleep);
    summary.add("bodies that were woken", wakes);
    summary.add("energy given up to sleep", slept, "J");
  }
  if (world.effects.sensors) summary.add("sightings of sensors", sightings);
  summary.add("pairs of nodes", node_pairs);
  if (!contact_ns.empty()) {
    summary.add_time("median frame with contact", contact_ns[contact_ns.size() / 2]);
    summary.add_time("slowest frame with contact", contact_ns.back());
  }
  summary.add_note("frames over 1/30 s", std::to_string(slow));
  const auto meshes = std::count_if(world.bodies.begin(), world.bodies.end(), [&](const Body& body) {
    return world.shapes[body.shape].kind == Shape::Kind::mesh;
  });
  if (scene.name == "two_bunnies" && meshes >= 2 &&
      with_contact > 0) {  // the demo: the paper's row (its section 5)
    const auto ms = [](std::int64_t ns) { return 1e-6 * static_cast<double>(ns); };
    summary.add_note("paper: contacts in a frame with contact",
                     "a few to dozens (two bunnies, 70,000 triangles)");
    summary.add_note("ours:  contacts in a frame with contact",
                     fewest == most ? std::to_string(most) : fmt::format("{} to {}", fewest, most));
    summary.add_note("paper: time of a frame with contact", "3 to 50 ms");
    summary.add_note("ours:  time of a frame with contact",
                     fmt::format("{:.2f} to {:.2f} ms, median {:.2f} ms", ms(contact_ns.front()),
                                 ms(contact_ns.back()), ms(contact_ns[contact_ns.size() / 2])));
    summary.add_note("paper: frames over 1/30 s", "not stated");
    summary.add_note("ours:  frames over 1/30 s", fmt::format("{} of {}", slow, reports.size()));
  }
  summary.counter("continuous collision queries", queries, ccd_ns);
  summary.counter("LCP solves", solves, lcp_ns);
  summary.counter("swept detection (pairs of bodies whose swept boxes overlap)", pairs, 0);
  if (scene.gravity) summary.counter("gravity (inside the motions: free fall in closed form)", queries, 0);
  if (scene.gyroscopic) summary.counter("gyroscopic (inside the motions: torque-free rotation)", queries, 0);
  if (scene.drag) summary.counter("drag (inside the motions: exponential decay)", queries, 0);
  if (world.effects.kinematic) summary.counter("kinematic (solves, their work)", solves, 0);
  if (world.effects.sensors) summary.counter("sensor (sightings)", sightings, 0);
  if (world.effects.sleep) summary.counter("sleep (falls asleep and wakes)", falls_asleep + wakes, 0);
}

}  // namespace fc::world
