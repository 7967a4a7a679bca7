#include <fmt/format.h>

#include "flags.h"
#include "quantity_flags.h"

namespace aplomb::cli {
namespace {

/// "wall.thin=0.6"
std::pair<std::string, double> limit_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto value = equals == std::string::npos ? std::nullopt : parse_numbers(text.substr(equals + 1));
  if (!value || value->size() != 1)
    throw CLI::ValidationError("--limit", fmt::format("'{}' is no check and number such as wall.thin=0.6", text));
  return {text.substr(0, equals), value->front()};
}

}  // namespace

void add_judging_flags(CLI::App* app, Arguments& a) {
  add_choice(
      app, "--process", {process_names.begin(), process_names.end()},
      [&a](const std::string& name) { a.process = *process_named(name); },
      "fdm (default), sla, powder or binder: which checks are made, and by which limits");
  app->add_option_function<std::vector<std::string>>(
      "--limit",
      [&a](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) a.limits.push_back(limit_of(text));
      },
      "another limit for a check, such as wall.thin=0.6, in its unit");
  app->add_option("--waive", a.waived, "a check whose findings are accepted");
  add_quantity(app, "--layer", a.layer_mm, lengths, "height of a layer (default 0.2mm)");
  app->add_option_function<std::string>(
      "--infill",
      [&a](const std::string& text) {
        const auto percent = parse_quantity(text, percentages);
        if (!percent) throw CLI::ValidationError("--infill", fmt::format("'{}' is no share such as 15%", text));
        a.infill_ratio = *percent / 100;
      },
      "how much of the inside the slicer fills (default 100%)");
}

}  // namespace aplomb::cli
