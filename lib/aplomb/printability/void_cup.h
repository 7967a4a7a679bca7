#pragma once

#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/printability/finding.h"
#include "aplomb/printability/printed_solid.h"
#include "aplomb/printability/rules.h"
#include "aplomb/printability/slices.h"

namespace aplomb {

/// "void.cup": suction cups, mm2 of the largest layer of each.
///
/// A resin print hangs from the plate, layer 0 uppermost, and each layer is cured against the film at the vat's floor.
/// Empty space that its layer's material surrounds, and that no empty space of the layers printed so far connects with
/// the air, is then closed by the film: pulled off, it sucks. A cup is such space, connected through the layers; its
/// height is that of its layers, and only cups higher than "void.cup_mm" count (UVtools: 1 mm2 and 0.5 mm). A closed
/// void is a cup from its first layer to its last. Space connects where it overlaps by 0.025 mm2 (ten pixels of 50 um,
/// as in UVtools), and less than that is no space. Space that reaches the plate counts as aired (our choice): resin
/// prints are raised on supports; that a flat print's bore is closed by the plate itself is not judged.
///
/// \return Places where the process has the check; none where there is no cup of that height. third_party, cancelled.
/// \par Cost  O(holes) set operations a layer.
Result<std::vector<Place>> measure_void_cup(const PrintedSolid& printed, const Slices& slices, const Rules& rules,
                                            const Job& job = {});

}  // namespace aplomb
