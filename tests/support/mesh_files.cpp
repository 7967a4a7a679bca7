#include "support/mesh_files.h"

#include <stdlib.h>

#include <cstring>
#include <fstream>
#include <iterator>

namespace aplomb::test {

namespace fs = std::filesystem;

std::vector<std::byte> bytes_of(std::string_view text) {
  const auto* data = reinterpret_cast<const std::byte*>(text.data());
  return {data, data + text.size()};
}

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Result<MeshFile> read_text(std::string_view text, std::string_view name, const ReadOptions& options) {
  return read_mesh(bytes_of(text), name, options);
}

std::string binary_stl(std::uint32_t count, const std::vector<float>& corners, std::string_view header) {
  std::string file(80, ' ');
  file.replace(0, header.size(), header);
  file.append(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t facet = 0; 9 * facet < corners.size(); ++facet) {
    file.append(12, '\0');
    file.append(reinterpret_cast<const char*>(corners.data() + 9 * facet), 36);
    file.append(2, '\0');
  }
  return file;
}

std::vector<Vec3> corner_positions(const TriangleMesh& mesh) {
  std::vector<Vec3> positions;
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle) positions.push_back(mesh.vertices.at(corner));
  return positions;
}

TempFolder::TempFolder() {
  std::string name = (fs::temp_directory_path() / "aplomb-test-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw std::runtime_error("no temporary folder can be made");
  path_ = name;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  fs::permissions(path_, fs::perms::owner_all, ignored);
  fs::remove_all(path_, ignored);
}

std::size_t TempFolder::entries() const {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
}

void write_text(const fs::path& path, std::string_view text) {
  std::ofstream(path, std::ios::binary).write(text.data(), static_cast<std::streamsize>(text.size()));
}

std::string read_text_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace aplomb::test
