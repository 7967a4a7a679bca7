// Reports that verify is given: what is none ends in one line, soon, in little memory.
#include <gtest/gtest.h>

#include "aplomb/job/job_file.h"
#include "aplomb/report/verification.h"
#include "support/cost.h"

namespace aplomb::test {
namespace {

using namespace std::string_literals;

constexpr std::size_t megabyte = std::size_t{1} << 20;

std::string report(const std::string& mass_g = "100", const std::string& up = "[0, 0, 1]") {
  return "{\"poses\": [{\"kind\": \"standing\", \"up\": " + up + "}], \"before\": {\"mass_g\": " + mass_g +
         ", \"volume_mm3\": 80000, \"com_mm\": [1, 2, 3], \"com_height_mm\": 3, \"tip_deg\": 12, "
         "\"support_polygon_mm\": [[0, 0, 0], [9, 0, 0], [0, 9, 0]], \"box_mm\": [[0, 0, 0], [9, 9, 9]]}}";
}

void expect_refused(const std::string& text, std::string_view words) {
  const auto expected = expected_print(text);
  ASSERT_FALSE(expected) << words;
  EXPECT_EQ(expected.error().code, ErrorCode::unusable_input);
  const std::string& message = expected.error().message;
  EXPECT_NE(message.find(words), std::string::npos) << message;
  EXPECT_NE(message.find("; "), std::string::npos) << message;
  EXPECT_LT(message.size(), 1000u);
  for (const char c : message) EXPECT_TRUE(static_cast<unsigned char>(c) >= 32 && c != 127) << message;
}

TEST(HostileReport, WhatIsNoReportIsRefusedWithWhatItLacksAndTheRemedy) {
  ASSERT_TRUE(expected_print(report())) << expected_print(report()).error().message;
  for (const std::string& text : {""s, "{"s, "\0"s, "solid cube"s, std::string(100'000, '['), report().substr(0, 99)})
    expect_refused(text, "no JSON");
  expect_refused("{}", "key 'poses' not found");
  expect_refused("[]", "no report");
  expect_refused("{\"poses\": 1}", "no report");
  expect_refused("{\"poses\": [{\"\\u001b[2J\": 1}]}", "'kind' not found");
  expect_refused("{\"poses\": []}", "none of the report's stands");
  expect_refused(report("\"much\""), "another kind");
  expect_refused("\xFF\xFE{\0"s, "UTF-16");
  EXPECT_TRUE(expected_print("\xEF\xBB\xBF" + report()));
}

TEST(HostileReport, NumbersOfNoBodyAreRefused) {
  for (const char* mass : {"0", "-1", "null", "1e308", "1e-320"}) expect_refused(report(mass), "");
  expect_refused(report("1e999"), "no JSON");
  expect_refused(report("100", "[0, 0, -1]"), "another way up");
  expect_refused(report("100", "[null, 0, 1]"), "another kind");
  expect_refused(report("100", "[0, 1]"), "");
}

TEST(HostileReport, NoByteOfAReportChangedOrCutOffCrashesItsReader) {
  const std::string text = report();
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (!expected_print(text.substr(0, at))) expect_refused(text.substr(0, at), "; ");
    std::string changed = text;
    changed[at] = static_cast<char>(changed[at] ^ 0x80);
    if (!expected_print(changed)) expect_refused(changed, "; ");
  }
}

/// One object with as many keys as fit.
std::string many_keys(std::size_t bytes) {
  std::string text = "{\"aplomb_job\": 1, \"model\": \"a\"";
  for (int i = 0; text.size() < bytes; ++i) text += ",\"" + std::to_string(i) + "\":1";
  return text + "}";
}

TEST(HostileReport, ManyKeysCostNoMoreThanTheirBytes) {
  const std::string in_job = many_keys(is_sanitized() ? 30'000 : 999'000),
                    keys = many_keys((is_sanitized() ? 1 : 3) * megabyte);
  const std::string in_pose = "{\"poses\": [" + keys + "], \"before\": " + keys.substr(0, keys.size() / 16) + "}}";
  for (const auto& work : {std::function<void()>([&] {
                             if (parse_job(in_job, ".")) abort();
                           }),
                           std::function<void()>([&] {
                             if (expected_print(keys)) abort();
                           }),
                           std::function<void()>([&] {
                             if (expected_print(in_pose)) abort();
                           })}) {
    const Cost cost = cost_of(work);
    EXPECT_TRUE(cost.ended);
    if (is_sanitized()) continue;
    EXPECT_LT(cost.seconds, 10);
    EXPECT_LT(cost.peak_bytes, 300 * megabyte);
  }
  expect_refused(std::string(5 * megabyte, ' '), "longer than 4 MB");
}

TEST(HostileReport, ListsOfListsStayWithinABound) {
  std::string lists = "{\"poses\": [[]";
  while (lists.size() < (is_sanitized() ? 1 : 3) * megabyte) lists += ",[]";
  const Cost cost = cost_of([&] {
    if (expected_print(lists + "]}")) abort();
  });
  EXPECT_TRUE(cost.ended);
  if (!is_sanitized()) {
    EXPECT_LT(cost.peak_bytes, 300 * megabyte);
  }
}

}  // namespace
}  // namespace aplomb::test
