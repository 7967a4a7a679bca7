// The yardstick of the bench: what OpenVDB alone takes to hollow a mesh. bare_openvdb MODEL SCALE VOXEL_MM WALL_MM
//
// Mesh to signed distance grid (3 voxels outside, the wall and 3 voxels inside), grid to the mesh at depth WALL_MM. No
// void is chosen, no wall is promised, nothing is checked. Prints JSON: CPU seconds, active voxels, triangles out.
// With a voxel of 0 nothing is done but to print the model's extents.

#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/VolumeToMesh.h>

#include <cstdlib>
#include <ctime>
#include <iostream>

#include "aplomb/io/read_mesh.h"

int main(int count, char** arguments) {
  if (count != 5) {
    std::cerr << "bare_openvdb MODEL SCALE VOXEL_MM WALL_MM\n";
    return 1;
  }
  const auto file = aplomb::read_mesh(std::filesystem::path(arguments[1]));
  if (!file) {
    std::cerr << file.error().message << '\n';
    return 2;
  }
  const double scale = std::atof(arguments[2]);
  const double voxel_mm = std::atof(arguments[3]);
  const double wall_mm = std::atof(arguments[4]);
  const aplomb::TriangleMesh& mesh = file->objects.front().mesh;

  const aplomb::Box3 box = aplomb::bounding_box(mesh);
  const aplomb::Vec3 extent = box.max - box.min;
  if (voxel_mm <= 0) {
    std::cout << "{\"box_mm\": [" << extent.x << ", " << extent.y << ", " << extent.z << "]}\n";
    return 0;
  }

  const std::clock_t start = std::clock();  // of the process: all threads' CPU time
  openvdb::initialize();
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel_mm);
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  for (const aplomb::Vec3& p : mesh.vertices) {
    points.push_back(openvdb::Vec3s(transform->worldToIndex(scale * openvdb::Vec3d(p.x, p.y, p.z))));
  }
  for (const aplomb::Triangle& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);

  const openvdb::tools::QuadAndTriangleDataAdapter<openvdb::Vec3s, openvdb::Vec3I> adapter(points, triangles);
  const auto inside = static_cast<float>(wall_mm / voxel_mm + 3);
  const auto grid = openvdb::tools::meshToVolume<openvdb::FloatGrid>(adapter, *transform, 3.0F, inside);
  std::vector<openvdb::Vec3s> out_points;
  std::vector<openvdb::Vec3I> out_triangles;
  std::vector<openvdb::Vec4I> out_quads;
  openvdb::tools::volumeToMesh(*grid, out_points, out_triangles, out_quads, -wall_mm, 0.0);
  const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;

  std::cout << "{\"cpu_s\": " << cpu_s << ", \"active_voxels\": " << grid->activeVoxelCount()
            << ", \"triangles\": " << out_triangles.size() + 2 * out_quads.size() << "}\n";
}
