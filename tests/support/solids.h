#pragma once

#include <vector>

#include "aplomb/core/job.h"
#include "aplomb/mesh/solid_mesh.h"
#include "aplomb/mesh/triangle_mesh.h"

/// Solids for the stages that carve, and slow judges of distance that share no code with them.
namespace aplomb::test {

/// \pre mesh bounds a solid.
SolidMesh solid_of(const TriangleMesh& mesh);

/// A prism over a star with `points` tips, from z = 0 up: sharp and concave edges.
TriangleMesh star_prism(int points, double tip_radius_mm, double notch_radius_mm, double height_mm);

/// A closed surface of revolution about the z axis. The profile (radius, height) runs upward from radius 0 to 0.
TriangleMesh lathe(const std::vector<Vec2>& profile, int segments);

/// Balls of these radii on the z axis, joined by necks.
struct Lobe {
  double radius_mm = 0;
  double height_mm = 0;  ///< of its centre
};
TriangleMesh dumbbell(const std::vector<Lobe>& lobes, double neck_radius_mm, int segments);

/// The least distance to any triangle, each by its plane and its three edges.
double brute_force_distance_mm(const TriangleMesh& mesh, Vec3 point_mm);

/// Whether the solid angles of all triangles add up to 4 pi (van Oosterom and Strackee 1983).
bool is_inside(const TriangleMesh& mesh, Vec3 point_mm);

/// A job that stops at its k-th report, and counts them.
class CancelAt {
 public:
  explicit CancelAt(int report) : last_(report) {}
  Job job() {
    return Job([this](double, std::string_view) { return ++reports_ < last_; });
  }
  int reports() const { return reports_; }

 private:
  int last_;
  int reports_ = 0;
};

}  // namespace aplomb::test
