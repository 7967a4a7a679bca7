#include "aplomb/adapters/tetgen/tetrahedralize.h"

#include <fmt/format.h>

#include <cassert>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "aplomb/mesh/detail/mesh_bytes.h"

#define TETLIBRARY
#include <tetgen.h>

namespace aplomb::adapters {
namespace {

double* copied(const std::vector<Vec3>& points) {
  auto* list = new double[3 * points.size()];  // a tetgenio deletes what it holds
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) list[3 * i + std::size_t(axis)] = points[i][axis];
  return list;
}

void set_facet(tetgenio::facet& facet, const Triangle& triangle) {
  tetgenio::init(&facet);
  facet.numberofpolygons = 1;
  facet.polygonlist = new tetgenio::polygon[1];
  tetgenio::polygon& polygon = facet.polygonlist[0];
  tetgenio::init(&polygon);
  polygon.numberofvertices = 3;
  polygon.vertexlist = new int[3];
  for (std::size_t corner = 0; corner < 3; ++corner) polygon.vertexlist[corner] = int(triangle[corner]);
}

/// Items of an array of their numbers.
template <class Item, class Number>
std::vector<Item> items_of(const Number* numbers, int count) {
  std::vector<Item> items(numbers && count > 0 ? std::size_t(count) : 0);
  if (!items.empty()) std::memcpy(static_cast<void*>(items.data()), numbers, items.size() * sizeof(Item));
  return items;
}

/// The vertices, then the tetrahedra.
std::string tetgen_bytes(const TriangleMesh& surface, const std::vector<Vec3>& void_points, std::string switches) {
  tetgenio in, out;
  in.numberofpoints = int(surface.vertices.size());
  in.pointlist = copied(surface.vertices);
  in.numberofholes = int(void_points.size());
  in.holelist = void_points.empty() ? nullptr : copied(void_points);
  in.numberoffacets = int(surface.triangles.size());
  in.facetlist = new tetgenio::facet[surface.triangles.size()];
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) set_facet(in.facetlist[t], surface.triangles[t]);
  try {
    ::tetrahedralize(switches.data(), &in, &out);
  } catch (int code) {
    throw std::runtime_error(fmt::format("TetGen gave up (code {})", code));
  }
  std::string bytes;
  detail::put(bytes, items_of<Vec3>(out.pointlist, out.numberofpoints));
  detail::put(bytes, items_of<TetMesh::Tet>(out.tetrahedronlist, out.numberoftetrahedra));
  return bytes;
}

Result<TetMesh> mesh_of(const std::string& bytes) {
  std::size_t at = 0;
  auto vertices = detail::take<Vec3>(bytes, at);
  auto tets = vertices ? detail::take_cells<TetMesh::Tet>(bytes, at, vertices->size()) : std::nullopt;
  if (!tets) return fail(ErrorCode::third_party, "TetGen gave tetrahedra of points that are not there");
  TetMesh mesh{std::move(*vertices), std::move(*tets)};
  for (TetMesh::Tet& tet : mesh.tets) {
    const auto volume = [&] {
      return signed_volume(mesh.vertices[tet[0]], mesh.vertices[tet[1]], mesh.vertices[tet[2]], mesh.vertices[tet[3]]);
    };
    if (volume() < 0) std::swap(tet[2], tet[3]);
    if (!(volume() > 0)) return fail(ErrorCode::third_party, "TetGen made a tetrahedron without volume");
  }
  if (mesh.tets.empty()) return fail(ErrorCode::third_party, "TetGen gave no tetrahedra");
  return mesh;
}

}  // namespace

Result<TetMesh> tetrahedralize(const TriangleMesh& surface, const std::vector<Vec3>& void_points_mm,
                               const TetrahedraSize& size, const IsolationLimits& limits, const Job& job) {
  assert(!surface.triangles.empty() && size.radius_edge_ratio > 1.2);
  static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(TetMesh::Tet) == 4 * sizeof(int));
  std::string switches = fmt::format("pQq{:.3f}", size.radius_edge_ratio);
  if (size.most_mm3 > 0) switches += fmt::format("a{:.9f}", size.most_mm3);
  const auto bytes =
      run_isolated([&] { return tetgen_bytes(surface, void_points_mm, switches); }, limits, job, "tetrahedra");
  if (!bytes)
    return fail(bytes.error().code, bytes.error().code == ErrorCode::cancelled ? bytes.error().message
                                                                               : "TetGen: " + bytes.error().message);
  return mesh_of(*bytes);
}

}  // namespace aplomb::adapters
