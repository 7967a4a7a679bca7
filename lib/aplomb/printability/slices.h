#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/core/polygon.h"
#include "aplomb/printability/printed_solid.h"

namespace aplomb {

/// A closed curve where a plane cuts the solid's surface; material lies on its left.
struct SliceLoop {
  Polygon points_mm;
  Box2 box_mm;
  PlaneMoments moments;                       ///< negative for holes
  std::optional<std::uint32_t> void_index{};  ///< the void of PrintedSolid whose surface it lies on

  bool is_outline() const { return moments.area_mm2 > 0; }
};

/// A connected piece of a layer's material: an outline and the holes in it.
struct SlicePart {
  std::vector<std::uint32_t> loops;  ///< of its slice; the outline first
  PlaneMoments moments;              ///< of the material
};

/// The solid at the middle of a layer.
struct Slice {
  double z_mm = 0;
  std::vector<SliceLoop> loops;
  std::vector<SlicePart> parts;  ///< in the order of their outlines

  const SliceLoop& outline(const SlicePart& part) const { return loops[part.loops.front()]; }
  Polygons polygons(const SlicePart& part) const;
  /// All material.
  Polygons material() const;
  /// The space of the voids, bodies that lie in one left out.
  Polygons void_space() const;
  PlaneMoments moments() const;
};

/// A printed solid, layer by layer: what a slicer sees of it.
struct Slices {
  double plate_mm = 0;  ///< height of the plate
  double layer_mm = 0;
  std::vector<Slice> layers;  ///< layer k at plate_mm + (k + 1/2) layer_mm, up to the solid's top
};

/// Cuts the solid at the middle of each layer; a vertex on a cutting plane counts as above it.
///
/// Loops follow the triangles, edge by edge: exact but for rounding of the crossing points, closed, and in an order
/// that depends on the mesh alone. Loops of less than 1e-8 mm2 are dropped.
///
/// All planes lie raised_mm higher: a first layer of another height raises those above it.
/// \pre layer_mm > 0; raised_mm > -layer_mm / 2.
/// \return over_budget for more than 50 million crossings or 200,000 layers; cancelled.
/// \par Cost  O(triangles + crossings).
Result<Slices> cut_slices(const PrintedSolid& printed, double layer_mm, const Job& job = {}, double raised_mm = 0);

}  // namespace aplomb
