#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

/// One thing to print, as the file has it.
struct MeshObject {
  std::string name;   ///< the file's name for it, else the file's own stem
  TriangleMesh mesh;  ///< in millimetres: the file's unit and transforms are applied
};

/// What a file holds.
struct MeshFile {
  std::string format;               ///< "binary STL", "ASCII STL", "OBJ", "PLY", "OFF" or "3MF"
  double unit_mm = 1;               ///< millimetres per file unit, already applied to the meshes
  bool unit_known = false;          ///< whether the file states its unit; if not, millimetres were taken
  std::vector<MeshObject> objects;  ///< never empty, no mesh without triangles
  std::vector<std::string> notes;   ///< what was odd, ignored or left out: a sentence each
};

/// Budgets that a reader keeps, whatever the file claims.
struct ReadOptions {
  std::size_t max_triangles = 50'000'000;           ///< 1 to 500 million, over all objects
  std::size_t memory_bytes = std::size_t{4} << 30;  ///< at least 1 MiB: the file, its meshes and the work
};

/// A sentence naming field, value and range; empty when the options can be used.
std::string find_problem(const ReadOptions& options);

/// Reads a mesh file: STL (binary, ASCII), OBJ, PLY (ASCII, both binary orders), OFF or 3MF (core and production
/// extension). "-" reads standard input. The content decides on the format, the extension only where it says nothing.
///
/// STL has no indices: corners at exactly equal positions become one vertex, in order of first appearance; a file of
/// another format that shares no vertex at all is indexed the same way. Everywhere else the file's own vertices stay,
/// in their order, used or not. Polygons are triangulated (concave ones by clipping ears). An OBJ's groups are one
/// object; every build item of a 3MF is one.
///
/// \post Indices are in range, coordinates finite as float32. Text is read as double (STL as float32): what
/// write_mesh()
///       wrote comes back the same after rounded_to_float().
/// \return unusable_input naming the place and the remedy, file_system, over_budget (before allocating),
///         invalid_option, cancelled.
/// \par Cost  Linear; 2 million binary STL facets in about 0.4 s. Independent of the locale; nothing is unpacked to
/// disk.
Result<MeshFile> read_mesh(const std::filesystem::path& path, const ReadOptions& options = {}, const Job& job = {});

/// The same from memory. `name` stands in messages, and its extension decides where the content does not.
Result<MeshFile> read_mesh(std::span<const std::byte> bytes, std::string_view name, const ReadOptions& options = {},
                           const Job& job = {});

}  // namespace aplomb
