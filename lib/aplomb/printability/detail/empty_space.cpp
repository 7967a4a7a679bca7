#include "aplomb/printability/detail/empty_space.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace aplomb::detail {
namespace {

TriangleMesh all_surfaces(const PrintedSolid& printed) {
  TriangleMesh all = printed.outer;
  for (const TriangleMesh& one : printed.voids) all = joined(std::move(all), one);
  return all;
}

tl::unexpected<Error> over_budget(double spacing_mm) {
  return fail(ErrorCode::over_budget,
              fmt::format("the solid is too large to look for escape paths at {:.3g} mm: ask for wider holes "
                          "(void.hole_mm), or judge it in parts",
                          spacing_mm));
}

}  // namespace

EmptySpace::EmptySpace(const PrintedSolid& printed)
    : surface_(all_surfaces(printed)),
      first_void_triangle_(static_cast<std::uint32_t>(printed.outer.triangles.size())),
      box_(bounding_box(printed.outer)),
      distance_(surface_) {}

EmptySpace::Clearance EmptySpace::at(Vec3 point, std::uint32_t hint) const {
  const auto nearest = distance_.closest(point, hint);
  Clearance here{nearest.distance_mm, nearest.distance_mm, nearest.triangle};
  if (nearest.triangle >= first_void_triangle_ || distance_.inside(point, nearest)) here.mm = 0;
  return here;
}

/// The descent from one block: decided whole, or point by point.
struct ClearanceLattice::Sampler {
  const EmptySpace& space;
  const VoxelFrame& frame;
  const double wide_mm;
  Held held{};
  bool any_open = false, all_wide = true;

  void descend(const VoxelIndex& origin, const VoxelIndex& from, int size, std::uint32_t hint) {
    const double h = frame.voxel_mm, half = 0.5 * (size - 1), reach = std::sqrt(3.0) * half * h;
    const auto here = space.at(frame.position_mm(from) + half * h * Vec3{1, 1, 1}, hint);
    if (size == 1 || here.mm - reach >= wide_mm) return fill(origin, from, size, here.mm - reach);
    if (here.mm == 0 && here.surface_mm > reach) return fill(origin, from, size, 0);
    for (int c = 0; c < 8; ++c) {
      const int step = size / 2;
      descend(origin, {from[0] + step * (c & 1), from[1] + step * (c >> 1 & 1), from[2] + step * (c >> 2 & 1)}, step,
              here.triangle);
    }
  }

 private:
  void fill(const VoxelIndex& origin, const VoxelIndex& from, int size, double value) {
    any_open = any_open || value > 0;
    all_wide = all_wide && value >= wide_mm;
    for (int n = 0; n < size * size * size; ++n) {
      const int i = from[0] - origin[0] + n / (size * size), j = from[1] - origin[1] + n / size % size,
                k = from[2] - origin[2] + n % size;
      const int point = (i * side + j) * side + k;
      held.values[static_cast<std::size_t>(point)] = static_cast<float>(value);
    }
  }
};

Result<ClearanceLattice> ClearanceLattice::sample(const EmptySpace& space, double spacing_mm, double wide_mm,
                                                  std::size_t most_blocks, const Job& job) {
  ClearanceLattice lattice;
  const double margin = wide_mm + 3 * spacing_mm;  // the rim is wide all over
  lattice.frame_ = {spacing_mm, space.box().min - margin * Vec3{1, 1, 1}};
  lattice.wide_mm_ = wide_mm;
  double blocks = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = std::ceil((space.box().size()[axis] + 2 * margin) / (side * spacing_mm));
    lattice.size_[static_cast<std::size_t>(axis)] = static_cast<int>(std::min(extent, 1e6));
    blocks *= extent;
  }
  if (blocks > 1024.0 * double(most_blocks)) return over_budget(spacing_mm);
  lattice.number_.assign(static_cast<std::size_t>(blocks), none);
  constexpr std::size_t batch = 64;  // between two looks at the job
  for (std::size_t begin = 0; begin < lattice.number_.size(); begin += batch) {
    if (!job.report(double(begin) / blocks, "measure the empty space")) return cancelled();
    std::vector<Sampler> parts(std::min(batch, lattice.number_.size() - begin),
                               Sampler{space, lattice.frame_, wide_mm});
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t n) {
      const VoxelIndex origin = lattice.origin_of(static_cast<std::uint32_t>(begin + n));
      parts[n].descend(origin, origin, side, EmptySpace::no_hint);
    });
    for (std::size_t n = 0; n < parts.size(); ++n) {
      const auto block = static_cast<std::uint32_t>(begin + n);
      parts[n].held.block = block;
      if (parts[n].all_wide) lattice.wide_.push_back({block, *std::ranges::max_element(parts[n].held.values)});
      else if (parts[n].any_open) lattice.held_.push_back(parts[n].held);
    }
    if (lattice.held_.size() > most_blocks) return over_budget(spacing_mm);
  }
  for (std::uint32_t n = 0; n < lattice.held_.size(); ++n) lattice.number_[lattice.held_[n].block] = n * points;
  for (std::uint32_t n = 0; n < lattice.wide_.size(); ++n)
    lattice.number_[lattice.wide_[n].block] = lattice.held_points() + n;
  return lattice;
}

VoxelIndex ClearanceLattice::origin_of(std::uint32_t block) const {
  const int b = static_cast<int>(block);
  return {side * (b / (size_[1] * size_[2])), side * (b / size_[2] % size_[1]), side * (b % size_[2])};
}

std::uint32_t ClearanceLattice::element(const VoxelIndex& index) const {
  for (int axis = 0; axis < 3; ++axis)
    if (index[axis] < 0 || index[axis] >= side * size_[axis]) return none;
  const int block = (index[0] / side * size_[1] + index[1] / side) * size_[2] + index[2] / side;
  const std::uint32_t first = number_[static_cast<std::size_t>(block)];
  if (first == none || is_wide_block(first)) return first;
  const auto point =
      first + static_cast<std::uint32_t>((index[0] % side * side + index[1] % side) * side + index[2] % side);
  return clearance_mm(point) > 0 ? point : none;
}

VoxelIndex ClearanceLattice::index(std::uint32_t element) const {
  if (is_wide_block(element)) {
    const VoxelIndex origin = origin_of(wide_[element - held_points()].block);
    return {origin[0] + side / 2, origin[1] + side / 2, origin[2] + side / 2};
  }
  const VoxelIndex origin = origin_of(held_[element / points].block);
  const int n = static_cast<int>(element % points);
  return {origin[0] + n / (side * side), origin[1] + n / side % side, origin[2] + n % side};
}

}  // namespace aplomb::detail
