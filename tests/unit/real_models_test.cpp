// Files that other programs wrote, against the counts their passport states. The folder is no part of the tree.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/mesh_files.h"

namespace aplomb::test {
namespace {

namespace fs = std::filesystem;

struct Passport {
  fs::path path;
  std::size_t vertices = 0, faces = 0;
};

std::vector<Passport> passports() {
  const char* place = std::getenv("APLOMB_MODELS");
  const fs::path folder = place ? place : APLOMB_MODELS;
  std::ifstream manifest(folder / "MANIFEST.tsv");
  std::vector<Passport> all;
  std::string line, cell;
  for (std::getline(manifest, line); std::getline(manifest, line);) {
    std::vector<std::string> cells;
    for (std::istringstream row(line); std::getline(row, cell, '\t');) cells.push_back(cell);
    all.push_back({folder / cells.at(1) / cells.at(0), std::stoul(cells.at(5)), std::stoul(cells.at(6))});
  }
  return all;
}

TEST(RealModels, EveryFileIsReadWithTheVerticesAndFacesThatItsPassportStates) {
  const auto models = passports();
  if (models.empty()) GTEST_SKIP() << "no real models beside the tree";
  for (const auto& [path, vertices, faces] : models) {
    const auto file = read_mesh(path);
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->objects.size(), 1u) << path;
    const TriangleMesh& mesh = file->objects[0].mesh;
    EXPECT_EQ(mesh.vertices.size(), vertices) << path;
    // Faces are polygons: as many triangles if all are triangles, twice as many if all are quads.
    EXPECT_GE(mesh.triangles.size(), faces) << path;
    EXPECT_LE(mesh.triangles.size(), 2 * faces) << path;
  }
}

TEST(RealModels, EveryFileComesBackFromEveryFormat) {
  for (const auto& [path, vertices, faces] : passports()) {
    const auto file = read_mesh(path);
    ASSERT_TRUE(file) << file.error().message;
    const TriangleMesh mesh = rounded_to_float(file->objects[0].mesh);
    for (const MeshFormat format : {MeshFormat::three_mf, MeshFormat::obj, MeshFormat::ply, MeshFormat::stl}) {
      const auto back = read_mesh(encode_mesh(mesh, format).value(), "a.stl");
      ASSERT_TRUE(back) << path << back.error().message;
      const TriangleMesh read = rounded_to_float(back->objects[0].mesh);
      if (format == MeshFormat::stl || mesh.vertices.size() == 3 * mesh.triangles.size())
        EXPECT_EQ(corner_positions(read), corner_positions(mesh)) << path;
      else EXPECT_EQ(read, mesh) << path;
    }
  }
}

}  // namespace
}  // namespace aplomb::test
