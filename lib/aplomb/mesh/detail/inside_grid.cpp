#include "aplomb/mesh/detail/inside_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "aplomb/mesh/detail/nearest.h"
#include "aplomb/mesh/marching_tetrahedra.h"

namespace aplomb::detail {
namespace {

struct Flat {
  double x, y, depth;
};

/// Twice the signed area of a, b, p, the same magnitude whichever way the edge is given.
double side(const Flat& a, const Flat& b, double x, double y) {
  if (b.x < a.x || (b.x == a.x && b.y < a.y)) return -side(b, a, x, y);
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

constexpr std::uint8_t all_votes = 6;
constexpr std::int64_t rays_a_report = 500'000;      // 10 ms
constexpr std::int64_t most_triangles_a_ray = 2000;  // on average: about 3 s for 200 voxels; figures have 2 to 50
constexpr std::size_t most_nodes_a_slab = 4'000'000;

/// A triangle as rays along an axis see it, in voxels.
struct Seen {
  std::array<Flat, 3> corners;
  double area = 0, low_x = 0, high_x = 0, low_y = 0, high_y = 0;

  explicit Seen(const std::array<Flat, 3>& c) : corners(c), area(side(c[0], c[1], c[2].x, c[2].y)) {
    std::tie(low_x, high_x) = std::minmax({c[0].x, c[1].x, c[2].x});
    std::tie(low_y, high_y) = std::minmax({c[0].y, c[1].y, c[2].y});
  }
  /// How far along the ray it is met, if it is.
  std::optional<float> depth_at(int x, int y) const {
    const auto& c = corners;
    const double a = side(c[1], c[2], x, y), b = side(c[2], c[0], x, y), d = side(c[0], c[1], x, y);
    if (!((a > 0 && b > 0 && d > 0) || (a < 0 && b < 0 && d < 0))) return std::nullopt;
    return static_cast<float>((a * c[0].depth + b * c[1].depth + d * c[2].depth) / (a + b + d));
  }
};

/// The turns of the surface that rays meet, summed by the node before which they are met: memory that does not grow
/// with the triangles. A turn of +1 faces along the ray.
class Turns {
 public:
  Turns(int rows, int columns, int nodes)
      : columns_(columns), nodes_(nodes), sums_(std::size_t(rows) * std::size_t(columns) * std::size_t(nodes + 1)) {}

  void add(int row, int column, float at, int turn) {
    const bool is_within = at <= static_cast<float>(nodes_ - 1);
    of_ray(row, column)[!is_within ? nodes_ : at > 0 ? static_cast<int>(std::ceil(at)) : 0] += turn;
  }
  /// Of one ray: by node, and at last what is met beyond them all.
  std::int32_t* of_ray(int row, int column) {
    return &sums_[(std::size_t(row) * std::size_t(columns_) + std::size_t(column)) * std::size_t(nodes_ + 1)];
  }

 private:
  int columns_, nodes_;
  std::vector<std::int32_t> sums_;
};

}  // namespace

Result<InsideGrid> InsideGrid::sampled(const TriangleMesh& mesh, const Box3& box, int voxels_on_diagonal,
                                       const Job& job) {
  InsideGrid grid;
  grid.voxel_mm_ = box.diagonal() / voxels_on_diagonal;
  assert(grid.voxel_mm_ > 0);
  // Off the beaten lattice, so that rays seldom meet vertices and faces of boxes.
  grid.origin_mm_ = box.min - grid.voxel_mm_ * Vec3{1.4142136, 1.7320508, 1.2360680};
  for (int axis = 0; axis < 3; ++axis)
    grid.size_[axis] = static_cast<int>((box.max[axis] - grid.origin_mm_[axis]) / grid.voxel_mm_) + 3;
  std::vector<std::uint8_t> votes(static_cast<std::size_t>(grid.size_[0]) * grid.size_[1] * grid.size_[2]);
  for (int axis = 0; axis < 3; ++axis)
    if (const auto voted = grid.vote_along(axis, mesh, votes, job.part(axis / 3.0, (axis + 1) / 3.0)); !voted)
      return tl::unexpected(voted.error());
  grid.inside_.resize(votes.size());
  std::size_t count = 0, doubtful = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    grid.inside_[i] = votes[i] > all_votes / 2;
    count += grid.inside_[i];
    doubtful += grid.inside_[i] && votes[i] != all_votes;
  }
  grid.doubtful_ratio_ = count > 0 ? static_cast<double>(doubtful) / static_cast<double>(count) : 1;
  return grid;
}

Result<void> InsideGrid::vote_along(int axis, const TriangleMesh& mesh, std::vector<std::uint8_t>& votes,
                                    const Job& job) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const std::size_t nodes_a_row = std::size_t(size_[u]) * std::size_t(size_[axis] + 1);
  const int rows_a_slab = static_cast<int>(std::clamp<std::size_t>(most_nodes_a_slab / nodes_a_row, 1, size_[v]));
  const std::int64_t most_rays = most_triangles_a_ray * size_[u] * size_[v];
  std::int64_t rays = 0, reported = 0;
  for (int first_row = 0; first_row < size_[v]; first_row += rows_a_slab) {
    const int end_row = std::min(first_row + rows_a_slab, size_[v]);
    const double done = double(first_row) / size_[v];
    if (!job.report(done, "repair")) return cancelled();
    Turns turns(end_row - first_row, size_[u], size_[axis]);
    for (const Triangle& t : mesh.triangles) {
      std::array<Flat, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 p = (mesh.vertices[t[i]] - origin_mm_) / voxel_mm_;
        corners[i] = {p[u], p[v], p[axis]};
      }
      const Seen seen(corners);
      if (seen.area == 0) continue;
      const auto first = [](int least, double low) { return std::max(least, static_cast<int>(std::ceil(low))); };
      for (int y = first(first_row, seen.low_y); y <= seen.high_y && y < end_row; ++y) {
        for (int x = first(0, seen.low_x); x <= seen.high_x && x < size_[u]; ++x, ++rays)
          if (const auto depth = seen.depth_at(x, y)) turns.add(y - first_row, x, *depth, seen.area > 0 ? 1 : -1);
        if (rays < reported + rays_a_report) continue;
        reported = rays;
        if (!job.report(done, "repair")) return cancelled();
        if (rays > most_rays)
          return fail(ErrorCode::unusable_input,
                      "its surface lies over itself too often to be rebuilt; unite its parts in a modeller, or leave "
                      "some out");
      }
    }
    for (int y = first_row; y < end_row; ++y)
      for (int x = 0; x < size_[u]; ++x) vote_on_ray(axis, x, y, turns.of_ray(y - first_row, x), votes);
  }
  return {};
}

void InsideGrid::vote_on_ray(int axis, int x, int y, const std::int32_t* turns,
                             std::vector<std::uint8_t>& votes) const {
  const int nodes = size_[axis], total = std::accumulate(turns, turns + nodes + 1, 0);
  std::array<int, 3> node{};
  node[(axis + 1) % 3] = x;
  node[(axis + 2) % 3] = y;
  int below = 0;  // the sum of turns passed so far: minus the winding seen from below
  for (node[axis] = 0; node[axis] < nodes; ++node[axis]) {
    below += turns[node[axis]];
    std::uint8_t& vote = votes[index(node[0], node[1], node[2])];
    vote = static_cast<std::uint8_t>(vote + (-below > 0) + (total - below > 0));
  }
}

Vec3 InsideGrid::place_mm(std::size_t index) const {
  const auto width = static_cast<std::size_t>(size_[0]), height = static_cast<std::size_t>(size_[1]);
  const std::size_t i = index % width, j = index / width % height, k = index / width / height;
  return origin_mm_ + voxel_mm_ * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
}

double InsideGrid::volume_mm3() const {
  return std::pow(voxel_mm_, 3) * static_cast<double>(std::count(inside_.begin(), inside_.end(), true));
}

double InsideGrid::difference_mm3(const InsideGrid& other) const {
  assert(size_ == other.size_);
  std::size_t count = 0;
  for (std::size_t i = 0; i < inside_.size(); ++i) count += inside_[i] != other.inside_[i];
  return std::pow(voxel_mm_, 3) * static_cast<double>(count);
}

Result<bool> fill_alike(const TriangleMesh& mesh, const TriangleMesh& candidate, int voxels_on_diagonal,
                        const Job& job) {
  constexpr double most_difference_ratio = 0.01;
  const Box3 box = bounding_box(mesh), candidate_box = bounding_box(candidate);
  const double voxel = box.diagonal() / voxels_on_diagonal;
  if (norm(candidate_box.min - box.min) > 2 * voxel || norm(candidate_box.max - box.max) > 2 * voxel) return false;
  const auto wanted = InsideGrid::sampled(mesh, box, voxels_on_diagonal, job.part(0, 0.5));
  if (!wanted) return tl::unexpected(wanted.error());
  const auto got = InsideGrid::sampled(candidate, box, voxels_on_diagonal, job.part(0.5, 1));
  if (!got) return tl::unexpected(got.error());
  return got->difference_mm3(*wanted) <= most_difference_ratio * wanted->volume_mm3();
}

TriangleMesh surface_of(const InsideGrid& grid, const TriangleMesh& mesh) {
  const auto size = grid.size();
  std::vector<CornerCell> cells;
  for (int k = 0; k + 1 < size[2]; ++k)
    for (int j = 0; j + 1 < size[1]; ++j)
      for (int i = 0; i + 1 < size[0]; ++i) {
        CornerCell cell{{i, j, k}, {}};
        int inside = 0;
        for (int c = 0; c < 8; ++c) {
          const bool in = grid.inside(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
          cell.values[static_cast<std::size_t>(c)] = in ? -1.0F : 1.0F;
          inside += in;
        }
        if (inside != 0 && inside != 8) cells.push_back(cell);
      }
  const auto corner_of = [&](const CornerCell& cell, int c) {
    return grid.index(cell.ijk[0] + (c & 1), cell.ijk[1] + (c >> 1 & 1), cell.ijk[2] + (c >> 2 & 1));
  };
  std::vector<std::size_t> corners;
  for (const CornerCell& cell : cells)
    for (int c = 0; c < 8; ++c) corners.push_back(corner_of(cell, c));
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());

  const TriangleTree tree(mesh);
  std::vector<float> voxels_away(corners.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, corners.size(), 256), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const double distance = distance_mm(grid.place_mm(corners[n]), mesh, tree, 2 * grid.voxel_mm());
      voxels_away[n] = static_cast<float>(std::max(distance / grid.voxel_mm(), 0.05));
    }
  });
  for (CornerCell& cell : cells)
    for (int c = 0; c < 8; ++c)
      cell.values[static_cast<std::size_t>(c)] *= voxels_away[static_cast<std::size_t>(
          std::lower_bound(corners.begin(), corners.end(), corner_of(cell, c)) - corners.begin())];
  return marching_tetrahedra(cells, grid.voxel_mm(), grid.origin_mm());
}

}  // namespace aplomb::detail
