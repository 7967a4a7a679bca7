#include "aplomb/deform/trim_choice.h"

#include <algorithm>
#include <cassert>

#include "aplomb/deform/cage.h"
#include "aplomb/deform/detail/carved_samples.h"

namespace aplomb {
namespace {

constexpr std::size_t samples = 20000;
constexpr double least_gain = 1e-3;
constexpr double nearly_all = 0.95;

/// The surface above a plane; where it is cut, it is left open.
TriangleMesh above(const TriangleMesh& mesh, double height) {
  TriangleMesh out{mesh.vertices, {}};
  const auto crossing = [&](std::uint32_t a, std::uint32_t b) {
    const Vec3 from = mesh.vertices[a], to = mesh.vertices[b];
    Vec3 at = from + (height - from.z) / (to.z - from.z) * (to - from);
    at.z = height;
    out.vertices.push_back(at);
    return static_cast<std::uint32_t>(out.vertices.size() - 1);
  };
  for (const Triangle& t : mesh.triangles) {
    std::vector<std::uint32_t> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = t[c], b = t[(c + 1) % 3];
      const bool a_stays = mesh.vertices[a].z >= height, b_stays = mesh.vertices[b].z >= height;
      if (a_stays) corners.push_back(a);
      if (a_stays != b_stays) corners.push_back(crossing(a, b));
    }
    for (std::size_t c = 2; c < corners.size(); ++c) out.triangles.push_back({corners[0], corners[c - 1], corners[c]});
  }
  return out;
}

/// The samples that stay, with a wall above the cut.
std::vector<SolidSample> above(const Cage& cage, double height, double wall) {
  std::vector<SolidSample> out;
  for (SolidSample sample : cage.samples()) {
    const double z = sample.at.position(cage.mesh(), cage.mesh().vertices).z;
    if (z < height) continue;
    if (z < height + wall) sample.carvable = 0;
    out.push_back(sample);
  }
  return out;
}

}  // namespace

Result<std::vector<TrimGain>> trim_gains(const SolidMesh& solid, const StandingPose& pose, RowKind kind, double wall_mm,
                                         std::span<const double> trims_mm, const Job& job) {
  assert(pose.up == (Vec3{0, 0, 1}));
  const auto cage = build_cage(solid, {.wall_mm = wall_mm, .samples = samples}, job.part(0, 0.3));
  if (!cage) return tl::unexpected(cage.error());
  CageProblem problem;
  problem.rest = cage->mesh();
  const std::vector<detail::TetShape> shapes = detail::tet_shapes(problem.rest);
  std::vector<TrimGain> gains;
  for (std::size_t n = 0; n < trims_mm.size(); ++n) {
    const double height = solid.box().min.z + trims_mm[n];
    const TriangleMesh surface = trims_mm[n] > 0 ? above(solid.mesh(), height) : solid.mesh();
    if (surface.triangles.empty()) break;
    const auto support = support_polygon(surface, pose);
    if (!support) continue;  // no named contact reaches that cut
    problem.samples = trims_mm[n] > 0 ? above(*cage, height, wall_mm) : cage->samples();
    if (problem.samples.empty()) break;
    problem.balance = standing_rows(*support, pose, kind);
    const double share = static_cast<double>(n + 1) / static_cast<double>(trims_mm.size());
    if (!job.report(0.3 + 0.7 * share, "trim")) return cancelled();
    const auto carved = detail::CarvedSamples(problem, shapes).best_carving(problem.rest.vertices, job.part(1, 1));
    if (!carved) return tl::unexpected(carved.error());
    gains.push_back({trims_mm[n], carved->t});
  }
  return gains;
}

double chosen_trim_mm(std::span<const TrimGain> gains, double required_t) {
  assert(!gains.empty() && gains.front().trim_mm == 0);
  const double without = gains.front().t;
  const auto serves = std::ranges::find_if(gains, [&](const TrimGain& g) { return g.t >= required_t; });
  if (serves != gains.end()) return serves->trim_mm;
  const double most = std::ranges::max_element(gains, {}, &TrimGain::t)->t;
  if (most - without < least_gain) return 0;
  return std::ranges::find_if(gains, [&](const TrimGain& g) { return g.t - without >= nearly_all * (most - without); })
      ->trim_mm;
}

}  // namespace aplomb
