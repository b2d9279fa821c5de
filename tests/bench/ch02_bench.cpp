// Chapter 2 beside FCL: first contact and distance of two moving bunnies of 69,666 triangles, and of coarser
// ones. See --help of Google Benchmark; every row has median_ns and p95_ns over its queries, and what the
// method got wrong. Each query is timed with the caches as the query before left them.
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>

#include "tests/bench/bench.hpp"
#include "tests/bench/ch02_cases.hpp"
#include "tests/bench/ch02_fcl.hpp"

namespace {

using namespace fc;
using namespace fc::bench;

constexpr Effort kFast{5, 1, 1}, kSlow{3, 1, 1}, kSlowest{1, 1, 1};
constexpr double kTolerance = 1e-6;        // of the bunny's size
constexpr double kTruthTolerance = 1e-11;  // of the bunny's size
constexpr double kLate = 1e-9;             // s
constexpr double kPosesAgree = 1e-9;       // m, and for the entries of a rotation

// What `make` returns, made when it is first asked for.
template <class Make>
auto lazily(const Make& make) {
  using Made = decltype(make());
  return [make, kept = std::make_shared<std::optional<Made>>()]() -> const Made& {
    if (!*kept) *kept = make();
    return **kept;
  };
}

struct Bunny {
  hulls::Model model;
  double size = 0;  // m
  std::shared_ptr<const FclMesh> fcl;
  explicit Bunny(const Shape& shape)
      : model(hulls::build_model(shape)), size(size_of(shape)), fcl(fcl_mesh(shape.core)) {}
};

// The truth of one query: a hit if our search or FCL's advancement says so at a hundred-thousandth of the tolerance,
// and the earlier of their times. They share no code, and neither is ever late if it is right, so the truth does not
// repeat a mistake that only one of them makes.
struct Truth {
  bool hit = false;
  double toc = 1;
};

struct Case {
  const Bunny* bunny = nullptr;
  std::vector<BunnyPair> pairs;
  std::vector<FclEnds> ends;
  std::vector<Truth> truth;
  int count() const { return static_cast<int>(pairs.size()); }
};

// FCL's answer: whether they touch, and when. `complete`: also all features in contact, or the distance at the end.
const ca::AdvanceResult& ours(const Bunny& bunny, const BunnyPair& pair, double tolerance, bool complete) {
  static hulls::SearchMemory memory;
  static ca::AdvanceResult result;
  ca::AdvanceOptions options;
  options.tolerance = tolerance * bunny.size;
  options.features = options.end_distance = complete;
  hulls::advance(bunny.model, pair.a, bunny.model, pair.b, options, memory, result);
  return result;
}

// Both engines move the bodies in the same way.
void check_poses(const BunnyPair& pair, const FclEnds& ends) {
  for (const double t : {0.0, 0.1, 0.35, 0.5, 0.8, 1.0}) {
    const auto error = [t](const ca::Motion& motion, const Pose& from, const Pose& to) {
      const Pose pose = motion.pose_at(t), fcl = fcl_pose(from, to, t);
      return std::max((pose.rotation - fcl.rotation).cwiseAbs().maxCoeff(),
                      (pose.position - fcl.position).cwiseAbs().maxCoeff());
    };
    if (!(error(pair.a, ends.from_a, ends.to_a) <= kPosesAgree &&
          error(pair.b, ends.from_b, ends.to_b) <= kPosesAgree))
      throw std::runtime_error("FCL's poses and ours differ at t = " + std::to_string(t));
  }
}

Case make_case(const Bunny& bunny, const std::vector<BunnyPair>& pairs) {
  Case made{&bunny, pairs, {}, {}};
  for (const BunnyPair& pair : pairs) {
    made.ends.push_back({pair.a.pose_at(0), pair.a.pose_at(1), pair.b.pose_at(0), pair.b.pose_at(1)});
    check_poses(pair, made.ends.back());
    const ca::AdvanceResult our = ours(bunny, pair, kTruthTolerance, false);
    const FclAnswer fcl = fcl_advance(*bunny.fcl, made.ends.back(), kTruthTolerance * bunny.size);
    const bool our_hit = our.status == ca::Status::contact;
    made.truth.push_back({our_hit || fcl.hit, std::min(our_hit ? our.toc : 1, fcl.hit ? fcl.toc : 1)});
  }
  return made;
}

// first contact
// -----------------------------------------------------------------------------------------------

struct Answer {
  bool hit = false;
  double toc = 1;  // s
  bool failed = false;
  double volumes = 0, leaves = 0;  // pairs that were tested
};

Answer ask_ours(const Case& c, int i, double tolerance, bool complete) {
  const ca::AdvanceResult& r = ours(*c.bunny, c.pairs[i], tolerance, complete);
  return {r.status == ca::Status::contact, r.toc,
          r.status != ca::Status::contact && r.status != ca::Status::separated,
          static_cast<double>(r.node_pairs), static_cast<double>(r.distance_calls)};
}
Answer ask_fcl(const Case& c, int i, double tolerance, bool statistics = false) {
  const FclAnswer r = fcl_advance(*c.bunny->fcl, c.ends[i], tolerance * c.bunny->size, statistics);
  return {r.hit, r.toc, r.failed, static_cast<double>(r.volume_tests), static_cast<double>(r.triangle_tests)};
}

// A hit is wrong, too, where FCL's distance at its time is above the tolerance.
template <class Ask>
Verdict judge(const Case& c, const Ask& ask, double tolerance, const std::string& volumes,
              const std::string& leaves) {
  Verdict verdict;
  verdict.more["triangles"] = static_cast<double>(c.bunny->model.mesh.triangles.size());  // of each bunny
  double& hits = verdict.more["hits"];
  for (int i = 0; i < c.count(); ++i) {
    const Answer answer = ask(i);
    const Truth& truth = c.truth[i];
    verdict.misses += truth.hit && !answer.hit;
    verdict.late += truth.hit && answer.hit && answer.toc > truth.toc + kLate;
    const auto wrong = [&] {
      const Pose a = c.pairs[i].a.pose_at(answer.toc), b = c.pairs[i].b.pose_at(answer.toc);
      return fcl_distance(*c.bunny->fcl, a, b) > tolerance * c.bunny->size * (1 + 1e-6);
    };
    verdict.failed += answer.failed || (answer.hit && wrong());
    hits += answer.hit;
    if (volumes.empty()) continue;
    verdict.more[volumes] += answer.volumes / c.count();
    verdict.more[leaves] += answer.leaves / c.count();
  }
  return verdict;
}

template <class GetCase>
void add_ours(const std::string& name, const GetCase& get, double tolerance = kTolerance) {
  for (const bool complete : {false, true})
    add_row_when_run(name + (complete ? "/ours_complete" : "/ours"), kFast, [=] {
      const Case& c = get();
      const auto ask = [&c, tolerance, complete](int i) { return ask_ours(c, i, tolerance, complete); };
      return Row{c.count(), [=](int i) { return ask(i).toc; },
                 [=, &c] { return judge(c, ask, tolerance, "node_pairs", "leaf_pairs"); }};
    });
}

template <class GetCase>
void add_fcl(const std::string& name, const std::string& who, const GetCase& get,
             double tolerance = kTolerance) {
  add_row_when_run(name + "/" + who, kSlow, [=] {
    const Case& c = get();
    const auto ask = [&c, tolerance](int i) { return ask_fcl(c, i, tolerance, true); };
    return Row{c.count(), [=, &c](int i) { return ask_fcl(c, i, tolerance).toc; },
               [=, &c] { return judge(c, ask, tolerance, "num_bv_tests", "num_leaf_tests"); }};
  });
}

template <class GetCase>
void add_public(const std::string& name, const GetCase& get) {
  add_row_when_run(name + "/fcl_public", kSlowest, [=] {
    const Case& c = get();
    const auto ask = [&c](int i) {
      const FclAnswer r = fcl_public(*c.bunny->fcl, c.ends[i], kTolerance);
      return Answer{r.hit, r.toc};
    };
    return Row{c.count(), [=](int i) { return ask(i).toc; },
               [=, &c] { return judge(c, ask, kTolerance, "", ""); }};
  });
}

// distance
// ----------------------------------------------------------------------------------------------------

// An answer is wrong if it is off by more than the tolerance from ours at a hundred-thousandth of it.
template <class Ask>
void add_distance(const std::string& name, const std::function<const Case&()>& get, const Ask& ask) {
  add_row_when_run(name, kFast, [=] {
    const Case& c = get();
    return Row{c.count(), [=, &c](int i) { return ask(c, i, kTolerance); },
               [=, &c] {
                 Verdict verdict;
                 for (int i = 0; i < c.count(); ++i) {
                   const ca::PairPose pose(c.pairs[i].a, c.pairs[i].b, 0);
                   const double truth = hulls::model_distance(c.bunny->model, c.bunny->model, pose,
                                                              kTruthTolerance * c.bunny->size)
                                            .upper;
                   verdict.failed += !(std::abs(ask(c, i, kTolerance) - truth) <= kTolerance * c.bunny->size);
                 }
                 return verdict;
               }};
  });
}

// cases
// -------------------------------------------------------------------------------------------------------

using Generate = BunnyPair (BunnyPairs::*)();

std::vector<BunnyPair> pairs(const Bunny& bunny, int count, Generate generate, std::uint64_t seed) {
  BunnyPairs source(bunny.model, bunny.size, seed);
  std::vector<BunnyPair> all;
  for (int i = 0; i < count; ++i) all.push_back((source.*generate)());
  return all;
}

// Those of the queries, at most `count`, that hit, or that do not.
Case part(const Case& whole, bool hit, int count) {
  Case some{whole.bunny, {}, {}, {}};
  for (int i = 0; i < whole.count() && some.count() < count; ++i) {
    if (whole.truth[i].hit != hit) continue;
    some.pairs.push_back(whole.pairs[i]);
    some.ends.push_back(whole.ends[i]);
    some.truth.push_back(whole.truth[i]);
  }
  return some;
}

void add_cases() {
  const auto shape = lazily([] { return bunny_shape(); });
  const auto bunny = lazily([=] { return Bunny(shape()); });
  const auto random = [=](int count, Generate generate, std::uint64_t seed) {
    return lazily([=] { return make_case(bunny(), pairs(bunny(), count, generate, seed)); });
  };
  const auto far = random(200, &BunnyPairs::far, 1);
  const auto close = random(100, &BunnyPairs::close, 2);
  const auto spin = random(50, &BunnyPairs::spinning, 3);
  const auto clear = lazily([=] { return part(far(), false, far().count()); });
  const auto hits = lazily([=] { return part(far(), true, 5); });

  add_ours("bunny_far", far);
  add_fcl("bunny_far", "fcl_rss_1e-6", far);
  add_ours("bunny_close", close);
  add_fcl("bunny_close", "fcl_rss_1e-6", close);
  add_ours("bunny_clear", clear);
  add_fcl("bunny_clear", "fcl_rss_1e-6", clear);
  add_ours("bunny_spin", spin);
  add_fcl("bunny_spin", "fcl_rss_1e-6", spin);

  // Coarser tolerances: how far each engine's time depends on it.
  for (const auto& [text, tolerance] : {std::pair("1e-3", 1e-3), std::pair("1e-4", 1e-4)}) {
    const std::string suffix = std::string("_") + text;
    add_ours("bunny_far" + suffix, far, tolerance);
    add_fcl("bunny_far" + suffix, "fcl_rss" + suffix, far, tolerance);
  }

  add_distance("bunny_distance/ours", far, [](const Case& c, int i, double tolerance) {
    return hulls::model_distance(c.bunny->model, c.bunny->model, ca::PairPose(c.pairs[i].a, c.pairs[i].b, 0),
                                 tolerance * c.bunny->size)
        .upper;
  });
  add_distance("bunny_distance/fcl", far, [](const Case& c, int i, double) {
    return fcl_distance(*c.bunny->fcl, c.ends[i].from_a, c.ends[i].from_b);
  });

  // The motions of bunny_far for coarser bunnies.
  for (const int triangles : {1000, 4000, 10000}) {
    const auto coarse = lazily([=] { return Bunny(coarser(shape(), static_cast<std::size_t>(triangles))); });
    const auto queries =
        lazily([=] { return make_case(coarse(), pairs(coarse(), 200, &BunnyPairs::far, 1)); });
    const std::string name = "bunny_" + std::to_string(triangles);
    add_ours(name, queries);
    add_fcl(name, "fcl_rss_1e-6", queries);
  }

  add_ours("bunny_public", hits);
  add_public("bunny_public", hits);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    add_cases();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_ch02: %s\n", error.what());
    return 1;
  }
}
