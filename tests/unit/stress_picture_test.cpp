#include "stress_picture.h"

#include <gtest/gtest.h>

#include "aplomb/printability/judge.h"
#include "page.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

double luminance(picture::Colour c) {
  return 0.2126 * double(c.red) + 0.7152 * double(c.green) + 0.0722 * double(c.blue);
}

TEST(StressPicture, darkens_with_every_band_and_stays_at_its_ends_beyond_them) {
  for (int band = 1; band < picture::scale_bands; ++band)
    EXPECT_LT(luminance(picture::scale_colour((band + 0.5) / picture::scale_bands)),
              0.85 * luminance(picture::scale_colour((band - 0.5) / picture::scale_bands)));
  EXPECT_EQ(luminance(picture::scale_colour(-1)), luminance(picture::scale_colour(0)));
  EXPECT_EQ(luminance(picture::scale_colour(7)), luminance(picture::scale_colour(0.99)));
}

TEST(StressPicture, is_on_the_page_where_there_are_stresses_and_only_there) {
  const TriangleMesh post = test::box({-4, -4, 0}, {4, 4, 60});
  page::PageContent content{.title = "post", .after = &post, .poses = {Pose{}}};
  content.judgement = Judgement{};
  EXPECT_EQ(page::html_page(content).value().find("Where it is stressed"), std::string::npos);
  content.judgement->stress = StressField{post, std::vector<double>(8, 3.0), 5};
  EXPECT_NE(page::html_page(content).value().find("exceeds 5 MPa"), std::string::npos);
}

}  // namespace
}  // namespace aplomb
