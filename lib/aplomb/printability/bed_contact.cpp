#include "aplomb/printability/bed_contact.h"

#include "aplomb/balance/detail/convex_hull_2d.h"
#include "aplomb/balance/support_polygon.h"
#include "aplomb/printability/detail/places.h"

namespace aplomb {

BedContact bed_contact(const Slices& slices) {
  BedContact contact;
  if (slices.layers.empty()) return contact;
  const Slice& first = slices.layers.front();
  const PlaneMoments moments = first.moments();
  contact.area_mm2 = moments.area_mm2;
  contact.parts = first.parts.size();
  if (moments.area_mm2 > 0) contact.center_mm = moments.centroid_mm();
  std::vector<Vec2> points;
  for (const SliceLoop& loop : first.loops) points.insert(points.end(), loop.points_mm.begin(), loop.points_mm.end());
  for (const Vec2& point : points) contact.box_mm.add(point);
  SupportPolygon hull;
  hull.corners_mm = detail::convex_hull(std::move(points));
  contact.width_mm = hull.width_mm();
  return contact;
}

std::vector<Place> measure_bed_contact(const Slices& slices, const Rules& rules) {
  if (!detail::mildest_limit(rules, "bed.contact") || slices.layers.empty()) return {};
  const BedContact contact = bed_contact(slices);
  const double half = slices.layer_mm / 2;
  return {{contact.area_mm2,
           {contact.center_mm.x, contact.center_mm.y, slices.plate_mm},
           detail::box_of(contact.box_mm, slices.plate_mm + half, slices.layer_mm)}};
}

}  // namespace aplomb
