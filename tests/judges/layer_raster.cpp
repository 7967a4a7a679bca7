// What a resin printer's layer images show of the voids in a print. Knows nothing of Aplomb.
//
// Arguments: pixel_mm allowed_mm image... (PNG, lowest layer first; light is material)
// Standard output, a line each:
//     layer K void_mm2 span_mm      void_mm2: dark with no way out through this layer or others. span_mm: of the widest
//                                   piece of this layer that lies over the void of the layer below, twice the largest
//                                   distance to what is no void there; 0 where none reaches farther than allowed_mm
//     island K area_mm2 x_mm y_mm   a piece of light that starts over a void with nothing below it, with the area of
//                                   its largest layer before it meets another piece

#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Labels = std::vector<int>;

/// A layer, one pixel of border all round.
struct Layer {
  int width = 0, height = 0;
  std::vector<unsigned char> light, enclosed;

  int size() const { return width * height; }
};

/// Which pieces of dark are connected: sets with a parent each (Tarjan).
class Sets {
 public:
  int add() {
    parents_.push_back(static_cast<int>(parents_.size()));
    return parents_.back();
  }
  int root(int set) {
    while (parents_[set] != set) set = parents_[set] = parents_[parents_[set]];
    return set;
  }
  void join(int a, int b) {
    const int first = root(a), second = root(b);
    parents_[std::max(first, second)] = std::min(first, second);
  }
  std::size_t count() const { return parents_.size(); }

 private:
  std::vector<int> parents_;
};

std::vector<unsigned char> gray_pixels(const std::string& path, png_image& image) {
  image = {};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_file(&image, path.c_str()) == 0) throw std::runtime_error(path + ": " + image.message);
  image.format = PNG_FORMAT_GRAY;
  std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0)
    throw std::runtime_error(path + ": " + image.message);
  return pixels;
}

/// Numbers the connected pieces of light, or of dark, from 0 in the order of their first pixels; the rest is -1. Rows
/// are taken as runs, and runs joined where they touch the row before.
Labels connected_pieces(const Layer& layer, bool light, bool diagonally, int& count) {
  Labels labels(layer.light.size(), -1);
  Sets runs;
  for (int y = 0; y < layer.height; ++y)
    for (int x = 0, run = -1; x < layer.width; ++x) {
      const int at = y * layer.width + x;
      if ((layer.light[at] != 0) != light) {
        run = -1;
        continue;
      }
      if (run < 0) run = runs.add();
      labels[at] = run;
      if (y == 0) continue;
      const int reach = diagonally ? 1 : 0;
      for (int above = std::max(0, x - reach); above <= std::min(layer.width - 1, x + reach); ++above)
        if (const int other = labels[(y - 1) * layer.width + above]; other >= 0) runs.join(run, other);
    }
  std::vector<int> numbers(runs.count(), -1);
  count = 0;
  for (int& label : labels) {
    if (label < 0) continue;
    int& number = numbers[static_cast<std::size_t>(runs.root(label))];
    if (number < 0) number = count++;
    label = number;
  }
  return labels;
}

Layer read_layer(const std::string& path) {
  png_image image;
  const auto pixels = gray_pixels(path, image);
  Layer layer;
  layer.width = static_cast<int>(image.width) + 2;
  layer.height = static_cast<int>(image.height) + 2;
  layer.light.resize(static_cast<std::size_t>(layer.size()));
  for (int y = 0; y + 2 < layer.height; ++y)
    for (int x = 0; x + 2 < layer.width; ++x)
      layer.light[static_cast<std::size_t>((y + 1) * layer.width + x + 1)] =
          pixels[static_cast<std::size_t>(y * (layer.width - 2) + x)] >= 128;
  return layer;
}

/// The sets of dark pieces that overlap from layer to layer. Set 0 is the outside: the borders', and the plate's.
Sets connected_dark(const std::vector<Layer>& layers) {
  Sets sets;
  int first = 0;
  Labels below;
  for (const Layer& layer : layers) {
    int count = 0;
    Labels labels = connected_pieces(layer, false, false, count);
    for (int k = 0; k < count; ++k) sets.add();
    sets.join(0, first);  // the border's comes first
    for (std::size_t i = 0; i < labels.size(); ++i) {
      if (labels[i] < 0) continue;
      labels[i] += first;
      if (below.empty() || below[i] >= 0) sets.join(labels[i], below.empty() ? 0 : below[i]);
    }
    below = std::move(labels);
    first += count;
  }
  return sets;
}

std::vector<Layer> read_layers(const std::vector<std::string>& paths) {
  std::vector<Layer> layers;
  for (const std::string& path : paths) layers.push_back(read_layer(path));
  Sets sets = connected_dark(layers);
  int first = 0;
  for (Layer& layer : layers) {
    int count = 0;
    const Labels labels = connected_pieces(layer, false, false, count);
    layer.enclosed.resize(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i)
      layer.enclosed[i] = labels[i] >= 0 && sets.root(first + labels[i]) != 0;
    first += count;
  }
  return layers;
}

/// The lower envelope of parabolas (Felzenszwalb and Huttenlocher 2012): squared distances along one line.
void transform_line(std::vector<double>& f, std::vector<double>& out, std::vector<int>& at, std::vector<double>& from) {
  const int n = static_cast<int>(f.size());
  const auto cut = [&](int p, int q) { return (f[q] + double(q) * q - f[p] - double(p) * p) / (2.0 * (q - p)); };
  int last = 0;
  at[0] = 0, from[0] = -std::numeric_limits<double>::infinity();
  for (int q = 1; q < n; ++q) {
    while (last > 0 && cut(at[last], q) <= from[last]) --last;
    const double start = cut(at[last], q);
    at[++last] = q, from[last] = start;
  }
  for (int q = 0, k = 0; q < n; ++q) {
    while (k < last && from[k + 1] < q) ++k;
    out[q] = (q - at[k]) * double(q - at[k]) + f[at[k]];
  }
}

/// Of every pixel to the nearest one that is not `inside`, in pixels.
std::vector<double> distances(const Layer& layer, const std::vector<unsigned char>& inside) {
  constexpr double far = 1e12;
  std::vector<double> d(inside.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = inside[i] ? far : 0;
  const int longest = std::max(layer.width, layer.height);
  std::vector<int> at(longest + 1);
  std::vector<double> from(longest + 1);
  const auto pass = [&](int lines, int length, int line_step, int step) {
    std::vector<double> f(length), out(length);
    for (int line = 0; line < lines; ++line) {
      for (int i = 0; i < length; ++i) f[i] = d[line * line_step + i * step];
      transform_line(f, out, at, from);
      for (int i = 0; i < length; ++i) d[line * line_step + i * step] = out[i];
    }
  };
  pass(layer.height, layer.width, layer.width, 1);
  pass(layer.width, layer.height, 1, layer.width);
  for (double& value : d) value = std::sqrt(value);
  return d;
}

double widest_span_mm(const Layer& below, const Layer& layer, double pixel_mm, double allowed_mm) {
  bool any = false;
  for (std::size_t i = 0; i < layer.light.size() && !any; ++i) any = layer.light[i] && below.enclosed[i];
  if (!any) return 0;
  const std::vector<double> reach = distances(below, below.enclosed);
  double most = 0;
  for (std::size_t i = 0; i < reach.size(); ++i)
    if (layer.light[i] && below.enclosed[i]) most = std::max(most, (reach[i] - 0.5) * pixel_mm);
  return most > allowed_mm ? 2 * most : 0;
}

struct Piece {
  int area = 0, over_void = 0;
  double x = 0, y = 0;
  std::vector<int> below;  // pieces it lies on
};

struct Pieces {
  Labels labels;
  std::vector<Piece> all;
};

Pieces pieces_of(const Layer& layer, const Layer* below_layer, const Labels* below) {
  Pieces pieces;
  int count = 0;
  pieces.labels = connected_pieces(layer, true, true, count);
  pieces.all.resize(static_cast<std::size_t>(count));
  for (int at = 0; at < layer.size(); ++at) {
    if (pieces.labels[at] < 0) continue;
    Piece& piece = pieces.all[static_cast<std::size_t>(pieces.labels[at])];
    ++piece.area, piece.x += at % layer.width, piece.y += at / layer.width;
    if (!below) continue;
    piece.over_void += below_layer->enclosed[at];
    const int under = (*below)[at];
    if (under >= 0 && std::find(piece.below.begin(), piece.below.end(), under) == piece.below.end())
      piece.below.push_back(under);
  }
  return pieces;
}

struct Island {
  std::size_t layer = 0;
  int piece = 0;  // of the last layer
  int most = 0;   // pixels
  double x = 0, y = 0;
};

/// Follows the islands that grow from layer to layer, and says of those that meet something how large they became.
void follow(std::vector<Island>& growing, const Pieces& pieces, double pixel_mm) {
  std::vector<Island> still;
  for (Island& island : growing) {
    const auto next = std::find_if(pieces.all.begin(), pieces.all.end(), [&](const Piece& p) {
      return p.below.size() == 1 && p.below.front() == island.piece;
    });
    if (next == pieces.all.end()) {
      std::printf("island %zu %.4f %.3f %.3f\n", island.layer, island.most * pixel_mm * pixel_mm, island.x, island.y);
      continue;
    }
    island.piece = static_cast<int>(next - pieces.all.begin());
    island.most = std::max(island.most, next->area);
    still.push_back(island);
  }
  growing = std::move(still);
}

void show(const std::vector<Layer>& layers, double pixel_mm, double allowed_mm) {
  Pieces below;
  std::vector<Island> growing;
  for (std::size_t k = 0; k < layers.size(); ++k) {
    const auto void_pixels = std::count(layers[k].enclosed.begin(), layers[k].enclosed.end(), 1);
    std::printf("layer %zu %.4f %.4f\n", k, double(void_pixels) * pixel_mm * pixel_mm,
                k == 0 ? 0 : widest_span_mm(layers[k - 1], layers[k], pixel_mm, allowed_mm));
    Pieces pieces = pieces_of(layers[k], k == 0 ? nullptr : &layers[k - 1], k == 0 ? nullptr : &below.labels);
    follow(growing, pieces, pixel_mm);
    for (std::size_t p = 0; p < pieces.all.size() && k > 0; ++p)
      if (const Piece& piece = pieces.all[p]; piece.below.empty() && 2 * piece.over_void > piece.area)
        growing.push_back(
            {k, static_cast<int>(p), piece.area, piece.x / piece.area * pixel_mm, piece.y / piece.area * pixel_mm});
    below = std::move(pieces);
  }
}

}  // namespace

int main(int count, char** arguments) try {
  if (count < 4) throw std::runtime_error("usage: layer_raster pixel_mm allowed_mm image...");
  show(read_layers({arguments + 3, arguments + count}), std::stod(arguments[1]), std::stod(arguments[2]));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "layer_raster: %s\n", error.what());
  return 2;
}
