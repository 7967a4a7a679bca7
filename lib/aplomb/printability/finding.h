#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/stress_field.h"

namespace aplomb {

enum class Severity { info, warn, fail };

/// A place where something was measured, in the unit of its check.
struct Place {
  double measured = 0;
  Vec3 at_mm;   ///< where it is worst
  Box3 box_mm;  ///< all of it; empty where it is the whole model
};

/// Something about a mesh that a print suffers from, where it is, and what helps.
struct Finding {
  std::string id;  ///< of its check, such as "wall.void_outer"; also the key that waives it
  Severity severity = Severity::warn;
  double measured = 0;   ///< in the check's unit
  double threshold = 0;  ///< that `measured` is on the wrong side of
  Vec3 at_mm;            ///< the worst place
  Box3 box_mm;           ///< all of it; empty where it is the whole model
  std::string text;      ///< a sentence: what is wrong, with numbers
  std::string remedy;    ///< a sentence: what helps
  /// What the check measured there before anything was carved or bent, where it was found then too: mark_inherited().
  std::optional<double> in_input{};
};

/// What came of one check.
struct CheckResult {
  enum class Verdict {
    passed,
    info,
    warned,
    failed,
    waived,      ///< there are findings, and the user accepts them
    not_judged,  ///< it cannot be: `why` says it
  };
  std::string id;
  Verdict verdict = Verdict::passed;
  bool has_measure = false;  ///< whether there was anything to measure
  double measured = 0;       ///< the worst, in the check's unit
  double threshold = 0;      ///< of the worst severity that it met, or the next one to meet
  std::string why;
};

/// What the judge says of a mesh.
struct Judgement {
  Process process = Process::fdm;   ///< that it was judged for
  std::vector<CheckResult> checks;  ///< every check of the process that was asked for, in the order of check_rules()
  std::vector<Finding> findings;    ///< in the same order
  std::optional<StressField> stress{};  ///< of strength.fem, where that was judged

  /// No check failed that was not waived.
  bool passes() const;
  /// Checks that fail, not waived, at places where they did not in the input.
  std::vector<std::string> new_failures() const;
};

/// Notes which findings about what was made of a model are findings about the model as it came: those that a check
/// made there too, as severe or more, with boxes that come within `reach_mm` of each other (or the whole model).
void mark_inherited(Judgement& made, const Judgement& input, double reach_mm);

}  // namespace aplomb
