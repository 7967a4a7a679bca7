#include "aplomb/report/report.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace aplomb {
namespace {

const Standing* first_standing(const std::vector<PoseMeasure>& measures) {
  for (const PoseMeasure& measure : measures)
    if (const auto* standing = std::get_if<Standing>(&measure)) return standing;
  return nullptr;
}

double gap_rad(const Report& report, RowKind kind) {
  const PoseReport& first = report.poses.front();
  switch (report.carving->bound_of) {
    case BoundOf::tip: {
      const Stability& s = std::get<Standing>(*first.after).stability;
      return report.carving->bound_rad - (kind == RowKind::robust ? s.robust_tip_rad : s.tip_rad);
    }
    case BoundOf::tilt:
      return std::get<Hanging>(*first.after).tilt_rad - report.carving->bound_rad;
    case BoundOf::surplus:
      break;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const PoseReport& entry : report.poses) least = std::min(least, surplus_t(entry.pose, *entry.after, kind));
  return report.carving->bound_rad - std::atan(least);
}

}  // namespace

double surplus_t(const Pose& pose, const PoseMeasure& measure, RowKind kind) {
  if (const HangingPose* hanging = pose.hanging())
    return std::tan(hanging->required_tilt_rad) - std::tan(std::get<Hanging>(measure).tilt_rad);
  const Stability& s = std::get<Standing>(measure).stability;
  return std::tan(kind == RowKind::robust ? s.robust_tip_rad : s.tip_rad) - std::tan(pose.standing()->required_tip_rad);
}

int InsertFigures::count() const {
  int sum = 0;
  for (const PocketFigures& pocket : pockets) sum += pocket.count;
  return sum;
}

void set_before(Report& report, std::vector<PoseMeasure> measures, RowKind kind) {
  assert(measures.size() == report.poses.size());
  if (const Standing* standing = first_standing(measures)) report.before = *standing;
  for (const PoseReport& entry : report.poses)
    if (const StandingPose* pose = entry.pose.standing()) {
      report.required_tip_rad = pose->required_tip_rad;
      break;
    }
  for (std::size_t i = 0; i < measures.size(); ++i) {
    PoseReport& entry = report.poses[i];
    entry.holds = holds(entry.pose, measures[i], kind);
    entry.before = std::move(measures[i]);
  }
}

void set_after(Report& report, std::vector<PoseMeasure> measures, RowKind kind) {
  assert(measures.size() == report.poses.size());
  if (const Standing* standing = first_standing(measures)) report.after = *standing;
  for (std::size_t i = 0; i < measures.size(); ++i) {
    PoseReport& entry = report.poses[i];
    entry.holds = holds(entry.pose, measures[i], kind);
    entry.after = std::move(measures[i]);
  }
  if (report.carving) report.carving->gap_rad = gap_rad(report, kind);
}

bool all_hold(const Report& report) {
  return std::all_of(report.poses.begin(), report.poses.end(), [](const PoseReport& entry) { return entry.holds; });
}

}  // namespace aplomb
