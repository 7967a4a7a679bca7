#include "aplomb/deform/cage.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/mesh/detail/topology.h"

namespace aplomb {

using adapters::SurfaceDistance;
using detail::DisjointSets;

namespace {

constexpr double least_share = 0.05;
constexpr double piece_reach = 0.9;  // of a piece's edge: more than from its centre to its corner

/// Corners of a cube that Kuhn's tetrahedron of an order of the axes runs through, as bits.
struct Path {
  std::array<int, 3> axes;
  std::array<int, 4> corners() const { return {0, 1 << axes[0], 1 << axes[0] | 1 << axes[1], 7}; }
  bool right_handed() const { return (axes[1] - axes[0] + 3) % 3 == 1; }
};
constexpr std::array<Path, 6> paths{{{{0, 1, 2}}, {{0, 2, 1}}, {{1, 0, 2}}, {{1, 2, 0}}, {{2, 0, 1}}, {{2, 1, 0}}}};

/// The path whose tetrahedron holds a point of the unit cube.
std::size_t path_of(const std::array<double, 3>& at) {
  std::array<int, 3> axes{0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(), [&](int a, int b) { return at[a] > at[b]; });
  return static_cast<std::size_t>(std::ranges::find(paths, axes, &Path::axes) - paths.begin());
}

/// Distance to the solid's surface, positive inside.
double depth_mm(const SurfaceDistance& surface, Vec3 point) {
  const auto nearest = surface.closest(point);
  return surface.inside(point, nearest) ? nearest.distance_mm : -nearest.distance_mm;
}

}  // namespace

std::size_t Cage::cube_index(const Index& cube) const {
  return (static_cast<std::size_t>(cube[2]) * static_cast<std::size_t>(size_[1]) + static_cast<std::size_t>(cube[1])) *
             static_cast<std::size_t>(size_[0]) +
         static_cast<std::size_t>(cube[0]);
}

std::optional<EmbeddedPoint> Cage::embed(Vec3 point_mm) const {
  const Vec3 scaled = (point_mm - origin_mm_) / cube_mm();
  Index cube{}, piece{};
  std::array<double, 3> at{};
  for (int axis = 0; axis < 3; ++axis) {
    if (!(scaled[axis] >= 0 && scaled[axis] <= size_[axis])) return std::nullopt;
    cube[axis] = std::min(static_cast<int>(scaled[axis]), size_[axis] - 1);
    at[axis] = scaled[axis] - cube[axis];
    piece[axis] = std::min(static_cast<int>(at[axis] * fine), fine - 1);
  }
  const std::uint32_t block = block_[cube_index(cube)];
  if (block == none) return std::nullopt;
  const int place = (piece[2] * fine + piece[1]) * fine + piece[0];
  const std::uint32_t copy = copies_[std::size_t{block} * pieces + static_cast<std::size_t>(place)];
  if (copy == none) return std::nullopt;
  const std::size_t p = path_of(at);
  const auto [a, b, c] = paths[p].axes;
  EmbeddedPoint point{6 * copy + static_cast<std::uint32_t>(p), {1 - at[a], at[a] - at[b], at[b] - at[c], at[c]}};
  if (!paths[p].right_handed()) std::swap(point.weights[2], point.weights[3]);  // as its corners are
  return point;
}

/// Makes a cage in the order of its functions.
class CageBuilder {
 public:
  CageBuilder(const SolidMesh& solid, const CageOptions& options)
      : solid_(solid), options_(options), surface_(solid.mesh()) {
    cage_.fine_mm_ = std::cbrt(solid.moments().volume_mm3 / static_cast<double>(options.samples));
    const double rim = cage_.fine_mm_;  // what is lifted stays within
    cage_.origin_mm_ = solid.box().min - rim * Vec3{1, 1, 1};
    for (int axis = 0; axis < 3; ++axis)
      cage_.size_[axis] = 1 + static_cast<int>((solid.box().size()[axis] + 2 * rim) / cage_.cube_mm());
    cage_.block_.assign(cage_.cube_index({0, 0, cage_.size_[2]}), Cage::none);
  }

  void find_pieces() {
    std::vector<std::vector<Cube>> layers(static_cast<std::size_t>(cage_.size_[2]));
    tbb::parallel_for(0, cage_.size_[2], [&](int k) {
      for (int j = 0; j < cage_.size_[1]; ++j)
        for (int i = 0; i < cage_.size_[0]; ++i)
          if (auto cube = sampled({i, j, k})) layers[static_cast<std::size_t>(k)].push_back(std::move(*cube));
    });
    for (auto& layer : layers)
      for (Cube& cube : layer) {
        cage_.block_[cage_.cube_index(cube.index)] = static_cast<std::uint32_t>(cubes_.size());
        cubes_.push_back(std::move(cube));
      }
  }

  void copy_cubes() {
    cage_.copies_.assign(cubes_.size() * Cage::pieces, Cage::none);
    for (std::size_t b = 0; b < cubes_.size(); ++b) {
      DisjointSets sets(Cage::pieces);
      for (int n = 0; n < Cage::pieces; ++n)
        for (const int step : {1, Cage::fine, Cage::fine * Cage::fine}) {
          const bool on_edge = n / step % Cage::fine == Cage::fine - 1;
          if (!on_edge && cubes_[b].held(n) && cubes_[b].held(n + step))
            sets.join(std::uint32_t(n), std::uint32_t(n + step));
        }
      for (int n = 0; n < Cage::pieces; ++n) {
        if (!cubes_[b].held(n)) continue;
        const std::uint32_t first = sets.find(static_cast<std::uint32_t>(n));
        std::uint32_t& copy = copy_at(b, static_cast<int>(first));
        if (copy == Cage::none) copy = static_cast<std::uint32_t>(block_of_copy_.size()), block_of_copy_.push_back(b);
        copy_at(b, n) = copy;
      }
    }
  }

  void join_corners() {
    DisjointSets corners(8 * block_of_copy_.size());
    for (std::size_t b = 0; b < cubes_.size(); ++b)
      for (int axis = 0; axis < 3; ++axis) {
        Cage::Index next = cubes_[b].index;
        if (++next[axis] == cage_.size_[axis] || cage_.block_[cage_.cube_index(next)] == Cage::none) continue;
        join_across(corners, b, cage_.block_[cage_.cube_index(next)], axis);
      }
    std::vector<std::uint32_t> numbers(8 * block_of_copy_.size(), Cage::none);
    for (std::uint32_t copy = 0; copy < block_of_copy_.size(); ++copy) {
      std::array<std::uint32_t, 8> vertices{};
      for (std::uint32_t c = 0; c < 8; ++c) {
        std::uint32_t& number = numbers[corners.find(8 * copy + c)];
        if (number == Cage::none) {
          number = static_cast<std::uint32_t>(cage_.mesh_.vertices.size());
          cage_.mesh_.vertices.push_back(corner_mm(cubes_[block_of_copy_[copy]].index, static_cast<int>(c)));
        }
        vertices[c] = number;
      }
      for (const Path& path : paths) {
        const auto [a, b, c, d] = path.corners();
        TetMesh::Tet tet{vertices[a], vertices[b], vertices[c], vertices[d]};
        if (!path.right_handed()) std::swap(tet[2], tet[3]);
        cage_.mesh_.tets.push_back(tet);
      }
    }
  }

  Cage take() {
    const double h = cage_.fine_mm_;
    double volume = 0;
    for (const Cube& cube : cubes_)
      for (int n = 0; n < Cage::pieces; ++n) {
        const double share = std::clamp(0.5 + double{cube.depths_mm[n]} / h, 0.0, 1.0);
        if (!cube.held(n) || share == 0) continue;
        const double carvable = std::clamp(0.5 + (double{cube.depths_mm[n]} - options_.wall_mm) / h, 0.0, 1.0);
        const auto at = cage_.embed(piece_middle_mm(cube.index, n));
        cage_.samples_.push_back({*at, share * h * h * h, carvable / share});
        volume += cage_.samples_.back().volume_mm3;
      }
    cage_.solid_share_.assign(cage_.mesh_.tets.size(), 0);
    const double tet_mm3 = cage_.cube_mm() * cage_.cube_mm() * cage_.cube_mm() / 6;
    for (SolidSample& sample : cage_.samples_) {
      sample.volume_mm3 *= solid_.moments().volume_mm3 / volume;
      cage_.solid_share_[sample.at.tet] += sample.volume_mm3 / tet_mm3;
    }
    for (double& share : cage_.solid_share_) share = std::clamp(share, least_share, 1.0);
    return std::move(cage_);
  }

 private:
  struct Cube {
    Cage::Index index{};
    double reach_mm = 0;           // how far outside the solid a piece's centre may lie
    std::vector<float> depths_mm;  // per piece, at its centre
    bool held(int piece) const { return double{depths_mm[static_cast<std::size_t>(piece)]} > -reach_mm; }
  };

  std::uint32_t& copy_at(std::size_t block, int piece) {
    return cage_.copies_[block * Cage::pieces + static_cast<std::size_t>(piece)];
  }

  std::optional<Cube> sampled(const Cage::Index& index) const {
    const double reach = piece_reach * cage_.fine_mm_;
    const Vec3 middle = corner_mm(index, 0) + 0.5 * cage_.cube_mm() * Vec3{1, 1, 1};
    if (depth_mm(surface_, middle) < -(0.5 * std::sqrt(3.0) * cage_.cube_mm() + reach)) return std::nullopt;
    Cube cube{index, reach, std::vector<float>(Cage::pieces)};
    bool any = false;
    for (int n = 0; n < Cage::pieces; ++n) {
      cube.depths_mm[static_cast<std::size_t>(n)] = static_cast<float>(depth_mm(surface_, piece_middle_mm(index, n)));
      any = any || cube.held(n);
    }
    return any ? std::optional(std::move(cube)) : std::nullopt;
  }

  /// Where the solid runs on from a piece of one cube to one of the next, the copies share the four corners between.
  void join_across(DisjointSets& corners, std::size_t block, std::size_t next, int axis) {
    const int step = axis == 0 ? 1 : axis == 1 ? Cage::fine : Cage::fine * Cage::fine;
    for (int n = 0; n < Cage::pieces; ++n) {
      if (n / step % Cage::fine != Cage::fine - 1) continue;
      const std::uint32_t here = copy_at(block, n), there = copy_at(next, n - (Cage::fine - 1) * step);
      if (here == Cage::none || there == Cage::none) continue;
      for (std::uint32_t c = 0; c < 8; ++c)
        if ((c >> axis & 1) != 0) corners.join(8 * here + c, 8 * there + (c ^ 1U << axis));
    }
  }

  Vec3 corner_mm(const Cage::Index& cube, int corner) const {
    return cage_.origin_mm_ + cage_.cube_mm() * Vec3{double(cube[0] + (corner & 1)),
                                                     double(cube[1] + (corner >> 1 & 1)),
                                                     double(cube[2] + (corner >> 2 & 1))};
  }

  Vec3 piece_middle_mm(const Cage::Index& cube, int piece) const {
    const int i = piece % Cage::fine, j = piece / Cage::fine % Cage::fine, k = piece / (Cage::fine * Cage::fine);
    return corner_mm(cube, 0) + cage_.fine_mm_ * Vec3{i + 0.5, j + 0.5, k + 0.5};
  }

  const SolidMesh& solid_;
  const CageOptions& options_;
  const SurfaceDistance surface_;
  Cage cage_;
  std::vector<Cube> cubes_;
  std::vector<std::size_t> block_of_copy_;
};

Result<Cage> build_cage(const SolidMesh& solid, const CageOptions& options, const Job& job) {
  assert(options.wall_mm > 0 && options.samples >= 1000);
  if (!job.report(0, "cage")) return cancelled();
  CageBuilder builder(solid, options);
  builder.find_pieces();
  if (!job.report(0.8, "cage")) return cancelled();
  builder.copy_cubes();
  builder.join_corners();
  return builder.take();
}

}  // namespace aplomb
