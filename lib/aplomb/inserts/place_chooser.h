#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "aplomb/balance/poses.h"
#include "aplomb/core/pulse.h"
#include "aplomb/inserts/pocket_places.h"

namespace aplomb {

/// A body of solid material and inserts.
struct LoadedBody {
  Moments solid;    ///< of the material, pockets left out
  Moments inserts;  ///< of as much material as weighs what the inserts do

  Moments all() const { return solid + inserts; }
};

/// How a body with inserts is weighed: largest_t(), or (RowKind::robust) its least over densities of the solid within
/// 2 % and masses of the inserts within 1 %, which is at one of the two extremes of their ratio.
double loaded_t(const BalanceProblem& problem, const LoadedBody& body, RowKind kind);

/// Pockets that keep apart, and what is known of the best that there could be.
struct PocketChoice {
  std::vector<PocketPlace> places;
  LoadedBody body;
  int inserts = 0;
  double t = 0;
  double bound_t = 0;  ///< no choice of as many inserts among the candidates has a larger t
};

/// What pockets do to a body.
struct PocketLoads {
  std::vector<std::uint32_t> stocks;  ///< of each pocket: which stock its inserts come from
  std::vector<int> most;              ///< of each stock: how many there are
  double density_g_per_cm3 = 1.24;    ///< of the material, > 0
  double filled_ratio = 1;            ///< of the solid's space: what is printed, in (0, 1]
  RowKind kind = RowKind::nominal;
};

/// The places of pockets that make t largest.
///
/// The loads of pockets are points in the 4-space of moments, so PlaneSearch bounds t as it does for carving: for a
/// plane l, no choice does better than the solid with those that l likes best, at most one in each cell of a lattice so
/// small that no two pockets have room in a cell. That relaxes the choice, and is certified. The choice itself comes of
/// a beam search, pocket by pocket, and of what the relaxed choice has room for; both are then made better by taking
/// one or two pockets out and filling up again, until that gains nothing.
class PlaceChooser {
 public:
  /// \pre candidates are of `fits`; the problem has rows; `solid` is the material as it would be without pockets.
  PlaceChooser(const PocketFits& fits, std::vector<PocketPlace> candidates, BalanceProblem problem,
               const Moments& solid, PocketLoads loads);

  /// No choice of at most so many inserts among the candidates has a larger t. \return cancelled.
  Result<double> bound(int most, const Job& job = {});

  /// The best found with at most so many inserts, of all kinds together; empty where nothing fits, or helps.
  /// \post Every place fits, and all are apart. \return cancelled.
  /// \par Cost  a bound, then some hundred scans of at most 20,000 candidates.
  Result<PocketChoice> choose(int most, const Job& job = {});

  /// The same, but of the choices that a form likes best: with the greatest integral of it over what they put in, less
  /// what they take. \post bound_t is that of no choice: infinity.
  Result<PocketChoice> choose_for(const AffineForm& form, int most, const Job& job = {});

  /// What the loads of the relaxed choice add up to that a form likes best.
  Moments relaxed_load(const AffineForm& form, int most) const;

  /// Whether a pocket fits at any of the candidates. \return cancelled.
  /// \par Cost  asks each of those that were not asked about.
  Result<bool> any_fits(const Job& job = {});

 private:
  struct Cell {
    std::uint32_t stock = 0;
    std::vector<std::uint32_t> members;  // candidates
  };
  struct Plane {
    AffineForm form;
    double bound_t = 0;
    std::vector<std::uint32_t> relaxed;  // the choice that the form would have
  };

  LoadedBody load_of(const PocketPlace& place) const;
  double gain(const AffineForm& form, std::uint32_t candidate) const;
  std::vector<std::uint32_t> best_for(const AffineForm& form, int most) const;
  std::vector<std::vector<std::uint32_t>> best_of_stock(const AffineForm& form, std::uint32_t stock, int most) const;
  Result<Plane> search(int most, const Job& job);
  std::vector<std::uint32_t> shortlist(const AffineForm& form) const;
  bool asked_fits(std::uint32_t candidate, const Pulse& pulse);
  bool may_join(const std::vector<std::uint32_t>& chosen, std::uint32_t candidate, int most, const Pulse& pulse);
  LoadedBody body_of(const std::vector<std::uint32_t>& chosen) const;
  double worth_of(const LoadedBody& body) const;
  double worth_of(const std::vector<std::uint32_t>& chosen) const;
  int inserts_of(const std::vector<std::uint32_t>& chosen) const;
  void fill_by_plane(std::vector<std::uint32_t>& chosen, const std::vector<std::uint32_t>& by_gain, int most,
                     const Pulse& pulse);
  std::vector<std::pair<double, std::uint32_t>> best_to_join(const std::vector<std::uint32_t>& chosen,
                                                             const std::vector<std::uint32_t>& among, int most,
                                                             std::size_t count, const Pulse& pulse);
  void fill_by_worth(std::vector<std::uint32_t>& chosen, const std::vector<std::uint32_t>& among, int most,
                     const Pulse& pulse);
  Result<std::vector<std::uint32_t>> best_of_beam(const std::vector<std::uint32_t>& among, int most, const Job& job);
  Result<PocketChoice> improved(const Plane& plane, int most, const Job& job);
  Result<void> exchange(std::vector<std::uint32_t>& chosen, const std::vector<std::uint32_t>& among, int most,
                        const Job& job);

  const PocketFits& fits_;
  std::vector<LoadedBody> loads_at_origin_;  // of each pocket
  std::vector<PocketPlace> candidates_;
  BalanceProblem problem_;
  Moments solid_;
  PocketLoads loads_;
  std::optional<AffineForm> liked_;  // what makes a choice good; none: its t
  std::vector<Cell> cells_;
  std::vector<std::int8_t> known_;  // of each candidate: 0 not asked yet, 1 fits, -1 does not
};

}  // namespace aplomb
