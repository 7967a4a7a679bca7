#include "aplomb/adapters/cgal/boolean.h"

#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <array>

#include "aplomb/adapters/cgal/mesh_order.h"
#include "aplomb/adapters/cgal/surface_mesh.h"

namespace aplomb::adapters {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

template <class Operation>
std::optional<TriangleMesh> combined(const TriangleMesh& body, const TriangleMesh& tool, const Operation& operation) {
  make_quiet_and_deterministic();
  std::array<SurfaceMesh, 2> operands{surface_of(body), surface_of(tool)};  // CGAL asks which has the lower address
  SurfaceMesh result;
  if (!operation(operands[0], operands[1], result)) return std::nullopt;
  return in_its_own_order(triangles_of(result));
}

}  // namespace

std::optional<TriangleMesh> difference(const TriangleMesh& body, const TriangleMesh& tool) {
  return combined(body, tool, [](SurfaceMesh& one, SurfaceMesh& other, SurfaceMesh& result) {
    return PMP::corefine_and_compute_difference(one, other, result);
  });
}

std::optional<TriangleMesh> intersection(const TriangleMesh& body, const TriangleMesh& tool) {
  return combined(body, tool, [](SurfaceMesh& one, SurfaceMesh& other, SurfaceMesh& result) {
    return PMP::corefine_and_compute_intersection(one, other, result);
  });
}

}  // namespace aplomb::adapters
