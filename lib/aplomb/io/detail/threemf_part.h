#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "aplomb/core/vec.h"
#include "aplomb/io/detail/read_context.h"

namespace aplomb::detail {

using ResourceId = std::uint32_t;

/// A reference to an object of this model part, or of another (production extension), moved.
struct ThreemfReference {
  ResourceId id = 0;
  std::string path;   ///< empty: the part at hand
  Affine3 transform;  ///< translation in millimetres
  bool printable = true;
};

struct ThreemfObject {
  std::string name;
  std::string type;   ///< "model" unless the file says otherwise
  TriangleMesh mesh;  ///< in millimetres
  std::vector<ThreemfReference> components;
  bool is_known_shape = false;  ///< has a mesh or components, not only an extension's geometry
  std::string modifier;         ///< Cura's name for what it is instead of a part of the print, such as "infill_mesh"
};

/// One .model part of a 3MF package.
struct ThreemfPart {
  double unit_mm = 1;
  std::map<ResourceId, ThreemfObject> objects;
  std::vector<ThreemfReference> items;
};

/// Reads a model part. Indices are in range, ids unique, coordinates and transforms finite, transforms invertible.
/// `name` stands in messages; `xml` is destroyed.
Result<ThreemfPart> read_threemf_part(ReadContext& context, std::string_view name, std::string xml);

}  // namespace aplomb::detail
