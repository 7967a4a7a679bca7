#include <fmt/format.h>

#include <filesystem>

#include "aplomb/deform/surface_motion.h"
#include "aplomb/io/write_mesh.h"
#include "arap_surface.h"
#include "studies.h"
#include "surface_quality.h"

namespace aplomb::bench {
namespace {

struct Method {
  std::string name;
  TriangleMesh surface;
  double cpu_s = 0;
};

TriangleMesh linear_surface(const StudyModel& model, const std::vector<Vec3>& moved_mm) {
  TriangleMesh out = model.solid.mesh();
  for (Vec3& v : out.vertices) v = model.cage.embed(v)->position(model.cage.mesh(), moved_mm);
  return rounded_to_float(std::move(out));
}

Result<std::vector<Method>> moved_surfaces(const StudyModel& model, const std::vector<Vec3>& moved_mm,
                                           const StudyOptions& options) {
  const TriangleMesh& rest = model.solid.mesh();
  std::vector<Method> methods;
  double before = cpu_s();
  methods.push_back({"linear", linear_surface(model, moved_mm), cpu_s() - before});
  before = cpu_s();
  const auto motion = SurfaceMotion::make(model.cage, rest);
  if (!motion) return tl::unexpected(motion.error());
  const TriangleMesh phong = motion->moved(moved_mm);
  methods.push_back({"Phong", phong, cpu_s() - before});
  for (const double cubes : options.spacings)
    for (const double alpha : options.alphas) {
      before = cpu_s();
      auto arap = arap_surface(rest, phong, model.held, {cubes * model.cage.cube_mm(), alpha, options.arap_iterations});
      if (!arap) return fail(ErrorCode::third_party, "CGAL could not factorise its system for " + model.name);
      methods.push_back({fmt::format("ARAP {} cubes, {}", cubes, alpha), std::move(*arap), cpu_s() - before});
    }
  return methods;
}

/// How far the surface's own angle (of the solid, not carved) is from that of the samples the cage balances; what they
/// differ by at rest left out.
double balance_error_deg(const StudyModel& model, const CageDeformation& cage, const TriangleMesh& surface) {
  const auto angle = [&](const Moments& body) { return degrees_of(largest_t(model.problem.balance, body)); };
  return angle(moments(surface)) - angle(sample_moments(model.problem, cage.vertices)) - angle(model.solid.moments()) +
         angle(sample_moments(model.problem, model.problem.rest.vertices));
}

Result<void> print_rows(const StudyModel& model, const StudyOptions& options) {
  const auto rest = at_rest(model.problem);
  if (!rest) return tl::unexpected(rest.error());
  const auto cage = bent(model.problem, asked_t(options, rest->t), options);
  if (!cage) return tl::unexpected(cage.error());
  const auto methods = moved_surfaces(model, cage->vertices, options);
  if (!methods) return tl::unexpected(methods.error());
  for (const Method& method : *methods) {
    const auto q = measure_quality(model.solid.mesh(), method.surface, (*methods)[1].surface);
    const auto checked = check_solid(method.surface);
    if (!checked) return tl::unexpected(checked.error());
    fmt::print(
        "| {} | {} | {:.1f} | {:.1f} | {} | {:.3f} | {:.2f} | {:.1f} | {:.3f} | {:.2f} | {} | {:.3f} | {:+.3f} | "
        "{:.2f} |\n",
        model.name, model.solid.mesh().triangles.size(), degrees_of(cage->t), cage->mean_mm, method.name,
        q.crease_rms_deg, q.crease_p99_deg, q.crease_max_deg, q.unevenness_mean_deg, q.unevenness_p99_deg,
        checked->defects.self_intersections, q.mean_from_mm, balance_error_deg(model, *cage, method.surface),
        method.cpu_s);
    if (options.folder.empty()) continue;
    const auto file = std::filesystem::path(options.folder) / (model.name + "-" + method.name + ".stl");
    if (auto written = write_mesh(file, method.surface); !written) return written;
  }
  if (options.folder.empty()) return {};
  return write_mesh(std::filesystem::path(options.folder) / (model.name + "-before.stl"), model.solid.mesh());
}

}  // namespace

Result<void> study_surface(const std::vector<std::string>& models, const StudyOptions& options) {
  fmt::print(
      "| model | triangles | bent to deg | mean mm | surface | crease rms deg | 99 % | max | uneven mean deg | 99 % | "
      "crossings | from Phong mm | balance error deg | CPU s "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  return for_each_model(models, options, print_rows);
}

}  // namespace aplomb::bench
