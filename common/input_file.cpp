#include "common/input_file.hpp"

#include <algorithm>
#include <fstream>
#include <system_error>

#include "common/errors.hpp"

namespace fc {

void InputFile::fail(const std::string& message) const {
  throw InputError({path.string(), 0, 0}, message);
}

InputFile read_input_file(const std::filesystem::path& path, const char* wanted, std::size_t largest) {
  InputFile file{path, {}};
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) file.fail("no such file; check the path");
  if (std::filesystem::is_directory(status))
    file.fail(std::string("is a folder; name ") + wanted + " file in it");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) file.fail("cannot be read; check its permissions");
  const auto check_size = [&](std::uintmax_t size) {
    if (size > largest)
      file.fail("is larger than " + std::to_string(largest >> 20) + " MiB, too much for " + wanted +
                "; check the path");
  };
  if (std::filesystem::is_fifo(status)) {  // what a shell makes of <(command)
    char block[65536];
    while (stream.read(block, sizeof block) || stream.gcount() > 0) {
      file.bytes.append(block, static_cast<std::size_t>(stream.gcount()));
      check_size(file.bytes.size());
    }
    return file;
  }
  if (!std::filesystem::is_regular_file(status))
    file.fail(std::string("is not a regular file; name ") + wanted + " file");
  const auto size = std::filesystem::file_size(path, error);
  if (error) file.fail("cannot be read; check its permissions");
  check_size(size);
  file.bytes.resize(size);
  stream.read(file.bytes.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size))
    file.fail("cannot be read to its end; try again");
  return file;
}

void refuse_other_kind(const InputFile& file, const char* wanted, std::string_view own_extension) {
  const auto kind = file_kind(file.bytes);
  if (kind && (own_extension.empty() || own_extension != kind->extension))
    file.fail(std::string("is ") + kind->name + ", not " + wanted + "; " + kind->advice);
}

void unify_text(std::string& text) {
  while (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // some tools add one to another
  const std::size_t first = text.find('\r');
  if (first == std::string::npos) return;
  std::size_t kept = first;
  for (std::size_t i = first; i < text.size(); ++i) {
    const bool pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
    if (!pair) text[kept++] = text[i] == '\r' ? '\n' : text[i];
  }
  text.resize(kept);
}

void make_text(InputFile& file, const char* wanted, int first_line) {
  unify_text(file.bytes);
  const std::size_t zero = file.bytes.find('\0');
  if (zero == std::string::npos) return;
  const auto at = file.bytes.begin() + static_cast<std::ptrdiff_t>(zero);
  const auto line = static_cast<int>(std::count(file.bytes.begin(), at, '\n'));
  const auto line_start = zero == 0 ? 0 : file.bytes.rfind('\n', zero - 1) + 1;  // npos + 1 = 0
  throw InputError({file.path.string(), first_line + line, static_cast<int>(zero - line_start) + 1},
                   std::string("a zero byte: binary data, so it is not ") + wanted +
                       "; check the file's name and content");
}

}  // namespace fc
