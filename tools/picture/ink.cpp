#include "ink.h"

#include <algorithm>
#include <cmath>

namespace aplomb::picture {
namespace {

float linear(std::uint8_t value) {
  const float v = float(value) / 255;
  return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
}

std::uint8_t encoded(float light) {
  const float v = std::clamp(light, 0.0F, 1.0F);
  const float s = v <= 0.0031308F ? 12.92F * v : 1.055F * std::pow(v, 1 / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255 * s));
}

void blend(Image& image, int x, int y, Colour c, double share) {
  const std::size_t pixel = std::size_t(y) * std::size_t(image.width) + std::size_t(x);
  const auto mix = [&](std::size_t channel, float to) {
    const float from = linear(image.rgb[3 * pixel + channel]);
    return from + float(share) * (to - from);
  };
  put(image, pixel, {mix(0, c.red), mix(1, c.green), mix(2, c.blue)});
}

/// Colours every pixel within the box by its coverage.
template <class Coverage>
void paint(Image& image, Vec2 low, Vec2 high, Colour colour, double opacity, Coverage&& coverage) {
  const int x1 = std::min(image.width - 1, int(std::ceil(high.x))),
            y1 = std::min(image.height - 1, int(std::ceil(high.y)));
  for (int y = std::max(0, int(std::floor(low.y))); y <= y1; ++y) {
    for (int x = std::max(0, int(std::floor(low.x))); x <= x1; ++x) {
      const double share = opacity * std::clamp(coverage(Vec2{x + 0.5, y + 0.5}), 0.0, 1.0);
      if (share > 0) blend(image, x, y, colour, share);
    }
  }
}

double segment_distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double length2 = dot(d, d);
  const double t = length2 > 0 ? std::clamp(dot(p - a, d) / length2, 0.0, 1.0) : 0;
  return norm(p - a - t * d);
}

void bounds(const std::vector<Vec2>& points, double margin, Vec2& low, Vec2& high) {
  low = high = points.front();
  for (const Vec2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  low = low - Vec2{margin, margin};
  high = high + Vec2{margin, margin};
}

}  // namespace

void put(Image& image, std::size_t pixel, Colour c) {
  image.rgb[3 * pixel] = encoded(c.red);
  image.rgb[3 * pixel + 1] = encoded(c.green);
  image.rgb[3 * pixel + 2] = encoded(c.blue);
}

void draw_stroke(Image& image, const std::vector<Vec2>& points, double width, Colour colour, float opacity) {
  Vec2 low, high;
  bounds(points, width + 1, low, high);
  paint(image, low, high, colour, opacity, [&](Vec2 p) {
    double nearest = 1e30;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      nearest = std::min(nearest, segment_distance(p, points[i], points[i + 1]));
    }
    return 0.5 * width + 0.5 - nearest;
  });
}

void fill_polygon(Image& image, const std::vector<Vec2>& convex, Colour colour, float opacity) {
  Vec2 low, high;
  bounds(convex, 1, low, high);
  double area = 0;
  for (std::size_t i = 0; i < convex.size(); ++i) area += cross(convex[i], convex[(i + 1) % convex.size()]);
  paint(image, low, high, colour, opacity, [&](Vec2 p) {
    double inside = 1e30;
    for (std::size_t i = 0; i < convex.size(); ++i) {
      const Vec2 edge = convex[(i + 1) % convex.size()] - convex[i];
      if (norm(edge) > 0) inside = std::min(inside, (area > 0 ? 1 : -1) * cross(edge, p - convex[i]) / norm(edge));
    }
    return inside + 0.5;
  });
}

void draw_ball(Image& image, Vec2 centre, double radius) {
  const Vec2 reach{radius + 2, radius + 2};
  const auto disc = [&](double r) { return [=](Vec2 p) { return r + 0.5 - norm(p - centre); }; };
  const auto quarters = [&](Vec2 p) {
    const Vec2 d = p - centre;
    return std::min(disc(0.8 * radius)(p), (d.x > 0) == (d.y > 0) ? 1.0 : 0.0);
  };
  paint(image, centre - reach, centre + reach, {0.01F, 0.01F, 0.01F}, 1, disc(radius));
  paint(image, centre - reach, centre + reach, {1, 1, 1}, 1, disc(0.8 * radius));
  paint(image, centre - reach, centre + reach, {0.01F, 0.01F, 0.01F}, 1, quarters);
}

void draw_mark(Image& image, Vec2 centre, double thickness, const std::string& text) {
  constexpr Colour white{1, 1, 1}, red{0.45F, 0.01F, 0.02F};
  const double radius = 5 * thickness, height = 8 * thickness;
  const Vec2 reach{2 * radius, 2 * radius};
  const auto ring = [&](double width) {
    return [=](Vec2 p) { return 0.5 * width + 0.5 - std::abs(norm(p - centre) - radius); };
  };
  paint(image, centre - reach, centre + reach, white, 0.9F, ring(3 * thickness));
  paint(image, centre - reach, centre + reach, red, 1, ring(1.4 * thickness));
  const Vec2 at = centre + Vec2{radius + 0.5 * height, -0.6 * radius};
  for (const Vec2 off : {Vec2{-1, 0}, Vec2{1, 0}, Vec2{0, -1}, Vec2{0, 1}})
    draw_text(image, at.x + thickness * off.x, at.y + thickness * off.y, height, text, white);
  draw_text(image, at.x, at.y, height, text, red);
}

}  // namespace aplomb::picture
