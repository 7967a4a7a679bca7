#include "aplomb/deform/detail/carved_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "aplomb/carve/plane_search.h"

namespace aplomb::detail {
namespace {

constexpr double search_tolerance = 1e-7;  // of t

/// What a plane leaves of a ball whose centre lies u radii inside it: the share of the volume, and how far beyond the
/// centre its centroid lies, in radii and times that share.
struct Cap {
  double share, offset;
};
Cap cap(double u) {
  const double clamped = std::clamp(u, -1.0, 1.0);
  const double w = 1 - clamped * clamped;
  return {(2 + 3 * clamped - clamped * clamped * clamped) / 4, 3.0 / 16 * w * w};
}

/// The form with its argument counted from the origin.
AffineForm about(const AffineForm& form, Vec3 origin) { return {form(origin), form.gradient}; }

}  // namespace

CarvedSamples::CarvedSamples(const CageProblem& problem, const std::vector<TetShape>& shapes)
    : problem_(problem), shapes_(shapes), change_(shapes.size(), 1) {
  Moments rest;
  for (const SolidSample& sample : problem.samples)
    rest += sample.volume_mm3 * Moments{1, sample.at.position(problem.rest, problem.rest.vertices)};
  origin_ = rest.centroid_mm();
  for (BalanceRow row : problem.balance.rows) {
    row = {about(row.a, origin_), about(row.b, origin_)};
    const double size_mm = std::cbrt(rest.volume_mm3);
    if (row.b(Moments{rest.volume_mm3, {}}) <= 1e-9 * size_mm * rest.volume_mm3) {
      row.a.constant += problem.required_t * size_mm;
      row.b.constant += size_mm;
    }
    rows_.rows.push_back(row);
  }
  for (std::size_t s = 0; s < problem.samples.size(); ++s)
    if (problem.samples[s].carvable > 0) order_.push_back(s);
  for (const std::size_t s : order_)
    radius_mm_.push_back(std::cbrt(problem.samples[s].volume_mm3 * 0.75 / std::numbers::pi));
  for (auto* values : {&x_, &y_, &z_, &carvable_mm3_}) values->resize(order_.size());
}

void CarvedSamples::move_to(const std::vector<Vec3>& vertices) {
  for (std::size_t t = 0; t < shapes_.size(); ++t)
    change_[t] = determinant(deformation_gradient(shapes_[t], problem_.rest.tets[t], vertices));
  solid_ = least_ = {};
  std::size_t next = 0;
  for (const SolidSample& sample : problem_.samples) {
    const double volume = sample.volume_mm3 * change_[sample.at.tet];
    const Vec3 at = sample.at.position(problem_.rest, vertices) - origin_;
    const Moments all = volume * Moments{1, at};
    solid_ += all;
    least_ += (1 - sample.carvable) * all;
    if (sample.carvable <= 0) continue;
    x_[next] = at.x, y_[next] = at.y, z_[next] = at.z;
    carvable_mm3_[next++] = sample.carvable * volume;
  }
}

Moments CarvedSamples::best_body(const AffineForm& kept) const {
  const double slope = norm(kept.gradient);
  if (!(slope > 0)) return kept.constant > 0 ? solid_ : least_;
  const Vec3 n = kept.gradient / slope;
  const double c = kept.constant / slope;
  double volume = 0, offset = 0, mx = 0, my = 0, mz = 0;
  for (std::size_t s = 0; s < x_.size(); ++s) {
    const double u = (c + n.x * x_[s] + n.y * y_[s] + n.z * z_[s]) / radius_mm_[s];
    if (u <= -1) continue;
    double mm3 = carvable_mm3_[s];
    if (u < 1) {
      const Cap left = cap(u);
      offset += mm3 * left.offset * radius_mm_[s];
      mm3 *= left.share;
    }
    volume += mm3;
    mx += mm3 * x_[s];
    my += mm3 * y_[s];
    mz += mm3 * z_[s];
  }
  return least_ + Moments{volume, Vec3{mx, my, mz} + offset * n};
}

std::vector<KeptShare> CarvedSamples::shares(const AffineForm& kept) const {
  std::vector<KeptShare> shares(shapes_.size());
  const double slope = norm(kept.gradient);
  std::size_t next = 0;
  for (const SolidSample& sample : problem_.samples) {
    double share = 1;
    KeptShare& tet = shares[sample.at.tet];
    if (sample.carvable > 0) {
      const double l = kept(Vec3{x_[next], y_[next], z_[next]});
      const double radius = radius_mm_[next++];
      const Cap left = slope > 0 ? cap(l / (slope * radius)) : Cap{l > 0 ? 1.0 : 0.0, 0};
      share = 1 - sample.carvable * (1 - left.share);
      if (left.offset > 0)
        tet.offset_mm4 += sample.carvable * sample.volume_mm3 * left.offset * radius / slope * kept.gradient;
    }
    const double mm3 = share * sample.volume_mm3;
    tet.volume_mm3 += mm3;
    for (std::size_t k = 0; k < 4; ++k) tet.at_corners_mm3[k] += mm3 * sample.at.weights[k];
  }
  return shares;
}

Result<CarvedShape> CarvedSamples::best_carving(const std::vector<Vec3>& vertices, const Job& job) {
  move_to(vertices);
  AffineForm kept{1, {}};
  double t = largest_t(rows_, solid_);
  if (!order_.empty()) {
    struct Asked {
      AffineForm form;
      Moments body;
    };
    std::optional<Asked> last;  // rows of one pose share their b, which is asked for each
    const BestBody body = [this, last](const AffineForm& form) mutable {
      if (!last || !(last->form.gradient == form.gradient && last->form.constant == form.constant))
        last = Asked{form, best_body(form)};
      return last->body;
    };
    PlaneSearch search(rows_, body, solid_);
    const auto found = search.most_stable(search_tolerance, job);
    if (!found) return tl::unexpected(found.error());
    kept = found->kept;
    t = found->t;
  }
  return CarvedShape{t, kept, shares(kept)};
}

}  // namespace aplomb::detail
