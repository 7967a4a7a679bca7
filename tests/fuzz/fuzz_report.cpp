// A report as verify is given it.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "aplomb/report/verification.h"
#include "checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace aplomb;
  const auto expected = expected_print({reinterpret_cast<const char*>(data), size});
  if (!expected) return fuzz::check_remedy(expected.error()), 0;
  fuzz::promise(expected->mass_g > 0 && expected->density_g_per_cm3 > 0 && std::isfinite(norm(expected->com_mm)),
                "what is expected is a body");
  return 0;
}
