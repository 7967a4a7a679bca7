#include "aplomb/report/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace aplomb {
namespace {

using Json = nlohmann::ordered_json;
using Verdict = CheckResult::Verdict;

constexpr std::size_t most_shown = 5;  // findings of a check, in the text

const char* name_of(Severity severity) {
  return severity == Severity::fail ? "fail" : severity == Severity::warn ? "warn" : "info";
}

const char* name_of(Verdict verdict) {
  constexpr std::array names{"passed", "info", "warned", "failed", "waived", "not_judged"};
  return names[static_cast<std::size_t>(verdict)];
}

std::string_view unit_of(std::string_view id) {
  const auto found = std::ranges::find(check_rules(), id, &CheckRule::id);
  return found == check_rules().end() ? std::string_view() : found->unit;
}

std::string list_of(const Judgement& judgement, Verdict verdict) {
  std::string ids;
  for (const CheckResult& check : judgement.checks)
    if (check.verdict == verdict) ids += (ids.empty() ? "" : ", ") + check.id;
  return ids;
}

std::string headline(const Judgement& judgement) {
  const auto failed = std::ranges::count(judgement.checks, Verdict::failed, &CheckResult::verdict);
  const auto warned = std::ranges::count(judgement.checks, Verdict::warned, &CheckResult::verdict);
  const std::string warnings = fmt::format("{} {}", warned, warned == 1 ? "warning" : "warnings");
  const std::string_view name = process_names[static_cast<std::size_t>(judgement.process)];
  if (failed == 0) return fmt::format("Prints ({}): no check fails, {}\n", name, warnings);
  return fmt::format("Will not print as it is ({}): {} {}, {}\n", name, failed,
                     failed == 1 ? "check fails" : "checks fail", warnings);
}

std::string place_of(const Finding& finding) {
  if (finding.box_mm.empty()) return "";
  const Vec3& p = finding.at_mm;
  return fmt::format("at ({:.1f}, {:.1f}, {:.1f}) mm; ", p.x, p.y, p.z);
}

std::string in_input_of(const Finding& finding) {
  if (!finding.in_input) return "";
  return fmt::format("the model as it came has it, too ({:.4g} {}); ", *finding.in_input, unit_of(finding.id));
}

std::string text_of(const Finding& finding, bool is_waived) {
  return fmt::format("  {:<7}{:<16}{}\n  {:<23}{}{}{}\n", is_waived ? "waived" : name_of(finding.severity), finding.id,
                     finding.text, "", place_of(finding), in_input_of(finding), finding.remedy);
}

Json json(Vec3 v) { return Json::array({v.x, v.y, v.z}); }

}  // namespace

std::string to_text(const Judgement& judgement) {
  std::string text = headline(judgement);
  for (const CheckResult& check : judgement.checks) {
    std::size_t count = 0;
    for (const Finding& finding : judgement.findings)
      if (finding.id == check.id && ++count <= most_shown) text += text_of(finding, check.verdict == Verdict::waived);
    if (count > most_shown) text += fmt::format("  {:<23}and {} more places\n", "", count - most_shown);
  }
  if (const std::string passed = list_of(judgement, Verdict::passed); !passed.empty())
    text += fmt::format("  passed {}\n", passed);
  std::map<std::string, std::string> left_out;  // by the reason
  for (const CheckResult& check : judgement.checks)
    if (check.verdict == Verdict::not_judged) {
      std::string& ids = left_out[check.why];
      ids += (ids.empty() ? "" : ", ") + check.id;
    }
  for (const auto& [why, ids] : left_out) text += fmt::format("  not judged, for {}: {}\n", why, ids);
  return text;
}

std::string to_json(const Judgement& judgement) {
  Json checks = Json::array(), findings = Json::array();
  for (const CheckResult& c : judgement.checks) {
    Json check{{"id", c.id}, {"verdict", name_of(c.verdict)}};
    if (c.has_measure) check.update({{"measured", c.measured}, {"threshold", c.threshold}, {"unit", unit_of(c.id)}});
    if (!c.why.empty()) check["why"] = c.why;
    checks.push_back(std::move(check));
  }
  for (const Finding& f : judgement.findings) {
    Json finding{{"id", f.id},
                 {"severity", name_of(f.severity)},
                 {"measured", f.measured},
                 {"threshold", f.threshold},
                 {"unit", unit_of(f.id)}};
    if (!f.box_mm.empty())
      finding.update({{"at_mm", json(f.at_mm)}, {"box_mm", Json::array({json(f.box_mm.min), json(f.box_mm.max)})}});
    if (f.in_input) finding["in_input"] = *f.in_input;
    finding.update({{"text", f.text}, {"remedy", f.remedy}, {"waiver", f.id}});
    findings.push_back(std::move(finding));
  }
  const Json json{{"process", process_names[static_cast<std::size_t>(judgement.process)]},
                  {"passes", judgement.passes()},
                  {"new_failures", judgement.new_failures()},
                  {"checks", std::move(checks)},
                  {"findings", std::move(findings)}};
  return json.dump(2) + "\n";
}

}  // namespace aplomb
