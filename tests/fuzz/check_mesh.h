#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace aplomb::fuzz {

/// Reads a mesh file within a small budget; aborts unless it ends in a mesh as promised or in an error with its remedy.
void check_mesh(std::span<const std::byte> bytes, std::string_view name);

}  // namespace aplomb::fuzz
