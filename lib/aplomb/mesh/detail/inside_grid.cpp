#include "aplomb/mesh/detail/inside_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "aplomb/mesh/detail/nearest.h"
#include "aplomb/mesh/marching_tetrahedra.h"

namespace aplomb::detail {
namespace {

struct Hit {
  std::uint32_t ray;
  float at;  // along the ray
  int turn;  // +1: the surface faces along the ray
  bool operator<(const Hit& b) const { return ray != b.ray ? ray < b.ray : at < b.at; }
};

struct Flat {
  double x, y, depth;
};

/// Twice the signed area of a, b, p, the same magnitude whichever way the edge is given.
double side(const Flat& a, const Flat& b, double x, double y) {
  if (b.x < a.x || (b.x == a.x && b.y < a.y)) return -side(b, a, x, y);
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

constexpr std::uint8_t all_votes = 6;

}  // namespace

InsideGrid::InsideGrid(const TriangleMesh& mesh, const Box3& box, int voxels_on_diagonal)
    : voxel_mm_(box.diagonal() / voxels_on_diagonal) {
  assert(voxel_mm_ > 0);
  // Off the beaten lattice, so that rays seldom meet vertices and faces of boxes.
  origin_mm_ = box.min - voxel_mm_ * Vec3{1.4142136, 1.7320508, 1.2360680};
  for (int axis = 0; axis < 3; ++axis)
    size_[axis] = static_cast<int>((box.max[axis] - origin_mm_[axis]) / voxel_mm_) + 3;
  std::vector<std::uint8_t> votes(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
  for (int axis = 0; axis < 3; ++axis) vote_along(axis, mesh, votes);
  inside_.resize(votes.size());
  std::size_t count = 0, doubtful = 0;
  for (std::size_t i = 0; i < votes.size(); ++i) {
    inside_[i] = votes[i] > all_votes / 2;
    count += inside_[i];
    doubtful += inside_[i] && votes[i] != all_votes;
  }
  doubtful_ratio_ = count > 0 ? static_cast<double>(doubtful) / static_cast<double>(count) : 1;
}

void InsideGrid::vote_along(int axis, const TriangleMesh& mesh, std::vector<std::uint8_t>& votes) const {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<Hit> hits;
  for (const Triangle& t : mesh.triangles) {
    std::array<Flat, 3> c{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = (mesh.vertices[t[i]] - origin_mm_) / voxel_mm_;
      c[i] = {p[u], p[v], p[axis]};
    }
    const double area = side(c[0], c[1], c[2].x, c[2].y);
    if (area == 0) continue;
    const auto [low_x, high_x] = std::minmax({c[0].x, c[1].x, c[2].x});
    const auto [low_y, high_y] = std::minmax({c[0].y, c[1].y, c[2].y});
    const auto first = [](double low) { return std::max(0, static_cast<int>(std::ceil(low))); };
    for (int y = first(low_y); y <= high_y && y < size_[v]; ++y)
      for (int x = first(low_x); x <= high_x && x < size_[u]; ++x) {
        const double a = side(c[1], c[2], x, y), b = side(c[2], c[0], x, y), d = side(c[0], c[1], x, y);
        if (!((a > 0 && b > 0 && d > 0) || (a < 0 && b < 0 && d < 0))) continue;
        const double depth = (a * c[0].depth + b * c[1].depth + d * c[2].depth) / (a + b + d);
        hits.push_back({static_cast<std::uint32_t>(y * size_[u] + x), static_cast<float>(depth), area > 0 ? 1 : -1});
      }
  }
  std::sort(hits.begin(), hits.end());
  for (std::size_t first = 0, last; first < hits.size(); first = last) {
    int total = 0;
    for (last = first; last < hits.size() && hits[last].ray == hits[first].ray; ++last) total += hits[last].turn;
    std::array<int, 3> node{};
    node[u] = static_cast<int>(hits[first].ray) % size_[u];
    node[v] = static_cast<int>(hits[first].ray) / size_[u];
    int below = 0;  // the sum of turns passed so far: minus the winding seen from below
    std::size_t next = first;
    for (node[axis] = 0; node[axis] < size_[axis]; ++node[axis]) {
      for (; next < last && hits[next].at <= static_cast<float>(node[axis]); ++next) below += hits[next].turn;
      std::uint8_t& vote = votes[index(node[0], node[1], node[2])];
      vote = static_cast<std::uint8_t>(vote + (-below > 0) + (total - below > 0));
    }
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
