#pragma once

// Private to job_file.cpp: the one table of what a job says, for its reader and its writer.

#include <array>

#include "aplomb/job/job_file.h"

namespace aplomb::detail {

inline constexpr std::array<const char*, 3> aim_names{"least", "light", "stable"};        // in CarveAim's order
inline constexpr std::array<const char*, 2> ceiling_names{"auto", "any"};                 // in Ceiling's order
inline constexpr std::array<const char*, 2> holes_names{"auto", "none"};                  // in Holes' order
inline constexpr std::array<const char*, 3> deform_names{"never", "auto", "only"};        // in Deform's order
inline constexpr auto ballast_names = deform_names;                                       // in Ballasting's order
inline constexpr std::array<const char*, 3> flavor_names{"prusaslicer", "orca", "cura"};  // in Flavor's order

template <class Visitor, class Radius>
void visit_ball(const Visitor& v, Vec3& center_mm, Radius& radius_mm) {
  v.point("at_mm", center_mm);
  v.value("radius_mm", radius_mm);
}

template <class Visitor>
void visit_regions(const Visitor& v, Regions& regions) {
  const auto visit_region = [](const Visitor& b, BallRegion& at) { visit_ball(b, at.center_mm, at.radius_mm); };
  v.list("stiffness", regions.stiffened, [&](const Visitor& s, StiffRegion& stiff) {
    visit_region(s, stiff.at);
    s.value("ratio", stiff.ratio);
  });
  v.list("keep", regions.kept, visit_region);
  v.list("handles", regions.handles, [&](const Visitor& h, Handle& handle) {
    visit_region(h, handle.at);
    h.point("to_mm", handle.to_mm);
    h.turns("turn_deg", handle.turns);
    h.value("scale", handle.scale_ratio);
  });
  v.list("lock", regions.locked, visit_region);
}

template <class Visitor>
void visit_pose(const Visitor& v, JobPose& job) {
  v.value("name", job.pose.name);
  if (auto* standing = std::get_if<StandingPose>(&job.pose.way))
    v.group("stand", [&](const Visitor& s) {
      s.direction("up", standing->up);
      s.angle("tip_deg", standing->required_tip_rad);
      s.value("contact_height_mm", standing->contact_height_mm);
      s.value("xy_error_mm", standing->xy_error_mm);
      s.list("contacts", job.contacts,
             [](const Visitor& c, JobContact& contact) { visit_ball(c, contact.center_mm, contact.radius_mm); });
    });
  else if (auto* hanging = std::get_if<HangingPose>(&job.pose.way))
    v.group("hang", [&](const Visitor& h) {
      h.direction("up", hanging->up);
      h.points("from_mm", hanging->attachments_mm);
      h.angle("tilt_deg", hanging->required_tilt_rad);
      h.value("least_drop_mm", hanging->least_drop_mm);
    });
}

/// The one table of what a job says.
template <class Visitor>
void visit_job(const Visitor& v, JobFile& job) {
  v.path("model", job.model);
  v.path("output", job.output);
  v.path("report", job.report);
  v.path("dump", job.dump);
  v.path("html", job.html);
  v.path("picture", job.picture);
  v.path("plugs", job.plugs);
  v.path("modifier", job.modifier);
  v.path("profile", job.profile);
  v.name("flavor", flavor_names, job.flavor);
  v.group("place", [&](const Visitor& place) {
    place.value("object", job.input.object);
    place.up("up", job.input.placement.up);
    place.turns("rotate_deg", job.input.placement.turns);
    place.value("unit_mm", job.input.placement.unit_mm);
    place.value("scale", job.input.placement.scale);
    place.value("height_mm", job.input.placement.height_mm);
  });
  v.value("repair_force", job.input.repair.insist);
  v.poses("poses", job.poses, [](const Visitor& p, JobPose& pose) { visit_pose(p, pose); });
  v.value("robust", job.options.robust);
  v.name("aim", aim_names, job.options.aim);
  v.name("deform", deform_names, job.options.deform);
  v.value("deform_limit_percent", job.options.reshape.most_mean_percent);
  v.value("trim_base_mm", job.options.reshape.most_trim_mm);
  visit_regions(v, job.options.reshape.regions);
  v.value("inserts", job.inserts);
  v.name("holes", holes_names, job.options.holes);
  v.name("ballast", ballast_names, job.options.ballast);
  v.percent("ballast_low_percent", job.options.ballast_low_ratio);
  v.percent("ballast_high_percent", job.options.ballast_high_ratio);
  v.name("process", process_names, job.rules.process);
  v.preset("process", job.options.wall_mm, wall_of_process);
  v.value("wall_mm", job.options.wall_mm);
  v.name("ceiling", ceiling_names, job.options.ceiling);
  v.value("voxel_mm", job.options.voxel_mm);
  v.value("least_void_mm", job.options.least_void_mm);
  v.value("least_volume_mm3", job.options.least_volume_mm3);
  v.value("best_effort", job.options.best_effort);
  v.preset("material", job.options.density_g_per_cm3, density_of_material);
  v.value("density_g_per_cm3", job.options.density_g_per_cm3);
  v.memory("memory_mb", job.options.memory_bytes);
  v.value("max_triangles", job.input.read.max_triangles);
  v.value("time_s", job.time_s);
  v.value("threads", job.threads);
  v.value("layer_mm", job.rules.layer_mm);
  v.value("infill_percent", job.infill_percent);
  v.value("fem", job.fem);
  v.list("limits", job.rules.limits, [](const Visitor& l, RuleLimit& limit) {
    l.value("check", limit.id);
    l.value("limit", limit.value);
  });
  v.value("waive", job.rules.waived);
}

}  // namespace aplomb::detail
