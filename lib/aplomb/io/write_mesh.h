#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/io/atomic_file.h"
#include "aplomb/mesh/triangle_mesh.h"

namespace aplomb {

enum class MeshFormat {
  three_mf,  ///< core 3MF: unit millimeter, one object, one mesh
  stl,       ///< binary STL with real normals
  obj,
  ply,  ///< binary little-endian, float coordinates
};

/// A further file of a 3MF package.
struct PackagePart {
  std::string path;  ///< such as "Metadata/notes.xml"; its extension must be .config or .xml
  std::string text;
};

struct WriteOptions {
  std::string name = "aplomb";          ///< of the object, where the format has a place for one; any UTF-8
  TempFileListener on_temp_file;        ///< see write_file_atomically()
  std::vector<PackagePart> parts = {};  ///< 3MF only
};

/// The format that a file's extension asks for (.3mf .stl .obj .ply, any case); "-" is binary STL.
/// \return invalid_option for any other.
Result<MeshFormat> format_of(const std::filesystem::path& path);

/// The bytes of a mesh file. Coordinates are written as float32: STL and PLY hold them, 3MF and OBJ carry the shortest
/// text that reads back as the same float32. Vertex and triangle order stay (STL keeps triangle order). The same mesh
/// gives the same bytes: no clock, no locale.
///
/// Binary STL never begins with "solid" and always has a byte above 127 within bytes 84..211, without which PrusaSlicer
/// and admesh take it for ASCII.
///
/// \pre  Indices are in range.
/// \return unusable_input for a mesh without triangles or with a coordinate beyond float32; third_party (zip);
/// cancelled.
Result<std::vector<std::byte>> encode_mesh(const TriangleMesh& mesh, MeshFormat format,
                                           const WriteOptions& options = {}, const Job& job = {});

/// Writes encode_mesh() to a file, or to standard output for "-". The target is old or complete, never half; it may be
/// the file that the mesh was read from.
/// \return what format_of(), encode_mesh() and write_file_atomically() return.
Result<void> write_mesh(const std::filesystem::path& path, const TriangleMesh& mesh, const WriteOptions& options = {},
                        const Job& job = {});

}  // namespace aplomb
