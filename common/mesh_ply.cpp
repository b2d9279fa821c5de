// PLY (the Stanford polygon format), in text or binary of either byte order. The header describes the rows
// that follow; of these we keep x, y, z of `vertex` and the list vertex_indices (or vertex_index) of `face`,
// and pass over the rest.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "common/byte_order.hpp"
#include "common/mesh_formats.hpp"

namespace fc::mesh_formats {
namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  Scalar type = Scalar::float32;
  std::optional<Scalar> count_type;  // a list: its length comes first
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  std::optional<std::size_t> find(std::string_view property) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == property) return i;
    }
    return std::nullopt;
  }
};

enum class Encoding { text, little, big };

struct Header {
  Encoding encoding = Encoding::text;
  std::vector<Element> elements;
  std::size_t end = 0;  // the first byte after it
  int lines = 0;
};

std::size_t size_of(Scalar type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<int>(type)];
}

Scalar scalar_named(TextCursor& cursor) {
  constexpr std::array<const char*, 8> old_names = {"char", "uchar", "short", "ushort",
                                                    "int",  "uint",  "float", "double"};
  constexpr std::array<const char*, 8> new_names = {"int8",  "uint8",  "int16",   "uint16",
                                                    "int32", "uint32", "float32", "float64"};
  const std::string_view word = cursor.word();
  for (std::size_t i = 0; i < old_names.size(); ++i) {
    if (word == old_names[i] || word == new_names[i]) return static_cast<Scalar>(i);
  }
  cursor.fail("unknown number type " + quoted(word) + " in the PLY header; export the mesh again");
}

Encoding encoding_named(TextCursor& cursor) {
  const std::string_view word = cursor.word(), version = cursor.word();
  if (version != "1.0")
    cursor.fail("unsupported PLY version " + quoted(version) + "; export it as version 1.0");
  if (word == "ascii") return Encoding::text;
  if (word == "binary_little_endian") return Encoding::little;
  if (word == "binary_big_endian") return Encoding::big;
  cursor.fail("unsupported PLY format " + quoted(word) + "; export it as ascii or binary_little_endian");
}

Property read_property(TextCursor& cursor) {
  Property property;
  TextCursor ahead = cursor;
  if (ahead.word() == "list") {
    cursor = ahead;
    property.count_type = scalar_named(cursor);
    if (*property.count_type >= Scalar::float32)
      cursor.fail("a list's length must be of an integer type; export it again");
  }
  property.type = scalar_named(cursor);
  property.name = cursor.word();
  return property;
}

Header read_header(const MeshFile& file) {
  TextCursor cursor(file);
  Header header;
  bool has_format = false;
  if (cursor.word() != "ply")
    file.fail("does not begin with 'ply', so it is not a PLY mesh; check the file's content");
  cursor.next_line();
  for (;; cursor.next_line()) {
    if (cursor.at_end())
      cursor.fail(
          "the file ends in the PLY header, before 'end_header': it is truncated; export the mesh again");
    const std::string_view keyword = cursor.word();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.encoding = encoding_named(cursor);
      has_format = true;
    } else if (keyword == "element") {
      Element element;
      element.name = cursor.word();
      const long long count = cursor.integer("the number of rows");
      if (count < 0) cursor.fail("a negative number of rows; export the mesh again");
      element.count = static_cast<std::size_t>(count);
      header.elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (header.elements.empty()) cursor.fail("'property' before any 'element'; export the mesh again");
      header.elements.back().properties.push_back(read_property(cursor));
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      cursor.fail("unknown keyword " + quoted(keyword) + " in the PLY header; export the mesh again");
    }
  }
  if (!has_format) cursor.fail("the PLY header has no line 'format'; export the mesh again");
  header.lines = cursor.mark().line;
  cursor.next_line();
  header.end = cursor.offset();
  return header;
}

// The rows of a text file: one line each.
class TextRows {
 public:
  TextRows(const MeshFile& file, const Header& header) : cursor_(file, header.end, header.lines + 1) {}

  std::size_t smallest_row(const Element& element) const {
    return std::max<std::size_t>(2, 2 * element.properties.size()) - 1;
  }
  std::size_t bytes_left() const { return cursor_.bytes_left(); }
  void begin_row() {
    while (cursor_.at_line_end() && !cursor_.at_end()) cursor_.next_line();
    if (cursor_.at_end())
      cursor_.fail(
          "the file ends before all rows that its header announces: it is truncated; export the mesh again");
  }
  double read(Scalar) { return cursor_.number("a value of the row"); }
  void end_row() {
    if (!cursor_.at_line_end()) {
      cursor_.word();
      cursor_.fail("the row has more values than the header describes; export the mesh again");
    }
  }
  void end_file() {
    while (cursor_.at_line_end() && !cursor_.at_end()) cursor_.next_line();
    if (!cursor_.at_end()) cursor_.fail("more rows than the header announces; export the mesh again");
  }
  [[noreturn]] void fail(const std::string& message) const { cursor_.fail(message); }

 private:
  TextCursor cursor_;
};

class BinaryRows {
 public:
  BinaryRows(const MeshFile& file, const Header& header)
      : file_(file),
        at_(header.end),
        order_(header.encoding == Encoding::big ? ByteOrder::big : ByteOrder::little) {}

  std::size_t smallest_row(const Element& element) const {
    std::size_t bytes = 0;
    for (const Property& p : element.properties) bytes += size_of(p.count_type.value_or(p.type));
    return std::max<std::size_t>(1, bytes);
  }
  std::size_t bytes_left() const { return file_.bytes.size() - at_; }
  void begin_row() {}
  double read(Scalar type) {
    if (bytes_left() < size_of(type))
      fail("the file ends before all rows that its header announces: it is truncated; export the mesh again");
    const char* bytes = file_.bytes.data() + at_;
    at_ += size_of(type);
    switch (type) {
      case Scalar::int8:
        return from_bytes<std::int8_t>(bytes, order_);
      case Scalar::uint8:
        return from_bytes<std::uint8_t>(bytes, order_);
      case Scalar::int16:
        return from_bytes<std::int16_t>(bytes, order_);
      case Scalar::uint16:
        return from_bytes<std::uint16_t>(bytes, order_);
      case Scalar::int32:
        return from_bytes<std::int32_t>(bytes, order_);
      case Scalar::uint32:
        return from_bytes<std::uint32_t>(bytes, order_);
      case Scalar::float32:
        return from_bytes<float>(bytes, order_);
      case Scalar::float64:
        return from_bytes<double>(bytes, order_);
    }
    return 0;
  }
  void end_row() {}
  void end_file() {
    if (bytes_left() > 0) fail("more bytes than the header announces; export the mesh again");
  }
  [[noreturn]] void fail(const std::string& message) const { file_.fail(message); }

 private:
  const MeshFile& file_;
  std::size_t at_;
  ByteOrder order_;
};

template <class Rows>
class PlyReader {
 public:
  PlyReader(Rows rows, const MeshFile& file) : rows_(std::move(rows)), file_(file) {}

  PolygonSoup read(const std::vector<Element>& elements) {
    for (const Element& element : elements) {
      // A damaged header must not make us reserve memory for rows that the file cannot hold.
      if (element.count > rows_.bytes_left() / rows_.smallest_row(element) + 1) {
        file_.fail("announces " + std::to_string(element.count) + " rows of '" + element.name +
                   "', more than the file can hold: it is truncated or damaged; export the mesh again");
      }
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        for (std::size_t row = 0; row < element.count; ++row) read_row(element);
      }
    }
    rows_.end_file();
    return std::move(soup_);
  }

 private:
  // One row: the scalars by property, and the list `list_property` of it.
  void read_row(const Element& element, std::size_t list_property = std::numeric_limits<std::size_t>::max()) {
    rows_.begin_row();
    values_.assign(element.properties.size(), 0);
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const Property& property = element.properties[p];
      if (!property.count_type) {
        values_[p] = rows_.read(property.type);
        continue;
      }
      const double length = rows_.read(*property.count_type);
      if (!(length >= 0 && length <= static_cast<double>(rows_.bytes_left())) ||
          length != std::floor(length)) {
        rows_.fail("a list of impossible length; export the mesh again");
      }
      if (p == list_property) list_.clear();
      for (double i = 0; i < length; ++i) {
        const double item = rows_.read(property.type);
        if (p == list_property) list_.push_back(item);
      }
    }
    rows_.end_row();
  }

  void read_vertices(const Element& element) {
    const auto x = element.find("x"), y = element.find("y"), z = element.find("z");
    if (!x || !y || !z) file_.fail("has vertices without x, y or z; export the mesh again");
    soup_.vertices.reserve(soup_.vertices.size() + element.count);
    for (std::size_t row = 0; row < element.count; ++row) {
      read_row(element);
      soup_.vertices.emplace_back(checked_coordinate(values_[*x], rows_),
                                  checked_coordinate(values_[*y], rows_),
                                  checked_coordinate(values_[*z], rows_));
    }
  }

  void read_faces(const Element& element) {
    auto list = element.find("vertex_indices");
    if (!list) list = element.find("vertex_index");
    if (!list || !element.properties[*list].count_type) {
      file_.fail("has faces without a list 'vertex_indices'; export the mesh again");
    }
    soup_.sizes.reserve(element.count);
    soup_.corners.reserve(3 * element.count);
    const auto vertices = static_cast<double>(soup_.vertices.size());
    for (std::size_t row = 0; row < element.count; ++row) {
      read_row(element, *list);
      if (list_.size() < 3) rows_.fail("a face with fewer than three corners; export the mesh again");
      if (list_.size() > kMaxCorners)
        rows_.fail("a face with more than 10000 corners; export the mesh as triangles");
      for (double index : list_) {
        if (!(index >= 0 && index < vertices) || index != std::floor(index)) {
          rows_.fail("face " + std::to_string(row) + " names vertex " + fmt::format("{}", index) +
                     ", but the file has " + std::to_string(soup_.vertices.size()) +
                     " vertices, counted from 0; export the mesh again");
        }
        soup_.corners.push_back(static_cast<int>(index));
      }
      soup_.sizes.push_back(static_cast<int>(list_.size()));
    }
  }

  Rows rows_;
  const MeshFile& file_;
  PolygonSoup soup_;
  std::vector<double> values_, list_;
};

}  // namespace

TriangleMesh read_ply(const MeshFile& file) {
  const Header header = read_header(file);
  PolygonSoup soup = header.encoding == Encoding::text
                         ? PlyReader(TextRows(file, header), file).read(header.elements)
                         : PlyReader(BinaryRows(file, header), file).read(header.elements);
  if (soup.sizes.empty()) file.fail("has no faces; a point cloud cannot collide: export a mesh of triangles");
  return triangulate(std::move(soup));
}

}  // namespace fc::mesh_formats
