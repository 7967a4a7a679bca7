#pragma once

#include <gtest/gtest.h>

#include <string_view>

#include "support/mesh_files.h"
#include "support/refusal.h"

namespace aplomb::test {

/// Fails the test unless reading ends in an error of this kind, in a sentence as it is promised that holds `words`.
inline void expect_refused(std::string_view bytes, std::string_view name, std::string_view words,
                           ErrorCode code = ErrorCode::unusable_input) {
  const auto file = read_text(bytes, name);
  ASSERT_FALSE(file) << name << " was read, without " << words << ": " << bytes.substr(0, 60);
  EXPECT_EQ(file.error().code, code) << file.error().message;
  EXPECT_EQ(lack_of_refusal(file.error().message, name), "") << file.error().message;
  EXPECT_NE(file.error().message.find(words), std::string::npos) << file.error().message << "\nlacks " << words;
}

}  // namespace aplomb::test
