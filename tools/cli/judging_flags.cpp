#include <fmt/format.h>

#include "flags.h"
#include "quantity_flags.h"

namespace aplomb::cli {
namespace {

/// "wall.thin=0.6"
RuleLimit limit_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  const auto value = equals == std::string::npos ? std::nullopt : parse_numbers(text.substr(equals + 1));
  if (!value || value->size() != 1)
    throw CLI::ValidationError("--limit", fmt::format("'{}' is no check and number such as wall.thin=0.6", text));
  return {text.substr(0, equals), value->front()};
}

}  // namespace

void add_judging_flags(CLI::App* app, Arguments& a) {
  JobFile& job = a.job;
  add_choice(
      app, "--process", {process_names.begin(), process_names.end()},
      [&job](const std::string& name) {
        job.rules.process = *process_named(name);
        job.options.wall_mm = *wall_of_process(name);
      },
      "fdm (default; wall 1.6mm), sla (2mm), powder (1.5mm) or binder (3mm): what the print is judged for, and the "
      "wall")
      ->trigger_on_parse();
  app->add_option_function<std::vector<std::string>>(
      "--limit",
      [&job](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) job.rules.limits.push_back(limit_of(text));
      },
      "another limit for a check, such as wall.thin=0.6, in its unit");
  app->add_option("--waive", job.rules.waived, "a check whose findings are accepted");
  add_quantity(app, "--layer", job.rules.layer_mm, lengths, "height of a layer (default 0.2mm)");
  add_quantity(app, "--infill", job.infill_percent, percentages,
               "how much of the inside the slicer fills (default 100%)");
  app->add_flag("--fem", job.fem, "judge the strength by elasticity, too: what bends, where beams are no beams");
}

}  // namespace aplomb::cli
