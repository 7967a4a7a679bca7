#pragma once

#include "aplomb/core/stage_clock.h"
#include "aplomb/fdm/ballast.h"
#include "aplomb/input.h"
#include "aplomb/report/report.h"
#include "aplomb/stand_options.h"

// Steps of the pipeline that move mass by infill; stand() chooses among them.

namespace aplomb {

/// Whether stand() tries denser infill on one side: where that is asked for, or by default where the profile's infill
/// is sparse and nothing else is asked for. There a void would first add mass, for the slicer puts skins round it.
bool tries_ballast(const StandOptions& options);

/// The profile as ballast has it, with the low density. \pre options.profile.
PrintProfile profile_with_ballast(const StandOptions& options);

/// The layers of a solid as the profile has them; none without a profile. \return as LayeredPrint::make().
Result<std::optional<LayeredPrint>> layers_of(const SolidMesh& solid, const StandOptions& options, const Job& job);

/// Infill that makes every pose hold. \param layers  layers_of() the input.
/// \pre  the densities of `options` are sound for its profile. \return as LayeredPrint::make(), choose_ballast().
Result<Ballast> attempt_ballast(const Input& input, const LayeredPrint& layers, const JointProblem& joint,
                                const StandOptions& options, StageClock& clock, const Job& job);

/// The volume within which the slicer is to fill densely: a half-space, cut to somewhat more than the model's box.
TriangleMesh ballast_volume(const Ballast& ballast, const Box3& model);

/// As a body of the profile's filament, or of the options' material where it names none. \pre options.profile.
std::vector<Region> printed_body(const PredictedPrint& print, const StandOptions& options);

/// What the ballast did, for the report.
BallastFigures ballast_figures(const Ballast& ballast, const JointProblem& joint, const StandOptions& options);

/// Adds hints: what sparse infill makes of a void. \pre report.carving and the `after` of its poses.
void note_sliced(Report& report);

/// A solid as it is sliced, with ballast where there is any, or as one piece where it has no layers.
/// \return as LayeredPrint::make(); unusable_input where nothing is printed.
Result<std::vector<Region>> body_of(const SolidMesh& solid, const std::optional<LayeredPrint>& layers,
                                    const StandOptions& options, const std::optional<Ballast>& ballast, const Job& job);

}  // namespace aplomb
