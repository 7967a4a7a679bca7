#include "aplomb/printability/finding.h"

#include <algorithm>

namespace aplomb {
namespace {

bool is_waived(const Judgement& judgement, const std::string& id) {
  const auto check = std::ranges::find(judgement.checks, id, &CheckResult::id);
  return check != judgement.checks.end() && check->verdict == CheckResult::Verdict::waived;
}

bool come_near(const Box3& a, const Box3& b, double reach_mm) {
  if (a.empty() || b.empty()) return true;
  for (int axis = 0; axis < 3; ++axis)
    if (a.min[axis] > b.max[axis] + reach_mm || b.min[axis] > a.max[axis] + reach_mm) return false;
  return true;
}

}  // namespace

bool Judgement::passes() const {
  return std::ranges::none_of(checks, [](const CheckResult& c) { return c.verdict == CheckResult::Verdict::failed; });
}

std::vector<std::string> Judgement::new_failures() const {
  std::vector<std::string> ids;
  for (const Finding& finding : findings)
    if (finding.severity == Severity::fail && !finding.in_input && !is_waived(*this, finding.id) &&
        (ids.empty() || ids.back() != finding.id))
      ids.push_back(finding.id);
  return ids;
}

void mark_inherited(Judgement& made, const Judgement& input, double reach_mm) {
  for (Finding& finding : made.findings)
    for (const Finding& before : input.findings)
      if (before.id == finding.id && before.severity >= finding.severity &&
          come_near(before.box_mm, finding.box_mm, reach_mm)) {
        finding.in_input = before.measured;
        break;
      }
}

}  // namespace aplomb
