#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "aplomb/io/read_mesh.h"
#include "aplomb/io/write_mesh.h"
#include "aplomb/mesh/triangle_mesh.h"

/// Mesh files made in memory, and a folder that cleans up after itself.
namespace aplomb::test {

std::vector<std::byte> bytes_of(std::string_view text);
std::string text_of(const std::vector<std::byte>& bytes);

Result<MeshFile> read_text(std::string_view text, std::string_view name, const ReadOptions& options = {});

/// A binary STL that claims `count` facets and holds `corners.size() / 9` of them, with zero normals.
std::string binary_stl(std::uint32_t count, const std::vector<float>& corners,
                       std::string_view header = "made in a test");

/// The corner positions of a mesh, triangle by triangle: what is left when indices are forgotten.
std::vector<Vec3> corner_positions(const TriangleMesh& mesh);

/// A folder of the test's own, removed with what it holds.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }
  std::size_t entries() const;

 private:
  std::filesystem::path path_;
};

void write_text(const std::filesystem::path& path, std::string_view text);
std::string read_text_file(const std::filesystem::path& path);

}  // namespace aplomb::test
