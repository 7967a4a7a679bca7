// A slicer's profile: .ini, the end of a G-code, or JSON.
#include <cstdint>
#include <string_view>

#include "aplomb/fdm/print_profile.h"
#include "checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aplomb;
  const auto profile = parse_profile({reinterpret_cast<const char*>(data), size});
  if (!profile) return fuzz::check_remedy(profile.error()), 0;
  fuzz::promise(find_problem(*profile).empty(), "a profile without a problem: " + find_problem(*profile));
  return 0;
}
