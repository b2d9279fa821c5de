// Opening a mesh file, and choosing its reader.
#include <algorithm>
#include <cctype>

#include "common/mesh_formats.hpp"

namespace fc {

TriangleMesh load_mesh(const std::filesystem::path& path, std::string* left_out) {
  using namespace mesh_formats;
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  InputFile file = read_input_file(path, "a mesh");
  if (file.bytes.empty()) file.fail("is empty; export the mesh again");
  const auto read = extension == ".obj"   ? read_obj
                    : extension == ".stl" ? read_stl
                    : extension == ".ply" ? read_ply
                                          : nullptr;
  if (!read) {
    const auto kind = file_kind(file.bytes);
    if (kind) file.fail(std::string("is ") + kind->name + " by its content; " + kind->advice);
    file.fail("has an extension that names no mesh format we read; convert it to .obj, .stl or .ply");
  }
  ReadMesh result = read(file);
  if (left_out) *left_out = std::move(result.left_out);
  return std::move(result.mesh);
}

}  // namespace fc
