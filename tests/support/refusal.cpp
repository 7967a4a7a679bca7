#include "support/refusal.h"

#include <algorithm>
#include <iterator>

namespace aplomb::test {
namespace {

bool holds_one_of(std::string_view text, const auto& words) {
  return std::any_of(std::begin(words), std::end(words),
                     [text](std::string_view w) { return text.find(w) != text.npos; });
}

bool begins_with_one_of(std::string_view text, const auto& words) {
  return std::any_of(std::begin(words), std::end(words), [text](std::string_view w) { return text.starts_with(w); });
}

/// Of the file as a whole, so that no place in it can be named.
constexpr std::string_view whole_file[] = {"the file is empty",   "it holds no triangles",   "neither ",
                                           "the zip holds no ",   "its zip has a ",          "it cannot be opened as",
                                           "reading it needs ",   "holds more than ",        "its concave polygons",
                                           "its components make", "larger than the memory ", " exceed the memory "};
constexpr std::string_view places[] = {"line ",   "byte ", "facet ",     "part \"",
                                       "vertex ", "face ", "tristrips ", "element \""};
constexpr std::string_view remedies[] = {"save", "export", "repair", "simplify", "triangulate", "allow"};

}  // namespace

std::string lack_of_refusal(std::string_view message, std::string_view file_name) {
  if (message.empty() || message.size() >= 1000) return "a fitting length";
  for (std::size_t i = 0; i < message.size(); ++i) {
    const auto byte = static_cast<unsigned char>(message[i]);
    const bool is_c1 = i > 0 && message[i - 1] == '\xC2' && byte >= 0x80 && byte < 0xA0;
    if (byte < 32 || byte == 127 || is_c1) return "text without control characters";
  }
  if (!message.starts_with(file_name)) return "the file's name in front";
  const std::string_view rest = message.substr(file_name.size());
  if (rest.starts_with(": ")) {
    if (!holds_one_of(rest, whole_file)) return "a place";
  } else if (!rest.starts_with(", ") || !begins_with_one_of(rest.substr(2), places) || rest.find(": ") == rest.npos) {
    return "a place after the name";
  }
  const std::size_t mark = rest.rfind(';');
  return mark == rest.npos || !holds_one_of(rest.substr(mark), remedies) ? "a remedy" : "";
}

}  // namespace aplomb::test
