#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "aplomb/io/detail/threemf_part.h"
#include "aplomb/io/detail/zip_reader.h"

namespace aplomb::detail {

/// What slicers say of an object's pieces in parts of their own. Pieces that are not printed as model (negative
/// volumes, modifiers, support blockers and enforcers) are left out.
struct ThreemfVendor {
  /// PrusaSlicer, Slic3r: triangles first..last of an object's mesh.
  std::map<ResourceId, std::vector<std::pair<std::size_t, std::size_t>>> left_out_triangles;
  /// Bambu Studio, OrcaSlicer: components of an object, by their objectid.
  std::map<ResourceId, std::set<ResourceId>> left_out_components;
  std::map<ResourceId, std::string> names;
};

/// Reads the volume types of PrusaSlicer, Bambu Studio and OrcaSlicer, and notes what else is ignored. Settings and the
/// scripts in them are never read. \return what ZipReader::read() returns; unusable_input for a DTD.
Result<ThreemfVendor> read_threemf_vendor(ReadContext& context, ZipReader& zip);

}  // namespace aplomb::detail
