#include <bit>
#include <cstring>

#include "aplomb/io/detail/readers.h"
#include "aplomb/io/detail/text_cursor.h"
#include "aplomb/io/detail/vertex_index.h"

namespace aplomb::detail {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read and written as it lies in memory");

constexpr std::size_t kHeader = 84, kFacet = 50;

std::uint32_t facet_count(std::span<const std::byte> bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  return count;
}

bool same_word(std::string_view word, std::string_view lower_case) {
  return std::equal(word.begin(), word.end(), lower_case.begin(), lower_case.end(),
                    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

/// Reads an ASCII STL word by word; line breaks mean nothing but after a name.
class AsciiReader {
 public:
  explicit AsciiReader(ReadContext& context)
      : context_(context), text_(context.text()), mesh_(context), index_(mesh_, context) {}

  Result<MeshFile> read() {
    for (std::size_t words = 0;; ++words) {
      text_.skip_to_word();
      if (text_.at_end()) break;
      if (words % 65536 == 0 && !context_.proceed(text_.share_read())) return cancelled();
      if (auto done = read_statement(); !done) return tl::unexpected<Error>(done.error());
    }
    if (in_facet_)
      return context_.unusable(text_.place(), "the file ends within a facet; it was cut short, save it again");
    if (!ended_) context_.note("the ASCII STL has no endsolid line; it may have been cut short");
    return single_object("ASCII STL", short_name(name_), mesh_.take());
  }

 private:
  Result<void> read_statement() {
    const TextCursor start = text_;
    const std::string_view word = text_.word();
    if (same_word(word, "vertex")) return read_corner();
    if (same_word(word, "facet")) return begin_facet(start);
    if (same_word(word, "endfacet")) return end_facet(start);
    if (same_word(word, "outer") || same_word(word, "loop") || same_word(word, "endloop")) return {};
    if (in_facet_ || !(same_word(word, "solid") || same_word(word, "endsolid")))
      return context_.unusable(start.place(), in_quotes(word) + " is no word of an ASCII STL; save it again");
    ended_ = same_word(word, "endsolid");
    if (const std::string_view name = text_.rest_of_line(); !ended_ && name_.empty()) name_ = name;
    return {};
  }

  Result<void> begin_facet(const TextCursor& start) {
    if (in_facet_) return context_.unusable(start.place(), "a facet begins within a facet; save the file again");
    in_facet_ = true;
    corners_ = 0;
    // The normal follows from the corners; what the file says of it is often wrong and never needed.
    text_.skip_to_word();
    if (same_word(text_.peek_word(), "normal"))
      for (int i = 0; i < 4; ++i, text_.skip_word()) text_.skip_to_word();
    return {};
  }

  Result<void> read_corner() {
    const TextCursor start = text_;
    Result<Vec3> position = context_.read_position(text_);
    if (!position) return tl::unexpected(position.error());
    for (int axis = 0; axis < 3; ++axis)
      (*position)[axis] = static_cast<float>((*position)[axis]);  // STL is a float32 format, however it is written
    if (!in_facet_ || corners_ == 3)
      return context_.unusable(start.place(), in_facet_
                                                  ? "a facet has more than three corners; triangulate the model first"
                                                  : "a vertex stands outside a facet; save the file again");
    if (!index_.find_or_add(*position, triangle_[corners_++])) return index_.failure();
    return {};
  }

  Result<void> end_facet(const TextCursor& start) {
    if (!in_facet_ || corners_ != 3)
      return context_.unusable(start.place(), "a facet ends without three corners; save the file again");
    in_facet_ = false;
    if (!mesh_.add_triangle(triangle_)) return mesh_.failure();
    return {};
  }

  ReadContext& context_;
  TextCursor text_;
  GrowingMesh mesh_;
  VertexIndex index_;
  std::string_view name_;
  Triangle triangle_{};
  std::size_t corners_ = 0;
  bool in_facet_ = false;
  bool ended_ = false;
};

}  // namespace

bool is_stl_binary_by_size(std::span<const std::byte> bytes) {
  return bytes.size() >= kHeader && bytes.size() == kHeader + kFacet * std::size_t{facet_count(bytes)};
}

Result<MeshFile> read_stl_ascii(ReadContext& context) { return AsciiReader(context).read(); }

Result<MeshFile> read_stl_binary(ReadContext& context) {
  const auto bytes = context.bytes();
  if (bytes.size() < kHeader)
    return context.unusable("",
                            "neither an ASCII STL (it does not begin with \"solid\") nor a binary one (shorter than "
                            "its header); export the "
                            "model again");
  const std::size_t count = facet_count(bytes), room = (bytes.size() - kHeader) / kFacet;
  if (count > room)
    return context.unusable("byte 80", "the header promises " + std::to_string(count) +
                                           " facets, the file has room for " + std::to_string(room) +
                                           "; it was cut short or is no STL, save it again");
  if (bytes.size() != kHeader + kFacet * count)
    context.note(std::to_string(bytes.size() - kHeader - kFacet * count) + " bytes after the last facet were ignored");

  GrowingMesh mesh(context);
  if (auto reserved = mesh.reserve(0, count); !reserved) return tl::unexpected<Error>(reserved.error());
  VertexIndex index(mesh, context);
  for (std::size_t facet = 0; facet < count; ++facet) {
    if (facet % 65536 == 0 && !context.proceed(static_cast<double>(facet) / static_cast<double>(count)))
      return cancelled();
    float corners[9];
    std::memcpy(corners, bytes.data() + kHeader + kFacet * facet + 12, sizeof corners);
    Triangle triangle;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const float* p = corners + 3 * corner;
      if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
        return context.unusable("facet " + std::to_string(facet + 1),
                                "a coordinate is not a finite number; repair or export the model again");
      if (!index.find_or_add({p[0], p[1], p[2]}, triangle[corner])) return index.failure();
    }
    if (!mesh.add_triangle(triangle)) return mesh.failure();
  }
  return single_object("binary STL", "", mesh.take());
}

}  // namespace aplomb::detail
