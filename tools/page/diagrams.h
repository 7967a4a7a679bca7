#pragma once

#include <string>
#include <vector>

#include "aplomb/balance/standing.h"

/// Diagrams of how a figure stands, as SVG with the page's colours (its classes are in page.cpp).
namespace aplomb::page {

/// The part of a convex polygon, counter-clockwise, that is at least distance_mm inside each of its edges; may be
/// empty.
std::vector<Vec2> inset(const std::vector<Vec2>& polygon_mm, double distance_mm);

/// The tip angle over an edge of the support polygon when the table leans towards a direction of the plate: the tilt
/// at which the plumb line from the centre of mass leaves the polygon. Negative where it is outside already.
double tip_towards_rad(const Standing& standing, Vec2 direction);

/// The support polygon from above with the centre of mass, and the region in which a centre of mass at this height
/// stands to the angle asked for.
std::string support_svg(const Standing& standing, double required_tip_rad);

/// The tip angle by direction, a ring for the angle asked for.
std::string directions_svg(const Standing& standing, double required_tip_rad);

}  // namespace aplomb::page
