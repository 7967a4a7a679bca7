#include "aplomb/io/detail/polygon.h"
#include "aplomb/io/detail/readers.h"
#include "aplomb/io/detail/text_cursor.h"

namespace aplomb::detail {
namespace {

/// Reads OFF line by line: what follows a vertex's coordinates or a face's indices (normals, colours) is skipped.
class OffReader {
 public:
  explicit OffReader(ReadContext& context)
      : context_(context), text_(context.text()), mesh_(context), cutter_(mesh_, context) {}

  Result<MeshFile> read() {
    if (auto done = read_header(); !done) return tl::unexpected<Error>(done.error());
    for (std::size_t i = 0; i < vertices_; ++i) {
      if (i % 65536 == 0 && !context_.proceed(text_.share_read())) return cancelled();
      if (auto done = read_vertex(); !done) return tl::unexpected<Error>(done.error());
    }
    for (std::size_t i = 0; i < faces_; ++i) {
      if (i % 65536 == 0 && !context_.proceed(text_.share_read())) return cancelled();
      if (auto done = read_face(); !done) return tl::unexpected<Error>(done.error());
    }
    return single_object("OFF", "", mesh_.take());
  }

 private:
  Result<void> read_header() {
    text_.skip_to_word();
    const TextCursor start = text_;
    if (const std::string_view word = text_.word(); word.ends_with("OFF")) {
      if (word.find('4') != word.npos || word.find('n') != word.npos)
        return context_.unusable(start.place(), in_quotes(word) + " is not three-dimensional; export a plain OFF");
    } else {
      text_ = start;  // the keyword may be left out
    }
    text_.skip_to_word();
    if (text_.peek_word() == "BINARY")
      return context_.unusable(text_.place(), "binary OFF cannot be read; save it as text or as binary PLY");
    const auto vertices = text_.integer(), faces = text_.integer();
    // A vertex takes at least six characters and a face eight.
    const auto room = static_cast<long long>(context_.bytes().size());
    if (!vertices || !faces || *vertices < 0 || *faces < 0)
      return context_.unusable(text_.place(), "expected the numbers of vertices and faces; export the model again");
    if (*vertices > room / 4 || *faces > room / 4)
      return context_.unusable(text_.place(),
                               "the header promises " + std::to_string(*vertices) + " vertices and " +
                                   std::to_string(*faces) +
                                   " faces, more than the file can hold; it was cut short, save it again");
    text_.next_line();  // the number of edges means nothing
    vertices_ = static_cast<std::size_t>(*vertices);
    faces_ = static_cast<std::size_t>(*faces);
    return mesh_.reserve(vertices_, faces_);
  }

  Result<void> read_vertex() {
    text_.skip_to_word();
    const Result<Vec3> position = context_.read_position(text_);
    if (!position) return tl::unexpected(position.error());
    text_.next_line();
    if (!mesh_.add_vertex(*position)) return mesh_.failure();
    return {};
  }

  Result<void> read_face() {
    text_.skip_to_word();
    const auto count = text_.integer();
    if (!count || *count < 0) return unexpected("a number of corners");
    corners_.clear();
    for (long long i = 0; i < *count; ++i) {
      if (auto admitted = context_.admit_corner(corners_.size()); !admitted) return admitted;
      const auto index = text_.integer();
      if (!index) return unexpected("a vertex index");
      if (*index < 0 || *index >= static_cast<long long>(vertices_))
        return context_.unusable(text_.place(), "vertex index " + std::to_string(*index) +
                                                    " is out of range, the file has " + std::to_string(vertices_) +
                                                    " vertices; export the model again");
      corners_.push_back(static_cast<std::uint32_t>(*index));
    }
    text_.next_line();
    if (corners_.size() >= 3) return cutter_.add(corners_);
    context_.note("faces with fewer than three corners were ignored");
    return {};
  }

  tl::unexpected<Error> unexpected(const std::string& wanted) const {
    const std::string found = text_.at_end() ? "the end of the file" : in_quotes(text_.peek_word());
    return context_.unusable(text_.place(), "expected " + wanted + ", found " + found + "; export the model again");
  }

  ReadContext& context_;
  TextCursor text_;
  GrowingMesh mesh_;
  PolygonCutter cutter_;
  std::vector<std::uint32_t> corners_;
  std::size_t vertices_ = 0;
  std::size_t faces_ = 0;
};

}  // namespace

Result<MeshFile> read_off(ReadContext& context) { return OffReader(context).read(); }

}  // namespace aplomb::detail
