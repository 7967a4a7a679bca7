#include "stress_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "ink.h"

namespace aplomb::picture {
namespace {

constexpr Colour ink{0.02F, 0.02F, 0.03F};
constexpr Colour paper{0.87F, 0.86F, 0.84F};

/// Bands from nothing, below, to most_mpa.
Image legend(int width, int height, double most_mpa) {
  Image image{width, height, std::vector<std::uint8_t>(3 * std::size_t(width) * std::size_t(height))};
  for (std::size_t pixel = 0; pixel < image.rgb.size() / 3; ++pixel) put(image, pixel, paper);
  const double top = 0.14 * height, bottom = 0.94 * height, left = 0.12 * width, right = 0.36 * width;
  const double text = 0.038 * height;
  draw_text(image, 0.5 * width, 0.08 * height, text, "stress in MPa", ink);
  for (int band = 0; band <= scale_bands; ++band) {
    const double share = double(band) / scale_bands, y = bottom + share * (top - bottom);
    const double above = y + (top - bottom) / scale_bands;
    if (band < scale_bands)
      fill_polygon(image, {{left, above}, {right, above}, {right, y}, {left, y}}, scale_colour(share + 0.01), 1);
    draw_stroke(image, {{left, y}, {1.1 * right, y}}, 1.2, ink, 1);
    draw_text(image, 0.68 * width, y + 0.4 * text, text,
              fmt::format("{}{:.3g}", band == scale_bands ? "> " : "", share * most_mpa), ink);
  }
  return image;
}

}  // namespace

Colour scale_colour(double share) {
  // Steps of lightness (CIE L* 92 to 8) along yellow, orange, red, violet.
  constexpr std::array<Colour, scale_bands> colours{{{0.90F, 0.82F, 0.42F},
                                                     {0.90F, 0.58F, 0.16F},
                                                     {0.86F, 0.36F, 0.08F},
                                                     {0.72F, 0.19F, 0.06F},
                                                     {0.50F, 0.09F, 0.07F},
                                                     {0.28F, 0.04F, 0.10F},
                                                     {0.12F, 0.02F, 0.11F},
                                                     {0.02F, 0.008F, 0.04F}}};
  const auto band = static_cast<int>(std::floor(share * scale_bands));
  return colours[static_cast<std::size_t>(std::clamp(band, 0, scale_bands - 1))];
}

Result<Image> stress_picture(const StressField& field, int size, const Job& job) {
  assert(!field.surface.triangles.empty() && field.measured_mpa > 0 && size > 0);
  Subject subject{field.surface};
  const double plate = bounding_box(field.surface).min.z;
  for (Vec3& v : subject.mesh.vertices) v.z -= plate;
  for (const double stress : field.stress_mpa)
    subject.vertex_shares.push_back(static_cast<float>(stress / field.measured_mpa));
  std::vector<Panel> panels;
  for (const bool is_front : {true, false}) {
    View view;
    view.width = view.height = size;
    view.azimuth_rad = is_front ? -1.0 : std::numbers::pi - 1.0;
    auto drawn = render(subject, view, is_front ? job.part(0, 0.5) : job.part(0.5, 1));
    if (!drawn) return tl::unexpected(drawn.error());
    panels.push_back({std::move(drawn->image), is_front ? "front" : "back"});
  }
  panels.push_back({legend(2 * size / 5, size, field.measured_mpa), ""});
  return side_by_side(panels);
}

}  // namespace aplomb::picture
