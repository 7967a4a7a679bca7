#include "aplomb/report/text.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <numbers>
#include <sstream>
#include <string_view>

#include "aplomb/report/detail/lines.h"
#include "aplomb/report/judgement.h"

namespace aplomb {
namespace {

using detail::degrees;
using detail::figure;
using detail::line;
using detail::number;
using detail::point;

std::string weakest(const Stability& s) { return "weakest towards " + direction_word(s.heading); }

std::string variants_text(const Standing& standing) {
  std::string text;
  for (const ContactVariant& v : standing.variants)
    text += (text.empty() ? "" : ", ") + degrees(v.tip_rad) + " with " + figure(v.contact_height_mm) + " mm";
  const auto [least, most] =
      std::minmax_element(standing.variants.begin(), standing.variants.end(),
                          [](const ContactVariant& a, const ContactVariant& b) { return a.tip_rad < b.tip_rad; });
  const double fragile_rad = 2 * std::numbers::pi / 180;
  return text +
         (most->tip_rad - least->tip_rad > fragile_rad ? " touching: fragile, it rests on a sliver" : " touching");
}

std::string figures(const Standing& standing) {
  const Stability& s = standing.stability;
  std::string text =
      line("mass", figure(s.mass_g) + " g, " + figure(s.volume_mm3 * 1e-3) + " cm3") +
      line("centre of mass", point(s.com_mm) + ", " + number(s.com_height_mm, 1) + " mm above the plate") +
      line("support polygon", figure(standing.support.area_mm2()) + " mm2, " + figure(standing.support.width_mm()) +
                                  " mm at its narrowest, " + std::to_string(standing.support.corners_mm.size()) +
                                  " corners") +
      line("margin", number(s.margin_mm, 2) + " mm, " + weakest(s) + ", over the edge " + point(s.weak_edge_mm[0]) +
                         " to " + point(s.weak_edge_mm[1])) +
      line("tip angle",
           degrees(s.tip_rad) + " degrees; " + degrees(s.robust_tip_rad) + " at the worst of the tolerances") +
      line("", variants_text(standing));
  if (s.tip_rad > 0)
    text += line("to topple it", figure(s.topple_energy_j * 1e3) + " mJ, or " + figure(s.topple_push_n) +
                                     " N sideways " + number(s.push_height_mm, 1) + " mm up");
  if (standing.pedestal)
    text += line("pedestal", "a disc of " + number(2 * standing.pedestal->radius_mm, 1) + " mm across, " +
                                 number(standing.pedestal->thickness_mm, 1) + " mm thick, around " +
                                 point(standing.pedestal->center_mm) + " would do");
  return text;
}

std::string figures(const Hanging& hanging) {
  std::string text =
      line("mass", figure(hanging.mass_g) + " g, " + figure(hanging.volume_mm3 * 1e-3) + " cm3") +
      line("centre of mass", point(hanging.com_mm) + ", " + number(std::abs(hanging.drop_mm), 1) +
                                 (hanging.drop_mm >= 0 ? " mm below" : " mm above") + " where it hangs") +
      line("tilt", degrees(hanging.tilt_rad) + " degrees from level");
  if (!hanging.pulls_all_threads) text += line("", "one thread is slack: the centre of mass is not between the points");
  return text;
}

std::string figures(const PoseMeasure& measure) {
  return std::visit([](const auto& m) { return figures(m); }, measure);
}

/// Of what could be done at best, by carving or by infill.
std::string bound(const std::string& nothing, BoundOf bound_of, double bound_rad) {
  switch (bound_of) {
    case BoundOf::tip:
      return nothing + " gives more than " + degrees(bound_rad) + " degrees";
    case BoundOf::tilt:
      return nothing + " comes nearer to level than " + degrees(bound_rad) + " degrees";
    case BoundOf::surplus:
      break;
  }
  if (bound_rad < 0) return nothing + " meets every pose";
  return nothing + " exceeds every pose by more than " + degrees(bound_rad) + " degrees";
}

/// The trims that people ask for: 0.5, 1 and 2 mm.
std::string gains(const DeformationFigures& d) {
  std::string text;
  for (const auto& [trim_mm, tip_rad] : d.trims)
    if (trim_mm == 0 || trim_mm == 0.5 || trim_mm == 1 || trim_mm == 2)
      text += (text.empty() ? "carved it would reach " : ", ") + degrees(tip_rad) + " degrees with " + figure(trim_mm) +
              " mm off the base";
  return text;
}

std::string bending(const DeformationFigures& d) {
  std::string text;
  if (d.trim_mm > 0) text += line("base", figure(d.trim_mm) + " mm cut off");
  if (!d.trims.empty()) text += line("", gains(d));
  if (d.outcome == "trimmed") return text;
  const std::string end = d.outcome == "limit"   ? ": all that the limit allows"
                          : d.outcome == "stuck" ? ": no better shape was found"
                                                 : "";
  if (d.handle_short_mm > 0.1)
    text += line("handles", figure(d.handle_short_mm) + " mm short of where they were to go");
  return text + line("bent", figure(d.mean_mm) + " mm on average, " + figure(d.max_mm) +
                                 " mm at most, turned by up to " + degrees(d.max_turn_rad) + " degrees" + end);
}

std::string count(std::size_t number, const std::string& what) {
  return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

std::string shaping(const CeilingFigures& c) {
  if (c.rounds == 0) return c.left == 0 ? "" : line("ceilings", "not all print, and nothing was found that helps");
  std::string text = count(c.ribs, "rib") + ", " + count(c.pillars, "pillar") + ", " + count(c.fills, "fill");
  text += " in the voids, so that they print; they cost " + degrees(c.cost_rad) + " degrees of what could be reached";
  return line("ceilings", text);
}

std::string filling(const BallastFigures& b) {
  return line("infill", figure(100 * b.high_ratio) + " % on one side of a plane, " + figure(100 * b.low_ratio) +
                            " % on the other: " + figure(b.added_g) + " g more; " +
                            bound("no such infill", b.bound_of, b.bound_rad) + " (" + count(b.planes, "plane") + ")");
}

std::string work(const Report& report) {
  std::string text;
  if (report.inserts) text += detail::lines_of(*report.inserts);
  if (report.deformation) text += bending(*report.deformation);
  if (report.ballast) text += filling(*report.ballast);
  if (report.carving)
    text += line("void", figure(report.carving->void_mm3 * 1e-3) + " cm3; " +
                             bound("no void", report.carving->bound_of, report.carving->bound_rad) + " (aim " +
                             report.carving->aim + ", " + std::to_string(report.carving->planes) + " planes)");
  if (report.carving && report.carving->ceiling) text += shaping(*report.carving->ceiling);
  if (report.wall)
    text += line("wall", number(report.wall->measured_mm, 3) + " mm measured, " + number(report.wall->required_mm, 3) +
                             " asked");
  for (const HoleFigures& hole : report.holes)
    text += line(&hole == &report.holes.front() ? "escape holes" : "", number(hole.diameter_mm, 2) + " mm across, " +
                                                                           number(hole.depth_mm, 1) + " mm deep, at " +
                                                                           point(hole.mouth_mm));
  if (report.mesh)
    text +=
        line("mesh", std::to_string(report.mesh->triangles) + " triangles, " + std::to_string(report.mesh->voids) +
                         (report.mesh->voids == 1 ? " void, " : " voids, ") +
                         (report.mesh->closed && report.mesh->self_intersections == 0 ? "closed, no self-intersection"
                                                                                      : "not sound") +
                         (report.mesh->outer_unchanged ? ", outside unchanged" : ""));
  return text;
}

std::string asked(const Pose& pose) {
  if (const HangingPose* hanging = pose.hanging())
    return "hangs, to " + degrees(hanging->required_tilt_rad) + " degrees asked";
  return "stands, " + degrees(pose.standing()->required_tip_rad) + " degrees asked";
}

std::string name_of(const Report& report, std::size_t i) {
  const std::string& name = report.poses[i].pose.name;
  return name.empty() ? "pose " + std::to_string(i + 1) : name;
}

std::string angle(const PoseMeasure& measure) {
  if (const auto* hanging = std::get_if<Hanging>(&measure)) return degrees(hanging->tilt_rad);
  return degrees(std::get<Standing>(measure).stability.tip_rad);
}

std::string hanging_verdict(const Report& report) {
  const PoseReport& entry = report.poses.front();
  const std::string before = angle(entry.before) + " degrees",
                    asked_for = degrees(entry.pose.hanging()->required_tilt_rad) + " asked";
  switch (report.outcome) {
    case Outcome::already_stands:
      return "Hangs level: tilted by " + before + " (" + asked_for + ")";
    case Outcome::stands:
      return "Hangs level now: tilted by " + angle(*entry.after) + " degrees (" + asked_for + ", " + before +
             " before)";
    case Outcome::best_effort:
      return "Cannot hang level: tilted by " + angle(*entry.after) + " degrees at best (" + asked_for + ", " + before +
             " before)";
    case Outcome::falls:
      break;
  }
  return "Hangs tilted by " + before + " (" + asked_for + ")";
}

std::string joint_verdict(const Report& report) {
  std::string list;
  for (std::size_t i = 0; i < report.poses.size(); ++i) {
    const PoseReport& entry = report.poses[i];
    list += (i == 0 ? "" : ", ") + name_of(report, i) + " " + angle(entry.after ? *entry.after : entry.before);
    if (!entry.holds) list += entry.pose.hanging() ? " (too tilted)" : " (too little)";
  }
  const std::string all = "all " + std::to_string(report.poses.size()) + " poses";
  switch (report.outcome) {
    case Outcome::already_stands:
      return "Holds " + all + ": " + list + " degrees";
    case Outcome::stands:
      return "Holds " + all + " now: " + list + " degrees";
    case Outcome::best_effort:
      return "Cannot hold " + all + ": " + list + " degrees at best";
    case Outcome::falls:
      break;
  }
  return "Does not hold " + all + ": " + list + " degrees";
}

/// Of several poses, or of one that hangs: each as it was and as it is.
std::string pose_figures(const Report& report) {
  std::string text;
  for (std::size_t i = 0; i < report.poses.size(); ++i) {
    const PoseReport& entry = report.poses[i];
    const std::string head = name_of(report, i) + " (" + asked(entry.pose) + ")";
    text += head + (entry.after ? ", before\n" : "\n") + figures(entry.before);
    if (entry.after) text += head + ", after\n" + figures(*entry.after);
  }
  return text;
}

/// One pose, standing: most runs, and they keep their short form.
bool is_plain(const Report& report) {
  return report.poses.empty() || (report.poses.size() == 1 && report.poses.front().pose.standing());
}

/// An angle below the one asked for, in as many digits as tell them apart.
std::string short_of(double angle_rad, double asked_rad) {
  const std::string angle = degrees(angle_rad);
  if (angle != degrees(asked_rad)) return angle + " degrees";
  return number(angle_rad * 180 / std::numbers::pi, 3) + " degrees";
}

}  // namespace

std::string direction_word(Vec3 direction) {
  std::string word;
  const double threshold = std::sin(std::numbers::pi / 8) * norm(direction);  // half-way to the diagonal
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(direction[axis]) > threshold) word += {direction[axis] < 0 ? '-' : '+', "xyz"[axis]};
  return word.empty() ? "no side" : word;
}

std::string verdict(const Report& report) {
  if (report.poses.size() > 1) return joint_verdict(report);
  if (!is_plain(report)) return hanging_verdict(report);
  const Stability& now = (report.after ? *report.after : report.before).stability;
  const std::string angle = degrees(now.tip_rad) + " degrees", asked = degrees(report.required_tip_rad);
  switch (report.outcome) {
    case Outcome::already_stands:
      return "Stands: " + angle + " (" + weakest(now) + "; " + asked + " asked)";
    case Outcome::stands:
      return "Stands now: " + angle + " (" + weakest(now) + "; " + asked + " asked, " +
             degrees(report.before.stability.tip_rad) + " before)";
    case Outcome::best_effort:
      return "Cannot reach " + asked + " degrees: " + short_of(now.tip_rad, report.required_tip_rad) + " at best (" +
             weakest(now) + "; " + degrees(report.before.stability.tip_rad) + " before)";
    case Outcome::falls:
      break;
  }
  if (!now.can_stand) return "Cannot stand: it touches the plate in fewer than three points that are not in line";
  if (now.tip_rad > 0) return "Stands, but barely: " + angle + " (" + weakest(now) + "; " + asked + " asked)";
  return "Falls: tips over to the " + direction_word(now.heading) + " side, " + angle + " (" + asked + " asked)";
}

std::string to_text(const Report& report) {
  std::string text = verdict(report) + "\n";
  if (!is_plain(report)) text += pose_figures(report) + work(report);
  else if (report.after)
    text += "before\n" + figures(report.before) + "after\n" + figures(*report.after) + work(report);
  else text += figures(report.before) + work(report);
  if (report.judgement) text += to_text(*report.judgement);
  for (const std::string& sentence : report.repair) text += line("repair", sentence);
  for (const std::string& sentence : report.hints) text += "hint: " + sentence + "\n";
  return text;
}

std::string to_text(const RestingHint& hint) {
  if (!hint.up)
    return "it seems to lie flat: as it is, it falls by " + degrees(-hint.given_tip_rad) +
           " degrees; if another way is up, say so with --up";
  std::string axis = direction_word(*hint.up);
  if (axis.front() == '+') axis.erase(0, 1);
  return "it seems to lie: with --up " + axis + " it would stand by itself (" + degrees(hint.suggested_tip_rad) +
         " degrees instead of " + degrees(hint.given_tip_rad) + ")";
}

}  // namespace aplomb
