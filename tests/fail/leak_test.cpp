// Every test in this folder runs under LeakSanitizer (tests/CMakeLists.txt): what an ended run leaves behind fails it.
#include <gtest/gtest.h>

#include <cstdlib>

namespace aplomb {
namespace {

void leave_behind() {
  void* volatile lost = std::malloc(1000);
  if (lost) lost = nullptr;
  std::exit(0);
}

TEST(LeakSanitizer, EndsAProgramThatLeavesMemoryBehind) {
  EXPECT_EXIT(leave_behind(), testing::ExitedWithCode(23), "LeakSanitizer");
}

}  // namespace
}  // namespace aplomb
