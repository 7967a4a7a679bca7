#include "aplomb/printability/finding.h"

#include <algorithm>

namespace aplomb {

bool Judgement::passes() const {
  return std::ranges::none_of(checks, [](const CheckResult& c) { return c.verdict == CheckResult::Verdict::failed; });
}

}  // namespace aplomb
