// Every broken file is refused with exactly the line that expected.txt gives for it.
#include <gtest/gtest.h>

#include <set>

#include "common/errors.hpp"
#include "tests/mesh/test_meshes.hpp"

namespace fc {
namespace {

const std::filesystem::path kFolder = FC_SOURCE_DIR "/tests/data/broken_meshes";

// File name -> expected message, with {file} for its path.
std::map<std::string, std::string> expectations() {
  std::map<std::string, std::string> result;
  std::ifstream list(kFolder / "expected.txt");
  for (std::string line; std::getline(list, line);) {
    const auto bar = line.find(" | ");
    if (!line.starts_with("#") && bar != std::string::npos)
      result[line.substr(0, bar)] = line.substr(bar + 3);
  }
  return result;
}

std::string refusal(const std::filesystem::path& file) {
  try {
    load_mesh(file);
  } catch (const InputError& error) {
    return error.what();
  }
  return "(loaded without an error)";
}

TEST(BrokenMesh, IsRefusedWithTheExpectedLine) {
  const auto expected = expectations();
  ASSERT_GE(expected.size(), 15u);
  for (auto [name, message] : expected) {
    const std::string path = (kFolder / name).string();
    ASSERT_TRUE(message.starts_with("{file}:")) << name;
    message.replace(0, 6, path);
    EXPECT_EQ(refusal(path), message);
    EXPECT_EQ(message.find('\n'), std::string::npos) << name;
    EXPECT_NE(message.find("; "), std::string::npos) << name << ": a message says what to do";
  }
}

TEST(BrokenMesh, EveryFileOfTheFolderIsListed) {
  const auto expected = expectations();
  std::set<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kFolder))
    files.insert(entry.path().filename().string());
  files.erase("expected.txt");
  EXPECT_EQ(files.size(), expected.size());
  for (const std::string& name : files)
    EXPECT_TRUE(expected.contains(name)) << name << " is not in expected.txt";
}

TEST(BrokenMesh, MissingFileAndFolder) {
  EXPECT_EQ(refusal("no_such_file.obj"), "no_such_file.obj: no such file; check the path");
  EXPECT_EQ(refusal(kFolder), kFolder.string() + ": is a folder; name a mesh file in it");
}

// Whatever is cut off or changed in a good file, the reader answers: a mesh with valid indices and finite
// coordinates, or one line. (The sanitizers watch the memory.)
TEST(BrokenMesh, RandomDamageIsRefusedOrHarmless) {
  const std::string ascii_ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty double y\nproperty float z\n"
      "property uchar red\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  std::string binary_ply = ascii_ply.substr(0, ascii_ply.find("0 0 0 1\n"));
  binary_ply.replace(binary_ply.find("ascii"), 5, "binary_little_endian");
  binary_ply += std::string(4 * 17, '\0');
  for (char i : {0, 1, 2, 3}) binary_ply += std::string{3, 0, 0, 0, 0, 1, 0, 0, 0, i, 0, 0, 0};
  const std::vector<std::pair<std::string, std::string>> good = {
      {"mesh.obj",
       "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1/1 2/2 4/1\nf 2//1 3//1 -1//2\nf 1 4 3\n"},
      {"mesh.stl",
       "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
       "0\nendloop\nendfacet\n"
       "endsolid s\n"},
      {"mesh.stl", std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, '\0')},
      {"mesh.ply", ascii_ply},
      {"mesh.ply", binary_ply}};
  for (const auto& [name, text] : good)
    ASSERT_NO_THROW(load_mesh(test::TemporaryFile(name, text).path)) << text;
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 3000; ++trial) {
    const auto& [name, text] = good[trial % good.size()];
    std::string damaged = text;
    for (int change = 0; change < 1 + trial % 3; ++change) {
      const std::size_t at = random() % damaged.size();
      switch (random() % 4) {
        case 0:
          damaged[at] = static_cast<char>(random());
          break;
        case 1:
          damaged[at] = "0123456789-+.enif/ \n"[random() % 20];
          break;
        case 2:
          damaged.erase(at, random() % 9);
          break;
        case 3:
          damaged.insert(at, damaged.substr(random() % damaged.size(), 9));
          break;
      }
      if (damaged.empty()) damaged = " ";
    }
    const test::TemporaryFile file(name, damaged);
    try {
      const TriangleMesh mesh = load_mesh(file.path);
      ASSERT_FALSE(mesh.triangles.empty());
      for (const Vec3& v : mesh.vertices) ASSERT_TRUE(v.allFinite()) << damaged;
      for (const auto& t : mesh.triangles) {
        for (int v : t) ASSERT_TRUE(v >= 0 && v < static_cast<int>(mesh.vertices.size())) << damaged;
      }
      prepare_mesh(mesh);
    } catch (const InputError& error) {
      const std::string line = error.what();
      ASSERT_TRUE(line.starts_with(file.path.string() + ":")) << line;
      ASSERT_EQ(line.find('\n'), std::string::npos) << line;
    }
  }
}

}  // namespace
}  // namespace fc
