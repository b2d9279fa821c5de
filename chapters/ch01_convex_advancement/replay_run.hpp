// What ch01_replay and ch02_replay share, the programs that check certificates: options, tables, messages,
// exit codes.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "ch01_convex_advancement/replay.hpp"
#include "common/pieces.hpp"
#include "common/scene.hpp"

namespace fc::ca {

// The scene's queries, whatever they are about, and how to replay one.
struct ReplayQuestions {
  std::size_t count;
  std::function<std::vector<Refusal>(std::size_t query, const ReplayAnswer&,
                                     const std::vector<CertificateRow>&)>
      replay;
};

struct ReplayProgram {
  int chapter;
  std::string purpose, example;  // for --help
  using Ask = std::function<ReplayQuestions(const Scene&, const std::filesystem::path& run)>;
  Ask questions;
  // With --clear and --mine: the replay by a piece that a learner may write. None: there are no such options.
  Ask clear_questions = {};
  std::vector<PieceSlot> pieces = {};
};

// Reads SCENE and RUN_DIR from the command line, replays every query, and writes a line on standard error for
// each thing that is refused. Returns the exit code: 0, all is proved; 3, something is not; 2, bad input.
int run_replay(int argc, char** argv, const ReplayProgram& program);

}  // namespace fc::ca
