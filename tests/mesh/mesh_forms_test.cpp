// Meshes as people's tools write them: byte order marks, line ends, forms of numbers, capitals, orders of elements; and
// files that are no mesh, or have an unknown line, are refused for what they are.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "common/errors.hpp"
#include "common/mass_properties.hpp"
#include "tests/mesh/test_meshes.hpp"
#include "tests/support/text_forms.hpp"

namespace fc {
namespace {

using fc_test::forms_of;
using test::TemporaryFile;

TriangleMesh load(const std::string& name, const std::string& bytes) {
  return load_mesh(TemporaryFile(name, bytes).path);
}

// The line that refuses it, without the folder; or "loaded".
std::string refusal(const std::string& name, const std::string& bytes) {
  const TemporaryFile file(name, bytes);
  try {
    load_mesh(file.path);
  } catch (const InputError& error) {
    const std::string line = error.what(), folder = file.path.parent_path().string() + "/";
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_TRUE(line.starts_with(folder)) << line;
    return line.substr(folder.size());
  }
  return "loaded";
}

// A tetrahedron with legs of 3 m, whose volume is 4.5 m^3, with {} where a 3 stands; and a vertex that no face
// uses.
const std::string kObj =
    "v 0 0 0\nv {0} 0 0\nv 0 {0} 0\nv 0 0 {0}\nv 9 9 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
const std::string kPly =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n{0} 0 0\n0 {0} 0\n0 0 {0}\n9 9 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";

std::string stl_text() {
  std::string text = "solid by hand\n";
  for (const char* corners : {"132", "124", "234", "143"}) {
    text += "  facet normal 0 0 1\n    outer loop\n";
    for (const char* c = corners; *c; ++c)
      text += *c == '1'   ? "      vertex 0 0 0\n"
              : *c == '2' ? "      vertex {0} 0 0\n"
              : *c == '3' ? "      vertex 0 {0} 0\n"
                          : "      vertex 0 0 {0}\n";
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid by hand\n";
}

struct Format {
  std::string name, text;
};
const std::vector<Format>& formats() {
  static const std::vector<Format> all = {{"mesh.obj", kObj}, {"mesh.ply", kPly}, {"mesh.stl", stl_text()}};
  return all;
}

std::string with_three(const std::string& text, const std::string& three) {
  return fmt::format(fmt::runtime(text), three);
}

void expect_same(const TriangleMesh& a, const TriangleMesh& b, const std::string& what) {
  EXPECT_EQ(a.vertices, b.vertices) << what;
  EXPECT_EQ(a.triangles, b.triangles) << what;
}

TEST(MeshForms, MarksAndLineEndsChangeNothing) {
  for (const Format& format : formats()) {
    const std::string text = with_three(format.text, "3");
    const TriangleMesh plain = load(format.name, text);
    EXPECT_EQ(solid_mass(prepare_mesh(plain).mesh, 1000).mass, 4500) << format.name;
    for (const auto& [form, bytes] : forms_of(text))
      expect_same(load(format.name, bytes), plain, format.name + " with " + form);
  }
}

TEST(MeshForms, FormsOfNumbersChangeNothing) {
  for (const Format& format : formats()) {
    const TriangleMesh plain = load(format.name, with_three(format.text, "3"));
    for (const std::string& three : fc_test::kThrees)
      expect_same(load(format.name, with_three(format.text, three)), plain, format.name + " with " + three);
    for (const std::string& no_number : fc_test::kNoNumbers) {
      const std::string line = refusal(format.name, with_three(format.text, no_number));
      EXPECT_TRUE(line.find("found '" + no_number + "'") != std::string::npos ||
                  line.find("a coordinate is not finite") != std::string::npos)
          << line;
    }
  }
}

// A place is that which an editor shows, in every form.
TEST(MeshForms, PlacesAreTheSameInEveryForm) {
  for (const auto& [form, bytes] : forms_of("v 0 0 0\n# a remark\nv  one 0 0\n"))
    EXPECT_EQ(refusal("a.obj", bytes), "a.obj:3:4: expected the x coordinate, found 'one'; write a number")
        << form;
  for (const auto& [form, bytes] : forms_of(with_three(kPly, "x")))
    EXPECT_EQ(refusal("a.ply", bytes), "a.ply:12:1: expected a value of the row, found 'x'; write a number")
        << form;
}

// As where two files were joined.
TEST(MeshForms, AMarkInTheMiddleIsSeen) {
  EXPECT_TRUE(refusal("a.obj", "v 0 0 0\n\xEF\xBB\xBFv 1 0 0\n")
                  .starts_with("a.obj:2:1: unknown keyword '\\xef\\xbb\\xbfv'; "));
}

TEST(MeshForms, WholeNumbers) {
  const std::string obj = with_three(kObj, "3");
  const auto first_face = [&](const std::string& face) {
    return obj.substr(0, obj.find("f 1 3 2")) + face + obj.substr(obj.find("f 1 3 2") + 7);
  };
  for (const char* face : {"f +1 3 2", "f +1/+7/+3 3//1 2/5", "f 1/ 3// 2", "f 1 3\\\n 2",
                           "f 1 \\\n3 2 # the floor", "fo 1 3 2"})
    expect_same(load("a.obj", first_face(face)), load("a.obj", obj), face);
  for (const char* corner : {"1.0", "1e0", "+-1", "1/2.0", "1/2/3/4", "1/x", "0x1", "1,"})
    EXPECT_EQ(refusal("a.obj", first_face(std::string("f ") + corner + " 3 2")),
              std::string("a.obj:6:3: expected a vertex index, found '") + corner +
                  "'; write 'f 1 2 3' or 'f 1/1/1 2/2/2 3/3/3'");
  const std::string ply = with_three(kPly, "3");
  const auto row = [&](const std::string& first) {
    return ply.substr(0, ply.find("3 0 2 1")) + first + ply.substr(ply.find("3 0 2 1") + 7);
  };
  expect_same(load("a.ply", row("+3 +0 2 +1")), load("a.ply", ply), "+3");
  EXPECT_EQ(refusal("a.ply", row("3 0 2.0 1")),
            "a.ply:16:5: expected a vertex's number, found '2.0'; write a whole number");
  EXPECT_EQ(refusal("a.ply", row("3.0 0 2 1")),
            "a.ply:16:1: expected a list's length, found '3.0'; write a whole number");
}

TEST(MeshForms, ObjVerticesMayHaveWeightsAndColours) {
  for (const char* more : {"", " 1.0", " 0.5 .25 1", " 1 0.5 .25 1", " 1 # heavy"})
    expect_same(load("a.obj", "v 0 0 9" + std::string(more) + "\n" + with_three(kObj, "3").substr(8)),
                load("a.obj", "v 0 0 9\n" + with_three(kObj, "3").substr(8)), more);
  EXPECT_EQ(
      refusal("a.obj", "v 0 0 0 1 2\n"),
      "a.obj:1:12: a vertex of 5 numbers; write x y z, and after them at most a weight and a colour r g b");
  EXPECT_EQ(refusal("a.obj", "v 0 0 0 red\n"),
            "a.obj:1:9: expected a weight or a colour, found 'red'; write a number");
}

TEST(MeshForms, ObjKnownLinesArePassedOverAndTold) {
  const std::string text = with_three(kObj, "3");
  for (const char* line :
       {"o a", "g a b \\\n c d", "s off", "mg 1 2", "usemtl red", "mtllib a.mtl", "vt 0 0", "vn 0 0 1",
        "vp 0", "bevel on", "lod 3", "# v 1 2 3 \\", "", "  \t", "shadow_obj a.obj"})
    expect_same(load("a.obj", line + ("\n" + text)), load("a.obj", text), line);
  const TemporaryFile file("a.obj", text + "l 1 2 3\nl 1 2\np 5\n");
  std::string left_out;
  load_mesh(file.path, &left_out);
  EXPECT_EQ(left_out, "2 lines, 1 set of points");
  EXPECT_EQ(
      refusal("a.obj", text + "cstype bspline\n"),
      "a.obj:10:1: 'cstype' belongs to a free-form curve or surface, which is not read; export triangles");
  EXPECT_EQ(refusal("a.obj", text + "call b.obj\n"),
            "a.obj:10:1: 'call' would include another file, which is not supported; export one file");
  EXPECT_EQ(
      refusal("a.obj", "usemtl C:\\red\\\n" + text),
      "a.obj:2:1: the line above ends with a backslash, so 'v' would belong to it; remove the backslash");
}

// A line that begins with a word that the format does not know never goes unnoticed, wherever it stands.
RC_GTEST_PROP(MeshForms, UnknownFirstWordsAreRefusedWithTheirPlace, ()) {
  const std::set<std::string> known = {"v",  "f",  "fo", "l",   "p",  "o",   "g",   "s",  "mg",
                                       "vt", "vn", "vp", "lod", "sp", "con", "deg", "end"};
  const std::string word =
      *rc::gen::container<std::string>(*rc::gen::inRange(1, 6), rc::gen::inRange<char>('!', '~'));
  RC_PRE(!known.contains(word) && word[0] != '#' && word.back() != '\\');
  for (const Format& format : formats()) {
    const std::string text = with_three(format.text, "3");
    std::vector<std::size_t> starts = {0};
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
      if (text[i] == '\n') starts.push_back(i + 1);
    }
    const auto line = *rc::gen::inRange<std::size_t>(format.name == "mesh.obj" ? 0 : 1, starts.size());
    std::string changed = text;
    changed.insert(starts[line], word + " 0 2 1\n");
    const std::string message = refusal(format.name, changed);
    RC_ASSERT(message != "loaded");
    if (format.name == "mesh.ply")
      continue;  // of a number too many the next line or the last one may be told
    RC_ASSERT(message.starts_with(fmt::format("{}:{}:1: ", format.name, line + 1)));
    RC_ASSERT(message.find("'" + word + "'") != std::string::npos);
  }
}

TEST(MeshForms, StlInCapitalsAndWithOddNormals) {
  const std::string text = with_three(stl_text(), "3");
  std::string capitals = text;
  for (char& c : capitals) c = static_cast<char>(std::toupper(c));
  expect_same(load("a.STL", capitals), load("a.stl", text), "capitals");
  for (const char* normal : {"nan nan nan", "-nan(ind) 0 0", "1.#QNAN -1.#IND 0", "+0.0E+00 0 1e-400"}) {
    std::string odd = text;
    odd.replace(odd.find("0 0 1"), 5, normal);
    expect_same(load("a.stl", odd), load("a.stl", text), normal);
  }
  std::string short_normal = text;
  short_normal.replace(short_normal.find("0 0 1"), 5, "0 0");
  EXPECT_EQ(refusal("a.stl", short_normal),
            "a.stl:2:19: the line ends where the normal's z should stand; complete it");
  EXPECT_EQ(refusal("a.stl", text + "facet normal 0 0 1\n"),
            "a.stl:31:1: expected 'solid' or the end of the file, found 'facet'; export the mesh again");
  std::string one_line = text;
  std::replace(one_line.begin(), one_line.end(), '\n', ' ');
  EXPECT_EQ(refusal("a.stl", one_line),
            "a.stl:1:23: 'facet normal' stands in the line of the solid's name; begin a new line before it");
}

TEST(MeshForms, PlyFacesMayComeFirst) {
  const std::string text = with_three(kPly, "3");
  const std::size_t vertex = text.find("element vertex"), face = text.find("element face"),
                    end = text.find("end_header"), rows = text.find("0 0 0\n"), faces = text.find("3 0 2 1");
  const std::string first = text.substr(0, vertex) + text.substr(face, end - face) +
                            text.substr(vertex, face - vertex) + "end_header\n" + text.substr(faces);
  expect_same(load("a.ply", first + text.substr(rows, faces - rows)), load("a.ply", text), "faces first");
  std::string too_far = first + text.substr(rows, faces - rows);
  too_far.replace(too_far.find("3 0 2 1"), 7, "3 0 5 1");
  EXPECT_EQ(
      refusal("a.ply", too_far),
      "a.ply:11:7: face 0 names vertex 5, but the file has 5 vertices, counted from 0; export the mesh again");
}

std::string strips(const std::string& row) {
  std::string text = with_three(kPly, "3");
  text.replace(text.find("element face 4"), 14, "element tristrips 1");
  text.replace(text.find("list uchar int"), 14, "list int int");
  return text.substr(0, text.find("3 0 2 1")) + row + "\n";
}

TEST(MeshForms, PlyTriangleStrips) {
  using Triangles = std::vector<std::array<int, 3>>;
  EXPECT_EQ(load("a.ply", strips("15 0 2 1 -1 0 1 3 -1 1 2 3 -1 0 3 2")).triangles,
            load("a.ply", with_three(kPly, "3")).triangles);
  EXPECT_EQ(load("a.ply", strips("6 0 1 2 3 0 -1")).triangles, (Triangles{{0, 1, 2}, {1, 3, 2}, {2, 3, 0}}))
      << "every second one turned";
  EXPECT_EQ(load("a.ply", strips("10 -1 0 1 2 3 -1 -1 1 2 3")).triangles.size(), 3u);
}

TEST(MeshForms, PlyWrongStrips) {
  EXPECT_EQ(refusal("a.ply", strips("5 0 1 2 -1 3")),
            "a.ply:16:12: a triangle strip with fewer than three corners; export the mesh again");
  EXPECT_EQ(
      refusal("a.ply", strips("3 0 1 5")),
      "a.ply:16:7: triangle strip 0 names vertex 5, but the file has 5 vertices, counted from 0; export the mesh again");
  EXPECT_EQ(
      refusal("a.ply", strips("3 0 1 -2")),
      "a.ply:16:7: triangle strip 0 names vertex -2, but the file has 5 vertices, counted from 0; export the mesh again");
}

TEST(MeshForms, PlyHeadersSayEverythingOnce) {
  const std::string text = with_three(kPly, "3");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    return refusal("a.ply", changed.replace(changed.find(from), from.size(), to));
  };
  EXPECT_EQ(
      with("element vertex 5", "element vertex 5 6"),
      "a.ply:4:18: found '6' after all that this line of the PLY header should have; export the mesh again");
  EXPECT_EQ(with("property float y", "property float x"),
            "a.ply:6:16: the property 'x' is there twice; export the mesh again");
  EXPECT_EQ(with("element face 4", "element vertex 4"),
            "a.ply:8:9: the element 'vertex' is there twice; export the mesh again");
  EXPECT_EQ(with("comment by hand", "format ascii 1.0"),
            "a.ply:3:1: a second line 'format'; export the mesh again");
  EXPECT_EQ(with("property float z", "property list uchar float z"),
            "a.ply: has vertices without x, y or z; export the mesh again");
  EXPECT_EQ(with("property float z", "property float"),
            "a.ply:7:15: a property without a name; export the mesh again");
  EXPECT_EQ(
      with("9 9 9", "9 9 9 9"),
      "a.ply:15:7: found '9' after the row's last value that the header describes; export the mesh again");
  const TemporaryFile edges("a.ply", "ply\nformat ascii 1.0\nelement edge 2\nproperty int a\n" +
                                         text.substr(text.find("element vertex"),
                                                     text.find("0 0 0\n") - text.find("element vertex")) +
                                         "1\n2\n" + text.substr(text.find("0 0 0\n")));
  std::string left_out;
  load_mesh(edges.path, &left_out);
  EXPECT_EQ(left_out, "2 rows of 'edge'");
}

// The byte after the header's last line end belongs to the rows, even if it is 10 or 13.
TEST(MeshForms, BinaryPlyHeadersOfEveryLineEnd) {
  std::string header =
      "ply\nformat binary_little_endian 1.0\nelement first 1\nproperty uchar byte\nelement vertex 3\nproperty char x\n"
      "property char y\nproperty char z\nelement face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
  for (const char byte : {'\n', '\r', '0'}) {
    const std::string rows = byte + std::string("\0\0\0\1\0\0\0\1\0\3\0\1\2", 13);
    for (const auto& [form, bytes] : forms_of(header)) {
      if (form.find("mixed") != std::string::npos) continue;
      const TriangleMesh mesh = load("a.ply", bytes + rows);
      EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << form << int{byte};
      EXPECT_EQ(mesh.triangles.size(), 1u);
    }
  }
}

std::string binary_stl(std::string header) {
  header.resize(80);
  return header + std::string("\1\0\0\0", 4) + std::string(50, '\0');
}

TEST(MeshForms, WhatIsNoMeshIsNamed) {
  const std::string obj = with_three(kObj, "3"), ply = with_three(kPly, "3"),
                    stl = with_three(stl_text(), "3");
  std::string utf16 = "\xff\xfe", bare16;
  for (char c : obj) bare16 += {c, '\0'};
  utf16 += bare16;
  const std::vector<std::pair<std::string, std::string>> contents = {
      {"\x1f\x8b\x08 packed", "gzip data"},
      {"PK\x03\x04 packed", "a zip archive"},
      {"<!DOCTYPE HTML>\n<html>", "a web page"},
      {"\n <html lang=en>", "a web page"},
      {"<?xml version=\"1.0\"?>\n<COLLADA>", "an XML file"},
      {"{\n \"asset\": {\"version\": \"2.0\"}}", "a glTF model"},
      {std::string("glTF\2\0\0\0", 8), "a binary glTF model"},
      {"OFF\n3 1 0\n", "an OFF mesh"},
      {utf16, "UTF-16 text"},
      {bare16, "UTF-16 text"},
      {"version https://git-lfs.github.com/spec/v1\n", "a pointer of Git LFS"},
      {"\x89PNG\r\n", "a PNG picture"},
      {obj, "an OBJ mesh"},
      {"\xEF\xBB\xBF# by hand\r" + obj, "an OBJ mesh"},
      {ply, "a PLY mesh"},
      {stl, "an STL mesh"},
      {binary_stl("PK\x03\x04 or anything"), "an STL mesh"},
  };
  for (const auto& [bytes, kind] : contents) {
    for (const std::string name : {"a.obj", "a.ply", "a.stl"}) {
      const std::string own = name == "a.obj"   ? "an OBJ mesh"
                              : name == "a.ply" ? "a PLY mesh"
                                                : "an STL mesh";
      const std::string line = refusal(name, bytes);
      if (kind == own) {
        EXPECT_EQ(line, "loaded") << name;
      } else {
        EXPECT_TRUE(line.starts_with(name + ": is " + kind + ", not " + own + "; ")) << line;
      }
    }
    EXPECT_TRUE(refusal("a.mesh", bytes).starts_with("a.mesh: is " + kind + " by its content; ")) << kind;
  }
  EXPECT_EQ(
      refusal("a.obj", obj.substr(0, 20) + '\0' + obj.substr(20)),
      "a.obj:3:5: a zero byte: binary data, so it is not an OBJ mesh; check the file's name and content");
  EXPECT_TRUE(refusal("a.stl", "# by hand\n" + stl).starts_with("a.stl:1:1: expected 'solid'"));
}

TEST(MeshForms, BinaryStlWithAnyHeaderLoads) {
  for (const char* header : {"solid facet", "ply", "OFF mesh", "v 1 2 3", "glTF", "\xEF\xBB\xBFsolid"})
    EXPECT_EQ(load("a.stl", binary_stl(header)).triangles.size(), 1u) << header;
}

}  // namespace
}  // namespace fc
