#include "aplomb/carve/kept_parts.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "aplomb/carve/flat_ceilings.h"
#include "aplomb/carve/ribs.h"
#include "aplomb/carve/void_field.h"
#include "support/shapes.h"
#include "support/solids.h"

namespace aplomb {
namespace {

constexpr AffineForm carve_all{-1, {}};

SolidVolume volume_of(const TriangleMesh& mesh) {
  return voxelize(test::solid_of(mesh), {.wall_mm = 2, .voxel_mm = 0.5, .least_void_mm = 0}).value();
}

double void_mm3(const SolidVolume& volume) { return cut_void(volume, carve_all, 0)->field.moments().volume_mm3; }

TEST(KeptParts, take_their_own_volume_from_the_void) {
  const SolidVolume volume = volume_of(test::box({0, 0, 0}, {40, 40, 40}));
  const double all = void_mm3(volume);
  const Box3 middle{{15.1, 14.3, 13.7}, {25.4, 22.2, 31.3}};
  EXPECT_NEAR(all - void_mm3(without(volume, {kept_box(middle)})), 10.3 * 7.9 * 17.6, 0.01 * 10.3 * 7.9 * 17.6);
  EXPECT_EQ(void_mm3(without(volume, {})), all);
  EXPECT_EQ(void_mm3(without(volume, {kept_box({{100, 100, 100}, {120, 120, 120}})})), all);
  EXPECT_EQ(void_mm3(without(volume, {kept_box({{-1, -1, -1}, {41, 41, 41}})})), 0);
}

TEST(KeptParts, only_ever_take_from_what_may_be_carved) {
  const SolidVolume volume = volume_of(test::sphere({0, 0, 20}, 20, 3));
  const KeptPart half = kept_box({{-30, -30, 20}, {30, 30, 50}});
  const VoidField all = cut_void(volume, carve_all, 0)->field,
                  lower = cut_void(without(volume, {half}), carve_all, 0)->field;
  EXPECT_NEAR(lower.moments().volume_mm3, all.moments().volume_mm3 / 2, 0.01 * all.moments().volume_mm3);
  EXPECT_LT(lower.moments().first_mm4.z / lower.moments().volume_mm3, 20);
}

/// What another plane opens beside a part that is solid now is as closed as any void.
TEST(WithoutPart, leaves_a_closed_surface_to_whatever_is_carved_next) {
  const SolidVolume volume = volume_of(test::box({0, 0, 0}, {40, 40, 40}));
  const double all = void_mm3(volume);
  for (double cut_mm = 17; cut_mm < 21; cut_mm += 0.5) {
    SCOPED_TRACE(cut_mm);
    const VoidField upper = cut_void(volume, {cut_mm, {-1, 0, 0}}, 0)->field;  // carved where x > cut_mm
    const SolidVolume lower = without_part(volume, upper, {30, 20, 20}, 1e9);
    const VoidField rest = cut_void(lower, carve_all, 0)->field;
    EXPECT_NEAR(rest.moments().volume_mm3 + upper.moments().volume_mm3, all, 0.03 * all);
    const TriangleMesh mesh = marching_tetrahedra(boundary_cells(rest), rest.frame().voxel_mm, rest.frame().origin_mm);
    EXPECT_TRUE(check_solid(mesh)->solid);
  }
}

TEST(FlatCeilings, are_found_where_a_void_has_them_and_wide_where_a_circle_fits) {
  const TriangleMesh outer = test::box({-40, -40, 0}, {40, 40, 60});
  const TriangleMesh mesh = test::with_void(outer, test::box({-20, -5, 10}, {20, 5, 30}));
  const auto ceilings = flat_ceilings(mesh, outer.triangles.size(), 45, 0.5);
  ASSERT_EQ(ceilings.size(), 1u);
  const double area = 0.25 * double(std::ranges::count_if(ceilings[0].top_mm, [](double z) { return z == 30; }));
  EXPECT_NEAR(area, 400, 0.08 * 400);
  EXPECT_NEAR(0.25 * double(wide_cells(ceilings[0], 4).size()), 400, 0.1 * 400);
  EXPECT_TRUE(wide_cells(ceilings[0], 6).empty());
}

TEST(FlatCeilings, are_none_on_a_steep_roof) {
  const TriangleMesh outer = test::box({-40, -40, 0}, {40, 40, 60});
  const TriangleMesh mesh = test::with_void(outer, test::cone({0, 0, 10}, 15, 16, 64));
  EXPECT_TRUE(flat_ceilings(mesh, outer.triangles.size(), 45, 0.5).empty());
  EXPECT_EQ(flat_ceilings(mesh, outer.triangles.size(), 50, 0.5).size(), 1u);
}

/// Every place of a ceiling is near a rib, and what is kept of a rib stands on what is kept below it or beside it.
TEST(Ribs, leave_no_slot_wider_than_allowed_and_stand_by_themselves) {
  const TriangleMesh outer = test::box({0, 0, 0}, {50, 34, 60});
  const SolidVolume volume = volume_of(outer);
  const TriangleMesh inner = test::box({2.2, 2.2, 2.2}, {47.8, 31.8, 57.8});
  const auto ceiling = flat_ceilings(test::with_void(outer, inner), outer.triangles.size(), 45, 0.5).at(0);
  const RibOptions options{1, 9, 47, -5};
  const std::vector<int> cells = wide_cells(ceiling, 4);
  const auto ribs = ribs_under(ceiling, cells, ColumnCosts(volume, carve_all), options);
  ASSERT_GE(ribs.size(), 3u);
  const auto kept = [&](Vec3 p) {
    return std::ranges::any_of(ribs, [&](const KeptPart& rib) { return rib.depth_mm(p) > 0; });
  };
  double open = 0, all = 0;
  for (const int cell : cells) {
    const Vec2 p = ceiling.middle_mm(cell);
    double near = -std::min({p.x - 2.2, 47.8 - p.x, p.y - 2.2, 31.8 - p.y});  // the walls hold it, too
    for (const KeptPart& rib : ribs) near = std::max(near, rib.depth_mm({p.x, p.y, 57.5}));
    EXPECT_GE(near, -5.1) << p.x << " " << p.y;  // half a slot and a cell
    for (double z = 3; z < 57; z += 0.25) {
      ++all, open += !kept({p.x, p.y, z});
      if (!kept({p.x, p.y, z}) || kept({p.x, p.y, z - 0.5})) continue;
      const bool leans = kept({p.x - 0.5, p.y, z - 0.5}) || kept({p.x + 0.5, p.y, z - 0.5}) ||
                         kept({p.x, p.y - 0.5, z - 0.5}) || kept({p.x, p.y + 0.5, z - 0.5});
      EXPECT_TRUE(leans || p.x < 3 || p.x > 47 || p.y < 3 || p.y > 31) << p.x << " " << p.y << " " << z;
    }
  }
  EXPECT_GT(open, 0.4 * all);  // arches
}

}  // namespace
}  // namespace aplomb
