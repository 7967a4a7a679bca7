#include "aplomb/holes/chambers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "aplomb/adapters/embree/surface_distance.h"

namespace aplomb {
namespace {

constexpr double spacing_ratio = 1.0 / 6;  // of the ball's diameter
constexpr std::array<double, 5> room_ratios{0.8, 0.9, 1.0, 1.1, 1.2};
constexpr double reach_ratio = 1.4;  // of the ball's diameter: between chambers that a neck joins, and the lattice

enum class Part : char { none, own, other };

/// A lattice over a void: the room at each point, and whose it is.
class ChamberLattice {
 public:
  ChamberLattice(const TriangleMesh& surface, double spacing_mm) : spacing_(spacing_mm) {
    const Box3 box = bounding_box(surface);
    const Vec3 size = box.size();
    origin_ = box.min;
    for (int axis = 0; axis < 3; ++axis)
      counts_[static_cast<std::size_t>(axis)] = static_cast<int>(std::ceil(size[axis] / spacing_mm)) + 1;
    room_.assign(static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(counts_[1]) *
                     static_cast<std::size_t>(counts_[2]),
                 -1);
    const adapters::SurfaceDistance distance(surface);
    tbb::parallel_for(std::size_t{0}, room_.size(), [&](std::size_t n) {
      const auto nearest = distance.closest(position(n));
      if (distance.inside(position(n), nearest)) room_[n] = nearest.distance_mm;
    });
  }

  std::size_t size() const { return room_.size(); }
  Part part(std::size_t n) const { return parts_[n]; }

  Vec3 position(std::size_t n) const {
    const auto [i, j, k] = index(n);
    return origin_ + spacing_ * Vec3{double(i), double(j), double(k)};
  }

  Part part_at(Vec3 point) const {
    const Vec3 at = (point - origin_) / spacing_;
    const std::array<int, 3> index{int(std::lround(at.x)), int(std::lround(at.y)), int(std::lround(at.z))};
    return is_on(index) ? parts_[number(index)] : Part::none;
  }

  /// Tells the chamber round a point from the others. \return whether there are others.
  bool part_round(Vec3 inside_mm, double least_room_mm) {
    parts_.assign(room_.size(), Part::none);
    std::size_t first = room_.size();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t n = 0; n < room_.size(); ++n) {
      if (room_[n] < least_room_mm) continue;
      parts_[n] = Part::other;
      const double away = norm(position(n) - inside_mm);
      if (away < nearest) nearest = away, first = n;
    }
    if (first == room_.size()) return false;
    std::vector<std::size_t> front{first};
    parts_[first] = Part::own;
    while (!front.empty()) {
      const std::size_t at = front.back();
      front.pop_back();
      for_neighbours(at, [&](std::size_t other) {
        if (parts_[other] != Part::other) return;
        parts_[other] = Part::own;
        front.push_back(other);
      });
    }
    return std::ranges::find(parts_, Part::other) != parts_.end();
  }

  /// Those at the rim of a part.
  std::vector<Vec3> rim(Part part) const {
    std::vector<Vec3> points;
    for (std::size_t n = 0; n < parts_.size(); ++n) {
      if (parts_[n] != part) continue;
      int alike = 0;
      for_neighbours(n, [&](std::size_t other) { alike += parts_[other] == part ? 1 : 0; });
      if (alike < 26) points.push_back(position(n));
    }
    return points;
  }

 private:
  std::array<int, 3> index(std::size_t n) const {
    const int at = static_cast<int>(n);
    return {at / (counts_[1] * counts_[2]), at / counts_[2] % counts_[1], at % counts_[2]};
  }
  std::size_t number(const std::array<int, 3>& i) const {
    const int at = (i[0] * counts_[1] + i[1]) * counts_[2] + i[2];
    return static_cast<std::size_t>(at);
  }
  bool is_on(const std::array<int, 3>& index) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (index[axis] < 0 || index[axis] >= counts_[axis]) return false;
    return true;
  }

  template <class Visit>
  void for_neighbours(std::size_t n, const Visit& visit) const {
    const auto [i, j, k] = index(n);
    for (int step = 0; step < 27; ++step) {
      const std::array<int, 3> other{i + step / 9 - 1, j + step / 3 % 3 - 1, k + step % 3 - 1};
      if (step != 13 && is_on(other)) visit(number(other));
    }
  }

  const double spacing_;
  Vec3 origin_;
  std::array<int, 3> counts_{};
  std::vector<double> room_;
  std::vector<Part> parts_;
};

double distance_mm(const std::vector<Vec3>& points, Vec3 from) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& point : points) least = std::min(least, dot(point - from, point - from));
  return std::sqrt(least);
}

struct Sides {
  ChamberLattice lattice;
  std::vector<Vec3> own, other;

  double distance_of(Part part, Vec3 point) const {
    return lattice.part_at(point) == part ? 0 : distance_mm(part == Part::own ? own : other, point);
  }
};

}  // namespace

std::optional<KeptPart> wall_round_chamber(const TriangleMesh& surface, Vec3 inside_mm, double ball_mm,
                                           double thick_mm) {
  auto sides = std::make_shared<Sides>(Sides{ChamberLattice(surface, spacing_ratio * ball_mm), {}, {}});
  const bool has_others = std::ranges::any_of(
      room_ratios, [&](double ratio) { return sides->lattice.part_round(inside_mm, ratio * 0.5 * ball_mm); });
  if (!has_others) return std::nullopt;
  sides->own = sides->lattice.rim(Part::own);
  sides->other = sides->lattice.rim(Part::other);
  const double reach = reach_ratio * ball_mm;
  std::erase_if(sides->own, [&](Vec3 point) { return distance_mm(sides->other, point) > reach; });
  std::erase_if(sides->other, [&](Vec3 point) { return distance_mm(sides->own, point) > reach; });
  if (sides->own.empty() || sides->other.empty()) return std::nullopt;
  Box3 box;
  for (const Vec3& point : sides->own) box.add(point);
  for (const Vec3& point : sides->other) box.add(point);
  const double beside = 0.5 * ball_mm + thick_mm;
  box.min = box.min - Vec3{beside, beside, beside};
  box.max = box.max + Vec3{beside, beside, beside};
  return KeptPart{box, [sides, box, thick_mm](Vec3 p) {
                    const double depth =
                        0.5 *
                        (thick_mm - std::abs(sides->distance_of(Part::own, p) - sides->distance_of(Part::other, p)));
                    return depth > 0 ? std::min(depth, kept_box(box).depth_mm(p)) : depth;
                  }};
}

}  // namespace aplomb
