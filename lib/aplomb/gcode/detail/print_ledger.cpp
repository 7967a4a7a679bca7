#include "aplomb/gcode/detail/print_ledger.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aplomb::detail {
namespace {

constexpr double most_layer_mm = 1.5, most_width_mm = 3;
constexpr double same_layer_share = 0.25;  // of a layer's height
bool is_model(Feature feature) { return feature == Feature::model || feature == Feature::unnamed; }

/// Of the bead's middle line: its ends, and where an arc reaches farthest along an axis.
void add_to_box(Box3& box, const Stroke& stroke) {
  box.add(stroke.from_mm);
  box.add(stroke.to_mm);
  if (!stroke.arc) return;
  constexpr double quarter = std::numbers::pi / 2;
  const Arc& arc = *stroke.arc;
  const double first = std::min(arc.from_rad, arc.from_rad + arc.sweep_rad) / quarter;
  const double last = std::max(arc.from_rad, arc.from_rad + arc.sweep_rad) / quarter;
  constexpr std::array<Vec2, 4> axes{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  for (int turn = static_cast<int>(std::ceil(first)); turn <= last; ++turn) {
    const Vec2 farthest = arc.center_mm + arc.radius_mm * axes[static_cast<std::size_t>(turn & 3)];
    box.add({farthest.x, farthest.y, stroke.from_mm.z});
  }
}

}  // namespace

double LayerHeights::at(double z_mm, std::optional<double> usual_mm) {
  if (z_mm == top_mm_) return height_mm_;
  const double step_mm = z_mm - top_mm_;
  if (z_mm < top_mm_ || top_mm_ == 0) {  // the first layer, or that of an object printed after another
    if (z_mm > 0 && z_mm <= most_layer_mm) height_mm_ = z_mm;
  } else if (usual_mm && (step_mm < *usual_mm / 2 || step_mm > 2 * *usual_mm)) {
    height_mm_ = *usual_mm;
  } else if (step_mm <= most_layer_mm) {
    height_mm_ = step_mm;
  }
  top_mm_ = z_mm;
  return height_mm_;
}

bool PrintLedger::turn_to(std::optional<std::string_view> object, Feature feature) {
  std::size_t index = labelled + (feature == Feature::unnamed ? nameless_unnamed : nameless_model);
  if (object && is_one_ && !objects_.empty()) {
    index = 0;
  } else if (object) {
    const auto [known, is_new] = index_of_.try_emplace(std::string(*object), objects_.size());
    if (is_new && objects_.size() == labelled) return false;
    if (is_new) {
      objects_.push_back({.name = std::string(*object)});
      if (index_of_.size() > large_hulls) objects_.back().foot.hull = BeadHull(64);
    }
    index = known->second;
  }
  at_.object = index;
  feature_ = feature;
  slot_ = nullptr;
  return true;
}

double PrintLedger::volume_of(const Stroke& stroke) const {
  const double diameter_mm = filaments_[stroke.tool].diameter_mm;
  return stroke.is_volumetric ? stroke.feed : stroke.feed * std::numbers::pi / 4 * diameter_mm * diameter_mm;
}

bool PrintLedger::enter_moments(const Stroke& stroke, double volume_mm3, double height_mm) {
  if (!slot_ || stroke.tool != at_.tool) {
    at_.tool = stroke.tool;
    slot_ = &bodies_[at_];
    if (bodies_.size() > most_bodies) return false;
  }
  Vec3 centroid = stroke.centroid_mm();
  centroid.z -= height_mm / 2;
  *slot_ += {volume_mm3, volume_mm3 * centroid};
  return true;
}

bool PrintLedger::enter(const Stroke& stroke, double height_mm) {
  const double volume_mm3 = volume_of(stroke);
  if (!stroke.is_volumetric) filament_mm_ += stroke.feed;
  if (is_model(feature_)) {
    if (!enter_moments(stroke, volume_mm3, height_mm)) return false;
    enter_model(stroke, volume_mm3, height_mm);
    return true;
  }
  left_out_mm3_[static_cast<std::size_t>(feature_)][stroke.tool] += volume_mm3;
  const double length_mm = stroke.length_mm();
  if (is_skirt_or_brim(feature_) && height_mm > 0 && length_mm > 0)
    brims_.add(stroke, std::min(most_width_mm, volume_mm3 / (length_mm * height_mm)));
  return true;
}

void PrintLedger::enter_model(const Stroke& stroke, double volume_mm3, double height_mm) {
  Object& object = object_at(at_.object);
  add_to_box(object.box_mm, stroke);
  object.box_mm.add(stroke.to_mm - Vec3{0, 0, height_mm});
  Foot& foot = object.foot;
  const double top_mm = std::max(stroke.from_mm.z, stroke.to_mm.z), length_mm = stroke.length_mm();
  if (top_mm > foot.top_mm + same_layer_share * foot.height_mm || !(length_mm > 0) || !(height_mm > 0)) return;
  if (top_mm < foot.top_mm - same_layer_share * height_mm) {
    foot.hull.clear();
    foot = Foot{.top_mm = top_mm, .height_mm = height_mm, .hull = std::move(foot.hull)};
  }
  double width_mm = std::min(most_width_mm, volume_mm3 / (length_mm * height_mm));
  if (foot.length_mm > 1) width_mm = std::min(width_mm, 2 * foot.area_mm2 / foot.length_mm);  // short moves overflow
  foot.area_mm2 += width_mm * length_mm;
  foot.length_mm += length_mm;
  foot.hull.add(stroke, width_mm);
}

PrintedObject PrintLedger::printed(std::size_t index) const {
  const Object& object = index < labelled ? objects_[index] : nameless_[index - labelled];
  PrintedObject printed;
  printed.name = object.name;
  printed.box_mm = object.box_mm;
  printed.contact_layer_mm = object.foot.height_mm;
  for (auto at = bodies_.lower_bound({index, 0}); at != bodies_.end() && at->first.object == index; ++at)
    printed.body.push_back({at->second, filaments_[at->first.tool].density_g_per_cm3, 0});
  if (object.foot.length_mm > 0) printed.bead_width_mm = object.foot.area_mm2 / object.foot.length_mm;
  SupportPolygon& contact = printed.contact;
  contact.frame.plate_mm = object.foot.top_mm - object.foot.height_mm;
  contact.height_mm = object.box_mm.max.z - contact.frame.plate_mm;
  if (!object.foot.hull.empty()) contact.corners_mm = object.foot.hull.corners();
  if (contact.corners_mm.empty() || leaves_brims_out()) return printed;
  if (auto with_brim = brims_.around(contact.corners_mm); !with_brim.empty()) {
    printed.with_brim = contact;
    printed.with_brim->corners_mm = std::move(with_brim);
  }
  return printed;
}

void PrintLedger::close_left_out(bool names_features, PrintedPlate& plate) const {
  for (std::size_t feature = 0; feature < feature_count; ++feature) {
    double mass_g = 0;
    for (std::size_t tool = 0; tool < Machine::most_tools; ++tool)
      mass_g += 1e-3 * filaments_[tool].density_g_per_cm3 * left_out_mm3_[feature][tool];
    if (mass_g > 0) plate.left_out.push_back({std::string(feature_names[feature]), mass_g});
  }
  double outside_g = 0, before_g = 0;
  for (const auto& [body, moments] : bodies_) {
    const double g = 1e-3 * filaments_[body.tool].density_g_per_cm3 * moments.volume_mm3;
    if (body.object == labelled + nameless_unnamed && names_features) before_g += g;
    else if (body.object >= labelled && !objects_.empty()) outside_g += g;
  }
  if (before_g > 0) plate.left_out.push_back({"start G-code", before_g});
  if (outside_g > 0) plate.left_out.push_back({"outside of labelled objects", outside_g});
}

Result<void> PrintLedger::close(bool names_features, PrintedPlate& plate, const Job& job) {
  constexpr std::size_t objects_between_reports = 8;
  brims_.finish();
  const auto add = [&plate, this](std::size_t index) {
    PrintedObject object = printed(index);
    if (!object.body.empty() && !object.contact.corners_mm.empty()) plate.objects.push_back(std::move(object));
  };
  for (std::size_t index = 0; index < objects_.size(); ++index) {
    if (index % objects_between_reports == 0 &&
        !job.report(static_cast<double>(index) / static_cast<double>(objects_.size()), "read"))
      return cancelled();
    add(index);
  }
  if (objects_.empty()) add(labelled + (names_features ? nameless_model : nameless_unnamed));
  close_left_out(names_features, plate);
  plate.filament_mm = filament_mm_;
  return {};
}

}  // namespace aplomb::detail
