#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "aplomb/balance/pose.h"
#include "aplomb/balance/support_polygon.h"
#include "aplomb/core/error.h"
#include "aplomb/mesh/mass_properties.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// A part of the body of one material, whose printed density lies within density (1 +- density_error_ratio).
/// Usual: solid print 0.02, skins 0.02, infill 0.15, inserts 0.01.
struct Region {
  Moments moments;                 ///< positive volume
  double density_g_per_cm3 = 0;    ///< > 0
  double density_error_ratio = 0;  ///< in [0, 1)
};

struct BodyMass {
  double volume_mm3 = 0;
  double mass_g = 0;
  Vec3 com_mm;
};

/// Of all regions at their nominal densities. \pre body is not empty, its regions have positive volume and density.
BodyMass mass_of(std::span<const Region> body);

/// How a body stands in a pose (PRINTABILITY, "Standing, defined"). c is the centre of mass, h its height
/// above the plate, d_i its distance inside edge i of the support polygon, negative outside.
struct Stability {
  double mass_g = 0;
  double volume_mm3 = 0;
  Vec3 com_mm;
  double com_height_mm = 0;
  bool can_stand = false;     ///< at least three contacts that are not in line
  double margin_mm = 0;       ///< min d_i; negative: falls
  double tip_rad = 0;         ///< min atan2(d_i, h): stands on a table tilted by less, in any direction
  double robust_tip_rad = 0;  ///< the same with contacts and densities at their worst
  std::size_t weak_edge = 0;  ///< of SupportPolygon::edges(): the one with the least margin
  std::array<Vec3, 2> weak_edge_mm{};
  Vec3 heading;                ///< horizontal unit vector, out over the weak edge: where it falls
  double topple_energy_j = 0;  ///< min M g (sqrt(d_i^2 + h^2) - h); 0 when it falls by itself
  double topple_push_n = 0;    ///< sideways at the top: min M g d_i / height; 0 when it falls by itself
  double push_height_mm = 0;   ///< above the plate
};

/// \pre body is not empty, its regions have positive volume and density; the centre of mass lies above the
/// plate.
Stability measure_stability(const SupportPolygon& support, std::span<const Region> body, const StandingPose& pose);

/// The largest direction . centroid over all densities within the regions' intervals.
///
///     max sum r_k V_k s_k / sum r_k V_k   over  r_k in [lo_k, hi_k]
///
/// is bang-bang: hi for the regions beyond the optimum, lo for the others; the regions are sorted and every
/// split tried.
double farthest_centroid_mm(std::span<const Region> body, Vec3 direction);

/// What the verdict would be if more, or less, of the base touched.
struct ContactVariant {
  double contact_height_mm = 0;
  double tip_rad = 0;
  double area_mm2 = 0;
};

/// The tip angle at 1, 2 and 4 times pose.contact_height_mm (half, one and two first layers): far apart means
/// fragile. \pre as measure_stability. \return as support_polygon.
Result<std::array<ContactVariant, 3>> contact_variants(const TriangleMesh& mesh, std::span<const Region> body,
                                                       const StandingPose& pose);

}  // namespace aplomb
