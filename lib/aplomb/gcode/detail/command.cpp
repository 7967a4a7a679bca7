#include "aplomb/gcode/detail/command.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace aplomb::detail {
namespace {

constexpr std::array<double, 19> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                               1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};
constexpr int most_digits = 18;  // that fit 64 bits; correctly rounded up to 15, as many as slicers write

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// Takes a number off the front; an "E" behind it is the next word, not an exponent.
std::optional<double> take_number(std::string_view& text) {
  const char* at = text.data();
  const char* const end = at + text.size();
  const bool is_negative = at != end && *at == '-';
  if (at != end && (*at == '-' || *at == '+')) ++at;
  std::uint64_t digits = 0;
  const char* const whole = at;
  for (; at != end && is_digit(*at); ++at) digits = 10 * digits + static_cast<std::uint64_t>(*at - '0');
  std::ptrdiff_t count = at - whole, decimals = 0;
  if (count > most_digits) return std::nullopt;
  if (at != end && *at == '.') {
    const char* const fraction = ++at;
    const char* const last = fraction + std::min<std::ptrdiff_t>(end - fraction, most_digits - count);
    for (; at != last && is_digit(*at); ++at) digits = 10 * digits + static_cast<std::uint64_t>(*at - '0');
    decimals = at - fraction;
    count += decimals;
    while (at != end && is_digit(*at)) ++at;  // beyond any machine's precision
  }
  if (count == 0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(at - text.data()));
  const double value = static_cast<double>(digits) / powers_of_ten[static_cast<std::size_t>(decimals)];
  return is_negative ? -value : value;
}

bool is_letter(char c) { return upper(c) >= 'A' && upper(c) <= 'Z'; }

/// What may follow a number: "1,5", "1.2.3" and "1-2" are none.
bool ends_a_number(std::string_view text) {
  return text.empty() || is_blank(text[0]) || is_letter(text[0]) || text.find_first_of(";*(/\r") == 0;
}

void skip_blanks(std::string_view& text) {
  while (!text.empty() && is_blank(text[0])) text.remove_prefix(1);
}

}  // namespace

Command::Command(std::string_view line) : rest_(line) {
  skip_blanks(rest_);
  if (!rest_.empty() && upper(rest_[0]) == 'N' && rest_.size() > 1 && is_digit(rest_[1])) {  // a line's number
    rest_.remove_prefix(1);
    take_number(rest_);
    skip_blanks(rest_);
  }
  if (rest_.empty() || rest_[0] == ';') return;
  const char letter = upper(rest_[0]);
  if (letter != 'G' && letter != 'M' && letter != 'T') return;
  std::string_view behind = rest_.substr(1);
  const bool has_number = !behind.empty() && is_digit(behind[0]);
  const auto number = has_number ? take_number(behind) : std::nullopt;
  if (!number || *number > 1e6) return;
  letter_ = letter;
  if (*number == static_cast<int>(*number)) number_ = static_cast<int>(*number);
  rest_ = behind;
}

void Command::read_words() {
  std::string_view text = rest_;
  while (!text.empty()) {
    const char c = upper(text[0]);
    text.remove_prefix(1);
    if (c == ';' || c == '*') return;
    if (c == '(') text.remove_prefix(std::min(text.size(), text.find(')') + 1));
    if (c < 'A' || c > 'Z') continue;
    const bool is_apart = !text.empty() && is_blank(text[0]);
    skip_blanks(text);
    const auto number = take_number(text);
    const bool is_twice = ((present_ | unreadable_) & bit(c)) != 0;  // as "X0x10" has an X, for a printer
    if (number && ends_a_number(text) && !is_twice) {
      present_ |= bit(c);
      values_[static_cast<std::size_t>(c - 'A')] = *number;
      continue;
    }
    present_ &= ~bit(c);
    unreadable_ |= bit(c);
    if (is_apart && !text.empty() && is_letter(text[0])) continue;  // the next word
    while (!text.empty() && !is_blank(text[0]) && text[0] != ';') text.remove_prefix(1);
  }
}

}  // namespace aplomb::detail
