#include "aplomb/fdm/ballast.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "aplomb/carve/plane_search.h"

namespace aplomb {
namespace {

constexpr double search_tolerance = 1e-7;  // of t
constexpr double beyond_t = 1e-5;          // asked for in addition to what a print came short of
constexpr int most_rounds = 8;

/// A print for each plane that is tried.
class Chooser {
 public:
  Chooser(const LayeredPrint& print, const BalanceProblem& problem, const BallastOptions& options)
      : print_(print), problem_(problem), options_(options) {}

  Result<Ballast> choose(const Job& job) {
    const auto sparse = print_.fill({}, job.part(0, 0.1));
    if (!sparse) return tl::unexpected(sparse.error());
    const Moments plain = sparse->all();
    PlaneSearch search(
        problem_,
        [&](const AffineForm& dense) {
          return plain + print_.added_by({dense, options_.infill_ratio});
        },
        plain);
    const auto stable = search.most_stable(search_tolerance, job.part(0.1, 0.3));
    if (!stable) return tl::unexpected(stable.error());
    auto made = options_.aim == CarveAim::stable || stable->bound < options_.required_t
                    ? filled(stable->kept, job.part(0.3, 1))
                    : least(search, *stable, job.part(0.3, 1));
    if (!made) return made;
    made->bound_t = stable->bound;
    made->planes = search.planes();
    made->added_mm3 = made->print.all().volume_mm3 - plain.volume_mm3;
    return made;
  }

 private:
  Result<Ballast> filled(const AffineForm& dense, const Job& job) const {
    Ballast ballast;
    ballast.infill = {dense, options_.infill_ratio};
    auto print = print_.fill(ballast.infill, job);
    if (!print) return tl::unexpected(print.error());
    ballast.print = *print;
    ballast.t = largest_t(problem_, ballast.print.all());
    ballast.reaches = options_.aim == CarveAim::stable || ballast.t >= options_.required_t;
    return ballast;
  }

  /// The least mass that reaches what was asked for; the most stable print where bridges and slivers forbid that.
  Result<Ballast> least(PlaneSearch& search, const PlaneChoice& stable, const Job& job) const {
    double asked = options_.required_t;
    for (int round = 0; round < most_rounds; ++round) {
      const Job part = job.part(double(round) / most_rounds, (round + 1.0) / most_rounds);
      const auto plane = search.extreme_volume(VolumeAim::least, std::min(asked, stable.t), stable, part.part(0, 0.5));
      if (!plane) return tl::unexpected(plane.error());
      auto made = filled(plane->kept, part.part(0.5, 1));
      if (!made || made->reaches || asked >= stable.t) return made;
      asked += options_.required_t - made->t + beyond_t;
    }
    return filled(stable.kept, job.part(1, 1));
  }

  const LayeredPrint& print_;
  const BalanceProblem& problem_;
  const BallastOptions& options_;
};

/// A convex polygon's part where the form is positive. Crossing points are the same from both sides of an edge.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, const AffineForm& form) {
  const auto crossing = [&form](Vec3 a, Vec3 b) {
    if (std::array{b.x, b.y, b.z} < std::array{a.x, a.y, a.z}) std::swap(a, b);
    return a + form(a) / (form(a) - form(b)) * (b - a);
  };
  std::vector<Vec3> kept;
  Vec3 a = polygon.back();
  for (const Vec3& b : polygon) {
    if ((form(a) > 0) != (form(b) > 0)) kept.push_back(crossing(a, b));
    if (form(b) > 0) kept.push_back(b);
    a = b;
  }
  return kept;
}

}  // namespace

Result<Ballast> choose_ballast(const LayeredPrint& print, const BalanceProblem& problem, const BallastOptions& options,
                               const Job& job) {
  assert(!problem.rows.empty() && std::isfinite(options.required_t));
  assert(print.profile().infill_ratio < options.infill_ratio && options.infill_ratio <= 1);
  return Chooser(print, problem, options).choose(job);
}

TriangleMesh part_of_box(const Box3& box, const AffineForm& form) {
  const auto corner = [&box](unsigned bits) {
    return Vec3{(bits & 1 ? box.max : box.min).x, (bits & 2 ? box.max : box.min).y, (bits & 4 ? box.max : box.min).z};
  };
  // outward, of a box whose corners are numbered by x + 2 y + 4 z
  constexpr std::array<std::array<unsigned, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  TriangleMesh mesh;
  std::map<std::array<double, 3>, std::uint32_t> numbers;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  const auto number = [&](const Vec3& v) {
    const auto [at, is_new] =
        numbers.try_emplace(std::array{v.x, v.y, v.z}, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (is_new) mesh.vertices.push_back(v);
    return at->second;
  };
  const auto add = [&](const std::vector<std::uint32_t>& polygon) {
    for (std::size_t i = 2; i < polygon.size(); ++i) mesh.triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
  };
  for (const auto& face : faces) {
    const auto part = clipped({corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])}, form);
    std::vector<std::uint32_t> polygon;
    polygon.reserve(part.size());
    for (const Vec3& v : part) polygon.push_back(number(v));
    if (polygon.size() < 3) continue;
    add(polygon);
    for (std::size_t i = 0; i < polygon.size(); ++i) edges.emplace(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  std::map<std::uint32_t, std::uint32_t> rim;  // the other way round along edges that only one face has
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from})) rim[to] = from;
  std::vector<std::uint32_t> cap;
  if (!rim.empty())
    for (std::uint32_t at = rim.begin()->first; cap.size() < rim.size(); at = rim.at(at)) cap.push_back(at);
  add(cap);
  return mesh;
}

}  // namespace aplomb
