#include "aplomb/shell/shell.h"

#include <fmt/format.h>

#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "aplomb/core/pulse.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/mesh/marching_tetrahedra.h"
#include "aplomb/shell/simplify_surface.h"
#include "aplomb/shell/wall.h"

namespace aplomb {
namespace {

struct VoidSurface {
  TriangleMesh mesh;  // normals out of the void
  std::size_t voids = 0;
  double loose_mm3 = 0;
};

/// Components that enclose material instead of void float loose: they are taken out.
VoidSurface without_loose_parts(const TriangleMesh& surface, const Pulse& pulse) {
  const auto components = detail::edge_components(surface, detail::EdgeTable(surface, pulse), pulse);
  if (pulse.stopped()) return {};
  std::vector<double> volumes(components.count, 0.0);
  const Vec3 origin = bounding_box(surface).min;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Triangle& t = surface.triangles[i];
    volumes[components.of_triangle[i]] +=
        dot(surface.vertices[t[0]] - origin, cross(surface.vertices[t[1]] - origin, surface.vertices[t[2]] - origin)) /
        6;
  }
  VoidSurface result;
  for (const double volume : volumes) {
    if (volume > 0) ++result.voids;
    else result.loose_mm3 -= volume;
  }
  result.mesh = detail::submesh(surface, [&](std::uint32_t t) { return volumes[components.of_triangle[t]] > 0; });
  return result;
}

}  // namespace

std::string find_problem(const ShellOptions& o) {
  if (!(o.wall_mm > 0)) return fmt::format("wall_mm is {}; it must be positive", o.wall_mm);
  if (!(o.deviation_voxels >= 0 && o.deviation_voxels <= 1))
    return fmt::format("deviation_voxels is {}; it must lie in [0, 1]", o.deviation_voxels);
  return {};
}

Result<Shell> build_shell(const SolidMesh& solid, const VoidField& field, const ShellOptions& options, const Job& job) {
  assert(find_problem(options).empty());
  const TriangleMesh& outer = solid.mesh();
  Shell shell{outer, outer.triangles.size(), 0, std::numeric_limits<double>::infinity(), 0};
  if (field.empty()) return shell;
  const VoxelFrame& frame = field.frame();
  const Pulse pulse(job, 0, "mesh the void");
  const TriangleMesh fine =
      rounded_to_float(marching_tetrahedra(boundary_cells(field, pulse), frame.voxel_mm, frame.origin_mm, pulse));
  const VoidSurface surface = without_loose_parts(fine, pulse);
  if (pulse.stopped()) return cancelled();
  double wall_mm = 0;
  const auto find_thin = [&](const TriangleMesh& inner, const Job& part) -> Result<std::vector<std::uint32_t>> {
    auto wall = measure_wall(inner, outer, options.wall_mm, part);
    if (!wall) return tl::unexpected(wall.error());
    wall_mm = wall->least_mm;
    return std::move(wall->thin);
  };
  auto inner = simplified_surface(surface.mesh, options.deviation_voxels * frame.voxel_mm, find_thin, job.part(0.1, 1));
  if (!inner) return tl::unexpected(inner.error());
  if (inner->triangles.size() == surface.mesh.triangles.size()) {
    if (const auto thin = find_thin(*inner, job); !thin) return tl::unexpected(thin.error());
  }
  if (wall_mm < options.wall_mm)
    return fail(ErrorCode::internal,
                fmt::format("the carved wall measures {} mm, less than {}", wall_mm, options.wall_mm));
  shell.mesh = joined(outer, reversed(std::move(*inner)));
  shell.voids = surface.voids;
  shell.wall_mm = wall_mm;
  shell.loose_mm3 = surface.loose_mm3;
  return shell;
}

}  // namespace aplomb
