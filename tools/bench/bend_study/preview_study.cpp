#include <fmt/format.h>

#include <chrono>

#include "aplomb/deform/surface_motion.h"
#include "studies.h"

namespace aplomb::bench {
namespace {

double wall_clock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The bend with the surface moved at every iterate, as a window would show it.
struct Preview {
  int updates = 0;
  double deform_cpu_s = 0, surface_cpu_s = 0, seconds = 0;
};

Result<Preview> preview(const StudyModel& model, double required_t, const StudyOptions& options) {
  const auto motion = SurfaceMotion::make(model.cage, model.solid.mesh());
  if (!motion) return tl::unexpected(motion.error());
  CageProblem problem = model.problem;
  problem.required_t = required_t;
  DeformOptions deform_options;
  deform_options.most_mean_mm = options.most_mean_percent / 100 * options.height_mm;
  Preview made;
  const double cpu_before = cpu_s(), before = wall_clock_s();
  const auto show = [&](const std::vector<Vec3>& vertices, double) {
    const double start = cpu_s();
    const TriangleMesh surface = motion->moved(vertices);
    made.surface_cpu_s += cpu_s() - start;
    ++made.updates;
  };
  const auto cage = deform_cage(problem, deform_options, show);
  if (!cage) return tl::unexpected(cage.error());
  made.seconds = wall_clock_s() - before;
  made.deform_cpu_s = cpu_s() - cpu_before - made.surface_cpu_s;
  return made;
}

}  // namespace

Result<void> study_preview(const std::vector<std::string>& models, const StudyOptions& options) {
  fmt::print(
      "| model | triangles | samples | tetrahedra | load and cage CPU s | bend to deg | updates | deform CPU ms an "
      "update | "
      "surface CPU ms an update | updates a second |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& named : models)
    for (const std::size_t samples : {7000UL, 24000UL, 60000UL, 90000UL, 350000UL}) {
      StudyOptions sized = options;
      sized.samples = samples;
      const double before = cpu_s();
      const auto model = load_model(named, sized);
      if (!model) return tl::unexpected(model.error());
      const double load_s = cpu_s() - before;
      const auto rest = at_rest(model->problem);
      if (!rest) return tl::unexpected(rest.error());
      const double asked = asked_t(options, rest->t);
      const auto made = preview(*model, asked, options);
      if (!made) return tl::unexpected(made.error());
      fmt::print("| {} | {} | {} | {} | {:.2f} | {:.1f} | {} | {:.0f} | {:.0f} | {:.1f} |\n", model->name,
                 model->solid.mesh().triangles.size(), samples, model->cage.mesh().tets.size(), load_s,
                 degrees_of(asked), made->updates, 1000 * made->deform_cpu_s / made->updates,
                 1000 * made->surface_cpu_s / made->updates, made->updates / made->seconds);
      std::fflush(stdout);
    }
  return {};
}

}  // namespace aplomb::bench
