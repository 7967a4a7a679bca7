#include "aplomb/inserts/place_chooser.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "aplomb/shell/wall.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

const Insert ball{"ball 8 mm", Insert::Shape::ball, 8, 8, 2.1};
const Insert coin{"coin", Insert::Shape::disc, 12, 1.5, 1.3};

PocketFits fits_of(const SolidMesh& solid, std::vector<Pocket> pockets, double step_mm = 2) {
  return PocketFits::make(solid, std::move(pockets), {.wall_mm = 1.6, .least_step_mm = step_mm}).value();
}

BalanceProblem rows_of(const SolidMesh& solid) {
  return joint_problem(solid.mesh(), std::vector<Pose>{Pose{}}, RowKind::nominal)->problem;
}

PocketLoads loads_of(std::vector<std::uint32_t> stocks, std::vector<int> most) {
  PocketLoads loads;
  loads.stocks = std::move(stocks);
  loads.most = std::move(most);
  return loads;
}

/// What a choice weighs, from meshes and formulae of the inserts alone.
LoadedBody weighed(const SolidMesh& solid, const PocketFits& fits, const std::vector<PocketPlace>& places) {
  LoadedBody body{solid.moments(), {}};
  for (const PocketPlace& place : places) {
    const Pocket& pocket = fits.pockets()[place.pocket];
    body.solid = body.solid - moments(pocket_mesh(pocket, place.floor_mm));
    for (int i = 0; i < pocket.stacked; ++i) {
      const double volume = pocket.insert.mass_g / 1.24e-3;
      body.inserts += {volume, volume * (place.floor_mm + Vec3{0, 0, (i + 0.5) * pocket.insert.height_mm})};
    }
  }
  return body;
}

TEST(PocketFits, AgreesWithABoxAndWithTheWallMeasured) {
  const SolidMesh solid = test::solid_of(test::box({-30, -20, 0}, {30, 20, 25}));
  const PocketFits fits = fits_of(solid, {pocket_for(ball, 1, {}), pocket_for(coin, 2, {})});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-30, 30), y(-20, 20), z(0, 25);
  int fit = 0;
  for (int i = 0; i < 2000; ++i) {
    const PocketPlace place{std::uint32_t(i % 2), {x(random), y(random), z(random)}};
    const Pocket& pocket = fits.pockets()[place.pocket];
    const double radius =
        pocket.radius_mm / std::cos(3.14159265358979 / 64);  // a corner of the polygon points along x and y
    const double wall = std::min({30 - std::abs(place.floor_mm.x) - radius, 20 - std::abs(place.floor_mm.y) - radius,
                                  place.floor_mm.z, 25 - place.floor_mm.z - pocket.height_mm});
    ASSERT_EQ(fits.fits(place), wall >= 1.6 - 1e-5) << wall;
    if (wall < 1.6) continue;
    ++fit;
    EXPECT_NEAR(fits.wall_mm(place, 100), wall, 1e-5);
    if (fit % 20 == 0) {
      EXPECT_NEAR(measure_wall(pocket_mesh(pocket, place.floor_mm), solid.mesh(), 1.6)->least_mm, wall, 2e-4 * wall);
    }
  }
  EXPECT_GT(fit, 100);
}

TEST(PocketFits, LeavesNoPlaceOfTheLatticeOut) {
  const SolidMesh solid = test::solid_of(test::star_prism(5, 40, 18, 30));
  const PocketFits fits = fits_of(solid, {pocket_for(coin, 1, {})});
  const auto candidates = fits.candidates();
  ASSERT_GT(candidates.size(), 100u);
  const auto is_candidate = [&](const PocketPlace& place) {
    return std::ranges::any_of(candidates,
                               [&](const PocketPlace& c) { return norm(c.floor_mm - place.floor_mm) < 1e-6; });
  };
  int beyond = 0, fitting = 0;
  for (const PocketPlace& candidate : candidates) {
    fitting += fits.fits(candidate);
    for (const Vec3 step :
         {Vec3{2, 0, 0}, Vec3{-2, 0, 0}, Vec3{0, 2, 0}, Vec3{0, -2, 0}, Vec3{0, 0, 2}, Vec3{0, 0, -2}}) {
      const PocketPlace next{0, candidate.floor_mm + step};
      if (is_candidate(next)) continue;
      ++beyond;
      ASSERT_FALSE(fits.fits(next)) << next.floor_mm.x << " " << next.floor_mm.y << " " << next.floor_mm.z;
    }
  }
  EXPECT_GT(beyond, 100);
  EXPECT_GT(fitting, 0.6 * double(candidates.size()));  // the lattice alone knows nearly
  EXPECT_GT(fits.widest_mm(fits.pockets().front().height_mm), 12.5);
  EXPECT_EQ(fits.widest_mm(30), 0);
}

TEST(PocketFits, KeepsPocketsApartByTheWall) {
  const SolidMesh solid = test::solid_of(test::box({-40, -40, 0}, {40, 40, 40}));
  const PocketFits fits = fits_of(solid, {pocket_for(ball, 1, {}), pocket_for(coin, 3, {})});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> along(-10, 10);
  for (int i = 0; i < 300; ++i) {
    const PocketPlace a{std::uint32_t(i % 2), {0, 0, 15}},
        b{std::uint32_t(i / 2 % 2), {2 * along(random), 2 * along(random), 15 + along(random)}};
    const double apart = measure_wall(pocket_mesh(fits.pockets()[a.pocket], a.floor_mm),
                                      pocket_mesh(fits.pockets()[b.pocket], b.floor_mm), 1.6)
                             ->least_mm;
    EXPECT_EQ(fits.are_apart(a, b), fits.are_apart(b, a));
    if (fits.are_apart(a, b)) {
      EXPECT_GE(apart, 1.6 * (1 - 1e-4));
    }
  }
}

/// Of a few places: every choice there is.
double best_by_trial(const PocketFits& fits, const std::vector<PocketPlace>& places, const SolidMesh& solid,
                     const BalanceProblem& problem, const PocketLoads& loads, int most) {
  double best = loaded_t(problem, {solid.moments(), {}}, loads.kind);
  std::vector<PocketPlace> chosen;
  const std::function<void(std::size_t)> extend = [&](std::size_t from) {
    best = std::max(best, loaded_t(problem, weighed(solid, fits, chosen), loads.kind));
    for (std::size_t i = from; i < places.size(); ++i) {
      std::vector<int> left = loads.most;
      int all = most - fits.pockets()[places[i].pocket].stacked;
      left[loads.stocks[places[i].pocket]] -= fits.pockets()[places[i].pocket].stacked;
      bool is_apart = true;
      for (const PocketPlace& other : chosen) {
        left[loads.stocks[other.pocket]] -= fits.pockets()[other.pocket].stacked;
        all -= fits.pockets()[other.pocket].stacked;
        is_apart &= fits.are_apart(other, places[i]);
      }
      if (all < 0 || *std::ranges::min_element(left) < 0 || !is_apart || !fits.fits(places[i])) continue;
      chosen.push_back(places[i]);
      extend(i + 1);
      chosen.pop_back();
    }
  };
  extend(0);
  return best;
}

class Chooser : public testing::TestWithParam<int> {};

TEST_P(Chooser, FindsTheBestOfAllChoicesAndBoundsIt) {
  const SolidMesh solid = test::solid_of(test::leaning_prism(34, 40, 60, 22));
  const PocketFits fits =
      fits_of(solid, {pocket_for(ball, 1, {}), pocket_for(ball, 2, {}), pocket_for(coin, 1, {})}, 3);
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  auto places = fits.candidates();
  std::ranges::shuffle(places, random);
  places.resize(14);
  PocketLoads loads = loads_of({0, 0, 1}, {3, 2});
  if (GetParam() % 2 == 1) loads.kind = RowKind::robust;
  PlaceChooser chooser(fits, places, rows_of(solid), solid.moments(), loads);
  for (const int most : {1, 2, 4}) {
    const PocketChoice choice = chooser.choose(most).value();
    const double best = best_by_trial(fits, places, solid, rows_of(solid), loads, most);
    EXPECT_NEAR(choice.t, best, 1e-6) << most;
    EXPECT_GE(choice.bound_t, best - 1e-9);
    EXPECT_LE(choice.inserts, most);
    EXPECT_NEAR(choice.t, loaded_t(rows_of(solid), weighed(solid, fits, choice.places), loads.kind), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Chooser, testing::Range(1, 13));

TEST(Chooser, KeepsWallsAndStocksAndComesNearItsBound) {
  const SolidMesh solid = test::solid_of(test::leaning_prism(34, 40, 60, 22));
  std::vector<Pocket> pockets;
  for (const int stacked : {1, 2, 3, 4, 5}) pockets.push_back(pocket_for(ball, stacked, {}));
  const PocketFits fits = fits_of(solid, pockets, 1.5);
  PlaceChooser chooser(fits, fits.candidates(), rows_of(solid), solid.moments(), loads_of({0, 0, 0, 0, 0}, {5}));
  double before = loaded_t(rows_of(solid), {solid.moments(), {}}, RowKind::nominal);
  for (int most = 1; most <= 5; ++most) {
    const PocketChoice choice = chooser.choose(most).value();
    EXPECT_GE(choice.t, before);
    EXPECT_LE(choice.t, choice.bound_t + 1e-9);
    EXPECT_LT(choice.bound_t - choice.t, 0.1 * (choice.bound_t + 0.02)) << most;
    EXPECT_EQ(choice.inserts, most);
    for (std::size_t i = 0; i < choice.places.size(); ++i) {
      EXPECT_TRUE(fits.fits(choice.places[i]));
      for (std::size_t j = 0; j < i; ++j) EXPECT_TRUE(fits.are_apart(choice.places[i], choice.places[j]));
    }
    before = choice.t;
  }
}

TEST(Chooser, PutsABallIntoTheCornerOfABlockFarthestFromWhereItFalls) {
  const SolidMesh solid = test::solid_of(test::leaning_prism(40, 40, 60, 30));
  const PocketFits fits = fits_of(solid, {pocket_for(ball, 1, {})}, 1);
  PlaceChooser chooser(fits, fits.candidates(), rows_of(solid), solid.moments(), loads_of({0}, {1}));
  const PocketChoice choice = chooser.choose(1).value();
  ASSERT_EQ(choice.places.size(), 1u);
  const Vec3 at = choice.places.front().floor_mm;
  // It leans along +x, and its sides at -x with it, by half its height.
  const Pocket& pocket = fits.pockets().front();
  const double least_x = -20 + 0.5 * (at.z + pocket.height_mm) + 1.6 * std::sqrt(1.25) + pocket.radius_mm;
  EXPECT_LT(at.z, 1.6 + 1e-9);
  EXPECT_GE(at.x, least_x - 1e-9);
  EXPECT_LT(at.x, least_x + 1);
}

TEST(Chooser, DoesAsWellOnAModelThatIsTurnedOrMirrored) {
  const TriangleMesh mesh = test::leaning_prism(34, 40, 60, 22);
  Affine3 mirrored;
  mirrored.linear.rows[0] = {-1, 0, 0};
  double first = 0;
  for (const Affine3& move :
       {Affine3{}, test::rotation({0, 0, 1}, std::acos(-1.0)), mirrored, test::translation({64, -32, 0})}) {
    const SolidMesh solid = test::solid_of(transformed(mesh, move));
    const PocketFits fits = fits_of(solid, {pocket_for(ball, 1, {}), pocket_for(ball, 2, {})}, 1.5);
    PlaceChooser chooser(fits, fits.candidates(), rows_of(solid), solid.moments(), loads_of({0, 0}, {3}));
    const double t = chooser.choose(3)->t;
    if (first == 0) first = t;
    EXPECT_NEAR(t, first, 1e-3 * first);
  }
}

TEST(Chooser, StopsWhenItIsToldTo) {
  const SolidMesh solid = test::solid_of(test::leaning_prism(34, 40, 60, 22));
  const std::vector<Pocket> pockets{pocket_for(ball, 1, {})};
  test::CancelAt first(1), second(8);
  EXPECT_EQ(PocketFits::make(solid, pockets, {}, first.job()).error().code, ErrorCode::cancelled);
  const PocketFits fits = fits_of(solid, pockets, 3);
  PlaceChooser chooser(fits, fits.candidates(), rows_of(solid), solid.moments(), loads_of({0}, {3}));
  EXPECT_EQ(chooser.choose(3, second.job()).error().code, ErrorCode::cancelled);
}

}  // namespace
}  // namespace aplomb
