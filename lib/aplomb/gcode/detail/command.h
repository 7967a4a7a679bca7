#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace aplomb::detail {

/// One line of a program: "G1 X10 Y20.5 E1.2".
class Command {
 public:
  /// Reads a line; an empty one, or one that holds only a comment, has no letter().
  explicit Command(std::string_view line);

  char letter() const { return letter_; }  ///< 'G', 'M', 'T', or 0
  int number() const { return number_; }   ///< -1 where it has a fraction, or none
  std::string_view rest() const { return rest_; }

  /// Finds the words behind the number. Of a command that takes text they mean nothing.
  void read_words();
  bool has(char word) const { return (present_ & bit(word)) != 0; }
  /// A word without a number, such as "Y{depth}", "Xnan" or "X1,5", or one that stands twice, as X does in "X0x10".
  bool is_unreadable(char word) const { return (unreadable_ & bit(word)) != 0; }
  /// \pre has(word), after read_words().
  double value(char word) const { return values_[static_cast<std::size_t>(word - 'A')]; }
  double value_or(char word, double otherwise) const { return has(word) ? value(word) : otherwise; }

 private:
  static std::uint32_t bit(char word) { return std::uint32_t{1} << static_cast<unsigned>(word - 'A'); }

  std::string_view rest_;
  char letter_ = 0;
  int number_ = -1;
  std::uint32_t present_ = 0, unreadable_ = 0;
  std::array<double, 26> values_;  // only those that are present
};

}  // namespace aplomb::detail
