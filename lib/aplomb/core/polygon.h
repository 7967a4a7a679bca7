#pragma once

#include <vector>

#include "aplomb/core/vec.h"

namespace aplomb {

/// A closed loop of points on a plane: counter-clockwise round a region, clockwise round a hole in it.
using Polygon = std::vector<Vec2>;
/// Loops that together bound a region.
using Polygons = std::vector<Polygon>;

/// An axis-aligned rectangle; empty until a point was added.
struct Box2 {
  Vec2 min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  constexpr void add(Vec2 p) {
    min = {p.x < min.x ? p.x : min.x, p.y < min.y ? p.y : min.y};
    max = {p.x > max.x ? p.x : max.x, p.y > max.y ? p.y : max.y};
  }
  constexpr bool meets(const Box2& other) const {
    return min.x <= other.max.x && other.min.x <= max.x && min.y <= other.max.y && other.min.y <= max.y;
  }
  constexpr bool holds(Vec2 p) const { return min.x <= p.x && p.x <= max.x && min.y <= p.y && p.y <= max.y; }
};

/// Integrals of 1, q and q q^T over a plane region, about the origin.
struct PlaneMoments {
  double area_mm2 = 0;
  Vec2 first_mm3;
  double xx_mm4 = 0, xy_mm4 = 0, yy_mm4 = 0;

  /// \pre area_mm2 != 0.
  Vec2 centroid_mm() const { return (1 / area_mm2) * first_mm3; }
  /// The same region's about its own centroid, first_mm3 being 0. \pre area_mm2 != 0.
  PlaneMoments about_centroid() const;
};

PlaneMoments operator+(const PlaneMoments& a, const PlaneMoments& b);
inline PlaneMoments& operator+=(PlaneMoments& a, const PlaneMoments& b) { return a = a + b; }

/// By Green's formulas, exact for polygons: with c_i = q_i x q_i+1, A = 1/2 sum c_i,
/// xx = 1/12 sum c_i (x_i^2 + x_i x_i+1 + x_i+1^2), and so on. A hole's are negative.
PlaneMoments plane_moments(const Polygon& polygon);
double area_mm2(const Polygon& polygon);
double area_mm2(const Polygons& polygons);

/// Where constant + gradient . q is positive.
struct HalfPlane {
  double constant = 0;
  Vec2 gradient;

  double operator()(Vec2 q) const { return constant + dot(gradient, q); }
};

/// Of the part of a region that lies in a half-plane: exact, and linear in its corners, for the cut need not be drawn.
/// Seen from a point on the border the pieces of the border subtend nothing, so the sum over the edges within is all.
PlaneMoments plane_moments(const Polygons& polygons, const HalfPlane& half);

/// The part of a rectangle that lies in a half-plane; empty where none does.
Polygon clipped(const Box2& box, const HalfPlane& half);

Box2 bounding_box(const Polygon& polygon);
Box2 bounding_box(const Polygons& polygons);

/// The same region within the box, with fewer corners beyond it: a run of them on one side of the box keeps its ends,
/// so that the path between them stays on that side and no winding number in the box changes. Beyond it loops may
/// cross.
Polygons thinned_outside(const Polygons& polygons, const Box2& box);

struct Segment {
  Vec2 from, to;
};
double distance_mm(Vec2 point, const Segment& segment);
/// To the nearest; infinite where there is none.
double distance_mm(Vec2 point, const std::vector<Segment>& segments);

/// Whether a loop of either direction runs round the point; on the loop itself either answer.
bool encloses(const Polygon& polygon, Vec2 point_mm);

/// The connected pieces of a region, each an outline followed by its holes, in the order of the outlines.
/// \pre The loops do not cross.
std::vector<Polygons> pieces(const Polygons& polygons);

}  // namespace aplomb
