#include "aplomb/mesh/trim.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "aplomb/adapters/cgal/fill_polygon.h"
#include "aplomb/mesh/detail/topology.h"

namespace aplomb {
namespace {

constexpr int most_tries = 8;
constexpr double next_try_mm = 1e-3 / most_tries;

/// Where the plane meets the mesh's edges; each place once.
class Cut {
 public:
  Cut(TriangleMesh& mesh, double height) : mesh_(mesh), height_(height) {}

  /// The number of the point on the edge, from either end.
  std::uint32_t on_edge(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const Vec3 from = mesh_.vertices[a], to = mesh_.vertices[b];
    const double t = (height_ - from.z) / (to.z - from.z);
    const Vec3 place{double(float(from.x + t * (to.x - from.x))), double(float(from.y + t * (to.y - from.y))), height_};
    const auto [known, added] = numbers_.try_emplace({place.x, place.y}, static_cast<std::uint32_t>(points_.size()));
    if (added) {
      points_.push_back({place.x, place.y});
      mesh_.vertices.push_back(place);
    }
    return first_ + known->second;
  }

  /// An edge of the cut, as the cap runs along it.
  void add_edge(std::uint32_t from, std::uint32_t to) {
    if (from != to) edges_.push_back({from - first_, to - first_});
  }

  /// Closes the cut with triangles that look down.
  Result<void> close() {
    const auto cap = adapters::fill_polygon(points_, edges_);
    if (!cap) return tl::unexpected(cap.error());
    for (const Triangle& t : *cap) mesh_.triangles.push_back({first_ + t[0], first_ + t[2], first_ + t[1]});
    return {};
  }

 private:
  TriangleMesh& mesh_;
  const double height_;
  const std::uint32_t first_ = static_cast<std::uint32_t>(mesh_.vertices.size());
  std::map<std::pair<double, double>, std::uint32_t> numbers_;
  std::vector<Vec2> points_;
  std::vector<std::array<std::uint32_t, 2>> edges_;
};

void add_triangle(TriangleMesh& mesh, Triangle t) {
  if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
}

/// The part of a triangle above the plane. \pre Corner 0 is alone on its side.
void add_upper_part(TriangleMesh& mesh, Cut& cut, const Triangle& t, bool lone_is_above) {
  const std::uint32_t next = cut.on_edge(t[0], t[1]), last = cut.on_edge(t[0], t[2]);
  if (lone_is_above) {
    add_triangle(mesh, {t[0], next, last});
    cut.add_edge(last, next);
    return;
  }
  const auto& v = mesh.vertices;
  if (norm(v[next] - v[t[2]]) < norm(v[last] - v[t[1]])) {
    add_triangle(mesh, {next, t[1], t[2]});
    add_triangle(mesh, {next, t[2], last});
  } else {
    add_triangle(mesh, {next, t[1], last});
    add_triangle(mesh, {last, t[1], t[2]});
  }
  cut.add_edge(next, last);
}

Result<TriangleMesh> cut_at(const TriangleMesh& mesh, double height) {
  TriangleMesh upper{mesh.vertices, {}};
  Cut cut(upper, height);
  const auto above = [&](std::uint32_t v) { return mesh.vertices[v].z > height; };
  for (const Triangle& t : mesh.triangles) {
    const auto count = std::ranges::count_if(t, above);
    if (count == 3) upper.triangles.push_back(t);
    if (count == 0 || count == 3) continue;
    const auto lone = std::ranges::find_if(t, [&](std::uint32_t v) { return above(v) == (count == 1); }) - t.begin();
    const Triangle turned{t[lone], t[(lone + 1) % 3], t[(lone + 2) % 3]};
    add_upper_part(upper, cut, turned, count == 1);
  }
  if (const auto closed = cut.close(); !closed) return tl::unexpected(closed.error());
  return detail::submesh(upper, [](std::size_t) { return true; });
}

}  // namespace

Result<SolidMesh> trim_base(const SolidMesh& solid, double height_mm, const Job& job) {
  const auto& vertices = solid.mesh().vertices;
  std::string why = "nothing or everything lies below the cut";
  for (int round = 0; round < most_tries; ++round) {
    const double height = double(float(height_mm - round * next_try_mm));
    if (!(height > solid.box().min.z && height < solid.box().max.z)) break;
    if (std::ranges::any_of(vertices, [&](const Vec3& v) { return v.z == height; })) {
      why = "every plane tried passes through a vertex";
      continue;
    }
    const auto cut = cut_at(solid.mesh(), height);
    if (!cut) {
      why = cut.error().message;
      continue;
    }
    auto checked = check_solid(*cut, job);
    if (!checked) return tl::unexpected(checked.error());
    if (checked->solid) return std::move(*checked->solid);
    why = "what is left has " + describe(checked->defects);
  }
  return fail(ErrorCode::unusable_input, fmt::format("the base cannot be cut off at {:.4g} mm: {}", height_mm, why));
}

}  // namespace aplomb
