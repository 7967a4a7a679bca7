#pragma once

#include <optional>
#include <string>

#include "aplomb/io/write_mesh.h"

namespace aplomb::detail {

/// What of a 3MF package speaks of the model.
struct ModelParts {
  std::string model_xml;                ///< 3D/3dmodel.model
  std::optional<PackagePart> settings;  ///< a slicer's own, where they have a part of their own
};

/// One object, one mesh; with a modifier volume as its flavor has it.
/// \pre as encode_mesh(). \return cancelled.
Result<ModelParts> model_parts(const TriangleMesh& mesh, const WriteOptions& options, const Job& job);

}  // namespace aplomb::detail
