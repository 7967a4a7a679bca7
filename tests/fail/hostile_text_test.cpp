// Job files, profiles and text of every encoding: what is no such file is said in one line that a terminal can show.
#include <gtest/gtest.h>

#include "aplomb/core/printable.h"
#include "aplomb/fdm/print_profile.h"
#include "aplomb/job/job_file.h"
#include "support/cost.h"
#include "support/mesh_files.h"

namespace aplomb::test {
namespace {

using namespace std::string_literals;

void expect_one_line(const Error& error, std::string_view words) {
  EXPECT_NE(error.message.find(words), std::string::npos) << error.message;
  EXPECT_LT(error.message.size(), 1000u) << words;
  for (const char c : error.message) EXPECT_TRUE(static_cast<unsigned char>(c) >= 32 && c != 127) << error.message;
}

void expect_bad_job(const std::string& text, std::string_view words) {
  const auto job = parse_job(text, "folder");
  ASSERT_FALSE(job) << words;
  EXPECT_EQ(job.error().code, ErrorCode::invalid_option);
  expect_one_line(job.error(), words);
}

void expect_bad_profile(const std::string& text, std::string_view words) {
  const auto profile = parse_profile(text);
  ASSERT_FALSE(profile) << words;
  EXPECT_EQ(profile.error().code, ErrorCode::unusable_input);
  expect_one_line(profile.error(), words);
}

std::string repeated(std::string_view text, std::size_t count) {
  std::string all;
  for (std::size_t i = 0; i < count; ++i) all.append(text);
  return all;
}

TEST(HostileText, JobsThatNestAHundredThousandDeepAreRefusedWithoutACrash) {
  for (const auto& [open, close] : {std::pair{"[", "]"}, {"{\"a\":", "}"}}) {
    expect_bad_job("{\"aplomb_job\": 1, \"model\": " + repeated(open, 100'000) + "1" + repeated(close, 100'000) + "}",
                   "nests deeper");
    expect_bad_job(repeated(open, 500'000), "nests deeper");
  }
  expect_bad_job(
      "{\"aplomb_job\": 1, \"model\": \"" + repeated("[", 500) + "\\\"" + repeated("{", 500) + "\", \"x\": 1}",
      "no key 'x'");
}

TEST(HostileText, WhatAJobHoldsIsShownShortAndWithoutControlCharacters) {
  expect_bad_job("{\"aplomb_job\": 1, \"model\": \"a\", \"\x1b[2Jred\x7f\": 1}", "no JSON");
  expect_bad_job("{\"aplomb_job\": 1, \"model\": \"a\", \"\\u001b[2J\": 1}", "no key '?[2J'");
  expect_bad_job("{\"aplomb_job\": 1, \"model\": \"a\", \"" + std::string(500'000, 'k') + "\": 1}", "kkk...'");
  expect_bad_job("{\"aplomb_job\": 1, \"model\": 1" + std::string(500'000, '0') + "}", "no JSON");
  expect_bad_job("{\"aplomb_job\": 1, \"model\": " + std::string(500'000, 'x') + "}", "no JSON");
  expect_bad_job("{\"aplomb_job\": \"\\u001b]0;title\\u0007\", \"model\": \"a\"}", "must be");
  expect_bad_job(
      "\"\xC2\x9B"
      "2J",
      "no JSON");
}

TEST(HostileText, JobsOfOtherEncodingsCutOffOrWithNumbersNoDoubleHoldsAreRefused) {
  expect_bad_job("", "no JSON");
  expect_bad_job("{", "; mend it there");
  expect_bad_job("\xFF\xFE{\0}\0"s, "no JSON");
  expect_bad_job("{\"aplomb_job\": 1, \"model\": \"a\0b\"}"s, "no JSON");
  expect_bad_job("{\"aplomb_job\": 1, \"model\": \"a\", \"place\": {\"scale\": 1e999}}", "no JSON");
  expect_bad_job("{\"aplomb_job\": 1, \"model\": \"a\", \"place\": {\"scale\": NaN}}", "no JSON");
  expect_bad_job("{\"aplomb_job\": 1, \"model\": \"a\", \"place\": {\"scale\": -1}}", "scale");
  expect_bad_job("{\"aplomb_job\": 1, \"model\": \"a\", \"place\": {\"object\": 1e300}}", "object");
  EXPECT_TRUE(parse_job("\xEF\xBB\xBF{\"aplomb_job\": 1,\r\n \"model\": \"a\"}", "folder"));
}

TEST(HostileText, NoByteOfAJobChangedOrCutOffCrashesItsReader) {
  const std::string job = read_text_file(std::string(APLOMB_FIXTURES) + "/jobs/stand_and_hang.json");
  ASSERT_FALSE(job.empty());
  for (std::size_t at = 0; at < job.size(); ++at) {
    if (const auto cut = parse_job(job.substr(0, at), "folder"); !cut) expect_one_line(cut.error(), "");
    std::string changed = job;
    changed[at] = static_cast<char>(changed[at] ^ 0x80);
    if (const auto read = parse_job(changed, "folder"); !read) expect_one_line(read.error(), "");
  }
}

TEST(HostileText, FilesWithoutAnEndAreReadNoFurtherThanTheirLimit) {
  const Cost cost = cost_of([] {
    if (read_job("/dev/zero") || read_profile("/dev/zero")) abort();
  });
  EXPECT_TRUE(cost.ended);
  EXPECT_LT(cost.peak_bytes, std::size_t{is_sanitized() ? 1000 : 100} << 20);
  EXPECT_FALSE(read_job(".."));
  EXPECT_FALSE(read_profile(".."));
  EXPECT_EQ(read_mesh("/dev/zero", {.memory_bytes = 1 << 20}).error().code, ErrorCode::over_budget);
}

TEST(HostileText, NumbersOfAProfileOutOfEveryRangeAreNamed) {
  const std::string prusa = "perimeters = 2\nfill_density = 15%\n", cura = "infill_sparse_density = 20\n";
  for (const char* bad : {"nan", "inf", "x", "", "1e999"})
    expect_bad_profile(prusa + "layer_height = " + bad, "layer_height");
  expect_bad_profile(prusa + "layer_height = 0x10", "line 3: layer_height is '0x10', which is no number; ");
  for (const char* bad : {"1,05", "0,2", "0.2mm", "0.2 0.3", "0.2,0.3", "1.2.3", "15%%", "+0.2", "1e-400"})
    expect_bad_profile(prusa + "layer_height = " + bad, "line 3: layer_height is '" + std::string(bad) + "', which");
  expect_bad_profile(prusa + "nozzle_diameter = 1,05", "line 3: nozzle_diameter is '1,05', which is no number");
  expect_bad_profile(prusa + "nozzle_diameter = 0.4,x", "nozzle_diameter is '0.4,x', which is no number");
  expect_bad_profile(prusa + "layer_height = \x1b[2J", "'?[2J'");
  expect_bad_profile(prusa + "layer_height = " + std::string(1'000'000, 'x'), "...'");
  expect_bad_profile("perimeters = 1e300\nfill_density = 15%", "line 1: perimeters is '1e300'");
  expect_bad_profile("perimeters = -3e9\nfill_density = 15%", "perimeters");
  expect_bad_profile(cura + "wall_line_count = 1e300", "line 2: wall_line_count is '1e300'");
  expect_bad_profile(cura + "machine_nozzle_size = 0", "machine_nozzle_size comes to 0; it must be");
  expect_bad_profile(cura + "top_layers = -1e300", "top_layers");
  expect_bad_profile(prusa + "solid_infill_below_area = -1", "solid_infill_below_area is '-1'");
  expect_bad_profile(prusa + "infill_overlap = 1e300", "infill_overlap is");
  expect_bad_profile(prusa + "filament_density = 1e9",
                     "filament_density is '1e9', which comes to 1e+09; it must be at least 0");
}

TEST(HostileText, AMarkOfUtf8HidesNoSettingAndUtf16IsNamed) {
  const std::string mark = "\xEF\xBB\xBF";
  for (const std::string& text : {"layer_height = 0.1\nperimeters = 2\nfill_density = 15%\n"s,
                                  "; layer_height = 0.1\n; perimeters = 2\n; fill_density = 15%\n"s,
                                  "{\"layer_height\": 0.1, \"wall_line_count\": 2}"s}) {
    const auto profile = parse_profile(mark + text);
    ASSERT_TRUE(profile) << profile.error().message;
    EXPECT_EQ(profile->layer_mm, 0.1) << text;
    EXPECT_EQ(profile->perimeters, 2) << text;
  }
  expect_bad_profile("\xFF\xFEp\0"s, "byte 0: the text is UTF-16; ");
  expect_bad_profile("\xFE\xFF\0p"s, "byte 0: the text is UTF-16; ");
}

TEST(HostileText, ExpressionsInAProfileAreNotEvaluated) {
  expect_bad_profile("wall_line_count = 2\nline_width = =machine_nozzle_size * 2\n",
                     "line 2: line_width is '=machine_nozzle_size * 2', an expression, which is not evaluated; ");
  expect_bad_profile("{\"wall_line_count\": \"=__import__('os').system('touch x')\"}",
                     "an expression, which is not evaluated; ");
  EXPECT_TRUE(parse_profile("wall_line_count = 2\nsupport_angle = =50 + 1\n"));
}

TEST(HostileText, EveryRefusalOfAProfileNamesARemedy) {
  for (const std::string& text :
       {""s, "perimeters = x\nfill_density = 1"s, "perimeters = -1\nfill_density = 1"s, "\xFF\xFE"s})
    expect_bad_profile(text, "; ");
  for (const char* path : {"no such.ini", ".."}) {
    const auto profile = read_profile(path);
    ASSERT_FALSE(profile);
    expect_one_line(profile.error(), "; ");
  }
}

TEST(HostileText, WhatIsNoProfileIsRefused) {
  for (const std::string& text :
       {""s, "\0\0\0"s, "PK\x03\x04"s, repeated("[", 500'000), repeated("{\"a\":", 200'000),
        "{\"perimeters\": [1], \"fill_density\": {}}"s, std::string(1'000'000, '='), repeated("a=b\n", 300'000)})
    expect_bad_profile(text, "no profile");
}

TEST(HostileText, TextMadePrintableHoldsNothingThatATerminalObeys) {
  EXPECT_EQ(printable("a\x1b[2J\r\n\t\x7f\0b"s), "a?[2J?????b");
  EXPECT_EQ(printable("\xC2\x9B"
                      "2J"),
            "\xC2?2J");
  EXPECT_EQ(printable("B\xC3\xA4r"), "B\xC3\xA4r");
  EXPECT_EQ(printable("abcdef", 3), "abc...");
  EXPECT_EQ(printable(""), "");
}

TEST(HostileText, EveryTextFormatIsReadWithAnyLineEndAndAMark) {
  const std::string
      obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
      off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2",
      stl =
          "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
          "0\nendloop\nendfacet\nendsolid",
      ply =
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face "
          "1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2";
  for (const auto& [text, name] : {std::pair{obj, "a.obj"}, {off, "a.off"}, {stl, "a.stl"}, {ply, "a.ply"}})
    for (const std::string& end : {"\n"s, "\r\n"s, "\r"s}) {
      std::string other;
      for (const char c : text) other += c == '\n' ? end : std::string(1, c);
      for (const std::string& whole : {other, other + end}) {
        EXPECT_TRUE(read_text(whole, name)) << name << end.size();
        const auto marked = read_text("\xEF\xBB\xBF" + whole, name);
        EXPECT_EQ(marked.has_value(), name != std::string_view("a.ply")) << name << end.size();
        if (!marked) {
          EXPECT_NE(marked.error().message.find("byte 0: it does not begin with \"ply\""), std::string::npos);
        }
      }
      std::string utf16 = "\xFF\xFE";
      for (const char c : other) utf16 += std::string{c, '\0'};
      const auto wide = read_text(utf16, name);
      ASSERT_FALSE(wide) << name;
      EXPECT_NE(wide.error().message.find("UTF-16"), std::string::npos) << wide.error().message;
    }
}

}  // namespace
}  // namespace aplomb::test
