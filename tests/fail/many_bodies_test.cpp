// Very many bodies in one file: what it costs to tell them apart grows with the file, or ends in a reason; it can be
// stopped.
#include <gtest/gtest.h>

#include <algorithm>

#include "aplomb/mesh/bodies.h"
#include "aplomb/mesh/solid_mesh.h"
#include "support/cancelled.h"
#include "support/many_bodies.h"

namespace aplomb {
namespace {

struct Crowd {
  const char* name;
  TriangleMesh (*made)(int count);
  int count;
  bool is_one_print;
};

std::ostream& operator<<(std::ostream& out, const Crowd& crowd) { return out << crowd.name; }

const Crowd crowds[] = {
    {"apart", test::tetrahedra_apart, 1'000'000, false},
    {"stacked", test::tetrahedra_stacked, 1'000'000, false},
    {"nested", [](int count) { return test::tetrahedra_nested(count); }, 100'000, true},
    {"nestedFromOutside", [](int count) { return test::tetrahedra_nested(count, false); }, 100'000, true},
    {"crossing", test::tetrahedra_crossing, 10'000, true},
};

class ManyBodies : public testing::TestWithParam<Crowd> {
 protected:
  static int count() { return test::is_sanitized() ? GetParam().count / 20 : GetParam().count; }
};

TEST_P(ManyBodies, AreToldApartInTimeAndMemoryThatGrowWithTheFile) {
  const auto cost = [](int count) {
    const TriangleMesh mesh = GetParam().made(count);
    return test::cost_of([&] {
      const auto prints = split_prints(mesh);
      if (!prints || prints->size() != (GetParam().is_one_print ? 1U : std::size_t(count))) abort();
    });
  };
  test::Cost whole = cost(count());
  ASSERT_TRUE(whole.ended);
  if (test::is_sanitized()) return;
  test::Cost eighth = cost(count() / 8);
  const auto most_s = [&] { return std::min(15.0, 0.2 + 14 * eighth.seconds); };  // takes 3 to 6 on quiet cores
  // The two were not measured at once.
  for (int again = 0; again < 3 && whole.seconds >= most_s(); ++again) {
    whole = test::least_of(whole, cost(count()));
    eighth = test::least_of(eighth, cost(count() / 8));
  }
  ASSERT_TRUE(whole.ended && eighth.ended);
  std::cout << "  " << whole.seconds << " s, " << (whole.peak_bytes >> 20) << " MB\n";
  EXPECT_LT(whole.seconds, most_s()) << "an eighth takes " << eighth.seconds << " s";
  EXPECT_LT(double(whole.peak_bytes), 64e6 + 1500.0 * count());
}

TEST_P(ManyBodies, CanBeStoppedWhileTheyAreToldApart) {
  const TriangleMesh mesh = GetParam().made(count() / 10);
  const auto run = [&](const Job& job) { return split_prints(mesh, job); };
  test::expect_cancelled_at_a_spread(test::whole(run), run, 8);
}

INSTANTIATE_TEST_SUITE_P(Every, ManyBodies, testing::ValuesIn(crowds),
                         [](const auto& crowd) { return std::string(crowd.param.name); });

TEST(ManyBodiesInOneAnothersBoxes, AreRefusedWithTheRemedyRatherThanSortedOutForEver) {
  const auto refused = [](const auto& result) {
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::unusable_input);
    EXPECT_NE(result.error().message.find("split the file"), std::string::npos) << result.error().message;
  };
  const double most_s = test::is_sanitized() ? 200 : 20;
  const auto refuse = [&] {
    const double start_s = test::thread_cpu_s();
    refused(split_prints(test::needles_slanted(40'000)));
    return test::thread_cpu_s() - start_s;
  };
  EXPECT_LT(test::least_seconds(refuse, most_s), most_s);
}

TEST(ManyBodiesInOneAnother, AreASolidOrRefusedAsTheyWind) {
  const auto few = check_solid(test::tetrahedra_nested(500));
  ASSERT_TRUE(few.has_value());
  EXPECT_EQ(few->defects.misoriented_shells, 499U);  // all but the outermost
  const auto many = check_solid(test::tetrahedra_nested(test::is_sanitized() ? 20'000 : 100'000));
  ASSERT_FALSE(many.has_value());
  EXPECT_EQ(many.error().code, ErrorCode::unusable_input);
}

TEST(ManyBodiesThatCross, AreCountedToALimitAndNoFurther) {
  const auto check = check_solid(test::tetrahedra_crossing(10'000));
  ASSERT_TRUE(check.has_value());
  EXPECT_EQ(check->defects.self_intersections, 1'000'000U);
}

}  // namespace
}  // namespace aplomb
