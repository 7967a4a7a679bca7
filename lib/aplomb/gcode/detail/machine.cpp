#include "aplomb/gcode/detail/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace aplomb::detail {
namespace {

using std::string_view_literals::operator""sv;

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double most_radius_error_mm = 0.5;  // between an arc's start and its end: rounding is a thousandth

tl::unexpected<Error> unusable(std::string what) { return fail(ErrorCode::unusable_input, std::move(what)); }

char axis_name(int axis) { return static_cast<char>('X' + axis); }

/// With a number or without.
bool names(const Command& command, char word) { return command.has(word) || command.is_unreadable(word); }
bool names_any(const Command& command, std::string_view words) {
  return std::ranges::any_of(words, [&](char word) { return names(command, word); });
}

double angle_of(Vec2 v) { return std::atan2(v.y, v.x); }

/// I and J, or the centre that R asks for: on the left of the chord for a short counter-clockwise arc; a negative R
/// asks for the long way round.
Result<Vec2> center_of(const Command& command, Vec2 from, Vec2 to, int direction, double unit_mm) {
  if (command.has('I') || command.has('J'))
    return from + Vec2{unit_mm * command.value_or('I', 0), unit_mm * command.value_or('J', 0)};
  if (!command.has('R')) return unusable("an arc has neither I, J nor R; slice the model again");
  const double radius = unit_mm * command.value('R');
  const Vec2 chord = to - from;
  const double length = norm(chord);
  if (length == 0 || length > 2 * std::abs(radius) + most_radius_error_mm)
    return unusable(
        fmt::format("an arc of radius {:g} mm cannot span {:g} mm; slice the model again", std::abs(radius), length));
  const double height = std::sqrt(std::max(0.0, radius * radius - length * length / 4));
  const double side = (direction > 0) == (radius > 0) ? 1 : -1;
  return from + 0.5 * chord + (side * height / length) * Vec2{-chord.y, chord.x};
}

}  // namespace

double Stroke::length_mm() const {
  if (!arc) return norm(to_mm - from_mm);
  return std::hypot(arc->radius_mm * arc->sweep_rad, to_mm.z - from_mm.z);
}

Vec3 Stroke::centroid_mm() const {
  const Vec3 middle = 0.5 * (from_mm + to_mm);
  if (!arc) return middle;
  const double half = arc->sweep_rad / 2;
  const double reach = arc->radius_mm * std::sin(half) / half, direction = arc->from_rad + half;
  return {arc->center_mm.x + reach * std::cos(direction), arc->center_mm.y + reach * std::sin(direction), middle.z};
}

Result<std::optional<Stroke>> Machine::obey(Command& command) {
  if (command.letter() == 'T') {
    if (command.number() >= 0 && command.number() < static_cast<int>(most_tools))
      tool_ = static_cast<unsigned>(command.number());
    return std::nullopt;  // what lies beyond is no tool: Bambu's T1000 and T255
  }
  if (command.letter() == 'G') {
    switch (command.number()) {
      case 0:
      case 1:
        return move(command, 0);
      case 2:
        return move(command, -1);
      case 3:
        return move(command, 1);
      case 5:
        return unusable("G5 splines cannot be read; export straight moves or arcs");
      default:
        break;
    }
  }
  set_mode(command);
  return std::nullopt;
}

void Machine::set_mode(Command& command) {
  const int number = command.number();
  if (command.letter() == 'G') {
    if (number >= 17 && number <= 19) plane_ = number;
    else if (number == 20 || number == 21) unit_mm_ = number == 20 ? 25.4 : 1;
    else if (number == 28) home(command);
    else if (number == 90 || number == 91) is_relative_ = number == 91;
    else if (number == 92) set_position(command);
  } else if (command.letter() == 'M') {
    if (number == 82 || number == 83) is_e_relative_ = number == 83;
    if (number != 200 && number != 221) return;
    command.read_words();
    if (number == 200) is_volumetric_ = command.value_or('D', 1) > 0 && command.value_or('S', 1) > 0;
    else if (command.value_or('S', 0) > 0) flow_ratio_ = command.value('S') / 100;
  }
}

void Machine::home(Command& command) {
  command.read_words();
  const bool is_all = !names_any(command, "XYZ");  // "G28 X", without a number, homes x alone
  for (int axis = 0; axis < 3; ++axis)
    if (is_all || names(command, axis_name(axis))) at_mm_[axis] = origin_mm_[axis] = 0;
}

void Machine::set_position(Command& command) {
  command.read_words();
  const bool is_all = !names_any(command, "XYZE");
  for (int axis = 0; axis < 3; ++axis)
    if (const char name = axis_name(axis); is_all || command.has(name))
      origin_mm_[axis] = at_mm_[axis] - unit_mm_ * command.value_or(name, 0);
  if (is_all || command.has('E')) e_ = unit_mm_ * command.value_or('E', 0);
}

Vec3 Machine::target(const Command& command) const {
  Vec3 to = at_mm_;
  for (int axis = 0; axis < 3; ++axis) {
    const char name = axis_name(axis);
    if (command.has(name)) to[axis] = unit_mm_ * command.value(name) + (is_relative_ ? at_mm_ : origin_mm_)[axis];
  }
  return to;
}

double Machine::laid_down(double feed) {
  double& owed = owed_[tool_];
  if (feed <= 0) {
    owed -= feed;
    return 0;
  }
  const double paid = std::min(owed, feed);
  owed -= paid;
  return feed - paid;
}

Result<std::optional<Arc>> Machine::arc_to(const Command& command, Vec3 to_mm, int direction) const {
  if (direction == 0) return std::nullopt;
  if (plane_ != 17)
    return unusable("arcs can only be read in the plane of the bed (G17); switch arcs off in the slicer");
  if (command.value_or('P', 0) > 0)
    return unusable("arcs of several turns (P) cannot be read; switch arcs off in the slicer");
  const Vec2 from{at_mm_.x, at_mm_.y}, to{to_mm.x, to_mm.y};
  const auto center = center_of(command, from, to, direction, unit_mm_);
  if (!center) return tl::unexpected(center.error());
  const Vec2 start = from - *center, end = to - *center;
  if (!(std::abs(norm(start) - norm(end)) <= most_radius_error_mm) || norm(start) == 0)
    return unusable(fmt::format("an arc begins {:g} and ends {:g} mm from its centre; slice the model again",
                                norm(start), norm(end)));
  Arc arc{*center, (norm(start) + norm(end)) / 2, angle_of(start), angle_of(end) - angle_of(start)};
  if (direction > 0 && arc.sweep_rad <= 0) arc.sweep_rad += two_pi;
  if (direction < 0 && arc.sweep_rad >= 0) arc.sweep_rad -= two_pi;
  return arc;
}

Result<std::optional<Stroke>> Machine::move(Command& command, int arc_direction) {
  command.read_words();
  Stroke stroke{.from_mm = at_mm_, .to_mm = target(command), .is_volumetric = is_volumetric_, .tool = tool_};
  double feed = 0;
  if (command.has('E')) {
    const double e = unit_mm_ * command.value('E');
    feed = is_relative_ || is_e_relative_ ? e : e - e_;
    e_ += feed;
  }
  if (feed != 0) stroke.feed = flow_ratio_ * laid_down(feed);
  const std::string_view words = arc_direction == 0 ? "XYZE"sv : "XYZEIJRP"sv;
  const bool is_unreadable = std::ranges::any_of(words, [&](char word) { return command.is_unreadable(word); });
  if (is_unreadable && names(command, 'E'))
    return unusable("a move that extrudes has a word without a number of its own; slice the model again");
  if (stroke.feed > 0) {
    auto arc = arc_to(command, stroke.to_mm, arc_direction);
    if (!arc) return tl::unexpected(arc.error());
    stroke.arc = *arc;
  }
  at_mm_ = stroke.to_mm;
  if (!(stroke.feed > 0)) return std::nullopt;
  return stroke;
}

}  // namespace aplomb::detail
