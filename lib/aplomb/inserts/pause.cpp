#include "aplomb/inserts/pause.h"

#include <fmt/format.h>

#include <algorithm>

namespace aplomb {
namespace {

constexpr double same_layer_mm = 1e-3;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') out += "&amp;";
    else if (c == '<') out += "&lt;";
    else if (c == '"') out += "&quot;";
    else out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return out;
}

}  // namespace

std::string prusaslicer_pauses(std::vector<Pause> pauses) {
  std::ranges::stable_sort(pauses, {}, &Pause::first_print_mm);
  std::vector<Pause> joined;
  for (Pause& pause : pauses)
    if (!joined.empty() && pause.first_print_mm - joined.back().first_print_mm < same_layer_mm)
      joined.back().message += ", " + pause.message;
    else joined.push_back(std::move(pause));
  std::string xml = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<custom_gcodes_per_print_z>\n";
  for (const Pause& pause : joined)
    xml += fmt::format("<code print_z=\"{:.6g}\" type=\"1\" extruder=\"1\" color=\"\" extra=\"{}\" gcode=\"M601\"/>\n",
                       pause.first_print_mm, escaped(pause.message));
  return xml + "<mode value=\"SingleExtruder\"/>\n</custom_gcodes_per_print_z>\n";
}

}  // namespace aplomb
