#pragma once

#include <vector>

#include "picture.h"

namespace aplomb::picture {

/// Sets a pixel (rows from the top, one after another) from linear light.
void put(Image& image, std::size_t pixel, Colour colour);

/// A line through the points with round ends, over what is there. Coordinates in pixels.
void draw_stroke(Image& image, const std::vector<Vec2>& points, double width, Colour colour, float opacity);
void fill_polygon(Image& image, const std::vector<Vec2>& convex, Colour colour, float opacity);
/// The usual sign of a centre of mass: a disc in black and white quarters.
void draw_ball(Image& image, Vec2 centre, double radius);
/// A ring with the text at its upper right, edged in white, so that it shows on anything.
void draw_mark(Image& image, Vec2 centre, double thickness, const std::string& text);

}  // namespace aplomb::picture
