#include "common/table.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include "common/errors.hpp"

namespace fc {

std::string cell_text(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{}", *number);
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return fmt::format("{}", *integer);
  return std::get<std::string>(cell);
}

namespace {

// A CSV field: quoted only where a reader needs it (RFC 4180).
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) {
    field += c;
    if (c == '"') field += c;
  }
  return field + '"';
}

}  // namespace

struct TableWriter::File {
  std::filesystem::path path;
  std::vector<Column> columns;
  std::FILE* stream = nullptr;

  [[noreturn]] void fail(const std::string& message) const {
    throw NumericalFailure(path.filename().string() + ": " + message);
  }
  void write(const std::string& line) const {
    if (std::fwrite(line.data(), 1, line.size(), stream) != line.size()) fail_to_write();
  }
  [[noreturn]] void fail_to_write() const {
    throw std::runtime_error(path.filename().string() +
                             ": cannot be written to the end: " + std::strerror(errno));
  }
};

TableWriter::TableWriter(const std::filesystem::path& file, std::vector<Column> columns)
    : file_(std::make_unique<File>()) {
  file_->path = file;
  file_->columns = std::move(columns);
  file_->stream = std::fopen(file.c_str(), "wb");
  if (!file_->stream) {
    throw InputError({file.string()}, std::string("cannot be written: ") + std::strerror(errno) +
                                          "; choose another folder by --out");
  }
  std::string header;
  for (const Column& column : file_->columns) {
    if (!header.empty()) header += ',';
    header += csv_field(column.unit.empty() ? column.name : column.name + " [" + column.unit + "]");
  }
  file_->write(header + '\n');
}

TableWriter::~TableWriter() {
  if (file_ && file_->stream) std::fclose(file_->stream);
}

TableWriter::TableWriter(TableWriter&&) noexcept = default;

void TableWriter::row(const std::vector<Cell>& cells) {
  const std::vector<Column>& columns = file_->columns;
  if (!file_->stream) file_->fail("a row after close()");
  if (cells.size() != columns.size()) {
    file_->fail(fmt::format("a row of {} cells, but {} columns", cells.size(), columns.size()));
  }
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto* number = std::get_if<double>(&cells[i]);
    if (number && std::isnan(*number)) file_->fail("column " + columns[i].name + " is not a number (NaN)");
    const std::string text = cell_text(cells[i]);
    if (text.empty()) file_->fail("column " + columns[i].name + " is empty");
    if (i > 0) line += ',';
    line += csv_field(text);
  }
  file_->write(line + '\n');
}

void TableWriter::close() {
  if (!file_->stream) return;
  const bool had_error = std::ferror(file_->stream) != 0;
  const bool closed = std::fclose(std::exchange(file_->stream, nullptr)) == 0;
  if (had_error || !closed) file_->fail_to_write();
}

}  // namespace fc
