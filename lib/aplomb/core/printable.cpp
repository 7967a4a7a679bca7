#include "aplomb/core/printable.h"

namespace aplomb {

std::string printable(std::string_view text, std::size_t most) {
  std::string shown;
  char before = 0;
  for (const char c : text.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_c1 = before == '\xC2' && byte >= 0x80 && byte < 0xA0;  // U+0080 to U+009F
    shown += byte < 32 || byte == 127 || is_c1 ? '?' : c;
    before = c;
  }
  return text.size() > most ? shown + "..." : shown;
}

}  // namespace aplomb
