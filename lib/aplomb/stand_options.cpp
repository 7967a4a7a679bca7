#include "aplomb/stand_options.h"

#include <fmt/format.h>

#include <algorithm>

namespace aplomb {
namespace {

std::string find_ballast_problem(const StandOptions& o) {
  const double high = o.ballast_high_ratio;
  if (!(high > least_ballast_ratio && high <= 1))
    return fmt::format("ballast_high_ratio is {}; it must lie in ({}, 1]", high, least_ballast_ratio);
  if (const auto low = o.ballast_low_ratio; low && !(*low >= least_ballast_ratio && *low < high))
    return fmt::format("ballast_low_ratio is {}; it must lie in [{}, {})", *low, least_ballast_ratio, high);
  if (o.ballast != Ballasting::only) return {};
  if (o.deform == Deform::only || !o.reshape.regions.handles.empty())
    return "ballast leaves the outside as it is, but deform asks for another";
  if (!o.inserts.empty()) return "ballast is infill alone; leave it or the inserts out";
  if (!o.profile) return {};
  const double low = o.ballast_low_ratio.value_or(o.profile->infill_ratio);
  if (!(low >= least_ballast_ratio && low < high))
    return fmt::format(
        "the profile's infill is {:.4g} %; ballast needs at least {:.4g} % to be printed on, and less than the {:.4g} "
        "% "
        "of its own",
        100 * low, 100 * least_ballast_ratio, 100 * high);
  return {};
}

}  // namespace

namespace {

std::string find_insert_problem(const StandOptions& o) {
  if (o.inserts.empty()) return {};
  for (const InsertStock& stock : o.inserts)
    if (std::string problem = find_problem(stock); !problem.empty()) return problem;
  return {};
}

}  // namespace

std::string find_problem(const StandOptions& o) {
  if (std::string problem = find_problem(o.poses); !problem.empty()) return problem;
  if (!(o.density_g_per_cm3 > 0 && o.density_g_per_cm3 < 30))
    return fmt::format("density_g_per_cm3 is {}; it must lie in (0, 30)", o.density_g_per_cm3);
  if (!(o.wall_mm > 0 && o.wall_mm <= 1e4)) return fmt::format("wall_mm is {}; it must lie in (0, 10000]", o.wall_mm);
  if (o.voxel_mm)
    if (std::string problem = find_problem(VolumeOptions{o.wall_mm, *o.voxel_mm, o.least_void_mm, o.memory_bytes});
        !problem.empty())
      return problem;
  if (std::string problem = find_problem(o.reshape); !problem.empty()) return problem;
  if (o.deform == Deform::never && !o.reshape.regions.handles.empty())
    return "deform is never, but a handle moves the outside; it must be auto or only";
  if (std::string problem = find_ballast_problem(o); !problem.empty()) return problem;
  if (std::string problem = find_problem(o.judge); !problem.empty()) return problem;
  if (std::string problem = find_insert_problem(o); !problem.empty()) return problem;
  return find_problem(CarveOptions{o.aim, 0, o.least_volume_mm3});
}

double voxel_mm(const StandOptions& options, const Box3& box) {
  return options.voxel_mm.value_or(std::min(options.wall_mm / 4, box.diagonal() / 256));
}

double printed_density(const StandOptions& options) {
  const bool is_told = options.profile && options.profile->density_g_per_cm3 > 0;
  return is_told ? options.profile->density_g_per_cm3 : options.density_g_per_cm3;
}

bool shapes_ceilings(const StandOptions& options) {
  const bool by_default = options.judge.rules.process() == Process::fdm;
  return options.ceiling ? *options.ceiling == Ceiling::automatic : by_default;
}

RowKind kind_of(const StandOptions& options) { return options.robust ? RowKind::robust : RowKind::nominal; }

}  // namespace aplomb
