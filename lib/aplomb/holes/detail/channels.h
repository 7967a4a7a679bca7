#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/holes/hole_places.h"

namespace aplomb::detail {

/// A channel that may become a hole.
struct Channel {
  Hole hole;
  double looks_up = 0;  ///< z of the outside's normal at the mouth
  double cost_mm = 0;   ///< of what serves, the least is taken

  /// About the highest that its lower lip gets on the way out: see Channels::sill_mm().
  double axis_sill_mm() const;
  /// The lower and the upper lip of its throat.
  double lower_lip_mm() const { return hole.at(hole.throat_mm).z - lip_mm(); }
  double upper_lip_mm() const { return hole.at(hole.throat_mm).z + lip_mm(); }

 private:
  double lip_mm() const;
};

/// Tells which channels can be drilled out of one void.
class Channels {
 public:
  /// \pre The references outlive it. Coordinates are float32 values.
  Channels(const TriangleMesh& outer, const TriangleMesh& surface, const HoleDemand& demand, const HoleFences& fences);

  /// The point moved off the void's wall until a ball of the bore's diameter fits; none where none is near, or where
  /// the outside is too far for a hole.
  std::optional<Vec3> seat(Vec3 point_mm) const;
  /// From a seat outward: the axis alone is looked at.
  std::optional<Channel> channel(Vec3 seat_mm, Vec3 outward) const;
  /// In many directions; only those that may have a sill this low.
  std::vector<Channel> channels_from(Vec3 seat_mm, double most_sill_mm = std::numeric_limits<double>::infinity()) const;
  /// The height from which liquid runs out: that of the lowest way along the channel's side from void to outside.
  double sill_mm(const Channel& channel) const;
  /// Whether it can be drilled; gives the hole its end.
  bool can_be_drilled(Channel& channel, std::span<const Hole> others) const;

  const adapters::SurfaceDistance& void_distance() const { return inner_; }
  double bore_mm() const { return demand_.bore_mm(); }

 private:
  std::optional<double> way_out_mm(const adapters::SurfaceDistance& surface, Vec3 from, Vec3 along, double most) const;
  bool is_free(Vec3 from, Vec3 along, double length) const;
  bool has_room(Channel& channel) const;
  bool is_fenced(const Hole& hole) const;
  bool touches_the_plate(const Hole& hole) const;

  const TriangleMesh& outer_mesh_;
  const HoleDemand& demand_;
  const HoleFences& fences_;
  adapters::SurfaceDistance outer_, inner_;
  std::vector<double> plates_mm_;  // of each pose that stands: height of the plate along its up
  std::vector<Vec3> directions_;
};

}  // namespace aplomb::detail
