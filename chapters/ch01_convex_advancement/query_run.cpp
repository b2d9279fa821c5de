#include "ch01_convex_advancement/query_run.hpp"
#include "common/stopwatch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace fc::ca {
namespace {

struct Tables {
  std::filesystem::path leaves_file;
  TableWriter queries, features;
  std::optional<TableWriter> certificate, certificate_leaves;

  explicit Tables(const RunContext& context)
      : leaves_file(context.out_dir / "certificate_leaves.csv"),
        queries(context.out_dir / "queries.csv", {{"query", ""},
                                                  {"status", ""},
                                                  {"toc", "1"},
                                                  {"gap_lower", "m"},
                                                  {"gap_upper", "m"},
                                                  {"iterations", ""},
                                                  {"distance_calls", ""},
                                                  {"node_pairs", ""},
                                                  {"features", ""},
                                                  {"wall_ns", ""}}),
        features(context.out_dir / "features.csv", {{"query", ""},
                                                    {"ax", "m"},
                                                    {"ay", "m"},
                                                    {"az", "m"},
                                                    {"bx", "m"},
                                                    {"by", "m"},
                                                    {"bz", "m"},
                                                    {"nx", ""},
                                                    {"ny", ""},
                                                    {"nz", ""},
                                                    {"gap", "m"},
                                                    {"kind_a", ""},
                                                    {"kind_b", ""},
                                                    {"id_a", ""},
                                                    {"id_b", ""}}) {
    if (context.certificate)
      certificate.emplace(context.out_dir / "certificate.csv", std::vector<Column>{{"query", ""},
                                                                                   {"k", ""},
                                                                                   {"t", "s"},
                                                                                   {"nx", ""},
                                                                                   {"ny", ""},
                                                                                   {"nz", ""},
                                                                                   {"gap_lower", "m"},
                                                                                   {"speed_bound", "m/s"},
                                                                                   {"advance", "s"}});
  }
  void close() {
    queries.close();
    features.close();
    if (certificate) certificate->close();
    if (certificate_leaves) certificate_leaves->close();
  }

  void write(std::int64_t query, const AdvanceResult& r, double toc, std::int64_t wall_ns) {
    queries.row({query, std::string(name_of(r.status)), toc, r.gap_lower, r.gap_upper, r.iterations,
                 r.distance_calls, r.node_pairs, static_cast<std::int64_t>(r.features.size()), wall_ns});
    for (const FeaturePair& f : r.features)
      features.row({query, f.point_a.x(), f.point_a.y(), f.point_a.z(), f.point_b.x(), f.point_b.y(),
                    f.point_b.z(), f.normal.x(), f.normal.y(), f.normal.z(), f.gap,
                    std::string(name_of(f.kind_a)), std::string(name_of(f.kind_b)), std::int64_t{f.id_a},
                    std::int64_t{f.id_b}});
    if (!certificate) return;
    std::int64_t k = 0;
    for (const CertificateRow& row : r.certificate)
      certificate->row({query, k++, row.t, row.normal.x(), row.normal.y(), row.normal.z(), row.gap_lower,
                        row.speed_bound, row.advance});
    if (!r.certificate_leaves.empty() && !certificate_leaves)  // of hierarchies only
      certificate_leaves.emplace(
          leaves_file,
          std::vector<Column>{
              {"query", ""}, {"k", ""}, {"first_a", ""}, {"count_a", ""}, {"first_b", ""}, {"count_b", ""}});
    k = 0;
    for (const LeafBlock& block : r.certificate_leaves)
      certificate_leaves->row({query, k++, std::int64_t{block.first_a}, std::int64_t{block.count_a},
                               std::int64_t{block.first_b}, std::int64_t{block.count_b}});
  }
};

// The motion of the two bodies up to the query's answer, where they stop, in frames of a sixtieth of the
// interval.
MotionRecording recorded(const Scene& scene, const std::vector<Shape>& shapes, const QueryMotions& query,
                         const AdvanceResult& result, double interval, const std::string& chapter) {
  constexpr int kFrames = 60;
  const double end = result.status == Status::separated ? interval : result.toc;
  const double dt = interval > 0 ? interval / kFrames : 1.0 / kFrames;
  MotionRecording motion(scene.name, chapter, dt);
  for (const Shape& shape : shapes) motion.add_shape(shape);
  const auto states = [&](double t) {
    std::vector<RigidBody> bodies;
    for (int i = 0; i < 2; ++i) {
      const Motion& m = i == 0 ? query.a : query.b;
      RigidBody body;
      body.position = m.position_at(t);
      body.orientation = Quat(m.rotation_at(t));
      body.velocity = m.velocity_at(t);
      body.spin = m.spin_at(t);
      bodies.push_back(body);
    }
    return bodies;
  };
  const std::vector<RigidBody> first = states(0);
  for (int i = 0; i < 2; ++i) motion.add_body(scene.bodies[i].shape, first[i]);
  const auto frame = [&](double t) {
    motion.frame(t, states(t));
    motion.value("contacts", "features in contact", "",
                 t < end ? 0 : static_cast<double>(result.features.size()));
  };
  for (int k = 0; k * dt < end; ++k) frame(k * dt);
  frame(end);
  for (const FeaturePair& f : result.features)
    motion.contact(end, 0.5 * (f.point_a + f.point_b), f.normal, 1);
  return motion;
}

// Reports what a scene says of its bodies and no query depends on, so that nothing is ignored in silence.
void tell_the_rest(const Scene& scene, const std::vector<Shape>& shapes, Summary& summary) {
  for (const Shape& shape : shapes) {
    if (shape.mass.mass == 0) continue;
    const Mat3& i = shape.mass.inertia;
    summary.add("shape " + shape.name + ", mass (of no effect on queries)", shape.mass.mass, "kg");
    summary.add("shape " + shape.name + ", inertia (of no effect on queries)",
                fmt::format("[{:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}, {:.6g}]", i(0, 0), i(1, 1), i(2, 2),
                            i(0, 1), i(0, 2), i(1, 2)),
                "kg m^2");
  }
  for (const char* key : {"static", "position", "orientation", "velocity", "spin"}) {
    const bool given =
        scene.mark(fmt::format("bodies.0.{}", key)) || scene.mark(fmt::format("bodies.1.{}", key));
    if (!given) continue;
    if (key == std::string("static"))
      summary.add("static bodies", scene.bodies[0].is_static + std::int64_t{scene.bodies[1].is_static});
    else if (scene.motions)
      summary.add(fmt::format("{} of the bodies", key), "that of the motions file, not the scene's");
  }
}

}  // namespace

void run_queries(const Scene& scene, std::size_t queries, const Ask& ask, const RunContext& context,
                 Summary& summary, const std::function<void(const AdvanceResult&)>& finish) {
  AdvanceOptions options;
  options.interval = scene.interval;
  options.tolerance = scene.ccd.tolerance;
  options.bound = motion_bound_named(scene.ccd.bound);
  options.max_iterations = scene.ccd.max_iterations;
  options.certificate = context.certificate;
  options.warm_start = scene.ccd.warm_start;

  Tables tables(context);
  std::map<Status, std::int64_t> count;
  std::vector<std::int64_t> times;
  std::int64_t iterations = 0, distance_calls = 0, gjk_iterations = 0, node_pairs = 0, total_ns = 0,
               raised = 0;
  Progress progress("queries", static_cast<std::int64_t>(queries), context.quiet);
  for (std::size_t q = 0; q < queries; ++q) {
    const Stopwatch watch;
    const AdvanceResult r = ask(q, options);
    const std::int64_t wall_ns = watch.ns();
    const double toc = r.status == Status::separated ? 1
                       : options.interval > 0        ? r.toc / options.interval
                                                     : 0;
    tables.write(static_cast<std::int64_t>(q), r, toc, wall_ns);
    ++count[r.status];
    times.push_back(wall_ns);
    iterations += r.iterations;
    distance_calls += r.distance_calls;
    gjk_iterations += r.gjk_iterations;
    node_pairs += r.node_pairs;
    total_ns += wall_ns;
    raised += r.tolerance > options.tolerance ? 1 : 0;
    if (queries == 1) {
      summary.add("status", std::string(name_of(r.status)));
      const bool met = r.status != Status::separated && r.status != Status::unresolved;
      summary.add(met ? "time of contact" : "clear until", toc, "of the interval");
      summary.add(met ? "first contact at" : "clear for", toc * options.interval, "s");
      summary.add("gap, certified lower bound", r.gap_lower, "m");
      summary.add("gap, witness points", r.gap_upper, "m");
      summary.add("features", static_cast<std::int64_t>(r.features.size()));
      if (finish) finish(r);
    }
    progress.update(static_cast<std::int64_t>(q) + 1);
  }
  tables.close();

  std::sort(times.begin(), times.end());
  summary.add("queries", static_cast<std::int64_t>(queries));
  for (const Status s : {Status::contact, Status::separated, Status::touching_at_start,
                         Status::penetrating_at_start, Status::unresolved})
    summary.add(std::string("queries: ") + name_of(s), count[s]);
  summary.add("tolerance", options.tolerance, "m");
  summary.add("queries whose tolerance was raised to the rounding term", raised);
  summary.add("advances", iterations);
  summary.add("distance calls", distance_calls);
  if (gjk_iterations > 0) summary.add("GJK iterations", gjk_iterations);
  summary.add("pairs of nodes", node_pairs);
  summary.add_time("median time of a query", times[times.size() / 2]);
  summary.counter("continuous collision queries", static_cast<std::int64_t>(queries), total_ns);
}

void run_queries(const Scene& scene, const std::vector<Shape>& shapes,
                 const std::vector<QueryMotions>& queries, const AskMotions& ask, const RunContext& context,
                 Summary& summary, const std::function<void(MotionRecording&)>& add_hulls) {
  run_queries(
      scene, queries.size(),
      [&](std::size_t q, const AdvanceOptions& options) { return ask(queries[q].a, queries[q].b, options); },
      context, summary,
      [&](const AdvanceResult& result) {
        MotionRecording motion = recorded(scene, shapes, queries[0], result, scene.interval, context.chapter);
        if (add_hulls) add_hulls(motion);
        summary.add_note("motion", motion.write(context.out_dir));
      });
  tell_the_rest(scene, shapes, summary);
}

}  // namespace fc::ca
