#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "aplomb/core/error.h"
#include "aplomb/core/job.h"
#include "aplomb/core/vec.h"
#include "aplomb/mesh/triangle_mesh.h"

/// Pictures of figures on the plate, drawn in software: no display, no graphics card, the same bytes on every run.
namespace aplomb::picture {

/// 8-bit sRGB, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

struct Colour {
  float red = 0, green = 0, blue = 0;  ///< linear light, 0..1
};

/// A ring round a place, with a short text beside it.
struct Mark {
  Vec3 at_mm;
  std::string text;
};

/// What is shown, in millimetres, z up, the plate at z = 0.
struct Subject {
  TriangleMesh mesh;                          ///< closed; voids are its reversed shells
  std::vector<Vec2> support_polygon_mm = {};  ///< drawn on the plate; empty: none
  std::optional<Vec3> com_mm = {};            ///< drawn as a ball with its plumb line, seen through the figure
  std::vector<Vec3> threads_mm = {};          ///< points from which it hangs: drawn as lines upward
  std::vector<Mark> marks = {};               ///< seen through the figure
  Colour colour = {0.66F, 0.29F, 0.17F};
  std::vector<float> vertex_shares = {};  ///< by vertex: coloured by scale_colour() instead; empty: none
};

/// A scale of eight bands for shares in [0, 1], each darker than the one before: it reads without colour vision.
Colour scale_colour(double share);
inline constexpr int scale_bands = 8;

/// A plane through `point`; what is on the side of `normal` is taken away.
struct Cut {
  Vec3 point_mm, normal;
};

/// A parallel view. The azimuth is where the viewer stands: 0 on +x, a quarter turn on +y.
struct View {
  double azimuth_rad = -1.0;
  double elevation_rad = 0.22;  ///< above the plate
  int width = 900, height = 900;
  std::optional<Cut> cut = {};
  bool plate = true;
  std::optional<Box3> frame_mm = {};  ///< what must be in the picture; default: the subject's box
};

struct Rendering {
  Image image;
  double mm_per_pixel = 0;
  std::vector<float> figure_share;  ///< of every pixel: covered by the figure (or its cut)
  std::vector<float> cut_share;     ///< of every pixel: cut material
};

/// Draws the subject: nine samples a pixel, soft light from a key lamp and the sky (both shadowed), the cut filled
/// where the winding number is positive and hatched, voids' surfaces in their own colour.
///
/// \pre  view.width and height > 0; a cut's normal is not zero and has the viewer on its side.
/// \return cancelled. \par Cost  About 2 s of CPU for 900 x 900 pixels and 50k triangles.
Result<Rendering> render(const Subject& subject, const View& view, const Job& job);
inline Rendering render(const Subject& subject, const View& view) { return *render(subject, view, {}); }

/// The subject as it lies after falling over an edge of its support polygon: turned about it until another part of it
/// reaches the plate. `share` of 1 is all the way; less stops on the way.
///
/// \pre from_mm != to_mm; the figure is on the left of from -> to.
Subject toppled(Subject subject, Vec2 from_mm, Vec2 to_mm, double share = 1);

/// Letters (ASCII and the degree sign) drawn in strokes, centred on x, the base line at y, in pixels.
void draw_text(Image& image, double x, double y, double height, const std::string& text, Colour colour);

/// Pictures in a row, each with a line of text under it.
struct Panel {
  Image image;
  std::string caption;
  Colour caption_colour = {0.02F, 0.02F, 0.03F};
};
/// \pre Not empty, all of one height.
Image side_by_side(const std::vector<Panel>& panels);

/// One under another, all of one width. \pre Not empty.
Image one_below_another(const std::vector<Image>& rows);

/// The bytes of a PNG file. \return cancelled, third_party.
Result<std::vector<std::byte>> encode_png(const Image& image, const Job& job = {});

/// \return file_system.
Result<void> write_png(const std::string& path, const Image& image);

}  // namespace aplomb::picture
