// 3MF: units, transforms, components, the production extension, and what slicers add.
#include <gtest/gtest.h>

#include <algorithm>

#include "aplomb/mesh/mass_properties.h"
#include "support/mesh_files.h"
#include "support/zip_files.h"

namespace aplomb::test {
namespace {

MeshFile read_package(const std::string& bytes) {
  auto file = read_text(bytes, "a.3mf");
  EXPECT_TRUE(file) << file.error().message;
  return file.value();
}

Moments moments_of_model(std::string_view resources, std::string_view build, std::string_view unit = "millimeter") {
  return moments(read_package(package(model_xml(resources, build, unit))).objects.at(0).mesh);
}

TEST(Threemf, EveryUnitIsTurnedIntoMillimetres) {
  for (const auto& [unit, factor] : {std::pair{"micron", 0.001},
                                     {"millimeter", 1.0},
                                     {"centimeter", 10.0},
                                     {"inch", 25.4},
                                     {"foot", 304.8},
                                     {"meter", 1000.0}}) {
    const MeshFile file = read_package(package(model_xml(tetrahedron_object(1), "<item objectid=\"1\"/>", unit)));
    EXPECT_TRUE(file.unit_known);
    EXPECT_EQ(file.unit_mm, factor);
    EXPECT_NEAR(moments(file.objects[0].mesh).volume_mm3 / (factor * factor * factor), 1.0 / 6, 1e-12) << unit;
  }
}

TEST(Threemf, TransformsMultiplyRowVectorsFromTheRight) {
  // x goes to y, y to z, z to x, then (10, 20, 30) is added.
  const auto file = read_package(
      package(model_xml(tetrahedron_object(1), "<item objectid=\"1\" transform=\"0 1 0 0 0 1 1 0 0 10 20 30\"/>")));
  const std::vector<Vec3> expected{{10, 20, 30}, {10, 21, 30}, {10, 20, 31}, {11, 20, 30}};
  EXPECT_EQ(file.objects[0].mesh.vertices, expected);
}

TEST(Threemf, NestedTransformsComposeFromTheInside) {
  const std::string parts =
      tetrahedron_object(1) +
      "<object id=\"2\"><components><component objectid=\"1\" transform=\"2 0 0 0 2 0 0 0 2 1 0 0\"/>"
      "</components></object>";
  const Moments whole = moments_of_model(parts, "<item objectid=\"2\" transform=\"0 1 0 -1 0 0 0 0 1 0 0 5\"/>");
  EXPECT_NEAR(whole.volume_mm3, 8.0 / 6, 1e-12);
  // The centroid (1/4, 1/4, 1/4) goes to (3/2, 1/2, 1/2), then a quarter turn about z and up by 5.
  EXPECT_NEAR(whole.centroid_mm().x, -0.5, 1e-12);
  EXPECT_NEAR(whole.centroid_mm().y, 1.5, 1e-12);
  EXPECT_NEAR(whole.centroid_mm().z, 5.5, 1e-12);
}

TEST(Threemf, MirroringNeverTurnsASolidInsideOut) {
  const std::string mirror = "transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"";
  const std::string parts = tetrahedron_object(1) + "<object id=\"2\"><components><component objectid=\"1\" " + mirror +
                            "/></components></object>";
  EXPECT_NEAR(moments_of_model(parts, "<item objectid=\"1\" " + mirror + "/>").volume_mm3, 1.0 / 6, 1e-12);
  EXPECT_NEAR(moments_of_model(parts, "<item objectid=\"2\"/>").volume_mm3, 1.0 / 6, 1e-12);
  EXPECT_NEAR(moments_of_model(parts, "<item objectid=\"2\" " + mirror + "/>").volume_mm3, 1.0 / 6, 1e-12);
}

TEST(Threemf, TheProductionExtensionFindsObjectsInOtherPartsWithTheirOwnUnits) {
  const std::string other = model_xml(tetrahedron_object(1), "", "centimeter");
  const std::string parts =
      "<object id=\"7\"><components><component p:path=\"/3D/Objects/a.model\" objectid=\"1\" transform=\"1 0 0 0 1 0 0 "
      "0 1 "
      "4 0 0\"/></components></object>";
  const auto file = read_package(package(model_xml(parts, "<item objectid=\"7\"/>"), {{"3D/Objects/a.model", other}}));
  EXPECT_NEAR(moments(file.objects[0].mesh).volume_mm3, 1000.0 / 6, 1e-9);
  EXPECT_EQ(bounding_box(file.objects[0].mesh).min, (Vec3{4, 0, 0}));
}

TEST(Threemf, EveryBuildItemIsAnObjectAndWhatTheBuildDoesNotUseIsNot) {
  const auto file = read_package(
      package(model_xml(tetrahedron_object(1, "name=\"left\"") + tetrahedron_object(2, "name=\"right\"") +
                            tetrahedron_object(3) + tetrahedron_object(4, "type=\"support\""),
                        "<item objectid=\"2\"/><item objectid=\"1\"/><item objectid=\"2\"/><item objectid=\"4\"/>")));
  ASSERT_EQ(file.objects.size(), 3u);
  EXPECT_EQ(file.objects[0].name, "right");
  EXPECT_EQ(file.objects[1].name, "left");
  EXPECT_EQ(file.notes.size(), 2u);  // the support, and the object without a build item
}

TEST(Threemf, APrefixedCoreNamespaceIsUnderstoodAndForeignElementsAreNot) {
  std::string xml = model_xml(tetrahedron_object(1), "<item objectid=\"1\"/>");
  std::string prefixed;
  for (std::size_t i = xml.find("<model"); i < xml.size(); ++i) {
    prefixed += xml[i];
    if (xml[i] == '<') prefixed += xml[i + 1] == '/' ? (++i, "/c:") : "c:";
  }
  prefixed.replace(prefixed.find("xmlns="), 6, "xmlns:c=");
  prefixed.insert(prefixed.find("</c:vertices>"), "<x:vertex x=\"9\" y=\"9\" z=\"9\"/>");
  EXPECT_EQ(read_package(package(prefixed)).objects[0].mesh.vertices.size(), 4u);
}

TEST(Threemf, PrusaSlicersNegativeVolumesAndModifiersAreLeftOutWithANote) {
  // Two tetrahedra in one mesh: the second is triangles 0..3 once more, over four vertices of its own.
  std::string object = tetrahedron_object(1);
  const std::string vertices =
      object.substr(object.find("<vertex "), object.find("</vertices>") - object.find("<vertex "));
  object.insert(object.find("</vertices>"), vertices);
  object.insert(object.find("</triangles>"), "<triangle v1=\"4\" v2=\"5\" v3=\"6\"/>");
  const std::string config =
      "<config><object id=\"1\"><metadata type=\"object\" key=\"name\" value=\"cup\"/>"
      "<volume firstid=\"0\" lastid=\"3\"><metadata key=\"volume_type\" value=\"ModelPart\"/></volume>"
      "<volume firstid=\"4\" lastid=\"4\"><metadata key=\"volume_type\" "
      "value=\"NegativeVolume\"/></volume></object></config>";
  const auto file =
      read_package(package(model_xml(object, "<item objectid=\"1\"/>"), {{"Metadata/Slic3r_PE_model.config", config}}));
  EXPECT_EQ(file.objects[0].name, "cup");
  EXPECT_EQ(file.objects[0].mesh.triangles.size(), 4u);
  EXPECT_EQ(file.objects[0].mesh.vertices.size(), 4u);
  EXPECT_TRUE(std::any_of(file.notes.begin(), file.notes.end(),
                          [](const auto& n) { return n.find("NegativeVolume") != n.npos; }));
}

TEST(Threemf, BambuStudiosModifierPartsAreLeftOut) {
  const std::string parts = tetrahedron_object(1) + tetrahedron_object(2) +
                            "<object id=\"3\"><components><component objectid=\"1\"/><component objectid=\"2\" "
                            "transform=\"1 0 0 0 1 0 0 0 1 9 9 9\"/></components></object>";
  const std::string config =
      "<config><object id=\"3\"><part id=\"1\" subtype=\"normal_part\"/>"
      "<part id=\"2\" subtype=\"modifier_part\"/></object></config>";
  const auto file =
      read_package(package(model_xml(parts, "<item objectid=\"3\"/>"), {{"Metadata/model_settings.config", config}}));
  EXPECT_EQ(bounding_box(file.objects[0].mesh).max, (Vec3{1, 1, 1}));
}

TEST(Threemf, AWrittenNameSurvivesWhateverCharactersItHas) {
  const std::string name = "a \"b\" <c> & d's \xC3\xA4";
  const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  const auto bytes = encode_mesh(mesh, MeshFormat::three_mf, {.name = name, .on_temp_file = {}});
  EXPECT_EQ(read_mesh(*bytes, "x.3mf")->objects[0].name, name);
}

}  // namespace
}  // namespace aplomb::test
