// 3MF with a modifier volume, in the words of each slicer.
#include <gtest/gtest.h>

#include <algorithm>

#include "aplomb/io/read_mesh.h"
#include "aplomb/io/write_mesh.h"
#include "support/shapes.h"
#include "support/zip_files.h"

namespace aplomb::test {
namespace {

constexpr Flavor flavors[] = {Flavor::prusaslicer, Flavor::orca, Flavor::cura};

WriteOptions options_for(Flavor flavor, double infill_ratio = 1) {
  WriteOptions options;
  options.name = "A & B";
  options.modifier = InfillModifier{flavor, box({5, -1, -1}, {11, 11, 11}), infill_ratio, std::nullopt};
  return options;
}

std::vector<std::byte> encoded(const WriteOptions& options) {
  return encode_mesh(box({0, 0, 0}, {10, 10, 10}), MeshFormat::three_mf, options).value();
}

TEST(Modifier3mf, IsNoPartOfThePrintWhenItIsReadBack) {
  for (const Flavor flavor : flavors) {
    const auto back = read_mesh(encoded(options_for(flavor)), "a.3mf");
    ASSERT_TRUE(back) << back.error().message;
    ASSERT_EQ(back->objects.size(), 1u);
    const TriangleMesh cube = box({0, 0, 0}, {10, 10, 10}), &mesh = back->objects.front().mesh;
    ASSERT_EQ(mesh.triangles.size(), cube.triangles.size());
    for (std::size_t i = 0; i < cube.triangles.size(); ++i)
      for (int corner = 0; corner < 3; ++corner)
        EXPECT_EQ(mesh.vertices[mesh.triangles[i][corner]], cube.vertices[cube.triangles[i][corner]]);
    EXPECT_TRUE(std::ranges::any_of(back->notes, [](const auto& note) { return note.ends_with("was left out"); }));
  }
}

TEST(Modifier3mf, SaysItsInfillInTheSlicersWords) {
  WriteOptions options = options_for(Flavor::prusaslicer);
  const std::string solid = part_of(encoded(options), "Metadata/Slic3r_PE_model.config");
  EXPECT_NE(solid.find(R"(key="fill_density" value="100%")"), solid.npos) << solid;
  EXPECT_NE(solid.find(R"(key="fill_pattern" value="rectilinear")"), solid.npos);
  EXPECT_NE(solid.find("A &amp; B"), solid.npos);
  EXPECT_EQ(solid.find(R"(type="object" key="fill_density")"), solid.npos);
  options.modifier->infill_ratio = 0.8;
  options.modifier->rest_ratio = 0.05;
  const std::string both = part_of(encoded(options), "Metadata/Slic3r_PE_model.config");
  EXPECT_NE(both.find(R"(type="volume" key="fill_density" value="80%")"), both.npos) << both;
  EXPECT_NE(both.find(R"(type="object" key="fill_density" value="5%")"), both.npos);
  EXPECT_EQ(both.find("rectilinear"), both.npos);
  options.modifier->flavor = Flavor::orca;
  const std::string orca = part_of(encoded(options), "Metadata/model_settings.config");
  EXPECT_NE(orca.find(R"(subtype="modifier_part")"), orca.npos) << orca;
  EXPECT_NE(orca.find(R"(key="sparse_infill_density" value="80%")"), orca.npos);
  options.modifier->flavor = Flavor::cura;
  const std::string cura = part_of(encoded(options), "3D/3dmodel.model");
  EXPECT_NE(cura.find(R"(<metadata name="cura:infill_mesh" type="xs:string" preserve="true">True</metadata>)"),
            cura.npos);
}

TEST(Modifier3mf, TheSameModifierGivesTheSameBytes) {
  for (const Flavor flavor : flavors) EXPECT_EQ(encoded(options_for(flavor)), encoded(options_for(flavor)));
}

TEST(Modifier3mf, FurtherPartsAreWrittenAndDoNotChangeTheModel) {
  WriteOptions options;
  options.parts.push_back({"Metadata/notes.xml", "<notes/>"});
  EXPECT_EQ(part_of(encoded(options), "Metadata/notes.xml"), "<notes/>");
  EXPECT_EQ(part_of(encoded(options), "3D/3dmodel.model"), part_of(encoded({}), "3D/3dmodel.model"));
  EXPECT_NE(part_of(encoded(options), "[Content_Types].xml").find(R"(Extension="xml")"), std::string::npos);
}

TEST(Modifier3mf, OtherFormatsRefuseIt) {
  const auto stl = encode_mesh(box({0, 0, 0}, {1, 1, 1}), MeshFormat::stl, options_for(Flavor::cura));
  ASSERT_FALSE(stl);
  EXPECT_EQ(stl.error().code, ErrorCode::invalid_option);
}

}  // namespace
}  // namespace aplomb::test
