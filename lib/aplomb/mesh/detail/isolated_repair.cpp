#include "aplomb/mesh/detail/isolated_repair.h"

#include <string>

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
  return std::optional(unpacked(*bytes, at));
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
  ClosedSurface closed;
  closed.mesh = unpacked(*bytes, at);
  closed.holes = take<FilledHole>(*bytes, at);
  closed.holes_left = take<std::size_t>(*bytes, at).at(0);
  return closed;
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
