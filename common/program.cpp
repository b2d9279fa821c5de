#include "common/program.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <new>

#include "common/options.hpp"
#include "common/report.hpp"
#include "common/results_folder.hpp"
#include "common/scene_failure.hpp"
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

// A failure's message, after the place in the scene that it concerns.
std::string failure_text(const std::exception& error, const Scene& scene) {
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return scene.file.string() + ": the scene needs more memory than there is; make it smaller";
  const auto* failure = dynamic_cast<const SceneFailure*>(&error);
  if (failure == nullptr) return error.what();
  const std::string& key = failure->key();
  const std::string above = key.substr(0, key.find('.'));  // "solver" of "solver.limit"
  const SourceMark file{scene.file.string()};
  return scene.mark(key).value_or(scene.mark(above).value_or(file)).text() + ": " + error.what();
}

// Runs one scene into a folder that exists. Failures are printed, and the summary is written in any case.
int run_scene(const Chapter& chapter, const Scene& scene, const RunContext& context, Summary& summary) {
  int exit_code = failed;
  std::string failure;
  for (const PieceUse& piece : context.pieces)
    summary.add_note("piece " + piece.number + ", " + piece.what, piece.mine ? "yours" : "the book's");
  try {
    exit_code = chapter.run(scene, context, summary);
  } catch (const InputError&) {
    throw;                                 // the run found the input bad: there is nothing to sum up
  } catch (const std::exception& error) {  // a NumericalFailure, or anything unforeseen
    failure = one_line(failure_text(error, scene));
    print_error(failure);
  }
  write_summary(context.out_dir / "summary.json", chapter, scene, summary, exit_code, failure);
  return exit_code;
}

int run_once(const Chapter& chapter, const Scene& scene, RunContext context) {
  const std::filesystem::path folder = context.out_dir;
  ResultsFolder results(folder);
  context.out_dir = results.aside();
  Summary summary;
  const int exit_code = run_scene(chapter, scene, context, summary);
  results.put_in_place();
  if (!context.quiet)
    fmt::print("{}: results in {}\n{}", one_line(scene.name), folder.string(), summary_text(summary));
  return exit_code;
}

// The scenes of a sweep, one for each value: all are checked before the first one runs.
std::vector<Scene> swept_scenes(const Chapter& chapter, const SceneSource& source, const Sweep& sweep) {
  std::vector<Scene> scenes;
  for (const std::string& value : sweep.values) {
    SceneSource swept = source;
    swept.swept = sweep.key + "=" + value;
    scenes.push_back(read_scene(swept));
  }
  if (chapter.check)
    for (const Scene& scene : scenes) chapter.check(scene);
  return scenes;
}

// Runs a scene once per value, each in a folder of its own; ends with the worst exit code.
int run_sweep(const Chapter& chapter, const SceneSource& source, const Sweep& sweep, RunContext context) {
  const std::vector<Scene> scenes = swept_scenes(chapter, source, sweep);
  const std::vector<std::string> folders = sweep_folders(sweep);
  const std::filesystem::path folder = context.out_dir;
  ResultsFolder results(folder);
  std::vector<SweepRun> runs;
  int exit_code = done;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    context.out_dir = results.aside() / folders[i];
    std::filesystem::create_directory(context.out_dir);
    SweepRun run{sweep.values[i], {}, 0};
    run.exit_code = run_scene(chapter, scenes[i], context, run.summary);
    exit_code = std::max(exit_code, run.exit_code);
    if (!context.quiet) fmt::print("{}={}\n{}", sweep.key, run.value, summary_text(run.summary));
    runs.push_back(std::move(run));
    write_sweep(results.aside() / "sweep.csv", sweep, runs);  // after each run: a later failure loses nothing
    results.keep_if_killed();
  }
  write_sweep_summary(results.aside() / "summary.json", chapter, scenes[0], sweep, exit_code);
  results.put_in_place();
  if (!context.quiet) fmt::print("one row per value in {}\n", (folder / "sweep.csv").string());
  return exit_code;
}

// Fills the chapter's slots, if the options ask for it; returns whose functions they hold.
std::vector<PieceUse> pieces_for(const Options& options, const Chapter& chapter) {
  if (!options.clear && !options.mine) return {};
  if (options.clear && options.mine)
    throw InputError("--clear runs on the book's pieces, --mine on yours; give one of them");
  if (chapter.pieces.empty())
    throw InputError(fmt::format("--{}: this program has no clear version; leave it out",
                                 options.mine ? "mine" : "clear"));
  if (options.clear) return books(chapter.pieces);
  return take_mine(chapter.pieces, mine_folder(), print_error);
}

int run_with(const Options& options, const Chapter& chapter) {
  const SceneSource source{options.scene, options.sets, options.mesh_path, chapter.number};
  if (options.live) {
    if (!chapter.live) throw InputError("--live: this program has no live scene; leave it out");
    return chapter.live(source, *options.live, options.quiet);
  }
  // In a sweep the scene is complete, and is checked, only with a swept value in it.
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
  const std::vector<PieceUse> pieces = pieces_for(options, chapter);
  const RunContext context{chapter.name,
                           options.out.value_or(default_dir),
                           options.certificate,
                           options.poses,
                           options.quiet,
                           options.clear || options.mine,
                           pieces,
                           options.algorithm};
  return sweep.values.empty() ? run_once(chapter, scene, context)
                              : run_sweep(chapter, source, sweep, context);
}

}  // namespace

int run_program(int argc, char** argv, const Chapter& chapter) {
  try {
    const Options options = parse_options(argc, argv, chapter.number, chapter.purpose, chapter.example);
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
