#include "study_model.h"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <numbers>

#include "aplomb/deform/bend.h"
#include "aplomb/pipeline.h"

namespace aplomb::bench {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// As Bender does it: every cage vertex that carries a held vertex.
std::vector<bool> fixed_vertices(const Cage& cage, const SolidMesh& solid, const std::vector<bool>& held) {
  std::vector<bool> fixed(cage.mesh().vertices.size());
  for (std::size_t v = 0; v < held.size(); ++v)
    if (const auto point = held[v] ? cage.embed(solid.mesh().vertices[v]) : std::nullopt)
      for (const std::uint32_t corner : cage.mesh().tets[point->tet]) fixed[corner] = true;
  return fixed;
}

double volume_of(const TetMesh::Tet& t, const std::vector<Vec3>& v) {
  return signed_volume(v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
}

}  // namespace

Result<StudyModel> load_model(const std::string& named, const StudyOptions& options) {
  const std::size_t at = named.rfind('@');
  const std::filesystem::path path = named.substr(0, at);
  InputOptions input_options;
  input_options.placement.height_mm = options.height_mm;
  if (at != std::string::npos) input_options.placement.up = up_axis_named(named.substr(at + 1));
  const auto input = load_solid(path, input_options);
  if (!input) return tl::unexpected(input.error());
  StandingPose pose;
  pose.contact_height_mm = options.contact_height_mm;
  const std::vector<Pose> poses{{.name = {}, .way = pose}};
  const auto joint = joint_problem(input->solid.mesh(), poses, RowKind::nominal);
  if (!joint) return tl::unexpected(joint.error());
  auto cage = build_cage(input->solid, {.wall_mm = options.wall_mm, .samples = options.samples});
  if (!cage) return tl::unexpected(cage.error());
  StudyModel model{path.stem().string(), input->solid, std::move(*cage), {}, {}};
  model.held = vertices_near_plate(model.solid.mesh(), pose.up, pose.contact_height_mm);
  model.problem.rest = model.cage.mesh();
  model.problem.solid_share = model.cage.solid_share();
  model.problem.stiffness.assign(model.cage.mesh().tets.size(), 1);
  model.problem.fixed = fixed_vertices(model.cage, model.solid, model.held);
  model.problem.samples = model.cage.samples();
  model.problem.balance = joint->problem;
  model.problem.grounds.push_back({pose.up, model.solid.box().min.z});
  return model;
}

Result<CageDeformation> at_rest(const CageProblem& problem) {
  DeformOptions options;
  options.most_iterations = 0;
  return deform_cage(problem, options);
}

Result<CageDeformation> bent(CageProblem problem, double required_t, const StudyOptions& options) {
  problem.required_t = required_t;
  DeformOptions deform_options;
  deform_options.most_mean_mm = options.most_mean_percent / 100 * options.height_mm;
  return deform_cage(problem, deform_options);
}

double asked_t(const StudyOptions& options, double carved_t) {
  if (options.to_deg) return std::tan(*options.to_deg * degree);
  return std::tan(std::atan(carved_t) + options.beyond_deg * degree);
}

Moments sample_moments(const CageProblem& problem, const std::vector<Vec3>& vertices) {
  Moments sum;
  for (const SolidSample& sample : problem.samples) {
    const TetMesh::Tet& tet = problem.rest.tets[sample.at.tet];
    const double volume = sample.volume_mm3 * volume_of(tet, vertices) / volume_of(tet, problem.rest.vertices);
    sum += Moments{volume, volume * sample.at.position(problem.rest, vertices)};
  }
  return sum;
}

double degrees_of(double t) { return std::atan(t) / degree; }

double cpu_s() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Result<void> for_each_model(const std::vector<std::string>& models, const StudyOptions& options,
                            const std::function<Result<void>(const StudyModel&, const StudyOptions&)>& print) {
  for (const std::string& named : models) {
    const auto model = load_model(named, options);
    if (!model) return tl::unexpected(model.error());
    if (auto printed = print(*model, options); !printed) return printed;
    std::fflush(stdout);
  }
  return {};
}

}  // namespace aplomb::bench
