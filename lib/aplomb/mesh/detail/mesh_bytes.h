#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "aplomb/mesh/triangle_mesh.h"

/// What a child process sends home: plain arrays, each after its length.
namespace aplomb::detail {

template <class T>
void put(std::string& bytes, const std::vector<T>& items) {
  const std::size_t count = items.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(items.data()), count * sizeof(T));
}

template <class T>
std::vector<T> take(const std::string& bytes, std::size_t& at) {
  std::size_t count = 0;
  std::memcpy(&count, bytes.data() + at, sizeof count);
  at += sizeof count;
  std::vector<T> items(count);
  if (count > 0) std::memcpy(items.data(), bytes.data() + at, count * sizeof(T));
  at += count * sizeof(T);
  return items;
}

inline std::string packed(const TriangleMesh& mesh) {
  std::string bytes;
  put(bytes, mesh.vertices);
  put(bytes, mesh.triangles);
  return bytes;
}

inline TriangleMesh unpacked(const std::string& bytes, std::size_t& at) {
  TriangleMesh mesh;
  mesh.vertices = take<Vec3>(bytes, at);
  mesh.triangles = take<Triangle>(bytes, at);
  return mesh;
}

}  // namespace aplomb::detail
