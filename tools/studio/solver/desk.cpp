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

}  // namespace

Result<const Input*> Desk::solid(const std::string& folder, const JobFile& asked, const Job& job) {
  const std::string key = key_of(folder, asked);
  if (solid_ && key == solid_key_) return &*solid_;
  solid_.reset();
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

}  // namespace aplomb::studio
