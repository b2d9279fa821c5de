// PLY (the Stanford polygon format), in text or binary of either byte order. The header describes the rows
// that follow, in any order; of these we keep x, y, z of `vertex` and the list vertex_indices (or
// vertex_index) of `face` and of `tristrips`. Other properties are skipped; so are rows of other elements,
// which are reported.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "common/byte_order.hpp"
#include "common/mesh_ply_header.hpp"
#include "common/text.hpp"

namespace fc::mesh_formats {
namespace {

std::size_t size_of(PlyScalar type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<int>(type)];
}

// The rows of a text file: one line each.
class TextRows {
 public:
  TextRows(const InputFile& file, const PlyHeader& header) : cursor_(file, header.lines + 1) {}

  std::size_t smallest_row(const PlyElement& element) const {
    return std::max<std::size_t>(2, 2 * element.properties.size()) - 1;
  }
  std::size_t bytes_left() const { return cursor_.bytes_left(); }
  void begin_row() {
    while (cursor_.at_line_end() && !cursor_.at_end()) cursor_.next_line();
    if (cursor_.at_end())
      cursor_.fail(
          "the file ends before all rows that its header announces: it is truncated; export the mesh again");
  }
  double read(PlyScalar) { return cursor_.number("a value of the row"); }
  // A list's length, or a vertex's number: written as a whole number where its type is one.
  double read_whole(PlyScalar type, const char* what) {
    return type < PlyScalar::float32 ? static_cast<double>(cursor_.integer(what)) : cursor_.number(what);
  }
  void end_row() {
    cursor_.end_line("the row's last value that the header describes; export the mesh again");
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
  BinaryRows(const InputFile& file, const PlyHeader& header)
      : file_(file), order_(header.encoding == PlyEncoding::big ? ByteOrder::big : ByteOrder::little) {}

  std::size_t smallest_row(const PlyElement& element) const {
    std::size_t bytes = 0;
    for (const PlyProperty& p : element.properties) bytes += size_of(p.count_type.value_or(p.type));
    return std::max<std::size_t>(1, bytes);
  }
  std::size_t bytes_left() const { return file_.bytes.size() - at_; }
  void begin_row() {}
  double read(PlyScalar type) {
    if (bytes_left() < size_of(type))
      fail("the file ends before all rows that its header announces: it is truncated; export the mesh again");
    const char* bytes = file_.bytes.data() + at_;
    at_ += size_of(type);
    switch (type) {
      case PlyScalar::int8:
        return from_bytes<std::int8_t>(bytes, order_);
      case PlyScalar::uint8:
        return from_bytes<std::uint8_t>(bytes, order_);
      case PlyScalar::int16:
        return from_bytes<std::int16_t>(bytes, order_);
      case PlyScalar::uint16:
        return from_bytes<std::uint16_t>(bytes, order_);
      case PlyScalar::int32:
        return from_bytes<std::int32_t>(bytes, order_);
      case PlyScalar::uint32:
        return from_bytes<std::uint32_t>(bytes, order_);
      case PlyScalar::float32:
        return from_bytes<float>(bytes, order_);
      case PlyScalar::float64:
        return from_bytes<double>(bytes, order_);
    }
    return 0;
  }
  double read_whole(PlyScalar type, const char*) { return read(type); }
  void end_row() {}
  void end_file() {
    if (bytes_left() > 0) fail("more bytes than the header announces; export the mesh again");
  }
  [[noreturn]] void fail(const std::string& message) const { file_.fail(message); }

 private:
  const InputFile& file_;
  std::size_t at_ = 0;
  ByteOrder order_;
};

template <class Rows>
class PlyReader {
 public:
  PlyReader(Rows rows, const InputFile& file, const PlyHeader& header)
      : rows_(std::move(rows)), file_(file), header_(header) {}

  ReadMesh read() {
    const PlyElement* vertices = header_.find("vertex");
    vertex_count_ = vertices ? vertices->count : 0;  // a face's row may stand before those of its vertices
    std::string left_out;
    for (const PlyElement& element : header_.elements) {
      // A damaged header must not make us reserve memory for rows that the file cannot hold.
      if (element.count > rows_.bytes_left() / rows_.smallest_row(element) + 1) {
        file_.fail("announces " + std::to_string(element.count) + " rows of " + in_quotes(element.name) +
                   ", more than the file can hold: it is truncated or damaged; export the mesh again");
      }
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face" || element.name == "tristrips") {
        read_faces(element);
      } else {
        for (std::size_t row = 0; row < element.count; ++row) read_row(element);
        if (element.count > 0)
          left_out += fmt::format("{}{} row{} of {}", left_out.empty() ? "" : ", ", element.count,
                                  element.count == 1 ? "" : "s", in_quotes(element.name));
      }
    }
    rows_.end_file();
    if (soup_.sizes.empty() && header_.find("range_grid"))
      file_.fail("is a range scan, whose grid is not read; export a mesh of triangles");
    if (soup_.sizes.empty())
      file_.fail("has no faces; a point cloud cannot collide: export a mesh of triangles");
    return {triangulate(std::move(soup_)), left_out};
  }

 private:
  // One row: the scalars by property, and the list `list_property` of it.
  void read_row(const PlyElement& element,
                std::size_t list_property = std::numeric_limits<std::size_t>::max()) {
    rows_.begin_row();
    values_.assign(element.properties.size(), 0);
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (!property.count_type) {
        values_[p] = rows_.read(property.type);
        continue;
      }
      const double length = rows_.read_whole(*property.count_type, "a list's length");
      if (!(length >= 0 && length <= static_cast<double>(rows_.bytes_left()))) {
        rows_.fail("a list of impossible length; export the mesh again");
      }
      if (p == list_property) list_.clear();
      for (double i = 0; i < length; ++i) {
        if (p != list_property)
          rows_.read(property.type);
        else
          list_.push_back(rows_.read_whole(property.type, "a vertex's number"));
      }
    }
    rows_.end_row();
  }

  void read_vertices(const PlyElement& element) {
    const auto x = element.find("x"), y = element.find("y"), z = element.find("z");
    const auto is_number = [&](const auto& property) {
      return property && !element.properties[*property].count_type;
    };
    if (!is_number(x) || !is_number(y) || !is_number(z))
      file_.fail("has vertices without x, y or z; export the mesh again");
    soup_.vertices.reserve(element.count);
    for (std::size_t row = 0; row < element.count; ++row) {
      read_row(element);
      soup_.vertices.emplace_back(checked_coordinate(values_[*x], rows_),
                                  checked_coordinate(values_[*y], rows_),
                                  checked_coordinate(values_[*z], rows_));
    }
  }

  // Faces, or triangle strips: each row has a list of vertices.
  void read_faces(const PlyElement& element) {
    auto list = element.find("vertex_indices");
    if (!list) list = element.find("vertex_index");
    if (!list || !element.properties[*list].count_type) {
      file_.fail("has faces without a list 'vertex_indices'; export the mesh again");
    }
    soup_.sizes.reserve(soup_.sizes.size() + element.count);
    soup_.corners.reserve(soup_.corners.size() + 3 * element.count);
    for (std::size_t row = 0; row < element.count; ++row) {
      read_row(element, *list);
      if (element.name == "face")
        add_face(row);
      else
        add_strips(row);
    }
  }

  int vertex(double index, const char* of, std::size_t row) const {
    if (!(index >= 0 && index < static_cast<double>(vertex_count_)) || index != std::floor(index)) {
      rows_.fail(
          fmt::format("{} {} names vertex {}, but the file has {} vertices, counted from 0; export the "
                      "mesh again",
                      of, row, index, vertex_count_));
    }
    return static_cast<int>(index);
  }

  void add_face(std::size_t row) {
    if (list_.size() < 3) rows_.fail("a face with fewer than three corners; export the mesh again");
    if (list_.size() > kMaxCorners)
      rows_.fail("a face with more than 10000 corners; export the mesh as triangles");
    for (double index : list_) soup_.corners.push_back(vertex(index, "face", row));
    soup_.sizes.push_back(static_cast<int>(list_.size()));
  }

  // Each three successive vertices are a triangle, every second one in reverse order; -1 begins a new strip.
  void add_strips(std::size_t row) {
    list_.push_back(-1);
    for (std::size_t begin = 0, i = 0; i < list_.size(); ++i) {
      if (list_[i] != -1) continue;
      if (i == begin + 1 || i == begin + 2)
        rows_.fail("a triangle strip with fewer than three corners; export the mesh again");
      for (std::size_t k = begin; k + 2 < i; ++k) {
        const std::size_t odd = (k - begin) % 2;
        for (std::size_t at : {k, k + 1 + odd, k + 2 - odd})
          soup_.corners.push_back(vertex(list_[at], "triangle strip", row));
        soup_.sizes.push_back(3);
      }
      begin = i + 1;
    }
  }

  Rows rows_;
  const InputFile& file_;
  const PlyHeader& header_;
  std::size_t vertex_count_ = 0;
  PolygonSoup soup_;
  std::vector<double> values_, list_;
};

}  // namespace

ReadMesh read_ply(InputFile& file) {
  const auto kind = file_kind(file.bytes);
  refuse_other_kind(file, "a PLY mesh", ".ply");
  const std::size_t start = std::min(file.bytes.find_first_not_of("\xEF\xBB\xBF"), file.bytes.size());
  if (!kind || file.bytes.compare(start, 3, "ply") != 0)
    file.fail("does not begin with 'ply', so it is not a PLY mesh; check the file's content");
  const PlyHeader header = read_ply_header(file);
  if (header.encoding != PlyEncoding::text) return PlyReader(BinaryRows(file, header), file, header).read();
  make_text(file, "a PLY mesh in text", header.lines + 1);
  return PlyReader(TextRows(file, header), file, header).read();
}

}  // namespace fc::mesh_formats
