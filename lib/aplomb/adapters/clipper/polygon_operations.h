#pragma once

#include "aplomb/core/error.h"
#include "aplomb/core/polygon.h"

namespace aplomb::adapters {

/// Set operations on regions by Clipper: loops in any order, a region being where their winding number is positive.
/// Coordinates are rounded to a nanometre. Regions that come back are bounded by loops that do not cross, outlines
/// counter-clockwise. All of them \return third_party where Clipper gives up.
Result<Polygons> intersection(const Polygons& a, const Polygons& b);
Result<Polygons> difference(const Polygons& a, const Polygons& b);

/// All points within by_mm of the region; where by_mm is negative, all points of it farther than -by_mm from its
/// rim. Round corners are polygons inside the true arc, and corners off their neighbours' line are left out, both by at
/// most tolerance_mm. \pre The loops do not cross.
Result<Polygons> grown(const Polygons& polygons, double by_mm, double tolerance_mm = 1e-4);

using Line = std::vector<Vec2>;  // two points or more, open

/// All points within radius_mm of the lines; arcs as in grown().
Result<Polygons> around(const std::vector<Line>& lines, double radius_mm, double tolerance_mm = 1e-4);

}  // namespace aplomb::adapters
