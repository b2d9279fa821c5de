// ch06_cones: how well each method solves friction problems from files, what flat sides do to a free slide, and what
// towers need.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "ch03_impulse_lcp/matrix_market.hpp"
#include "ch06_friction/study/facet_study.hpp"
#include "ch06_friction/study/tower_study.hpp"

namespace {

using namespace fc;
using namespace fc::friction;

// The names of all problems in a folder: NAME.A.mtx, NAME.b.mtx, NAME.mu.mtx.
std::vector<std::string> problem_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  const std::string ending = ".A.mtx";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string file = entry.path().filename().string();
    if (file.ends_with(ending)) names.push_back(file.substr(0, file.size() - ending.size()));
  }
  std::sort(names.begin(), names.end());
  return names;
}

void print_method(const std::string& problem, const ConeProblem& p, Method method) {
  const auto start = std::chrono::steady_clock::now();
  const ConeResult result = solve(p, method);
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  const PhysicalErrors errors = physical_errors(p, result.r, result.u);
  fmt::print("{:28} {:4} {:13} {:8} {:9.1e} {:6} {:5} {:6} {:9.2f} {:9.1e} {:9.1e} {:9.1e} {:9.1e}\n",
             problem, p.contacts(), name(method), lcp::name(result.status), result.residual, result.sweeps,
             result.steps, result.pivots, time.count(), errors.approach, errors.cone_excess, errors.creep,
             errors.angle);
}

// Public problems may be slightly asymmetric: the mean of A and its transpose is solved.
void measure_problems(const std::filesystem::path& folder, const std::vector<Method>& methods,
                      int most_contacts) {
  fmt::print("{:28} {:>4} {:13} {:8} {:>9} {:>6} {:>5} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "problem", "n",
             "method", "status", "residual", "sweeps", "steps", "pivots", "[ms]", "approach", "excess",
             "creep", "angle");
  for (const std::string& problem : problem_names(folder)) {
    const std::string base = (folder / problem).string();
    const MatX read = lcp::read_matrix_market(base + ".A.mtx"), A = 0.5 * (read + read.transpose());
    const VecX b = lcp::read_matrix_market(base + ".b.mtx"), mu = lcp::read_matrix_market(base + ".mu.mtx");
    if (mu.size() > most_contacts) continue;
    for (const Method method : methods) print_method(problem, {A, b, mu}, method);
  }
}

void measure_facets(int angles, int steps) {
  fmt::print("{:16} {:>16} {:>10} {:>10} {:>10}\n", "law", "worst angle [°]", "at [°]", "shortest",
             "longest");
  const auto print = [&](const std::string& law, const FrictionLaw& of) {
    const FacetErrors e = facet_errors(of, angles, steps);
    const double degrees = 180 / std::numbers::pi;
    fmt::print("{:16} {:16.3f} {:10.2f} {:10.4f} {:10.4f}\n", law, e.direction * degrees,
               e.direction_at * degrees, e.shortest, e.longest);
  };
  print("cone", {});
  print("boxed", {Method::boxed});
  for (const int sides : {4, 8, 16}) print(fmt::format("pyramid of {}", sides), {Method::pyramid, sides});
}

void measure_towers(const std::filesystem::path& file) {
  std::ofstream out(file);
  out << "boxes,method,steps,looks at each contact,residual,force error\n";
  for (const int boxes : {5, 20, 50})
    for (const TowerRow& row : measure_tower(boxes))
      out << fmt::format("{},{},{},{:.6g},{:.3e},{:.3e}\n", row.boxes, row.method, row.steps, row.looks,
                         row.residual, row.force_error);
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures chapter 6's solvers of frictional contact.");
  std::string folder;
  std::vector<std::string> methods = {"combined", "gauss_seidel", "newton", "pyramid", "boxed"};
  int most_contacts = 60;
  bool facets = false;
  app.add_option("--problems", folder, "Folder of NAME.A.mtx, NAME.b.mtx, NAME.mu.mtx")
      ->check(CLI::ExistingDirectory);
  app.add_option("--methods", methods, "Methods to measure")->delimiter(',')->capture_default_str();
  app.add_option("--most-contacts", most_contacts, "Leave larger problems out")->capture_default_str();
  app.add_flag("--facets", facets, "The free slide on a plane, by boxes and pyramids");
  std::string towers;
  app.add_option("--towers", towers, "Write a table: towers of boxes by sweeps, and by all contacts at once");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<Method> chosen;
    for (const std::string& word : methods) chosen.push_back(method_named(word));
    if (!folder.empty()) measure_problems(folder, chosen, most_contacts);
    if (facets) measure_facets(91, 400);
    if (!towers.empty()) measure_towers(towers);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
  return 0;
}
