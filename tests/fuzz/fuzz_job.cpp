// A job file; what is accepted is written as JSON, which must be accepted again and mean the same.
#include <cstdint>
#include <string_view>

#include "aplomb/job/job_file.h"
#include "checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aplomb;
  const auto job = parse_job({reinterpret_cast<const char*>(data), size}, "folder");
  if (!job) return fuzz::check_remedy_or_range(job.error()), 0;
  const std::string written = to_json(*job, "folder");
  const auto again = parse_job(written, "folder");
  fuzz::promise(again.has_value(), "what was written is read: " + (again ? "" : again.error().message));
  const std::string twice = to_json(*again, "folder");
  fuzz::promise(twice == written, "what is read again means the same: " + written + twice);
  return 0;
}
