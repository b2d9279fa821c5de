#include "common/program.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "common/options.hpp"
#include "common/report.hpp"
#include "common/scene_keys.hpp"
#include "common/sweep.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

enum ExitCode { done = 0, bad_input = 2, failed = 3 };

void print_error(const std::string& message) {
  fmt::print(stderr, "{}\n", one_line(message));
  std::fflush(stderr);
}

// Creates the folder, with its parents. A folder that cannot be written is bad input.
void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(folder, ignored);
  if (is_folder && access(folder.c_str(), W_OK) == 0) return;
  const std::string why = error ? error.message() : is_folder ? "cannot be written" : "not a folder";
  throw InputError("--out " + folder.string() + ": " + why + "; choose another folder");
}

// Runs one scene into a folder that exists. Failures are printed, and the summary is written in any case.
int run_scene(const Chapter& chapter, const Scene& scene, const RunContext& context, Summary& summary) {
  int exit_code = failed;
  std::string failure;
  try {
    exit_code = chapter.run(scene, context, summary);
  } catch (const InputError&) {
    throw;                                 // the run found the input bad: there is nothing to sum up
  } catch (const std::exception& error) {  // a NumericalFailure, or anything that no one foresaw
    failure = one_line(error.what());
    print_error(failure);
  }
  write_summary(context.out_dir / "summary.json", chapter, scene, summary, exit_code, failure);
  return exit_code;
}

void print_summary(const Scene& scene, const RunContext& context, const Summary& summary) {
  if (context.quiet) return;
  fmt::print("{}: results in {}\n{}", one_line(scene.name), context.out_dir.string(), summary_text(summary));
}

int run_once(const Chapter& chapter, const Scene& scene, const RunContext& context) {
  create_folder(context.out_dir);
  Summary summary;
  const int exit_code = run_scene(chapter, scene, context, summary);
  print_summary(scene, context, summary);
  return exit_code;
}

// Runs a scene once per value, each in a folder of its own; ends with the worst exit code. All values are
// checked before the first one runs.
int run_sweep(const Chapter& chapter, const SceneSource& source, const Sweep& sweep,
              const RunContext& context) {
  std::vector<Scene> scenes;
  for (const std::string& value : sweep.values) {
    SceneSource swept = source;
    swept.swept = sweep.key + "=" + value;
    scenes.push_back(read_scene(swept));
  }
  const std::vector<std::string> folders = sweep_folders(sweep);
  std::vector<SweepRun> runs;
  int exit_code = done;
  create_folder(context.out_dir);
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    RunContext run_context = context;
    run_context.out_dir = context.out_dir / folders[i];
    create_folder(run_context.out_dir);
    SweepRun run{sweep.values[i], {}, 0};
    run.exit_code = run_scene(chapter, scenes[i], run_context, run.summary);
    exit_code = std::max(exit_code, run.exit_code);
    if (!context.quiet) fmt::print("{}={}\n{}", sweep.key, run.value, summary_text(run.summary));
    runs.push_back(std::move(run));
    write_sweep(context.out_dir / "sweep.csv", sweep, runs);  // after each run: a later failure loses nothing
  }
  if (!context.quiet) fmt::print("one row per value in {}\n", (context.out_dir / "sweep.csv").string());
  return exit_code;
}

int run_with(const Options& options, const Chapter& chapter) {
  const SceneSource source{options.scene, options.sets, options.mesh_path, chapter.number};
  // Under a sweep the scene is only complete, and only checked, with the swept value in it.
  Sweep sweep;
  SceneSource first = source;
  if (!options.sweep.empty()) {
    sweep = parse_sweep(options.sweep);
    first.swept = sweep.key + "=" + sweep.values[0];
  }
  const Scene scene = read_scene(first);
  if (options.explain) {
    if (!options.quiet)
      fmt::print("{}: effects\n{}", one_line(scene.name), effects_text(chapter.explain(scene)));
    return done;
  }
  const std::filesystem::path default_dir = std::filesystem::path("out") / file_name_from(scene.name);
  const RunContext context{chapter.name, options.out.value_or(default_dir), options.certificate,
                           options.poses, options.quiet};
  return sweep.values.empty() ? run_once(chapter, scene, context)
                              : run_sweep(chapter, source, sweep, context);
}

}  // namespace

int run_program(int argc, char** argv, const Chapter& chapter) {
  try {
    const Options options = parse_options(argc, argv, chapter.purpose, chapter.example);
    if (!options.help.empty()) {
      fmt::print("{}\n{}", options.help, scene_keys_help(chapter.number));
      return done;
    }
    return run_with(options, chapter);
  } catch (const InputError& error) {
    print_error(error.what());
    return bad_input;
  } catch (const std::exception& error) {
    print_error(error.what());
    return failed;
  }
}

}  // namespace fc
