#pragma once

#include <vector>

#include "picture.h"
#include "raster.h"

namespace aplomb::picture {

/// One direction light comes from, and how far it reaches into the scene.
struct Lamp {
  Vec3 towards;
  Colour light;
  Camera camera;
  std::vector<float> depth;  ///< of the nearest surface to the lamp
};

/// A key lamp (a small disc of directions) and the sky (a hemisphere), each direction with its own depth map.
/// What a cut takes away gives no shadow.
class Lights {
 public:
  /// Without some of them where the job says no; see is_complete().
  Lights(const TriangleMesh& mesh, Vec3 key, const std::optional<Cut>& cut, const Job& job = {});
  bool is_complete() const { return is_complete_; }

  /// The light that arrives at a point, by the share'th of `shares` interleaved subsets of the lamps.
  Colour at(Vec3 point, Vec3 normal, std::size_t share, std::size_t shares) const;
  /// The same as a share of what would arrive if nothing were in the way.
  Colour share_at(Vec3 point, Vec3 normal, std::size_t share, std::size_t shares) const;

 private:
  bool reaches(const Lamp& lamp, Vec3 point, Vec3 normal) const;

  std::vector<Lamp> lamps_;
  bool is_complete_ = false;
};

}  // namespace aplomb::picture
