// What the executables of all chapters share: options, exit codes, summaries, sweeps (contract 1.3 and 1.5).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "common/pieces.hpp"
#include "common/scene.hpp"
#include "common/table.hpp"

namespace fc {

// A run's summary: printed to standard output with units, and written to summary.json; its numbers are the
// columns of sweep.csv. Entries keep their order.
class Summary {
 public:
  enum class Kind { value, time, note };
  struct Entry {
    std::string name;
    Cell value;  // of a time: whole nanoseconds
    std::string unit;
    Kind kind = Kind::value;
  };
  struct Counter {
    std::string stage;      // a stage of the pipeline or an effect
    std::int64_t runs = 0;  // how often it ran
    std::int64_t ns = 0;    // what it cost
  };

  void add(std::string name, Cell value, std::string unit = "") {
    entries_.push_back({std::move(name), std::move(value), std::move(unit)});
  }
  // A measured time: it differs from run to run, so its column in sweep.csv ends in _ns.
  void add_time(std::string name, std::int64_t ns) {
    entries_.push_back({std::move(name), ns, "ns", Kind::time});
  }
  // A remark for people; not a column of sweep.csv.
  void add_note(std::string name, std::string text) {
    entries_.push_back({std::move(name), std::move(text), "", Kind::note});
  }
  void counter(std::string stage, std::int64_t runs, std::int64_t ns) {
    Counter& added = counters_.emplace_back();  // moving a Counter in makes GCC 12 warn about its string
    added = {std::move(stage), runs, ns};
  }

  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<Counter>& counters() const { return counters_; }

 private:
  std::vector<Entry> entries_;
  std::vector<Counter> counters_;
};

// A bar on standard error, only on a terminal and not when quiet. Cheap to call often.
class Progress {
 public:
  Progress(std::string what, std::int64_t total, bool quiet);
  ~Progress();  // clears the line
  void update(std::int64_t done);

 private:
  std::string what_;
  std::int64_t total_;
  bool enabled_;
  int shown_percent_ = -1;
};

// What a chapter's run gets in addition to the scene.
struct RunContext {
  std::string chapter;            // the program's name
  std::filesystem::path out_dir;  // exists; the run writes here, and its files are put in place at its end
  bool certificate = false;       // --certificate
  bool poses = false;             // --poses
  bool quiet = false;             // --quiet
  bool clear = false;             // --clear or --mine: run on the chapter's pieces
  std::vector<PieceUse> pieces = {};  // then: whose each piece is
  std::vector<int> algorithm = {};    // --algorithm: frames, or kFirstContact (options.hpp)
};

// One line of --explain.
struct Effect {
  std::string name;    // "restitution"
  std::string reason;  // "declared at line 7" or "derived: every body is a sphere"
  std::string stages;  // what it adds to the pipeline
  int unknowns_per_contact = 0;
};

// A chapter's executable. `run` fills the summary as it goes (what it holds is written even if run throws
// NumericalFailure) and returns the exit code: 0, or 3 for a failure that is already reported in the tables.
struct Chapter {
  int number = 0;
  std::string name;     // the folder's name
  std::string purpose;  // one or two sentences for --help
  std::string example;  // a command line that works from the project's root
  std::function<std::vector<Effect>(const Scene&)> explain;
  std::function<int(const Scene&, const RunContext&, Summary&)> run;
  // Throws InputError for what only the built scene shows (bodies that overlap, a matrix that cannot be
  // read); called before a sweep begins. May be empty.
  std::function<void(const Scene&)> check = {};
  std::vector<PieceSlot> pieces = {};  // of its clear versions; none: there is no --clear and no --mine
  // --live: lets a page in a browser touch the scene while it runs; returns the exit code. A chapter reads the source into its
  // live::Simulation and hands that to the server:
  //   chapter.live = [](const SceneSource& source, int port, bool quiet) {
  //     MyLiveScene scene(source);
  //     return live::serve(scene, port, quiet);  // common/live/serve.hpp, library fc_live
  //   };
  // A function, so that this library needs no server. May be empty: then there is no --live.
  std::function<int(const SceneSource& source, int port, bool quiet)> live = {};
};

// The whole of main(): parses options, reads the scene, runs, sweeps or explains, prints, and maps failures
// to exit codes.
int run_program(int argc, char** argv, const Chapter& chapter);

}  // namespace fc
