#include "solver/desk.h"

namespace aplomb::studio {
namespace {

/// All that a job says of how its model is read, placed and made solid.
std::string key_of(const std::string& folder, const JobFile& asked) {
  JobFile input;
  input.model = asked.model;
  input.input = asked.input;
  input.options.memory_bytes = asked.options.memory_bytes;
  return folder + (asked.input.hint_at_resting ? "\n1\n" : "\n0\n") + to_json(input, ".");
}

/// All that the cage and its rows depend on, besides the solid.
std::string key_of(const StandOptions& options) {
  JobFile bending;
  bending.poses.clear();
  for (const Pose& pose : options.poses) {
    JobPose& added = bending.poses.emplace_back(JobPose{pose, {}});
    if (const StandingPose* standing = pose.standing())
      for (const auto& contact : standing->contacts) added.contacts.push_back({contact.center_mm, contact.radius_mm});
  }
  bending.options.robust = options.robust;
  bending.options.deform = options.deform == Deform::only ? Deform::only : Deform::automatic;
  bending.options.wall_mm = options.wall_mm;
  bending.options.reshape.most_mean_percent = options.reshape.most_mean_percent;
  return to_json(bending, ".");
}

}  // namespace

Result<const Input*> Desk::solid(const std::string& folder, const JobFile& asked, const Job& job) {
  const std::string key = key_of(folder, asked);
  if (solid_ && key == solid_key_) return &*solid_;
  solid_.reset();
  bender_.reset();
  bent.clear();
  const std::string path = folder + "/" + asked.model.string();
  if (!file_ || path != file_key_) {
    file_.reset();
    auto file = read_mesh(asked.model, asked.input.read, job.part(0, 0.3));
    if (!file) return tl::unexpected(file.error());
    file_ = std::move(*file);
    file_key_ = path;
  }
  auto input = load_solid(*file_, asked.input, job.part(0.3, 1));
  if (!input) return tl::unexpected(input.error());
  solid_ = std::move(*input);
  solid_key_ = key;
  return &*solid_;
}

Result<const BendPreview*> Desk::bender(const Input& input, const StandOptions& options, const Job& job) {
  const std::string key = key_of(options);
  if (bender_ && key == bender_key_) return &*bender_;
  bender_.reset();
  bent.clear();
  BendPreview::Options bending{.reshape = options.reshape, .kind = kind_of(options)};
  bending.reshape.wall_mm = options.wall_mm;
  bending.reshape.carves = options.deform != Deform::only;
  auto made = BendPreview::make(input.solid, options.poses, bending, job);
  if (!made) return tl::unexpected(made.error());
  bender_ = std::move(*made);
  bender_key_ = key;
  return &*bender_;
}

}  // namespace aplomb::studio
