#include "aplomb/printability/strength_fem.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "aplomb/mesh/detail/topology.h"
#include "aplomb/printability/detail/places.h"
#include "aplomb/printability/detail/quadratic_tet.h"
#include "aplomb/printability/detail/stress_samples.h"
#include "aplomb/printability/elasticity.h"

namespace aplomb {
namespace {

constexpr double push_n = 10, gravity_m_per_s2 = 9.80665;
constexpr double least_share_above = 0.02, exceeding_mm3 = 1;
constexpr double push_depth_ratio = 0.005;  // of the body's height

/// What of the print counts, by height.
class Judged {
 public:
  explicit Judged(const Slices& slices) : plate_mm_(slices.plate_mm), layer_mm_(slices.layer_mm) {
    double all = 0, above = 0;
    for (const Slice& slice : slices.layers) all += slice.moments().area_mm2;
    half_widths_mm_.resize(slices.layers.size());
    for (std::size_t n = slices.layers.size(); n-- > 0;) {
      double area = 0;
      for (const SlicePart& part : slices.layers[n].parts)
        area = std::max(area, slices.layers[n].outline(part).moments.area_mm2);
      half_widths_mm_[n] = std::sqrt(area / std::numbers::pi);
      above += slices.layers[n].moments().area_mm2;
      if (above < least_share_above * all) half_widths_mm_[n] = std::numeric_limits<double>::infinity();
    }
  }

  bool counts(double z_mm, double top_mm) const {
    const auto layer = static_cast<std::ptrdiff_t>(std::floor((z_mm - plate_mm_) / layer_mm_));
    if (layer < 0 || layer >= std::ssize(half_widths_mm_)) return false;
    const double half_width = half_widths_mm_[std::size_t(layer)];
    return z_mm - plate_mm_ >= half_width && top_mm - z_mm >= half_width;
  }
  bool counts_anywhere(double top_mm) const {
    for (std::size_t n = 0; n < half_widths_mm_.size(); ++n)
      if (counts(plate_mm_ + (static_cast<double>(n) + 0.5) * layer_mm_, top_mm)) return true;
    return false;
  }

 private:
  double plate_mm_, layer_mm_;
  std::vector<double> half_widths_mm_;  // by layer; infinite for a chip
};

/// The connected bodies of a mesh, each with its height.
struct Bodies {
  std::vector<std::uint32_t> of_tet;
  std::vector<double> tops_mm;
};
Bodies bodies_of(const QuadraticTets& mesh) {
  detail::DisjointSets sets(mesh.nodes.size());
  for (const auto& tet : mesh.tets)
    for (const std::uint32_t node : tet) sets.join(tet[0], node);
  Bodies bodies;
  std::vector<std::uint32_t> number(mesh.nodes.size(), std::numeric_limits<std::uint32_t>::max());
  for (const auto& tet : mesh.tets) {
    std::uint32_t& body = number[sets.find(tet[0])];
    if (body == std::numeric_limits<std::uint32_t>::max()) {
      body = static_cast<std::uint32_t>(bodies.tops_mm.size());
      bodies.tops_mm.push_back(-std::numeric_limits<double>::infinity());
    }
    bodies.of_tet.push_back(body);
    for (const std::uint32_t node : tet) bodies.tops_mm[body] = std::max(bodies.tops_mm[body], mesh.nodes[node].z);
  }
  return bodies;
}

/// Whether nodes hold a body: not all on one line.
bool hold(const std::vector<Vec3>& nodes) {
  constexpr double least_mm = 1e-3;
  if (nodes.empty()) return false;
  const Vec3 first = nodes.front();
  const Vec3 far = *std::ranges::max_element(nodes, {}, [&](Vec3 p) { return norm(p - first); }) - first;
  const auto is_off_line = [&](Vec3 p) { return norm(cross(p - first, far)) > least_mm * norm(far); };
  return norm(far) > least_mm && std::ranges::any_of(nodes, is_off_line);
}

/// Why the nodes held do not hold every body; empty when they do.
std::string find_loose_body(const QuadraticTets& mesh, const Bodies& bodies, const std::vector<bool>& held) {
  std::vector<std::vector<Vec3>> nodes(bodies.tops_mm.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const std::uint32_t node : mesh.tets[t])
      if (held[node]) nodes[bodies.of_tet[t]].push_back(mesh.nodes[node]);
  if (std::ranges::all_of(nodes, hold)) return "";
  return bodies.tops_mm.size() == 1 ? "it touches the plate in less than three points"
                                    : "a part of it touches the plate in less than three points";
}

/// The loads, weight and a push along x and y.
std::vector<NodalField> forces_on(const QuadraticTets& mesh, const Bodies& bodies, double plate_mm,
                                  double density_g_per_cm3) {
  const double newton_per_mm3 = 1e-6 * density_g_per_cm3 * gravity_m_per_s2;
  std::vector<NodalField> forces(3, NodalField(mesh.nodes.size()));
  std::vector<double> shares(mesh.nodes.size());  // of the push, before they are made to sum to it
  std::vector<double> sums(bodies.tops_mm.size());
  std::vector<std::uint32_t> body_of(mesh.nodes.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const double volume = detail::tet_shape(mesh, t).volume_mm3;
    const std::uint32_t body = bodies.of_tet[t];
    const double from = bodies.tops_mm[body] - push_depth_ratio * (bodies.tops_mm[body] - plate_mm);
    for (std::size_t n = 0; n < 10; ++n) {
      const std::uint32_t node = mesh.tets[t][n];
      forces[0][node].z -= newton_per_mm3 * volume * (n < 4 ? -0.05 : 0.2);  // integrals of the shape functions
      body_of[node] = body;
      if (mesh.nodes[node].z < from) continue;
      shares[node] += volume;
      sums[body] += volume;
    }
  }
  for (std::size_t node = 0; node < shares.size(); ++node)
    if (shares[node] > 0) {
      const double force = push_n * shares[node] / sums[body_of[node]];
      forces[1][node].x = force;
      forces[2][node].y = force;
    }
  return forces;
}

/// Every vertex has the mean of the stresses in the tetrahedra round it, by volume.
StressField field_of(const TetMesh& tets, const QuadraticTets& mesh,
                     const std::vector<std::array<detail::LoadStress, 4>>& stresses) {
  std::vector<detail::LoadStress> sums(tets.vertices.size());
  std::vector<double> volumes(tets.vertices.size());
  for (std::size_t t = 0; t < tets.tets.size(); ++t) {
    const double volume = detail::tet_shape(mesh, t).volume_mm3;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const std::uint32_t v = tets.tets[t][corner];
      volumes[v] += volume;
      for (std::size_t load = 0; load < 3; ++load) sums[v][load] = sums[v][load] + volume * stresses[t][corner][load];
    }
  }
  TetSurface surface = surface_of(tets);
  StressField field{std::move(surface.mesh), std::vector<double>(surface.tet_vertices.size()), 0};
  tbb::parallel_for(std::size_t{0}, field.stress_mpa.size(), [&](std::size_t n) {
    const std::uint32_t v = surface.tet_vertices[n];
    field.stress_mpa[n] = detail::worst_push_mpa(sums[v]) / volumes[v];
  });
  return field;
}

}  // namespace

Result<FemStrength> measure_strength_fem(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                         const FemOptions& options, const Job& job) {
  assert(options.density_g_per_cm3 > 0);
  FemStrength strength;
  const Judged judged(slices);
  if (!detail::mildest_limit(rules, "strength.fem") || !judged.counts_anywhere(printed.solid.box().max.z))
    return strength;
  const auto tets = solid_tets(printed.solid, options.tets, job.part(0, 0.3));
  if (!tets) return tl::unexpected(tets.error());
  const QuadraticTets mesh = quadratic_tets(tets->mesh);
  const Bodies bodies = bodies_of(mesh);
  ElasticLoads loads;
  const double held_below_mm = slices.plate_mm + slices.layer_mm + tets->deviation_mm;
  for (const Vec3& node : mesh.nodes) loads.held.push_back(node.z <= held_below_mm);
  strength.why_not = find_loose_body(mesh, bodies, loads.held);
  if (!strength.why_not.empty()) return strength;
  loads.forces_n = forces_on(mesh, bodies, slices.plate_mm, options.density_g_per_cm3);
  const ElasticMaterial material{2000, rules.process() == Process::binder ? 0.2 : 0.35};
  const auto moved = solve_elasticity(mesh, material, loads, options.memory_bytes, job.part(0.3, 0.9));
  if (!moved) return tl::unexpected(moved.error());
  const auto stresses = detail::corner_stresses(mesh, material, *moved);
  if (!job.report(0.92, "elasticity")) return cancelled();
  strength.places = detail::exceeded_stress(
      mesh, stresses, [&](std::size_t t, Vec3 at) { return judged.counts(at.z, bodies.tops_mm[bodies.of_tet[t]]); },
      exceeding_mm3);
  if (!job.report(0.97, "elasticity")) return cancelled();
  if (strength.places.empty()) return strength;
  strength.field = field_of(tets->mesh, mesh, stresses);
  strength.field->measured_mpa = strength.places.front().measured;
  return strength;
}

}  // namespace aplomb
