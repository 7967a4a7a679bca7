#pragma once

#include <cstdint>
#include <vector>

namespace aplomb {

/// Which print each triangle of a mesh belongs to, numbered from 0 in the order of their first triangles.
struct PrintNumbers {
  std::vector<std::uint32_t> of_triangle;
  std::uint32_t count = 0;
};

}  // namespace aplomb
