#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/mesh/triangle_mesh.h"

/// What a child process sends home: plain arrays, each after its length. A child may have gone wrong without dying of
/// it, so nothing in them is believed.
namespace aplomb::detail {

inline tl::unexpected<Error> spoilt() { return fail(ErrorCode::third_party, "the work sent back what is no mesh"); }

template <class T>
void put(std::string& bytes, const std::vector<T>& items) {
  const std::size_t count = items.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(items.data()), count * sizeof(T));
}

/// What put() wrote at `at`, which then stands behind it; nothing where the bytes end before that.
template <class T>
std::optional<std::vector<T>> take(const std::string& bytes, std::size_t& at) {
  std::size_t count = 0;
  if (at > bytes.size() || bytes.size() - at < sizeof count) return std::nullopt;
  std::memcpy(&count, bytes.data() + at, sizeof count);
  if (count > (bytes.size() - at - sizeof count) / sizeof(T)) return std::nullopt;
  at += sizeof count;
  std::vector<T> items(count);
  if (count > 0) std::memcpy(items.data(), bytes.data() + at, count * sizeof(T));
  at += count * sizeof(T);
  return items;
}

/// Triangles or tetrahedra, each of whose corners is one of so many vertices.
template <class Cell>
std::optional<std::vector<Cell>> take_cells(const std::string& bytes, std::size_t& at, std::size_t vertices) {
  auto cells = take<Cell>(bytes, at);
  const auto is_there = [&](const Cell& cell) {
    return std::all_of(cell.begin(), cell.end(), [&](std::uint32_t v) { return v < vertices; });
  };
  if (cells && !std::all_of(cells->begin(), cells->end(), is_there)) cells.reset();
  return cells;
}

inline std::string packed(const TriangleMesh& mesh) {
  std::string bytes;
  put(bytes, mesh.vertices);
  put(bytes, mesh.triangles);
  return bytes;
}

/// \return third_party where the bytes are no mesh.
inline Result<TriangleMesh> unpacked(const std::string& bytes, std::size_t& at) {
  auto vertices = take<Vec3>(bytes, at);
  if (!vertices) return spoilt();
  auto triangles = take_cells<Triangle>(bytes, at, vertices->size());
  if (!triangles) return spoilt();
  return TriangleMesh{std::move(*vertices), std::move(*triangles)};
}

}  // namespace aplomb::detail
