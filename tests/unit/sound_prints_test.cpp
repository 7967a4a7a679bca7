// Shapes that print, against every check by slices: none may say otherwise.
#include <gtest/gtest.h>

#include <string>

#include "aplomb/io/read_mesh.h"
#include "aplomb/printability/print_stands.h"
#include "aplomb/printability/strength_ankle.h"
#include "aplomb/printability/void_base.h"
#include "aplomb/printability/void_bridge.h"
#include "aplomb/printability/void_cup.h"
#include "aplomb/printability/void_island.h"
#include "aplomb/printability/void_slope.h"
#include "support/prints.h"

namespace aplomb {
namespace {

void expect_sound(const TriangleMesh& mesh, double layer_mm) {
  const auto& [printed, slices] = test::print_of(mesh, layer_mm);
  const Rules fdm(Process::fdm), sla(Process::sla);
  EXPECT_TRUE(measure_void_bridge(printed, slices, fdm)->empty());
  EXPECT_TRUE(measure_void_base(printed, slices, fdm)->empty());
  EXPECT_TRUE(measure_void_cup(printed, slices, sla)->empty());
  for (const Rules& rules : {fdm, sla}) {
    EXPECT_TRUE(measure_void_slope(printed, slices, rules)->empty());
    EXPECT_TRUE(measure_void_island(printed, slices, rules)->empty());
  }
  EXPECT_GT(measure_print_stands(printed, slices, fdm)->front().measured, 0.3);
  const std::vector<Place> ankles = measure_strength_ankle(printed, slices, fdm, 1.24).value();
  EXPECT_TRUE(ankles.empty() || ankles.front().measured < 16.5);
}

TEST(SoundPrints, simple_shapes_raise_nothing) {
  for (const double layer_mm : {0.1, 0.2}) {
    expect_sound(test::box({}, {20, 20, 20}), layer_mm);
    expect_sound(test::box({}, {60, 60, 0.9}), layer_mm);
    expect_sound(test::sphere({}, 20, 4), layer_mm);
    expect_sound(test::cone({}, 12, 40, 64), layer_mm);
    expect_sound(test::star_prism(16, 20, 16, 10), layer_mm);
    expect_sound(test::ring({{5, 0}, {20, 0}, {20, 8}, {5, 8}}, 64), layer_mm);
  }
}

TEST(SoundPrints, figures_that_stand_raise_nothing) {
  for (const std::string name : {"snowman", "knight", "tumbler", "giraffe"}) {
    SCOPED_TRACE(name);
    expect_sound(read_mesh(std::string(APLOMB_FIXTURES) + "/" + name + ".stl").value().objects.front().mesh, 0.2);
  }
}

}  // namespace
}  // namespace aplomb
