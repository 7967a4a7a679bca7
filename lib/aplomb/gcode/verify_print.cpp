#include "aplomb/gcode/verify_print.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "aplomb/core/printable.h"

namespace aplomb {
namespace {

constexpr double other_size_mm = 2;  // a bead's width, and what layers round, is less

std::optional<std::size_t> number_in(const std::string& text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// "1 cube, 2 tower", as many as a line holds.
std::string names_of(const std::vector<PrintedObject>& objects) {
  constexpr std::size_t most_named = 10, most_name_bytes = 60;
  std::string names;
  for (std::size_t i = 0; i < std::min(most_named, objects.size()); ++i)
    names += fmt::format("{}{} {}", i ? ", " : "", i + 1, printable(objects[i].name, most_name_bytes));
  return objects.size() > most_named ? fmt::format("{} ... {}", names, objects.size()) : names;
}

/// Keeps only the object asked for: its label, the label's beginning where that is one object's, or its number.
Result<void> choose(std::vector<PrintedObject>& objects, const std::string& wanted) {
  if (wanted.empty()) return {};
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].name == wanted) found.assign(1, i);
    if (objects[i].name == wanted) break;
    if (objects[i].name.starts_with(wanted)) found.push_back(i);
  }
  const auto number = number_in(wanted);
  if (found.empty() && number && *number >= 1 && *number <= objects.size()) found.push_back(*number - 1);
  if (found.size() != 1)
    return fail(ErrorCode::invalid_option,
                fmt::format("object is '{}' but must be one of: {}", printable(wanted), names_of(objects)));
  PrintedObject kept = std::move(objects[found.front()]);
  objects.clear();
  objects.push_back(std::move(kept));
  return {};
}

Vec2 middle_of(const Box3& box) { return {(box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2}; }

bool differ_in_size(const PrintedObject& printed, const Box3& promised) {
  const Vec3 size = printed.box_mm.size(), told = promised.size();
  const double bead_mm = printed.bead_width_mm;  // the box is that of the beads' middles
  return std::abs(size.x + bead_mm - told.x) > other_size_mm || std::abs(size.y + bead_mm - told.y) > other_size_mm ||
         std::abs(size.z - told.z) > other_size_mm;
}

PrintError error_of(const PrintedObject& printed, const Stability& s, bool density_is_known,
                    const VerifyOptions& options) {
  const ExpectedPrint& promised = *options.expected;
  PrintError error;
  const double density_ratio = density_is_known ? 1 : promised.density_g_per_cm3 / (s.mass_g / s.volume_mm3 * 1e3);
  error.mass_ratio = s.mass_g * density_ratio / promised.mass_g - 1;
  Box3 foot;
  for (const Vec2& corner : printed.contact.corners_mm) foot.add({corner.x, corner.y, 0});
  const Vec2 printed_middle = promised.box_mm ? middle_of(printed.box_mm) : middle_of(foot);
  const Vec2 middle = promised.box_mm ? middle_of(*promised.box_mm) : promised.support_center_mm;
  error.com_mm = {s.com_mm.x - printed_middle.x - (promised.com_mm.x - middle.x),
                  s.com_mm.y - printed_middle.y - (promised.com_mm.y - middle.y),
                  s.com_height_mm - promised.com_height_mm};
  error.has_other_size = promised.box_mm && differ_in_size(printed, *promised.box_mm);
  error.is_within_limits = std::abs(error.mass_ratio) <= options.most_mass_error_ratio &&
                           norm(error.com_mm) <= options.most_com_error_mm && !error.has_other_size;
  return error;
}

}  // namespace

std::string find_problem(const VerifyOptions& options) {
  if (!(options.required_tip_rad >= 0 && options.required_tip_rad < std::numbers::pi / 2))
    return fmt::format("required_tip_rad is {} but must be at least 0 and below pi/2", options.required_tip_rad);
  for (const auto& [name, value] : {std::pair{"most_mass_error_ratio", options.most_mass_error_ratio},
                                    std::pair{"most_com_error_mm", options.most_com_error_mm}})
    if (!(value > 0) || !std::isfinite(value)) return fmt::format("{} is {} but must be above 0", name, value);
  return {};
}

bool Verification::all_stand() const { return std::ranges::all_of(objects, &VerifiedObject::stands); }

bool Verification::all_as_told() const {
  return std::ranges::all_of(objects, [](const auto& o) { return !o.error || o.error->is_within_limits; });
}

Result<Verification> verify_print(PrintedPlate plate, const VerifyOptions& options) {
  if (const auto chosen = choose(plate.objects, options.object); !chosen) return tl::unexpected(chosen.error());
  Verification verification{.plate = {}, .objects = {}, .required_tip_rad = options.required_tip_rad};
  if (options.expected) verification.told_tip_rad = options.expected->tip_rad;
  const StandingPose pose{.required_tip_rad = options.required_tip_rad};
  const bool density_is_known = std::ranges::all_of(plate.filaments, &Filament::density_is_known);
  for (PrintedObject& printed : plate.objects) {
    VerifiedObject object{.printed = {}, .stability = measure_stability(printed.contact, printed.body, pose)};
    if (printed.with_brim) object.with_brim = measure_stability(*printed.with_brim, printed.body, pose);
    if (options.expected) object.error = error_of(printed, object.stability, density_is_known, options);
    object.stands = object.stability.can_stand && object.stability.tip_rad >= options.required_tip_rad;
    object.printed = std::move(printed);
    verification.objects.push_back(std::move(object));
  }
  plate.objects.clear();
  verification.plate = std::move(plate);
  return verification;
}

}  // namespace aplomb
