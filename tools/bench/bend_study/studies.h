#pragma once

#include <string>
#include <vector>

#include "study_model.h"

namespace aplomb::bench {

/// What moves the fine surface: linear interpolation in the cage, Phong deformation, SRE-ARAP. A table to stdout.
Result<void> study_surface(const std::vector<std::string>& models, const StudyOptions& options);

/// Carving and bending solved together, bending alone, and carving first: mean displacement at the same angle.
Result<void> study_joint(const std::vector<std::string>& models, const StudyOptions& options);

/// What a step costs by the size of the cage, and how often a second a preview could show the surface.
Result<void> study_preview(const std::vector<std::string>& models, const StudyOptions& options);

}  // namespace aplomb::bench
