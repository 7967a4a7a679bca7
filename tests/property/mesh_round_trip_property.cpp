// Whatever mesh is written is read back.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "support/mesh_files.h"

namespace aplomb::test {
namespace {

/// Any finite float32, of every magnitude down to the denormals.
rc::Gen<double> any_float() {
  return rc::gen::map(rc::gen::suchThat(rc::gen::arbitrary<std::uint32_t>(),
                                        [](std::uint32_t bits) { return std::isfinite(std::bit_cast<float>(bits)); }),
                      [](std::uint32_t bits) { return static_cast<double>(std::bit_cast<float>(bits)); });
}

TriangleMesh any_mesh() {
  TriangleMesh mesh;
  const auto count = *rc::gen::inRange<std::uint32_t>(1, 40);
  for (std::uint32_t i = 0; i < count; ++i) mesh.vertices.push_back({*any_float(), *any_float(), *any_float()});
  const auto corner = rc::gen::inRange<std::uint32_t>(0, count);
  for (int i = *rc::gen::inRange(1, 60); i > 0; --i) mesh.triangles.push_back({*corner, *corner, *corner});
  return mesh;
}

TEST(MeshRoundTrip, IndexedFormatsKeepEveryFloatAndIndex) {
  EXPECT_TRUE(rc::check([] {
    const TriangleMesh mesh = any_mesh();
    const bool soup = mesh.vertices.size() == 3 * mesh.triangles.size();  // may be indexed anew
    RC_PRE(!soup);
    for (const MeshFormat format : {MeshFormat::three_mf, MeshFormat::obj, MeshFormat::ply}) {
      const auto file = read_mesh(*encode_mesh(mesh, format), "a");
      RC_ASSERT(file.has_value());
      RC_ASSERT(rounded_to_float(file->objects.at(0).mesh) == mesh);
    }
  }));
}

TEST(MeshRoundTrip, StlKeepsEveryCornerAndSharesEqualPositions) {
  EXPECT_TRUE(rc::check([] {
    const TriangleMesh mesh = any_mesh();
    const auto file = read_mesh(*encode_mesh(mesh, MeshFormat::stl), "a.stl");
    RC_ASSERT(file.has_value());
    const TriangleMesh& read = file->objects.at(0).mesh;
    RC_ASSERT(corner_positions(read) == corner_positions(mesh));
    for (std::size_t i = 0; i < read.vertices.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) RC_ASSERT(!(read.vertices[i] == read.vertices[j]));
  }));
}

TEST(MeshRoundTrip, AnyBytesWithAnyNameEndInAMeshOrAnError) {
  const std::vector<std::string> starts{"",      "solid\n", "ply\nformat ascii 1.0\n",
                                        "OFF\n", "v ",      std::string("PK\x03\x04", 4)};
  EXPECT_TRUE(rc::check([&] {
    const auto tail = *rc::gen::container<std::string>(rc::gen::arbitrary<char>());
    const auto name = *rc::gen::element<std::string>("a.stl", "a.obj", "a.ply", "a.off", "a.3mf", "-");
    const auto file = read_text(*rc::gen::elementOf(starts) + tail, name);
    if (file)
      for (const MeshObject& object : file->objects) corner_positions(object.mesh);
    else RC_ASSERT(!file.error().message.empty());
  }));
}

}  // namespace
}  // namespace aplomb::test
