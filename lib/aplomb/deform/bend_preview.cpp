#include "aplomb/deform/bend_preview.h"

#include <algorithm>
#include <cassert>

#include "aplomb/deform/surface_motion.h"

namespace aplomb {
namespace {

constexpr double any_t = -20;        // every solid on a plate holds so much: tan(-87 degrees)
constexpr double settled_mm = 0.05;  // less is not seen
constexpr double at_limit_ratio = 0.98;
constexpr double same_t = 1e-4;

/// Whether what is fixed now was not moved before.
bool may_begin_at(const std::vector<Vec3>& from, const CageProblem& problem) {
  if (from.size() != problem.rest.vertices.size()) return false;
  for (std::size_t v = 0; v < from.size(); ++v)
    if (problem.fixed[v] && from[v] != problem.rest.vertices[v]) return false;
  return true;
}

double missing_t(const CageDeformation& bent, const CageProblem& problem) {
  return std::max(0.0, problem.required_t - bent.t);
}

double farthest_mm(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
  double farthest = 0;
  for (std::size_t v = 0; v < to.size(); ++v) farthest = std::max(farthest, norm(to[v] - from[v]));
  return farthest;
}

}  // namespace

struct BendPreview::Parts {
  SolidMesh solid;
  JointProblem joint;
  Cage cage;
  SurfaceMotion motion;
  CageProblem problem;  // without regions
  DeformOptions options;
};

Result<BendPreview> BendPreview::make(const SolidMesh& solid, const std::vector<Pose>& poses, const Options& options,
                                      const Job& job) {
  assert(find_problem(options.reshape).empty() && find_problem(poses).empty());
  auto joint = joint_problem(solid.mesh(), poses, options.kind);
  if (!joint) return tl::unexpected(joint.error());
  auto cage = build_cage(solid, {.wall_mm = wall_of(solid, options.reshape), .samples = options.samples}, job);
  if (!cage) return tl::unexpected(cage.error());
  auto motion = SurfaceMotion::make(*cage, solid.mesh());
  if (!motion) return tl::unexpected(motion.error());
  CageProblem problem = cage_problem(*cage, solid, bend_problem(solid, poses, joint->problem, {}));
  DeformOptions deforming;
  deforming.most_mean_mm = options.reshape.most_mean_percent / 100 * solid.box().size().z;
  deforming.most_step_mm = solid.box().diagonal();
  return BendPreview(std::make_shared<const Parts>(
      Parts{solid, std::move(*joint), std::move(*cage), std::move(*motion), std::move(problem), deforming}));
}

Result<CageDeformation> BendPreview::bend(const CageProblem& problem, int most_steps, const Job& job) const {
  DeformOptions options = parts_->options;
  options.most_iterations = most_steps;
  auto bent = deform_cage(problem, options, {}, job);
  const auto is_at_limit = [&] { return bent && bent->mean_mm >= at_limit_ratio * options.most_mean_mm; };
  if (problem.start.empty() || !is_at_limit()) return bent;
  CageProblem from_rest = problem;  // a step along the limit leads beyond it: from rest there is a way
  from_rest.start.clear();
  auto anew = deform_cage(from_rest, options, {}, job);
  if (!anew) return anew;
  const double gained = missing_t(*bent, problem) - missing_t(*anew, problem);
  const bool is_better = gained > same_t || (gained > -same_t && anew->energy_mm3 < bent->energy_mm3);
  return is_better ? anew : bent;
}

Result<BendStage> BendPreview::advance(const BendWish& wish, const std::vector<Vec3>& from, const Job& job) const {
  CageProblem problem = parts_->problem;
  if (const auto marked = mark_regions(parts_->cage, wish.regions, problem); !marked)
    return tl::unexpected(marked.error());
  problem.required_t = wish.balances ? parts_->joint.required_t : any_t;
  if (may_begin_at(from, problem)) problem.start = from;
  auto bent = bend(problem, wish.most_steps, job);
  if (!bent) return tl::unexpected(bent.error());
  const std::vector<Vec3>& before = problem.start.empty() ? problem.rest.vertices : problem.start;
  BendStage stage;
  stage.settled = bent->iterations < wish.most_steps || farthest_mm(before, bent->vertices) < settled_mm;
  stage.t = bent->t;
  stage.handle_short_mm = farthest_pull_mm(problem, bent->vertices);
  stage.surface = parts_->motion.moved(bent->vertices);
  for (const GroundPlane& ground : problem.grounds) lift_onto(stage.surface, ground);
  stage.cage = std::move(bent->vertices);
  const auto &rest = parts_->solid.mesh().vertices, &now = stage.surface.vertices;
  for (std::size_t v = 0; v < rest.size(); ++v) {
    const double by = norm(now[v] - rest[v]);
    stage.mean_mm += by / static_cast<double>(rest.size());
    stage.max_mm = std::max(stage.max_mm, by);
  }
  return stage;
}

const JointProblem& BendPreview::joint() const { return parts_->joint; }

}  // namespace aplomb
