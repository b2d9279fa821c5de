// The readers: the same mesh in every format comes back the same; polygons; the bunny.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <cstring>

#include "common/exact_collinear.hpp"
#include "tests/mesh/test_meshes.hpp"

namespace fc {
namespace {

using test::TemporaryFile;

TriangleMesh load(const std::string& name, const std::string& bytes) {
  return load_mesh(TemporaryFile(name, bytes).path);
}

template <class Number>
std::string bytes_of(Number number, bool big_endian = false) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());  // the tests run on little-endian machines
  return bytes;
}

void expect_same(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
}

// Coordinates of 22 binary digits after the point: they need nearly all the digits of a float, and fit into
// one. (Not by a cast to float and back: GCC 12 leaves both casts out when it vectorises them.)
TriangleMesh sample() {
  TriangleMesh mesh = test::sphere_mesh(1.7, 5);
  for (Vec3& v : mesh.vertices) {
    for (double& x : v) x = std::ldexp(std::nearbyint(std::ldexp(x, 22)), -22);
  }
  return mesh;
}

std::string obj_text(const TriangleMesh& mesh) {
  std::string text = "# a comment\no thing\r\nvn 0 0 1\n";
  for (const Vec3& v : mesh.vertices) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (const auto& [i, j, k] : mesh.triangles) text += fmt::format("f {}//1 {}/7 {}\n", i + 1, j + 1, k + 1);
  return text;
}

TEST(ReadObj, RoundTripKeepsEveryDigit) {
  expect_same(load("a.obj", obj_text(sample())), sample());
}

TEST(ReadObj, DoublesAreReadExactly) {
  const TriangleMesh mesh =
      load("a.OBJ", "v 0.1 1e-3 +123456.789012345678\nv 1 4.9e-324 1e-400\nv 0 1 -.5 1.0\nf 1 2 3\n");
  EXPECT_EQ(mesh.vertices[0], Vec3(0.1, 1e-3, 123456.789012345678));
  EXPECT_EQ(mesh.vertices[1], Vec3(1, 4.9e-324, 0));
  EXPECT_EQ(mesh.vertices[2], Vec3(0, 1, -0.5));
}

TEST(ReadObj, NegativeIndicesCountBackAndForwardReferencesWork) {
  const TriangleMesh mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nf 1 2 4\nv 0 0 1");
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 1, 3}}));
}

TEST(ReadObj, FacesContinueAndCommentsEndThem) {
  const TriangleMesh mesh = load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n\tf 1 2 \\\n 3 # the only one\n");
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}}));
}

TEST(ReadObj, ConvexPolygonsBecomeFans) {
  const TriangleMesh mesh = load("a.obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n");
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<int, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

// The polygon's triangles have its area only if none of them lies outside it or over another.
void expect_covers(const std::string& vertices_and_face, double polygon_area, const Vec3& normal) {
  const TriangleMesh mesh = load("a.obj", vertices_and_face);
  EXPECT_EQ(mesh.triangles.size(), mesh.vertices.size() - 2);
  EXPECT_NEAR(test::area(mesh), polygon_area, 1e-15);
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 n = (mesh.vertices[j] - mesh.vertices[i]).cross(mesh.vertices[k] - mesh.vertices[i]);
    EXPECT_GT(n.dot(normal), 0);
  }
}

TEST(ReadObj, ConcavePolygonsAreCovered) {
  const std::string dart = "v 0 0 0\nv 4 2 0\nv 0 4 0\nv 1 2 0\n";  // a notch at the fourth corner
  expect_covers(dart + "f 1 2 3 4\n", 6, Vec3::UnitZ());
  expect_covers(dart + "f 2 3 4 1\n", 6, Vec3::UnitZ());
  expect_covers(dart + "f 3 4 1 2\n", 6, Vec3::UnitZ());
  expect_covers(dart + "f 4 1 2 3\n", 6, Vec3::UnitZ());
  expect_covers(dart + "f 4 3 2 1\n", 6, -Vec3::UnitZ());
  // A comb standing in the y-z plane.
  expect_covers(
      "v 5 0 0\nv 5 5 0\nv 5 5 3\nv 5 4 3\nv 5 4 1\nv 5 3 1\nv 5 3 3\nv 5 2 3\nv 5 2 1\nv 5 1 1\nv 5 1 3\nv "
      "5 0 3\n"
      "f 1 2 3 4 5 6 7 8 9 10 11 12\n",
      11, Vec3::UnitX());
  // A corner on a straight side: no triangle may have zero area, or a gap would open beside it.
  expect_covers("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4 5\n", 4, Vec3::UnitZ());
}

RC_GTEST_PROP(ReadObj, RandomStarsAreCovered, ()) {
  auto random = test::random_engine();
  const int n = *rc::gen::inRange(4, 40);
  std::uniform_real_distribution<double> radius(0.2, 1);
  std::vector<Vec3> ring;
  std::string text, face = "f";
  double twice_area = 0;
  const Mat3 turn = test::random_rotation(random);
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * i / n;
    ring.push_back(radius(random) * Vec3(std::cos(angle), std::sin(angle), 0));
    const Vec3 p = turn * ring.back();
    text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
    face += fmt::format(" {}", i + 1);
  }
  for (int i = 0; i < n; ++i) twice_area += ring[i].cross(ring[(i + 1) % n]).z();
  const TriangleMesh mesh = load("a.obj", text + face + "\n");
  RC_ASSERT(std::abs(test::area(mesh) - twice_area / 2) < 1e-13);
}

std::string stl_binary(const TriangleMesh& mesh, std::string header) {
  header.resize(80, ' ');
  std::string bytes = header + bytes_of(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    bytes += std::string(12, '\0');
    for (int v : t) {
      for (int axis = 0; axis < 3; ++axis) bytes += bytes_of(static_cast<float>(mesh.vertices[v][axis]));
    }
    bytes += "\7\7";
  }
  return bytes;
}

TEST(ReadStl, Binary) {
  expect_same(load("a.stl", stl_binary(sample(), "made by a test")), test::torn_apart(sample()));
}

TEST(ReadStl, BinaryThatBeginsWithSolid) {
  expect_same(load("a.stl", stl_binary(sample(), "solid made by a test")), test::torn_apart(sample()));
}

TEST(ReadStl, AsciiWithTwoSolidsAndAnyLineBreaks) {
  std::string text = "solid the first one\n";
  const TriangleMesh mesh = sample();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    text += "facet normal 0 0 0\r\n outer loop\r\n";
    for (int v : mesh.triangles[i]) {
      const Vec3& p = mesh.vertices[v];
      text += fmt::format("  vertex {:.17e} {} {}\n", p.x(), p.y(), p.z());
    }
    text += i % 2 ? "endloop endfacet\n" : " endloop\n\n endfacet\n";
    if (i == 5) text += "endsolid the first one\nsolid\n";
  }
  expect_same(load("a.stl", text + "endsolid"), test::torn_apart(mesh));
}

TEST(ReadPly, AsciiWithExtras) {
  std::string text =
      "ply\r\nformat ascii 1.0\r\ncomment extras come first, in the middle and last\r\nobj_info none\r\n"
      "element camera 1\r\nproperty list uchar float view\r\nproperty int id\r\nelement vertex {}\r\n"
      "property uchar red\r\nproperty double z\r\nproperty float64 x\r\nproperty list int8 int16 "
      "tags\r\nproperty float32 y\r\n"
      "element face {}\r\nproperty float quality\r\nproperty list uchar uint vertex_index\r\nelement edge "
      "2\r\n"
      "property int a\r\nend_header\r\n3 1 2 3 9\r\n";
  const TriangleMesh mesh = sample();
  text.replace(text.find("{}"), 2, std::to_string(mesh.vertices.size()));
  text.replace(text.find("{}"), 2, std::to_string(mesh.triangles.size()));
  for (const Vec3& v : mesh.vertices) text += fmt::format("255 {} {} 2 -5 6 {}\r\n", v.z(), v.x(), v.y());
  for (const auto& [i, j, k] : mesh.triangles) text += fmt::format("0.5 3 {} {} {}\r\n", i, j, k);
  expect_same(load("a.ply", text + "1\r\n2\r\n"), mesh);
}

std::string ply_binary(const TriangleMesh& mesh, bool big) {
  std::string bytes = fmt::format(
      "ply\nformat binary_{}_endian 1.0\nelement vertex {}\nproperty double z\nproperty list ushort char "
      "tags\n"
      "property float x\nproperty short w\nproperty float y\nelement face {}\nproperty list int uint "
      "vertex_indices\n"
      "property uint8 flag\nelement rest 1\nproperty double a\nend_header\n",
      big ? "big" : "little", mesh.vertices.size(), mesh.triangles.size());
  for (const Vec3& v : mesh.vertices) {
    bytes += bytes_of(v.z(), big) + bytes_of<std::uint16_t>(2, big) + "ab" +
             bytes_of(static_cast<float>(v.x()), big) + bytes_of<std::int16_t>(-3, big) +
             bytes_of(static_cast<float>(v.y()), big);
  }
  for (const auto& t : mesh.triangles) {
    bytes += bytes_of<std::int32_t>(3, big);
    for (int v : t) bytes += bytes_of(static_cast<std::uint32_t>(v), big);
    bytes += '\1';
  }
  return bytes + bytes_of(1.0, big);
}

TEST(ReadPly, BinaryOfBothByteOrders) {
  expect_same(load("a.ply", ply_binary(sample(), false)), sample());
  expect_same(load("a.ply", ply_binary(sample(), true)), sample());
}

TEST(ReadPly, PolygonsAreSplit) {
  const TriangleMesh mesh =
      load("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
           "0 0 0\n4 2 0\n0 4 0\n1 2 0\n4 0 1 2 3\n");
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(test::area(mesh), 6);
}

// An independent reader agrees on the real mesh, but for its rounding of the last digits.
TEST(ReadObj, BunnyAsTinyobjloaderReadsIt) {
  if (!std::filesystem::exists(test::kBunny)) GTEST_SKIP() << "skipped: no " << test::kBunny;
  const TriangleMesh mesh = load_mesh(test::kBunny);
  tinyobj::ObjReader peer;
  ASSERT_TRUE(peer.ParseFromFile(test::kBunny));
  const auto& coordinates = peer.GetAttrib().vertices;
  ASSERT_EQ(3 * mesh.vertices.size(), coordinates.size());
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    ASSERT_NEAR(mesh.vertices[i / 3][i % 3], coordinates[i], 1e-15);
  std::size_t t = 0;
  for (const auto& shape : peer.GetShapes()) {
    for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3, ++t) {
      for (int k = 0; k < 3; ++k) ASSERT_EQ(mesh.triangles[t][k], shape.mesh.indices[i + k].vertex_index);
    }
  }
  EXPECT_EQ(t, mesh.triangles.size());
}

TEST(ExactCollinear, DecidesWhatRoundingHides) {
  EXPECT_TRUE(exactly_collinear({0, 0, 0}, {1, 2, 3}, {3, 6, 9}));
  EXPECT_TRUE(exactly_collinear({1, 2, 3}, {1, 2, 3}, {7, 5, 1}));
  EXPECT_FALSE(exactly_collinear({0, 0, 0}, {1, 3, 0}, {0.1, 0.3, 0}));  // 0.3 != 3 * 0.1 in doubles
  const double ulp = std::ldexp(1.0, -52);
  const Vec3 a(1, 1, 1), b(1 + ulp, 1 + ulp, 1 + ulp), c(2, 2, 2);
  EXPECT_TRUE(exactly_collinear(a, b, c));
  EXPECT_FALSE(exactly_collinear(a, b, {2, 2, 2 + 2 * ulp}));
  EXPECT_FALSE(exactly_collinear({0, 0, 5}, {0, 1e-100, 5}, {1, 0, 5}));
}

// Integers are exact, so that the determinants of small integers are the truth; the points are then scaled by
// powers of two.
RC_GTEST_PROP(ExactCollinear, AgreesWithIntegers, ()) {
  auto random = test::random_engine();
  std::uniform_int_distribution<int> small(-3, 3);
  const auto point = [&] {
    const int x = small(random), y = small(random);
    return Vec3(x, y, small(random));
  };
  const Vec3 a = point(), b = point(), c = point();
  const bool truth = (b - a).cross(c - a).isZero(0);
  const double scale = std::ldexp(1.0, *rc::gen::inRange(-300, 300));
  const Vec3 far(1e9, -3e9, 7e9);
  RC_ASSERT(exactly_collinear(a * scale, b * scale, c * scale) == truth);
  RC_ASSERT(exactly_collinear(a + far, b + far, c + far) == truth);
}

}  // namespace
}  // namespace fc
