// The library's only file that includes CLI11, which takes seconds to compile.
#include "common/options.hpp"

#include <CLI/CLI.hpp>
#include <charconv>

#include "common/errors.hpp"
#include "common/scene_keys.hpp"
#include "common/text.hpp"

namespace fc {
namespace {

// An option that may be given several times, with one value each: a list option would swallow the scene after
// it.
template <class Value>
CLI::Option* add_repeated(CLI::App& app, const std::string& name, std::vector<Value>& values,
                          const std::string& help) {
  return app.add_option(name, values, help)
      ->expected(1)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

// The one value of an option that may be given once, or "".
std::string once(const std::string& name, const std::vector<std::string>& values,
                 const std::string& instead) {
  if (values.size() > 1)
    throw InputError(name + " is given twice, " + in_quotes(values[0]) + " and " + in_quotes(values[1]) +
                     "; " + instead);
  return values.empty() ? "" : values[0];
}

void refuse_idle(const CLI::App& app, int chapter) {
  for (const ChapterOption& option : chapter_options()) {
    if (app.get_option(option.name)->count() == 0 || (option.first <= chapter && chapter <= option.last))
      continue;
    throw InputError(option.name + " has no effect in " + chapter_title(chapter) + ": it " + option.what +
                     ", in " + chapters_text(option.first, option.last) + "; leave it out");
  }
}

// The port that --live or --live=PORT names; 0 = any free one.
int port_of(const std::string& text) {
  int port = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (error != std::errc() || end != text.data() + text.size() || port < 0 || port > 65535)
    throw InputError("--live=" + one_line(text) +
                     ": a port is a whole number from 1 to 65535; leave it out, and a free one is taken");
  return port;
}

// The frames that --algorithm names: numbers from 1 on, the word "first", or "none" alone.
std::vector<int> frames_of(const std::string& text) {
  if (text == "none") return {};
  std::vector<int> frames;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::string word = text.substr(start, end - start);
    int frame = kFirstContact;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), frame);
    const bool is_number = error == std::errc() && stop == word.data() + word.size() && frame >= 1;
    if (!is_number && word != "first")
      throw InputError("--algorithm " + one_line(text) + ": " + in_quotes(word) +
                       " is no frame; name frames from 1 on, as 12,40, or 'first', or 'none'");
    frames.push_back(is_number ? frame : kFirstContact);
    start = end + 1;
  }
  return frames;
}

// A live scene writes no results, and runs until it is stopped.
void refuse_beside_live(const CLI::App& app) {
  for (const char* other : {"--explain", "--sweep", "--out", "--poses", "--algorithm", "--clear", "--mine"})
    if (app.get_option(other)->count() > 0)
      throw InputError(std::string(other) + " has no effect beside --live; leave one of them out");
}

}  // namespace

const std::vector<ChapterOption>& chapter_options() {
  static const std::vector<ChapterOption> options = {
      {"--certificate", 1, 2, "writes certificate.csv, every advance of a query"},
      {"--poses", 4, all_later_chapters, "writes poses.csv, every body at every frame"},
      {"--algorithm", 4, all_later_chapters,
       "names the frames whose algorithm the recording shows step by step"},
      {"--mesh-path", 2, all_later_chapters, "names folders in which meshes are looked for"},
      {"--live", 4, all_later_chapters, "opens the scene to a browser while it runs"},
  };
  return options;
}

Options parse_options(int argc, char** argv, int chapter, const std::string& purpose,
                      const std::string& example) {
  Options options;
  std::vector<std::string> out, sweep, mesh_path, live, algorithm;
  CLI::App app(purpose);
  app.footer("Example:\n  " + example);
  app.add_option("SCENE", options.scene, "The scene to run, a YAML file")->required()->type_name("FILE");
  add_repeated(app, "--out", out, "Folder for the results (default: out/<scene name>/)")->type_name("DIR");
  add_repeated(app, "--set", options.sets, "Set one value of the scene, e.g. ccd.tolerance=1e-4 (repeatable)")
      ->type_name("KEY.PATH=VALUE");
  add_repeated(app, "--sweep", sweep, "Run once per value; one row per value in sweep.csv")
      ->type_name("KEY.PATH=V1,V2,...");
  app.add_flag("--explain", options.explain, "Print which effects are on, why, and what each adds; then exit")
      ->disable_flag_override();
  add_repeated(app, "--mesh-path", mesh_path, "Look for meshes here too (repeatable; from chapter 2 on)")
      ->type_name("DIR");
  app.add_flag("--certificate", options.certificate, "Write certificate.csv: every advance (chapters 1, 2)")
      ->disable_flag_override();
  app.add_flag("--poses", options.poses, "Write poses.csv: every body at every frame (chapter 4 on)")
      ->disable_flag_override();
  add_repeated(
      app, "--algorithm", algorithm,
      "Show the algorithm of these frames step by step in the recording: numbers, 'first' (the first with "
      "a contact; the default) or 'none' (chapter 4 on)")
      ->type_name("FRAME,FRAME,...");
  app.add_flag("--live{0}", live,
               "Open the scene to a browser while it runs; print the page's address (chapter 4 on)");
  app.add_flag("--clear", options.clear, "Run on the text's clear versions instead of the fast ones")
      ->disable_flag_override();
  app.add_flag("--mine", options.mine, "Like --clear, but on your own pieces where they pass ./run check")
      ->disable_flag_override();
  app.add_flag("--quiet", options.quiet, "Print nothing but errors")->disable_flag_override();
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    options.help = app.help();
    const std::string as_declared = "--live{0}    ";  // CLI11's way to say that a flag may have a value
    if (const std::size_t at = options.help.find(as_declared); at != std::string::npos)
      options.help.replace(at, as_declared.size(), "--live[=PORT]");
    return options;
  } catch (const CLI::ParseError& error) {
    throw InputError(one_line(error.what()) + "; see --help");
  }
  refuse_idle(app, chapter);
  if (!live.empty()) {
    refuse_beside_live(app);
    options.live = port_of(once("--live", live, "there is one page"));
  }
  if (!algorithm.empty() && chapter >= 5 && (options.clear || options.mine))
    throw InputError(
        "--algorithm has no effect beside --clear and --mine from chapter 5 on: it shows the fast methods; "
        "leave one of them out");
  if (!algorithm.empty())
    options.algorithm = frames_of(once("--algorithm", algorithm, "name all frames in one list, as 12,40"));
  options.sweep = once("--sweep", sweep, "a run sweeps one key: sweep one, and --set the other");
  if (!out.empty()) {
    options.out = once("--out", out, "the results go into one folder");
    if (options.out->empty()) throw InputError("--out: the folder's name is empty; name a folder");
  }
  for (const std::string& folder : mesh_path) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored)) {
      throw InputError("--mesh-path " + one_line(folder) + ": no such folder; check the path");
    }
    options.mesh_path.emplace_back(folder);
  }
  return options;
}

}  // namespace fc
