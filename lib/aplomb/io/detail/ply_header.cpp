#include "aplomb/io/detail/ply_header.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace aplomb::detail {
namespace {

constexpr std::size_t kMostElements = 100, kMostProperties = 1000;

std::optional<PlyType> type_named(std::string_view name) {
  constexpr std::pair<std::string_view, PlyType> kNames[] = {
      {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
      {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
      {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
      {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
      {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
      {"float64", PlyType::float64}};
  for (const auto& [known, type] : kNames)
    if (known == name) return type;
  return {};
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  while (words.size() < 8) {
    const auto start = line.find_first_not_of(" \t\r");
    if (start == line.npos) break;
    const auto stop = std::min(line.find_first_of(" \t\r", start), line.size());
    words.push_back(line.substr(start, stop - start));
    line.remove_prefix(stop);
  }
  return words;
}

/// Understands one line of the header at a time.
class HeaderReader {
 public:
  explicit HeaderReader(const ReadContext& context) : context_(context) {}

  Result<PlyHeader> read() {
    std::string_view rest = context_.text();
    const char line_end = rest.substr(3, 2) == "\r\n" || rest[3] == '\n' ? '\n' : '\r';
    for (;;) {
      const auto end = rest.find(line_end);
      if (end == rest.npos)
        return context_.unusable(place(), "the header has no end_header; it was cut short, save the file again");
      const auto words = words_of(rest.substr(0, end));
      rest.remove_prefix(end + 1);
      ++line_;
      if (words.empty() || words[0] == "comment" || words[0] == "obj_info" || words[0] == "ply") continue;
      if (words[0] == "end_header") break;
      if (auto done = read_line(words); !done) return tl::unexpected<Error>(done.error());
    }
    header_.data_offset = context_.text().size() - rest.size();
    return check_counts(rest.size());
  }

 private:
  Result<void> read_line(const std::vector<std::string_view>& words) {
    if (words[0] == "format" && words.size() >= 2) return read_format(words[1]);
    if (words[0] == "element" && words.size() >= 3) return read_element(words);
    if (words[0] == "property" && words.size() >= 3) return read_property(words);
    return context_.unusable(place(), in_quotes(words[0]) + " is no line of a PLY header; export the model again");
  }

  Result<void> read_format(std::string_view format) {
    if (format == "ascii") header_.encoding = PlyEncoding::ascii;
    else if (format == "binary_little_endian") header_.encoding = PlyEncoding::little_endian;
    else if (format == "binary_big_endian") header_.encoding = PlyEncoding::big_endian;
    else return context_.unusable(place(), "the encoding " + in_quotes(format) + " is unknown; save it as ASCII");
    has_format_ = true;
    return {};
  }

  Result<void> read_element(const std::vector<std::string_view>& words) {
    PlyElement element{words[1], 0, line_, {}};
    const char* end = words[2].data() + words[2].size();
    const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
    if (error != std::errc() || stop != end)
      return context_.unusable(place(), in_quotes(words[2]) + " is no number of elements; export the model again");
    for (const PlyElement& other : header_.elements)
      if (other.name == element.name)
        return context_.unusable(place(), "there are two elements " + in_quotes(words[1]) + "; export the model again");
    if (header_.elements.size() == kMostElements)
      return context_.unusable(place(), "the header has more than 100 elements; export the model again");
    header_.elements.push_back(std::move(element));
    return {};
  }

  Result<void> read_property(const std::vector<std::string_view>& words) {
    if (header_.elements.empty())
      return context_.unusable(place(), "a property stands before any element; export the model again");
    const bool list = words[1] == "list";
    if (list && words.size() < 5)
      return context_.unusable(place(), "a list property lacks its types or its name; export the model again");
    const auto count_type = list ? type_named(words[2]) : std::nullopt;
    const auto type = type_named(list ? words[3] : words[1]);
    const bool bad_count = list && (!count_type || *count_type >= PlyType::float32);
    if (!type || bad_count)
      return context_.unusable(place(), in_quotes(words[bad_count ? 2
                                                        : list    ? 3
                                                                  : 1]) +
                                            " is not a type that can stand here; export the model again");
    if (header_.elements.back().properties.size() == kMostProperties)
      return context_.unusable(place(), "an element has more than 1000 properties; export the model again");
    header_.elements.back().properties.push_back({list ? words[4] : words[2], *type, count_type});
    return {};
  }

  Result<PlyHeader> check_counts(std::size_t bytes_left) {
    if (!has_format_) return context_.unusable(place(), "the header names no format; export the model again");
    double least = 0;
    for (const PlyElement& element : header_.elements) {
      double each = 0;
      for (const PlyProperty& property : element.properties)
        each += header_.encoding == PlyEncoding::ascii
                    ? 2.0  // a digit and a blank
                    : static_cast<double>(size_of(property.count_type.value_or(property.type)));
      least += each * static_cast<double>(element.count);
    }
    if (least > static_cast<double>(bytes_left) + 1)
      return context_.unusable(
          "byte " + std::to_string(header_.data_offset),
          "the header promises more elements than the file can hold; it was cut short, save it again");
    return std::move(header_);
  }

  std::string place() const { return "line " + std::to_string(line_); }

  const ReadContext& context_;
  PlyHeader header_;
  std::size_t line_ = 0;
  bool has_format_ = false;
};

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::find(std::string_view property) const {
  const auto at = std::find_if(properties.begin(), properties.end(), [&](const auto& p) { return p.name == property; });
  return static_cast<std::size_t>(at - properties.begin());
}

Result<PlyHeader> read_ply_header(const ReadContext& context) { return HeaderReader(context).read(); }

}  // namespace aplomb::detail
