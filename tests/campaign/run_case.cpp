#include "campaign/run_case.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "aplomb/ending.h"
#include "aplomb/io/write_mesh.h"
#include "aplomb/report/json.h"
#include "campaign/case.h"

namespace aplomb::campaign {
namespace {

using nlohmann::json;
constexpr double degrees = 180 / std::numbers::pi;
constexpr std::chrono::seconds patience{300};  // a case takes a second
// The bound is of a sum over cells, of which one that both the plane and the region's rim cut is kept by its share; the
// void is a polyhedron. 9e-6 was seen.
constexpr double bound_tolerance = 1e-4;

json coordinates(Vec3 v) { return {v.x, v.y, v.z}; }

json claims_of(const PoseReport& pose) {
  json claims{{"up", coordinates(pose.pose.up())}, {"holds", pose.holds}};
  if (const StandingPose* asked = pose.pose.standing()) {
    const Stability& after = std::get<Standing>(*pose.after).stability;
    claims.update({{"kind", "standing"},
                   {"contact_height_mm", asked->contact_height_mm},
                   {"required_deg", asked->required_tip_rad * degrees},
                   {"xy_error_mm", asked->xy_error_mm},
                   {"can_stand", after.can_stand},
                   {"tip_deg", after.tip_rad * degrees},
                   {"robust_tip_deg", after.robust_tip_rad * degrees},
                   {"volume_mm3", after.volume_mm3},
                   {"com_mm", coordinates(after.com_mm)}});
    return claims;
  }
  const HangingPose& asked = *pose.pose.hanging();
  const Hanging& after = std::get<Hanging>(*pose.after);
  claims.update({{"kind", "hanging"},
                 {"required_deg", asked.required_tilt_rad * degrees},
                 {"least_drop_mm", asked.least_drop_mm},
                 {"tilt_deg", after.tilt_rad * degrees},
                 {"volume_mm3", after.volume_mm3},
                 {"com_mm", coordinates(after.com_mm)},
                 {"attachments_mm", json::array()}});
  for (const Vec3& point : asked.attachments_mm) claims["attachments_mm"].push_back(coordinates(point));
  return claims;
}

json claims_of(const Report& report, const StandRun& run, const StandOptions& options) {
  json claims{{"outcome", to_string(report.outcome)}, {"robust", kind_of(options) == RowKind::robust},
              {"voids", report.mesh->voids},          {"own_triangles", run.shell->outer_triangles},
              {"drilled", !report.holes.empty()},     {"poses", json::array()}};
  for (const PoseReport& pose : report.poses) claims["poses"].push_back(claims_of(pose));
  if (report.wall)
    claims["wall"] = {{"required_mm", report.wall->required_mm}, {"measured_mm", report.wall->measured_mm}};
  if (report.carving) {
    constexpr std::array<const char*, 3> kinds{"tip", "tilt", "surplus"};
    claims["bound"] = {{"of", kinds[static_cast<std::size_t>(report.carving->bound_of)]},
                       {"deg", report.carving->bound_rad * degrees}};
  }
  return claims;
}

/// Whether the outside, where it is said to be unchanged, is the figure's own, bit for bit.
bool is_outside_kept(const TriangleMesh& figure, const TriangleMesh& written) {
  for (std::size_t t = 0; t < figure.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      if (figure.vertices[figure.triangles[t][corner]] != written.vertices[written.triangles[t][corner]]) return false;
  return true;
}

/// What is wrong by what the run itself knows.
std::string broken_promise(const TriangleMesh& figure, const TriangleMesh& written, const Input& input,
                           const StandRun& run, const Report& report, const StandOptions& options) {
  if (!report.mesh->closed || report.mesh->self_intersections > 0) return "what was written is no solid";
  if (report.mesh->outer_unchanged && !is_outside_kept(rounded_to_float(figure), written))
    return "the outside is said to be unchanged and is not";
  if (report.outcome == Outcome::best_effort && all_hold(report)) return "it holds and is called a best effort";
  if (!run.carving || report.deformation) return {};
  const Carving& carving = *run.carving;
  if (carving.t > carving.bound_t + bound_tolerance)
    return fmt::format("t {} is beyond its bound {}", carving.t, carving.bound_t);
  const double carved_mm3 = input.moments.volume_mm3 - carving.body.volume_mm3;
  const double off_mm3 = 1e-6 * input.moments.volume_mm3;
  if (!report.holes.empty() || report.carving->ceiling) return {};  // the bounds are of a carving with other aims
  if (options.aim == CarveAim::least && carving.reaches && carved_mm3 < carving.volume_bound_mm3 - off_mm3)
    return fmt::format("a void of {} mm3 serves, and {} is the certified least", carved_mm3, carving.volume_bound_mm3);
  if (options.aim == CarveAim::light && carving.reaches && carved_mm3 > carving.volume_bound_mm3 + off_mm3)
    return fmt::format("a void of {} mm3 was carved, and {} is the certified most", carved_mm3,
                       carving.volume_bound_mm3);
  return {};
}

/// Spoils what a judge is to look at. \pre something was carved and not drilled.
void make_wrong(Spoil spoil, TriangleMesh& written, json& claims) {
  const std::size_t first = claims["own_triangles"];
  if (spoil == Spoil::hole) written.triangles.pop_back();
  const bool has_void = first < written.triangles.size();  // else there is nothing of it to spoil
  if (spoil == Spoil::winding && has_void) std::swap(written.triangles[first][0], written.triangles[first][1]);
  if (spoil == Spoil::wall &&
      has_void) {  // a corner of the void goes nearer to the outside, the void turning no inside out
    Vec3& moved = written.vertices[written.triangles[first][0]];
    Vec3 nearest{};
    double least = 1e300;
    for (std::size_t t = 0; t < first; ++t)
      for (const std::uint32_t v : written.triangles[t])
        if (const double far = norm(written.vertices[v] - moved); far < least)
          least = far, nearest = written.vertices[v];
    moved = moved + 0.5 * (nearest - moved);
    written = rounded_to_float(std::move(written));
  }
  json& pose = claims["poses"][0];
  if (spoil == Spoil::angle) {
    const char* angle = pose["kind"] == "standing" ? "tip_deg" : "tilt_deg";
    pose[angle] = pose[angle].get<double>() + 0.01;
  }
  if (spoil == Spoil::bound) claims["bound"]["deg"] = claims["bound"]["of"] == "tilt" ? 180.0 : -90.0;
  if (spoil == Spoil::outcome) claims["outcome"] = claims["outcome"] == "best_effort" ? "stands" : "best_effort";
}

CaseEnd judged(const TriangleMesh& figure, const Input& input, const StandRun& run, const StandOptions& options,
               const std::filesystem::path& written_to, Spoil spoil, const Job& job) {
  TriangleMesh written = rounded_to_float(run.shell->mesh);
  const auto report = measure_output(written, input, run, options, job);
  if (!report) return {"error", "measure_output: " + report.error().message};
  CaseEnd end{to_string(report->outcome), {}, report->mesh->voids > 0 && report->carving};
  end.wrong = broken_promise(figure, written, input, run, *report, options);
  json claims = claims_of(*report, run, options);
  make_wrong(spoil, written, claims);
  const auto stl = encode_mesh(written, MeshFormat::stl);
  if (!stl) return {"error", "encode_mesh: " + stl.error().message};
  std::ofstream(std::filesystem::path(written_to) += ".stl", std::ios::binary)
      .write(reinterpret_cast<const char*>(stl->data()), static_cast<std::streamsize>(stl->size()));
  std::ofstream(std::filesystem::path(written_to) += ".json") << claims;
  return end;
}

}  // namespace

CaseEnd run_case(std::uint64_t number, const std::filesystem::path& folder, Spoil spoil) {
  const Case a_case = case_of(number);
  const TriangleMesh figure = mesh_of(a_case.figure);
  const auto until = std::chrono::steady_clock::now() + patience;
  const Job job([until](double, std::string_view) { return std::chrono::steady_clock::now() < until; });
  const MeshFile file{"made", 1, true, {{"figure", figure}}, {}};
  const auto input = load_solid(file, {}, job);
  if (!input && input.error().code == ErrorCode::unusable_input) return {"refused", {}};
  if (!input) return {"error", "load_solid: " + input.error().message};
  const StandOptions options = options_of(a_case, input->solid);
  if (const std::string problem = find_problem(options); !problem.empty()) return {"error", problem};
  const auto run = stand(*input, options, job);
  if (!run) return {"error", "stand: " + run.error().message};
  if (!run->shell) return {"error", "a best effort was asked for, and nothing was made"};
  return judged(figure, *input, *run, options, folder / std::to_string(number), spoil, job);
}

}  // namespace aplomb::campaign
