#pragma once

#include "aplomb/io/detail/read_context.h"

namespace aplomb::detail {

// One reader a format; each takes the whole file and gives what read_mesh() promises, but for names and soups.

Result<MeshFile> read_stl_binary(ReadContext& context);
Result<MeshFile> read_stl_ascii(ReadContext& context);
Result<MeshFile> read_obj(ReadContext& context);
Result<MeshFile> read_ply(ReadContext& context);
Result<MeshFile> read_off(ReadContext& context);
Result<MeshFile> read_3mf(ReadContext& context);

/// Whether the bytes can only be a binary STL: its facet count and its size agree.
bool is_stl_binary_by_size(std::span<const std::byte> bytes);

/// A file with one object.
MeshFile single_object(std::string format, std::string name, TriangleMesh mesh);

}  // namespace aplomb::detail
