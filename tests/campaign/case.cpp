#include "campaign/case.h"

#include <fmt/format.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace aplomb::campaign {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Thousandths of the way between two numbers, so that what rapidcheck draws is whole.
double between(double low, double high) { return low + (high - low) * *rc::gen::inRange(0, 1001) / 1000; }

bool one_in(int count) { return *rc::gen::inRange(0, count) == 0; }

Vec3 direction() {
  const double z = between(-1, 1), turn = between(0, 2 * std::numbers::pi), across = std::sqrt(1 - z * z);
  return {across * std::cos(turn), across * std::sin(turn), z};
}

Limb limb() {
  Limb made;
  made.step_mm = between(2, 14) * direction();
  made.step_mm.z = std::abs(made.step_mm.z) + 1;  // it grows upwards, and so leans
  made.radius_mm = between(3, 9);
  if (one_in(3)) {
    made.half_mm = {between(2, 9), between(2, 9), between(2, 9)};
    if (!one_in(3)) made.turn_axis = direction();
    made.turn_rad = between(0, 3);
  }
  return made;
}

Figure figure() {
  Figure made;
  const int limbs = *rc::gen::inRange(1, 6);
  for (int n = 0; n < limbs; ++n) made.limbs.push_back(limb());
  made.is_crossing = one_in(10);
  if (one_in(2)) made.noise_mm = between(0.1, 1.5);
  made.noise_length_mm = between(5, 25);
  made.foot_mm = one_in(5) ? 0 : between(0.1, 0.8) * made.limbs.front().radius_mm;
  made.cell_mm = norm(box_of(made).size()) / between(11, 18);
  return made;
}

PoseChoice pose() {
  PoseChoice made;
  made.hangs = one_in(5);
  constexpr std::array<Vec3, 6> axes{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}}};
  if (one_in(5)) made.up = axes[static_cast<std::size_t>(*rc::gen::inRange(0, 6))];
  else if (one_in(6)) made.up = normalized(direction());
  made.is_relative = !one_in(3);
  made.angle_rad = between(0.1, made.is_relative ? 2 : 40) * degree;
  made.contact_height_mm = one_in(2) ? 0.1 : between(0.05, 2);
  const int threads = one_in(3) ? 2 : 1;
  for (int n = 0; n < threads; ++n) made.vertices.push_back(between(0, 0.999));
  return made;
}

StandOptions options(bool hangs, double diagonal_mm) {
  StandOptions made;
  made.robust = !hangs && one_in(5);
  made.aim = static_cast<CarveAim>(*rc::gen::inRange(0, 3));
  made.deform = one_in(20) ? Deform::automatic : Deform::never;
  if (one_in(40)) made.deform = Deform::only;
  made.voxel_mm = diagonal_mm / between(28, 42);
  made.wall_mm = *made.voxel_mm * between(2, 3);
  made.least_void_mm = one_in(3) ? 0 : between(0, 3);
  made.least_volume_mm3 = one_in(3) ? 0 : between(0, 60);
  made.holes = one_in(2) ? Holes::none : Holes::automatic;
  if (one_in(3)) made.ceiling = one_in(2) ? Ceiling::any : Ceiling::automatic;
  made.best_effort = true;
  made.judge.rules = Rules(one_in(3) ? Process::fdm : static_cast<Process>(*rc::gen::inRange(0, 4)));
  return made;
}

Case any_case() {
  Case made;
  made.figure = figure();
  const int poses = one_in(4) ? *rc::gen::inRange(2, 4) : 1;
  for (int n = 0; n < poses; ++n) made.poses.push_back(pose());
  const bool hangs = std::any_of(made.poses.begin(), made.poses.end(), [](const auto& p) { return p.hangs; });
  made.options = options(hangs, norm(box_of(made.figure).size()));
  return made;
}

/// Adds to the angle asked for what the solid reaches as it comes.
void ask_for_more(Pose& pose, const SolidMesh& solid) {
  const std::array<Region, 1> body{Region{solid.moments(), 1, 0}};
  const auto before = measure_pose(solid.mesh(), body, pose);
  if (!before) return;
  if (auto* standing = std::get_if<StandingPose>(&pose.way)) {
    const double tip_rad = std::get<Standing>(*before).stability.tip_rad;
    standing->required_tip_rad = std::clamp(tip_rad + standing->required_tip_rad, 0.0, 80 * degree);
  } else {
    auto& hanging = std::get<HangingPose>(pose.way);
    const double tilt_rad = std::get<Hanging>(*before).tilt_rad;
    hanging.required_tilt_rad = std::clamp(tilt_rad - hanging.required_tilt_rad, 0.5 * degree, 80 * degree);
  }
}

}  // namespace

Case case_of(std::uint64_t seed) {
  constexpr int size = 100;
  return rc::gen::exec(any_case)(rc::Random(seed), size).value();
}

StandOptions options_of(const Case& a_case, const SolidMesh& solid) {
  StandOptions options = a_case.options;
  options.poses.clear();
  const std::vector<Vec3>& vertices = solid.mesh().vertices;
  for (const PoseChoice& choice : a_case.poses) {
    Pose pose{{}, StandingPose{choice.up, {}, choice.contact_height_mm, choice.angle_rad}};
    if (choice.hangs) {
      HangingPose hanging{choice.up, {}, choice.angle_rad};
      for (const double share : choice.vertices)
        hanging.attachments_mm.push_back(vertices[static_cast<std::size_t>(share * double(vertices.size()))]);
      if (!find_problem(hanging).empty()) hanging.attachments_mm.pop_back();  // one straight above the other
      pose.way = hanging;
    }
    if (choice.is_relative) ask_for_more(pose, solid);
    options.poses.push_back(pose);
  }
  return options;
}

std::string describe(const Case& a_case) {
  const StandOptions& o = a_case.options;
  std::string text =
      fmt::format("{} limbs{}, noise {:.3g} mm, cells {:.3g} mm, wall {:.4g} mm, voxel {:.4g} mm, {}, aim {}",
                  a_case.figure.limbs.size(), a_case.figure.is_crossing ? " that cross" : "", a_case.figure.noise_mm,
                  a_case.figure.cell_mm, o.wall_mm, *o.voxel_mm,
                  process_names[static_cast<std::size_t>(o.judge.rules.process())], static_cast<int>(o.aim));
  text += fmt::format(", least void {:.3g} mm and {:.3g} mm3, deform {}", o.least_void_mm, o.least_volume_mm3,
                      static_cast<int>(o.deform));
  for (const PoseChoice& pose : a_case.poses)
    text += fmt::format("; {} up ({:.3g}, {:.3g}, {:.3g}), {:.3g} degrees{}", pose.hangs ? "hangs" : "stands",
                        pose.up.x, pose.up.y, pose.up.z, pose.angle_rad / degree, pose.is_relative ? " more" : "");
  return text;
}

}  // namespace aplomb::campaign
