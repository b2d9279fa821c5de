#include "ch01_convex_advancement/replay_run.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>

#include "common/program.hpp"
#include "common/table_reader.hpp"
#include "common/text.hpp"

namespace fc::ca {
namespace {

enum ExitCode { proved = 0, bad_input = 2, refused = 3 };

struct Arguments {
  SceneSource source;
  std::filesystem::path run;
  bool quiet = false, clear = false, mine = false;
  std::string help;  // not empty: asked for
};

Arguments parse(int argc, char** argv, const ReplayProgram& program) {
  Arguments arguments;
  CLI::App app(program.purpose);
  app.footer(program.example);
  app.add_option("SCENE", arguments.source.file, "The scene of the run")->required()->type_name("FILE");
  app.add_option("RUN_DIR", arguments.run, "The folder that the run wrote")->required()->type_name("DIR");
  app.add_option("--set", arguments.source.overrides, "As given to the run (repeatable)")
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("KEY.PATH=VALUE");
  app.add_flag("--quiet", arguments.quiet, "Print nothing but what is refused");
  if (program.clear_questions) {
    CLI::Option* clear = app.add_flag("--clear", arguments.clear, "Check with the text's clear version");
    app.add_flag("--mine", arguments.mine, "Like --clear, but with your own checker if it passes ./run check")
        ->excludes(clear);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    arguments.help = app.help();
  } catch (const CLI::ParseError& error) {
    throw InputError(one_line(error.what()) + "; see --help");
  }
  arguments.source.chapter = program.chapter;
  return arguments;
}

// The certificate rows of one query, in their order.
struct Certificate {
  std::vector<CertificateRow> rows;
  std::vector<int> lines;  // of the file
};

// The tables in a run's folder, and what is wrong with their numbering (rows out of order), line by line.
struct RunFiles {
  ReadTable queries, certificate;
  std::vector<ReplayAnswer> answers;
  std::vector<Certificate> certificates;  // one for each answer
  std::vector<std::pair<int, std::string>> wrong;
};

Status status_of(const ReadTable& table, const ReadTable::Row& row) {
  for (const Status s : {Status::contact, Status::separated, Status::touching_at_start,
                         Status::penetrating_at_start, Status::unresolved})
    if (row.cells[1] == name_of(s)) return s;
  throw InputError(
      table.mark(row, 1),
      "\"" + row.cells[1] +
          "\" is not a status; write contact, separated, touching_at_start, penetrating_at_start or "
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
    next = x[1] + 1;  // so that a missing row is reported once
    certificate.rows.push_back({x[2], {x[3], x[4], x[5]}, x[6], x[7], x[8]});
    certificate.lines.push_back(row.line);
  }
  return run;
}

int check(const Arguments& arguments, const ReplayProgram& program) {
  const Scene scene = read_scene(arguments.source);
  std::string whose;
  if (arguments.mine) {
    take_mine(program.pieces, mine_folder(),
              [](const std::string& line) { fmt::print(stderr, "{}\n", line); });
    whose = ", by your checker";
  } else if (arguments.clear) {
    whose = ", by the clear checker";
  }
  const ReplayQuestions questions =
      (whose.empty() ? program.questions : program.clear_questions)(scene, arguments.run);
  RunFiles run = read_run(arguments.run, questions.count);
  std::vector<std::string> lines;
  for (const auto& [line, what] : run.wrong)
    lines.push_back(fmt::format("{}:{}: {}", run.certificate.file, line, what));
  Progress progress("queries", static_cast<std::int64_t>(questions.count), arguments.quiet);
  for (std::size_t q = 0; q < questions.count; ++q) {
    for (const Refusal& refusal : questions.replay(q, run.answers[q], run.certificates[q].rows)) {
      const bool of_answer = refusal.row < 0;
      lines.push_back(fmt::format(
          "{}:{}: query {}: {}", of_answer ? run.queries.file : run.certificate.file,
          of_answer ? run.queries.rows[q].line : run.certificates[q].lines[refusal.row], q, refusal.what));
    }
    progress.update(static_cast<std::int64_t>(q) + 1);
  }
  for (const std::string& line : lines) fmt::print(stderr, "{}\n", one_line(line));
  if (!arguments.quiet)
    fmt::print("{}: {} queries, {} certificate rows, {} refused{}\n", arguments.run.string(), questions.count,
               run.certificate.rows.size(), lines.size(), whose);
  return lines.empty() ? proved : refused;
}

}  // namespace

int run_replay(int argc, char** argv, const ReplayProgram& program) {
  try {
    const Arguments arguments = parse(argc, argv, program);
    if (!arguments.help.empty()) {
      fmt::print("{}\n", arguments.help);
      return proved;
    }
    return check(arguments, program);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", one_line(error.what()));
    return bad_input;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", one_line(error.what()));
    return refused;
  }
}

}  // namespace fc::ca
