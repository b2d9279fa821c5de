// ch02_study: what each idea of the hierarchical search gains, and what continuous detection costs and gives.
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "ch02_hull_hierarchy/study_mesh.hpp"
#include "ch02_hull_hierarchy/study_parts.hpp"
#include "common/errors.hpp"
#include "common/text.hpp"

namespace {

using namespace fc;

enum ExitCode { done = 0, bad_input = 2, failed = 3 };

const std::vector<std::string> kParts = {"ideas",     "leaves",   "tightness", "tolerance",
                                         "triangles", "approach", "discrete",  "pictures"};

struct Arguments {
  std::string part;
  std::filesystem::path mesh = hulls::kBunny;
  int triangles = 0;  // 0: all
  hulls::StudyOptions study;
  std::string help;  // not empty: asked for
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  hulls::StudyOptions& study = arguments.study;
  CLI::App app(
      "Measures what chapter 2's ideas gain. Two models of one mesh move against each other, `--far` times "
      "from "
      "afar and `--close` times from close by, always the same motions. Each part writes a table into --out; "
      "columns that end in _ns are times of this machine, all others are the same in every run:\n\n"
      "  ideas      node pairs of FAST's, C2A's and our search, one idea after the other\n"
      "  leaves     pieces against triangles as leaves, and how many points a hull may have\n"
      "  tightness  how far volumes reach beyond what they hold\n"
      "  tolerance  error and cost against the tolerance\n"
      "  triangles  cost against the number of triangles, 500 to all (edges are collapsed)\n"
      "  approach   cost against the distance by which two bodies miss or meet\n"
      "  discrete   continuous detection against checks at the ends of 1 to 256 frames\n"
      "  pictures   hulls of some levels, and which pairs a query looks at");
  app.footer(
      "Example:\n  build/bin/ch02_study --part ideas --triangles 5000 --far 40 --close 20 --out "
      "out/ch02/study");
  app.add_option("--part", arguments.part, "What to measure")->required()->check(CLI::IsMember(kParts));
  app.add_option("--out", study.out, "The folder for the tables")->required()->type_name("DIR");
  app.add_option("--mesh", arguments.mesh, "A closed mesh: OBJ, STL or PLY")
      ->capture_default_str()
      ->type_name("FILE");
  app.add_option("--triangles", arguments.triangles, "Collapse edges until so many are left; 0: none")
      ->capture_default_str()
      ->check(CLI::NonNegativeNumber);
  app.add_option("--far", study.far, "Motions from afar")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--close", study.close, "Motions from close by")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_flag("--quiet", study.quiet, "No progress");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    arguments.help = app.help();
  } catch (const CLI::ParseError& error) {
    throw InputError(one_line(error.what()) + "; see --help");
  }
  return arguments;
}

void run(const Arguments& arguments) {
  const hulls::StudyOptions& study = arguments.study;
  std::error_code error;
  std::filesystem::create_directories(study.out, error);
  if (error) throw InputError(study.out.string() + ": cannot be made: " + error.message());
  Shape shape = hulls::mesh_shape(arguments.mesh);
  if (!shape.solid) throw InputError(arguments.mesh.string() + ": not closed: " + shape.report.text());
  if (arguments.triangles > 0) shape = hulls::coarser(shape, static_cast<std::size_t>(arguments.triangles));
  const std::string& part = arguments.part;
  if (part == "triangles") return hulls::study_triangles(shape, study);
  const bool pieces = part != "discrete" && part != "tightness" && part != "tolerance";
  const hulls::StudyCase c = hulls::study_case(shape, study, pieces);
  if (part == "ideas") hulls::study_ideas(c, study);
  if (part == "leaves") hulls::study_leaves(c, study);
  if (part == "tightness") hulls::study_tightness(c, study);
  if (part == "tolerance") hulls::study_tolerance(c, study);
  if (part == "approach") hulls::study_approach(c, study);
  if (part == "discrete") hulls::study_discrete(c, study);
  if (part == "pictures") hulls::study_pictures(c, study);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments arguments = parse(argc, argv);
    if (!arguments.help.empty())
      fmt::print("{}\n", arguments.help);
    else
      run(arguments);
    return done;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", one_line(error.what()));
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", one_line(error.what()));
    return failed;
  }
}
