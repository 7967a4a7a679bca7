// A G-code program, read and verified.
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "aplomb/gcode/verify_print.h"
#include "checks.h"

namespace {

/// The bytes as a file, for G-code is read by its path.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : file_(memfd_create("program", MFD_CLOEXEC)) {
    if (file_ < 0 || write(file_, data, size) != static_cast<ssize_t>(size)) std::abort();
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aplomb;
  const MemoryFile file(data, size);
  auto plate = read_gcode(file.path());
  if (!plate) return fuzz::check_remedy(plate.error()), 0;
  for (const std::string& note : plate->notes) fuzz::check_error({ErrorCode::unusable_input, note});
  const auto verified = verify_print(std::move(*plate), {});
  if (!verified) return fuzz::check_error(verified.error()), 0;
  for (const VerifiedObject& object : verified->objects)
    fuzz::promise(!object.stands || std::isfinite(object.stability.mass_g), "what stands has a mass");
  return 0;
}
