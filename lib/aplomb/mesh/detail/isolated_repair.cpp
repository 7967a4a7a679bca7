#include "aplomb/mesh/detail/isolated_repair.h"

#include <string>
#include <utility>

#include "aplomb/mesh/detail/mesh_bytes.h"

namespace aplomb::detail {
namespace {

using adapters::ClosedSurface;
using adapters::FilledHole;

/// An optional mesh comes home as no bytes or its arrays.
template <class Work>
Result<std::optional<TriangleMesh>> mesh_of(Work work, const IsolationLimits& limits, const Job& job) {
  const Result<std::string> bytes = run_isolated(
      [&] {
        const std::optional<TriangleMesh> mesh = work();
        return mesh ? packed(*mesh) : std::string();
      },
      limits, job, "repair");
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty()) return std::optional<TriangleMesh>();
  std::size_t at = 0;
  return unpacked(*bytes, at).map([](TriangleMesh mesh) { return std::optional(std::move(mesh)); });
}

}  // namespace

Result<ClosedSurface> closed_surface(const TriangleMesh& soup, const IsolationLimits& limits, const Job& job) {
  const Result<std::string> bytes = run_isolated(
      [&] {
        const ClosedSurface closed = adapters::closed_surface(soup);
        std::string sent = packed(closed.mesh);
        put(sent, closed.holes);
        put(sent, std::vector<std::size_t>{closed.holes_left});
        return sent;
      },
      limits, job, "repair");
  if (!bytes) return tl::unexpected(bytes.error());
  std::size_t at = 0;
  auto mesh = unpacked(*bytes, at);
  if (!mesh) return tl::unexpected(mesh.error());
  auto holes = take<FilledHole>(*bytes, at);
  const auto holes_left = take<std::size_t>(*bytes, at);
  if (!holes || !holes_left || holes_left->size() != 1) return spoilt();
  return ClosedSurface{std::move(*mesh), std::move(*holes), holes_left->front()};
}

Result<std::optional<TriangleMesh>> united(const std::vector<TriangleMesh>& bodies, const IsolationLimits& limits,
                                           const Job& job) {
  return mesh_of([&] { return adapters::united(bodies); }, limits, job);
}

Result<std::optional<TriangleMesh>> without_self_intersections(const TriangleMesh& mesh, const IsolationLimits& limits,
                                                               const Job& job) {
  return mesh_of([&] { return adapters::without_self_intersections(mesh); }, limits, job);
}

}  // namespace aplomb::detail
