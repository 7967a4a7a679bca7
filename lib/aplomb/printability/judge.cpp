#include "aplomb/printability/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "aplomb/printability/bed_contact.h"
#include "aplomb/printability/escape.h"
#include "aplomb/printability/mesh_checks.h"
#include "aplomb/printability/print_stands.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/remedies.h"
#include "aplomb/printability/slices.h"
#include "aplomb/printability/strength_ankle.h"
#include "aplomb/printability/strength_fem.h"
#include "aplomb/printability/void_base.h"
#include "aplomb/printability/void_bridge.h"
#include "aplomb/printability/void_cup.h"
#include "aplomb/printability/void_island.h"
#include "aplomb/printability/void_slope.h"
#include "aplomb/printability/walls.h"

namespace aplomb {
namespace {

using Verdict = CheckResult::Verdict;

constexpr double solid_error_ratio = 0.02;  // of the density

/// Density of what stays in a closed void, of the printed material's: liquid resin, loose powder. Our choice.
constexpr std::array<double, 4> trapped_ratios{0, 0.95, 0.45, 0.6};

std::string figure(double value) { return fmt::format("{:.4g}", value == 0 ? 0.0 : value); }

std::string with_unit(double value, const CheckRule& rule) {
  return figure(value) + (rule.unit.empty() ? "" : " ") + std::string(rule.unit);
}

/// Collects what the checks measure and says what is wrong with it.
class Collector {
 public:
  explicit Collector(const Rules& rules) : rules_(rules) { judgement_.process = rules.process(); }

  static constexpr bool sum_of_places = true;

  /// Places, worst first. No place: there was nothing to measure. The check's measure is the worst, or all together.
  void add(std::string_view id, const std::vector<Place>& places, bool is_sum = false) {
    const CheckRule& rule = rule_of(id);
    const auto limits = rules_.limits(id);
    if (!limits) return;
    CheckResult result;
    result.id = id;
    if (!places.empty()) {
      result.has_measure = true;
      result.measured = places.front().measured;
      if (is_sum)
        for (std::size_t n = 1; n < places.size(); ++n) result.measured += places[n].measured;
      result.threshold = limits->fail.value_or(limits->warn.value_or(limits->info.value_or(0)));
    }
    for (const Place& place : places)
      if (const auto severity = severity_of(place, rule, *limits)) {
        judgement_.findings.push_back(finding(place, rule, *severity, *limits));
        if (result.verdict == Verdict::passed) {
          result.verdict = verdict_of(*severity, id);
          result.threshold = judgement_.findings.back().threshold;
        }
      }
    judgement_.checks.push_back(std::move(result));
  }

  void leave_out(std::string_view id, std::string why) {
    if (!rules_.limits(id)) return;
    judgement_.checks.push_back({std::string(id), Verdict::not_judged, false, 0, 0, std::move(why)});
  }

  void show(StressField stress) { judgement_.stress = std::move(stress); }

  /// In the order of check_rules().
  Judgement judgement() {
    const auto rank = [](const auto& item) {
      return std::ranges::find(check_rules(), std::string_view(item.id), &CheckRule::id) - check_rules().begin();
    };
    std::ranges::stable_sort(judgement_.checks, {}, rank);
    std::ranges::stable_sort(judgement_.findings, {}, rank);
    return std::move(judgement_);
  }

 private:
  static const CheckRule& rule_of(std::string_view id) {
    const auto found = std::ranges::find(check_rules(), id, &CheckRule::id);
    assert(found != check_rules().end());
    return *found;
  }

  static std::optional<Severity> severity_of(const Place& place, const CheckRule& rule, const Limits& limits) {
    const auto is_wrong = [&](const std::optional<double>& limit) {
      return limit && (rule.is_least ? place.measured < *limit : place.measured > *limit);
    };
    if (is_wrong(limits.fail)) return Severity::fail;
    if (is_wrong(limits.warn)) return Severity::warn;
    if (is_wrong(limits.info)) return Severity::info;
    return std::nullopt;
  }

  Verdict verdict_of(Severity severity, std::string_view id) const {
    if (rules_.is_waived(id)) return Verdict::waived;
    return severity == Severity::fail ? Verdict::failed : severity == Severity::warn ? Verdict::warned : Verdict::info;
  }

  static Finding finding(const Place& place, const CheckRule& rule, Severity severity, const Limits& limits) {
    const double threshold = *(severity == Severity::fail   ? limits.fail
                               : severity == Severity::warn ? limits.warn
                                                            : limits.info);
    return {std::string(rule.id),
            severity,
            place.measured,
            threshold,
            place.at_mm,
            place.box_mm,
            fmt::format("{}: {}; {} {}", rule.what, with_unit(place.measured, rule),
                        rule.is_least ? "at least" : "at most", with_unit(threshold, rule)),
            std::string(remedy_of(rule.id))};
  }

  const Rules& rules_;
  Judgement judgement_;
};

/// The angles asked for are those of the pose, unless the rules were changed.
Rules with_angles_of(Rules rules, const StandingPose& pose) {
  const double asked_deg = pose.required_tip_rad * 180 / std::numbers::pi;
  rules.adopt("stand.nominal", {{}, {}, asked_deg});
  rules.adopt("stand.robust", {{}, asked_deg, asked_deg / 2});
  if (rules.limits("stand.trapped")) rules.adopt("stand.trapped", {{}, {}, asked_deg});
  return rules;
}

bool holds(const Box3& box, Vec3 point) {
  for (int axis = 0; axis < 3; ++axis)
    if (point[axis] < box.min[axis] || point[axis] > box.max[axis]) return false;
  return true;
}

/// Judges what is a solid.
class SolidJudge {
 public:
  SolidJudge(const SolidMesh& solid, const JudgeOptions& options, Collector& collector)
      : printed_(printed_solid(solid)), options_(options), collector_(collector) {}

  Result<void> run(const Job& job) {
    if (!job.report(0, "judge")) return cancelled();
    collector_.add("mass.gained", mass_gained_percent(printed_, options_.filling));
    return stand()
        .and_then([&] { return walls(job.part(0, 0.4)); })
        .and_then([&] { return escape(job.part(0.4, 0.7)); })
        .and_then([&] { return layers(job.part(0.7, 1)); });
  }

 private:
  const Rules& rules() const { return options_.rules; }

  Result<void> add(std::string_view id, const Result<std::vector<Place>>& places) {
    if (!places) return tl::unexpected(places.error());
    collector_.add(id, *places);
    return {};
  }

  Result<void> walls(const Job& job) {
    return add("wall.void_outer", wall_void_outer(printed_, rules(), job.part(0, 0.3)))
        .and_then([&] { return add("wall.void_void", wall_void_void(printed_, rules(), job.part(0.3, 0.5))); })
        .and_then([&] { return add("wall.thin", wall_thin(printed_, rules(), job.part(0.5, 1))); });
  }

  Result<void> escape(const Job& job) {
    const auto cavities = find_cavities(printed_, rules(), job);
    if (!cavities) return tl::unexpected(cavities.error());
    collector_.add("void.closed", without_inserts(void_closed(*cavities, rules())), Collector::sum_of_places);
    collector_.add("void.holes", void_holes(*cavities, rules()));
    collector_.add("void.hole_place", void_hole_place(*cavities, rules()));
    return {};
  }

  /// What is in a pocket is to stay there: of the places round an insert, the smallest is its pocket.
  std::vector<Place> without_inserts(std::vector<Place> places) const {
    const auto size = [](const Place& place) {
      const Vec3 s = place.box_mm.size();
      return s.x * s.y * s.z;
    };
    for (const Region& insert : options_.inserts) {
      auto pocket = places.end();
      for (auto place = places.begin(); place != places.end(); ++place)
        if (holds(place->box_mm, insert.moments.centroid_mm()) &&
            (pocket == places.end() || size(*place) < size(*pocket)))
          pocket = place;
      if (pocket != places.end()) places.erase(pocket);
    }
    return places;
  }

  Result<void> layers(const Job& job) {
    const double fem_share = options_.fem ? 0.6 : 0;  // of the time
    const auto slices = cut_slices(printed_, rules().layer_mm, job.part(0, 0.2 * (1 - fem_share)));
    if (!slices) return tl::unexpected(slices.error());
    return sections(*slices, job.part(0, 1 - fem_share)).and_then([&] {
      return fem(*slices, job.part(1 - fem_share, 1));
    });
  }

  Result<void> sections(const Slices& slices, const Job& job) {
    using Measure = Result<std::vector<Place>> (*)(const PrintedSolid&, const Slices&, const Rules&, const Job&);
    constexpr std::array<std::pair<std::string_view, Measure>, 6> measures{{{"void.bridge", measure_void_bridge},
                                                                            {"void.slope", measure_void_slope},
                                                                            {"void.island", measure_void_island},
                                                                            {"void.cup", measure_void_cup},
                                                                            {"void.base", measure_void_base},
                                                                            {"print.stands", measure_print_stands}}};
    for (std::size_t n = 0; n < measures.size(); ++n) {
      const auto& [id, measure] = measures[n];
      const double done = 0.2 + 0.1 * static_cast<double>(n);
      if (const auto added = add(id, measure(printed_, slices, rules(), job.part(done, done + 0.1))); !added)
        return tl::unexpected(added.error());
    }
    collector_.add("bed.contact", measure_bed_contact(slices, rules()));
    return add("strength.ankle",
               measure_strength_ankle(printed_, slices, rules(), options_.density_g_per_cm3, job.part(0.8, 1)));
  }

  /// What elasticity cannot do is no reason to say nothing else.
  Result<void> fem(const Slices& slices, const Job& job) {
    constexpr std::string_view id = "strength.fem";
    if (!options_.fem) return {};
    auto strength =
        measure_strength_fem(printed_, slices, rules(), {.density_g_per_cm3 = options_.density_g_per_cm3}, job);
    if (!strength && strength.error().code == ErrorCode::cancelled) return tl::unexpected(strength.error());
    if (!strength) collector_.leave_out(id, strength.error().message);
    else if (!strength->why_not.empty()) collector_.leave_out(id, strength->why_not);
    else collector_.add(id, strength->places);
    if (strength && strength->field) collector_.show(std::move(*strength->field));
    return {};
  }

  Result<void> stand() {
    constexpr std::array ids{"stand.nominal", "stand.robust", "stand.trapped"};
    if (!options_.pose) {
      for (const char* id : ids) collector_.leave_out(id, "it is not meant to stand");
      return {};
    }
    const double trapped_ratio = trapped_ratios[static_cast<std::size_t>(options_.rules.process())];
    const double density_g_per_cm3 = options_.density_g_per_cm3;
    std::vector<Region> body = options_.body;
    if (body.empty()) body.push_back({printed_.solid.moments(), density_g_per_cm3, solid_error_ratio});
    body.insert(body.end(), options_.inserts.begin(), options_.inserts.end());
    const auto measured = measure_stand(printed_, *options_.pose, std::move(body), trapped_ratio * density_g_per_cm3);
    if (!measured) return tl::unexpected(measured.error());
    collector_.add(ids[0], measured->nominal);
    collector_.add(ids[1], measured->robust);
    collector_.add(ids[2], measured->trapped);
    return {};
  }

  PrintedSolid printed_;
  const JudgeOptions& options_;
  Collector& collector_;
};

}  // namespace

Result<Judgement> judge(const TriangleMesh& mesh, const JudgeOptions& options, const TriangleMesh* meant,
                        const Job& job) {
  assert(find_problem(options).empty());
  const Rules rules = options.pose ? with_angles_of(options.rules, *options.pose) : options.rules;
  Collector collector(rules);
  const auto measured = measure_mesh(mesh, job.part(0, 0.2));
  if (!measured) return tl::unexpected(measured.error());
  collector.add("mesh.manifold", measured->manifold);
  if (measured->manifold.front().measured == 0) collector.add("mesh.orientation", measured->orientation);
  else collector.leave_out("mesh.orientation", "it is not closed");
  collector.add("mesh.intersection", measured->intersection);
  collector.add("mesh.degenerate", measured->degenerate);
  if (!job.report(0.2, "judge")) return cancelled();
  if (meant) collector.add("mesh.roundtrip", {{roundtrip_error_ratio(*meant, mesh), {}, {}}});
  if (!measured->solid) {
    for (const CheckRule& rule : check_rules())
      if (rule.is_check && !rule.id.starts_with("mesh.") && (options.fem || rule.id != "strength.fem"))
        collector.leave_out(rule.id, "the mesh is no solid");
    return collector.judgement();
  }
  if (const auto judged = SolidJudge(*measured->solid, options, collector).run(job.part(0.2, 1)); !judged)
    return tl::unexpected(judged.error());
  return collector.judgement();
}

}  // namespace aplomb
