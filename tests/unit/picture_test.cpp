#include "picture.h"

#include <gtest/gtest.h>

#include <set>

#include <cmath>
#include <numbers>
#include <numeric>
#include <string_view>

#include "aplomb/mesh/mass_properties.h"
#include "comparison.h"
#include "figure.h"
#include "support/shapes.h"

namespace aplomb::picture {
namespace {

double area_mm2(const std::vector<float>& share, const Rendering& r) {
  return std::accumulate(share.begin(), share.end(), 0.0) * r.mm_per_pixel * r.mm_per_pixel;
}

View small_view() {
  View view;
  view.width = view.height = 240;
  view.plate = false;
  return view;
}

TEST(Picture, a_sphere_covers_the_area_of_its_great_circle) {
  Subject subject;
  subject.mesh = test::sphere({3, 4, 20}, 20, 5);
  const Rendering r = render(subject, small_view());
  EXPECT_NEAR(area_mm2(r.figure_share, r) / (std::numbers::pi * 400), 1, 0.01);
}

TEST(Picture, a_cut_through_a_cube_has_its_area_foreshortened_by_the_view) {
  Subject subject;
  subject.mesh = test::box({-10, -10, 0}, {10, 10, 20});
  View view = small_view();
  view.cut = Cut{{0, 0, 10}, {0, -1, 0}};
  for (const double azimuth : {-std::numbers::pi / 2, -1.0}) {
    view.azimuth_rad = azimuth;
    view.elevation_rad = 0.3;
    const double seen = -std::cos(0.3) * std::sin(azimuth);
    const Rendering r = render(subject, view);
    EXPECT_NEAR(area_mm2(r.cut_share, r) / (400 * seen), 1, 0.01);
  }
}

TEST(Picture, a_void_is_not_filled_by_the_cut) {
  Subject subject;
  subject.mesh = test::with_void(test::sphere({0, 0, 20}, 20, 5), test::sphere({0, 0, 20}, 12, 5));
  View view = small_view();
  view.azimuth_rad = 0;
  view.elevation_rad = 0;
  view.cut = Cut{{0, 0, 20}, {1, 0, 0}};
  const Rendering r = render(subject, view);
  EXPECT_NEAR(area_mm2(r.cut_share, r) / (std::numbers::pi * (400 - 144)), 1, 0.01);
  const auto middle = static_cast<std::size_t>(120 * 240 + 120);
  EXPECT_EQ(r.cut_share[middle], 0);
  EXPECT_EQ(r.figure_share[middle], 1);  // the void's far wall
}

TEST(Picture, bodies_that_overlap_are_cut_as_one) {
  Subject subject;
  subject.mesh = joined(test::box({-10, -10, 0}, {4, 10, 20}), test::box({-4, -10, 0}, {10, 10, 20}));
  View view = small_view();
  view.azimuth_rad = -std::numbers::pi / 2;
  view.elevation_rad = 0;
  view.cut = Cut{{0, 0, 10}, {0, -1, 0}};
  const Rendering r = render(subject, view);
  EXPECT_NEAR(area_mm2(r.cut_share, r) / 400, 1, 0.01);
}

TEST(Picture, a_second_run_draws_the_same_bytes) {
  Subject subject;
  subject.mesh = test::cone({0, 0, 0}, 10, 25, 40);
  View view;
  view.width = view.height = 80;
  EXPECT_EQ(render(subject, view).image.rgb, render(subject, view).image.rgb);
}

TEST(Picture, a_box_topples_onto_its_side_without_changing_shape) {
  Subject subject;
  subject.mesh = test::box({0, 0, 0}, {10, 20, 40});
  const Subject fallen = toppled(subject, {10, 0}, {10, 20});  // the edge at x = 10, the box on its left
  const Box3 box = bounding_box(fallen.mesh);
  EXPECT_NEAR(box.min.x, 10, 1e-9);
  EXPECT_NEAR(box.max.x, 50, 1e-9);
  EXPECT_NEAR(box.min.z, 0, 1e-9);
  EXPECT_NEAR(box.max.z, 10, 1e-9);
  EXPECT_NEAR(moments(fallen.mesh).volume_mm3, 8000, 1e-6);
}

TEST(Picture, text_leaves_ink_only_near_its_line) {
  Image image{200, 60, std::vector<std::uint8_t>(200 * 60 * 3, 255)};
  draw_text(image, 100, 40, 20, "12.5\xC2\xB0", {0, 0, 0});
  int ink = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 200; ++x) {
      if (image.rgb[static_cast<std::size_t>(3 * (y * 200 + x))] > 128) continue;
      ++ink;
      EXPECT_TRUE(y >= 17 && y <= 43 && x >= 50 && x <= 150) << x << ' ' << y;
    }
  }
  EXPECT_GT(ink, 100);
}

/// However it is held, a body comes to rest with its centre of mass below the thread, or below the line through both.
TEST(Picture, a_body_hangs_with_its_centre_of_mass_below_the_threads) {
  const TriangleMesh box = test::box({0, 0, 0}, {30, 10, 10});
  for (const Vec3 up : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}, Vec3{0, -1, 0}}) {
    const auto one = hung(box, {.up = up, .attachments_mm = {{2, 3, 10}}});
    ASSERT_TRUE(one);
    const Vec3 thread = one->subject.threads_mm.at(0) - *one->subject.com_mm;
    EXPECT_NEAR(std::hypot(thread.x, thread.y), 0, 1e-9);
    EXPECT_NEAR(thread.z, norm(Vec3{2, 3, 10} - Vec3{15, 5, 5}), 1e-9);
    EXPECT_NEAR(bounding_box(one->subject.mesh).min.z, 0, 1e-9);
  }
  const auto two = hung(box, {.attachments_mm = {{2, 3, 10}, {20, 3, 10}}});
  ASSERT_TRUE(two);
  const Vec3 p = two->subject.threads_mm.at(0), q = two->subject.threads_mm.at(1), com = *two->subject.com_mm;
  const Vec3 along = normalized(q - p), thread = p - com - dot(along, p - com) * along;
  EXPECT_NEAR(p.z, q.z, 1e-9);
  EXPECT_NEAR(std::hypot(thread.x, thread.y), 0, 1e-9);
  EXPECT_GT(thread.z, 0);
}

/// In the pose's own coordinates: the model's top is at the bottom of the picture when it stands on its head.
TEST(Picture, a_mark_is_drawn_where_the_pose_puts_it) {
  const TriangleMesh box = test::box({0, 0, 5}, {10, 10, 25});
  const auto rows_with_a_mark = [&](Vec3 up, Vec3 at) {
    const std::vector<Pose> poses{{.way = StandingPose{.up = up}}};
    const Image plain = as_it_is(box, poses, 100).value(), marked = as_it_is(box, poses, 100, {{at, "1"}}).value();
    std::set<int> rows;
    for (std::size_t i = 0; i < plain.rgb.size(); ++i)
      if (plain.rgb[i] != marked.rgb[i]) rows.insert(static_cast<int>(i / 3) / plain.width);
    return rows;
  };
  const auto upright = rows_with_a_mark({0, 0, 1}, {5, 5, 24}), head_down = rows_with_a_mark({0, 0, -1}, {5, 5, 24});
  ASSERT_FALSE(upright.empty() || head_down.empty());
  EXPECT_LT(*upright.rbegin(), *head_down.begin());
}

TEST(Picture, before_and_after_has_a_row_for_every_pose) {
  const TriangleMesh box = test::box({0, 0, 0}, {10, 10, 20});
  const std::vector<Pose> poses{{.name = "feet"}, {.way = HangingPose{.attachments_mm = {{1, 1, 20}}}}};
  const auto image = before_and_after(box, box, poses, 50);
  ASSERT_TRUE(image);
  EXPECT_EQ(image->width, 150);
  EXPECT_EQ(image->height, 2 * 55);
  EXPECT_EQ(as_it_is(box, poses, 50)->width, 100);
  const auto stopped = before_and_after(box, box, poses, 50, {}, Job([](double, std::string_view) { return false; }));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

TEST(Picture, is_encoded_with_its_colour_space_and_to_its_end) {
  const auto bytes = encode_png(Image{2, 1, {255, 0, 0, 0, 0, 255}});
  ASSERT_TRUE(bytes);
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  EXPECT_EQ(text.substr(1, 3), "PNG");
  EXPECT_NE(text.find("sRGB"), std::string_view::npos);
  EXPECT_EQ(text.substr(text.size() - 8, 4), "IEND");  // then its check sum
}

TEST(Picture, that_cannot_be_encoded_says_so_and_one_that_is_stopped_is_cancelled) {
  const auto empty = encode_png(Image{0, 0, {}});
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::third_party);
  EXPECT_NE(empty.error().message.find("IHDR"), std::string::npos) << empty.error().message;
  const auto stopped = encode_png(Image{1, 1, {0, 0, 0}}, Job([](double, std::string_view) { return false; }));
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::cancelled);
}

TEST(Picture, a_folder_that_is_not_there_is_a_file_system_error) {
  const auto written = write_png("no/such/folder/picture.png", Image{1, 1, {0, 0, 0}});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::file_system);
}

}  // namespace
}  // namespace aplomb::picture
