#include "arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

#include "quantities.h"

namespace aplomb::cli {
namespace {

constexpr int usage_exit = 1;

/// Binds a flag with a unit to a field; CLI11 prints what is thrown.
template <class Field>
CLI::Option* add_quantity(CLI::App* app, const std::string& flag, Field& field, const std::vector<Unit>& units,
                          const std::string& help) {
  return app->add_option_function<std::string>(
      flag,
      [&field, &units, flag](const std::string& text) {
        const auto value = parse_quantity(text, units);
        if (!value)
          throw CLI::ValidationError(
              flag, fmt::format("'{}' is no number with a unit such as {}{}", text, 10, units.front().name));
        field = static_cast<typename std::remove_reference_t<decltype(*std::optional<Field>())>>(*value);
      },
      help);
}

template <>
CLI::Option* add_quantity(CLI::App* app, const std::string& flag, std::optional<double>& field,
                          const std::vector<Unit>& units, const std::string& help) {
  return app->add_option_function<std::string>(
      flag,
      [&field, &units, flag](const std::string& text) {
        field = parse_quantity(text, units);
        if (!field)
          throw CLI::ValidationError(
              flag, fmt::format("'{}' is no number with a unit such as 10{}", text, units.front().name));
      },
      help);
}

void add_input_options(CLI::App* app, Arguments& a) {
  app->add_option("MODEL", a.model, "STL, OBJ, PLY, OFF or 3MF file; - reads an STL from standard input")->required();
  app->add_option("--object", a.input.object, "which print of a file that holds several, from 1");
  app->add_option_function<std::string>(
      "--up",
      [&a](const std::string& text) {
        a.input.placement.up = up_axis_named(text);
        if (!a.input.placement.up) throw CLI::ValidationError("--up", "'" + text + "' is none of x y z -x -y -z");
      },
      "the file's direction that points up: x y z -x -y -z (default z)");
  app->add_option_function<std::string>(
      "--rotate",
      [&a](const std::string& text) {
        const auto turns = parse_numbers(text);
        if (!turns || turns->size() != 3)
          throw CLI::ValidationError("--rotate", "'" + text + "' is not X,Y,Z in degrees");
        const double degree = angles.front().factor;
        a.input.placement.turns = turns_about_xyz({(*turns)[0] * degree, (*turns)[1] * degree, (*turns)[2] * degree});
      },
      "turn about the plate's axes, after --up: X,Y,Z in degrees");
  add_quantity(app, "--unit", a.input.placement.unit_mm, lengths, "length of one unit of the file (default 1mm)");
  app->add_option("--scale", a.input.placement.scale, "scale by this factor");
  add_quantity(app, "--height", a.input.placement.height_mm, lengths, "scale to this height, such as 100mm");
  app->add_flag("--repair-force", a.input.repair.insist, "accept a solid of which most had to be made up");
  app->add_option(
      "--contact", a.contacts,
      "what may touch the plate: auto, or points X,Y,Z[,R] in mm with a radius (default 5 % of the height)");
  add_quantity(app, "--contact-height", a.stand.pose.contact_height_mm, lengths,
               "how far above the lowest point still touches (default 0.1mm)");
  add_quantity(app, "--tip", a.stand.pose.required_tip_rad, angles, "tip angle asked for (default 10deg)");
  app->add_flag("--robust", a.stand.robust, "ask it of the robust tip angle");
  static const std::map<std::string, double> densities{{"pla", 1.24}, {"petg", 1.27},  {"abs", 1.04}, {"asa", 1.07},
                                                       {"tpu", 1.22}, {"resin", 1.15}, {"pa12", 1.01}};
  app->add_option_function<std::string>(
         "--material", [&a](const std::string& name) { a.stand.density_g_per_cm3 = densities.at(name); },
         "pla petg abs asa tpu resin pa12 (default pla)")
      ->check(CLI::IsMember(densities));
  app->add_option("--density", a.stand.density_g_per_cm3, "in g/cm3, instead of the material's");
  app->add_option("--report", a.report, "write the report as JSON; - is standard output");
  app->add_option("--threads", a.threads, "at most this many (default: one per core)")->check(CLI::NonNegativeNumber);
  add_quantity(app, "--memory", a.stand.memory_bytes, memories, "memory budget, such as 2GB (default 4GB)");
  app->add_flag("-q,--quiet", a.quiet, "no progress and no summary");
}

void add_stand_options(CLI::App* app, Arguments& a) {
  app->add_option("-o,--output", a.output, "3MF, STL, OBJ or PLY file; - writes an STL to standard output")->required();
  static const std::map<std::string, CarveAim> aims{
      {"least", CarveAim::least}, {"light", CarveAim::light}, {"stable", CarveAim::stable}};
  app->add_option_function<std::string>(
         "--aim", [&a](const std::string& name) { a.stand.aim = aims.at(name); },
         "least: remove least; light: remove most; stable: the largest tip angle (default least)")
      ->check(CLI::IsMember(aims));
  static const std::map<std::string, double> walls{{"fdm", 1.6}, {"sla", 2}, {"powder", 1.5}, {"binder", 3}};
  app->add_option_function<std::string>(
         "--process", [&a](const std::string& name) { a.stand.wall_mm = walls.at(name); },
         "fdm (wall 1.6mm), sla (2mm), powder (1.5mm) or binder (3mm); --wall overrides (default fdm)")
      ->check(CLI::IsMember(walls))
      ->trigger_on_parse();
  add_quantity(app, "--wall", a.stand.wall_mm, lengths, "least wall between void and outside (default: the process's)");
  add_quantity(app, "--voxel", a.stand.voxel_mm, lengths, "grid spacing (default: 4 in a wall, 256 on the diagonal)");
  add_quantity(app, "--least-void", a.stand.least_void_mm, lengths, "no void narrower than this (default 1mm)");
  app->add_option("--least-volume", a.stand.least_volume_mm3, "no void smaller than this, in mm3 (default 10)");
  app->add_flag("--best-effort", a.stand.best_effort, "write the best that can be reached when it will not stand");
  app->add_option("--dump", a.dump, "write what each stage made into this folder");
}

std::vector<std::pair<std::string, std::string>> flags_given(const CLI::App& app) {
  std::vector<std::pair<std::string, std::string>> given;
  for (const CLI::Option* option : app.get_options())
    if (option->count() > 0 && !option->get_lnames().empty())
      given.emplace_back(option->get_lnames().front(), fmt::format("{}", fmt::join(option->results(), " ")));
  return given;
}

}  // namespace

Parsed parse_arguments(int argc, char** argv) {
  Arguments a;
  CLI::App app(
      "Aplomb makes 3D prints stand: it carves a void that moves the centre of mass, and measures the result.");
  app.set_version_flag("--version", "aplomb " APLOMB_VERSION);
  app.require_subcommand(1);
  CLI::App* check = app.add_subcommand("check", "say whether a model stands, and by how many degrees");
  CLI::App* stand = app.add_subcommand("stand", "carve a model so that it stands");
  for (CLI::App* command : {check, stand}) add_input_options(command, a);
  add_stand_options(stand, a);
  app.footer("Exit: 0 stands; 1 usage; 2 input unusable; 3 cannot stand; 4 cancelled; 5 over budget; 7 internal.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return {std::nullopt, app.exit(error) == 0 ? 0 : usage_exit};
  }
  a.command = stand->parsed() ? Command::stand : Command::check;
  a.given = flags_given(stand->parsed() ? *stand : *check);
  a.input.read.memory_bytes = a.stand.memory_bytes;
  for (const std::string& problem :
       {find_problem(a.input.placement), find_problem(a.input.repair), find_problem(a.stand)})
    if (!problem.empty()) {
      fmt::print(stderr, "aplomb: {}\n", problem);
      return {std::nullopt, usage_exit};
    }
  return {std::move(a), 0};
}

Result<std::vector<Contact>> contacts_of(const std::vector<std::string>& texts, double height_mm) {
  std::vector<Contact> contacts;
  for (const std::string& text : texts) {
    if (text == "auto") continue;
    const auto numbers = parse_numbers(text);
    if (!numbers || numbers->size() < 3 || numbers->size() > 4)
      return fail(ErrorCode::invalid_option, fmt::format("--contact '{}' is neither auto nor X,Y,Z[,R] in mm", text));
    contacts.push_back(
        {{(*numbers)[0], (*numbers)[1], (*numbers)[2]}, numbers->size() == 4 ? (*numbers)[3] : 0.05 * height_mm});
  }
  return contacts;
}

}  // namespace aplomb::cli
