#include "aplomb/gcode/detail/print_ledger.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aplomb::detail {
namespace {

constexpr double most_layer_mm = 1.5, most_width_mm = 3;
constexpr double same_layer_share = 0.25;  // of a layer's height
constexpr double chord_rad = 0.1;          // of an arc, where only its extent counts

bool is_model(Feature feature) { return feature == Feature::model || feature == Feature::unnamed; }

/// Calls back with the ends of straight pieces of the stroke.
template <class Visit>
void visit_pieces(const Stroke& stroke, const Visit& visit) {
  if (!stroke.arc) return visit(stroke.from_mm, stroke.to_mm);
  const Arc& arc = *stroke.arc;
  const int count = std::max(1, static_cast<int>(std::ceil(std::abs(arc.sweep_rad) / chord_rad)));
  Vec3 last = stroke.from_mm;
  for (int i = 1; i <= count; ++i) {
    const double share = static_cast<double>(i) / count, angle = arc.from_rad + share * arc.sweep_rad;
    Vec3 next{arc.center_mm.x + arc.radius_mm * std::cos(angle), arc.center_mm.y + arc.radius_mm * std::sin(angle),
              stroke.from_mm.z + share * (stroke.to_mm.z - stroke.from_mm.z)};
    if (i == count) next = stroke.to_mm;
    visit(last, next);
    last = next;
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
    if (is_new) objects_.emplace_back().name = *object;
    index = known->second;
  }
  at_ = {index, feature, at_.tool};
  slot_ = nullptr;
  return true;
}

double PrintLedger::volume_of(const Stroke& stroke) const {
  const double diameter_mm = filaments_[stroke.tool].diameter_mm;
  return stroke.is_volumetric ? stroke.feed : stroke.feed * std::numbers::pi / 4 * diameter_mm * diameter_mm;
}

void PrintLedger::enter(const Stroke& stroke, double height_mm) {
  if (!slot_ || stroke.tool != at_.tool) {
    at_.tool = stroke.tool;
    slot_ = &moments_[at_];
  }
  const double volume_mm3 = volume_of(stroke);
  Vec3 centroid = stroke.centroid_mm();
  centroid.z -= height_mm / 2;
  *slot_ += {volume_mm3, volume_mm3 * centroid};
  if (!stroke.is_volumetric) filament_mm_ += stroke.feed;
  if (is_model(at_.feature)) enter_model(stroke, volume_mm3, height_mm);
  if (!is_skirt_or_brim(at_.feature) || !(height_mm > 0)) return;
  const double length_mm = stroke.length_mm();
  if (!(length_mm > 0)) return;
  const double width_mm = std::min(most_width_mm, volume_mm3 / (length_mm * height_mm));
  visit_pieces(stroke, [&](Vec3 from, Vec3 to) { brims_.add(from, to, width_mm); });
}

void PrintLedger::enter_model(const Stroke& stroke, double volume_mm3, double height_mm) {
  Object& object = object_at(at_.object);
  visit_pieces(stroke, [&object, height_mm](Vec3 from, Vec3 to) {
    object.box_mm.add(from);
    object.box_mm.add(to);
    object.box_mm.add(to - Vec3{0, 0, height_mm});
  });
  Foot& foot = object.foot;
  const double top_mm = std::max(stroke.from_mm.z, stroke.to_mm.z), length_mm = stroke.length_mm();
  if (top_mm > foot.top_mm + same_layer_share * foot.height_mm || !(length_mm > 0) || !(height_mm > 0)) return;
  if (top_mm < foot.top_mm - same_layer_share * height_mm)
    foot = Foot{.top_mm = top_mm, .height_mm = height_mm, .hull = {}};
  double width_mm = std::min(most_width_mm, volume_mm3 / (length_mm * height_mm));
  if (foot.length_mm > 1) width_mm = std::min(width_mm, 2 * foot.area_mm2 / foot.length_mm);  // short moves overflow
  foot.area_mm2 += width_mm * length_mm;
  foot.length_mm += length_mm;
  visit_pieces(stroke, [&foot, width_mm](Vec3 from, Vec3 to) {
    for (const Vec3& end : {from, to}) foot.hull.add({end.x, end.y}, width_mm / 2);
  });
}

PrintedObject PrintLedger::printed(std::size_t index) const {
  const Object& object = index < labelled ? objects_[index] : nameless_[index - labelled];
  PrintedObject printed;
  printed.name = object.name;
  printed.box_mm = object.box_mm;
  printed.contact_layer_mm = object.foot.height_mm;
  std::map<unsigned, Moments> by_tool;
  for (auto at = moments_.lower_bound({index, {}, 0}); at != moments_.end() && at->first.object == index; ++at)
    if (is_model(at->first.feature)) by_tool[at->first.tool] += at->second;
  for (const auto& [tool, moments] : by_tool) printed.body.push_back({moments, filaments_[tool].density_g_per_cm3, 0});
  if (object.foot.length_mm > 0) printed.bead_width_mm = object.foot.area_mm2 / object.foot.length_mm;
  SupportPolygon& contact = printed.contact;
  contact.frame.plate_mm = object.foot.top_mm - object.foot.height_mm;
  contact.height_mm = object.box_mm.max.z - contact.frame.plate_mm;
  if (!object.foot.hull.empty()) contact.corners_mm = object.foot.hull.corners();
  if (auto with_brim = brims_.around(contact.corners_mm); !with_brim.empty() && !contact.corners_mm.empty()) {
    printed.with_brim = contact;
    printed.with_brim->corners_mm = std::move(with_brim);
  }
  return printed;
}

void PrintLedger::close_left_out(bool names_features, PrintedPlate& plate) const {
  std::map<Feature, double> mass_g;
  double outside_g = 0, before_g = 0;
  for (const auto& [key, moments] : moments_) {
    const double g = 1e-3 * filaments_[key.tool].density_g_per_cm3 * moments.volume_mm3;
    if (!is_model(key.feature)) mass_g[key.feature] += g;
    else if (key.object == labelled + nameless_unnamed && names_features) before_g += g;
    else if (key.object >= labelled && !objects_.empty()) outside_g += g;
  }
  for (const auto& [feature, g] : mass_g)
    plate.left_out.push_back({std::string(feature_names[static_cast<std::size_t>(feature)]), g});
  if (before_g > 0) plate.left_out.push_back({"start G-code", before_g});
  if (outside_g > 0) plate.left_out.push_back({"outside of labelled objects", outside_g});
}

void PrintLedger::close(bool names_features, PrintedPlate& plate) {
  brims_.finish();
  const auto add = [&plate, this](std::size_t index) {
    PrintedObject object = printed(index);
    if (!object.body.empty() && !object.contact.corners_mm.empty()) plate.objects.push_back(std::move(object));
  };
  for (std::size_t index = 0; index < objects_.size(); ++index) add(index);
  if (objects_.empty()) add(labelled + (names_features ? nameless_model : nameless_unnamed));
  close_left_out(names_features, plate);
  plate.filament_mm = filament_mm_;
}

}  // namespace aplomb::detail
