// 3MF packages that no slicer should have written.
#include <gtest/gtest.h>

#include <filesystem>

#include "support/expect_refused.h"
#include "support/mesh_files.h"
#include "support/zip_files.h"

namespace aplomb::test {
namespace {

const std::string kGood = model_xml(tetrahedron_object(1), "<item objectid=\"1\"/>");

void expect_error(const std::string& bytes, ErrorCode code, std::string_view words) {
  expect_refused(bytes, "a.3mf", words, code);
}

void expect_unusable_model(const std::string& model, std::string_view words) {
  expect_error(package(model), ErrorCode::unusable_input, words);
}

std::string component(int object, std::string_view more = "") {
  return "<component objectid=\"" + std::to_string(object) + "\" " + std::string(more) + "/>";
}

std::string assembly(int id, const std::string& components) {
  return "<object id=\"" + std::to_string(id) + "\"><components>" + components + "</components></object>";
}

TEST(HostileThreemf, ThePackageThatTheOthersBreakIsGood) { EXPECT_TRUE(read_text(package(kGood), "a.3mf")); }

TEST(HostileThreemf, DocumentTypesAndEntityBombsAreErrors) {
  const std::string bomb = "<!DOCTYPE m [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;&a;&a;\">]>";
  std::string model = kGood;
  model.insert(model.find("<model"), bomb);
  expect_unusable_model(model, "document type");
  model = kGood;
  model.insert(model.find("<model"), "<!DOCTYPE model SYSTEM \"file:///etc/passwd\">");
  expect_unusable_model(model, "document type");
  expect_error(package(kGood, {{"Metadata/model_settings.config", bomb + "<config/>"}}), ErrorCode::unusable_input,
               "document type");
}

/// The good package with other relationships.
std::string package_related_by(const std::string& relationships) {
  return zip_of({{"_rels/.rels", relationships, true}, {"3D/3dmodel.model", kGood, true}});
}

TEST(HostileThreemf, RelationshipsKeepToTheRulesOfEveryPart) {
  const std::string root =
      "<Relationships><Relationship Target=\"/3D/3dmodel.model\" Type=\"http://x/3dmodel\"/></Relationships>";
  EXPECT_TRUE(read_text(package_related_by(root), "a.3mf"));
  expect_error(package_related_by("<!DOCTYPE r [<!ENTITY a \"aa\">]>" + root), ErrorCode::unusable_input,
               "part \"_rels/.rels\": it has a document type");
  std::string open, close;
  for (int i = 0; i < 1'000'000; ++i) open += "<a>", close += "</a>";
  expect_error(package_related_by(open), ErrorCode::unusable_input, "part \"_rels/.rels\", byte");
  EXPECT_TRUE(read_text(package_related_by("<Relationships>" + open + close + root.substr(15)), "a.3mf"));
  expect_error(package_related_by(std::string(150'000'000, ' ')), ErrorCode::over_budget, "part \"_rels/.rels\"");
}

TEST(HostileThreemf, WhatASlicerLeftToBeRunIsIgnoredAndSaidToBe) {
  const auto notes_of = [](const std::string& part) {
    const auto file = read_text(package(kGood, {{part, "post_process = rm -rf ~"}}), "a.3mf");
    return file && !file->notes.empty() ? file->notes.front() : "none";
  };
  for (const char* settings : {"Metadata/Slic3r_PE.config", "Metadata/project_settings.config", "Cura/preferences.cfg",
                               "Cura/machine_0.global.cfg", "Metadata/machine_settings_1.json"})
    EXPECT_NE(notes_of(settings).find("settings in the file (and any scripts in them) were ignored"), std::string::npos)
        << settings << notes_of(settings);
  for (const char* program : {"Metadata/plate_1.gcode", "x.GCODE", "Metadata/plate_2.bgcode"})
    EXPECT_NE(notes_of(program).find("G-code in the file was ignored"), std::string::npos) << program;
  EXPECT_EQ(notes_of("Metadata/thumbnail.png"), "none");
}

TEST(HostileThreemf, ALongNameIsCutBetweenTwoCharacters) {
  const std::string model =
      model_xml(tetrahedron_object(1, "name=\"" + std::string(999, 'n') + "\xC3\xA4\""), "<item objectid=\"1\"/>");
  const auto file = read_text(package(model), "a.3mf");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->objects.at(0).name, std::string(999, 'n'));
}

TEST(HostileThreemf, Utf16AndLatin1AreReadAsTheyDeclareThemselves) {
  std::string model = model_xml(tetrahedron_object(1, "name=\"B\xE4r\""), "<item objectid=\"1\"/>");
  model.replace(model.find("UTF-8"), 5, "ISO-8859-1");
  auto file = read_text(package(model), "a.3mf");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->objects.at(0).name, "B\xC3\xA4r");
  std::string wide = "\xFF\xFE";
  for (const char c : kGood) wide.append({c, '\0'});
  file = read_text(package(wide), "a.3mf");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(file->objects.at(0).mesh.triangles.size(), 4u);
}

TEST(HostileThreemf, XmlNestedAMillionDeepIsReadOrRefusedWithoutACrash) {
  std::string deep;
  for (int i = 0; i < 1'000'000; ++i) deep += "<a>";
  std::string model = kGood;
  model.insert(model.find("<build>"), deep);
  expect_unusable_model(model, "XML");
  std::string closed = deep;
  for (int i = 0; i < 1'000'000; ++i) closed += "</a>";
  model = kGood;
  model.insert(model.find("<build>"), closed);
  EXPECT_TRUE(read_text(package(model), "a.3mf"));
}

TEST(HostileThreemf, CyclesOfComponentsAreFound) {
  expect_unusable_model(model_xml(assembly(1, component(1)), "<item objectid=\"1\"/>"), "contains itself");
  expect_unusable_model(model_xml(assembly(1, component(2)) + assembly(2, component(1)), "<item objectid=\"1\"/>"),
                        "contains itself");
  const std::string other = model_xml(assembly(5, component(1, "p:path=\"/3D/3dmodel.model\"")), "");
  const std::string root = model_xml(assembly(1, component(5, "p:path=\"/3D/o.model\"")), "<item objectid=\"1\"/>");
  expect_error(package(root, {{"3D/o.model", other}}), ErrorCode::unusable_input, "contains itself");
}

TEST(HostileThreemf, DoublingThirtyTimesIsOverBudgetWhetherOrNotThereAreTriangles) {
  for (const std::string& leaf : {tetrahedron_object(1), std::string("<object id=\"1\"><mesh/></object>")}) {
    std::string objects = leaf;
    for (int id = 2; id <= 31; ++id) objects += assembly(id, component(id - 1) + component(id - 1));
    expect_error(package(model_xml(objects, "<item objectid=\"31\"/>")), ErrorCode::over_budget, "");
  }
}

TEST(HostileThreemf, AChainOfComponentsTooDeepIsRefused) {
  std::string objects = tetrahedron_object(1);
  for (int id = 2; id <= 20000; ++id) objects += assembly(id, component(id - 1));
  expect_unusable_model(model_xml(objects, "<item objectid=\"20000\"/>"), "too deeply");
}

TEST(HostileThreemf, IdsThatAreDoubleMissingOrNoIdsAreNamed) {
  expect_unusable_model(model_xml(tetrahedron_object(1) + tetrahedron_object(1), "<item objectid=\"1\"/>"), "same id");
  expect_unusable_model(model_xml(tetrahedron_object(1), "<item objectid=\"2\"/>"), "object 2");
  expect_unusable_model(model_xml(tetrahedron_object(1), "<item/>"), "objectid");
  expect_unusable_model(model_xml(tetrahedron_object(1), "<item objectid=\"-1\"/>"), "objectid");
  expect_unusable_model(model_xml(assembly(1, component(9)), "<item objectid=\"1\"/>"), "object 9");
  expect_unusable_model(model_xml("<object><mesh/></object>", "<item objectid=\"1\"/>"), "id");
  expect_unusable_model(model_xml(tetrahedron_object(1), ""), "build is empty");
  expect_unusable_model(model_xml("<object id=\"1\"/>", "<item objectid=\"1\"/>"), "neither a mesh");
}

TEST(HostileThreemf, VerticesTrianglesTransformsAndUnitsOutOfTheirRangeAreNamed) {
  const auto with = [](std::string_view old, std::string_view replacement) {
    std::string model = kGood;
    return model.replace(model.find(old), old.size(), replacement);
  };
  expect_unusable_model(with("v3=\"1\"", "v3=\"4\""), "triangle 0");
  expect_unusable_model(with("v3=\"1\"", "v3=\"-1\""), "triangle 0");
  expect_unusable_model(with("v3=\"1\"", ""), "triangle 0");
  expect_unusable_model(with("x=\"1\"", "x=\"nan\""), "vertex 1");
  expect_unusable_model(with("x=\"1\"", "x=\"1e39\""), "vertex 1");
  expect_unusable_model(with("x=\"1\"", ""), "vertex 1");
  expect_unusable_model(with("millimeter", "parsec"), "parsec");
  expect_unusable_model(with("millimeter", "a;b"), "a;b");
  for (const char* transform : {"1 0 0 0 1 0 0 0 1", "0 0 0 0 0 0 0 0 0 0 0 0", "1 0 0 0 1 0 0 0 nan 0 0 0",
                                "1 0 0 0 1 0 0 0 1 0 0 0 0", "1 0 0 1 0 0 0 0 1 0 0 0"})
    expect_unusable_model(with("objectid=\"1\"", std::string("objectid=\"1\" transform=\"") + transform + "\""),
                          "transform");
  expect_unusable_model(with("objectid=\"1\"", "objectid=\"1\" transform=\"3e38 0 0 0 1 0 0 0 1 3e38 0 0\""),
                        "out of every range");
}

TEST(HostileThreemf, AnExtensionThatShapesTheModelIsNamed) {
  std::string model = kGood;
  model.insert(
      model.find("<model ") + 7,
      "requiredextensions=\"b\" xmlns:b=\"http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02\" ");
  expect_unusable_model(model, "beamlattice");
}

TEST(HostileThreemf, ZipEntriesThatAreEncryptedLinksDoubledOrOfAnotherMethodAreNamed) {
  const std::vector<std::pair<ZipEntry, std::string>> cases{
      {{"3D/o.model", kGood, false, 1}, "encrypted"},
      {{"3D/o.model", kGood, false, 0, 12}, "method"},
      {{"3D/o.model", "../../etc/passwd", false, 0, -1, -1, 0120777}, "symbolic link"},
      {{"3D/o.model", kGood, true, 0, -1, 10}, "part"},
      {{"3D/o.model", kGood, true, 0, -1, 1'000'000}, "part"}};
  const std::string root = model_xml(assembly(1, component(1, "p:path=\"/3D/o.model\"")), "<item objectid=\"1\"/>");
  for (const auto& [entry, words] : cases) expect_error(package(root, {entry}), ErrorCode::unusable_input, words);
  expect_error(package(root, {{"3D/o.model", kGood}, {"3d/O.model", kGood}}), ErrorCode::unusable_input, "two parts");
  expect_error(package(root), ErrorCode::unusable_input, "no such part");
}

TEST(HostileThreemf, PathsThatLeaveThePackageFindNothingAndTouchNothing) {
  const TempFolder folder;
  write_text(folder / "o.model", kGood);
  for (const std::string& path :
       {(folder / "o.model").string(), std::string("../o.model"), std::string("C:\\o.model")}) {
    const std::string root = model_xml(assembly(1, component(1, "p:path=\"" + path + "\"")), "<item objectid=\"1\"/>");
    expect_error(package(root), ErrorCode::unusable_input, "no such part");
  }
  ASSERT_TRUE(read_text(package(kGood, {{"../escaped.txt", "x"}, {"/etc/escaped.txt", "x"}}), "a.3mf"));
  EXPECT_FALSE(std::filesystem::exists("../escaped.txt"));
}

TEST(HostileThreemf, ZipBombsAreOverBudgetBeforeTheyExpand) {
  std::string model = kGood;
  model.insert(model.find("<build>"), std::string(150'000'000, ' '));
  expect_error(package(model), ErrorCode::over_budget, "expands");
  ZipEntry lying{"3D/o.model", kGood, true};
  lying.claimed_size = 0xfffffff0;
  const std::string root = model_xml(assembly(1, component(1, "p:path=\"/3D/o.model\"")), "<item objectid=\"1\"/>");
  expect_error(package(root, {lying}), ErrorCode::over_budget, "3d/o.model");
}

TEST(HostileThreemf, APackageWithoutAModelSaysSo) {
  expect_error(zip_of({{"readme.txt", "hello"}}), ErrorCode::unusable_input, "no 3D model");
  expect_error(package("<html/>"), ErrorCode::unusable_input, "not a model");
  expect_error(package(""), ErrorCode::unusable_input, "XML");
}

}  // namespace
}  // namespace aplomb::test
