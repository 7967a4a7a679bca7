#include "aplomb/holes/drill.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>

#include "aplomb/adapters/cgal/boolean.h"
#include "aplomb/core/isolated.h"
#include "aplomb/core/pulse.h"
#include "aplomb/mesh/detail/mesh_bytes.h"

namespace aplomb {
namespace {

constexpr int most_tries = 6;
constexpr double next_try_rad = 0.0417;  // a fraction of a side that never meets it again
const IsolationLimits limits{.seconds = 120, .memory_mb = 4096};

using Operation = std::optional<TriangleMesh> (*)(const TriangleMesh&, const TriangleMesh&);

/// A Boolean in a child; nothing where CGAL has no answer.
Result<std::optional<TriangleMesh>> combined(Operation operation, const TriangleMesh& body, const TriangleMesh& tool,
                                             const Job& job) {
  const auto bytes = run_isolated(
      [&] {
        const std::optional<TriangleMesh> mesh = operation(body, tool);
        return mesh ? detail::packed(*mesh) : std::string();
      },
      limits, job, "cut escape holes");
  if (!bytes && bytes.error().code == ErrorCode::third_party) return std::optional<TriangleMesh>();
  if (!bytes) return tl::unexpected(bytes.error());
  if (bytes->empty()) return std::optional<TriangleMesh>();
  std::size_t at = 0;
  auto mesh = detail::unpacked(*bytes, at);
  return mesh ? std::optional(std::move(*mesh)) : std::nullopt;
}

struct HashOfPoint {
  std::size_t operator()(const Vec3& p) const {
    const std::hash<double> hash;
    return hash(p.x) ^ (hash(p.y) * 0x9E3779B97F4A7C15U) ^ (hash(p.z) * 0xC2B2AE3D27D4EB4FU);
  }
};

/// With its least vertex first, as wound.
Triangle turned(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// The cut mesh with the triangles that it shares with the one before it first, in that one's order. Where the pulse
/// stopped, not all of it.
Drilled in_order_of(const TriangleMesh& before, std::size_t outer_triangles, const TriangleMesh& cut,
                    const Pulse& pulse) {
  std::unordered_map<Vec3, std::uint32_t, HashOfPoint> numbers;
  for (std::uint32_t v = 0; v < before.vertices.size() && pulse.goes_on(); ++v) numbers.emplace(before.vertices[v], v);
  Drilled drilled{{before.vertices, {}}, 0, 0, {}};
  std::vector<std::uint32_t> number_of(cut.vertices.size());
  for (std::size_t v = 0; v < cut.vertices.size(); ++v) {
    const auto known = numbers.find(cut.vertices[v]);
    number_of[v] = known != numbers.end() ? known->second : static_cast<std::uint32_t>(drilled.mesh.vertices.size());
    if (known == numbers.end()) drilled.mesh.vertices.push_back(cut.vertices[v]);
  }
  std::set<Triangle> kept;
  std::vector<Triangle> made;
  std::set<Triangle> known;
  for (const Triangle& t : before.triangles) {
    if (!pulse.goes_on()) break;
    known.insert(turned(t));
  }
  for (const Triangle& t : cut.triangles) {
    if (!pulse.goes_on()) break;
    const Triangle now{number_of[t[0]], number_of[t[1]], number_of[t[2]]};
    if (known.contains(turned(now))) kept.insert(turned(now));
    else made.push_back(now);
  }
  for (std::size_t t = 0; t < before.triangles.size() && pulse.goes_on(); ++t)
    if (kept.contains(turned(before.triangles[t]))) {
      drilled.mesh.triangles.push_back(before.triangles[t]);
      if (t < outer_triangles) ++drilled.untouched_outer;
    }
  drilled.untouched = drilled.mesh.triangles.size();
  drilled.mesh.triangles.insert(drilled.mesh.triangles.end(), made.begin(), made.end());
  return drilled;
}

/// Without vertices that no triangle uses.
TriangleMesh tidy(TriangleMesh mesh) {
  constexpr std::uint32_t unused = 0xFFFFFFFF;
  std::vector<std::uint32_t> numbers(mesh.vertices.size(), unused);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) numbers[v] = 0;
  std::vector<Vec3> used;
  for (std::size_t v = 0; v < numbers.size(); ++v)
    if (numbers[v] != unused) {
      numbers[v] = static_cast<std::uint32_t>(used.size());
      used.push_back(mesh.vertices[v]);
    }
  for (Triangle& t : mesh.triangles) t = {numbers[t[0]], numbers[t[1]], numbers[t[2]]};
  return {std::move(used), std::move(mesh.triangles)};
}

}  // namespace

Result<Drilled> drill(const TriangleMesh& solid, std::size_t outer_triangles, std::span<const Hole> holes,
                      const Job& job) {
  std::vector<Hole> turned_holes(holes.begin(), holes.end());
  std::string why = "no answer";
  for (int round = 0; round < most_tries; ++round) {
    const Job part = job.part(double(round) / most_tries, double(round + 1) / most_tries);
    TriangleMesh tool;
    for (Hole& hole : turned_holes) {
      if (round > 0) hole.turn_rad += next_try_rad;
      tool = joined(std::move(tool), prism_of(hole));
    }
    const auto cut = combined(adapters::difference, solid, tool, part.part(0, 0.6));
    if (!cut) return tl::unexpected(cut.error());
    if (!*cut) continue;
    const Pulse pulse(part, 0.6, "cut escape holes");
    Drilled drilled = in_order_of(solid, outer_triangles, **cut, pulse);
    if (pulse.stopped()) return cancelled();
    drilled.mesh = rounded_to_float(tidy(std::move(drilled.mesh)));
    drilled.holes = turned_holes;
    const auto checked = check_solid(drilled.mesh, part.part(0.6, 1));
    if (!checked) return tl::unexpected(checked.error());
    if (checked->solid) return drilled;
    why = describe(checked->defects);
  }
  return fail(ErrorCode::third_party, "the escape holes cannot be cut: " + why);
}

Result<std::vector<TriangleMesh>> plugs(const TriangleMesh& outer, std::span<const Hole> holes, double clearance_mm,
                                        const Job& job) {
  std::vector<TriangleMesh> made;
  for (std::size_t n = 0; n < holes.size(); ++n) {
    Hole hole = holes[n];
    std::optional<TriangleMesh> plug;
    std::string why = "no answer";
    for (int round = 0; round < most_tries && !plug; ++round) {
      const Job part = job.part(double(n) / double(holes.size()), double(n + 1) / double(holes.size()));
      auto cut = combined(adapters::intersection, outer, prism_of(hole, hole.throat_mm, clearance_mm), part);
      if (!cut) return tl::unexpected(cut.error());
      hole.throat_mm += 1e-3;  // another try
      if (!*cut) continue;
      TriangleMesh rounded = rounded_to_float(std::move(**cut));
      const auto checked = check_solid(rounded, part);
      if (!checked) return tl::unexpected(checked.error());
      if (checked->solid) plug = std::move(rounded);
      else why = describe(checked->defects);
    }
    if (!plug) return fail(ErrorCode::third_party, "a plug cannot be made: " + why);
    made.push_back(std::move(*plug));
  }
  return made;
}

}  // namespace aplomb
