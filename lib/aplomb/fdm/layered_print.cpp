#include "aplomb/fdm/layered_print.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "aplomb/adapters/clipper/polygon_operations.h"
#include "aplomb/printability/slices.h"

namespace aplomb {
namespace {

constexpr double tolerance_mm = 0.004;  // of the polygons; a bead is a hundred times as wide
constexpr double most_step_mm = 0.9;    // of an inset: deep ones cost the square of the corners
constexpr double narrow_shell =
    0.3;                            // of a bead: skins under twice that are left out where shells keep their thickness
constexpr double narrow_beads = 3;  // half of what counts as narrow, and by how much that grows

/// Share of its rim along which sparse infill's lines are joined, where there is little of it; measured. Rectilinear
/// lines are joined along every other piece of it.
double linked_rim(std::string_view pattern) {
  if (pattern == "rectilinear" || pattern == "alignedrectilinear" || pattern == "line" || pattern == "zigzag")
    return 0.5;
  if (pattern == "grid" || pattern == "lines") return 0.18;
  return 0.25;
}

/// The first failure of a chain of set operations; what follows it works on nothing.
class Regions {
 public:
  Polygons of(Result<Polygons> made) {
    if (made) return std::move(*made);
    if (!error_) error_ = made.error();
    return {};
  }
  Polygons inset(Polygons polygons, double depth_mm) {
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(depth_mm) / most_step_mm)));
    for (int i = 0; i < steps && !polygons.empty(); ++i)
      polygons = of(adapters::grown(polygons, -depth_mm / steps, tolerance_mm));
    return polygons;
  }
  Polygons grown(const Polygons& polygons, double by_mm) { return inset(polygons, -by_mm); }
  Polygons common(const Polygons& a, const Polygons& b) { return of(adapters::intersection(a, b)); }
  Polygons less(const Polygons& a, const Polygons& b) { return of(adapters::difference(a, b)); }
  Polygons both(const Polygons& a, const Polygons& b) {
    Polygons all = a;
    all.insert(all.end(), b.begin(), b.end());
    return of(adapters::difference(all, {}));
  }
  Polygons opened(const Polygons& polygons, double radius_mm) { return grown(inset(polygons, radius_mm), radius_mm); }
  const std::optional<Error>& error() const { return error_; }

 private:
  std::optional<Error> error_;
};

PlaneMoments plane_moments_of(const Polygons& polygons) {
  PlaneMoments sum;
  for (const Polygon& polygon : polygons) sum += plane_moments(polygon);
  return sum;
}

double rim_mm(const Polygons& polygons) {
  double length = 0;
  for (const Polygon& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i) length += norm(polygon[(i + 1) % polygon.size()] - polygon[i]);
  return length;
}

/// A plane region as a body of that thickness about a height.
Moments layer_of(const PlaneMoments& plane, double thickness_mm, double z_mm) {
  return {plane.area_mm2 * thickness_mm,
          thickness_mm * Vec3{plane.first_mm3.x, plane.first_mm3.y, plane.area_mm2 * z_mm}};
}

/// The strip of that width inside a region's rim as such a body, to first order: exact but for its corners.
Moments strip_of(const Polygons& polygons, double width_mm, double thickness_mm, double z_mm) {
  Moments strip;
  for (const Polygon& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      const double volume_mm3 = width_mm * norm(b - a) * thickness_mm;
      strip += Moments{volume_mm3, volume_mm3 * Vec3{(a.x + b.x) / 2, (a.y + b.y) / 2, z_mm}};
    }
  return strip;
}

/// What of a core stays sparse: PrusaSlicer fills what is smaller than solid_below_mm2.
Polygons sparse_of(const Polygons& core, double infill_ratio, const PrintProfile& profile, Regions& regions) {
  if (infill_ratio >= 1) return {};
  if (infill_ratio == 0) return core;
  Polygons small;
  for (const Polygons& piece : pieces(core))
    if (area_mm2(piece) <= profile.solid_below_mm2) small.insert(small.end(), piece.begin(), piece.end());
  return small.empty() ? core : regions.less(core, small);
}

}  // namespace

/// Finds out what of each core shows above or below, and is filled therefore.
class LayeredPrint::Skins {
 public:
  Skins(LayeredPrint& print, Regions& regions) : p_(print.profile_), layers_(print.layers_), regions_(regions) {}

  Polygons skin(std::size_t k) {
    const Layer& layer = layers_[k];
    if (p_.infill_ratio == 0 && !p_.ensures_shell_thickness)
      return regions_.opened(regions_.both(hollow_skin(k, 1, p_.top_layers), hollow_skin(k, -1, p_.bottom_layers)),
                             p_.external_width_mm);
    const Polygons inner = regions_.common(beyond(k, 1, p_.top_layers), beyond(k, -1, p_.bottom_layers));
    const Polygons solid = regions_.less(layer.core, inner);
    if (p_.ensures_shell_thickness)
      return regions_.opened(solid, narrow_shell * (p_.infill_width_mm - p_.bead_gap_mm()));
    const double margin_mm = narrow_beads * p_.solid_width_mm;
    const Polygons narrow = regions_.less(solid, regions_.opened(solid, margin_mm));
    return regions_.both(solid, regions_.common(layer.core, regions_.grown(narrow, margin_mm)));
  }

 private:
  const Layer* layer_at(std::size_t k, int away) const {
    const auto other = static_cast<std::ptrdiff_t>(k) + away;
    return other < 0 || other >= std::ssize(layers_) ? nullptr : &layers_[static_cast<std::size_t>(other)];
  }

  /// What of a core is covered by the next `count` layers above (or below).
  Polygons beyond(std::size_t k, int step, int count) {
    Polygons covered = layers_[k].core;
    for (int i = 1; i <= count && !covered.empty(); ++i) {
      const Layer* layer = layer_at(k, i * step);
      if (!layer) return {};
      covered = regions_.common(covered, p_.ensures_shell_thickness && i < count ? layer->core : layer->outline);
    }
    return covered;
  }

  /// The skin of a hollow print: what lies under a surface that shows, as far down as there is core under all of it.
  Polygons hollow_skin(std::size_t k, int step, int count) {
    Polygons core = layers_[k].core, skin;
    for (int i = 0; i < count && !core.empty(); ++i) {
      const Layer* layer = layer_at(k, i * step);
      const Layer* next = layer_at(k, (i + 1) * step);
      if (!layer) break;
      const Polygons reached = i == 0 ? core : regions_.common(core, layer->outline);
      skin = regions_.both(skin, next ? regions_.less(reached, next->outline) : reached);
      if (i > 0) core = regions_.common(core, layer->core);
    }
    return skin;
  }

  const PrintProfile& p_;
  const std::vector<Layer>& layers_;
  Regions& regions_;
};

/// How the core of one layer is filled.
struct LayeredPrint::Filling {
  Polygons solid, dense, sparse;

  static Filling of(const Layer& layer, const std::optional<DenseInfill>& denser, const PrintProfile& profile,
                    Regions& regions) {
    Filling filling;
    filling.sparse = layer.sparse;
    if (denser && !layer.open.empty()) {
      const Polygons side{clipped(bounding_box(layer.open), layer.half(denser->dense))};
      if (!side.front().empty()) {
        filling.dense = sparse_of(regions.common(layer.open, side), denser->infill_ratio, profile, regions);
        filling.sparse = sparse_of(regions.less(layer.open, side), profile.infill_ratio, profile, regions);
      }
    }
    filling.solid = layer.core;
    for (const Polygons* loose : {&filling.dense, &filling.sparse})
      if (!loose->empty()) filling.solid = regions.less(filling.solid, *loose);
    return filling;
  }
};

Result<LayeredPrint> LayeredPrint::make(const PrintedSolid& printed, const PrintProfile& profile, const Job& job) {
  assert(find_problem(profile).empty());
  const auto slices =
      cut_slices(printed, profile.layer_mm, job.part(0, 0.1), profile.first_layer_mm - profile.layer_mm);
  if (!slices) return tl::unexpected(slices.error());
  LayeredPrint print(profile);
  const double gap_mm = profile.bead_gap_mm(), spacing_mm = profile.perimeter_width_mm - gap_mm;
  const double walls_mm =
      profile.perimeters == 0 ? 0 : profile.external_width_mm - gap_mm / 2 + (profile.perimeters - 1) * spacing_mm;

  Regions regions;
  const auto count = static_cast<double>(slices->layers.size());
  double top_mm = printed.solid.box().min.z;
  for (const Slice& slice : slices->layers) {
    if (!job.report(0.1 + 0.3 * static_cast<double>(print.layers_.size()) / count, "predict")) return cancelled();
    Layer layer;
    layer.height_mm = print.layers_.empty() ? profile.first_layer_mm : profile.layer_mm;
    layer.middle_mm = top_mm + layer.height_mm / 2;
    top_mm += layer.height_mm;
    layer.outline = regions.of(adapters::grown(slice.material(), -0.0, tolerance_mm));
    layer.core = regions.inset(layer.outline, walls_mm - profile.infill_overlap_mm);
    if (profile.perimeters > 0) {
      const auto strip = [&layer](const Polygons& polygons, double width_mm) {
        return strip_of(polygons, width_mm, layer.height_mm, layer.middle_mm);
      };
      const auto all = [&layer](const Polygons& polygons) {
        return layer_of(plane_moments_of(polygons), layer.height_mm, layer.middle_mm);
      };
      layer.walls = all(layer.outline) - strip(layer.outline, gap_mm / 2) - all(layer.core) +
                    strip(layer.core, profile.infill_overlap_mm);
    }
    print.layers_.push_back(std::move(layer));
  }
  Skins skins(print, regions);
  for (std::size_t k = 0; k < print.layers_.size(); ++k) {
    if (!job.report(0.4 + 0.6 * static_cast<double>(k) / count, "predict")) return cancelled();
    Layer& layer = print.layers_[k];
    if (profile.infill_ratio >= 1 || layer.core.empty()) continue;
    layer.open = regions.less(layer.core, skins.skin(k));
    layer.sparse = sparse_of(layer.open, profile.infill_ratio, profile, regions);
  }
  if (regions.error()) return tl::unexpected(*regions.error());
  return print;
}

std::optional<LayeredPrint> LayeredPrint::with_infill(double infill_ratio) const {
  const auto is_sparse = [](double ratio) { return ratio > 0 && ratio < 1; };
  if (infill_ratio == profile_.infill_ratio) return *this;
  if (!is_sparse(infill_ratio) || !is_sparse(profile_.infill_ratio)) return std::nullopt;
  LayeredPrint other = *this;
  other.profile_.infill_ratio = infill_ratio;
  return other;  // how small a core is filled does not depend on the density, if there is any
}

/// Of a region that infill takes up, its links along the rim included.
double LayeredPrint::share(double infill_ratio, const Polygons& region) const {
  if (infill_ratio == 0 || region.empty()) return 0;
  const double joined_mm = linked_rim(profile_.infill_pattern) * std::pow(1 - infill_ratio, 1.5) * rim_mm(region);
  const double spacing_mm = profile_.infill_width_mm - profile_.bead_gap_mm();
  return infill_ratio + std::min(1 - infill_ratio, joined_mm * spacing_mm / area_mm2(region));
}

Result<PredictedPrint> LayeredPrint::fill(const std::optional<DenseInfill>& denser, const Job& job) const {
  const PrintProfile& p = profile_;
  Regions regions;
  PredictedPrint print;
  Filling below;
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    if (!job.report(static_cast<double>(k) / static_cast<double>(layers_.size()), "predict")) return cancelled();
    const Layer& layer = layers_[k];
    const auto laid = [&](const Polygons& region, double thickness_mm) {
      return layer_of(plane_moments_of(region), p.flow_ratio * thickness_mm, layer.middle_mm);
    };
    print.walls += p.flow_ratio * layer.walls;
    Filling filling = Filling::of(layer, denser, p, regions);
    print.solid_infill += laid(filling.solid, layer.height_mm);
    if (p.thick_bridges && k > 0 && !filling.solid.empty()) {
      Polygons held = layers_[k - 1].outline;
      for (const Polygons* loose : {&below.dense, &below.sparse})
        if (!loose->empty()) held = regions.less(held, *loose);
      const Polygons bridge = regions.opened(regions.less(filling.solid, held), narrow_beads * p.nozzle_mm);
      const double d = p.nozzle_mm, thickness_mm = std::numbers::pi / 4 * d * d / (d + 0.05);
      print.solid_infill += laid(bridge, thickness_mm - layer.height_mm);
    }
    print.sparse_infill += laid(filling.sparse, share(p.infill_ratio, filling.sparse) * layer.height_mm);
    if (denser)
      print.sparse_infill += laid(filling.dense, share(denser->infill_ratio, filling.dense) * layer.height_mm);
    below = std::move(filling);
  }
  if (regions.error()) return tl::unexpected(*regions.error());
  return print;
}

Moments LayeredPrint::added_by(const DenseInfill& denser) const {
  Moments added;
  for (const Layer& layer : layers_) {
    if (layer.sparse.empty()) continue;
    const double more = share(denser.infill_ratio, layer.sparse) - share(profile_.infill_ratio, layer.sparse);
    added += layer_of(plane_moments(layer.sparse, layer.half(denser.dense)),
                      profile_.flow_ratio * more * layer.height_mm, layer.middle_mm);
  }
  return added;
}

}  // namespace aplomb
