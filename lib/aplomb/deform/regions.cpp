#include "aplomb/deform/regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace aplomb {
namespace {

constexpr double kept_ratio = 1000;
constexpr double handle_ratio = 100;  // of stiffness: the region takes its wanted shape to about a hundredth
constexpr double pull_weight = 100;   // likewise, against the whole solid

std::string text_of(Vec3 point) { return fmt::format("{:.6g}, {:.6g}, {:.6g}", point.x, point.y, point.z); }

std::string problem_of(const BallRegion& at) {
  if (!(at.radius_mm >= 0 && std::isfinite(at.radius_mm)))
    return fmt::format("radius_mm of a region is {}; it must be at least 0", at.radius_mm);
  return {};
}

/// The tetrahedra of a region; never none for a point of the solid.
std::vector<std::size_t> tets_in(const Cage& cage, const BallRegion& at) {
  const TetMesh& mesh = cage.mesh();
  const double reach_mm = at.radius_mm + 0.5 * cage.cube_mm();
  std::vector<std::size_t> found;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 middle;
    for (const std::uint32_t v : mesh.tets[t]) middle += 0.25 * mesh.vertices[v];
    if (at.radius_mm > 0 && norm(middle - at.center_mm) <= reach_mm) found.push_back(t);
  }
  if (found.empty())
    if (const auto point = cage.embed(at.center_mm)) found.push_back(point->tet);
  return found;
}

Mat3 shape_of(const Handle& handle) {
  Mat3 shape = handle.scale_ratio * Mat3{};
  for (const AxisTurn& turn : handle.turns) shape = rotation_of(turn) * shape;
  return shape;
}

/// The centre of a point handle, or the corners of all its tetrahedra.
std::vector<EmbeddedPoint> points_of(const Cage& cage, const Handle& handle, const std::vector<std::size_t>& tets) {
  if (handle.at.radius_mm == 0)
    if (const auto point = cage.embed(handle.at.center_mm)) return {*point};
  std::vector<EmbeddedPoint> points;
  std::vector<bool> seen(cage.mesh().vertices.size());
  for (const std::size_t t : tets)
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint32_t v = cage.mesh().tets[t][k];
      if (seen[v]) continue;
      seen[v] = true;
      EmbeddedPoint& point = points.emplace_back();
      point.tet = static_cast<std::uint32_t>(t);
      point.weights[k] = 1;
    }
  return points;
}

void pull(const Cage& cage, const Handle& handle, const std::vector<std::size_t>& tets, CageProblem& problem) {
  const Mat3 shape = shape_of(handle);
  const std::vector<EmbeddedPoint> points = points_of(cage, handle, tets);
  for (const EmbeddedPoint& point : points) {
    const Vec3 from = point.position(cage.mesh(), cage.mesh().vertices);
    problem.handles.push_back({point, *handle.to_mm + shape * (from - handle.at.center_mm),
                               pull_weight / static_cast<double>(points.size())});
  }
}

}  // namespace

std::string find_problem(const Regions& regions) {
  for (const StiffRegion& stiff : regions.stiffened) {
    if (std::string problem = problem_of(stiff.at); !problem.empty()) return problem;
    if (!(stiff.ratio >= 0.001 && stiff.ratio <= 1000))
      return fmt::format("ratio of a stiff region is {}; it must lie in [0.001, 1000]", stiff.ratio);
  }
  for (const Handle& handle : regions.handles) {
    if (std::string problem = problem_of(handle.at); !problem.empty()) return problem;
    if (!(handle.scale_ratio >= 0.2 && handle.scale_ratio <= 5))
      return fmt::format("scale_ratio of a handle is {}; it must lie in [0.2, 5]", handle.scale_ratio);
    if (std::string problem = find_problem(PlacementOptions{.turns = handle.turns}); !problem.empty()) return problem;
  }
  for (const auto* balls : {&regions.kept, &regions.locked})
    for (const BallRegion& ball : *balls)
      if (std::string problem = problem_of(ball); !problem.empty()) return problem;
  return {};
}

Result<void> mark_regions(const Cage& cage, const Regions& regions, CageProblem& problem) {
  assert(find_problem(regions).empty());
  const TetMesh& mesh = cage.mesh();
  Box3 box;
  for (const Vec3& v : mesh.vertices) box.add(v);
  Result<void> marked;
  const auto tets_of = [&](const BallRegion& at, const char* what) {
    std::vector<std::size_t> tets = tets_in(cage, at);
    if (tets.empty())
      marked =
          fail(ErrorCode::invalid_option,
               fmt::format("the region to {} about ({}) holds nothing of the model, which lies between ({}) and ({})",
                           what, text_of(at.center_mm), text_of(box.min), text_of(box.max)));
    return tets;
  };
  for (const StiffRegion& stiff : regions.stiffened)
    for (const std::size_t t : tets_of(stiff.at, "stiffen")) problem.stiffness[t] = stiff.ratio;
  for (const BallRegion& ball : regions.kept)
    for (const std::size_t t : tets_of(ball, "keep")) problem.stiffness[t] = kept_ratio;
  if (!regions.handles.empty()) problem.wanted.assign(mesh.tets.size(), {});
  for (const Handle& handle : regions.handles) {
    const std::vector<std::size_t> tets = tets_of(handle.at, "move");
    for (const std::size_t t : tets) {
      problem.stiffness[t] = std::max(problem.stiffness[t], handle_ratio);
      problem.wanted[t] = shape_of(handle);
    }
    if (handle.to_mm) pull(cage, handle, tets, problem);
  }
  for (const BallRegion& ball : regions.locked)
    for (const std::size_t t : tets_of(ball, "lock"))
      for (const std::uint32_t v : mesh.tets[t]) problem.fixed[v] = true;
  return marked;
}

double farthest_pull_mm(const CageProblem& problem, const std::vector<Vec3>& vertices) {
  double farthest = 0;
  for (const SoftHandle& handle : problem.handles)
    farthest = std::max(farthest, norm(handle.at.position(problem.rest, vertices) - handle.target_mm));
  return farthest;
}

}  // namespace aplomb
