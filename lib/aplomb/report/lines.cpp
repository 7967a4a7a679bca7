#include <algorithm>
#include <cmath>
#include <locale>
#include <numbers>
#include <sstream>

#include "aplomb/report/detail/lines.h"

namespace aplomb::detail {

std::string number(double value, int decimals) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.setf(std::ios::fixed);
  text.precision(decimals);
  const double unit = std::pow(10.0, -decimals);
  text << (std::abs(value) < unit / 2 ? 0.0 : value);  // no "-0.0"
  return text.str();
}

std::string degrees(double angle_rad) {
  const double angle_deg = angle_rad * 180 / std::numbers::pi;
  return number(angle_deg, std::abs(angle_deg) < 0.1 && angle_deg != 0 ? 3 : 1);
}

std::string figure(double value) {
  const int digits_before = value == 0 ? 1 : static_cast<int>(std::floor(std::log10(std::abs(value)))) + 1;
  return number(value, std::clamp(3 - digits_before, 0, 6));
}

std::string point(Vec3 p) {
  return std::string("(") + number(p.x, 1) + ", " + number(p.y, 1) + ", " + number(p.z, 1) + ") mm";
}

std::string line(std::string_view name, const std::string& text) {
  std::string padded(name);
  padded.resize(18, ' ');
  return "  " + padded + text + "\n";
}

std::string lines_of(const InsertFigures& inserts) {
  if (inserts.pockets.empty())
    return line("inserts", "none of " + std::to_string(inserts.allowed) + " used: where they fit, none helps");
  std::string text;
  for (const PocketFigures& p : inserts.pockets)
    text += line(&p == &inserts.pockets.front() ? "inserts" : "",
                 "pause at z = " + number(p.pause_mm, 2) + " mm and put " +
                     (p.count == 1 ? "a " + p.name : std::to_string(p.count) + " x " + p.name) +
                     " in: " + figure(p.mass_g) + " g at " + point(p.at_mm));
  const std::string count = std::to_string(inserts.count()) + " of " + std::to_string(inserts.allowed);
  std::string known = count + " used; ";
  if (inserts.bound_of == BoundOf::tip)
    known += "alone they reach " + degrees(inserts.reached_rad) + " degrees, and as many elsewhere at most " +
             degrees(inserts.bound_rad);
  else if (inserts.bound_of == BoundOf::tilt)
    known += "alone they come to " + degrees(inserts.reached_rad) + " degrees from level, and as many elsewhere to " +
             degrees(inserts.bound_rad) + " at best";
  else known += inserts.reached_rad >= 0 ? "alone they meet every pose" : "alone they do not meet every pose";
  return text + line("", known + " (places " + figure(inserts.step_mm) + " mm apart)");
}

}  // namespace aplomb::detail
