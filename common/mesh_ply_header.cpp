#include "common/mesh_ply_header.hpp"
#include "common/text.hpp"

#include <algorithm>

namespace fc::mesh_formats {
namespace {

PlyScalar scalar_named(TextCursor& cursor) {
  constexpr std::array<const char*, 8> old_names = {"char", "uchar", "short", "ushort",
                                                    "int",  "uint",  "float", "double"};
  constexpr std::array<const char*, 8> new_names = {"int8",  "uint8",  "int16",   "uint16",
                                                    "int32", "uint32", "float32", "float64"};
  const std::string_view word = cursor.word();
  for (std::size_t i = 0; i < old_names.size(); ++i) {
    if (word == old_names[i] || word == new_names[i]) return static_cast<PlyScalar>(i);
  }
  cursor.fail("unknown number type " + in_quotes(word) + " in the PLY header; export the mesh again");
}

PlyEncoding encoding_named(TextCursor& cursor) {
  const std::string_view word = cursor.word(), version = cursor.word();
  if (version != "1.0")
    cursor.fail("unsupported PLY version " + in_quotes(version) + "; export it as version 1.0");
  if (word == "ascii") return PlyEncoding::text;
  if (word == "binary_little_endian") return PlyEncoding::little;
  if (word == "binary_big_endian") return PlyEncoding::big;
  cursor.fail("unsupported PLY format " + in_quotes(word) + "; export it as ascii or binary_little_endian");
}

void read_property(TextCursor& cursor, PlyHeader& header) {
  if (header.elements.empty()) cursor.fail("'property' before any 'element'; export the mesh again");
  PlyElement& element = header.elements.back();
  PlyProperty property;
  TextCursor ahead = cursor;
  if (ahead.word() == "list") {
    cursor = ahead;
    property.count_type = scalar_named(cursor);
    if (*property.count_type >= PlyScalar::float32)
      cursor.fail("a list's length must be of an integer type; export it again");
  }
  property.type = scalar_named(cursor);
  property.name = cursor.word();
  if (property.name.empty()) cursor.fail("a property without a name; export the mesh again");
  if (element.find(property.name))
    cursor.fail("the property " + in_quotes(property.name) + " is there twice; export the mesh again");
  element.properties.push_back(std::move(property));
}

void read_element(TextCursor& cursor, PlyHeader& header) {
  PlyElement element;
  element.name = cursor.word();
  if (header.find(element.name))
    cursor.fail("the element " + in_quotes(element.name) + " is there twice; export the mesh again");
  const long long count = cursor.integer("the number of rows");
  if (count < 0) cursor.fail("a negative number of rows; export the mesh again");
  element.count = static_cast<std::size_t>(count);
  header.elements.push_back(std::move(element));
}

// Reads the lines of a header, from its "ply" to its "end_header".
PlyHeader read_lines(const InputFile& file) {
  TextCursor cursor(file);
  PlyHeader header;
  bool has_format = false;
  cursor.word();
  cursor.end_line("'ply' in the PLY header; export the mesh again");
  for (cursor.next_line();; cursor.next_line()) {
    if (cursor.at_end())
      cursor.fail(
          "the file ends in the PLY header, before 'end_header': it is truncated; export the mesh again");
    const std::string_view keyword = cursor.word();
    if (keyword == "comment" || keyword == "obj_info" || keyword.empty()) continue;
    if (keyword == "format") {
      if (has_format) cursor.fail("a second line 'format'; export the mesh again");
      header.encoding = encoding_named(cursor);
      has_format = true;
    } else if (keyword == "element") {
      read_element(cursor, header);
    } else if (keyword == "property") {
      read_property(cursor, header);
    } else if (keyword != "end_header") {
      cursor.fail("unknown keyword " + in_quotes(keyword) + " in the PLY header; export the mesh again");
    }
    cursor.end_line("all that this line of the PLY header should have; export the mesh again");
    if (keyword == "end_header") break;
  }
  if (!has_format) cursor.fail("the PLY header has no line 'format'; export the mesh again");
  header.lines = cursor.mark().line;
  return header;
}

// The size of the header in bytes. The rows after it may be binary, so the header itself must show what ends its
// last line: if \r alone ends the first one, a byte \n after the last one's \r belongs to the rows.
std::size_t header_size(const std::string& bytes) {
  const std::size_t first_end = std::min(bytes.find_first_of("\r\n"), bytes.size());
  const bool returns_alone = bytes[first_end] == '\r' && bytes[first_end + 1] != '\n';
  const std::size_t last_line =
      std::min(bytes.find("\nend_header", first_end), bytes.find("\rend_header", first_end));
  if (last_line == std::string::npos) return bytes.size();
  const std::size_t end = bytes.find_first_of("\r\n", last_line + 1);
  if (end == std::string::npos) return bytes.size();
  return end + (!returns_alone && bytes.compare(end, 2, "\r\n") == 0 ? 2 : 1);
}

}  // namespace

PlyHeader read_ply_header(InputFile& file) {
  std::string& rows = file.bytes;
  while (rows.starts_with("\xEF\xBB\xBF")) rows.erase(0, 3);
  const std::size_t size = header_size(rows);
  InputFile header{file.path, rows.substr(0, size)};
  rows.erase(0, size);
  const bool ends_with_return = header.bytes.ends_with('\r');
  unify_text(header.bytes);
  PlyHeader result = read_lines(header);
  if (result.encoding == PlyEncoding::text && ends_with_return && rows.starts_with('\n')) rows.erase(0, 1);
  return result;
}

}  // namespace fc::mesh_formats
