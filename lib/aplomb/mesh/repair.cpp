#include "aplomb/mesh/repair.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

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
    report_.found = defects_;
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

  /// Keeps the solid and the defects of the last mesh that was asked about.
  Result<bool> is_solid(const TriangleMesh& mesh, double from, double to) {
    solid_.reset();
    defects_ = {};
    if (mesh.triangles.empty()) return false;
    Result<SolidCheck> check = check_solid(mesh, job_.part(from, to));
    if (!check && check.error().code != ErrorCode::unusable_input) return tl::unexpected(check.error());
    if (!check) return refuse_as<bool>(check.error().message);
    defects_ = check->defects;
    solid_ = check->solid;
    return solid_.has_value();
  }

  template <class T>
  static Result<T> refuse_as(const std::string& reason) {
    return fail(ErrorCode::unusable_input, "the mesh cannot be made a solid: " + reason);
  }
  Result<Repaired> refuse(const std::string& reason) const { return refuse_as<Repaired>(reason); }

  /// Weld, clean, wind, sew, fill and nest.
  Result<bool> repair_soup() {
    clean();
    if (mesh_.triangles.empty()) return refuse_as<bool>("all its triangles are degenerate or cancel each other");
    Result<bool> solid = is_solid(mesh_, 0.1, 0.15);
    if (!solid || *solid) return solid;
    if (defects_.nonmanifold_edges + defects_.nonmanifold_vertices > 0) {
      if (defects_.nonmanifold_edges > 0)
        say("The surface was cut apart at " + counted(defects_.nonmanifold_edges, "edge", "edges") +
            " of more than two triangles.");
      if (defects_.nonmanifold_vertices > 0)
        say("The surface was cut apart at " + counted(defects_.nonmanifold_vertices, "vertex", "vertices") +
            " where parts only touched.");
      mesh_ = detail::cut_apart(mesh_);
      solid = is_solid(mesh_, 0.1, 0.15);
      if (!solid) return solid;
    }
    if (!defects_.manifold()) {
      const Result<ClosedSurface> closed = detail::closed_surface(mesh_, limits(), job_.part(0.15, 0.35));
      if (!closed && closed.error().code == ErrorCode::cancelled) return cancelled();
      if (closed) take(*closed);
      if (!closed) say("The holes could not be filled one by one (" + closed.error().message + ").");
      closed_ = mesh_;
      solid = is_solid(mesh_, 0.35, 0.4);
      if (!solid || *solid || !defects_.manifold()) return solid;
    }
    nest();
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
    if (defects_.flipped_edges > 0)
      say("Neighbouring triangles were wound against each other along " +
          counted(defects_.flipped_edges, "edge", "edges") + "; all were wound alike.");
    if (!closed.holes.empty()) {
      double largest = 0, area = 0;
      for (const FilledHole& hole : closed.holes) {
        largest = std::max(largest, hole.diameter_mm);
        area += hole.area_mm2;
      }
      report_.patched_ratio = area / std::max(surface_area(closed.mesh), 1e-300);
      say(counted(closed.holes.size(), "hole", "holes") + " filled (largest " + length(largest) + " across, together " +
          percent(report_.patched_ratio) + " of the surface).");
    }
    if (closed.holes_left > 0) say(counted(closed.holes_left, "hole", "holes") + " could not be filled.");
    mesh_ = detail::welded(closed.mesh);
    // Welding joins again what was cut apart.
    const Result<SolidCheck> check = check_solid(mesh_);
    if (!check || !check->defects.manifold()) mesh_ = rounded_to_float(closed.mesh);
  }

  static double surface_area(const TriangleMesh& mesh) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles)
      area += norm(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a])) / 2;
    return area;
  }

  void nest() {
    const detail::OrientedShells shells = detail::oriented_shells(mesh_);
    if (shells.turned > 0)
      say(counted(shells.turned, "shell was inside out and was", "shells were inside out and were") + " turned.");
    if (shells.dropped > 0)
      say(counted(shells.dropped, "shell changes", "shells change") +
          " nothing where it lies (a body inside the solid, or a void outside it) and was left out; if it was meant as "
          "a void, reverse its winding in the modeller.");
    mesh_ = shells.mesh;
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
    if (!defects_.manifold()) return false;
    if (const std::vector<TriangleMesh> bodies = detail::bodies_to_unite(mesh_); !bodies.empty()) {
      Result<bool> solid = tried(detail::united(bodies, limits(), job_.part(0.45, 0.55)),
                                 counted(bodies.size(), "body", "bodies") + " that crossed or touched were united.");
      if (!solid || *solid) return solid;
    }
    if (Result<bool> solid = try_setting_apart(); !solid || *solid) return solid;
    const std::size_t crossings = defects_.self_intersections;
    std::string sentence = counted(crossings, "self-intersection was", "self-intersections were") +
                           " cut out and the places filled again.";
    constexpr int most_rounds = 4;
    for (int round = 0; round < most_rounds && defects_.manifold(); ++round) {
      const std::size_t before = defects_.self_intersections;
      const Job part = job_.part(0.55 + 0.05 * round, 0.6 + 0.05 * round);
      Result<bool> solid =
          tried(detail::without_self_intersections(mesh_, limits(), part), std::exchange(sentence, {}));
      if (!solid || *solid) return solid;
      if (defects_.self_intersections >= before) break;
    }
    return false;
  }

  /// Parts that only touch, drawn back from one another by less than anybody sees.
  Result<bool> try_setting_apart() {
    const detail::SetApart apart = detail::set_apart(mesh_);
    if (apart.places == 0) return false;
    const MeshDefects before = defects_;
    Result<bool> solid = is_solid(apart.mesh, 0.55, 0.55);
    if (!solid) return solid;
    if (!*solid) {
      defects_ = before;
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
    const MeshDefects before = defects_;
    Result<bool> solid = is_solid(raw, 0.75, 0.75);
    if (!solid) return solid;
    const TriangleMesh candidate =
        defects_.manifold() ? detail::without_crumbs(detail::oriented_shells(raw).mesh) : detail::cleaned(raw).mesh;
    if (candidate.triangles.empty()) return false;
    solid = is_solid(candidate, 0.75, 0.75);
    if (!solid) return solid;
    const bool is_better = *solid || (defects_.manifold() && defects_.self_intersections < before.self_intersections);
    if (!is_better || detail::count_bodies(candidate) > detail::count_bodies(mesh_) || !is_same_solid(candidate)) {
      solid_.reset();
      defects_ = before;
      return false;
    }
    mesh_ = candidate;
    if (!sentence.empty()) say(sentence);
    return solid;
  }

  /// Whether a candidate fills the same space as the mesh it was made of.
  bool is_same_solid(const TriangleMesh& candidate) const {
    constexpr double most_difference_ratio = 0.01;
    const Box3 box = bounding_box(mesh_), candidate_box = bounding_box(candidate);
    const double voxel = box.diagonal() / options_.remesh_voxels;
    if (norm(candidate_box.min - box.min) > 2 * voxel || norm(candidate_box.max - box.max) > 2 * voxel) return false;
    const detail::InsideGrid wanted(mesh_, box, options_.remesh_voxels), got(candidate, box, options_.remesh_voxels);
    return got.difference_mm3(wanted) <= most_difference_ratio * wanted.volume_mm3();
  }

  Result<Repaired> remesh() {
    if (!job_.report(0.75, "repair")) return cancelled();
    const detail::InsideGrid grid(mesh_, bounding_box(mesh_), options_.remesh_voxels);
    const double doubt = grid.doubtful_ratio();
    if (doubt > 0.5 && !options_.insist)
      return refuse(
          "for " + percent(doubt) +
          " of its inside it is not clear that it is inside; close it in a modeller, or insist (--repair force)");
    const TriangleMesh surface = detail::without_crumbs(detail::surface_of(grid, mesh_));
    if (surface.triangles.empty()) return refuse("it encloses no volume");
    Result<bool> solid = is_solid(surface, 0.85, 0.95);
    if (!solid) return tl::unexpected(solid.error());
    if (!*solid) return fail(ErrorCode::internal, "the rebuilt surface has " + describe(defects_));
    mesh_ = surface;
    say("The whole surface was rebuilt on a grid of " + length(grid.voxel_mm()) + " (" + describe(report_.found) +
        " could not be mended in place).");
    return finished(RepairMethod::remeshed);
  }

  /// What the box says of parts that got lost; empty when it is as it was.
  std::string what_was_lost() const {
    constexpr double most_ratio = 0.015;
    const Box3 before = bounding_box(detail::welded(input_)), after = solid_->box();
    const double most_mm = most_ratio * before.diagonal();
    if (norm(after.min - before.min) <= most_mm && norm(after.max - before.max) <= most_mm) return {};
    const auto sides = [](Vec3 size) { return length(size.x) + " x " + length(size.y) + " x " + length(size.z); };
    return "parts of it have no thickness: " + sides(before.size()) + " would become " + sides(after.size()) +
           "; thicken them in a modeller, or insist (--repair force)";
  }

  Result<Repaired> finished(RepairMethod method) {
    if (const std::string lost = what_was_lost(); !lost.empty()) {
      if (!options_.insist) return refuse(lost);
      say("Parts without thickness were lost.");
    }
    report_.method = method;
    report_.outer_unchanged = detail::same_triangles(input_, solid_->mesh());
    report_.volume_after_mm3 = solid_->moments().volume_mm3;
    if (!report_.outer_unchanged) {
      const TriangleMesh& whole = closed_.triangles.empty() ? mesh_ : closed_;
      report_.max_deviation_mm = detail::largest_distance_mm(detail::new_triangles(solid_->mesh(), whole), whole);
    }
    if (method != RepairMethod::none && solid_->bodies() > 1)
      say("The solid is in " + std::to_string(solid_->bodies()) + " pieces that do not touch.");
    if (!job_.report(1, "repair")) return cancelled();
    return Repaired{*solid_, report_};
  }

  const TriangleMesh& input_;
  const RepairOptions& options_;
  const Job& job_;
  TriangleMesh mesh_;
  TriangleMesh closed_;  // with its patches, before anything was moved
  MeshDefects defects_;
  std::optional<SolidMesh> solid_;
  RepairReport report_;
};

}  // namespace

Result<Repaired> repair(const TriangleMesh& mesh, const RepairOptions& options, const Job& job) {
  return Repair(mesh, options, job).run();
}

}  // namespace aplomb
