#include "flags.h"
#include "quantity_flags.h"

namespace aplomb::cli {
namespace {

/// A list by tool: "1.24" or "1.24,1.27".
CLI::Option* add_list(CLI::App* app, const std::string& flag, std::vector<double>& list, const std::string& help) {
  return app->add_option_function<std::string>(
      flag,
      [&list, flag](const std::string& text) {
        list = numbers_of(flag, text, 1, 64, "a number, or one for each tool");
      },
      help);
}

/// A quantity that is kept in other units than those in which it is given.
CLI::Option* add_percent(CLI::App* app, const std::string& flag, double& ratio, const std::string& help) {
  return app->add_option_function<std::string>(
      flag,
      [&ratio, flag](const std::string& text) {
        const auto percent = parse_quantity(text, percentages);
        if (!percent) throw CLI::ValidationError(flag, "'" + text + "' is no share such as 5%");
        ratio = *percent / 100;
      },
      help);
}

}  // namespace

void add_verify_flags(CLI::App* app, Arguments& a) {
  VerifyArguments& verify = a.verify;
  app->add_option("GCODE", verify.program, "G-code in text, of PrusaSlicer, Orca, Bambu Studio, Cura or others")
      ->required();
  add_quantity(app, "--tip", verify.options.required_tip_rad, angles, "tip angle asked for (default 10deg)");
  app->add_option("--object", verify.options.object, "only this one, by its label or its number from 1");
  app->add_flag("--one", verify.gcode.is_one, "all objects are one print: a model and an infill mesh of Cura's in it");
  app->add_option("--expect", verify.expect, "compare with this report of stand or check (its --report)");
  add_percent(app, "--max-mass-error", verify.options.most_mass_error_ratio, "from the report's mass (default 5%)");
  add_quantity(app, "--max-com-error", verify.options.most_com_error_mm, lengths,
               "from the report's centre of mass (default 0.5mm)");
  add_list(app, "--density", verify.gcode.densities_g_per_cm3,
           "of the filament in g/cm3, by tool as in 1.24,1.27 (default: as the G-code says, else 1.24)");
  add_list(app, "--diameter", verify.gcode.diameters_mm,
           "of the filament in mm, by tool (default: as the G-code says, else 1.75)");
  app->add_option("--report", verify.report, "write what was measured as JSON; - is standard output");
  add_time_flag(app, a);
  add_progress_flag(app, a);
  app->add_flag("-q,--quiet", a.quiet, "no progress and no summary");
}

}  // namespace aplomb::cli
