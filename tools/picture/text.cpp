#include <array>
#include <string_view>
#include <utility>

#include "ink.h"

namespace aplomb::picture {
namespace {

/// Strokes of a letter, separated by '|'; a point is two characters: x as a hexadecimal digit, y as a letter, 'e' the
/// base line, 'o' the height of small letters, 's' of capitals. '~' begins a stroke that is curved through its points.
constexpr std::array<std::pair<char, std::string_view>, 76> glyphs{{
    {'a', "~8j4o0j4e8j|8o8e"},
    {'b', "0s0e|~0j4o8j4e0j"},
    {'c', "~7m4o0j4e7g"},
    {'d', "8s8e|~8j4o0j4e8j"},
    {'e', "0j8j|~8j4o0j4e7g"},
    {'f', "~6s3q2n|2n2e|0n5n"},
    {'g', "8o8c|~8c4a1b|~8j4o0j4e8j"},
    {'h', "0s0e|~0k4o8k|8k8e"},
    {'i', "0o0e|0r0s"},
    {'j', "3o3c|~3c2a0b|3r3s"},
    {'k', "0s0e|7o0i|2k7e"},
    {'l', "0s0e"},
    {'m', "0o0e|~0k3o6k|6k6e|~6k9oCk|CkCe"},
    {'n', "0o0e|~0k4o8k|8k8e"},
    {'o', "~4o0j4e8j4o"},
    {'p', "0o0a|~0j4o8j4e0j"},
    {'q', "8o8a|~8j4o0j4e8j"},
    {'r', "0o0e|~0k2n5o"},
    {'s', "~7m4o1m4j7h4e0g"},
    {'t', "3r3h|~3h4e6e|0o6o"},
    {'u', "0o0i|~0i4e8i|8o8e"},
    {'v', "0o4e8o"},
    {'w', "0o3e6o9eCo"},
    {'x', "0o8e|8o0e"},
    {'y', "0o4e|8o3a"},
    {'z', "0o8o0e8e"},
    {'A', "0e5sAe|2i8i"},
    {'B', "0e0s5s|~5s8p5l|5l0l|~5l9i5e|5e0e"},
    {'C', "~9p5s0l5e9h"},
    {'D', "0e0s4s|~4s9l4e|4e0e"},
    {'E', "8e0e0s8s|0l6l"},
    {'F', "0e0s8s|0l6l"},
    {'G', "~9p5s0l5e9h|9h9k5k"},
    {'H', "0s0e|9s9e|0l9l"},
    {'I', "0s0e"},
    {'J', "6s6i|~6i3e0h"},
    {'K', "0s0e|9s0j|3m9e"},
    {'L', "0s0e7e"},
    {'M', "0e0s5hAsAe"},
    {'N', "0e0s9e9s"},
    {'O', "~5s0l5eAl5s"},
    {'P', "0e0s5s|~5s9o5k|5k0k"},
    {'Q', "~5s0l5eAl5s|6iAe"},
    {'R', "0e0s5s|~5s9o5k|5k0k|4k9e"},
    {'S', "~8p4s0p4l9i4e0h"},
    {'T', "0sAs|5s5e"},
    {'U', "0s0i|~0i4e9i|9i9s"},
    {'V', "0s5eAs"},
    {'W', "0s3e6s9eCs"},
    {'X', "0s9e|9s0e"},
    {'Y', "0s5l|As5l|5l5e"},
    {'Z', "0s9s0e9e"},
    {'0', "~4s0l4e8l4s"},
    {'1', "1p4s4e"},
    {'2', "~0o4s8o5j0e|0e8e"},
    {'3', "~0q4s7p3l|~3l8i4e0g"},
    {'4', "6e6s0i9i"},
    {'5', "7s1s0l|~0l4n8i4e0g"},
    {'6', "~7s2o0i4e8i4m0i"},
    {'7', "0s8s3e"},
    {'8', "~4s1p4l7p4s|~4l0h4e8h4l"},
    {'9', "~1e6i8o4s0o4k8o"},
    {'.', "0e0f"},
    {',', "1f0c"},
    {':', "0e0f|0m0n"},
    {'-', "0j6j"},
    {'+', "0j8j|4n4f"},
    {'%', "0eAs|~2s0q2o4q2s|~8i6g8eAg8i"},
    {'/', "0c6s"},
    {'(', "~3t0l3c"},
    {')', "~0t3l0c"},
    {'=', "0m8m|0h8h"},
    {'>', "0o7j0e"},
    {'<', "7o0j7e"},
    {'\'', "0s0p"},
    {'\xB0', "~2s0q2o4q2s"},
}};

using Strokes = std::vector<std::vector<Vec2>>;

Vec2 spline(Vec2 a, Vec2 b, Vec2 c, Vec2 d, double t) {
  return b + 0.5 * t * ((c - a) + t * ((2.0 * a - 5.0 * b + 4.0 * c - d) + t * (3.0 * b - a - 3.0 * c + d)));
}

std::vector<Vec2> curved(const std::vector<Vec2>& p) {
  const bool closed = p.front() == p.back();
  const auto n = std::ssize(p);
  const auto at = [&](std::ptrdiff_t i) {
    if (closed) i = (i + n - 1) % (n - 1);
    return p[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, n - 1))];
  };
  std::vector<Vec2> out;
  for (std::ptrdiff_t i = 0; i + 1 < n; ++i) {
    for (int step = 0; step < 8; ++step) out.push_back(spline(at(i - 1), at(i), at(i + 1), at(i + 2), step / 8.0));
  }
  out.push_back(p.back());
  return out;
}

/// In glyph units: 14 from the base line to the top of a capital.
Strokes strokes(char letter, double& width) {
  Strokes out;
  width = 4;
  for (const auto& [key, code] : glyphs) {
    if (key != letter) continue;
    width = 0;
    std::vector<Vec2> points;
    bool curve = false;
    const auto finish = [&] {
      if (!points.empty()) out.push_back(curve ? curved(points) : points);
      points.clear();
      curve = false;
    };
    for (std::size_t i = 0; i < code.size();) {
      if (code[i] == '|') finish();
      if (code[i] == '~') curve = true;
      if (code[i] == '|' || code[i] == '~' || code[i] == ' ') {
        ++i;
        continue;
      }
      const double x = code[i] >= 'A' ? code[i] - 'A' + 10 : code[i] - '0';
      points.push_back({x, double(code[i + 1] - 'e')});
      width = std::max(width, x);
      i += 2;
    }
    finish();
  }
  return out;
}

/// One byte per letter: the degree sign's two UTF-8 bytes become 0xB0, other foreign bytes are dropped.
std::string letters(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x80 || c == '\xB0') out.push_back(c);
  }
  return out;
}

}  // namespace

void draw_text(Image& image, double x, double y, double height, const std::string& text, Colour colour) {
  constexpr double gap = 4.2;
  const double unit = height / 14;
  double length = -gap;
  for (const char letter : letters(text)) {
    double width = 0;
    strokes(letter, width);
    length += width + gap;
  }
  double pen = x - 0.5 * length * unit;
  for (const char letter : letters(text)) {
    double width = 0;
    for (auto& stroke : strokes(letter, width)) {
      for (Vec2& p : stroke) p = {pen + p.x * unit, y - p.y * unit};
      draw_stroke(image, stroke, 1.9 * unit, colour, 1);
    }
    pen += (width + gap) * unit;
  }
}

Image side_by_side(const std::vector<Panel>& panels) {
  int width = 0;
  int height = 0;
  for (const Panel& panel : panels) {
    width += panel.image.width;
    height = std::max(height, panel.image.height);
  }
  const int strip = height / 10;
  Image out{width, height + strip, {}};
  out.rgb.resize(3 * std::size_t(width) * std::size_t(out.height));
  for (std::size_t pixel = 0; pixel < out.rgb.size() / 3; ++pixel) put(out, pixel, {0.87F, 0.86F, 0.84F});
  int left = 0;
  for (const Panel& panel : panels) {
    for (int y = 0; y < panel.image.height; ++y) {
      const auto from = panel.image.rgb.begin() + std::ptrdiff_t(3) * y * panel.image.width;
      std::copy(from, from + std::ptrdiff_t(3) * panel.image.width,
                out.rgb.begin() + std::ptrdiff_t(3) * (std::ptrdiff_t(y) * width + left));
    }
    draw_text(out, left + 0.5 * panel.image.width, height + 0.62 * strip, 0.36 * strip, panel.caption,
              panel.caption_colour);
    left += panel.image.width;
  }
  return out;
}

Image one_below_another(const std::vector<Image>& rows) {
  Image out{rows.front().width, 0, {}};
  for (const Image& row : rows) {
    out.height += row.height;
    out.rgb.insert(out.rgb.end(), row.rgb.begin(), row.rgb.end());
  }
  return out;
}

}  // namespace aplomb::picture
