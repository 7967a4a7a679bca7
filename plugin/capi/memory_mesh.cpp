#include "memory_mesh.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "aplomb/io/write_mesh.h"

namespace aplomb::capi {
namespace {

constexpr std::uint64_t most_vertices = std::numeric_limits<std::uint32_t>::max();

/// What is wrong with the fields; nothing of what they point at is read.
Result<void> check_fields(const aplomb_mesh* mesh, const ReadOptions& options) {
  if (!mesh) return fail(ErrorCode::invalid_option, "mesh is null");
  if (mesh->struct_size != sizeof(aplomb_mesh))
    return fail(ErrorCode::invalid_option, fmt::format("mesh->struct_size is {}; this version of the library knows {}",
                                                       mesh->struct_size, sizeof(aplomb_mesh)));
  if (mesh->vertex_count == 0 || mesh->triangle_count == 0)
    return fail(ErrorCode::unusable_input, "the mesh has no triangles");
  if ((mesh->float_vertices == nullptr) == (mesh->double_vertices == nullptr))
    return fail(ErrorCode::invalid_option, "exactly one of float_vertices and double_vertices is to be given");
  if (!mesh->triangles) return fail(ErrorCode::invalid_option, "triangles is null");
  if (mesh->triangle_count > options.max_triangles || mesh->vertex_count > most_vertices)
    return fail(ErrorCode::over_budget,
                fmt::format("the mesh has {} triangles and {} vertices; {} and {} are the most", mesh->triangle_count,
                            mesh->vertex_count, options.max_triangles, most_vertices));
  const std::uint64_t bytes = mesh->vertex_count * sizeof(Vec3) + mesh->triangle_count * sizeof(Triangle);
  if (bytes > options.memory_bytes)
    return fail(ErrorCode::over_budget, fmt::format("the mesh takes {} MB; the job's memory_mb allows {}",
                                                    bytes / 1'000'000, options.memory_bytes / 1'000'000));
  return {};
}

template <class Number>
Result<std::vector<Vec3>> vertices_of(const Number* numbers, std::size_t count) {
  std::vector<Vec3> vertices(count);
  for (std::size_t i = 0; i < count; ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const auto coordinate = static_cast<double>(numbers[3 * i + axis]);
      if (!(std::abs(coordinate) <= std::numeric_limits<float>::max()))
        return fail(ErrorCode::unusable_input,
                    fmt::format("vertex {} (from 0) has the coordinate {}, which is no finite float32", i, coordinate));
      vertices[i][axis] = coordinate;
    }
  return vertices;
}

Result<std::vector<Triangle>> triangles_of(const aplomb_mesh& mesh) {
  std::vector<Triangle> triangles(mesh.triangle_count);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t vertex = mesh.triangles[3 * i + corner];
      if (vertex >= mesh.vertex_count)
        return fail(ErrorCode::unusable_input,
                    fmt::format("triangle {} (from 0) has the vertex {}; there are {}", i, vertex, mesh.vertex_count));
      triangles[i][corner] = vertex;
    }
  return triangles;
}

bool shares_no_vertex(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size());
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) {
      if (used[vertex]) return false;
      used[vertex] = true;
    }
  return true;
}

}  // namespace

Result<MeshFile> read_memory(const aplomb_mesh* given, const ReadOptions& options) {
  if (const auto checked = check_fields(given, options); !checked) return tl::unexpected(checked.error());
  auto vertices = given->float_vertices ? vertices_of(given->float_vertices, given->vertex_count)
                                        : vertices_of(given->double_vertices, given->vertex_count);
  if (!vertices) return tl::unexpected(vertices.error());
  auto triangles = triangles_of(*given);
  if (!triangles) return tl::unexpected(triangles.error());
  TriangleMesh mesh{std::move(*vertices), std::move(*triangles)};
  if (shares_no_vertex(mesh)) {
    const auto bytes = encode_mesh(mesh, MeshFormat::stl);
    if (!bytes) return tl::unexpected(bytes.error());
    return read_mesh(*bytes, "mesh.stl", options);
  }
  return MeshFile{"mesh in memory", 1, true, {{"mesh", std::move(mesh)}}, {}};
}

}  // namespace aplomb::capi
