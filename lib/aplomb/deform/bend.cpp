#include "aplomb/deform/bend.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "aplomb/deform/surface_motion.h"

namespace aplomb {
namespace {

constexpr std::array<double, 7> path_ratios{1, 0.9, 0.75, 0.5, 0.25, 0.1, 0};  // at 0 it is as it came: a solid

double lowest_mm(const TriangleMesh& mesh, Vec3 up) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& v : mesh.vertices) lowest = std::min(lowest, dot(up, v));
  return lowest;
}

/// Every cage vertex that carries a point which does not move.
std::vector<bool> fixed_vertices(const Cage& cage, const SolidMesh& solid, const BendProblem& problem) {
  std::vector<bool> fixed(cage.mesh().vertices.size());
  const auto fix = [&](Vec3 place) {
    if (const auto point = cage.embed(place))
      for (const std::uint32_t corner : cage.mesh().tets[point->tet]) fixed[corner] = true;
  };
  for (std::size_t v = 0; v < problem.held.size(); ++v)
    if (problem.held[v]) fix(solid.mesh().vertices[v]);
  for (const Vec3& anchor : problem.anchors) fix(anchor);
  return fixed;
}

std::vector<Vec3> between(const std::vector<Vec3>& from, const std::vector<Vec3>& to, double ratio) {
  std::vector<Vec3> out;
  out.reserve(from.size());
  for (std::size_t v = 0; v < from.size(); ++v) out.push_back(ratio == 1 ? to[v] : from[v] + ratio * (to[v] - from[v]));
  return out;
}

/// What a pose holds where it is.
void hold(const Pose& pose, const SolidMesh& solid, BendProblem& problem) {
  if (const StandingPose* standing = pose.standing()) {
    const auto touching = vertices_near_plate(solid.mesh(), standing->up, standing->contact_height_mm);
    for (std::size_t v = 0; v < touching.size(); ++v)
      if (touching[v]) problem.held[v] = true;
    problem.grounds.push_back({standing->up, lowest_mm(solid.mesh(), standing->up)});
  } else {
    const auto& points = pose.hanging()->attachments_mm;
    problem.anchors.insert(problem.anchors.end(), points.begin(), points.end());
  }
}

}  // namespace

struct Bender::Parts {
  SolidMesh solid;
  Cage cage;
  SurfaceMotion motion;
  CageProblem problem;
  std::vector<bool> held;
};

std::vector<bool> vertices_near_plate(const TriangleMesh& mesh, Vec3 up, double height_mm) {
  const double level = lowest_mm(mesh, up) + height_mm;
  std::vector<bool> near(mesh.vertices.size());
  for (std::size_t v = 0; v < near.size(); ++v) near[v] = dot(up, mesh.vertices[v]) <= level;
  return near;
}

BendProblem bend_problem(const SolidMesh& solid, std::span<const Pose> poses, const BalanceProblem& balance,
                         const Regions& regions) {
  BendProblem problem{balance, std::vector<bool>(solid.mesh().vertices.size()), {}, {}, regions};
  for (const Pose& pose : poses) hold(pose, solid, problem);
  return problem;
}

CageProblem cage_problem(const Cage& cage, const SolidMesh& solid, const BendProblem& problem) {
  CageProblem bending;
  bending.rest = cage.mesh();
  bending.solid_share = cage.solid_share();
  bending.stiffness.assign(cage.mesh().tets.size(), 1);
  bending.fixed = fixed_vertices(cage, solid, problem);
  bending.samples = cage.samples();
  bending.balance = problem.balance;
  bending.grounds = problem.grounds;
  return bending;
}

void lift_onto(TriangleMesh& mesh, const GroundPlane& ground) {
  for (Vec3& v : mesh.vertices)
    if (const double height = dot(ground.up, v) - ground.plate_mm; height < 0) v += -height * ground.up;
}

Result<Bender> Bender::make(const SolidMesh& solid, const BendProblem& problem, const CageOptions& options,
                            const Job& job) {
  assert(problem.held.size() == solid.mesh().vertices.size());
  auto cage = build_cage(solid, options, job);
  if (!cage) return tl::unexpected(cage.error());
  auto motion = SurfaceMotion::make(*cage, solid.mesh());
  if (!motion) return tl::unexpected(motion.error());
  CageProblem bending = cage_problem(*cage, solid, problem);
  if (const auto marked = mark_regions(*cage, problem.regions, bending); !marked) return tl::unexpected(marked.error());
  return Bender(std::make_shared<const Parts>(
      Parts{solid, std::move(*cage), std::move(*motion), std::move(bending), problem.held}));
}

Result<Bent> Bender::bend(double required_t, const DeformOptions& options, const Job& job) const {
  CageProblem problem = parts_->problem;
  problem.required_t = required_t;
  auto cage = deform_cage(problem, options, {}, job.part(0, 0.8));
  if (!cage) return tl::unexpected(cage.error());
  for (const double ratio : path_ratios) {
    const std::vector<Vec3> vertices = between(problem.rest.vertices, cage->vertices, ratio);
    auto mesh = parts_->motion.moved_apart(vertices, parts_->held, job);
    if (!mesh) return tl::unexpected(mesh.error());
    for (const GroundPlane& ground : problem.grounds) lift_onto(*mesh, ground);
    auto checked = check_solid(*mesh, job.part(0.8, 1));
    if (!checked) return tl::unexpected(checked.error());
    if (!checked->solid) continue;
    Bent bent{std::move(*checked->solid), std::move(*cage), ratio, 0, 0, farthest_pull_mm(problem, vertices)};
    const auto &from = parts_->solid.mesh().vertices, &to = bent.solid.mesh().vertices;
    for (std::size_t v = 0; v < from.size(); ++v) {
      const double by = norm(to[v] - from[v]);
      bent.mean_mm += by / static_cast<double>(from.size());
      bent.max_mm = std::max(bent.max_mm, by);
    }
    return bent;
  }
  return fail(ErrorCode::internal, "the surface crosses itself where nothing bends it");
}

}  // namespace aplomb
