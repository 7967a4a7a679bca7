#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "aplomb/balance/poses.h"
#include "aplomb/core/stage_clock.h"
#include "aplomb/printability/finding.h"

namespace aplomb {

enum class Outcome {
  already_stands,  ///< as it came, at the angle asked for
  stands,          ///< it does now
  best_effort,     ///< it does not; the nearest that could be reached
  falls,           ///< it does not, and only that was asked (`check`)
};

/// What was kept in the voids so that their ceilings print.
struct CeilingFigures {
  std::size_t ribs = 0;     ///< upright sheets that ceilings are bridged between
  std::size_t pillars = 0;  ///< under what would start in mid-air
  std::size_t fills = 0;    ///< where walls between voids were too thin
  std::size_t rounds = 0;   ///< times it was carved again
  std::size_t left = 0;     ///< findings of the judge that remain
  bool reached_without = false;
  double bound_rad = 0;     ///< what no void in this volume does better than, ceilings or not (see bound_of)
  double cost_rad = 0;      ///< by which the bound of what was carved falls short of that
  double material_mm3 = 0;  ///< that the void holds less than without it
};

struct CarvingFigures {
  std::string aim;  ///< "least", "light" or "stable"
  double void_mm3 = 0;
  double bound_rad = 0;    ///< no void in this volume gives a larger tip angle (see bound_of)
  double gap_rad = 0;      ///< between the bound and what was reached
  std::size_t planes = 0;  ///< tried until it was proved
  BoundOf bound_of = BoundOf::tip;
  std::optional<CeilingFigures> ceiling{};  ///< where ceilings were to be shaped
};

/// What was done to the outside.
struct DeformationFigures {
  struct Trim {
    double trim_mm = 0;
    double tip_rad = 0;  ///< what carving would reach, estimated
  };
  std::string outcome;  ///< "trimmed" (the cut alone serves), "reached", "limit" (of the mean displacement), "stuck"
  double trim_mm = 0;   ///< cut off the base
  std::vector<Trim> trims;         ///< what cuts would gain
  double mean_mm = 0;              ///< displacement, weighted by the solid's volume
  double max_mm = 0;               ///< of a vertex of the surface
  double handle_short_mm = 0;      ///< how far a handle that was to be moved is from its place
  double max_turn_rad = 0;         ///< of a piece of the cage; no more than that where the surface stopped earlier
  double volume_change_ratio = 0;  ///< of the solid, the cut included
  int iterations = 0;
  double energy_mm3 = 0;
};

/// How one pose holds.
struct PoseReport {
  Pose pose;
  PoseMeasure before;
  std::optional<PoseMeasure> after;
  bool holds = false;  ///< as asked, after where there is one
};

struct WallFigures {
  double required_mm = 0;
  double measured_mm = 0;  ///< exact, on the rounded output
};

/// How mass was moved by infill.
struct BallastFigures {
  double low_ratio = 0, high_ratio = 1;  ///< of the infill
  AffineForm dense;                      ///< high where positive
  double added_mm3 = 0, added_g = 0;     ///< of material, to a print with the low infill throughout
  double bound_rad = 0;                  ///< no filling between the two gives a larger tip angle (see bound_of)
  BoundOf bound_of = BoundOf::tip;
  std::size_t planes = 0;  ///< tried until it was proved
};

/// An escape hole that was cut.
struct HoleFigures {
  Vec3 mouth_mm;   ///< where its axis leaves the solid
  Vec3 throat_mm;  ///< where it leaves the void
  Vec3 outward;    ///< along it, of length 1
  double diameter_mm = 0;
  double depth_mm = 0;  ///< from throat to mouth
};

/// A pocket, and the inserts that are to be laid into it when the print pauses.
struct PocketFigures {
  std::string name;           ///< of the insert
  int count = 1;              ///< one on another
  Vec3 at_mm;                 ///< their centre of mass
  double pause_mm = 0;        ///< above the plate: where the ceiling begins, and the print pauses
  double floor_mm = 0;        ///< above the plate: the pocket's lowest point
  double diameter_mm = 0;     ///< of the pocket
  double mass_g = 0;          ///< of the inserts
  double first_print_mm = 0;  ///< above the plate: the top of the first layer after the pause
};

struct InsertFigures {
  std::vector<PocketFigures> pockets;
  int allowed = 0;         ///< inserts that there were
  double reached_rad = 0;  ///< by inserts alone (see bound_of)
  double bound_rad = 0;    ///< no choice of as many at the places looked at does better
  BoundOf bound_of = BoundOf::tip;
  double step_mm = 0;   ///< between the places looked at
  double layer_mm = 0;  ///< that pockets were cut for

  int count() const;
};

struct MeshFigures {
  bool outer_unchanged = false;
  bool closed = false;
  std::size_t self_intersections = 0;
  std::size_t voids = 0;
  std::size_t triangles = 0;
};

/// What a run found and did, measured on what it wrote. A part that the run had no use for is absent.
struct Report {
  std::string version;
  Outcome outcome = Outcome::falls;
  double required_tip_rad = 0;    ///< of the first standing pose
  Standing before;                ///< of the first standing pose; without corners when every pose hangs
  std::optional<Standing> after;  ///< of the first standing pose
  std::vector<PoseReport> poses;  ///< every pose, in the order in which they were asked for
  std::optional<CarvingFigures> carving;
  std::optional<DeformationFigures> deformation;
  std::optional<BallastFigures> ballast;
  std::optional<InsertFigures> inserts;
  std::optional<WallFigures> wall;
  std::vector<HoleFigures> holes;
  std::optional<MeshFigures> mesh;
  std::optional<Judgement> judgement;  ///< of what was written
  std::vector<std::string> repair;     ///< what was wrong with the input and what was decided, a sentence each
  std::vector<std::string> hints;      ///< what looks like a mistake, or what would help, a sentence each
  StageSeconds stage_seconds;
  double peak_memory_mb = 0;
  std::vector<std::pair<std::string, std::variant<bool, double, std::string>>> options;

  /// Whether `before` says anything.
  bool has_standing_pose() const { return !before.support.corners_mm.empty(); }
};

/// Puts what was measured first (`before`), or on the final body (`after`), into the report: one measure for each of
/// its poses. The latter also gives carving->gap_rad.
void set_before(Report& report, std::vector<PoseMeasure> measures, RowKind kind);
void set_after(Report& report, std::vector<PoseMeasure> measures, RowKind kind);

/// What the tangent of the measured angle exceeds that of the one asked for by.
double surplus_t(const Pose& pose, const PoseMeasure& measure, RowKind kind);

/// Whether every pose holds.
bool all_hold(const Report& report);

}  // namespace aplomb
