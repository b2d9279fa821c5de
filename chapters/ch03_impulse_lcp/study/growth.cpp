// How pivots, sweeps, steps and time grow with the number of rows.
#include <cmath>

#include "ch03_impulse_lcp/study/parts.hpp"
#include "common/program.hpp"
#include "common/table.hpp"

namespace fc::lcp {
namespace {

struct Curve {
  Method method;
  double target;  // tolerance; 0: the method's own
  int rows;       // of the largest problem: beyond it a solve takes seconds
};

constexpr std::array kCurves = {Curve{Method::dantzig, 0, 1024}, Curve{Method::lemke, 0, 512},
                                Curve{Method::pgs, 1e-6, 256}, Curve{Method::pgs, 1e-10, 256},
                                Curve{Method::interior_point, 0, 512}};

constexpr int kSweeps = 10'000;

// Sums of a straight line through (log n, log y).
class Power {
 public:
  void add(double n, double y) {
    if (y <= 0) return;
    const double u = std::log(n), v = std::log(y);
    ++count_, u_ += u, v_ += v, uu_ += u * u, uv_ += u * v;
  }
  bool known() const { return count_ >= 3; }
  double exponent() const { return (count_ * uv_ - u_ * v_) / (count_ * uu_ - u_ * u_); }

 private:
  double count_ = 0, u_ = 0, v_ = 0, uu_ = 0, uv_ = 0;
};

double thousandths(double x) {
  return std::round(1000 * x) / 1000;
}

}  // namespace

void study_growth(const StudyOptions& options) {
  TableWriter growth(options.out / "growth.csv", {{"family", ""},
                                                  {"rows", ""},
                                                  {"method", ""},
                                                  {"target", ""},
                                                  {"problems", ""},
                                                  {"solved", ""},
                                                  {"work", ""},
                                                  {"residual", ""},
                                                  {"median_ns", ""}});
  TableWriter exponents(options.out / "exponents.csv", {{"family", ""},
                                                        {"method", ""},
                                                        {"target", ""},
                                                        {"from_rows", ""},
                                                        {"work_exponent", ""},
                                                        {"time_exponent_ns", ""}});
  constexpr std::array kGrown = {Family::random_spd, Family::box_heap};
  constexpr int kFrom = 32;  // below, constant costs weigh too much to fit a power
  Progress progress("growth", static_cast<std::int64_t>(kGrown.size() * kCurves.size()), options.quiet);
  std::int64_t done = 0;
  for (const Family family : kGrown)
    for (const Curve& curve : kCurves) {
      Power work, time;
      for (int n = 8; n <= std::min(options.rows, curve.rows); n *= 2) {
        Tally tally;
        const int count = n > 256 ? 1 : n > 64 ? std::min(3, options.seeds) : options.seeds;
        for (int seed = 1; seed <= count; ++seed) {
          const KnownProblem p = make_problem(family, n, static_cast<std::uint64_t>(seed));
          tally.add(p, timed_solve(
                           p.lcp(), curve.method,
                           {.limit = curve.method == Method::pgs ? kSweeps : 0, .tolerance = curve.target}));
        }
        if (tally.work.empty()) continue;
        const double pivots = median(tally.work), ns = median(tally.ns);
        growth.row({std::string(name(family)), std::int64_t{n}, std::string(name(curve.method)), curve.target,
                    std::int64_t{count}, std::int64_t{tally.solved}, pivots, median(tally.residual), ns});
        // Without an answer, there is no cost to count.
        if (n < kFrom || median(tally.residual) > std::max(curve.target, 1e-10)) continue;
        work.add(n, pivots);
        time.add(n, ns);
      }
      if (work.known() && time.known())
        exponents.row({std::string(name(family)), std::string(name(curve.method)), curve.target,
                       std::int64_t{kFrom}, thousandths(work.exponent()), thousandths(time.exponent())});
      progress.update(++done);
    }
  growth.close();
  exponents.close();
}

}  // namespace fc::lcp
