#include "common/pieces.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>

#include "common/errors.hpp"

namespace fc {
namespace {

// "1.6" of "ch01/ex06_closest_point", and "ch01_ex06", which its files are called.
std::string dotted(const std::string& exercise) {
  return fmt::format("{}.{}", std::stoi(exercise.substr(2, 2)), std::stoi(exercise.substr(7, 2)));
}
std::string file_name(const std::string& exercise) {
  return exercise.substr(0, 4) + "_" + exercise.substr(5, 4);
}

std::optional<std::string> text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// Whether the file that a module was compiled from still has the text that was checked.
bool is_as_checked(const std::filesystem::path& source) {
  const std::string kept = text_of(source).value_or("");
  const std::size_t line = kept.find('\n');
  return line != std::string::npos && text_of(kept.substr(0, line)) == kept.substr(line + 1);
}

// The module's function, or why there is none. Modules stay open until the program ends: their functions are called.
void* open_module(const std::filesystem::path& module, const std::string& type, std::string& refused) {
  void* handle = dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    refused = dlerror();
    return nullptr;
  }
  const auto function = reinterpret_cast<void* (*)()>(dlsym(handle, "fc_piece"));
  const auto its_type = reinterpret_cast<const char* (*)()>(dlsym(handle, "fc_piece_type"));
  if (function != nullptr && its_type != nullptr && its_type() == type) return function();
  refused = "it was compiled for another version of this program";
  return nullptr;
}

}  // namespace

std::vector<PieceUse> books(const std::vector<PieceSlot>& slots) {
  std::vector<PieceUse> uses;
  for (const PieceSlot& slot : slots) uses.push_back({dotted(slot.exercise), slot.what, false});
  return uses;
}

std::vector<PieceUse> take_mine(const std::vector<PieceSlot>& slots, const std::filesystem::path& folder,
                                const std::function<void(const std::string&)>& say) {
  std::vector<PieceUse> uses = books(slots);
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const PieceSlot& slot = slots[i];
    const auto file = [&](const char* end) { return folder / (file_name(slot.exercise) + end); };
    std::string refused;
    if (std::filesystem::exists(file(".so"))) {
      if (!is_as_checked(file(".source"))) {
        refused = "its file has changed since it was checked";
      } else if (void* function = open_module(file(".so"), slot.type, refused); function != nullptr) {
        slot.take(function);
        uses[i].mine = true;
        continue;
      }
    } else if (const auto why = text_of(file(".refused"))) {
      refused = why->substr(0, why->find('\n'));
    } else {
      continue;  // not started
    }
    say(fmt::format("--mine: the book's version stands in for your {} ({}): {}; ./run check {}",
                    uses[i].number, slot.what, refused, slot.exercise.substr(0, 9)));
  }
  if (std::none_of(uses.begin(), uses.end(), [](const PieceUse& use) { return use.mine; }))
    throw InputError(fmt::format(
        "--mine: of the {} pieces that this program runs on, none of yours passes its tests yet; write {} "
        "(exercises/{}/README.md), then ./run check",
        slots.size(), uses.empty() ? "one" : uses[0].number,
        slots.empty() ? "ch01" : slots[0].exercise.substr(0, 4)));
  return uses;
}

std::filesystem::path mine_folder() {
  const char* named = std::getenv("FC_MINE");
  return named != nullptr && *named != '\0' ? std::filesystem::path(named)
                                            : std::filesystem::path(FC_MINE_FOLDER);
}

}  // namespace fc
