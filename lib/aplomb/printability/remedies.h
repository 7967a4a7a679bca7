#pragma once

#include <string_view>

namespace aplomb {

/// A sentence on what helps against a finding of this check. \pre id is one of check_rules().
std::string_view remedy_of(std::string_view id);

}  // namespace aplomb
