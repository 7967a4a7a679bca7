#include "aplomb/adapters/clipper/polygon_operations.h"

#include <polyclipping/clipper.hpp>

#include <algorithm>
#include <cmath>
#include <exception>

namespace aplomb::adapters {
namespace {

namespace cl = ClipperLib;

constexpr double units_per_mm = 1e6;  // below 1.07 m Clipper works in 64 bits, beyond in 128

/// Where Clipper has no numbers (4.6e12 mm) it still gets one, and refuses it.
cl::cInt to_clipper(double mm) {
  constexpr double beyond = 5e18;
  return std::llround(std::clamp(mm * units_per_mm, -beyond, beyond));
}

cl::IntPoint to_clipper(Vec2 p) { return {to_clipper(p.x), to_clipper(p.y)}; }

cl::Paths to_clipper(const Polygons& polygons) {
  cl::Paths paths(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    paths[i].reserve(polygons[i].size());
    for (const Vec2& p : polygons[i]) paths[i].push_back(to_clipper(p));
  }
  return paths;
}

Polygons from_clipper(const cl::Paths& paths) {
  Polygons polygons(paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    polygons[i].reserve(paths[i].size());
    for (const cl::IntPoint& p : paths[i])
      polygons[i].push_back({static_cast<double>(p.X) / units_per_mm, static_cast<double>(p.Y) / units_per_mm});
  }
  return polygons;
}

/// What `work` makes, with Clipper's exceptions and refusals as errors.
template <class Work>
Result<Polygons> guarded(Work&& work) {
  try {
    cl::Paths paths;
    if (work(paths)) return from_clipper(paths);
  } catch (const std::exception& error) {
    return fail(ErrorCode::third_party, std::string("Clipper failed on a slice: ") + error.what());
  }
  return fail(ErrorCode::third_party, "Clipper failed on a slice");
}

Result<Polygons> combined(cl::ClipType type, const Polygons& a, const Polygons& b) {
  return guarded([&](cl::Paths& paths) {
    cl::Clipper clipper;
    clipper.AddPaths(to_clipper(a), cl::ptSubject, true);
    clipper.AddPaths(to_clipper(b), cl::ptClip, true);
    return clipper.Execute(type, paths, cl::pftPositive, cl::pftPositive);
  });
}

/// What of a region matters near another: Clipper's time grows faster than the number of corners.
Polygons near(const Polygons& polygons, const Polygons& other) {
  const Box2 box = bounding_box(other);
  Polygons meeting;
  for (const Polygon& loop : polygons)
    if (bounding_box(loop).meets(box)) meeting.push_back(loop);
  return thinned_outside(meeting, box);
}

Result<Polygons> offset(const cl::Paths& from, cl::EndType ends, double by_mm, double tolerance_mm) {
  return guarded([&](cl::Paths& paths) {
    cl::ClipperOffset offset(2, tolerance_mm * units_per_mm);
    offset.AddPaths(from, cl::jtRound, ends);
    offset.Execute(paths, by_mm * units_per_mm);
    cl::CleanPolygons(paths, tolerance_mm * units_per_mm);  // a round corner becomes two corners at least
    std::erase_if(paths, [](const cl::Path& path) { return path.size() < 3; });
    return true;
  });
}

}  // namespace

Result<Polygons> intersection(const Polygons& a, const Polygons& b) {
  const Polygons a_near = near(a, b), b_near = near(b, a_near);
  if (a_near.empty() || b_near.empty()) return Polygons{};
  return combined(cl::ctIntersection, a_near, b_near);
}

Result<Polygons> difference(const Polygons& a, const Polygons& b) {
  if (a.empty()) return Polygons{};
  return combined(cl::ctDifference, a, near(b, a));
}

Result<Polygons> grown(const Polygons& polygons, double by_mm, double tolerance_mm) {
  return offset(to_clipper(polygons), cl::etClosedPolygon, by_mm, tolerance_mm);
}

Result<Polygons> around(const std::vector<Line>& lines, double radius_mm, double tolerance_mm) {
  return offset(to_clipper(lines), cl::etOpenRound, radius_mm, tolerance_mm);
}

}  // namespace aplomb::adapters
