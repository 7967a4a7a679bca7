// A host program may write its numbers with a comma: what libraries read of ours is the same.
#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>

#include "aplomb/adapters/tetgen/tetrahedralize.h"
#include "support/mesh_files.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

/// LC_NUMERIC with a comma for as long as this lives: a locale of the system's, or one compiled into a folder.
class CommaLocale {
 public:
  CommaLocale() {
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE", "fr_FR"})
      if (std::setlocale(LC_NUMERIC, name)) return;
    const std::string made = "localedef -i de_DE -f UTF-8 " + (folder_.path() / "de_DE.UTF-8").string();
    if (std::system((made + " >/dev/null 2>&1").c_str()) != 0) return;
    setenv("LOCPATH", folder_.path().c_str(), 1);
    std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  }
  ~CommaLocale() {
    std::setlocale(LC_NUMERIC, "C");
    unsetenv("LOCPATH");
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;
  bool is_set() const { return std::strtod("1,5", nullptr) == 1.5; }

 private:
  test::TempFolder folder_;
};

TEST(Locale, WithADecimalCommaTetGenGetsTheSameNumbers) {
  const TriangleMesh cube = test::box({0, 0, 0}, {4, 4, 4});
  const auto tets = [&] { return adapters::tetrahedralize(cube, {}, {.most_mm3 = 0.45}, {.seconds = 20}); };
  const auto expected = tets();
  ASSERT_TRUE(expected.has_value()) << expected.error().message;
  const CommaLocale comma;
  ASSERT_TRUE(comma.is_set()) << "no locale with a comma could be made: install locales";
  const auto got = tets();
  ASSERT_TRUE(got.has_value()) << got.error().message;
  EXPECT_EQ(got->vertices, expected->vertices);
  EXPECT_EQ(got->tets, expected->tets);
}

}  // namespace
}  // namespace aplomb
