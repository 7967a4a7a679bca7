// What a child process sends may be cut off or wrong: never read beyond, never believed.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <random>

#include "aplomb/core/isolated.h"
#include "aplomb/mesh/detail/mesh_bytes.h"
#include "aplomb/mesh/tet_mesh.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

const TriangleMesh mesh = test::sphere({0, 0, 0}, 10, 2);

Result<TriangleMesh> unpacked(const std::string& bytes) {
  std::size_t at = 0;
  return detail::unpacked(bytes, at);
}

TEST(SpoiltBytes, OfAMeshCutOffAnywhereAreAThirdPartysError) {
  const std::string whole = detail::packed(mesh);
  EXPECT_EQ(unpacked(whole).value(), mesh);
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 50) {
    const auto cut = unpacked(whole.substr(0, size));
    ASSERT_FALSE(cut.has_value()) << size;
    EXPECT_EQ(cut.error().code, ErrorCode::third_party);
  }
}

TEST(SpoiltBytes, OfAMeshGiveAnErrorOrTrianglesOfVerticesThatAreThere) {
  const std::string whole = detail::packed(mesh);
  std::mt19937 random(5);
  int refused = 0;
  for (int n = 0; n < 2000; ++n) {
    std::string bytes = whole;
    for (int flips = 1 + n % 3; flips > 0; --flips)
      bytes[random() % (n % 2 ? bytes.size() : 8)] ^= static_cast<char>(1U << random() % 8);
    const auto read = unpacked(bytes);
    refused += !read;
    if (!read) continue;
    for (const Triangle& t : read->triangles)
      for (const std::uint32_t v : t) ASSERT_LT(v, read->vertices.size());
  }
  EXPECT_GT(refused, 500);
}

TEST(SpoiltBytes, OfTetrahedraWithNegativeCountsOrCornersAreRefused) {
  std::string bytes;
  detail::put(bytes, std::vector<TetMesh::Tet>{{0, 1, 2, 3}, {0, 1, 2, static_cast<std::uint32_t>(-1)}});
  std::size_t at = 0;
  EXPECT_FALSE(detail::take_cells<TetMesh::Tet>(bytes, at, 4).has_value());
  const std::size_t negative = static_cast<std::size_t>(-1);
  bytes.assign(reinterpret_cast<const char*>(&negative), sizeof negative);
  at = 0;
  EXPECT_FALSE(detail::take<Vec3>(bytes, at).has_value());
  EXPECT_FALSE(detail::take<Vec3>(bytes, at = bytes.size() + 1).has_value());
}

TEST(SpoiltBytes, OfAChildThatEndsBeforeAllIsSaidAreAThirdPartysError) {
  const auto result = run_isolated(
      []() -> std::string {
        std::string much(256'000'000, 'x');
        std::signal(SIGALRM, [](int) { _exit(3); });
        ualarm(5'000, 0);  // while it is sent
        return much;
      },
      {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error().code, ErrorCode::third_party);
}

}  // namespace
}  // namespace aplomb
