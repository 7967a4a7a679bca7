#pragma once

#include <memory>
#include <span>
#include <vector>

#include "aplomb/balance/poses.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/deform/cage.h"
#include "aplomb/deform/deform_cage.h"
#include "aplomb/deform/regions.h"
#include "aplomb/mesh/solid_mesh.h"

namespace aplomb {

/// What a solid is bent for, and what of it stays.
struct BendProblem {
  BalanceProblem balance;            ///< the rows of every pose
  std::vector<bool> held;            ///< per vertex of the solid: contacts, which do not move
  std::vector<Vec3> anchors;         ///< points of the solid that do not move: attachments
  std::vector<GroundPlane> grounds;  ///< the plates of the poses
  Regions regions{};                 ///< what the user wants of parts of it
};

/// What the poses hold of a solid where it is, and the rows of `balance`.
BendProblem bend_problem(const SolidMesh& solid, std::span<const Pose> poses, const BalanceProblem& balance,
                         const Regions& regions);

/// The cage's part of a problem, its regions left out: see mark_regions(). \pre as Bender::make().
CageProblem cage_problem(const Cage& cage, const SolidMesh& solid, const BendProblem& problem);

/// The ground is soft to a cage: puts what is left to sink on the plate.
void lift_onto(TriangleMesh& mesh, const GroundPlane& ground);

/// The vertices up to height_mm above the plane through the lowest point: what a standing pose holds.
std::vector<bool> vertices_near_plate(const TriangleMesh& mesh, Vec3 up, double height_mm);

struct Bent {
  SolidMesh solid;        ///< triangles and order of vertices as they were
  CageDeformation cage;   ///< what the cage does; of the path that was found
  double path_ratio = 1;  ///< how far along it the surface went: less than 1, or 0, where it would have crossed itself
  double mean_mm = 0;     ///< displacement of the surface's vertices
  double max_mm = 0;
  double handle_short_mm = 0;  ///< how far a pulled handle is from where it was to go
};

/// Bends the surface of a solid, carved as well as can be, as little as makes it balance and takes the handles where
/// they are to go (deform_cage()).
class Bender {
 public:
  /// \pre problem.held has an entry per vertex; the rows are those of the solid as it is.
  /// \return what build_cage(), mark_regions() and SurfaceMotion::make() return.
  static Result<Bender> make(const SolidMesh& solid, const BendProblem& problem, const CageOptions& options,
                             const Job& job = {});

  /// The solid bent until every row holds at required_t, or as far as the options and what would cross itself allow. No
  /// point of the surface ends below a plate.
  ///
  /// \return what deform_cage() and check_solid() return.
  Result<Bent> bend(double required_t, const DeformOptions& options, const Job& job = {}) const;

 private:
  struct Parts;
  explicit Bender(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const Parts> parts_;
};

}  // namespace aplomb
