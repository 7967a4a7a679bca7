#include "outputs.h"

#include <fmt/format.h>

#include <string_view>
#include <utility>
#include <vector>

namespace aplomb::cli {
namespace {

namespace fs = std::filesystem;

struct Named {
  std::string_view flag;
  fs::path path;
};

/// What several paths to one file have in common; empty for what cannot be replaced.
fs::path identity_of(const fs::path& path) {
  if (path.empty() || path == "-") return path;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) return {};
  const fs::path whole = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? fs::absolute(path, error).lexically_normal() : whole;
}

}  // namespace

std::string find_clash(const Arguments& a) {
  const bool verifies = a.command == Command::verify;
  const std::vector<Named> outputs{
      {"--output", a.job.output},   {"--report", verifies ? a.verify.report : a.job.report},
      {"--plugs", a.job.plugs},     {"--modifier", a.job.modifier},
      {"--picture", a.job.picture}, {"--html", a.job.html},
      {"--save-job", a.save_job}};
  std::vector<std::pair<fs::path, std::string_view>> taken;  // by what is read, and by the outputs so far
  for (const fs::path& input : {verifies ? a.verify.program : a.job.model, a.verify.expect, a.job.profile, a.job_file})
    if (input != "-") taken.emplace_back(identity_of(input), "what is read");
  for (const auto& [flag, path] : outputs) {
    const fs::path identity = identity_of(path);
    if (identity.empty()) continue;
    for (const auto& [other, by] : taken)
      if (other == identity && !(flag == "--output" && by == "what is read"))
        return identity == "-"
                   ? fmt::format("{} and {} both go to standard output; give one of them a file", by, flag)
                   : fmt::format("{} and {} are both {}; give each a file of its own", by, flag, path.string());
    taken.emplace_back(identity, flag);
  }
  return {};
}

}  // namespace aplomb::cli
