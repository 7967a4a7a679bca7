#include <fmt/format.h>

#include "aplomb/printability/judge.h"

namespace aplomb {

Result<Rules> rules_of(const RuleChanges& changes) {
  Rules rules(changes.process);
  rules.layer_mm = changes.layer_mm;
  for (const RuleLimit& limit : changes.limits)
    if (const auto set = rules.set(limit.id, limit.value); !set) return tl::unexpected(set.error());
  for (const std::string& id : changes.waived)
    if (const auto waived = rules.waive(id); !waived) return tl::unexpected(waived.error());
  return rules;
}

std::string find_problem(const JudgeOptions& o) {
  if (!(o.rules.layer_mm > 0 && o.rules.layer_mm <= 100))
    return fmt::format("layer_mm is {}; it must lie in (0, 100]", o.rules.layer_mm);
  if (!(o.filling.infill_ratio >= 0 && o.filling.infill_ratio <= 1))
    return fmt::format("infill_ratio is {}; it must lie in [0, 1]", o.filling.infill_ratio);
  if (!(o.filling.skin_mm > 0 && o.filling.skin_mm <= 100))
    return fmt::format("skin_mm is {}; it must lie in (0, 100]", o.filling.skin_mm);
  if (!(o.density_g_per_cm3 > 0 && o.density_g_per_cm3 < 30))
    return fmt::format("density_g_per_cm3 is {}; it must lie in (0, 30)", o.density_g_per_cm3);
  return o.pose ? find_problem(*o.pose) : "";
}

}  // namespace aplomb
