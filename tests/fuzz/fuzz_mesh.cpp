// One file of one mesh format. APLOMB_FUZZ_NAME is the name it comes under.
#include <cstdint>

#include "check_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  aplomb::fuzz::check_mesh({reinterpret_cast<const std::byte*>(data), size}, APLOMB_FUZZ_NAME);
  return 0;
}
