// Wavefront OBJ: the lines "v x y z" and "f a b c ...". Of the format's other lines, those about appearance
// and names are skipped, lines and points are counted and reported, and free-form surfaces are refused. A
// line that begins with anything else is refused: it may be geometry.
#include <algorithm>
#include <array>
#include <limits>

#include "common/mesh_formats.hpp"
#include "common/number_text.hpp"
#include "common/text.hpp"

namespace fc::mesh_formats {
namespace {

// Names, groups, materials, texture coordinates, normals, and how a renderer should draw.
constexpr std::array<std::string_view, 17> kPassedOver = {
    "vt",     "vn",     "vp",    "g",        "o",        "s",   "mg",         "usemtl",   "mtllib",
    "usemap", "maplib", "bevel", "c_interp", "d_interp", "lod", "shadow_obj", "trace_obj"};

// Curves and surfaces by formulas, and the older words for them.
constexpr std::array<std::string_view, 21> kFreeForm = {
    "cstype", "deg", "bmat", "step",  "curv",  "curv2", "surf", "parm", "trim", "hole", "scrv",
    "sp",     "end", "con",  "ctech", "stech", "bsp",   "bzp",  "cdc",  "cdp",  "res"};

template <std::size_t n>
bool is_one_of(std::string_view word, const std::array<std::string_view, n>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

struct ObjReader {
  TextCursor cursor;
  PolygonSoup soup;
  int largest_index = -1;  // that a face named so far, and where
  SourceMark largest_index_mark = {};
  bool continues = false;  // a backslash ended the last word's line
  int lines = 0, points = 0;

  // The next word of the statement: a backslash at a line's end continues it in the next line, a comment ends
  // it. Empty at its end.
  std::string_view next() {
    for (;;) {
      if (continues) cursor.next_line();
      continues = false;
      std::string_view word = cursor.word();
      if (word.empty() || word.front() == '#') return {};
      continues = word.back() == '\\' && cursor.at_line_end();
      if (continues) word.remove_suffix(1);
      if (!word.empty()) return word;
    }
  }

  double coordinate(const char* what) { return checked_coordinate(cursor.number(next(), what), cursor); }

  void vertex() {
    const double x = coordinate("the x coordinate");
    const double y = coordinate("the y coordinate");
    const double z = coordinate("the z coordinate");
    soup.vertices.emplace_back(x, y, z);
    int numbers = 3;  // a weight, a colour, or both may follow
    for (std::string_view word = next(); !word.empty(); word = next(), ++numbers)
      cursor.number(word, "a weight or a colour");
    if (numbers == 5 || numbers > 7)
      cursor.fail("a vertex of " + std::to_string(numbers) +
                  " numbers; write x y z, and after them at most a weight and a colour r g b");
  }

  [[noreturn]] void refuse_corner(std::string_view word) const {
    cursor.fail("expected a vertex index, found " + in_quotes(word) +
                "; write 'f 1 2 3' or 'f 1/1/1 2/2/2 3/3/3'");
  }

  // What follows the vertex in a corner: up to two slashes, with or without a whole number after each.
  void check_rest_of_corner(std::string_view word, std::size_t slash) const {
    for (int parts = 0; slash < word.size(); ++parts) {
      const std::size_t next_slash = std::min(word.find('/', slash + 1), word.size());
      const std::string_view index = word.substr(slash + 1, next_slash - slash - 1);
      long long ignored = 0;
      if (parts == 2 || (!index.empty() && read_whole_number(index, ignored) != std::errc()))
        refuse_corner(word);
      slash = next_slash;
    }
  }

  // One corner "v", "v/t", "v//n" or "v/t/n"; negative indices count back from the last vertex.
  int corner(std::string_view word) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    const std::string_view index_text = word.substr(0, slash);
    long long index = 0;
    const std::errc error = read_whole_number(index_text, index);
    const bool too_long = error == std::errc::result_out_of_range;
    if (error == std::errc::invalid_argument) refuse_corner(word);
    check_rest_of_corner(word, slash);
    const auto count = static_cast<long long>(soup.vertices.size());
    if (index == 0 && !too_long)
      cursor.fail("vertex index 0; OBJ counts vertices from 1: export the mesh again");
    if (too_long || index < -count || index > std::numeric_limits<int>::max()) {
      cursor.fail("vertex index " + in_quotes(index_text) + " is out of range: the file has " +
                  std::to_string(count) + " vertices up to this line; export the mesh again");
    }
    const int zero_based = static_cast<int>(index > 0 ? index - 1 : count + index);
    if (zero_based > largest_index) {  // a face may name a vertex that a later line defines
      largest_index = zero_based;
      largest_index_mark = cursor.mark();
    }
    return zero_based;
  }

  void face() {
    int size = 0;
    for (std::string_view word = next(); !word.empty(); word = next(), ++size)
      soup.corners.push_back(corner(word));
    if (size < 3) cursor.fail("a face with fewer than three corners; complete it, or remove its line");
    if (size > kMaxCorners) cursor.fail("a face with more than 10000 corners; export the mesh as triangles");
    soup.sizes.push_back(size);
  }

  // Skips a statement to its last line. A name may end with a backslash by mistake, and the line below it
  // must not be lost.
  void pass_over() {
    continues = false;
    while (cursor.line_continues() && !cursor.at_end()) {
      cursor.next_line();
      const std::string_view word = TextCursor(cursor).word();
      if (word != "v" && word != "f") continue;
      cursor.word();
      cursor.fail("the line above ends with a backslash, so " + in_quotes(word) +
                  " would belong to it; remove the backslash");
    }
  }

  void statement(std::string_view keyword) {
    if (keyword == "v") return vertex();
    if (keyword == "f" || keyword == "fo") return face();
    if (keyword.empty()) return;
    if (is_one_of(keyword, kFreeForm))
      cursor.fail(in_quotes(keyword) +
                  " belongs to a free-form curve or surface, which is not read; export triangles");
    if (keyword == "call" || keyword == "csh")
      cursor.fail(in_quotes(keyword) +
                  " would include another file, which is not supported; export one file");
    lines += keyword == "l";
    points += keyword == "p";
    if (keyword != "l" && keyword != "p" && !is_one_of(keyword, kPassedOver))
      cursor.fail("unknown keyword " + in_quotes(keyword) +
                  "; OBJ has v, f, vn, vt, o, g, s, usemtl and others; correct it, or put # "
                  "before it to leave the line out");
    pass_over();
  }
};

std::string counted(int number, const char* one, const char* many) {
  return number == 0 ? "" : std::to_string(number) + " " + (number == 1 ? one : many);
}

}  // namespace

ReadMesh read_obj(InputFile& file) {
  refuse_other_kind(file, "an OBJ mesh", ".obj");
  make_text(file, "an OBJ mesh");
  ObjReader reader{TextCursor(file), {}};
  for (; !reader.cursor.at_end(); reader.cursor.next_line()) reader.statement(reader.next());
  const auto count = static_cast<int>(reader.soup.vertices.size());
  if (reader.soup.sizes.empty()) {
    file.fail("has no triangles; an OBJ mesh needs lines 'v x y z' and 'f a b c'");
  }
  if (reader.largest_index >= count) {
    throw InputError(reader.largest_index_mark, "vertex index " + std::to_string(reader.largest_index + 1) +
                                                    " is out of range: the file has " +
                                                    std::to_string(count) +
                                                    " vertices; export the mesh again");
  }
  const std::string lines = counted(reader.lines, "line", "lines");
  const std::string points = counted(reader.points, "set of points", "sets of points");
  return {triangulate(std::move(reader.soup)),
          lines + (lines.empty() || points.empty() ? "" : ", ") + points};
}

}  // namespace fc::mesh_formats
