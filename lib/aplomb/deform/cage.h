#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/deform/embedding.h"
#include "aplomb/mesh/solid_mesh.h"

namespace aplomb {

struct CageOptions {
  double wall_mm = 2;           ///< > 0: what is deeper may be carved
  std::size_t samples = 60000;  ///< >= 1000: about as many pieces of the solid are carried
};

/// A coarse tetrahedral mesh around a solid, and what it carries: cubes of a lattice, six tetrahedra each (Kuhn's
/// split). A cube that several parts of the solid pass through stands there once for each, and cubes are joined only
/// where the solid runs on (virtual nodes: Molino, Bao and Fedkiw 2004), so that legs near one another move apart.
/// Every tetrahedron has the same good shape, whatever the solid.
class Cage {
 public:
  static constexpr int fine = 4;  ///< pieces along a cube's edge: parts nearer than two pieces count as one

  const TetMesh& mesh() const { return mesh_; }
  /// The part of each tetrahedron that is solid, in [0.05, 1]: air still resists a little.
  const std::vector<double>& solid_share() const { return solid_share_; }
  /// Together the solid: the same volume and, nearly, the same centre.
  const std::vector<SolidSample>& samples() const { return samples_; }
  double cube_mm() const { return fine * fine_mm_; }

  /// Where the cage holds a point; nothing for one that is farther than a piece from the solid.
  std::optional<EmbeddedPoint> embed(Vec3 point_mm) const;

 private:
  friend class CageBuilder;
  using Index = std::array<int, 3>;
  static constexpr int pieces = fine * fine * fine;
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  std::size_t cube_index(const Index& cube) const;

  Vec3 origin_mm_;
  double fine_mm_ = 1;
  Index size_{};                       // in cubes
  std::vector<std::uint32_t> block_;   // per cube: its block of pieces in copies_, or none
  std::vector<std::uint32_t> copies_;  // per piece: the copy of the cube that holds it, or none
  TetMesh mesh_;                       // copy c has the tetrahedra 6 c to 6 c + 5
  std::vector<double> solid_share_;
  std::vector<SolidSample> samples_;
};

/// Builds a cage. A solid's own voids are air to it.
///
/// \pre  wall_mm > 0, samples >= 1000.
/// \post embed() holds every point of the solid.
/// \return cancelled.
/// \par Cost  0.3 s for 100k triangles; 8k to 20k tetrahedra.
Result<Cage> build_cage(const SolidMesh& solid, const CageOptions& options, const Job& job = {});

}  // namespace aplomb
