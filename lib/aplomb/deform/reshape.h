#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aplomb/balance/poses.h"
#include "aplomb/deform/bend.h"
#include "aplomb/deform/trim_choice.h"

namespace aplomb {

struct ReshapeOptions {
  double most_mean_percent = 5;          ///< of the height: the mean displacement of a bend, in (0, 100]
  std::optional<double> most_trim_mm{};  ///< what may be cut off the base, >= 0; none: 1 % of the height
  Regions regions{};                     ///< what is to become of parts of it
  double wall_mm = 2;                    ///< > 0
  bool carves = true;                    ///< false: the solid stays solid, and the bend does it all
};

/// A sentence that names field, value and range; empty when there is nothing to say.
std::string find_problem(const ReshapeOptions& options);

/// What is nearer to the outside stays: all of it where nothing is carved.
double wall_of(const SolidMesh& solid, const ReshapeOptions& options);

/// What was done to the outside.
struct Reshaping {
  SolidMesh solid;
  double trim_mm = 0;          ///< cut off the base
  std::optional<Bent> bent{};  ///< none where the cut alone serves
};

/// Changes the outside of a solid as little as makes it hold its poses where no void does: a cut off the base first,
/// which nobody sees, then a bend (Bender). The base is cut where there is one pose and it stands on z = 0 upward.
class Reshaper {
 public:
  /// \pre  find_problem(options) and find_problem(poses) are empty.
  /// \return as trim_gains(), trim_base(), joint_problem() and Bender::make().
  static Result<Reshaper> make(const SolidMesh& solid, const std::vector<Pose>& poses, RowKind kind,
                               const ReshapeOptions& options, const Job& job = {});

  /// Reshapes for `beyond_t` more than the poses ask for: what a first try came short of. \return as Bender::bend().
  Result<Reshaping> reshape(double beyond_t, const Job& job = {}) const;

  /// What cuts of nothing, 0.5, 1 and 2 mm and those considered would reach; empty where the base is not to be cut.
  const std::vector<TrimGain>& gains() const;
  double trim_mm() const;

 private:
  struct Parts;
  explicit Reshaper(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const Parts> parts_;
};

}  // namespace aplomb
