// Small or large files made to cost more than they are: every one ends in under 10 s, within the memory budget.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "fail/expect_within.h"
#include "support/cancelled.h"
#include "support/mesh_files.h"
#include "support/refusal.h"
#include "support/zip_files.h"

namespace aplomb::test {
namespace {

enum class Reading { may_do, must_do, must_be_refused };

/// Reads in a process of its own, which ends in time and within the budget: in a mesh, or in a sentence that holds
/// `words`.
void expect_cheap(const std::string& bytes, std::string_view name, const ReadOptions& options = {},
                  Reading reading = Reading::may_do, std::string_view words = "") {
  const std::span view(reinterpret_cast<const std::byte*>(bytes.data()), bytes.size());
  const Cost cost = cost_of([&] {
    const auto file = read_mesh(view, name, options);
    const bool is_as_asked = file
                                 ? reading != Reading::must_be_refused
                                 : reading != Reading::must_do && lack_of_refusal(file.error().message, name).empty() &&
                                       file.error().message.find(words) != std::string::npos;
    if (is_as_asked) return;
    std::cerr << name << (file ? " was read" : ": " + file.error().message) << "\n";
    abort();
  });
  constexpr std::size_t kRest = 32 * megabyte;
  const std::size_t budget = options.memory_bytes + kRest;
  expect_within(cost, budget > bytes.size() ? budget - bytes.size() : 0, name);
}

void expect_cheap_refusal(const std::string& bytes, std::string_view name, std::string_view words,
                          const ReadOptions& options = {}) {
  expect_cheap(bytes, name, options, Reading::must_be_refused, words);
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

/// Twice round, the second time a little further in: no corner of the first round is an ear, which is known half a
/// round later.
std::string polygon_of_two_rounds(int corners_a_round) {
  std::string obj, face = "f";
  for (const double radius : {1.0, 1 - 1 / std::pow(corners_a_round, 2)})
    for (int i = 0; i < corners_a_round; ++i) {
      const double angle = 2 * std::numbers::pi * i / corners_a_round;
      obj += fmt::format("v {:.17g} {:.17g} 0\n", radius * std::cos(angle), radius * std::sin(angle));
    }
  for (int i = 1; i <= 2 * corners_a_round; ++i) face += fmt::format(" {}", i);
  return obj + face + "\n";
}

TEST(HostileCost, APolygonThatIsCutSlowlySaysSoAndCanBeStopped) {
  const std::string obj = polygon_of_two_rounds(is_sanitized() ? 4000 : 12'000);
  const std::span bytes(reinterpret_cast<const std::byte*>(obj.data()), obj.size());
  const auto read = [&](const Job& job) { return read_mesh(bytes, "a.obj", {}, job); };
  expect_cancelled_at_a_spread(never_silent(read), read, 4);
}

TEST(HostileCost, HeadersOfAMillionElementsOrPropertiesAreRefused) {
  std::string elements = "ply\nformat ascii 1.0\n";
  for (int i = 0; i < 1'000'000; ++i) elements += "element e" + std::to_string(i) + " 0\n";
  expect_cheap_refusal(elements + "end_header\n", "a.ply", "more than 100 elements", {.memory_bytes = 128 * megabyte});
  const std::string properties =
      "ply\nformat ascii 1.0\nelement vertex 0\n" + repeated("property float x\n", 3'000'000) + "end_header\n";
  expect_cheap_refusal(properties, "a.ply", "more than 1000 properties", {.memory_bytes = 128 * megabyte});
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

TEST(HostileCost, ManyVolumesOfAnObjectWithManyItemsAreLeftOutOnce) {
  const std::string volumes =
      "<config><object id=\"1\">" +
      repeated("<volume firstid=\"1\" lastid=\"1\"><metadata key=\"volume_type\" value=\"NegativeVolume\"/></volume>",
               200'000) +
      "</object></config>";
  expect_cheap(package(model_xml(tetrahedron_object(1), repeated("<item objectid=\"1\"/>", 100'000)),
                       {{"Metadata/Slic3r_PE_model.config", volumes, true}}),
               "a.3mf", {}, Reading::must_do);
}

TEST(HostileCost, ALongNameIsNotKeptWholeForEachItem) {
  const auto named = [](std::size_t length, std::size_t items) {
    return package(model_xml(tetrahedron_object(1, "name=\"" + std::string(length, 'n') + "\""),
                             repeated("<item objectid=\"1\"/>", items)));
  };
  expect_cheap(named(100'000, 5'000), "a.3mf", {.memory_bytes = 100 * megabyte}, Reading::must_do);
  expect_cheap_refusal(named(1'000, 500'000), "a.3mf", "allow more memory", {.memory_bytes = 400 * megabyte});
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", name(is_sanitized() ? 1000 : 60'000'000, 'n');
  expect_cheap("o " + name + "\n" + triangle, "a.obj", {.memory_bytes = 64 * megabyte});
  expect_cheap("solid " + name + "\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n", "a.stl",
               {.memory_bytes = 64 * megabyte});
  expect_cheap("ply\nformat ascii 1.0\nelement " + name + " 0\nproperty int " + name + "\n", "a.ply",
               {.memory_bytes = 128 * megabyte});
}

TEST(HostileCost, TextThatIsConvertedOrUnpackedIsCountedAsOftenAsItIsHeld) {
  const std::size_t length = (is_sanitized() ? 1 : 60) * megabyte;
  std::string model = model_xml(tetrahedron_object(1), "<item objectid=\"1\"/>");
  const std::string blanks = "<!--" + std::string(length, '\xE9') + "-->";
  model.insert(model.find("<build>"), blanks);
  expect_cheap(package(model), "a.3mf", {.memory_bytes = 100 * megabyte});
  model.replace(model.find("UTF-8"), 5, "ISO-8859-1");
  expect_cheap(package(model), "a.3mf", {.memory_bytes = 100 * megabyte});
}

TEST(HostileCost, CornersThatAreIndexedAnewAreHeldTwiceWithinTheBudget) {
  const std::uint32_t count = is_sanitized() ? 1'000 : 600'000;
  const std::string number = std::to_string(count), corners = std::to_string(3 * count);
  std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " + corners +
                    "\nproperty int x\nproperty uchar y\nproperty uchar z\nelement face " + number +
                    "\nproperty list uchar int vertex_indices\nend_header\n";
  for (std::uint32_t i = 0; i < 3 * count; ++i)
    ply.append(reinterpret_cast<const char*>(&i), 4)
        .append({static_cast<char>(i % 3 == 1), static_cast<char>(i % 3 == 2)});
  for (std::uint32_t i = 0; i < 3 * count; i += 3)
    for (std::uint32_t corner = i; corner < i + 3; ++corner)
      ply.append(corner == i ? 1 : 0, '\3').append(reinterpret_cast<const char*>(&corner), 4);
  for (std::size_t budget = 80; budget <= 320; budget += 60)
    expect_cheap(ply, "a.ply", {.memory_bytes = budget * megabyte});
}

TEST(HostileCost, AStreamTakesNoMoreThanTheBudgetWhileItGrows) {
  expect_within(cost_of([] {
                  if (read_mesh("/dev/zero", {.memory_bytes = 256 * megabyte})) abort();
                }),
                (256 + 32) * megabyte, "/dev/zero");
}

TEST(HostileCost, LongPathsAndExtensionsOverAndOverAreRefused) {
  const std::string path = "p:path=\"" + std::string(60'000, 'x') + "\"";
  std::string objects = tetrahedron_object(1);
  for (int id = 2; id <= 20; ++id) {
    const std::string component = "<component objectid=\"" + std::to_string(id - 1) + "\" " + path + "/>";
    objects +=
        "<object id=\"" + std::to_string(id) + "\"><components>" + component + component + "</components></object>";
  }
  expect_cheap_refusal(package(model_xml(objects, "<item objectid=\"20\"/>")), "a.3mf", "too long a path");
  std::string model = model_xml(tetrahedron_object(1), "<item objectid=\"1\"/>"), attributes;
  for (int i = 0; i < 100'000; ++i) attributes += "a" + std::to_string(i) + "=\"\" ";
  model.insert(model.find("<model ") + 7, attributes + "requiredextensions=\"" + repeated("p ", 100'000) + "\" ");
  expect_cheap_refusal(package(model), "a.3mf", "more than 100 extensions");
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
  expect_cheap_refusal(bytes, "a.3mf", is_sanitized() ? "" : "expands");
  EXPECT_EQ(read_text(bytes, "a.3mf").error().code, ErrorCode::over_budget);
}

/// A zip of one entry whose directory names it `count` times, and says so.
std::string zip_of_many(std::size_t count) {
  const std::string zip = zip_of({{"a", ""}});
  const EndRecord end = end_record_of(zip);
  return zip.substr(0, end.offset) + repeated(zip.substr(end.offset, end.size), count) +
         with_end_records("PK\x05\x06", {count, end.size * count, end.offset});
}

TEST(HostileCost, ADirectoryOfMillionsOfEntriesIsRefusedBeforeItIsRead) {
  expect_cheap_refusal(zip_of_many(500'000), "a.3mf", "directory", {.memory_bytes = 100 * megabyte});
  const std::string zip = zip_of({{"a", ""}});
  EndRecord lying = end_record_of(zip);
  lying.entries = 1 << 26;  // an entry takes libzip some 50 bytes before it reads any
  expect_cheap_refusal(with_end_records(zip, {}, lying), "a.3mf", "directory", {.memory_bytes = 100 * megabyte});
}

TEST(HostileCost, NamesOfPartsThatCollideInTheirHashCostNoMoreThanOthers) {
  const auto named = [](int doublings) {
    std::vector<ZipEntry> entries;
    for (std::string& name : names_of_one_hash(doublings)) entries.push_back({std::move(name), ""});
    return package(model_xml(tetrahedron_object(1), "<item objectid=\"1\"/>"), entries);
  };
  expect_cheap(named(12), "a.3mf", {}, Reading::must_do);
  expect_cheap_refusal(named(17), "a.3mf", "directory");
}

TEST(HostileCost, ThousandsOfEndRecordsThatShareADirectoryAreRefused) {
  const std::string zip = zip_of_many(4'000);
  const std::string end = zip.substr(zip.rfind("PK\x05\x06"));
  expect_cheap_refusal(zip + repeated(end, 2'900), "a.3mf", "directory");
}

}  // namespace
}  // namespace aplomb::test
