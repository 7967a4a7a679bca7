#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "aplomb/deform/cage.h"
#include "aplomb/deform/deform_cage.h"
#include "aplomb/mesh/solid_mesh.h"

namespace aplomb::bench {

struct StudyOptions {
  double height_mm = 100;  ///< models are scaled to it
  double wall_mm = 2;
  double contact_height_mm = 1;
  double most_mean_percent = 25;  ///< of the height: the mean displacement that a bend may have
  std::optional<double> to_deg;   ///< the tip angle asked for; none: what carving reaches and beyond_deg more
  double beyond_deg = 3;
  std::size_t samples = 60000;  ///< of the cage: 6 of them make about one tetrahedron
  std::string folder;           ///< where surfaces are written; none: they are not
  /// Of SRE-ARAP: between vertices that the cage carries, in edges of its cubes; CGAL's alpha; iterations.
  std::vector<double> spacings{1, 2}, alphas{0.02, 0.0002};
  int arap_iterations = 4;
};

/// A model ready to be bent on its feet, with what Bender keeps to itself.
struct StudyModel {
  std::string name;
  SolidMesh solid;
  Cage cage;
  CageProblem problem;     ///< required_t is 0
  std::vector<bool> held;  ///< per vertex of the solid: within contact_height_mm of the plate
};

/// `named` is a file, with "@y", "@-z" and so on behind it where +z is not up. \return as load_solid() and
/// build_cage().
Result<StudyModel> load_model(const std::string& named, const StudyOptions& options);

/// The cage as it is with the best carving there is.
Result<CageDeformation> at_rest(const CageProblem& problem);

/// The least bend to required_t, within the options' mean displacement.
Result<CageDeformation> bent(CageProblem problem, double required_t, const StudyOptions& options);

/// tan of the tip angle that the options ask for.
double asked_t(const StudyOptions& options, double carved_t);

/// Moments of the solid that the samples are when the cage's vertices are at `vertices`.
Moments sample_moments(const CageProblem& problem, const std::vector<Vec3>& vertices);

double degrees_of(double t);

/// CPU seconds of this process, of all threads.
double cpu_s();

/// Loads one model after the other and lets `print` write its rows. \return the first error.
Result<void> for_each_model(const std::vector<std::string>& models, const StudyOptions& options,
                            const std::function<Result<void>(const StudyModel&, const StudyOptions&)>& print);

}  // namespace aplomb::bench
