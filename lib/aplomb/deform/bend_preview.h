#pragma once

#include <memory>
#include <vector>

#include "aplomb/balance/poses.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/deform/reshape.h"

namespace aplomb {

/// What a preview is asked to come nearer to.
struct BendWish {
  Regions regions{};
  bool balances = true;  ///< the poses are to hold, too; false: handles alone pull
  int most_steps = 2;    ///< of Newton, >= 1
};

/// A solid that is bent a part of the way.
struct BendStage {
  std::vector<Vec3> cage;      ///< vertices of the cage: where the next stage goes on
  TriangleMesh surface;        ///< triangles and order of vertices as they were; it may cross itself
  bool settled = false;        ///< more steps would change nothing that one sees
  double t = 0;                ///< the largest at which every row holds with the best void; see joint()
  double mean_mm = 0;          ///< displacement of the surface's vertices
  double max_mm = 0;           ///< likewise
  double handle_short_mm = 0;  ///< how far a pulled handle is from where it is to go
};

/// Bends a solid while its handles are dragged: what Bender does, in a coarser cage that is made once, a few steps at a
/// time, each from where the last one ended. Neither is the base cut nor is the surface kept from crossing itself.
class BendPreview {
 public:
  struct Options {
    ReshapeOptions reshape{};  ///< its regions do not count
    RowKind kind = RowKind::nominal;
    std::size_t samples = 7000;  ///< of the cage, >= 1000: fewer are faster
  };

  /// \pre  find_problem(options.reshape) and find_problem(poses) are empty.
  /// \return as joint_problem(), build_cage() and SurfaceMotion::make().
  static Result<BendPreview> make(const SolidMesh& solid, const std::vector<Pose>& poses, const Options& options,
                                  const Job& job = {});

  /// Goes on from a stage's cage (empty: from rest) towards a wish. Where the wish now locks what has moved, it begins
  /// at rest again. What the poses hold stays.
  ///
  /// \pre  find_problem(wish.regions) is empty; `from` is empty or of a stage of this preview.
  /// \return as mark_regions() and deform_cage().
  /// \par Cost  About 30 ms of CPU a step, twice that at the limit of the mean displacement, and 0.2 ms for 1000
  /// vertices.
  Result<BendStage> advance(const BendWish& wish, const std::vector<Vec3>& from, const Job& job = {}) const;

  const JointProblem& joint() const;

 private:
  struct Parts;
  explicit BendPreview(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  Result<CageDeformation> bend(const CageProblem& problem, int most_steps, const Job& job) const;
  std::shared_ptr<const Parts> parts_;
};

}  // namespace aplomb
