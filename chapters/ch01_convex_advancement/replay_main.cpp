// ch01_replay: checks the certificates that chapter 1's executable wrote.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <functional>

#include "ch01_convex_advancement/query_run.hpp"
#include "ch01_convex_advancement/replay.hpp"
#include "common/table_reader.hpp"
#include "common/text.hpp"

namespace {

using namespace fc;

enum ExitCode { proved = 0, bad_input = 2, refused = 3 };

struct Arguments {
  SceneSource source;
  std::filesystem::path run;
  bool quiet = false;
  std::string help;  // not empty: asked for
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Checks the certificate of a run of chapter 1: that every row of certificate.csv is true, and that the "
      "rows together prove what queries.csv says. It uses neither GJK nor the motion bounds, and computes in "
      "long double. Each row that is refused is a line on standard error. Exit code 0: all is proved; 3: "
      "something is not; 2: bad input. (Chapter 2's certificates do not name the parts of a body that their "
      "rows are about: they cannot be replayed.)");
  app.footer(
      "Example:\n"
      "  build/bin/ch01_convex_advancement chapters/ch01_convex_advancement/scenes/spinning_box.yaml "
      "--certificate\n"
      "  build/bin/ch01_replay chapters/ch01_convex_advancement/scenes/spinning_box.yaml out/spinning_box");
  app.add_option("SCENE", arguments.source.file, "The scene of the run")->required()->type_name("FILE");
  app.add_option("RUN_DIR", arguments.run, "The folder that the run wrote")->required()->type_name("DIR");
  app.add_option("--set", arguments.source.overrides, "As it was given to the run (repeatable)")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("KEY.PATH=VALUE");
  app.add_flag("--quiet", arguments.quiet, "Print nothing but what is refused");
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    arguments.help = app.help();
  } catch (const CLI::ParseError& error) {
    throw InputError(one_line(error.what()) + "; see --help");
  }
  arguments.source.chapter = 1;
  return arguments;
}

// The rows of a table that speak of one query, in their order.
struct Certificate {
  std::vector<ca::CertificateRow> rows;
  std::vector<int> lines;  // of the file
};

// What stands in a run's folder, and what is wrong with its numbering (rows that are out of order), line by
// line.
struct RunFiles {
  ReadTable queries, certificate;
  std::vector<ca::ReplayAnswer> answers;
  std::vector<Certificate> certificates;  // one for each answer
  std::vector<std::pair<int, std::string>> wrong;
};

ca::Status status_of(const ReadTable& table, const ReadTable::Row& row) {
  for (const ca::Status s : {ca::Status::contact, ca::Status::separated, ca::Status::touching_at_start,
                             ca::Status::penetrating_at_start, ca::Status::unresolved})
    if (row.cells[1] == ca::name_of(s)) return s;
  throw InputError(
      table.mark(row, 1),
      "\"" + row.cells[1] +
          "\" is no status; write contact, separated, touching_at_start, penetrating_at_start or "
          "unresolved");
}

RunFiles read_run(const std::filesystem::path& folder, std::size_t asked) {
  RunFiles run;
  run.queries = read_table(folder / "queries.csv",
                           "query,status,toc [1],gap_lower [m],gap_upper [m],iterations,distance_calls,"
                           "node_pairs,features,wall_ns");
  if (!std::filesystem::exists(folder / "certificate.csv"))
    throw InputError(SourceMark{(folder / "certificate.csv").string()},
                     "cannot be read: no such file; run the chapter with --certificate");
  run.certificate = read_table(folder / "certificate.csv",
                               "query,k,t [s],nx,ny,nz,gap_lower [m],speed_bound [m/s],advance [s]");
  for (const ReadTable::Row& row : run.queries.rows) {
    if (run.queries.number(row, 0) != static_cast<double>(run.answers.size()))
      throw InputError(run.queries.mark(row, 0), "query " + row.cells[0] + " stands where query " +
                                                     std::to_string(run.answers.size()) + " should");
    run.answers.push_back({status_of(run.queries, row), run.queries.number(row, 2),
                           run.queries.number(row, 3), run.queries.number(row, 4)});
  }
  if (run.answers.size() != asked)
    throw InputError(SourceMark{run.queries.file},
                     std::to_string(run.answers.size()) + " answers, but the scene asks " +
                         std::to_string(asked) + " queries; is it another run?");
  run.certificates.resize(run.answers.size());
  double last = 0, next = 0;  // the query, and its row, that should come
  for (const ReadTable::Row& row : run.certificate.rows) {
    std::array<double, 9> x{};
    for (int c = 0; c < 9; ++c) x[c] = run.certificate.number(row, c);
    const double query = x[0];
    if (!(query >= 0 && query < static_cast<double>(asked) && query == std::floor(query)))
      throw InputError(run.certificate.mark(row, 0), "there is no query " + row.cells[0]);
    Certificate& certificate = run.certificates[static_cast<std::size_t>(query)];
    if (query > last) next = 0;
    if (query < last || x[1] != next)
      run.wrong.emplace_back(row.line, "row " + row.cells[1] + " of query " + row.cells[0] +
                                           " is out of order, or one before it is missing");
    last = query;
    next = x[1] + 1;  // so that what is missing is said once
    certificate.rows.push_back({x[2], {x[3], x[4], x[5]}, x[6], x[7], x[8]});
    certificate.lines.push_back(row.line);
  }
  return run;
}

// The scene's queries, whatever they are about, and how to replay one.
struct Questions {
  std::size_t count;
  std::function<std::vector<ca::Refusal>(std::size_t query, const ca::ReplayAnswer&,
                                         const std::vector<ca::CertificateRow>&)>
      replay;
};

Questions questions_of(const Scene& scene) {
  const double interval = scene.interval;
  if (scene.linear) {
    auto queries = ca::linear_queries(scene);
    const std::size_t count = queries.size();
    return {count, [=, queries = std::move(queries)](std::size_t q, const auto& answer, const auto& rows) {
              return ca::replay(queries[q], interval, answer, rows);
            }};
  }
  const std::vector<Shape> shapes = build_shapes(scene, false);
  auto queries = ca::query_motions(scene, shapes);
  const std::size_t count = queries.size();
  return {count, [=, a = ca::replay_shape(shapes[scene.bodies[0].shape]),
                  b = ca::replay_shape(shapes[scene.bodies[1].shape]),
                  queries = std::move(queries)](std::size_t q, const auto& answer, const auto& rows) {
            return ca::replay({a, b, queries[q].a, queries[q].b, interval}, answer, rows);
          }};
}

int check(const Arguments& arguments) {
  const Scene scene = read_scene(arguments.source);
  const Questions questions = questions_of(scene);
  RunFiles run = read_run(arguments.run, questions.count);
  std::vector<std::string> lines;
  for (const auto& [line, what] : run.wrong)
    lines.push_back(fmt::format("{}:{}: {}", run.certificate.file, line, what));
  Progress progress("queries", static_cast<std::int64_t>(questions.count), arguments.quiet);
  for (std::size_t q = 0; q < questions.count; ++q) {
    for (const ca::Refusal& refusal : questions.replay(q, run.answers[q], run.certificates[q].rows)) {
      const bool of_answer = refusal.row < 0;
      lines.push_back(fmt::format(
          "{}:{}: query {}: {}", of_answer ? run.queries.file : run.certificate.file,
          of_answer ? run.queries.rows[q].line : run.certificates[q].lines[refusal.row], q, refusal.what));
    }
    progress.update(static_cast<std::int64_t>(q) + 1);
  }
  for (const std::string& line : lines) fmt::print(stderr, "{}\n", one_line(line));
  if (!arguments.quiet)
    fmt::print("{}: {} queries, {} certificate rows, {} refused\n", arguments.run.string(), questions.count,
               run.certificate.rows.size(), lines.size());
  return lines.empty() ? proved : refused;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments arguments = parse(argc, argv);
    if (!arguments.help.empty()) {
      fmt::print("{}\n", arguments.help);
      return proved;
    }
    return check(arguments);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", one_line(error.what()));
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", one_line(error.what()));
    return refused;
  }
}
