#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "aplomb/printability/detail/quadratic_tet.h"
#include "aplomb/printability/detail/stress_samples.h"

namespace aplomb::detail {
namespace {

constexpr std::size_t directions = 64;
constexpr std::size_t stride = 4;  // a first look takes every fourth, 2 % off the worst at most
double azimuth_rad(std::size_t direction) {
  return 2 * std::numbers::pi * static_cast<double>(direction) / static_cast<double>(directions);
}

using Barycentric = std::array<double, 4>;
using Corners = std::array<Barycentric, 4>;

Barycentric between(const Barycentric& a, const Barycentric& b) {
  Barycentric middle{};
  for (std::size_t k = 0; k < 4; ++k) middle[k] = (a[k] + b[k]) / 2;
  return middle;
}

/// Four points in each of the 8^level tetrahedra of equal volume that a tetrahedron is halved into.
void add_points(const Corners& c, int level, std::vector<Barycentric>& points) {
  if (level == 0) {
    for (const Barycentric& place : tet_points) {  // unlike its middle, they keep the spread within it
      Barycentric& point = points.emplace_back();
      for (std::size_t corner = 0; corner < 4; ++corner)
        for (std::size_t k = 0; k < 4; ++k) point[k] += place[corner] * c[corner][k];
    }
    return;
  }
  std::array<Barycentric, 6> m;
  for (std::size_t e = 0; e < 6; ++e) m[e] = between(c[tet_edges[e][0]], c[tet_edges[e][1]]);
  for (const Corners& part :
       {Corners{c[0], m[0], m[1], m[2]}, Corners{c[1], m[0], m[3], m[4]}, Corners{c[2], m[1], m[3], m[5]},
        Corners{c[3], m[2], m[4], m[5]}, Corners{m[0], m[5], m[1], m[2]}, Corners{m[0], m[5], m[2], m[4]},
        Corners{m[0], m[5], m[4], m[3]}, Corners{m[0], m[5], m[3], m[1]}})
    add_points(part, level - 1, points);
}

std::vector<Barycentric> points_of(int level) {
  std::vector<Barycentric> points;
  add_points({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}, level, points);
  return points;
}

struct Sample {
  LoadStress stress;
  double volume_mm3 = 0;
  Vec3 at_mm;
};

LoadStress interpolated(const std::array<LoadStress, 4>& corners, const Barycentric& place) {
  LoadStress sum{};
  for (std::size_t load = 0; load < sum.size(); ++load)
    for (std::size_t k = 0; k < 4; ++k) sum[load] = sum[load] + place[k] * corners[k][load];
  return sum;
}

/// The samples that are worst by a push in one direction and fill the volume, and the mildest of their stresses.
struct Worst {
  double stress_mpa = 0;
  std::vector<std::pair<double, std::size_t>> samples;  // stress and number
};

Worst worst_of(const std::vector<Sample>& samples, double azimuth, double volume_mm3) {
  Worst worst;
  auto& heap = worst.samples;
  heap.reserve(samples.size());
  for (std::size_t n = 0; n < samples.size(); ++n)
    heap.emplace_back(largest_principal_mpa(pushed_towards(samples[n].stress, azimuth)), n);
  std::ranges::make_heap(heap);
  double sum = 0;
  for (auto end = heap.end(); end != heap.begin(); --end) {
    std::pop_heap(heap.begin(), end);  // to its end, one before the last
    sum += samples[std::prev(end)->second].volume_mm3;
    if (sum < volume_mm3) continue;
    worst.stress_mpa = std::prev(end)->first;
    heap.erase(heap.begin(), std::prev(end));
    return worst;
  }
  return {};
}

using WorstByDirection = std::array<Worst, directions>;

/// Of the directions that are asked for.
template <class Asked>
WorstByDirection worst_of(const std::vector<Sample>& samples, double volume_mm3, const Asked& is_asked) {
  WorstByDirection all;
  tbb::parallel_for(std::size_t{0}, directions, [&](std::size_t d) {
    if (is_asked(d)) all[d] = worst_of(samples, azimuth_rad(d), volume_mm3);
  });
  return all;
}
const Worst& worst_of(const WorstByDirection& all) { return *std::ranges::max_element(all, {}, &Worst::stress_mpa); }

/// Finer in larger tetrahedra, so that a sample is a small part of the volume asked for.
int level_of(double tet_mm3, double volume_mm3) {
  int level = 0;
  while (level < 4 && tet_mm3 > 0.03 * volume_mm3 * std::pow(8, level)) ++level;
  return level;
}

}  // namespace

Stress pushed_towards(const LoadStress& stress, double azimuth) {
  return stress[0] + std::cos(azimuth) * stress[1] + std::sin(azimuth) * stress[2];
}

double worst_push_mpa(const LoadStress& stress) {
  double worst = 0;
  for (std::size_t d = 0; d < directions; d += stride)
    worst = std::max(worst, largest_principal_mpa(pushed_towards(stress, azimuth_rad(d))));
  return worst;
}

std::vector<std::array<LoadStress, 4>> corner_stresses(const QuadraticTets& mesh, const ElasticMaterial& material,
                                                       const std::vector<NodalField>& moved_mm) {
  std::vector<std::array<LoadStress, 4>> stresses(mesh.tets.size());
  tbb::parallel_for(std::size_t{0}, mesh.tets.size(), [&](std::size_t t) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      Barycentric place{};
      place[corner] = 1;
      for (std::size_t load = 0; load < 3; ++load)
        stresses[t][corner][load] = stress_in(mesh, material, moved_mm[load], t, place);
    }
  });
  return stresses;
}

std::vector<Place> exceeded_stress(const QuadraticTets& mesh, const std::vector<std::array<LoadStress, 4>>& stresses,
                                   const std::function<bool(std::size_t tet, Vec3 at_mm)>& counts, double volume_mm3) {
  const auto add_samples = [&](std::size_t t, const auto& places, std::vector<Sample>& samples) {
    const double volume = tet_shape(mesh, t).volume_mm3 / static_cast<double>(std::size(places));
    for (const Barycentric& place : places) {
      Vec3 at;
      for (std::size_t k = 0; k < 4; ++k) at += place[k] * mesh.nodes[mesh.tets[t][k]];
      if (counts(t, at)) samples.push_back({interpolated(stresses[t], place), volume, at});
    }
  };
  std::vector<Sample> coarse, fine;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) add_samples(t, tet_points, coarse);
  const WorstByDirection about = worst_of(coarse, volume_mm3, [](std::size_t d) { return d % stride == 0; });
  const double about_mpa = worst_of(about).stress_mpa;
  if (!(about_mpa > 0)) return {};

  // The largest principal stress is convex and the stress affine: no tetrahedron exceeds the worst of its corners.
  std::vector<double> bounds(mesh.tets.size());
  tbb::parallel_for(std::size_t{0}, bounds.size(), [&](std::size_t t) {
    for (const LoadStress& corner : stresses[t]) bounds[t] = std::max(bounds[t], worst_push_mpa(corner));
  });
  const std::array points{points_of(0), points_of(1), points_of(2), points_of(3), points_of(4)};
  for (std::size_t t = 0; t < bounds.size(); ++t)
    if (bounds[t] >= 0.7 * about_mpa)
      add_samples(t, points[std::size_t(level_of(tet_shape(mesh, t).volume_mm3, volume_mm3))], fine);
  const WorstByDirection all = worst_of(fine, volume_mm3, [&](std::size_t d) {
    const std::size_t before = d - d % stride, after = (before + stride) % directions;
    return std::max(about[before].stress_mpa, about[after].stress_mpa) >= 0.93 * about_mpa;
  });
  const Worst& worst = worst_of(all);
  if (worst.samples.empty()) return {};
  Place place{worst.stress_mpa, {}, {}};
  double sum = 0;
  for (const auto& [stress, n] : worst.samples) {
    sum += fine[n].volume_mm3;
    place.at_mm += fine[n].volume_mm3 * fine[n].at_mm;
    place.box_mm.add(fine[n].at_mm);
  }
  place.at_mm = place.at_mm / sum;
  return {place};
}

}  // namespace aplomb::detail
