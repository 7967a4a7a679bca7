#include "aplomb/fdm/predict_print.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "aplomb/adapters/clipper/polygon_operations.h"
#include "aplomb/core/polygon.h"
#include "aplomb/printability/slices.h"

namespace aplomb {
namespace {

constexpr double tolerance_mm = 0.004;  // of the polygons; a bead is a hundred times as wide
constexpr double most_step_mm = 0.5;    // of an inset: deep ones cost the square of the corners
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

/// One layer: what the walls enclose, and what of it is solid.
struct Layer {
  Polygons outline, core, solid, sparse;
};

class Prediction {
 public:
  Prediction(const PrintProfile& profile, const PrintedSolid& printed)
      : p_(profile), plate_mm_(printed.solid.box().min.z) {
    const double gap_mm = p_.rules == PrintProfile::Rules::prusaslicer ? (1 - std::numbers::pi / 4) * p_.layer_mm : 0;
    const double external_mm = p_.external_width_mm - gap_mm, spacing_mm = p_.perimeter_width_mm - gap_mm;
    spacing_mm_ = p_.infill_width_mm - gap_mm;
    skin_mm_ = gap_mm / 2;
    depth_mm_ = p_.perimeters == 0 ? 0 : p_.external_width_mm / 2 + external_mm / 2 + (p_.perimeters - 1) * spacing_mm;
  }

  Result<PredictedPrint> run(const Slices& slices, const Job& job);

 private:
  const Layer* layer_at(std::size_t k, int away) const {
    const auto other = static_cast<std::ptrdiff_t>(k) + away;
    return other < 0 || other >= static_cast<std::ptrdiff_t>(layers_.size())
               ? nullptr
               : &layers_[static_cast<std::size_t>(other)];
  }
  Polygons beyond(std::size_t k, int step, int count);
  Polygons hollow_skin(std::size_t k, int step, int count);
  Polygons skin(std::size_t k);
  void find_solid(std::size_t k);
  void add(std::size_t k, PredictedPrint& print);
  double height_mm(std::size_t k) const { return k == 0 ? p_.first_layer_mm : p_.layer_mm; }
  double top_mm(std::size_t k) const { return plate_mm_ + p_.first_layer_mm + static_cast<double>(k) * p_.layer_mm; }

  const PrintProfile& p_;
  double plate_mm_, depth_mm_ = 0, skin_mm_ = 0, spacing_mm_ = 0;
  std::vector<Layer> layers_;
  Regions regions_;
};

/// What of a core is covered by the next `count` layers above (or below).
Polygons Prediction::beyond(std::size_t k, int step, int count) {
  Polygons covered = layers_[k].core;
  for (int i = 1; i <= count && !covered.empty(); ++i) {
    const Layer* layer = layer_at(k, i * step);
    if (!layer) return {};
    covered = regions_.common(covered, p_.ensures_shell_thickness && i < count ? layer->core : layer->outline);
  }
  return covered;
}

/// The skin of a hollow print: what lies under a surface that shows, as far down as there is core under all of it.
Polygons Prediction::hollow_skin(std::size_t k, int step, int count) {
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

Polygons Prediction::skin(std::size_t k) {
  const Layer& layer = layers_[k];
  if (p_.infill_ratio == 0 && !p_.ensures_shell_thickness)
    return regions_.opened(regions_.both(hollow_skin(k, 1, p_.top_layers), hollow_skin(k, -1, p_.bottom_layers)),
                           p_.external_width_mm);
  const Polygons inner = regions_.common(beyond(k, 1, p_.top_layers), beyond(k, -1, p_.bottom_layers));
  const Polygons solid = regions_.less(layer.core, inner);
  if (p_.ensures_shell_thickness) return regions_.opened(solid, narrow_shell * spacing_mm_);
  const double margin_mm = narrow_beads * p_.solid_width_mm;
  const Polygons narrow = regions_.less(solid, regions_.opened(solid, margin_mm));
  return regions_.both(solid, regions_.common(layer.core, regions_.grown(narrow, margin_mm)));
}

void Prediction::find_solid(std::size_t k) {
  Layer& layer = layers_[k];
  if (layer.core.empty()) return;
  if (p_.infill_ratio >= 1) {
    layer.solid = layer.core;
    return;
  }
  Polygons solid = skin(k);
  Polygons open = regions_.less(layer.core, solid);
  if (p_.infill_ratio > 0)
    for (const Polygons& piece : pieces(open))
      if (area_mm2(piece) <= p_.solid_below_mm2) solid = regions_.both(solid, piece);
  layer.sparse = regions_.less(layer.core, solid);
  layer.solid = std::move(solid);
}

void Prediction::add(std::size_t k, PredictedPrint& print) {
  const Layer& layer = layers_[k];
  const double height = height_mm(k), z_mm = top_mm(k) - height / 2;
  const PlaneMoments ring = plane_moments_of(
      regions_.less(regions_.inset(layer.outline, skin_mm_), regions_.inset(layer.outline, depth_mm_)));
  print.walls += layer_of(ring, p_.flow_ratio * height, z_mm);
  print.solid_infill += layer_of(plane_moments_of(layer.solid), p_.flow_ratio * height, z_mm);
  if (p_.thick_bridges && k > 0 && !layer.solid.empty()) {
    const Polygons held =
        p_.infill_ratio >= 1 ? layers_[k - 1].outline : regions_.less(layers_[k - 1].outline, layers_[k - 1].sparse);
    const Polygons bridge = regions_.opened(regions_.less(layer.solid, held), narrow_beads * p_.nozzle_mm);
    const double d = p_.nozzle_mm, thickness_mm = std::numbers::pi / 4 * d * d / (d + 0.05);
    print.solid_infill += layer_of(plane_moments_of(bridge), p_.flow_ratio * (thickness_mm - height), z_mm);
  }
  if (layer.sparse.empty() || p_.infill_ratio == 0) return;
  const PlaneMoments sparse = plane_moments_of(layer.sparse);
  const double joined_mm = linked_rim(p_.infill_pattern) * std::pow(1 - p_.infill_ratio, 1.5) * rim_mm(layer.sparse);
  const double links = std::min(1 - p_.infill_ratio, joined_mm * spacing_mm_ / sparse.area_mm2);
  print.sparse_infill += layer_of(sparse, p_.flow_ratio * height * (p_.infill_ratio + links), z_mm);
}

Result<PredictedPrint> Prediction::run(const Slices& slices, const Job& job) {
  const auto count = static_cast<double>(slices.layers.size());
  layers_.resize(slices.layers.size());
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    if (!job.report(0.3 * static_cast<double>(k) / count, "predict")) return cancelled();
    layers_[k].outline = regions_.of(adapters::grown(slices.layers[k].material(), -0.0, tolerance_mm));
    layers_[k].core = regions_.inset(layers_[k].outline, depth_mm_ - p_.infill_overlap_mm);
  }
  PredictedPrint print;
  for (std::size_t k = 0; k < layers_.size(); ++k) {
    if (!job.report(0.3 + 0.7 * static_cast<double>(k) / count, "predict")) return cancelled();
    find_solid(k);
    add(k, print);
  }
  if (regions_.error()) return tl::unexpected(*regions_.error());
  return print;
}

}  // namespace

std::vector<Region> PredictedPrint::body(double density_g_per_cm3) const {
  std::vector<Region> body;
  for (const auto& [moments, error_ratio] :
       {std::pair{walls, 0.02}, std::pair{solid_infill, 0.02}, std::pair{sparse_infill, 0.15}})
    if (moments.volume_mm3 > 0) body.push_back({moments, density_g_per_cm3, error_ratio});
  return body;
}

Result<PredictedPrint> predict_print(const PrintedSolid& printed, const PrintProfile& profile, const Job& job) {
  assert(find_problem(profile).empty());
  const auto slices =
      cut_slices(printed, profile.layer_mm, job.part(0, 0.1), profile.first_layer_mm - profile.layer_mm);
  if (!slices) return tl::unexpected(slices.error());
  return Prediction(profile, printed).run(*slices, job.part(0.1, 1));
}

}  // namespace aplomb
