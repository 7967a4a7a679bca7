#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "aplomb/core/printable.h"
#include "aplomb/report/verification.h"

namespace aplomb {
namespace {

using Json = nlohmann::json;

constexpr std::size_t most_bytes = std::size_t{4} << 20;
constexpr int most_levels = 100;
constexpr const char* remedy = "; give a file that aplomb stand or check wrote (--report)";

tl::unexpected<Error> unusable(const std::string& what) { return fail(ErrorCode::unusable_input, what + remedy); }

/// The part of a report that is needed: of the rest nothing is kept. \return discarded where it is no JSON or nests too
/// deep.
Json parsed(std::string_view text) {
  constexpr std::array<std::string_view, 3> needed{"poses", "before", "after"};
  bool is_too_deep = false;
  const auto keep = [&](int depth, Json::parse_event_t event, Json& value) {
    is_too_deep = is_too_deep || depth > most_levels;
    if (is_too_deep) return false;
    if (event != Json::parse_event_t::key || depth != 1) return true;
    return std::ranges::find(needed, value.get_ref<const std::string&>()) != needed.end();
  };
  Json report = Json::parse(text, keep, false);
  return is_too_deep ? Json(Json::value_t::discarded) : report;
}

/// Of "[json.exception.out_of_range.403] key 'poses' not found" what it says.
std::string reason(const Json::exception& error) {
  const std::string what = error.what();
  return printable(what.substr(std::min(what.size(), what.find(']') + 2)));
}

Vec3 vector_of(const Json& json) {
  return {json.at(0).get<double>(), json.at(1).get<double>(), json.at(2).get<double>()};
}

bool is_finite(Vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// The measure of the first standing pose. \pre as nlohmann's at(): it throws where a key is missing.
ExpectedPrint expected_of(const Json& report) {
  const Json& standing = report.contains("after") ? report.at("after") : report.at("before");
  ExpectedPrint expected{.mass_g = standing.at("mass_g").get<double>(),
                         .com_mm = vector_of(standing.at("com_mm")),
                         .com_height_mm = standing.at("com_height_mm").get<double>(),
                         .tip_rad = standing.at("tip_deg").get<double>() * std::numbers::pi / 180};
  expected.density_g_per_cm3 = 1e3 * expected.mass_g / standing.at("volume_mm3").get<double>();
  Box3 support;
  for (const Json& corner : standing.at("support_polygon_mm")) support.add(vector_of(corner));
  expected.support_center_mm = {(support.min.x + support.max.x) / 2, (support.min.y + support.max.y) / 2};
  if (const auto box = standing.find("box_mm"); box != standing.end())
    expected.box_mm = Box3{vector_of(box->at(0)), vector_of(box->at(1))};
  return expected;
}

/// What could be measured: what was not would fit anything, or nothing.
bool is_sound(const ExpectedPrint& e) {
  const bool has_box = !e.box_mm || (is_finite(e.box_mm->min) && is_finite(e.box_mm->max));
  return e.mass_g > 0 && std::isnormal(e.mass_g) && e.density_g_per_cm3 > 0 && std::isnormal(e.density_g_per_cm3) &&
         is_finite(e.com_mm) && std::isfinite(e.com_height_mm) && std::isfinite(e.tip_rad) && has_box &&
         is_finite({e.support_center_mm.x, e.support_center_mm.y, 0});
}

}  // namespace

Result<ExpectedPrint> expected_print(std::string_view report_json) {
  if (report_json.size() > most_bytes) return unusable("the report is longer than 4 MB, as none of ours is");
  if (report_json.starts_with("\xFF\xFE") || report_json.starts_with("\xFE\xFF"))
    return fail(ErrorCode::unusable_input, "byte 0: the report is UTF-16; save it as UTF-8");
  try {
    const Json report = parsed(report_json);
    if (report.is_discarded()) return unusable("this is no JSON, or nests deeper than 100 levels");
    const Json& poses = report.at("poses");
    const auto pose = std::ranges::find_if(poses, [](const Json& p) { return p.at("kind") == "standing"; });
    if (pose == poses.end())
      return fail(ErrorCode::unusable_input, "poses: none of the report's stands; give the report of one that does");
    if (!(dot(vector_of(pose->at("up")), {0, 0, 1}) >= 1 - 1e-9))
      return fail(ErrorCode::unusable_input,
                  "poses: the report's first that stands has another way up than z, as which it is printed; turn the "
                  "model and report it again");
    if (const ExpectedPrint expected = expected_of(report); is_sound(expected)) return expected;
    return unusable("before, after: the report's numbers are none of a body");
  } catch (const Json::out_of_range& error) {  // the library's own way to say that a key is missing
    return unusable("this is no report, for it lacks what each has: " + reason(error));
  } catch (const Json::exception& error) {
    return unusable("this is no report, for a value is of another kind: " + reason(error));
  }
}

}  // namespace aplomb
