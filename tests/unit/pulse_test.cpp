#include "aplomb/core/pulse.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace aplomb {
namespace {

TEST(Pulse, ReportsAtTheFirstStepAndThenAboutEveryTwentyMilliseconds) {
  std::vector<double> fractions;
  const Job job([&](double fraction, std::string_view stage) {
    EXPECT_EQ(stage, "stir");
    fractions.push_back(fraction);
    return true;
  });
  const Pulse pulse(job.part(0.5, 1), 0.5, "stir");
  EXPECT_TRUE(fractions.empty());
  for (int step = 0; step < 100; ++step) EXPECT_TRUE(pulse.goes_on(1000));
  EXPECT_EQ(fractions, std::vector<double>(5, 0.75));
  EXPECT_TRUE(pulse.goes_on(1'000'000));  // a step longer than that
  EXPECT_EQ(fractions.size(), 6U);
}

TEST(Pulse, OnceToldToStopAsksNobodyAgain) {
  int asked = 0;
  const Job job([&](double, std::string_view) { return ++asked < 3; });
  const Pulse pulse(job, 0, "stir");
  int steps = 0;
  while (pulse.goes_on(5000)) ++steps;
  EXPECT_TRUE(pulse.stopped());
  EXPECT_EQ(steps, 8);
  for (int step = 0; step < 100; ++step) EXPECT_FALSE(pulse.goes_on(5000));
  EXPECT_EQ(asked, 3);
}

TEST(Pulse, WithoutAListenerGoesOn) {
  const Pulse pulse;
  for (int step = 0; step < 100; ++step) EXPECT_TRUE(pulse.goes_on(5000));
  EXPECT_FALSE(pulse.stopped());
}

}  // namespace
}  // namespace aplomb
