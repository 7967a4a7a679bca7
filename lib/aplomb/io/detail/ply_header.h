#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "aplomb/io/detail/read_context.h"

namespace aplomb::detail {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);

// Names are views of the file's text.

struct PlyProperty {
  std::string_view name;
  PlyType type;
  std::optional<PlyType> count_type;  ///< set for a list; an integer type
};

struct PlyElement {
  std::string_view name;
  std::size_t count = 0;
  std::size_t line = 0;  ///< of the header
  std::vector<PlyProperty> properties;

  /// Position of a property; properties.size() when there is none.
  std::size_t find(std::string_view property) const;
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t data_offset = 0;  ///< of the first byte after the header
};

/// Reads the header. \post The elements' counts fit the file's size, were every list empty.
Result<PlyHeader> read_ply_header(const ReadContext& context);

}  // namespace aplomb::detail
