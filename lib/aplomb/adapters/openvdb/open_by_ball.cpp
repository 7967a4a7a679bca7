#include <algorithm>
#include <cmath>
#include <limits>

#include "aplomb/adapters/openvdb/field_operations.h"

namespace aplomb::adapters {
namespace {

using openvdb::Coord;
using IndexTree = openvdb::Int32Tree;

constexpr std::int32_t nobody = -1;

/// For each inside point too shallow to be a centre, the centre whose ball reaches farthest past it, found by letting
/// neighbours pass on theirs (Danielsson's vector distance transform) until nothing changes.
class Opening {
 public:
  Opening(FieldTree& field, double radius, double voxel, const Pulse& pulse)
      : field_(field), radius_(radius), voxel_(voxel), pulse_(pulse) {}

  void run(double slack) {
    collect();
    for (int sweep = 0; sweep < 64 && pass_on(sweep % 2 == 1); ++sweep) {
    }
    for (const Shallow& point : shallow_) {
      if (!pulse_.goes_on()) return;
      const double opened = std::min<double>(point.reach - slack, field_.background());
      if (opened > field_.getValue(point.at)) field_.setValueOnly(point.at, static_cast<float>(opened));
    }
  }

 private:
  struct Shallow {
    Coord at;
    Coord centre;
    double reach = std::numeric_limits<double>::infinity();  // |at - centre| + field(centre)
  };

  void collect() {
    for (auto leaf = field_.cbeginLeaf(); leaf && pulse_.goes_on(20); ++leaf)
      for (openvdb::Index n = 0; n < FieldLeaf::SIZE; ++n) {
        const float value = leaf->getValue(n);
        if (value >= 0 || value <= -radius_) continue;
        index_.setValueOnly(leaf->offsetToGlobalCoord(n), static_cast<std::int32_t>(shallow_.size()));
        shallow_.push_back({leaf->offsetToGlobalCoord(n), {}});
      }
  }

  void consider(Shallow& point, const Coord& centre, double value, bool& changed) {
    const Coord step = point.at - centre;
    const double reach = voxel_ * std::sqrt(double(step[0] * step[0] + step[1] * step[1] + step[2] * step[2])) + value;
    if (reach >= point.reach - 1e-9 * voxel_) return;
    point.reach = reach;
    point.centre = centre;
    changed = true;
  }

  bool pass_on(bool backward) {
    bool changed = false;
    FieldReader values(field_);
    openvdb::tree::ValueAccessor<const IndexTree, false> indices(index_);
    for (std::size_t n = 0; n < shallow_.size() && pulse_.goes_on(); ++n) {
      Shallow& point = shallow_[backward ? shallow_.size() - 1 - n : n];
      for (int d = 0; d < 27; ++d) {
        const Coord neighbour = point.at.offsetBy(d / 9 - 1, d / 3 % 3 - 1, d % 3 - 1);
        const float value = values.getValue(neighbour);
        if (value <= -radius_) consider(point, neighbour, value, changed);
        else if (const std::int32_t i = indices.getValue(neighbour); i != nobody && std::isfinite(shallow_[i].reach))
          consider(point, shallow_[i].centre, values.getValue(shallow_[i].centre), changed);
      }
    }
    return changed && !pulse_.stopped();
  }

  FieldTree& field_;
  const double radius_;
  const double voxel_;
  const Pulse& pulse_;
  IndexTree index_{nobody};
  std::vector<Shallow> shallow_;
};

}  // namespace

void open_by_ball(FieldTree& field, double radius, double slack, double voxel, const Pulse& pulse) {
  if (radius > 0) Opening(field, radius, voxel, pulse).run(slack);
}

}  // namespace aplomb::adapters
