// Model XML, wrapped into a zip here so that mutations reach the XML. Parts beyond the root one follow a line
// "--- NAME"; the mutator works on whole elements and on attributes' values.
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "check_mesh.h"
#include "support/zip_files.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

using namespace aplomb;

constexpr std::string_view separator = "\n--- ";

/// The root part's XML and the named parts behind it.
std::string package_of(std::string_view text) {
  std::vector<test::ZipEntry> more;
  const std::string_view model = text.substr(0, text.find(separator));
  text.remove_prefix(model.size());
  while (!text.empty()) {
    text.remove_prefix(separator.size());
    const std::string_view part = text.substr(0, text.find(separator));
    const std::size_t line_end = std::min(part.find('\n'), part.size());
    more.push_back(
        {std::string(part.substr(0, line_end)), std::string(part.substr(std::min(part.size(), line_end + 1)))});
    text.remove_prefix(part.size());
  }
  return test::package(model, std::move(more));
}

struct Span {
  std::size_t from = 0, size = 0;
};

/// All that lies between an `open` and the next `close`, both included.
std::vector<Span> spans(const std::string& text, char open, char close) {
  std::vector<Span> found;
  for (std::size_t from = text.find(open); from != text.npos;) {
    const std::size_t to = text.find(close, from + 1);
    if (to == text.npos) break;
    found.push_back({from, to + 1 - from});
    from = text.find(open, open == close ? to + 1 : from + 1);
  }
  return found;
}

/// From an element's start tag to its end tag, as far as they can be paired by name.
Span whole_element(const std::string& text, Span tag) {
  const std::string name = text.substr(tag.from + 1, text.find_first_of(" />", tag.from) - tag.from - 1);
  if (name.empty() || text[tag.from + tag.size - 2] == '/') return tag;
  const std::size_t end = text.find("</" + name + ">", tag.from);
  return end == text.npos ? tag : Span{tag.from, end + name.size() + 3 - tag.from};
}

void mutate_value(std::string& text, Span value, std::size_t room) {
  std::vector<std::uint8_t> bytes(text.begin() + static_cast<std::ptrdiff_t>(value.from + 1),
                                  text.begin() + static_cast<std::ptrdiff_t>(value.from + value.size - 1));
  const std::size_t size = bytes.size();
  bytes.resize(size + std::min<std::size_t>(room, 16) + 1);
  bytes.resize(LLVMFuzzerMutate(bytes.data(), size, bytes.size()));
  text.replace(value.from + 1, value.size - 2, std::string(bytes.begin(), bytes.end()));
}

void mutate(std::string& text, std::mt19937& random, std::size_t most) {
  const std::vector<Span> tags = spans(text, '<', '>'), values = spans(text, '"', '"');
  const auto any = [&random](const std::vector<Span>& list) { return list[random() % list.size()]; };
  const unsigned way = random() % 8;
  if (way < 3 && !values.empty()) return mutate_value(text, any(values), most - text.size());
  if (tags.empty()) return;
  const Span element = whole_element(text, any(tags));
  if (way == 3) text.erase(element.from, element.size);
  else if (way < 6) text.insert(any(tags).from, text.substr(element.from, element.size));
  else if (!values.empty()) text.replace(any(values).from, 0, text.substr(any(values).from, any(values).size));
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  std::mt19937 random(seed);
  if (random() % 4 == 0) return LLVMFuzzerMutate(data, size, most);
  std::string text(reinterpret_cast<const char*>(data), size);
  mutate(text, random, most);
  if (text.size() > most) return LLVMFuzzerMutate(data, size, most);
  text.copy(reinterpret_cast<char*>(data), text.size());
  return text.size();
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes = package_of({reinterpret_cast<const char*>(data), size});
  fuzz::check_mesh({reinterpret_cast<const std::byte*>(bytes.data()), bytes.size()}, "a.3mf");
  return 0;
}
