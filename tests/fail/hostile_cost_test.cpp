// Small or large files made to cost more than they are: every one ends in under 10 s, within the memory budget.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/cost.h"
#include "support/gcode_files.h"
#include "support/mesh_files.h"
#include "support/zip_files.h"

namespace aplomb::test {
namespace {

constexpr std::size_t megabyte = std::size_t{1} << 20;

std::string repeated(std::string_view text, std::size_t count) {
  std::string all;
  all.reserve(text.size() * count);
  for (std::size_t i = 0; i < count; ++i) all.append(text);
  return all;
}

/// Reads in a process of its own; under sanitizers only that it ends is asked.
void expect_cheap(const std::string& bytes, std::string_view name, const ReadOptions& options = {}) {
  const std::span view(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size());
  const Cost cost = cost_of([&] {
    const auto file = read_mesh(view, name, options);
    if (!file && file.error().message.find(';') == std::string::npos) abort();
  });
  EXPECT_TRUE(cost.ended) << name;
  if (is_sanitized()) return;
  EXPECT_LT(cost.seconds, 10) << name;
  EXPECT_LT(cost.peak_bytes + bytes.size(), options.memory_bytes + 32 * megabyte) << name << " " << bytes.size();
}

TEST(HostileCost, AGigabyteInOneLineIsReadInPlace) {
  const std::size_t bytes = (is_sanitized() ? 50 : 1024) * megabyte;
  for (const auto& [head, name] : {std::pair{"o ", "a.obj"},
                                   {"f ", "a.obj"},
                                   {"solid ", "a.stl"},
                                   {"solid a\nfacet normal ", "a.stl"},
                                   {"ply\nformat ascii 1.0\ncomment ", "a.ply"},
                                   {"OFF\n", "a.off"}})
    expect_cheap(head + std::string(bytes, 'n'), name);
}

TEST(HostileCost, OnePolygonOfAsManyCornersAsFitTheFileIsWithinTheBudget) {
  const std::string head =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar "
      "z\nelement face 1\nproperty list uint uchar vertex_indices\nend_header\n";
  const std::uint32_t corners = is_sanitized() ? 10'000 : 40'000'000;
  std::string ply = head + std::string("\0\0\0\1\0\0\0\1\0", 9);
  ply.append(reinterpret_cast<const char*>(&corners), 4);
  for (std::uint32_t i = 0; i < corners; ++i) ply += static_cast<char>(i % 3);
  expect_cheap(ply, "a.ply");
  expect_cheap(ply, "a.ply", {.memory_bytes = 256 * megabyte});
  expect_cheap("v 0 0 0\nv 1 0 0\nv 0 1 0\nf " + repeated("1 2 3 ", corners / 10), "a.obj",
               {.memory_bytes = 256 * megabyte});
}

TEST(HostileCost, HeadersOfAMillionElementsOrPropertiesAreRefused) {
  std::string elements = "ply\nformat ascii 1.0\n";
  for (int i = 0; i < 1'000'000; ++i) elements += "element e" + std::to_string(i) + " 0\n";
  expect_cheap(elements + "end_header\n", "a.ply", {.memory_bytes = 128 * megabyte});
  const std::string properties =
      "ply\nformat ascii 1.0\nelement vertex 0\n" + repeated("property float x\n", 3'000'000) + "end_header\n";
  expect_cheap(properties, "a.ply", {.memory_bytes = 128 * megabyte});
}

TEST(HostileCost, AMillionObjectsItemsComponentsAndVolumesAreWithinTheBudget) {
  std::string objects;
  for (int i = 2; i < 1'000'000; ++i) objects += "<object id=\"" + std::to_string(i) + "\"/>";
  const std::string one = "<item objectid=\"1\"/>";
  const ReadOptions options{.memory_bytes = 400 * megabyte};
  expect_cheap(package(model_xml(tetrahedron_object(1) + objects, one)), "a.3mf", options);
  expect_cheap(package(model_xml(tetrahedron_object(1), repeated(one, 1'000'000))), "a.3mf", options);
  const std::string assembly =
      "<object id=\"2\"><components>" + repeated("<component objectid=\"1\"/>", 1'000'000) + "</components></object>";
  expect_cheap(package(model_xml(tetrahedron_object(1) + assembly, "<item objectid=\"2\"/>")), "a.3mf", options);
}

TEST(HostileCost, VolumesThatAllCoverTheWholeMeshAreLeftOutOnce) {
  std::string mesh = "<object id=\"1\"><mesh><vertices>" + repeated("<vertex x=\"0\" y=\"0\" z=\"0\"/>", 3) +
                     "</vertices><triangles>" + repeated("<triangle v1=\"0\" v2=\"1\" v3=\"2\"/>", 200'000) +
                     "</triangles></mesh></object>";
  const std::string volumes = "<config><object id=\"1\">" +
                              repeated(
                                  "<volume firstid=\"0\" lastid=\"18446744073709551615\"><metadata key=\"volume_type\" "
                                  "value=\"ParameterModifier\"/></volume>",
                                  100'000) +
                              "</object></config>";
  expect_cheap(package(model_xml(mesh, "<item objectid=\"1\"/>"), {{"Metadata/Slic3r_PE_model.config", volumes, true}}),
               "a.3mf");
}

TEST(HostileCost, LongPathsAndExtensionsOverAndOverAreRefused) {
  const std::string path = "p:path=\"" + std::string(60'000, 'x') + "\"";
  std::string objects = tetrahedron_object(1);
  for (int id = 2; id <= 20; ++id) {
    const std::string component = "<component objectid=\"" + std::to_string(id - 1) + "\" " + path + "/>";
    objects +=
        "<object id=\"" + std::to_string(id) + "\"><components>" + component + component + "</components></object>";
  }
  expect_cheap(package(model_xml(objects, "<item objectid=\"20\"/>")), "a.3mf");
  std::string model = model_xml(tetrahedron_object(1), "<item objectid=\"1\"/>"), attributes;
  for (int i = 0; i < 100'000; ++i) attributes += "a" + std::to_string(i) + "=\"\" ";
  model.insert(model.find("<model ") + 7, attributes + "requiredextensions=\"" + repeated("p ", 100'000) + "\" ");
  expect_cheap(package(model), "a.3mf");
}

TEST(HostileCost, PartsThatExpandTogetherAreRefusedAsOneBombIs) {
  std::vector<ZipEntry> parts;
  std::string components;
  for (int i = 0; i < 40; ++i) {
    const std::string name = "3D/" + std::to_string(i) + ".model";
    parts.push_back(
        {name,
         model_xml("<object id=\"1\"><mesh/></object>" + std::string((is_sanitized() ? 2 : 30) * megabyte, ' '), ""),
         true});
    components += "<component objectid=\"1\" p:path=\"/" + name + "\"/>";
  }
  const std::string root =
      model_xml("<object id=\"1\"><components>" + components + "</components></object>", "<item objectid=\"1\"/>");
  const std::string bytes = package(root, parts);
  expect_cheap(bytes, "a.3mf");
  EXPECT_EQ(read_text(bytes, "a.3mf").error().code, ErrorCode::over_budget);
}

TEST(HostileCost, ADirectoryOfMillionsOfEntriesIsRefusedBeforeItIsRead) {
  ZipEntry entry{"a", ""};
  std::string zip = zip_of({entry});
  const std::size_t directory = zip.find("PK\x01\x02"), end = zip.find("PK\x05\x06");
  const std::string one = zip.substr(directory, end - directory);
  std::string tail = zip.substr(end);
  const std::size_t count = 500'000;
  const auto size = static_cast<std::uint32_t>(one.size() * count);
  for (int i = 0; i < 4; ++i) tail[12 + i] = static_cast<char>(size >> (8 * i));
  expect_cheap(zip.substr(0, directory) + repeated(one, count) + tail, "a.3mf", {.memory_bytes = 100 * megabyte});
}

/// Reads a program in a process of its own, which must end in time and in the constant memory that is promised.
void expect_cheap_program(const std::string& program) {
  const Cost cost = cost_of([&] { read_program(program); });
  EXPECT_TRUE(cost.ended);
  if (is_sanitized()) return;
  EXPECT_LT(cost.seconds, 10);
  EXPECT_LT(cost.peak_bytes, 100 * megabyte);
}

TEST(HostileCost, ARoundFootOfAHundredThousandBeadsCostsNoMoreThanItsLength) {
  std::string program = plain_start();
  const int beads = is_sanitized() ? 5'000 : 200'000;
  for (int i = 0; i < beads; ++i) {
    const double angle = 2 * std::numbers::pi * i / beads;
    program += "G1 X" + std::to_string(1e4 * std::cos(angle)) + " Y" + std::to_string(1e4 * std::sin(angle)) + " E1\n";
  }
  expect_cheap_program(program);
  expect_cheap_program(";TYPE:Skirt\n" + program + ";TYPE:Perimeter\nG1 X0 Y0 E1\nG1 X5 E1\nG1 Y5 E1\n");
}

TEST(HostileCost, ThousandsOfObjectsBesideThousandsOfBrimsCostNoMoreThanTheirProduct) {
  std::string program = plain_start() + ";TYPE:Skirt\n";
  const int count = is_sanitized() ? 300 : 4'000;
  for (int i = 0; i < count; ++i) {
    const std::string x = "G1 X" + std::to_string(10 * i);
    program += x + " Y0\n" + x + ".5 Y1 E0.1\n";
  }
  for (int i = 0; i < count; ++i) {
    program += "; printing object " + std::to_string(i) + "\n";
    for (int tool = 0; tool < 20; ++tool)
      program += ";TYPE:Perimeter\nT" + std::to_string(tool) + "\nG1 X" + std::to_string(tool % 7) + " Y" +
                 std::to_string(i % 11) + " E1\n";
  }
  expect_cheap_program(program);
}

TEST(HostileCost, LabelsOfAMegabyteEachAreNotKept) {
  std::string program = plain_start();
  for (int i = 0; i < (is_sanitized() ? 10 : 300); ++i)
    program += "; printing object " + std::to_string(i) + std::string(900'000, 'n') + "\nG1 X" + std::to_string(i % 7) +
               " E1\n";
  expect_cheap_program(program);
}

}  // namespace
}  // namespace aplomb::test
