// ch02_study: what each idea of the hierarchical search gains, and what continuous detection costs and gives.
#include <CLI/CLI.hpp>

#include "ch02_hull_hierarchy/study/mesh.hpp"
#include "ch02_hull_hierarchy/study/parts.hpp"
#include "common/errors.hpp"
#include "common/study_program.hpp"

int main(int argc, char** argv) {
  using namespace fc;
  hulls::StudyOptions study;
  std::filesystem::path mesh = hulls::kBunny;
  int triangles = 0;  // 0: all
  Shape shape;
  // Runs a part on the mesh; `pieces`: with its pieces, which take long to find.
  const auto on_mesh = [&](auto part, bool pieces) {
    return [&, part, pieces] { part(hulls::study_case(shape, study, pieces), study); };
  };
  StudyProgram program;
  program.purpose =
      "Measures what chapter 2's ideas gain. Two models of one mesh move against each other, `--far` times "
      "from afar and `--close` times from close by, always the same motions. Each part writes a table into "
      "--out; columns that end in _ns are times on this machine, all others are the same in every run:";
  program.example =
      "build/bin/ch02_study --part ideas --triangles 5000 --far 40 --close 20 --out out/ch02/study";
  program.parts = {
      {"ideas", "node pairs of FAST's, C2A's and our search, one idea after the other",
       on_mesh(hulls::study_ideas, true)},
      {"leaves", "pieces against triangles as leaves, and how many points a hull may have",
       on_mesh(hulls::study_leaves, true)},
      {"tightness", "how far volumes reach beyond what they hold", on_mesh(hulls::study_tightness, false)},
      {"tolerance", "error and cost against the tolerance", on_mesh(hulls::study_tolerance, false)},
      {"triangles", "cost against the number of triangles, 500 to all (edges are collapsed)",
       [&] { hulls::study_triangles(shape, study); }},
      {"approach", "cost against the distance by which two bodies miss or meet",
       on_mesh(hulls::study_approach, true)},
      {"discrete", "continuous detection against checks at the ends of 1 to 256 frames",
       on_mesh(hulls::study_discrete, false)},
      {"pictures", "hulls of some levels, and which pairs a query looks at",
       on_mesh(hulls::study_pictures, true)}};
  program.add_options = [&](CLI::App& app) {
    app.add_option("--mesh", mesh, "A closed mesh: OBJ, STL or PLY")
        ->capture_default_str()
        ->type_name("FILE");
    app.add_option("--triangles", triangles, "Collapse edges until this many are left; 0: none")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    app.add_option("--far", study.far, "Motions from afar")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--close", study.close, "Motions from close by")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
  };
  program.prepare = [&] {
    shape = hulls::mesh_shape(mesh);
    if (!shape.solid) throw InputError(mesh.string() + ": not closed: " + shape.report.text());
    if (triangles > 0) shape = hulls::coarser(shape, static_cast<std::size_t>(triangles));
  };
  return run_study(argc, argv, program, study.out, study.quiet);
}
