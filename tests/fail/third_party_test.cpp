// What other people's code does when it gives up is an answer, not our end.
#include <gtest/gtest.h>

#include "aplomb/adapters/glpk/linear_program.h"

namespace aplomb {
namespace {

using adapters::LinearProgram;

TEST(ThirdParty, GlpkAbortsAndIsAskedAgainWithoutHarmOrAWord) {
  const LinearProgram none;  // GLPK calls abort() for a program without a variable
  const LinearProgram one{{{1, 0, adapters::unbounded}}, {{{-1}, -7}}};
  for (int round = 0; round < 3; ++round) {
    testing::internal::CaptureStdout();
    EXPECT_FALSE(adapters::solve(none).has_value());
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(adapters::solve(one).value().value, 7);
  }
}

}  // namespace
}  // namespace aplomb
