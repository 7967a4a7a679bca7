#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "aplomb/balance/balance_problem.h"
#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/deform/embedding.h"
#include "aplomb/mesh/tet_mesh.h"

namespace aplomb {

/// Nothing may sink below the plate: dot(up, vertex) >= plate_mm, or no lower than it was at rest.
struct GroundPlane {
  Vec3 up{0, 0, 1};  ///< of unit length
  double plate_mm = 0;
};

/// A point of the solid that is pulled to a place.
struct SoftHandle {
  EmbeddedPoint at;
  Vec3 target_mm;
  double weight = 1;  ///< all weights together at 1 resist as strongly as the whole solid does, roughly
};

/// What to bend, and what for.
struct CageProblem {
  TetMesh rest;
  std::vector<double> solid_share;   ///< per tetrahedron, in (0, 1]
  std::vector<double> stiffness;     ///< per tetrahedron, > 0: 1, or large where the user wants no change
  std::vector<Mat3> wanted;          ///< per tetrahedron, the F that costs nothing, det > 0; empty: as it is at rest
  std::vector<bool> fixed;           ///< per vertex: contacts and what else must stay
  std::vector<SolidSample> samples;  ///< the solid, for the balance
  BalanceProblem balance;
  double required_t = 0;
  std::vector<GroundPlane> grounds;
  std::vector<SoftHandle> handles;
  std::vector<Vec3> start{};  ///< of the vertices, where the search begins, within most_mean_mm; empty: at rest
};

struct DeformOptions {
  double alpha_ratio = 0.2;    ///< what distortion costs, in [0.001, 1000]
  double beta_ratio = 1;       ///< what turning costs, in [0, 1000]; 0 lets the figure fold over
  double gamma_ratio = 10;     ///< what a change of volume costs, in [0, 1000]; 0 lets thin parts swell
  double ground_ratio = 1000;  ///< what sinking below the plate costs, in [0, 1e6]
  double most_mean_mm = std::numeric_limits<double>::infinity();  ///< the mean displacement stays within, > 0
  double most_step_mm = 6;   ///< no vertex moves farther in a step, in [0.001, 1000]
  double settled_mm = 0.02;  ///< a step that moves no vertex farther ends the search, in [1e-9, 1]
  int most_iterations = 80;  ///< in [0, 10000]
};

/// A sentence naming the field, its value and its range; empty when there is none.
std::string find_problem(const DeformOptions& options);

enum class DeformOutcome {
  reached,  ///< every row holds at required_t
  limit,    ///< the mean displacement allowed buys no more
  stuck,    ///< no better shape was found, or the iterations ran out
};

struct CageDeformation {
  std::vector<Vec3> vertices;  ///< of the cage
  double t = 0;                ///< the largest at which every row holds, with the best carving of the deformed solid
  AffineForm kept;             ///< that carving: kept where positive
  DeformOutcome outcome = DeformOutcome::stuck;
  int iterations = 0;
  double energy_mm3 = 0;
  double mean_mm = 0;              ///< displacement, weighted by the solid's volume
  double max_mm = 0;               ///< of any vertex
  double max_turn_rad = 0;         ///< of any tetrahedron, by its polar decomposition
  double volume_change_ratio = 0;  ///< of the solid
};

/// Called with the vertices and t of every accepted iterate.
using DeformListener = std::function<void(const std::vector<Vec3>& vertices, double t)>;

/// Finds the least change of shape with which the solid, carved as well as can be, balances.
///
///     minimise  sum_T V_T f_T w_T W(F_T)  +  ground  +  handles         over the free vertices of the cage
///     such that a carving exists with g_i(vertices, carving, required_t) >= 0 for every row i
///
/// W is TetEnergy, of F_T times the inverse of the wanted F where one is wanted. Prevost et al. 2013 alternate a linear
/// Laplacian deformation with a greedy carving; here the best carving is part of every iterate (its derivative by the
/// envelope theorem), so both are optimal together. Projected Newton: each step is the exact minimiser of a convex
/// model under the linearised rows, towards as much of required_t as `most_step_mm` and `most_mean_mm` allow; so the
/// path is a family of shapes of growing t.
///
/// A row whose b is zero (it holds or does not, whatever t is) counts as  a - (t - required_t) size: the same condition
/// at required_t, and a distance to it elsewhere.
///
/// \pre  find_problem(options) is empty; tetrahedra are positively oriented, at the start, too; there, fixed vertices
/// are
///       at rest; sizes agree; balance has rows.
/// \post No tetrahedron is inverted; fixed vertices are where they were; mean_mm <= most_mean_mm.
/// \post Every accepted iterate is better than the one before by energy + penalty x what is missing of required_t.
/// \return cancelled, third_party, internal.
/// \par Cost  a sparse factorisation and some twenty passes over the samples a step, 5-20 steps.
Result<CageDeformation> deform_cage(const CageProblem& problem, const DeformOptions& options = {},
                                    const DeformListener& listener = {}, const Job& job = {});

}  // namespace aplomb
