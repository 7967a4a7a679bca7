#pragma once

#include "aplomb/io/write_mesh.h"

namespace aplomb::detail {

// One writer a format. \pre At least one triangle, every coordinate finite as float32.

using Bytes = std::vector<std::byte>;

Result<Bytes> encode_stl(const TriangleMesh& mesh, const Job& job);
Result<Bytes> encode_obj(const TriangleMesh& mesh, const WriteOptions& options, const Job& job);
Result<Bytes> encode_ply(const TriangleMesh& mesh, const Job& job);
Result<Bytes> encode_3mf(const TriangleMesh& mesh, const WriteOptions& options, const Job& job);

/// Builds text quickly: the shortest digits that read back as the same value, whatever the locale.
class TextSink {
 public:
  void add(std::string_view text) { text_.append(text); }
  void add(float value);
  void add(std::uint32_t value);
  const std::string& text() const { return text_; }
  void reserve(std::size_t bytes) { text_.reserve(bytes); }
  Bytes bytes() const;

 private:
  std::string text_;
};

}  // namespace aplomb::detail
