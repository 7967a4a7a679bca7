#include "aplomb/inserts/pocket_places.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "aplomb/adapters/embree/surface_distance.h"

namespace aplomb {
namespace {

using adapters::SurfaceDistance;

constexpr double most_points = 500'000;
constexpr double far = 1e12;
constexpr double rounding_mm = 1e-5;  // of coordinates to float32

/// Squared distances, in steps, from each point of a line to the nearest of the parabolas over it
/// (Felzenszwalb and Huttenlocher 2012), in place.
void spread_along(std::vector<double>& line, std::vector<double>& scratch, std::vector<int>& hull,
                  std::vector<double>& border) {
  const int n = static_cast<int>(line.size());
  const auto meet = [&](int a, int b) {
    return ((line[a] + double(a) * a) - (line[b] + double(b) * b)) / (2.0 * (a - b));
  };
  int k = 0;
  hull[0] = 0, border[0] = -far, border[1] = far;
  for (int q = 1; q < n; ++q) {
    while (meet(q, hull[k]) <= border[k]) --k;
    ++k;
    border[k] = meet(q, hull[k - 1]), border[k + 1] = far;
    hull[k] = q;
  }
  k = 0;
  for (int q = 0; q < n; ++q) {
    while (border[k + 1] < q) ++k;
    scratch[q] = double(q - hull[k]) * (q - hull[k]) + line[hull[k]];
  }
  line = scratch;
}

/// The largest radius of a pocket at a height above its floor.
double radius_at(const Pocket& pocket, double height) {
  double radius = 0;
  for (std::size_t i = 0; i + 1 < pocket.profile.size(); ++i) {
    const auto [r, z] = pocket.profile[i];
    const auto [s, w] = pocket.profile[i + 1];
    if (height < z || height > w) continue;
    radius = std::max(radius, w > z ? r + (s - r) * (height - z) / (w - z) : std::max(r, s));
  }
  return radius;
}

}  // namespace

/// Upright layers of points; what is outside, or nearer to the surface than the wall, is bad.
struct PocketFits::Lattice {
  const TriangleMesh& mesh;
  SurfaceDistance distance;
  Vec3 origin;
  double step = 1, rise = 1;  // along the plate, upward
  int columns = 0, rows = 0, levels = 0;
  std::vector<std::vector<float>> clear;  // of each level: how far the nearest bad point is, squared, in steps

  Lattice(const SolidMesh& solid, const PlaceOptions& options) : mesh(solid.mesh()), distance(solid.mesh()) {
    const Box3 box = solid.box();
    const Vec3 size = box.size();
    step = std::max(options.least_step_mm, std::cbrt(size.x * size.y * size.z / most_points));
    rise = std::max(1.0, std::round(step / options.layer_mm)) * options.layer_mm;
    columns = static_cast<int>(size.x / step) + 3;
    rows = static_cast<int>(size.y / step) + 3;
    const double layers = std::ceil((options.wall_mm - rounding_mm - options.first_layer_mm) / options.layer_mm);
    const double lowest = options.first_layer_mm + std::max(0.0, layers) * options.layer_mm;  // floor under a pocket
    levels = static_cast<int>(std::max(0.0, size.z - lowest) / rise) + 1;
    origin = {(box.min.x + box.max.x) / 2 - step * (columns - 1) / 2,
              (box.min.y + box.max.y) / 2 - step * (rows - 1) / 2, box.min.z + lowest};
  }

  Vec3 at(int column, int row, int level) const { return origin + Vec3{step * column, step * row, rise * level}; }

  std::vector<float> clearances(int level, double wall_mm) const {
    std::vector<float> free(std::size_t(columns) * rows);
    tbb::parallel_for(0, rows, [&](int row) {
      std::uint32_t hint = SurfaceDistance::no_triangle;
      for (int column = 0; column < columns; ++column) {
        const Vec3 point = at(column, row, level);
        const auto nearest = distance.closest(point, hint, wall_mm);
        hint = nearest.triangle;
        const bool is_good = nearest.distance_mm >= wall_mm - rounding_mm && distance.inside(point, nearest);
        free[std::size_t(row) * columns + column] = is_good ? float(far) : 0.0F;
      }
    });
    return spread(std::move(free));
  }

 private:
  std::vector<float> spread(std::vector<float> free) const {
    const int longest = std::max(columns, rows);
    std::vector<int> hull(longest);
    std::vector<double> border(longest + 1);
    const auto along = [&](int lines, int points, auto index) {
      std::vector<double> line(points), scratch(points);
      for (int i = 0; i < lines; ++i) {
        for (int k = 0; k < points; ++k) line[k] = free[index(i, k)];
        spread_along(line, scratch, hull, border);
        for (int k = 0; k < points; ++k) free[index(i, k)] = static_cast<float>(line[k]);
      }
    };
    along(rows, columns, [&](int row, int column) { return std::size_t(row) * columns + column; });
    along(columns, rows, [&](int column, int row) { return std::size_t(row) * columns + column; });
    return free;
  }
};

Result<PocketFits> PocketFits::make(const SolidMesh& solid, std::vector<Pocket> pockets, const PlaceOptions& options,
                                    const Job& job) {
  assert(options.wall_mm > 0 && options.layer_mm > 0 && options.least_step_mm > 0);
  auto lattice = std::make_shared<Lattice>(solid, options);
  for (int level = 0; level < lattice->levels; ++level) {
    if (!job.report(double(level) / lattice->levels, "find pockets")) return cancelled();
    lattice->clear.push_back(lattice->clearances(level, options.wall_mm));
  }
  return PocketFits(std::move(pockets), options, std::move(lattice));
}

double PocketFits::step_mm() const { return lattice_->step; }

std::vector<PocketPlace> PocketFits::candidates() const {
  const Lattice& lattice = *lattice_;
  std::vector<PocketPlace> found;
  for (std::uint32_t p = 0; p < pockets_.size(); ++p) {
    std::vector<float> needed;  // squared steps, level by level above the floor
    for (int up = 0; up * lattice.rise <= pockets_[p].height_mm + 1e-9; ++up) {
      const double steps = radius_at(pockets_[p], std::min(up * lattice.rise, pockets_[p].height_mm)) / lattice.step;
      needed.push_back(static_cast<float>(steps * steps * (1 - 1e-5)));
    }
    const int tall = static_cast<int>(needed.size());
    for (int level = 0; level + tall <= lattice.levels; ++level)
      for (int point = 0; point < lattice.columns * lattice.rows; ++point) {
        int up = 0;
        while (up < tall && lattice.clear[level + up][point] > needed[up]) ++up;
        if (up == tall) found.push_back({p, lattice.at(point % lattice.columns, point / lattice.columns, level)});
      }
  }
  return found;
}

double PocketFits::widest_mm(double height_mm) const {
  const Lattice& lattice = *lattice_;
  const int tall = static_cast<int>(height_mm / lattice.rise + 1e-9) + 1;
  float widest = 0;
  for (int level = 0; level + tall <= lattice.levels; ++level)
    for (std::size_t point = 0; point < lattice.clear[level].size(); ++point) {
      float narrowest = lattice.clear[level][point];
      for (int up = 1; up < tall; ++up) narrowest = std::min(narrowest, lattice.clear[level + up][point]);
      widest = std::max(widest, narrowest);
    }
  return 2 * std::sqrt(double(widest)) * lattice.step;
}

double PocketFits::wall_mm(const PocketPlace& place, double at_most_mm) const {
  const SurfaceDistance& distance = lattice_->distance;
  const TriangleMesh mesh = rounded_to_float(pocket_mesh(pockets_[place.pocket], place.floor_mm));
  std::uint32_t hint = SurfaceDistance::no_triangle;
  double least = at_most_mm;
  for (std::size_t start = 0; start < 8; ++start)  // every eighth first: where it does not fit that shows soon
    for (std::size_t v = start; v < mesh.vertices.size(); v += 8) {
      const auto nearest = distance.closest(mesh.vertices[v], hint);
      hint = nearest.triangle;
      least = std::min(least, nearest.distance_mm);
      const bool is_inside = v != 0 || distance.inside(mesh.vertices[v], nearest);
      if (!is_inside || least < options_.wall_mm - rounding_mm) return is_inside ? least : 0;
    }
  for (const Triangle& t : mesh.triangles)
    least =
        std::min(least, distance.from_triangle(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], least));
  return least;
}

bool PocketFits::fits(const PocketPlace& place) const {
  return wall_mm(place, options_.wall_mm) >= options_.wall_mm - rounding_mm;
}

bool PocketFits::are_apart(const PocketPlace& a, const PocketPlace& b) const {
  constexpr double rounding = 1.002;  // the polygon's corners, and float32
  const Pocket &p = pockets_[a.pocket], &q = pockets_[b.pocket];
  const double beside =
      std::hypot(a.floor_mm.x - b.floor_mm.x, a.floor_mm.y - b.floor_mm.y) - rounding * (p.radius_mm + q.radius_mm);
  const double above = std::max(b.floor_mm.z - a.floor_mm.z - p.height_mm, a.floor_mm.z - b.floor_mm.z - q.height_mm);
  return std::hypot(std::max(0.0, beside), std::max(0.0, above)) >= options_.wall_mm * (1 + 1e-6);
}

}  // namespace aplomb
