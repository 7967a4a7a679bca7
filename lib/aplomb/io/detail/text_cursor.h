#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace aplomb::detail {

/// Reads words and numbers from text, line by line or across lines, without copying, without limits on length and
/// without the locale. A carriage return ends a line as a line feed does; callers skip empty lines.
class TextCursor {
 public:
  /// Skips a UTF-8 byte order mark.
  explicit TextCursor(std::string_view text) : begin_(text.data()), at_(begin_), end_(begin_ + text.size()) {
    if (text.starts_with("\xEF\xBB\xBF")) at_ += 3;
  }

  bool at_end() const { return at_ == end_; }
  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  double share_read() const {
    return end_ == begin_ ? 1 : static_cast<double>(offset()) / static_cast<double>(end_ - begin_);
  }

  /// After blanks: nothing more on this line but perhaps a comment.
  bool at_line_end() {
    skip_blanks();
    return at_ == end_ || is_line_end(*at_) || *at_ == '#';
  }
  /// To the start of the next line.
  void next_line() {
    while (at_ != end_ && !is_line_end(*at_)) ++at_;
    if (at_ == end_) return;
    at_ += *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n' ? 2 : 1;
  }
  /// To the first word at or after the cursor, over empty lines and comments.
  void skip_to_word() {
    while (at_line_end() && at_ != end_) next_line();
  }
  /// The next word of this line; empty at its end.
  std::string_view word() {
    skip_blanks();
    const char* start = at_;
    while (at_ != end_ && !is_blank(*at_) && !is_line_end(*at_)) ++at_;
    return {start, static_cast<std::size_t>(at_ - start)};
  }
  /// The rest of this line, without blanks around it.
  std::string_view rest_of_line() {
    skip_blanks();
    const char* start = at_;
    while (at_ != end_ && !is_line_end(*at_)) ++at_;
    const char* stop = at_;
    while (stop != start && is_blank(stop[-1])) --stop;
    return {start, static_cast<std::size_t>(stop - start)};
  }
  /// The next number of this line if it is one that float32 can hold; the cursor stays where it was if not.
  std::optional<double> number() {
    skip_blanks();
    const char* start = at_ != end_ && *at_ == '+' ? at_ + 1 : at_;
    double value = 0;
    const auto [stop, error] = std::from_chars(start, end_, value);
    if (error == std::errc::invalid_argument || !ends_word(stop) || (start != at_ && *start == '-')) return {};
    if (error == std::errc::result_out_of_range) value = too_small({start, stop}) ? 0 : HUGE_VAL;
    if (!(std::abs(value) <= std::numeric_limits<float>::max())) return {};
    at_ = stop;
    return value;
  }
  /// The next whole number of this line; the cursor stays where it was if there is none. Stops before a '/'.
  std::optional<long long> integer() {
    skip_blanks();
    long long value = 0;
    const auto [stop, error] = std::from_chars(at_, end_, value);
    if (error != std::errc() || (!ends_word(stop) && *stop != '/')) return {};
    at_ = stop;
    return value;
  }
  void skip_word() {
    while (at_ != end_ && !is_blank(*at_) && !is_line_end(*at_)) ++at_;
  }

  /// "line 12", for messages. Linear in the offset.
  std::string place() const {
    std::size_t line = 1;
    for (const char* p = begin_; p != at_; ++p)
      if (*p == '\n' || (*p == '\r' && (p + 1 == end_ || p[1] != '\n'))) ++line;
    return "line " + std::to_string(line);
  }
  /// What stands at the cursor, for messages.
  std::string_view peek_word() const { return TextCursor(*this).word(); }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
  bool ends_word(const char* p) const { return p == end_ || is_blank(*p) || is_line_end(*p) || *p == '#'; }
  /// Of a number that double cannot hold: whether it is too near zero rather than too large. Where its first digit
  /// other than 0 stands, and its exponent, say how large it is; neither alone does.
  static bool too_small(std::string_view number) {
    const auto mark = std::min(number.find_first_of("eE"), number.size());
    const std::string_view digits = number.substr(0, mark);
    const auto first = digits.find_first_of("123456789"), point = std::min(digits.find('.'), digits.size());
    if (first == digits.npos) return true;
    double exponent = 0;  // of any length
    for (const char c : number.substr(mark))
      if (c >= '0' && c <= '9') exponent = 10 * exponent + (c - '0');
    if (number.substr(mark).find('-') != number.npos) exponent = -exponent;
    return static_cast<double>(point) - static_cast<double>(first) + exponent < 0;
  }
  void skip_blanks() {
    while (at_ != end_) {
      if (is_blank(*at_)) ++at_;
      else if (*at_ == '\\' && at_ + 1 != end_ && is_line_end(at_[1]))  // OBJ: the line goes on below
        at_ += at_[1] == '\r' && at_ + 2 != end_ && at_[2] == '\n' ? 3 : 2;
      else return;
    }
  }

  const char* begin_;
  const char* at_;
  const char* end_;
};

}  // namespace aplomb::detail
