#pragma once

#include <vector>

#include "aplomb/balance/resting.h"

namespace aplomb {

/// A face on which the solid rests, and how often it comes to.
struct Landing {
  RestingFace face;
  double chance = 0;  ///< in (0, 1]
};

/// The ways a solid comes to rest when it is dropped turned at random and rolls without bouncing, the likeliest first.
///
/// The hull's face f meets the plate first for the share of all directions that it takes up as seen from the centre of
/// mass c (van Oosterom and Strackee 1983 for each triangle a, b, d seen from c at distances |a|, |b|, |d|):
///
///     p_f = sum Omega / 4 pi      tan(Omega / 2) = a . (b x d) / (|a||b||d| + (a.b)|d| + (a.d)|b| + (b.d)|a|)
///
/// Where c does not lie over the face, the solid rolls over the edge nearest to c's foot, onto the face beyond, and on;
/// c sinks with every roll, so this ends. (The quasi-static estimator of Wiegley, Goldberg, Peshkin and Brokowski 1996,
/// "A complete algorithm for designing passive fences to orient parts"; Mirtich et al. 1996 compare it with throws.)
///
/// Faces within 0.8 degrees of another count as one with it. At most the 64 likeliest are given, so that chances may
/// add up to less than 1; faces with a tip angle of 0 are left out.
///
/// \pre  body has a positive volume.
/// \return unusable_input for a flat mesh.
/// \par Cost  O(n), and at most 0.2 s for the hull.
Result<std::vector<Landing>> landings(const TriangleMesh& mesh, const Moments& body, double contact_height_mm);

}  // namespace aplomb
