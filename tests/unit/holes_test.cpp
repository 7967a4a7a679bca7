#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "aplomb/adapters/embree/surface_distance.h"
#include "aplomb/holes/chambers.h"
#include "aplomb/holes/drill.h"
#include "aplomb/holes/hole_places.h"
#include "aplomb/holes/undrained.h"
#include "aplomb/printability/escape.h"
#include "aplomb/printability/void_cup.h"
#include "support/prints.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

struct Hollow {
  TriangleMesh outer, inner;
  TriangleMesh mesh() const { return test::with_void(outer, inner); }
};

Hollow ball() {
  return {rounded_to_float(test::sphere({0, 0, 20}, 20, 4)), rounded_to_float(test::sphere({0, 0, 20}, 17, 4))};
}
Hollow box() { return {test::box({-20, -15, 0}, {20, 15, 30}), test::box({-16, -11, 4}, {16, 11, 26})}; }
/// An arch on two legs.
Hollow arch() {
  return {test::strip({{-25, 0}, {-25, 40}, {25, 40}, {25, 0}}, {{-11, 0}, {-11, 26}, {11, 26}, {11, 0}}, 16),
          transformed(test::strip({{-21.5, 3.5}, {-21.5, 36.5}, {21.5, 36.5}, {21.5, 3.5}},
                                  {{-14.5, 3.5}, {-14.5, 29.5}, {14.5, 29.5}, {14.5, 3.5}}, 9),
                      test::translation({0, 3.5, 0}))};
}

const Pose on_its_feet{};

Result<HoleChoice> chosen(const Hollow& hollow, Process process, std::vector<BallRegion> kept = {},
                          const Job& job = {}) {
  return choose_holes(hollow.outer, std::array{hollow.inner}, *hole_demand(Rules(process)),
                      {{&on_its_feet, 1}, std::move(kept)}, {}, job);
}

Drilled drilled(const Hollow& hollow, Process process) {
  return drill(hollow.mesh(), hollow.outer.triangles.size(), chosen(hollow, process)->holes).value();
}

/// What the judge measures of the ways out.
struct WaysOut {
  bool is_cavity = false;  ///< narrow ways out: else it is an open vase, which needs no holes
  double closed = 0, holes = 0, off_mm = 0;
  std::size_t cups = 0;
};

WaysOut ways_out(const TriangleMesh& mesh, Process process) {
  const Rules rules(process);
  const test::Print print = test::print_of(mesh);
  const auto cavities = find_cavities(print.printed, rules);
  WaysOut ways;
  ways.is_cavity = !cavities->empty();
  if (ways.is_cavity) ways.closed = void_closed(*cavities, rules).front().measured;
  if (const auto holes = void_holes(*cavities, rules); !holes.empty()) ways.holes = holes.front().measured;
  if (const auto places = void_hole_place(*cavities, rules); !places.empty()) ways.off_mm = places.front().measured;
  const auto cups = measure_void_cup(print.printed, print.slices, rules);
  ways.cups = std::size_t(std::ranges::count_if(*cups, [](const Place& cup) { return cup.measured > 1; }));
  return ways;
}

class EscapeHoles : public testing::TestWithParam<Process> {};

TEST_P(EscapeHoles, OpenWhatTheJudgeFoundClosedAsWidelyAndWhereTheProcessAsks) {
  for (const Hollow& hollow : {ball(), box(), arch()}) {
    ASSERT_EQ(ways_out(hollow.mesh(), GetParam()).closed, 1);
    const WaysOut after = ways_out(drilled(hollow, GetParam()).mesh, GetParam());
    EXPECT_EQ(after.closed, 0);
    if (after.is_cavity) {
      EXPECT_GE(after.holes, 2);
    }
    EXPECT_LE(after.off_mm, 2);
    EXPECT_EQ(after.cups, 0U);
  }
}

TEST_P(EscapeHoles, LeaveEveryTriangleThatTheyDoNotCutAsItWasToTheBit) {
  const Hollow hollow = ball();
  const Drilled made = drilled(hollow, GetParam());
  const auto corners = [](const TriangleMesh& mesh, std::size_t t) {
    std::array<std::array<double, 3>, 3> all{};
    for (std::size_t c = 0; c < 3; ++c)
      for (int axis = 0; axis < 3; ++axis) all[c][std::size_t(axis)] = mesh.vertices[mesh.triangles[t][c]][axis];
    return all;
  };
  const TriangleMesh before = hollow.mesh();
  std::set<std::array<std::array<double, 3>, 3>> known;
  for (std::size_t t = 0; t < before.triangles.size(); ++t) known.insert(corners(before, t));
  for (std::size_t t = 0; t < made.untouched; ++t) EXPECT_TRUE(known.contains(corners(made.mesh, t)));
  std::size_t far = 0;  // triangles that no prism comes near
  for (std::size_t t = 0; t < before.triangles.size(); ++t)
    far += std::ranges::all_of(made.holes, [&](const Hole& hole) {
      const Vec3 from = before.vertices[before.triangles[t][0]] - hole.inside_mm;
      return norm(from - dot(from, hole.outward) * hole.outward) > hole.bore_mm + 3;
    });
  EXPECT_GE(made.untouched, far);
  EXPECT_GT(far, before.triangles.size() / 2);
}

TEST_P(EscapeHoles, AreFilledByPlugsWithPlayAllRound) {
  const Hollow hollow = box();
  const Drilled made = drilled(hollow, GetParam());
  const double play = 0.15;
  const auto parts = plugs(hollow.outer, made.holes, play);
  ASSERT_TRUE(parts.has_value());
  ASSERT_EQ(parts->size(), made.holes.size());
  const adapters::SurfaceDistance shell(made.mesh);
  for (std::size_t n = 0; n < parts->size(); ++n) {
    const SolidMesh plug = test::solid_of((*parts)[n]);
    const Hole& hole = made.holes[n];
    const double sides = 24, radius = 0.5 * hole.bore_mm - play;
    const double area = sides * radius * radius * std::tan(std::numbers::pi / sides);
    EXPECT_NEAR(plug.moments().volume_mm3, area * hole.wall_mm(), 0.01 * area * hole.wall_mm());  // flat faces
    for (const Vec3& v : plug.mesh().vertices) {
      const auto nearest = shell.closest(v);
      EXPECT_FALSE(shell.inside(v, nearest));
      EXPECT_GE(nearest.distance_mm, play - 1e-3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, EscapeHoles, testing::Values(Process::sla, Process::powder, Process::binder),
                         [](const auto& test) { return std::string(process_names[std::size_t(test.param)]); });

TEST(EscapeHolePlaces, AreAtTheBottomOfEveryLegForLiquid) {
  const auto choice = chosen(arch(), Process::sla);
  ASSERT_TRUE(choice->dead_ends.empty());
  int left = 0, right = 0;
  for (const Hole& hole : choice->holes) {
    const Vec3 throat = hole.at(hole.throat_mm);
    if (throat.z < 7) (throat.x < 0 ? left : right) += 1;
  }
  EXPECT_EQ(left, 1);
  EXPECT_EQ(right, 1);
}

TEST(EscapeHolePlaces, KeepOffThePlateAndOutOfWhatIsToBeKept) {
  const auto free = chosen(ball(), Process::sla);
  ASSERT_FALSE(free->holes.empty());
  const Vec3 wanted = free->holes.front().at(free->holes.front().mouth_mm);
  const BallRegion kept{wanted, 6};
  const auto fenced = chosen(ball(), Process::sla, {kept});
  ASSERT_FALSE(fenced->holes.empty());
  for (const Hole& hole : fenced->holes) {
    EXPECT_GT(norm(hole.at(hole.mouth_mm) - kept.center_mm), kept.radius_mm + 0.5 * hole.bore_mm);
    for (const Vec3& v : prism_of(hole).vertices) EXPECT_GT(v.z, 0.1);
  }
}

TEST(EscapeHolePlaces, AreNotFoundThroughAWallThatIsTooThick) {
  const Hollow thick{test::box({-40, -40, 0}, {40, 40, 80}), test::box({-8, -8, 32}, {8, 8, 48})};
  const auto choice = chosen(thick, Process::powder);
  EXPECT_TRUE(choice->holes.empty());
  ASSERT_EQ(choice->dead_ends.size(), 1U);
  EXPECT_TRUE(std::isinf(choice->dead_ends.front().below_mm));
}

TEST(EscapeHolePlaces, AreTheSameAgainWhereTheyStillServe) {
  const Hollow hollow = arch();
  const auto first = chosen(hollow, Process::sla);
  const auto again = choose_holes(hollow.outer, std::array{hollow.inner}, *hole_demand(Rules(Process::sla)),
                                  {{&on_its_feet, 1}, {}}, first->holes);
  ASSERT_EQ(again->holes.size(), first->holes.size());
  for (const Hole& hole : again->holes)
    EXPECT_TRUE(std::ranges::any_of(first->holes, [&](const Hole& h) { return h.inside_mm == hole.inside_mm; }));
}

TEST(EscapeHolePlaces, AreCancelledAtAnyReport) {
  test::CancelAt never(1 << 30);
  ASSERT_TRUE(chosen(arch(), Process::sla, {}, never.job()).has_value());
  for (int k = 1; k <= never.reports(); k += 1 + never.reports() / 12) {
    test::CancelAt at_k(k);
    const auto result = chosen(arch(), Process::sla, {}, at_k.job());
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
  }
}

/// Two rooms above each other, 14 mm across and 12 mm high, and a bore of that radius and 0.5 mm long between.
TriangleMesh two_rooms(double bore_radius_mm) {
  return rounded_to_float(test::lathe(
      {{0, 0}, {7, 0}, {7, 12}, {bore_radius_mm, 12}, {bore_radius_mm, 12.5}, {7, 12.5}, {7, 24.5}, {0, 24.5}}, 48));
}

TEST(WallRoundAChamber, PartsTheRoomsOfAVoidWhereTheBallDoesNotPass) {
  const auto wall = wall_round_chamber(two_rooms(2), {0, 0, 6}, 5, 1.5);
  ASSERT_TRUE(wall.has_value());
  for (const double x : {-1.9, 0.0, 1.9}) {
    EXPECT_NEAR(wall->depth_mm({x, 0, 12.25}), 0.75, 0.45);
    EXPECT_LT(wall->depth_mm({x, 0, 9.5}), 0);
    EXPECT_LT(wall->depth_mm({x, 0, 15}), 0);
  }
  EXPECT_LT(wall->depth_mm({0, 0, 6}), 0);
  EXPECT_LT(wall->depth_mm({0, 0, 18}), 0);
}

TEST(WallRoundAChamber, IsNoneWhereTheBallGetsEverywhere) {
  EXPECT_FALSE(wall_round_chamber(two_rooms(4), {0, 0, 6}, 5, 1.5).has_value());
}

TEST(Undrained, AreCavitiesThatTheJudgeFailsAndNoneThatAreDrilled) {
  const Rules rules(Process::sla);
  const auto closed = undrained(ball().mesh(), rules);
  ASSERT_EQ(std::ranges::count(*closed, false, &Undrained::is_cup), 1);
  EXPECT_LT(norm(closed->front().at_mm - Vec3{0, 0, 20}), 3);
  EXPECT_TRUE(undrained(drilled(ball(), Process::sla).mesh, rules)->empty());
}

TEST(Undrained, AreCancelledAtEveryReport) {
  test::CancelAt never(1 << 30);
  ASSERT_TRUE(undrained(ball().mesh(), Rules(Process::sla), never.job()).has_value());
  for (int k = 1; k <= never.reports(); k += 1 + never.reports() / 12) {
    test::CancelAt at_k(k);
    const auto result = undrained(ball().mesh(), Rules(Process::sla), at_k.job());
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().code, ErrorCode::cancelled);
  }
}

TEST(EscapeHolePlaces, KeepOffTheFixingOfAThread) {
  Pose hangs;
  hangs.way = HangingPose{};
  const Hollow hollow = box();
  const auto before =
      choose_holes(hollow.outer, std::array{hollow.inner}, *hole_demand(Rules(Process::powder)), {{&hangs, 1}, {}});
  ASSERT_FALSE(before->holes.empty());
  HangingPose hung;
  hung.attachments_mm = {before->holes.front().at(before->holes.front().mouth_mm)};
  hangs.way = hung;
  const auto after =
      choose_holes(hollow.outer, std::array{hollow.inner}, *hole_demand(Rules(Process::powder)), {{&hangs, 1}, {}});
  ASSERT_FALSE(after->holes.empty());
  for (const Hole& hole : after->holes)
    EXPECT_GT(norm(hole.at(hole.mouth_mm) - hung.attachments_mm.front()), 0.5 * hole.bore_mm + 1);
}

TEST(EscapeHoleDemand, IsNoneWhereNothingHasToGetOut) {
  EXPECT_FALSE(hole_demand(Rules(Process::fdm)).has_value());
  EXPECT_EQ(hole_demand(Rules(Process::binder))->ball_mm, 5);
}

}  // namespace
}  // namespace aplomb
