#include "aplomb/mesh/repair.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "aplomb/mesh/detail/crossings.h"
#include "aplomb/mesh/detail/fans.h"
#include "aplomb/mesh/detail/inside_grid.h"
#include "aplomb/mesh/detail/isolated_repair.h"
#include "aplomb/mesh/detail/nearest.h"
#include "aplomb/mesh/detail/shells.h"
#include "aplomb/mesh/detail/soup.h"
#include "aplomb/mesh/detail/words.h"
#include "aplomb/mesh/mass_properties.h"

namespace aplomb {
namespace {

using adapters::ClosedSurface;
using adapters::FilledHole;
using detail::counted;
using detail::length;
using detail::percent;

/// The run of one repair: the mesh as it stands, and what was said about it.
class Repair {
 public:
  Repair(const TriangleMesh& input, const RepairOptions& options, const Job& job)
      : input_(input), options_(options), job_(job) {}

  Result<Repaired> run() {
    if (input_.triangles.empty()) return fail(ErrorCode::unusable_input, "the mesh has no triangles");
    mesh_ = welded_input();
    Result<bool> solid = is_solid(mesh_, 0, 0.1);
    if (!solid) return tl::unexpected(solid.error());
    report_.found = checked_.defects;
    report_.volume_before_mm3 = moments(mesh_).volume_mm3;
    if (*solid) return finished(RepairMethod::none);
    if (bounding_box(mesh_).diagonal() <= 0) return refuse("all its points are one");

    solid = repair_soup();
    if (!solid) return tl::unexpected(solid.error());
    if (std::string reason = what_is_made_up(); !reason.empty() && !options_.insist) return refuse(reason);
    if (*solid) return finished(RepairMethod::soup);

    const TriangleMesh before = mesh_;
    const std::size_t steps = report_.steps.size();
    solid = repair_crossings();
    if (!solid) return tl::unexpected(solid.error());
    if (*solid) return finished(RepairMethod::local);
    mesh_ = before;
    report_.steps.resize(steps);
    return remesh();
  }

 private:
  void say(std::string sentence) { report_.steps.push_back(std::move(sentence)); }

  TriangleMesh welded_input() {
    TriangleMesh mesh = detail::welded(input_);
    if (mesh.vertices.size() < input_.vertices.size())
      say(counted(input_.vertices.size() - mesh.vertices.size(), "vertex was", "vertices were") +
          " at the place of another one or unused, and merged or left out.");
    return mesh;
  }

  /// Keeps what it learnt in checked_.
  Result<bool> is_solid(const TriangleMesh& mesh, double from, double to) {
    checked_ = {};
    if (mesh.triangles.empty()) return false;
    Result<SolidCheck> check = check_solid(mesh, job_.part(from, to));
    if (!check) return refused<bool>(check.error());
    checked_ = std::move(*check);
    return checked_.solid.has_value();
  }

  template <class T>
  static Result<T> refuse_as(const std::string& reason) {
    return fail(ErrorCode::unusable_input, "the mesh cannot be made a solid: " + reason);
  }
  /// The end of a part of the work is that of the whole.
  template <class T>
  static Result<T> refused(const Error& error) {
    if (error.code != ErrorCode::unusable_input) return tl::unexpected(error);
    return refuse_as<T>(error.message);
  }
  Result<Repaired> refuse(const std::string& reason) const { return refuse_as<Repaired>(reason); }

  /// Weld, clean, wind, sew, fill and nest.
  Result<bool> repair_soup() {
    clean();
    if (mesh_.triangles.empty()) return refuse_as<bool>("all its triangles are degenerate or cancel each other");
    Result<bool> solid = is_solid(mesh_, 0.1, 0.15);
    if (!solid || *solid) return solid;
    if (checked_.defects.nonmanifold_edges + checked_.defects.nonmanifold_vertices > 0) {
      if (checked_.defects.nonmanifold_edges > 0)
        say("The surface was cut apart at " + counted(checked_.defects.nonmanifold_edges, "edge", "edges") +
            " of more than two triangles.");
      if (checked_.defects.nonmanifold_vertices > 0)
        say("The surface was cut apart at " + counted(checked_.defects.nonmanifold_vertices, "vertex", "vertices") +
            " where parts only touched.");
      mesh_ = detail::cut_apart(mesh_);
      solid = is_solid(mesh_, 0.1, 0.15);
      if (!solid) return solid;
    }
    if (!checked_.defects.manifold()) {
      const Result<ClosedSurface> closed = detail::closed_surface(mesh_, limits(), job_.part(0.15, 0.35));
      if (!closed && closed.error().code == ErrorCode::cancelled) return cancelled();
      if (closed) take(*closed);
      if (!closed) say("The holes could not be filled one by one (" + closed.error().message + ").");
      closed_ = mesh_;
      solid = is_solid(mesh_, 0.35, 0.4);
      if (!solid || *solid || !checked_.defects.manifold()) return solid;
    }
    if (const Result<void> nested = nest(); !nested) return tl::unexpected(nested.error());
    closed_ = mesh_;
    if (mesh_.triangles.empty()) return refuse_as<bool>("no shell of it encloses anything");
    return is_solid(mesh_, 0.4, 0.45);
  }

  void clean() {
    const detail::CleanSoup soup = detail::cleaned(mesh_);
    if (soup.merged > 0)
      say(counted(soup.merged, "vertex was", "vertices were") + " within rounding of another one and merged with it.");
    if (soup.degenerate > 0) say(counted(soup.degenerate, "triangle", "triangles") + " without area left out.");
    if (soup.duplicates > 0)
      say(counted(soup.duplicates, "triangle", "triangles") + " that stood at the place of another one left out.");
    if (soup.split_edges > 0)
      say(counted(soup.split_edges, "edge", "edges") + " cut at vertices that lay on them (T-junctions).");
    mesh_ = soup.mesh;
  }

  IsolationLimits limits() const { return {.seconds = options_.step_seconds, .memory_mb = options_.step_memory_mb}; }

  void take(const ClosedSurface& closed) {
    if (checked_.defects.flipped_edges > 0)
      say("Neighbouring triangles were wound against each other along " +
          counted(checked_.defects.flipped_edges, "edge", "edges") + "; all were wound alike.");
    if (!closed.holes.empty()) {
      double largest = 0, area = 0;
      for (const FilledHole& hole : closed.holes) {
        largest = std::max(largest, hole.diameter_mm);
        area += hole.area_mm2;
      }
      report_.patched_ratio = area / std::max(detail::surface_area_mm2(closed.mesh), 1e-300);
      say(counted(closed.holes.size(), "hole", "holes") + " filled (largest " + length(largest) + " across, together " +
          percent(report_.patched_ratio) + " of the surface).");
    }
    if (closed.holes_left > 0) say(counted(closed.holes_left, "hole", "holes") + " could not be filled.");
    mesh_ = detail::welded(closed.mesh);
    // Welding joins again what was cut apart.
    const Result<SolidCheck> check = check_solid(mesh_);
    if (!check || !check->defects.manifold()) mesh_ = rounded_to_float(closed.mesh);
  }

  Result<void> nest() {
    const Result<detail::OrientedShells> oriented = detail::oriented_shells(mesh_, job_.part(0.4, 0.4));
    if (!oriented) return refused<void>(oriented.error());
    const detail::OrientedShells& shells = *oriented;
    if (shells.turned > 0)
      say(counted(shells.turned, "shell was inside out and was", "shells were inside out and were") + " turned.");
    if (shells.dropped > 0)
      say(counted(shells.dropped, "shell changes", "shells change") +
          " nothing where it lies (a body inside the solid, or a void outside it) and was left out; if it was meant as "
          "a void, reverse its winding in the modeller.");
    mesh_ = shells.mesh;
    return {};
  }

  /// Why the solid would be our invention rather than the file's; empty when it is not.
  std::string what_is_made_up() const {
    if (report_.patched_ratio > options_.most_patched_ratio)
      return "it is an open surface, " + percent(report_.patched_ratio) +
             " of the closed one would be made up; close it in a modeller, or insist (--repair force)";
    return {};
  }

  /// Unites bodies that cross, then cuts out crossings for as long as that helps; judged against the grid.
  Result<bool> repair_crossings() {
    if (!checked_.defects.manifold()) return false;
    if (const std::vector<TriangleMesh> bodies = detail::bodies_to_unite(mesh_); !bodies.empty()) {
      Result<bool> solid = tried(detail::united(bodies, limits(), job_.part(0.45, 0.55)),
                                 counted(bodies.size(), "body", "bodies") + " that crossed or touched were united.");
      if (!solid || *solid) return solid;
    }
    if (Result<bool> solid = try_setting_apart(); !solid || *solid) return solid;
    const std::size_t crossings = checked_.defects.self_intersections;
    if (crossings >= detail::most_crossings) return false;  // as many as were counted: no cutting out will do
    std::string sentence = counted(crossings, "self-intersection was", "self-intersections were") +
                           " cut out and the places filled again.";
    constexpr int most_rounds = 4;
    for (int round = 0; round < most_rounds && checked_.defects.manifold(); ++round) {
      const std::size_t before = checked_.defects.self_intersections;
      const Job part = job_.part(0.55 + 0.05 * round, 0.6 + 0.05 * round);
      Result<bool> solid =
          tried(detail::without_self_intersections(mesh_, limits(), part), std::exchange(sentence, {}));
      if (!solid || *solid) return solid;
      if (checked_.defects.self_intersections >= before) break;
    }
    return false;
  }

  /// Parts that only touch, drawn back from one another by less than anybody sees.
  Result<bool> try_setting_apart() {
    const detail::SetApart apart = detail::set_apart(mesh_);
    if (apart.places == 0) return false;
    const MeshDefects before = checked_.defects;
    Result<bool> solid = is_solid(apart.mesh, 0.55, 0.55);
    if (!solid) return solid;
    if (!*solid) {
      checked_.defects = before;
      return false;
    }
    mesh_ = apart.mesh;
    say("Parts that only touched at " + counted(apart.places, "place", "places") + " were drawn apart by " +
        length(2 * apart.distance_mm) + ".");
    return true;
  }

  /// Takes a candidate when it is the same solid with fewer crossings, and says so; true when none are left.
  Result<bool> tried(const Result<std::optional<TriangleMesh>>& result, const std::string& sentence) {
    if (!result && result.error().code == ErrorCode::cancelled) return cancelled();
    if (!result || !*result) return false;
    const TriangleMesh raw = detail::welded(**result);
    if (raw.triangles.empty()) return false;
    const MeshDefects before = checked_.defects;
    Result<bool> solid = is_solid(raw, 0.75, 0.75);
    if (!solid) return solid;
    TriangleMesh candidate;
    if (checked_.defects.manifold()) {
      const Result<detail::OrientedShells> shells = detail::oriented_shells(raw, job_.part(0.75, 0.75));
      if (!shells) return refused<bool>(shells.error());
      candidate = detail::without_crumbs(shells->mesh);
    } else {
      candidate = detail::cleaned(raw).mesh;
    }
    if (candidate.triangles.empty()) return false;
    solid = is_solid(candidate, 0.75, 0.75);
    if (!solid) return solid;
    const bool is_better =
        *solid || (checked_.defects.manifold() && checked_.defects.self_intersections < before.self_intersections);
    bool is_taken = is_better && detail::count_bodies(candidate) <= detail::count_bodies(mesh_);
    if (is_taken) {
      const Result<bool> same = detail::fill_alike(mesh_, candidate, options_.remesh_voxels, job_.part(0.75, 0.75));
      if (!same) return refused<bool>(same.error());
      is_taken = *same;
    }
    if (!is_taken) {
      checked_.solid.reset();
      checked_.defects = before;
      return false;
    }
    mesh_ = candidate;
    if (!sentence.empty()) say(sentence);
    return solid;
  }

  Result<Repaired> remesh() {
    if (!job_.report(0.75, "repair")) return cancelled();
    const auto sampled =
        detail::InsideGrid::sampled(mesh_, bounding_box(mesh_), options_.remesh_voxels, job_.part(0.75, 0.8));
    if (!sampled) return refused<Repaired>(sampled.error());
    const detail::InsideGrid& grid = *sampled;
    const double doubt = grid.doubtful_ratio();
    if (doubt > 0.5 && !options_.insist)
      return refuse(
          "for " + percent(doubt) +
          " of its inside it is not clear that it is inside; close it in a modeller, or insist (--repair force)");
    const TriangleMesh surface = detail::without_crumbs(detail::surface_of(grid, mesh_));
    if (surface.triangles.empty()) return refuse("it encloses no volume");
    Result<bool> solid = is_solid(surface, 0.85, 0.95);
    if (!solid) return tl::unexpected(solid.error());
    if (!*solid) return fail(ErrorCode::internal, "the rebuilt surface has " + describe(checked_.defects));
    mesh_ = surface;
    say("The whole surface was rebuilt on a grid of " + length(grid.voxel_mm()) + " (" + describe(report_.found) +
        " could not be mended in place).");
    return finished(RepairMethod::remeshed);
  }

  Result<Repaired> finished(RepairMethod method) {
    report_.method = method;
    report_.volume_after_mm3 = checked_.solid->moments().volume_mm3;
    if (method != RepairMethod::none) {
      const Box3 before = bounding_box(detail::welded(input_));
      if (const std::string lost = detail::lost_parts(before, checked_.solid->box()); !lost.empty()) {
        if (!options_.insist) return refuse(lost);
        say("Parts without thickness were lost.");
      }
      report_.outer_unchanged = detail::same_triangles(input_, checked_.solid->mesh());
      if (checked_.solid->bodies() > 1)
        say("The solid is in " + std::to_string(checked_.solid->bodies()) + " pieces that do not touch.");
    }
    if (!report_.outer_unchanged) {
      const TriangleMesh& whole = closed_.triangles.empty() ? mesh_ : closed_;
      report_.max_deviation_mm =
          detail::largest_distance_mm(detail::new_triangles(checked_.solid->mesh(), whole), whole);
    }
    if (!job_.report(1, "repair")) return cancelled();
    return Repaired{*checked_.solid, report_, std::move(checked_.prints)};
  }

  const TriangleMesh& input_;
  const RepairOptions& options_;
  const Job& job_;
  TriangleMesh mesh_;
  TriangleMesh closed_;  // with its patches, before anything was moved
  SolidCheck checked_;   // of the last mesh that was asked about
  RepairReport report_;
};

}  // namespace

Result<Repaired> repair(const TriangleMesh& mesh, const RepairOptions& options, const Job& job) {
  return Repair(mesh, options, job).run();
}

}  // namespace aplomb
