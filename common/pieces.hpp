// The engine's core pieces: small functions that a learner writes in an exercise. With --clear a program runs on the
// book's clear versions of them; with --mine, on the learner's where they pass `./run check`.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <typeinfo>
#include <vector>

namespace fc {

// A piece that a program runs on: which exercise it is, and where its function is kept.
struct PieceSlot {
  std::string exercise;  // "ch01/ex06_closest_point"
  std::string what;      // "the closest point of a simplex"
  std::string type;  // of the function, as the compiler names it: a module made for another type is refused
  std::function<void(void*)> take;
};

// A slot for the function pointer `piece`, which must outlive the slot.
template <class Function>
PieceSlot slot(std::string exercise, std::string what, Function*& piece) {
  return {std::move(exercise), std::move(what), typeid(Function).name(),
          [&piece](void* function) { piece = reinterpret_cast<Function*>(function); }};
}

// Whose function a run used.
struct PieceUse {
  std::string number;  // "1.6"
  std::string what;
  bool mine = false;  // the learner's
};
std::vector<PieceUse> books(const std::vector<PieceSlot>& slots);

// Puts the learner's functions into the slots, from a folder that exercises/check.py has filled. For ch01/ex06_... it
// holds
//
//   ch01_ex06.so       the function, compiled, if its tests pass
//   ch01_ex06.source   what it was compiled from: a line with the file's path, then its text
//   ch01_ex06.refused  instead of both: one line that says why the piece is refused
//
// `say` gets one line for each piece that is refused, or has changed since it was checked; there the book's function
// stays. Throws InputError if none of the learner's functions is left.
std::vector<PieceUse> take_mine(const std::vector<PieceSlot>& slots, const std::filesystem::path& folder,
                                const std::function<void(const std::string&)>& say);

// Where check.py puts them: the environment variable FC_MINE, or build/mine/ of the project.
std::filesystem::path mine_folder();

}  // namespace fc

// In exMM_name.piece.cpp: makes a function available to the programs.
#define FC_PIECE(function)                     \
  extern "C" void* fc_piece() {                \
    return reinterpret_cast<void*>(&function); \
  }                                            \
  extern "C" const char* fc_piece_type() {     \
    return typeid(decltype(function)).name();  \
  }                                            \
  static_assert(true)
