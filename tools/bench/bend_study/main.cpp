#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "studies.h"

int main(int count, char** words) {
  using namespace aplomb::bench;
  CLI::App app{"Measures bending: how its surface follows, what solving with carving gains, what a step costs"};
  StudyOptions options;
  std::vector<std::string> models;
  app.add_option("--height", options.height_mm, "Of every model, in mm")->check(CLI::PositiveNumber);
  app.add_option("--wall", options.wall_mm, "In mm")->check(CLI::PositiveNumber);
  app.add_option("--contact-height", options.contact_height_mm, "In mm")->check(CLI::PositiveNumber);
  app.add_option("--limit", options.most_mean_percent, "Mean displacement, in percent of the height")
      ->check(CLI::PositiveNumber);
  app.add_option("--tip", options.to_deg, "Tip angle asked for, in degrees; default: see --beyond");
  app.add_option("--beyond", options.beyond_deg, "Tip angle asked for beyond what carving reaches, in degrees");
  app.add_option("--spacing", options.spacings, "ARAP: between controls, in cubes of the cage")->delimiter(',');
  app.add_option("--alpha", options.alphas, "ARAP: how much neighbouring rotations must agree")->delimiter(',');
  app.add_option("--arap-iterations", options.arap_iterations, "ARAP")->check(CLI::Range(1, 1000));
  app.add_option("--folder", options.folder, "Where the surfaces are written")->check(CLI::ExistingDirectory);
  app.require_subcommand(1)->fallthrough();
  const auto add = [&](const char* name, const char* what) {
    CLI::App* study = app.add_subcommand(name, what);
    study->add_option("models", models, "Mesh files; FILE@y where y is up")->required();
    return study;
  };
  const CLI::App* surface = add("surface", "Linear embedding, Phong deformation and SRE-ARAP by their creases");
  const CLI::App* joint = add("joint", "Carving and bending together against one after the other");
  add("preview", "Time of a step by the size of the cage");
  CLI11_PARSE(app, count, words);
  const auto done = surface->parsed() ? study_surface(models, options)
                    : joint->parsed() ? study_joint(models, options)
                                      : study_preview(models, options);
  if (done) return 0;
  fmt::print(stderr, "bend_study: {}\n", done.error().message);
  return 1;
}
