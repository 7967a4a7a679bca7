#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "aplomb/io/read_mesh.h"

namespace aplomb::detail {

class TextCursor;

/// A file's name or path made fit for a message: whole, but without control characters.
std::string shown_path(std::string_view path);

/// What the reader of one format is given: the bytes, what they may cost, and where to leave notes.
class ReadContext {
 public:
  ReadContext(std::span<const std::byte> bytes, std::string_view name, const ReadOptions& options, const Job& job)
      : bytes_(bytes), name_(shown_path(name)), options_(options), job_(job) {}

  std::span<const std::byte> bytes() const { return bytes_; }
  std::string_view text() const { return {reinterpret_cast<const char*>(bytes_.data()), bytes_.size()}; }
  /// Of the file, fit for a message.
  const std::string& name() const { return name_; }
  const ReadOptions& options() const { return options_; }

  /// "part.obj, line 3: what is wrong" as unusable_input; `place` may be empty.
  tl::unexpected<Error> unusable(std::string_view place, std::string_view problem) const;

  /// The next three numbers of the line; unusable_input where one of them is not finite or is missing.
  Result<Vec3> read_position(TextCursor& text) const;

  /// over_budget unless this many vertices and triangles, with `work_bytes` and the file itself, fit the budget.
  Result<void> admit(std::size_t vertices, std::size_t triangles, std::size_t work_bytes = 0) const;

  /// Before a polygon gets another corner: over_budget where it has so many that what cuts it would not fit.
  Result<void> admit_corner(std::size_t corners_so_far) const {
    constexpr std::size_t kUnasked = 0xffff;  // is asked for once in so many
    return (corners_so_far & kUnasked) == kUnasked ? admit_polygon(corners_so_far) : Result<void>();
  }

  /// What a reader holds besides the file and the mesh at hand; counts in every later admit().
  void set_work_bytes(std::size_t work_bytes) { work_bytes_ = work_bytes; }
  std::size_t work_bytes() const { return work_bytes_; }
  /// over_budget unless so much more fits; counts from then on.
  Result<void> hold(std::size_t bytes) {
    work_bytes_ += bytes;
    return admit(0, 0);
  }

  /// False: the caller wants to stop.
  bool proceed(double fraction) const { return job_.report(fraction, "read"); }

  void note(std::string sentence);
  std::vector<std::string> take_notes() { return std::move(notes_); }

 private:
  Result<void> admit_polygon(std::size_t corners) const;

  std::span<const std::byte> bytes_;
  std::string name_;
  const ReadOptions& options_;
  const Job& job_;
  std::vector<std::string> notes_;
  std::size_t work_bytes_ = 0;
};

/// A mesh that grows within the budget: capacity is asked for before it is taken.
class GrowingMesh {
 public:
  explicit GrowingMesh(const ReadContext& context) : context_(&context) {}

  [[nodiscard]] bool add_vertex(Vec3 vertex) {
    if (mesh_.vertices.size() == mesh_.vertices.capacity() && !grow_vertices()) return false;
    mesh_.vertices.push_back(vertex);
    return true;
  }
  [[nodiscard]] bool add_triangle(Triangle triangle) {
    if (mesh_.triangles.size() == mesh_.triangles.capacity() && !grow_triangles()) return false;
    mesh_.triangles.push_back(triangle);
    return true;
  }
  /// Room for counts that were checked against the file's size.
  Result<void> reserve(std::size_t vertices, std::size_t triangles);
  /// Why an add failed.
  tl::unexpected<Error> failure() const { return tl::unexpected<Error>(failure_); }

  const TriangleMesh& mesh() const { return mesh_; }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  bool grow_vertices();
  bool grow_triangles();
  bool keep(const Result<void>& admitted);

  const ReadContext* context_;
  TriangleMesh mesh_;
  Error failure_;
};

/// A name from a file as it is kept, perhaps for each of a million items: at most 1000 bytes, whole characters of
/// UTF-8.
std::string short_name(std::string_view name);

/// Text from a file made fit for a message: at most 80 characters, no control characters, in quotes.
std::string in_quotes(std::string_view text);

}  // namespace aplomb::detail
