#include "flags.h"

#include "quantity_flags.h"

namespace aplomb::cli {

void add_input_flags(CLI::App* app, Arguments& a) {
  JobFile& job = a.job;
  app->add_option("MODEL", job.model, "STL, OBJ, PLY, OFF or 3MF file; - reads an STL from standard input")->required();
  app->add_option("--object", job.input.object, "which print of a file that holds several, from 1");
  app->add_option_function<std::string>(
      "--up",
      [&job](const std::string& text) {
        job.input.placement.up = up_axis_named(text);
        if (!job.input.placement.up) throw CLI::ValidationError("--up", "'" + text + "' is none of x y z -x -y -z");
      },
      "the file's direction that points up: x y z -x -y -z (default z)");
  app->add_option_function<std::string>(
      "--rotate",
      [&job](const std::string& text) {
        const auto turns = numbers_of("--rotate", text, 3, 3, "X,Y,Z in degrees");
        job.input.placement.turns = turns_about_xyz(angles.front().factor * Vec3{turns[0], turns[1], turns[2]});
      },
      "turn about the plate's axes, after --up: X,Y,Z in degrees");
  add_quantity(app, "--unit", job.input.placement.unit_mm, lengths, "length of one unit of the file (default 1mm)");
  app->add_option("--scale", job.input.placement.scale, "scale by this factor");
  add_quantity(app, "--height", job.input.placement.height_mm, lengths, "scale to this height, such as 100mm");
  app->add_flag("--repair-force", job.input.repair.insist, "accept a solid of which most had to be made up");
}

void add_standing_flags(CLI::App* app, Arguments& a, StandingPose& pose) {
  app->add_option_function<std::vector<std::string>>(
      "--contact",
      [&a](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) {
          if (text == "auto") continue;
          const auto n = numbers_of("--contact", text, 3, 4, "auto or X,Y,Z[,R] in mm");
          a.job.poses.front().contacts.push_back(
              {{n[0], n[1], n[2]}, n.size() == 4 ? std::optional(n[3]) : std::nullopt});
        }
      },
      "what may touch the plate: auto, or points X,Y,Z[,R] in mm with a radius (default 5 % of the height)");
  add_quantity(app, "--contact-height", pose.contact_height_mm, lengths,
               "how far above the lowest point still touches (default 0.1mm)");
  add_quantity(app, "--tip", pose.required_tip_rad, angles, "tip angle asked for (default 10deg)");
  app->add_flag("--robust", a.job.options.robust, "ask it of the robust tip angle");
}

void add_hanging_flags(CLI::App* app, HangingPose& pose) {
  app->add_option_function<std::vector<std::string>>(
         "--from",
         [&pose](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             const auto n = numbers_of("--from", text, 3, 3, "X,Y,Z in mm");
             pose.attachments_mm.push_back({n[0], n[1], n[2]});
           }
         },
         "a point to hang from, X,Y,Z in mm, on the surface or inside; give it twice for two threads")
      ->required();
  add_quantity(app, "--tilt", pose.required_tilt_rad, angles, "how far from level it may hang (default 2deg)");
}

void add_carving_flags(CLI::App* app, Arguments& a) {
  StandOptions& options = a.job.options;
  app->add_option("-o,--output", a.job.output, "3MF, STL, OBJ or PLY file; - writes an STL to standard output")
      ->required();
  static const std::map<std::string, CarveAim> aims{
      {"least", CarveAim::least}, {"light", CarveAim::light}, {"stable", CarveAim::stable}};
  add_choice(
      app, "--aim", {"least", "light", "stable"}, [&options](const std::string& name) { options.aim = aims.at(name); },
      "least: remove least; light: remove most; stable: the largest angle (default least)");
  add_quantity(app, "--wall", options.wall_mm, lengths, "least wall between void and outside (default: the process's)");
  static const std::map<std::string, Ceiling> ceilings{{"auto", Ceiling::automatic}, {"any", Ceiling::any}};
  add_choice(
      app, "--ceiling", {"auto", "any"}, [&options](const std::string& name) { options.ceiling = ceilings.at(name); },
      "auto: voids whose ceilings print without supports (default for fdm); any: as balance has them");
  add_quantity(app, "--voxel", options.voxel_mm, lengths, "grid spacing (default: 4 in a wall, 256 on the diagonal)");
  add_quantity(app, "--least-void", options.least_void_mm, lengths, "no void narrower than this (default 1mm)");
  app->add_option("--least-volume", options.least_volume_mm3, "no void smaller than this, in mm3 (default 10)");
  app->add_option(
      "--insert", a.job.inserts,
      "coins or balls that may be laid into pockets while it prints, at most so many: penny:4 (nickel, dime, "
      "quarter), ball:10mm:6 (steel), coin:19.05x1.52mm:2.5g:4; pauses go into a 3MF for PrusaSlicer");
  add_choice(
      app, "--holes", {"auto", "none"},
      [&options](const std::string& name) { options.holes = name == "none" ? Holes::none : Holes::automatic; },
      "escape holes: auto (default; as the process asks for them, fdm for none) or none");
  app->add_option("--plugs", a.job.plugs, "write plugs for the escape holes into this 3MF, STL, OBJ or PLY file");
  app->add_flag("--best-effort", options.best_effort, "write the best that can be reached where it is not enough");
  app->add_option("--dump", a.job.dump, "write what each stage made into this folder");
  app->add_option("--save-job", a.save_job, "write this command as a job file, for aplomb run");
}

void add_reshaping_flags(CLI::App* app, Arguments& a) {
  StandOptions& options = a.job.options;
  static const std::map<std::string, Deform> modes{
      {"never", Deform::never}, {"auto", Deform::automatic}, {"only", Deform::only}};
  add_choice(
      app, "--deform", {"never", "auto", "only"},
      [&options](const std::string& name) { options.deform = modes.at(name); },
      "whether the outside may change: never (default); auto: where no void serves; only: instead of carving");
  add_quantity(app, "--deform-limit", options.reshape.most_mean_percent, percentages,
               "mean displacement of a bend, of the height (default 5%)");
  app->add_option_function<std::string>(
      "--trim-base",
      [&options](const std::string& text) {
        if (text == "auto") return;
        options.reshape.most_trim_mm = parse_quantity(text, lengths);
        if (!options.reshape.most_trim_mm)
          throw CLI::ValidationError("--trim-base", "'" + text + "' is neither auto nor a length such as 1mm");
      },
      "how much may be cut off the base before bending: auto (1 % of the height, default), 0 or a length");
  add_region_flags(app, options.reshape.regions);
}

void add_ballast_flags(CLI::App* app, Arguments& a) {
  StandOptions& options = a.job.options;
  app->add_flag_function(
      "--ballast,!--no-ballast",
      [&options](std::int64_t count) { options.ballast = count > 0 ? Ballasting::only : Ballasting::never; },
      "move mass by denser infill on one side, or never (default: where --profile has sparse infill)");
  const auto add_ratio = [app](const std::string& flag, auto& field_ratio, const std::string& help) {
    app->add_option_function<std::string>(
        flag,
        [flag, &field_ratio](const std::string& text) {
          const auto percent = parse_quantity(text, percentages);
          if (!percent) throw CLI::ValidationError(flag, "'" + text + "' is no share such as 15%");
          field_ratio = *percent / 100;
        },
        help);
  };
  add_ratio("--ballast-low", options.ballast_low_ratio, "infill of the light side (default: the profile's)");
  add_ratio("--ballast-high", options.ballast_high_ratio, "infill of the dense side (default 100%)");
  static const std::map<std::string, Flavor> flavors{
      {"prusaslicer", Flavor::prusaslicer}, {"orca", Flavor::orca}, {"bambu", Flavor::orca}, {"cura", Flavor::cura}};
  add_choice(
      app, "--flavor", {"prusaslicer", "orca", "bambu", "cura"},
      [&a](const std::string& name) { a.job.flavor = flavors.at(name); },
      "whose words the 3MF uses for that: prusaslicer orca bambu cura (default: the profile's slicer)");
  app->add_option("--modifier", a.job.modifier,
                  "write the volume of denser infill into this 3MF, STL, OBJ or PLY file");
}

void add_progress_flag(CLI::App* app, Arguments& a) {
  add_choice(
      app, "--progress", {"auto", "json"}, [&a](const std::string& name) { a.is_progress_json = name == "json"; },
      "auto: a line on a terminal (default); json: lines {\"progress\": 0.25, \"stage\": \"carve\"} on standard error");
}

void add_profile_flag(CLI::App* app, Arguments& a) {
  app->add_option(
      "--profile", a.job.profile,
      "measure it as it is sliced: an .ini of PrusaSlicer, its G-code, or Cura's settings as JSON or lines");
}

void add_time_flag(CLI::App* app, Arguments& a) {
  add_quantity(app, "--time", a.time_s, durations, "end after this time, such as 90s or 5min, with exit code 5")
      ->check(CLI::Validator(
          [](std::string& text) {
            const auto seconds = parse_quantity(text, durations);
            return seconds && *seconds > 0 && *seconds <= 1e7 ? std::string() : "must be a time above 0";
          },
          ""));
}

void add_run_flags(CLI::App* app, Arguments& a) {
  add_choice(
      app, "--material", {"pla", "petg", "abs", "asa", "tpu", "resin", "pa12"},
      [&a](const std::string& name) { a.job.options.density_g_per_cm3 = *density_of_material(name); },
      "pla petg abs asa tpu resin pa12 (default pla)");
  app->add_option("--density", a.job.options.density_g_per_cm3, "in g/cm3, instead of the material's");
  app->add_option("--report", a.job.report, "write the report as JSON; - is standard output");
  app->add_option("--threads", a.job.threads, "at most this many (default: one per core)")
      ->check(CLI::NonNegativeNumber);
  add_quantity(app, "--memory", a.job.options.memory_bytes, memories, "memory budget, such as 2GB (default 4GB)");
  app->add_option("--max-triangles", a.job.input.read.max_triangles, "refuse files of more (default 50 million)");
  add_time_flag(app, a);
  add_progress_flag(app, a);
  app->add_flag("-q,--quiet", a.quiet, "no progress and no summary");
}

}  // namespace aplomb::cli
