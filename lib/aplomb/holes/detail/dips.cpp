#include "aplomb/holes/detail/dips.h"

#include <algorithm>
#include <numeric>

namespace aplomb::detail {
namespace {

/// Lists the neighbours of each vertex.
class Neighbours {
 public:
  explicit Neighbours(const TriangleMesh& mesh) : starts_(mesh.vertices.size() + 1, 0) {
    for (const Triangle& t : mesh.triangles)
      for (const std::uint32_t v : t) ++starts_[v + 1];
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    others_.resize(starts_.back());
    std::vector<std::size_t> at(starts_.begin(), starts_.end() - 1);
    for (const Triangle& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i) others_[at[t[i]]++] = t[(i + 1) % 3];  // closed: every edge from one end
  }
  const std::uint32_t* begin(std::uint32_t v) const { return others_.data() + starts_[v]; }
  const std::uint32_t* end(std::uint32_t v) const { return others_.data() + starts_[v + 1]; }

 private:
  std::vector<std::size_t> starts_;
  std::vector<std::uint32_t> others_;
};

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]];
    const Vec3 normal = cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a);
    for (const std::uint32_t v : t) normals[v] += normal;
  }
  return normals;
}

/// Parts of the surface below a rising plane, each with the dip it belongs to, or none: what hangs from a ceiling.
class Flood {
 public:
  Flood(const TriangleMesh& mesh, double least_depth_mm)
      : mesh_(mesh),
        least_depth_(least_depth_mm),
        parents_(mesh.vertices.size(), Dips::none),
        dips_of_roots_(mesh.vertices.size(), Dips::none),
        first_dips_(mesh.vertices.size(), Dips::none) {}

  /// \pre Every lower vertex was added.
  void add(std::uint32_t v, const Neighbours& neighbours, bool looks_down) {
    parents_[v] = v;
    bool is_lowest = true;
    for (const std::uint32_t* other = neighbours.begin(v); other != neighbours.end(v); ++other)
      if (parents_[*other] != Dips::none && *other != v) {
        is_lowest = false;
        join(root(v), root(*other), mesh_.vertices[v].z);
      }
    if (is_lowest && looks_down) {
      dips_of_roots_[v] = static_cast<std::uint32_t>(dips_.size());
      dips_.push_back({mesh_.vertices[v]});
      into_.push_back(Dips::none);
    }
    first_dips_[v] = dips_of_roots_[root(v)];
  }

  Dips result() const {
    Dips result;
    std::vector<std::uint32_t> numbers(dips_.size(), Dips::none);
    for (std::uint32_t d = 0; d < dips_.size(); ++d) {
      if (dips_[d].pass_mm - dips_[d].bottom_mm.z < least_depth_) {
        numbers[d] = numbers[into_[d]];  // a lower one, and so numbered
        continue;
      }
      numbers[d] = static_cast<std::uint32_t>(result.dips.size());
      result.dips.push_back(dips_[d]);
    }
    for (const std::uint32_t d : first_dips_) result.of_vertex.push_back(d == Dips::none ? Dips::none : numbers[d]);
    return result;
  }

 private:
  std::uint32_t root(std::uint32_t v) {
    while (parents_[v] != v) v = parents_[v] = parents_[parents_[v]];
    return v;
  }

  /// The lower dip goes on; the other one runs over into it.
  void join(std::uint32_t a, std::uint32_t b, double height_mm) {
    if (a == b) return;
    std::uint32_t lower = dips_of_roots_[a], higher = dips_of_roots_[b];
    if (lower > higher) std::swap(lower, higher);  // dips are numbered from below; none is last
    if (higher != Dips::none && higher != lower) {
      dips_[higher].pass_mm = height_mm;
      into_[higher] = lower;
    }
    parents_[b] = a;
    dips_of_roots_[a] = lower;
  }

  const TriangleMesh& mesh_;
  const double least_depth_;
  std::vector<std::uint32_t> parents_;
  std::vector<std::uint32_t> dips_of_roots_;
  std::vector<std::uint32_t> first_dips_;  // of each vertex when it was reached
  std::vector<Dip> dips_;
  std::vector<std::uint32_t> into_;  // of each dip: the one it runs over into
};

}  // namespace

Dips dips_of(const TriangleMesh& surface, double least_depth_mm) {
  std::vector<std::uint32_t> order(surface.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t v) { return surface.vertices[v].z; });
  const Neighbours neighbours(surface);
  const std::vector<Vec3> normals = vertex_normals(surface);
  Flood flood(surface, least_depth_mm);
  for (const std::uint32_t v : order) flood.add(v, neighbours, normals[v].z < 0);
  return flood.result();
}

}  // namespace aplomb::detail
