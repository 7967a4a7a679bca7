#include <algorithm>
#include <bit>

#include "aplomb/io/detail/ply_header.h"
#include "aplomb/io/detail/polygon.h"
#include "aplomb/io/detail/readers.h"
#include "aplomb/io/detail/text_cursor.h"

namespace aplomb::detail {
namespace {

/// The data of an ASCII PLY, one number after the other.
class AsciiSource {
 public:
  explicit AsciiSource(std::string_view text) : text_(text) {}
  bool read(PlyType, double& value) {
    text_.skip_to_word();
    const auto number = text_.number();
    value = number.value_or(0);
    return number.has_value();
  }
  bool skip(PlyType, std::size_t count) {
    for (; count > 0; --count) {
      text_.skip_to_word();
      if (text_.at_end()) return false;
      text_.skip_word();
    }
    return true;
  }
  double share_read() const { return text_.share_read(); }

 private:
  TextCursor text_;
};

/// The data of a binary PLY of either byte order.
template <bool swap>
class BinarySource {
 public:
  explicit BinarySource(std::string_view data) : at_(data.data()), begin_(at_), end_(at_ + data.size()) {}
  bool read(PlyType type, double& value) {
    if (left() < size_of(type)) return false;
    switch (type) {
      case PlyType::int8:
        value = take<std::int8_t>();
        break;
      case PlyType::uint8:
        value = take<std::uint8_t>();
        break;
      case PlyType::int16:
        value = take<std::int16_t>();
        break;
      case PlyType::uint16:
        value = take<std::uint16_t>();
        break;
      case PlyType::int32:
        value = take<std::int32_t>();
        break;
      case PlyType::uint32:
        value = take<std::uint32_t>();
        break;
      case PlyType::float32:
        value = std::bit_cast<float>(take<std::uint32_t>());
        break;
      case PlyType::float64:
        value = std::bit_cast<double>(take<std::uint64_t>());
        break;
    }
    return true;
  }
  bool skip(PlyType type, std::size_t count) {
    if (count > left() / size_of(type)) return false;
    at_ += count * size_of(type);
    return true;
  }
  double share_read() const { return static_cast<double>(at_ - begin_) / static_cast<double>(end_ - begin_ + 1); }

 private:
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }
  template <class T>
  T take() {
    char raw[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) raw[swap ? sizeof(T) - 1 - i : i] = at_[i];
    at_ += sizeof(T);
    return std::bit_cast<T>(raw);
  }

  const char* at_;
  const char* begin_;
  const char* end_;
};

template <class Source>
class PlyReader {
 public:
  PlyReader(ReadContext& context, const PlyHeader& header)
      : context_(context),
        header_(header),
        source_(context.text().substr(header.data_offset)),
        mesh_(context),
        cutter_(mesh_, context) {}

  Result<MeshFile> read() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;
      for (std::size_t i = 0; i < element.count; ++i) {
        if (i % 65536 == 0 && !context_.proceed(source_.share_read())) return cancelled();
        at_ = i;
        Result<void> done = element.name == "vertex"      ? read_vertex(element)
                            : element.name == "face"      ? read_face(element)
                            : element.name == "tristrips" ? read_strip(element)
                                                          : skip_all(element);
        if (!done) return tl::unexpected<Error>(done.error());
      }
      if (element.name != "vertex" && element.name != "face" && element.name != "tristrips")
        context_.note("the elements " + in_quotes(element.name) + " were ignored");
    }
    return single_object("PLY", "", mesh_.take());
  }

 private:
  Result<void> read_vertex(const PlyElement& element) {
    if (at_ == 0) {
      for (int axis = 0; axis < 3; ++axis) axes_[axis] = element.find(std::string_view("xyz").substr(axis, 1));
      for (const std::size_t axis : axes_)
        if (axis == element.properties.size() || element.properties[axis].count_type)
          return context_.unusable(header_line(element), "its vertices lack x, y or z; export the model again");
      if (auto reserved = mesh_.reserve(element.count, 0); !reserved) return reserved;
    }
    Vec3 position;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const int axis = p == axes_[0] ? 0 : p == axes_[1] ? 1 : p == axes_[2] ? 2 : -1;
      if (axis < 0) {
        if (!skip(element.properties[p])) return broken(element);
      } else if (!source_.read(element.properties[p].type, position[axis]) ||
                 !(std::abs(position[axis]) <= std::numeric_limits<float>::max())) {
        return context_.unusable(place(element),
                                 "a coordinate is missing or not a finite number; repair or export the model again");
      }
    }
    if (!mesh_.add_vertex(position)) return mesh_.failure();
    return {};
  }

  /// Reads an element's corners into corners_; -1 stays, as all bits set.
  Result<void> read_corners(const PlyElement& element, bool allow_minus_one) {
    const std::size_t indices = std::min(element.find("vertex_indices"), element.find("vertex_index"));
    if (indices == element.properties.size() || !element.properties[indices].count_type)
      return context_.unusable(header_line(element), "its elements " + in_quotes(element.name) +
                                                         " lack a list vertex_indices; export the model again");
    corners_.clear();
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      double count = 0;
      if (p != indices) {
        if (!skip(property)) return broken(element);
        continue;
      }
      if (!source_.read(*property.count_type, count) || !(count >= 0 && count == std::floor(count)))
        return broken(element);
      for (double i = 0; i < count; ++i) {
        if (auto admitted = context_.admit_corner(corners_.size()); !admitted) return admitted;
        double index = 0;
        if (!source_.read(property.type, index)) return broken(element);
        const bool separator = allow_minus_one && index == -1;
        if (!separator &&
            !(index >= 0 && index < static_cast<double>(mesh_.mesh().vertices.size()) && index == std::floor(index)))
          return out_of_range(element, index);
        corners_.push_back(separator ? kSeparator : static_cast<std::uint32_t>(index));
      }
    }
    return {};
  }

  Result<void> read_face(const PlyElement& element) {
    if (auto done = read_corners(element, false); !done) return done;
    if (corners_.size() >= 3) return cutter_.add(corners_);
    context_.note("faces with fewer than three corners were ignored");
    return {};
  }

  /// Strips of triangles, turned over every other time, with -1 between two strips.
  Result<void> read_strip(const PlyElement& element) {
    if (auto done = read_corners(element, true); !done) return done;
    std::size_t start = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] == kSeparator) start = i + 1;
      if (i < start + 2) continue;
      const bool odd = (i - start) % 2 == 1;
      const Triangle t{corners_[i - 2], corners_[odd ? i : i - 1], corners_[odd ? i - 1 : i]};
      const bool stitch = t[0] == t[1] || t[1] == t[2] || t[2] == t[0];  // how strips are joined, no surface
      if (!stitch && !mesh_.add_triangle(t)) return mesh_.failure();
    }
    return {};
  }

  Result<void> skip_all(const PlyElement& element) {
    for (const PlyProperty& property : element.properties)
      if (!skip(property)) return broken(element);
    return {};
  }

  bool skip(const PlyProperty& property) {
    double count = 1;
    if (property.count_type && (!source_.read(*property.count_type, count) || !(count >= 0 && count < 5e9)))
      return false;
    return source_.skip(property.type, static_cast<std::size_t>(count));
  }

  static std::string header_line(const PlyElement& element) { return "line " + std::to_string(element.line); }
  std::string place(const PlyElement& element) const {
    const bool is_known = element.name == "vertex" || element.name == "face" || element.name == "tristrips";
    return (is_known ? std::string(element.name) : "element " + in_quotes(element.name)) + " " + std::to_string(at_);
  }
  tl::unexpected<Error> broken(const PlyElement& element) const {
    return context_.unusable(place(element),
                             "the data end here or are no numbers; the file was cut short, save it again");
  }
  tl::unexpected<Error> out_of_range(const PlyElement& element, double index) const {
    const std::string shown = std::abs(index) < 1e15 ? " " + std::to_string(static_cast<long long>(index)) : "";
    return context_.unusable(place(element), "vertex index" + shown + " is out of range, there are " +
                                                 std::to_string(mesh_.mesh().vertices.size()) +
                                                 " vertices before it; export the model again");
  }

  static constexpr std::uint32_t kSeparator = 0xffffffff;

  ReadContext& context_;
  const PlyHeader& header_;
  Source source_;
  GrowingMesh mesh_;
  PolygonCutter cutter_;
  std::vector<std::uint32_t> corners_;
  std::size_t axes_[3] = {};
  std::size_t at_ = 0;  // index of the element at hand
};

}  // namespace

Result<MeshFile> read_ply(ReadContext& context) {
  if (!context.text().starts_with("ply\n") && !context.text().starts_with("ply\r"))
    return context.unusable("byte 0", "it does not begin with \"ply\"; export the model again");
  const Result<PlyHeader> header = read_ply_header(context);
  if (!header) return tl::unexpected<Error>(header.error());
  switch (header->encoding) {
    case PlyEncoding::ascii:
      return PlyReader<AsciiSource>(context, *header).read();
    case PlyEncoding::little_endian:
      return PlyReader<BinarySource<false>>(context, *header).read();
    case PlyEncoding::big_endian:
      return PlyReader<BinarySource<true>>(context, *header).read();
  }
  return context.unusable("byte 0", "its encoding is unknown; save it as ASCII");
}

}  // namespace aplomb::detail
