#pragma once

#include "aplomb/core/job.h"
#include "aplomb/printability/stress_field.h"
#include "picture.h"

namespace aplomb::picture {

/// Where a solid is stressed, from the front and from behind, with the scale beside: from nothing, pale, to what the
/// check measured and more, dark.
///
/// \pre  The field is not empty and its measured_mpa > 0; size, the pixels across one view, > 0.
/// \return cancelled. \par Cost  as two pictures of before_and_after().
Result<Image> stress_picture(const StressField& field, int size, const Job& job = {});

}  // namespace aplomb::picture
