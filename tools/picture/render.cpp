#include <cstdint>
#include <map>
#include <numeric>

#include "aplomb/mesh/mass_properties.h"
#include "ink.h"
#include "light.h"
#include "picture.h"
#include "raster.h"

namespace aplomb::picture {
namespace {

constexpr int oversampling = 3;
constexpr std::size_t shares = std::size_t{oversampling} * oversampling;
constexpr std::uint32_t nothing = 0xFFFFFFFF;
constexpr double crease_cosine = 0.77;  // faces that meet more sharply are shaded flat
constexpr Colour background{0.87F, 0.86F, 0.84F};
constexpr Colour line_colour{0.80F, 0.79F, 0.77F};
constexpr Colour void_colour{0.80F, 0.53F, 0.16F};
constexpr Colour cut_colour{0.86F, 0.30F, 0.10F};

Colour operator*(Colour a, Colour b) { return {a.red * b.red, a.green * b.green, a.blue * b.blue}; }
Colour mixed(Colour a, Colour b, float share) {
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green), a.blue + share * (b.blue - a.blue)};
}

/// The nearest surface behind every sample, and how often what lies beyond the cut is entered and left.
struct Samples {
  std::vector<float> depth;
  std::vector<std::uint32_t> triangle;
  std::vector<std::int8_t> winding;
};

/// Per corner: the mean of the normals of the faces around that vertex which are not across a crease.
std::vector<std::array<Vec3, 3>> corner_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> face(mesh.triangles.size());
  std::vector<std::vector<std::uint32_t>> around(mesh.vertices.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    face[t] = cross(mesh.vertices[c[1]] - mesh.vertices[c[0]], mesh.vertices[c[2]] - mesh.vertices[c[0]]);
    for (const auto v : c) around[v].push_back(static_cast<std::uint32_t>(t));
  }
  std::vector<std::array<Vec3, 3>> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      Vec3 sum;
      for (const auto other : around[mesh.triangles[t][c]]) {
        const double both = dot(face[t], face[other]);
        if (both >= crease_cosine * norm(face[t]) * norm(face[other])) sum += face[other];
      }
      const double length = norm(sum);
      normals[t][c] = length > 0 ? sum / length : Vec3{0, 0, 1};
    }
  }
  return normals;
}

/// For every triangle: does it bound a void (a shell of negative volume)?
std::vector<char> void_triangles(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> root(mesh.vertices.size());
  std::iota(root.begin(), root.end(), 0U);
  const auto find = [&](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& t : mesh.triangles) {
    root[find(t[1])] = find(t[0]);
    root[find(t[2])] = find(t[0]);
  }
  std::vector<double> volume(mesh.vertices.size(), 0);
  for (const auto& t : mesh.triangles) {
    volume[find(t[0])] += dot(mesh.vertices[t[0]], cross(mesh.vertices[t[1]], mesh.vertices[t[2]]));
  }
  std::vector<char> bounds_void;
  for (const auto& t : mesh.triangles) bounds_void.push_back(volume[find(t[0])] < 0);
  return bounds_void;
}

/// Barycentric.
std::array<double, 3> weights(const TriangleMesh& mesh, const Triangle& t, Vec3 p) {
  const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
  const Vec3 n = cross(b - a, c - a);
  const double n2 = squared_norm(n);
  if (n2 == 0) return {1, 0, 0};
  const double wb = dot(cross(p - a, c - a), n) / n2;
  const double wc = dot(cross(b - a, p - a), n) / n2;
  return {1 - wb - wc, wb, wc};
}

Vec3 interpolated(const TriangleMesh& mesh, const Triangle& t, const std::array<Vec3, 3>& normal, Vec3 p) {
  const auto [wa, wb, wc] = weights(mesh, t, p);
  const Vec3 sum = wa * normal[0] + wb * normal[1] + wc * normal[2];
  const double length = norm(sum);
  return length > 0 ? sum / length : normal[0];
}

Camera framed(const Subject& subject, const View& view) {
  const double ce = std::cos(view.elevation_rad);
  Camera camera =
      camera_towards({ce * std::cos(view.azimuth_rad), ce * std::sin(view.azimuth_rad), std::sin(view.elevation_rad)});
  const Box3 box = view.frame_mm ? *view.frame_mm : bounding_box(subject.mesh);
  Box3 seen;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                 corner & 4 ? box.max.z : box.min.z};
    seen.add({dot(p, camera.right), dot(p, camera.up), dot(p, camera.back)});
  }
  const Vec3 middle = 0.5 * (seen.min + seen.max);
  camera.centre = middle.x * camera.right + middle.y * camera.up + middle.z * camera.back;
  camera.width = view.width * oversampling;
  camera.height = view.height * oversampling;
  camera.samples_per_mm = 0.90 * std::min(camera.width / seen.size().x, camera.height / seen.size().y);
  return camera;
}

/// Draws one subject from one view.
class Drawing {
 public:
  Drawing(const Subject& subject, const View& view, const Job& job)
      : subject_(subject),
        view_(view),
        box_(bounding_box(subject.mesh)),
        camera_(framed(subject, view)),
        normals_(corner_normals(subject.mesh)),
        bounds_void_(void_triangles(subject.mesh)),
        lights_(subject.mesh, key_direction(), view.cut, job.part(0, 0.3)),
        job_(job.part(0.3, 1)) {
    if (view.cut) cut_ = Cut{view.cut->point_mm, normalized(view.cut->normal)};
  }

  Result<Rendering> rendering() {
    if (!lights_.is_complete()) return cancelled();
    collect();
    Rendering out;
    out.image = {view_.width, view_.height, std::vector<std::uint8_t>(pixels() * 3)};
    out.mm_per_pixel = oversampling / camera_.samples_per_mm;
    out.figure_share.assign(pixels(), 0);
    out.cut_share.assign(pixels(), 0);
    for (int y = 0; y < view_.height; ++y) {
      if (!job_.report(double(y) / view_.height, "picture")) return cancelled();
      for (int x = 0; x < view_.width; ++x) resolve(x, y, out);
    }
    annotate(out.image);
    return out;
  }

 private:
  std::size_t pixels() const { return std::size_t(view_.width) * std::size_t(view_.height); }
  Vec3 key_direction() const { return camera_.back + 0.9 * camera_.up - 0.75 * camera_.right + Vec3{0, 0, 0.5}; }

  /// Where the line of sight through a sample meets the cut.
  double cut_depth(double x, double y) const {
    const Vec3 p = camera_.unproject(x, y, 0);
    return dot(cut_->point_mm - p, cut_->normal) / dot(camera_.back, cut_->normal);
  }

  void collect() {
    const auto samples = std::size_t(camera_.width) * std::size_t(camera_.height);
    samples_.depth.assign(samples, -1e30F);
    samples_.triangle.assign(samples, nothing);
    samples_.winding.assign(samples, 0);
    rasterize(subject_.mesh, camera_, [&](std::size_t s, double z, std::size_t t, bool front) {
      if (cut_) {
        const auto width = std::size_t(camera_.width);
        const std::size_t column = s % width, row = s / width;
        if (z > cut_depth(double(column) + 0.5, double(row) + 0.5)) return;
        samples_.winding[s] = static_cast<std::int8_t>(samples_.winding[s] + (front ? -1 : 1));
      }
      if (float(z) <= samples_.depth[s]) return;
      samples_.depth[s] = float(z);
      samples_.triangle[s] = static_cast<std::uint32_t>(t);
    });
  }

  void resolve(int px, int py, Rendering& out) const {
    Colour sum;
    int figure = 0, cut = 0;
    for (std::size_t share = 0; share < shares; ++share) {
      const int x = px * oversampling + int(share % oversampling), y = py * oversampling + int(share / oversampling);
      const auto s = std::size_t(y) * std::size_t(camera_.width) + std::size_t(x);
      const std::size_t subset = (share + 4 * std::size_t(px & 1) + 2 * std::size_t(py & 1)) % shares;
      const bool in_cut = cut_ && samples_.winding[s] > 0;
      cut += in_cut;
      figure += in_cut || samples_.triangle[s] != nothing;
      const Colour c = in_cut ? cut_sample(x, y) : sample(x + 0.5, y + 0.5, s, subset);
      sum = {sum.red + c.red, sum.green + c.green, sum.blue + c.blue};
    }
    const std::size_t pixel = std::size_t(py) * std::size_t(view_.width) + std::size_t(px);
    out.figure_share[pixel] = float(figure) / float(shares);
    out.cut_share[pixel] = float(cut) / float(shares);
    constexpr float mean = 1.0F / float(shares);
    put(out.image, pixel, {sum.red * mean, sum.green * mean, sum.blue * mean});
  }

  /// Hatched at 45 degrees in the plane of the cut.
  Colour cut_sample(int x, int y) const {
    const double period = 2.2 * 3 * std::max(view_.width, view_.height) / 400.0;
    const double phase = (x + y) / period;
    return phase - std::floor(phase) < 0.22 ? mixed(cut_colour, {0.35F, 0.06F, 0.02F}, 0.75F) : cut_colour;
  }

  Colour sample(double x, double y, std::size_t s, std::size_t subset) const {
    const double ground = ground_depth(x, y);
    if (samples_.triangle[s] != nothing && (!view_.plate || samples_.depth[s] >= ground - 1e-3)) {
      return figure_sample(x, y, s, subset);
    }
    return view_.plate && ground > -1e29 ? ground_sample(camera_.unproject(x, y, ground), subset) : background;
  }

  double ground_depth(double x, double y) const {
    if (camera_.back.z < 1e-3) return -1e30;
    return -camera_.unproject(x, y, 0).z / camera_.back.z;
  }

  Colour figure_sample(double x, double y, std::size_t s, std::size_t subset) const {
    const auto t = samples_.triangle[s];
    const Vec3 p = camera_.unproject(x, y, samples_.depth[s]);
    const Triangle& corners = subject_.mesh.triangles[t];
    Vec3 n = interpolated(subject_.mesh, corners, normals_[t], p);
    if (dot(n, camera_.back) < 0) n = n - 1.02 * dot(n, camera_.back) * camera_.back;
    n = normalized(n);
    Colour light = lights_.at(p, n, subset, shares);
    const float bounce = float(0.09 * (1 - n.z));
    light = {light.red + bounce + 0.04F, light.green + bounce + 0.04F, light.blue + bounce + 0.04F};
    const Colour base = colour_at(t, p);
    Colour out = base * light;
    const double shine = std::max(0.0, dot(n, normalized(normalized(key_direction()) + camera_.back)));
    const float gloss = float(0.05 * std::pow(shine, 40.0)) * light.red;
    return {out.red + gloss, out.green + gloss, out.blue + gloss};
  }

  Colour colour_at(std::uint32_t t, Vec3 p) const {
    if (subject_.vertex_shares.empty()) return bounds_void_[t] ? void_colour : subject_.colour;
    const Triangle& corners = subject_.mesh.triangles[t];
    const auto weight = weights(subject_.mesh, corners, p);
    double share = 0;
    for (std::size_t k = 0; k < 3; ++k) share += weight[k] * double(subject_.vertex_shares[corners[k]]);
    return scale_colour(share);
  }

  /// The background, darker where the figure keeps light away: the plate has no visible end.
  Colour ground_sample(Vec3 p, std::size_t subset) const {
    const Colour light = lights_.share_at(p, {0, 0, 1}, subset, shares);
    const auto line = [](double v) { return std::abs(v / 10 - std::floor(v / 10 + 0.5)) < 0.014; };
    const Vec3 middle = 0.5 * (box_.min + box_.max);
    const double away = std::hypot(p.x - middle.x, p.y - middle.y) / box_.diagonal();
    const float fade = float(std::clamp((away - 0.35) / 0.35, 0.0, 1.0));
    return light * (line(p.x) || line(p.y) ? mixed(line_colour, background, fade) : background);
  }

  Vec2 pixel(Vec3 p) const {
    const Vec3 at = camera_.project(p);
    return {at.x / oversampling, at.y / oversampling};
  }

  void annotate(Image& image) const {
    const double thick = std::max(1.0, 0.0035 * std::max(view_.width, view_.height));
    constexpr Colour blue{0.02F, 0.16F, 0.50F};
    if (subject_.support_polygon_mm.size() > 1) {
      std::vector<Vec2> outline;
      for (const Vec2 v : subject_.support_polygon_mm) outline.push_back(pixel({v.x, v.y, 0}));
      fill_polygon(image, outline, blue, 0.20F);
      outline.push_back(outline.front());
      draw_stroke(image, outline, thick, blue, 0.85F);
    }
    for (const Vec3& from : subject_.threads_mm)
      draw_stroke(image, {pixel(from), pixel(from + Vec3{0, 0, box_.diagonal()})}, thick, {0.02F, 0.02F, 0.03F}, 0.9F);
    if (subject_.com_mm) {
      const Vec3 com = *subject_.com_mm;
      const Vec2 foot = pixel({com.x, com.y, 0});
      draw_stroke(image, {pixel(com), foot}, 0.8 * thick, {0.02F, 0.02F, 0.03F}, 0.9F);
      draw_stroke(image, {foot, foot}, 3.2 * thick, {0.02F, 0.02F, 0.03F}, 1);
      draw_ball(image, pixel(com), 3.4 * thick);
    }
    for (const Mark& mark : subject_.marks) draw_mark(image, pixel(mark.at_mm), thick, mark.text);
  }

  const Subject& subject_;
  View view_;
  Box3 box_;
  Camera camera_;
  std::vector<std::array<Vec3, 3>> normals_;
  std::vector<char> bounds_void_;
  Lights lights_;
  Job job_;
  Samples samples_;
  std::optional<Cut> cut_;
};

}  // namespace

Result<Rendering> render(const Subject& subject, const View& view, const Job& job) {
  return Drawing(subject, view, job).rendering();
}

Subject toppled(Subject subject, Vec2 from, Vec2 to, double share) {
  const Vec2 along = (1 / norm(to - from)) * (to - from);
  const auto outward = [&](Vec3 p) { return cross(Vec2{p.x, p.y} - from, along); };
  double least = 3.2;
  for (const Vec3 v : subject.mesh.vertices) {
    if (v.z > 0.5 || outward(v) > 0.5) least = std::min(least, std::atan2(v.z, outward(v)));
  }
  const double c = std::cos(share * least), s = std::sin(share * least);
  const auto turn = [&](Vec3 p) {
    const double out = outward(p);
    const double by = (c * out + s * p.z) - out;
    return Vec3{p.x + by * along.y, p.y - by * along.x, c * p.z - s * out};
  };
  for (Vec3& v : subject.mesh.vertices) v = turn(v);
  if (subject.com_mm) subject.com_mm = turn(*subject.com_mm);
  for (Mark& mark : subject.marks) mark.at_mm = turn(mark.at_mm);
  return subject;
}

}  // namespace aplomb::picture
