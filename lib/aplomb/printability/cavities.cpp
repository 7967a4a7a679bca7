#include "aplomb/printability/cavities.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/core/pulse.h"
#include "aplomb/mesh/detail/topology.h"
#include "aplomb/mesh/mass_properties.h"
#include "aplomb/printability/detail/basins.h"
#include "aplomb/printability/detail/empty_space.h"
#include "aplomb/printability/detail/passage.h"
#include "aplomb/printability/detail/surface_samples.h"

namespace aplomb {
namespace {

using detail::Basins;
using detail::ClearanceLattice;
using detail::EmptySpace;
using detail::Passage;

// In rho, half the hole's diameter.
constexpr double spacing_ratio = 0.5;
constexpr double wide_ratio = 3;
constexpr double least_ratio = 0.565;  // 1 - spacing_ratio * sqrt(3) / 2: how near a lattice point is to a way

constexpr double narrow_ratio = 0.5;       // of a cavity's clearance: wider openings make it a cup
constexpr double same_basin_ratio = 0.65;  // the same as the lattice may show it, for a clearance of 2 rho
constexpr double least_volume_balls = 2;
constexpr std::size_t most_blocks = 1 << 15;

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Finds basins and the passages between them.
class CavitySearch {
 public:
  CavitySearch(const EmptySpace& space, const ClearanceLattice& lattice, double rho_mm, const Job& job)
      : space_(space),
        lattice_(lattice),
        rho_(rho_mm),
        pulse_(job, 0, "follow escape paths"),
        basins_(lattice, least_ratio * rho_mm, same_basin_ratio, pulse_) {}
  CavitySearch(const CavitySearch&) = delete;  // the basins have the pulse
  CavitySearch& operator=(const CavitySearch&) = delete;

  Result<std::vector<Cavity>> find();

 private:
  void drop_narrow_basins();
  std::map<Pair, std::vector<Basins::Contact>> patches();
  const Passage& passage(const Basins::Contact& contact);
  void merge_wide_open();
  std::vector<Cavity> cavities();
  void measure(std::vector<Cavity>& cavities, const std::map<std::uint32_t, std::size_t>& cavity_of);
  std::uint32_t basin_beside(std::uint32_t element) const;
  void extend(Cavity& cavity, std::uint32_t element) const;

  const EmptySpace& space_;
  const ClearanceLattice& lattice_;
  const double rho_;
  const Pulse pulse_;
  Basins basins_;
  std::map<std::pair<VoxelIndex, VoxelIndex>, Passage> passages_;
};

/// Where no ball finds room is only a part of the way to somewhere else.
void CavitySearch::drop_narrow_basins() {
  for (std::uint32_t basin = 1; basin < basins_.count(); ++basin)
    if (basins_.is_root(basin)) {
      if (!pulse_.goes_on(1000)) return;
      const double step = std::max(0.25 * lattice_.frame().voxel_mm, 0.25 * basins_.peak_mm(basin));
      const detail::Peak peak = detail::climb(space_, basins_.peak_at_mm(basin), step);
      basins_.set_peak(basin, peak.at_mm, peak.clearance_mm);
    }
  for (const Basins::Contact& contact : basins_.contacts())
    for (const std::uint32_t basin : {contact.basin_a, contact.basin_b})
      if (basins_.find(basin) != Basins::outside && basins_.peak_mm(basins_.find(basin)) < rho_)
        basins_.merge(contact.basin_a, contact.basin_b);
}

/// For each two basins that touch, the widest contact of each separate place where they do, widest first.
std::map<Pair, std::vector<Basins::Contact>> CavitySearch::patches() {
  std::map<Pair, std::vector<Basins::Contact>> by_pair;
  for (Basins::Contact contact : basins_.contacts()) {
    if (contact.basin_a < contact.basin_b) {  // from the cavity outward
      std::swap(contact.a, contact.b);
      std::swap(contact.basin_a, contact.basin_b);
    }
    by_pair[{contact.basin_a, contact.basin_b}].push_back(contact);
  }
  for (auto& [pair, contacts] : by_pair) {
    std::vector<Vec3> points;
    points.reserve(contacts.size());
    for (const Basins::Contact& contact : contacts) points.push_back(lattice_.frame().position_mm(contact.a));
    std::vector<Basins::Contact> widest;
    for (const auto& group : detail::groups_within(points, 2.01 * lattice_.frame().voxel_mm))
      widest.push_back(contacts[group.front()]);
    contacts = std::move(widest);
  }
  return by_pair;
}

const Passage& CavitySearch::passage(const Basins::Contact& contact) {
  const auto [entry, is_new] = passages_.try_emplace({contact.a, contact.b});
  if (is_new) {
    const double peak = std::min(basins_.peak_mm(contact.basin_a), basins_.peak_mm(contact.basin_b));
    entry->second = detail::find_passage(space_, lattice_, basins_, contact, narrow_ratio * peak, pulse_);
  }
  return entry->second;
}

void CavitySearch::merge_wide_open() {
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [pair, contacts] : patches()) {
      const double peak = std::min(basins_.peak_mm(pair.first), basins_.peak_mm(pair.second));
      for (const Basins::Contact& contact : contacts) {
        const Passage& way = passage(contact);
        if (pulse_.stopped()) return;
        if (way.clearance_mm < narrow_ratio * peak) continue;
        basins_.merge(pair.first, pair.second);
        changed = true;
        break;
      }
      if (changed) break;
    }
  }
}

bool is_in_an_opening(const Cavity& cavity, Vec3 point) {
  return std::ranges::any_of(cavity.openings, [&](const Opening& opening) {
    const double beyond = dot(point - opening.at_mm, opening.along);
    const double beside = norm(point - opening.at_mm - beyond * opening.along);
    return beyond > 0 && beyond < 3 * opening.diameter_mm && beside < 0.6 * opening.diameter_mm;
  });
}

/// Adds a lattice point and the wall near it to the box and the ends, but for what lies in an opening already.
void CavitySearch::extend(Cavity& cavity, std::uint32_t element) const {
  const double h = lattice_.frame().voxel_mm;
  const Vec3 point = lattice_.frame().position_mm(lattice_.index(element));
  if (is_in_an_opening(cavity, point)) return;
  const auto add = [&](Vec3 p) {
    if (cavity.box_mm.empty() || p.z < cavity.lowest_mm.z) cavity.lowest_mm = p;
    if (cavity.box_mm.empty() || p.z > cavity.highest_mm.z) cavity.highest_mm = p;
    cavity.box_mm.add(p);
  };
  add(point);
  if (lattice_.clearance_mm(element) > static_cast<float>(std::sqrt(3.0) * h)) return;
  const auto here = space_.at(point, EmptySpace::no_hint);
  const Vec3 wall = space_.closest_point(point, here.triangle);
  add(wall);
  for (const std::uint32_t v : space_.surface().triangles[here.triangle])
    if (const Vec3 corner = space_.surface().vertices[v]; norm(corner - wall) <= 0.9 * h && norm(corner - point) <= h)
      add(corner);
}

/// The basin that a point too narrow for one lies beside: uphill from there, along lines in empty space.
std::uint32_t CavitySearch::basin_beside(std::uint32_t element) const {
  for (int steps = 0; steps < 4 && basins_.of(element) == Basins::none; ++steps) {
    const Vec3 point = lattice_.frame().position_mm(lattice_.index(element));
    const double clearance = lattice_.clearance_mm(element);
    double widest = clearance;
    std::uint32_t next = element;
    detail::for_neighbours(lattice_, element, [&](const VoxelIndex& index, std::uint32_t other) {
      const double there = lattice_.clearance_mm(other);
      if (there <= widest || clearance + there < norm(lattice_.frame().position_mm(index) - point)) return;
      widest = there;
      next = other;
    });
    element = next;
  }
  return basins_.of(element);
}

/// Volume, box and ends, with the points along the walls that are too narrow for a basin.
void CavitySearch::measure(std::vector<Cavity>& cavities, const std::map<std::uint32_t, std::size_t>& cavity_of) {
  const double h = lattice_.frame().voxel_mm;
  for (std::uint32_t element = 0; element < lattice_.elements(); ++element) {
    if (cavities.empty() || !(lattice_.clearance_mm(element) > 0)) continue;
    if (!pulse_.goes_on(3)) return;
    const auto found = cavity_of.find(basin_beside(element));
    if (found == cavity_of.end()) continue;
    const double cells = lattice_.is_wide_block(element) ? ClearanceLattice::points : 1;
    cavities[found->second].volume_mm3 += cells * h * h * h;
    extend(cavities[found->second], element);
  }
}

std::vector<Cavity> CavitySearch::cavities() {
  const auto by_pair = patches();
  detail::DisjointSets one_cavity(basins_.count());
  for (const auto& [pair, contacts] : by_pair)
    for (const Basins::Contact& contact : contacts)
      if (pair.second != Basins::outside && passage(contact).clearance_mm >= rho_)
        one_cavity.join(pair.first, pair.second);
  std::vector<Cavity> cavities;
  std::map<std::uint32_t, std::size_t> cavity_of;  // by basin
  for (std::uint32_t basin = 1; basin < basins_.count(); ++basin) {
    if (!basins_.is_root(basin) || basins_.peak_mm(basin) < rho_) continue;
    const std::uint32_t first = one_cavity.find(basin);
    cavity_of[basin] = first == basin ? cavities.size() : cavity_of.at(first);
    if (first == basin) cavities.emplace_back();
    Cavity& cavity = cavities[cavity_of[basin]];
    if (basins_.peak_mm(basin) <= cavity.clearance_mm) continue;
    cavity.clearance_mm = basins_.peak_mm(basin);
    cavity.deepest_mm = basins_.peak_at_mm(basin);
  }
  for (const auto& [pair, contacts] : by_pair)
    for (const Basins::Contact& contact : contacts)
      if (const auto found = cavity_of.find(pair.first); pair.second == Basins::outside && found != cavity_of.end()) {
        const Passage& way = passage(contact);
        cavities[found->second].openings.push_back({way.at_mm, way.along, 2 * way.clearance_mm});
      }
  measure(cavities, cavity_of);
  return cavities;
}

Result<std::vector<Cavity>> CavitySearch::find() {
  drop_narrow_basins();
  merge_wide_open();
  std::vector<Cavity> found = pulse_.stopped() ? std::vector<Cavity>{} : cavities();
  if (pulse_.stopped()) return cancelled();
  const double ball = 4.0 / 3 * std::numbers::pi * rho_ * rho_ * rho_;
  std::erase_if(found, [&](const Cavity& cavity) { return cavity.volume_mm3 < least_volume_balls * ball; });
  for (Cavity& cavity : found) std::ranges::stable_sort(cavity.openings, std::greater<>{}, &Opening::diameter_mm);
  return found;
}

/// A closed surface of its own.
Cavity shell_cavity(const TriangleMesh& shell) {
  Cavity cavity;
  cavity.is_shell = true;
  cavity.volume_mm3 = std::abs(moments(shell).volume_mm3);
  cavity.box_mm = bounding_box(shell);
  const auto by_height = [](Vec3 a, Vec3 b) { return a.z < b.z; };
  cavity.lowest_mm = *std::ranges::min_element(shell.vertices, by_height);
  cavity.highest_mm = *std::ranges::max_element(shell.vertices, by_height);
  const adapters::SurfaceDistance distance(reversed(shell));
  constexpr int steps = 12;
  for (int n = 0; n < steps * steps * steps; ++n) {
    const Vec3 size = cavity.box_mm.size();
    const VoxelIndex cell{n / (steps * steps), n / steps % steps, n % steps};
    const Vec3 share = Vec3{cell[0] + 0.5, cell[1] + 0.5, cell[2] + 0.5} / steps;
    const Vec3 point = cavity.box_mm.min + Vec3{share.x * size.x, share.y * size.y, share.z * size.z};
    const auto nearest = distance.closest(point);
    if (nearest.distance_mm <= cavity.clearance_mm || !distance.inside(point, nearest)) continue;
    cavity.clearance_mm = nearest.distance_mm;
    cavity.deepest_mm = point;
  }
  return cavity;
}

/// What lies round a loose body in a closed shell looks like empty space outside; it is that shell's.
bool is_in_a_shell(const PrintedSolid& printed, Vec3 point) {
  return std::ranges::any_of(printed.voids, [&](const TriangleMesh& shell) {
    const adapters::SurfaceDistance distance(reversed(shell));
    return distance.inside(point, distance.closest(point));
  });
}

}  // namespace

int Cavity::holes(double hole_mm) const {
  return static_cast<int>(
      std::ranges::count_if(openings, [&](const Opening& opening) { return opening.diameter_mm >= hole_mm; }));
}

std::vector<Cavity> closed_shells(const PrintedSolid& printed) {
  std::vector<Cavity> shells;
  for (const TriangleMesh& shell : printed.voids) shells.push_back(shell_cavity(shell));
  std::ranges::stable_sort(shells, {}, [](const Cavity& shell) { return shell.lowest_mm.z; });
  return shells;
}

Result<std::vector<Cavity>> find_cavities(const PrintedSolid& printed, double hole_mm, const Job& job) {
  assert(hole_mm > 0);
  std::vector<Cavity> found = closed_shells(printed);
  const double rho = 0.5 * hole_mm;
  const EmptySpace space(printed);
  const auto lattice =
      ClearanceLattice::sample(space, spacing_ratio * rho, wide_ratio * rho, most_blocks, job.part(0, 0.8));
  if (!lattice) return tl::unexpected(lattice.error());
  auto pockets = CavitySearch(space, *lattice, rho, job.part(0.8, 1)).find();
  if (!pockets) return tl::unexpected(pockets.error());
  for (Cavity& pocket : *pockets)
    if (!pocket.openings.empty() || !is_in_a_shell(printed, pocket.deepest_mm)) found.push_back(std::move(pocket));
  std::stable_sort(found.begin() + static_cast<std::ptrdiff_t>(printed.voids.size()), found.end(),
                   [](const Cavity& a, const Cavity& b) { return a.lowest_mm.z < b.lowest_mm.z; });
  return found;
}

}  // namespace aplomb
