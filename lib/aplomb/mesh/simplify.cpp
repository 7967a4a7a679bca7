#include "aplomb/mesh/simplify.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "aplomb/core/pulse.h"
#include "aplomb/mesh/detail/corner_table.h"
#include "aplomb/mesh/detail/facet.h"
#include "aplomb/mesh/detail/quadric.h"

namespace aplomb {
namespace {

using detail::Corner;
using detail::CornerTable;
using detail::Facet;
using detail::Quadric;

constexpr std::uint32_t none = CornerTable::none;
constexpr std::uint32_t triangles_a_step = 8;  // about a microsecond
constexpr std::uint32_t most_valence = 24;
constexpr double least_turn_cosine = 0.5;
constexpr double least_height_ratio = 0.05;  // of the longest edge, unless the triangles replaced were worse
constexpr double collinear_ratio = 1e-5;
constexpr double shape_deviations = 4;  // a triangle lower than this many deviations has no normal to speak of
constexpr double first_limit = 0x1p-10, limit_factor = 4;  // on costs, from pass to pass; 1 is the last
constexpr double another_pass_share = 0.02;                // at the same limit, while so many vertices go
constexpr double watched_share = 0.2;                      // of the deviation: edges sharper than that are watched
constexpr double length_weight = 1e-6;                     // breaks ties in flat places: short edges first

class Simplifier {
 public:
  /// Where the pulse stopped, of no use.
  Simplifier(const TriangleMesh& fine, double deviation, const std::vector<bool>& kept, const Pulse& pulse)
      : fine_(fine),
        kept_(kept),
        squared_deviation_(deviation * deviation),
        table_(fine, pulse),
        quadrics_(fine.vertices.size()),
        shapes_(fine.triangles.size()),
        points_(fine.vertices),
        first_points_(fine.triangles.size(), none),
        outlooks_(fine.vertices.size()),
        touched_(fine.vertices.size(), 0) {
    for (std::uint32_t t = 0; t < fine.triangles.size(); ++t) {
      if (t % triangles_a_step == 0 && !pulse.goes_on()) return;
      const Triangle& corners = fine.triangles[t];
      const Facet facet(at(corners[0]), at(corners[1]), at(corners[2]));
      if (!(facet.doubled_area() > 0)) continue;
      const Vec3 normal = facet.area_vector() / facet.doubled_area();
      if (facet.height() >= shape_deviations * deviation) shapes_[t] = normal;
      const Quadric quadric(normal, dot(normal, at(corners[0])), facet.doubled_area());
      for (const std::uint32_t v : corners) quadrics_[v] += quadric;
    }
    next_points_.assign(points_.size(), none);
    for (Corner c = 0; c < 3 * fine.triangles.size(); ++c) {
      if (c % triangles_a_step == 0 && !pulse.goes_on()) return;
      if (c < table_.twin(c)) watch_sharp(c);
    }
  }

  /// False: cancelled.
  bool run(const Job& job) {
    std::vector<std::uint32_t> left;
    for (std::uint32_t v = 0; v < fine_.vertices.size(); ++v)
      if (table_.leaving(v) != none && (kept_.empty() || !kept_[v])) left.push_back(v);
    for (double limit = first_limit; limit <= 1; limit *= limit_factor)
      for (std::size_t removed = left.size();
           double(removed) > (limit < 1 ? another_pass_share : 0) * double(left.size());) {
        const std::size_t before = left.size();
        if (!pass(left, limit, job)) return false;
        removed = before - left.size();
      }
    return true;
  }

  SimplifiedMesh result() const;

 private:
  struct Way {
    Corner edge = none;
    double cost = 0;
  };

  /// What is known of removing a vertex since its neighbourhood changed.
  struct Outlook {
    double least = 0;    // no way costs less
    double failed = -1;  // ways that cost no more than this will not do
  };

  Vec3 at(std::uint32_t v) const { return fine_.vertices[v]; }

  /// Vertices alone do not see an edge turned into the other diagonal of its two triangles: where the diagonals are
  /// apart, the middle of the edge is watched as well.
  void watch_sharp(Corner c) {
    const Vec3 a = at(table_.vertex(c)), b = at(table_.head(c));
    const Vec3 left = at(table_.vertex(CornerTable::previous(c)));
    const Vec3 right = at(table_.vertex(CornerTable::previous(table_.twin(c))));
    const Vec3 across = cross(b - a, right - left);
    const double apart = dot(across, left - a);
    if (apart * apart <= watched_share * watched_share * squared_deviation_ * squared_norm(across)) return;
    next_points_.push_back(first_points_[c / 3]);
    first_points_[c / 3] = static_cast<std::uint32_t>(points_.size());
    points_.push_back(0.5 * (a + b));
  }

  /// Of collapsing an edge, over the squared deviation.
  double cost(Corner c) const {
    const std::uint32_t u = table_.vertex(c), v = table_.head(c);
    const Quadric &a = quadrics_[u], &b = quadrics_[v];
    const double mean = std::max(0.0, a(at(v)) + b(at(v))) / (a.weight() + b.weight());
    return (mean + length_weight * squared_norm(at(v) - at(u))) / squared_deviation_;
  }

  /// Removes what it may of the vertices left, in their order (which is that of memory), and none next to another.
  bool pass(std::vector<std::uint32_t>& left, double limit, const Job& job) {
    ++pass_;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (i % 8192 == 0 && !job.report(progress(left.size()), "simplify")) return false;
      const std::uint32_t u = left[i];
      if (touched_[u] == pass_ || outlooks_[u].least > limit || !remove(u, limit)) left[kept++] = u;
    }
    left.resize(kept);
    return true;
  }
  double progress(std::size_t left) const { return 1 - double(left) / double(fine_.vertices.size()); }

  bool remove(std::uint32_t u, double limit) {
    Outlook& outlook = outlooks_[u];
    ways_.clear();
    double later = std::numeric_limits<double>::infinity();
    const Corner start = table_.leaving(u);
    Corner c = start;
    do {
      const double way_cost = cost(c);
      if (way_cost > limit) later = std::min(later, way_cost);
      else if (way_cost > outlook.failed) ways_.push_back({c, way_cost});
      c = table_.turned(c);
    } while (c != start);
    std::ranges::sort(ways_,
                      [](const Way& a, const Way& b) { return a.cost != b.cost ? a.cost < b.cost : a.edge < b.edge; });
    for (const Way& way : ways_) {
      if (!table_.may_collapse(way.edge) || !shapes_well(way.edge) || !stays_near(way.edge)) continue;
      collapse(way.edge);
      return true;
    }
    outlook = {later, limit};
    return false;
  }

  bool shapes_well(Corner c);
  bool stays_near(Corner c);
  bool place(std::uint32_t point);
  void collapse(Corner c);

  const TriangleMesh& fine_;
  const std::vector<bool>& kept_;
  const double squared_deviation_;
  CornerTable table_;
  std::vector<Quadric> quadrics_;  // by vertex
  std::vector<Vec3> shapes_;       // by triangle: its normal when it first had one, or zero
  std::vector<Vec3> points_;       // that stay near: the given vertices, then the middles of sharp edges
  std::vector<std::uint32_t> first_points_, next_points_;  // by triangle, by point: the points near a triangle
  std::vector<Outlook> outlooks_;                          // by vertex
  std::vector<std::uint32_t> touched_;                     // by vertex: the last pass that removed a neighbour
  std::uint32_t pass_ = 0;

  // Of the collapse in question.
  std::vector<Way> ways_;
  std::vector<Facet> facets_;                                    // that the moved triangles become
  std::vector<std::uint32_t> moved_;                             // their numbers
  std::vector<std::pair<std::uint32_t, std::uint32_t>> placed_;  // point, index into facets_
};

bool Simplifier::shapes_well(Corner c) {
  const std::uint32_t u = table_.vertex(c), v = table_.head(c);
  if (table_.valence(u) + table_.valence(v) > most_valence + 4) return false;
  facets_.clear();
  moved_.clear();
  const Corner last = detail::next_corner(table_.twin(c));  // in the other triangle that vanishes
  Vec3 sum;
  double worst = 1;
  for (Corner e = table_.turned(c); e != last; e = table_.turned(e)) {
    const Vec3 from = at(table_.head(e)), to = at(table_.vertex(CornerTable::previous(e)));
    const Facet& facet = facets_.emplace_back(at(v), from, to);
    moved_.push_back(e / 3);
    worst = std::min(worst, facet.height_ratio());
    sum += facet.area_vector();
  }
  if (worst < collinear_ratio) return false;
  const double sum_norm = norm(sum);
  for (std::size_t i = 0; i < facets_.size(); ++i) {
    const Facet& facet = facets_[i];
    const Vec3 shape = shapes_[moved_[i]];
    if (shape == Vec3{} ? dot(facet.area_vector(), sum) < least_turn_cosine * sum_norm * facet.doubled_area()
                        : dot(facet.area_vector(), shape) < least_turn_cosine * facet.doubled_area())
      return false;
  }
  if (worst >= least_height_ratio) return true;
  double worst_before = 1;
  Corner e = c;
  do {
    worst_before = std::min(
        worst_before, Facet(at(u), at(table_.head(e)), at(table_.vertex(CornerTable::previous(e)))).height_ratio());
    e = table_.turned(e);
  } while (e != c);
  return worst > worst_before;
}

/// Finds a facet near enough for the point.
bool Simplifier::place(std::uint32_t point) {
  double nearest = squared_deviation_;
  std::uint32_t found = none;
  for (std::uint32_t i = 0; i < facets_.size(); ++i)
    if (const double squared = facets_[i].squared_distance(points_[point]); squared <= nearest) {
      nearest = squared;
      found = i;
      if (squared < 0.01 * squared_deviation_) break;
    }
  if (found == none) return false;
  placed_.emplace_back(point, found);
  return true;
}

bool Simplifier::stays_near(Corner c) {
  placed_.clear();
  for (Facet& facet : facets_) facet.prepare();
  if (!place(table_.vertex(c))) return false;
  Corner e = c;
  do {
    for (std::uint32_t p = first_points_[e / 3]; p != none; p = next_points_[p])
      if (!place(p)) return false;
    e = table_.turned(e);
  } while (e != c);
  return true;
}

void Simplifier::collapse(Corner c) {
  const std::uint32_t u = table_.vertex(c), v = table_.head(c);
  Corner e = c;
  do {
    touched_[table_.head(e)] = pass_;
    outlooks_[table_.head(e)] = {};
    e = table_.turned(e);
  } while (e != c);
  table_.collapse(c);
  quadrics_[v] += quadrics_[u];
  for (const std::uint32_t t : moved_) first_points_[t] = none;
  for (const auto& [point, facet] : placed_) {
    next_points_[point] = first_points_[moved_[facet]];
    first_points_[moved_[facet]] = point;
  }
  const double least_height = shape_deviations * std::sqrt(squared_deviation_);
  for (std::size_t i = 0; i < moved_.size(); ++i)
    if (shapes_[moved_[i]] == Vec3{} && facets_[i].height() >= least_height)
      shapes_[moved_[i]] = normalized(facets_[i].area_vector());
}

SimplifiedMesh Simplifier::result() const {
  SimplifiedMesh result{{}, {}, std::vector<std::uint32_t>(fine_.vertices.size(), SimplifiedMesh::no_triangle)};
  std::vector<std::uint32_t> numbers(fine_.vertices.size(), none);
  for (std::uint32_t v = 0; v < numbers.size(); ++v)
    if (table_.leaving(v) != none) {
      numbers[v] = static_cast<std::uint32_t>(result.mesh.vertices.size());
      result.mesh.vertices.push_back(at(v));
      result.given_vertices.push_back(v);
    }
  for (std::uint32_t t = 0; t < fine_.triangles.size(); ++t) {
    if (!table_.has_triangle(t)) continue;
    const auto number = static_cast<std::uint32_t>(result.mesh.triangles.size());
    for (std::uint32_t p = first_points_[t]; p != none; p = next_points_[p])
      if (p < fine_.vertices.size()) result.triangle_near[p] = number;
    Triangle corners{};
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t v = table_.vertex(3 * t + i);
      result.triangle_near[v] = number;
      corners[i] = numbers[v];
    }
    result.mesh.triangles.push_back(corners);
  }
  return result;
}

}  // namespace

Result<SimplifiedMesh> simplify(const TriangleMesh& fine, double deviation_mm, const std::vector<bool>& kept,
                                const Job& job) {
  assert(deviation_mm > 0);
  assert(kept.empty() || kept.size() == fine.vertices.size());
  const Pulse pulse(job, 0, "simplify");
  Simplifier simplifier(fine, deviation_mm, kept, pulse);
  if (pulse.stopped()) return cancelled();
  if (!simplifier.run(job)) return cancelled();
  return simplifier.result();
}

}  // namespace aplomb
