#include "aplomb/deform/detail/cage_energy.h"

#include <algorithm>
#include <cmath>

namespace aplomb::detail {
namespace {

constexpr double hold = 1e-6;  // of a vertex's elastic stiffness: keeps a cage that nothing fixes from drifting

constexpr std::size_t pair_index(std::size_t k, std::size_t l) { return k * (k + 1) / 2 + l; }

/// The sum over the modes of curvature direction_k (outer) direction_l, where direction_k = mode slope_k.
using TetHessian = std::array<Mat3, 10>;

void add_outer(Mat3& sum, double factor, Vec3 a, Vec3 b) {
  for (int i = 0; i < 3; ++i) sum.rows[std::size_t(i)] += factor * a[i] * b;
}

TetHessian tet_hessian(const TetShape& shape, const std::array<TetEnergy::Mode, 9>& modes, double weight,
                       bool projected) {
  TetHessian sum;
  sum.fill(Mat3{{{{}, {}, {}}}});
  for (const TetEnergy::Mode& mode : modes) {
    if (projected && mode.curvature <= 0) continue;
    std::array<Vec3, 4> of_corner;
    for (std::size_t k = 0; k < 4; ++k) of_corner[k] = mode.direction * shape.slopes[k];
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l <= k; ++l)
        add_outer(sum[pair_index(k, l)], weight * mode.curvature, of_corner[k], of_corner[l]);
  }
  return sum;
}

/// Slopes that make F S^-1 instead of F.
std::vector<TetShape> eased(std::vector<TetShape> shapes, const std::vector<Mat3>& wanted) {
  for (std::size_t t = 0; t < wanted.size(); ++t) {
    const Mat3 inverse_transposed = 1 / determinant(wanted[t]) * cofactor(wanted[t]);
    for (Vec3& slope : shapes[t].slopes) slope = inverse_transposed * slope;
  }
  return shapes;
}

}  // namespace

FreeVertices::FreeVertices(const std::vector<bool>& fixed) {
  for (const bool is_fixed : fixed) {
    first_.push_back(is_fixed ? -1 : unknowns_);
    if (!is_fixed) unknowns_ += 3;
  }
}

std::vector<double> FreeVertices::gather(const std::vector<Vec3>& field) const {
  std::vector<double> values;
  values.reserve(std::size_t(unknowns_));
  for (std::size_t v = 0; v < field.size(); ++v)
    if (first_[v] >= 0) values.insert(values.end(), {field[v].x, field[v].y, field[v].z});
  return values;
}

std::vector<Vec3> FreeVertices::scatter(const double* values) const {
  std::vector<Vec3> field(first_.size());
  for (std::size_t v = 0; v < field.size(); ++v)
    if (const int i = first_[v]; i >= 0) field[v] = {values[i], values[i + 1], values[i + 2]};
  return field;
}

CageEnergy::CageEnergy(const CageProblem& problem, const DeformOptions& options, const std::vector<TetShape>& shapes)
    : problem_(problem),
      shapes_(eased(shapes, problem.wanted)),
      density_{options.alpha_ratio, options.beta_ratio, options.gamma_ratio},
      free_(problem.fixed),
      holds_(problem.rest.vertices.size()) {
  std::vector<double> size_mm(problem.rest.vertices.size());
  double solid_mm3 = 0;
  for (std::size_t t = 0; t < shapes.size(); ++t) {
    const double solid = shapes[t].volume_mm3 * problem.solid_share[t];
    solid_mm3 += solid;
    weights_.push_back(solid * problem.stiffness[t]);
    for (const std::uint32_t v : problem.rest.tets[t]) {
      size_mm[v] += shapes[t].volume_mm3 / 4;
      holds_[v] += hold * weights_[t] / std::pow(shapes[t].volume_mm3, 2.0 / 3);
    }
  }
  for (double& size : size_mm) size = std::cbrt(size);
  for (const GroundPlane& plane : problem.grounds)
    grounds_.emplace_back(plane, options.ground_ratio, problem.rest.vertices, size_mm);
  for (const SoftHandle& handle : problem.handles)
    handles_.push_back(
        {problem.rest.tets[handle.at.tet], handle.at.weights, handle.target_mm, handle.weight * std::cbrt(solid_mm3)});
  make_pattern();
}

double CageEnergy::value(const std::vector<Vec3>& vertices) const {
  double sum = 0;
  for (std::size_t t = 0; t < shapes_.size(); ++t) {
    sum += weights_[t] * density_.value(deformation_gradient(shapes_[t], problem_.rest.tets[t], vertices));
    if (!std::isfinite(sum)) return sum;
  }
  for (const Ground& ground : grounds_) sum += ground.value(vertices);
  for (const HandleTerm& handle : handles_) sum += handle.value(vertices);
  return sum;
}

std::vector<Vec3> CageEnergy::elastic_gradient(const std::vector<Vec3>& vertices) const {
  std::vector<Vec3> sum(vertices.size());
  for (std::size_t t = 0; t < shapes_.size(); ++t) {
    const TetMesh::Tet& tet = problem_.rest.tets[t];
    const Mat3 stress = density_.gradient(deformation_gradient(shapes_[t], tet, vertices));
    for (std::size_t k = 0; k < 4; ++k) sum[tet[k]] += weights_[t] * (stress * shapes_[t].slopes[k]);
  }
  for (const HandleTerm& handle : handles_) handle.add_gradient(vertices, sum);
  return sum;
}

void CageEnergy::drop_fixed(std::vector<Vec3>& field) const {
  for (std::size_t v = 0; v < field.size(); ++v)
    if (problem_.fixed[v]) field[v] = {};
}

std::vector<Vec3> CageEnergy::gradient(const std::vector<Vec3>& vertices) const {
  std::vector<Vec3> sum = elastic_gradient(vertices);
  for (const Ground& ground : grounds_) ground.add_gradient(vertices, sum);
  drop_fixed(sum);
  return sum;
}

std::vector<Vec3> CageEnergy::model_gradient(const std::vector<Vec3>& vertices) const {
  std::vector<Vec3> sum = elastic_gradient(vertices);
  for (const Ground& ground : grounds_) ground.add_foreseen_gradient(vertices, sum);
  drop_fixed(sum);
  return sum;
}

bool CageEnergy::foresee(const std::vector<Vec3>& now, const std::vector<Vec3>& next) {
  bool found = false;
  for (Ground& ground : grounds_) found |= ground.foresee(now, next);
  return found;
}

void CageEnergy::forget() {
  for (Ground& ground : grounds_) ground.forget();
}

// A vertex has three columns. Each starts with the vertex's own block, of which the lower triangle is stored; then come
// three rows for each later neighbour.
void CageEnergy::make_pattern() {
  neighbours_.resize(std::size_t(free_.unknowns() / 3));
  for (const TetMesh::Tet& tet : problem_.rest.tets)
    for (const std::uint32_t a : tet)
      for (const std::uint32_t b : tet)
        if (const int i = free_.first_unknown(a), j = free_.first_unknown(b); i >= 0 && j > i)
          neighbours_[std::size_t(i / 3)].push_back(j / 3);
  for (std::size_t v = 0; v < neighbours_.size(); ++v) {
    auto& later = neighbours_[v];
    std::sort(later.begin(), later.end());
    later.erase(std::unique(later.begin(), later.end()), later.end());
    for (int c = 0; c < 3; ++c) {
      for (int r = c; r < 3; ++r) hessian_.rows.push_back(int(v) * 3 + r);
      for (const int other : later)
        for (int r = 0; r < 3; ++r) hessian_.rows.push_back(other * 3 + r);
      hessian_.column_starts.push_back(int(hessian_.rows.size()));
    }
  }
  hessian_.values.resize(hessian_.rows.size());
  for (const TetMesh::Tet& tet : problem_.rest.tets) {
    auto& offsets = offsets_.emplace_back();
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l <= k; ++l) {
        const int i = free_.first_unknown(tet[k]), j = free_.first_unknown(tet[l]);
        offsets[pair_index(k, l)] = i < 0 || j < 0 ? -1 : block_offset(std::max(i, j) / 3, std::min(i, j) / 3);
      }
  }
}

int CageEnergy::block_offset(int row_vertex, int column_vertex) const {
  if (row_vertex == column_vertex) return 0;
  const auto& later = neighbours_[std::size_t(column_vertex)];
  return 3 * int(std::lower_bound(later.begin(), later.end(), row_vertex) - later.begin());
}

/// Adds the block of corners k (rows) and l (columns); the transposed one when l has the later unknowns.
void CageEnergy::add_block(const TetMesh::Tet& corners, std::size_t k, std::size_t l, int offset, const Mat3& block) {
  if (offset < 0) return;
  const int i = free_.first_unknown(corners[k]), j = free_.first_unknown(corners[l]);
  for (int c = 0; c < 3; ++c) {
    const int number = std::min(i, j) + c;
    double* const column = hessian_.values.data() + hessian_.column_starts[std::size_t(number)];
    if (i == j)
      for (int r = c; r < 3; ++r) column[r - c] += block.rows[std::size_t(r)][c];
    else
      for (int r = 0; r < 3; ++r)
        column[3 - c + offset + r] += i > j ? block.rows[std::size_t(r)][c] : block.rows[std::size_t(c)][r];
  }
}

void CageEnergy::add_tet(std::size_t t, const std::vector<Vec3>& vertices, bool projected) {
  const TetMesh::Tet& tet = problem_.rest.tets[t];
  const auto modes = density_.modes(deformation_gradient(shapes_[t], tet, vertices));
  const TetHessian blocks = tet_hessian(shapes_[t], modes, weights_[t], projected);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t l = 0; l <= k; ++l) add_block(tet, k, l, offsets_[t][pair_index(k, l)], blocks[pair_index(k, l)]);
}

const adapters::SparseSymmetric& CageEnergy::hessian(const std::vector<Vec3>& vertices, bool projected) {
  std::fill(hessian_.values.begin(), hessian_.values.end(), 0.0);
  for (std::size_t t = 0; t < shapes_.size(); ++t) add_tet(t, vertices, projected);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (problem_.fixed[v]) continue;
    const TetMesh::Tet self{std::uint32_t(v)};
    Mat3 block{{{{}, {}, {}}}};
    if (projected)
      for (int i = 0; i < 3; ++i) block.rows[std::size_t(i)][i] = holds_[v];
    for (const Ground& ground : grounds_) add_outer(block, ground.curvature(v, vertices[v]), ground.up(), ground.up());
    add_block(self, 0, 0, 0, block);
  }
  for (std::size_t h = 0; h < handles_.size(); ++h) {
    const HandleTerm& handle = handles_[h];
    const std::size_t t = problem_.handles[h].at.tet;
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l <= k; ++l) {
        const double value = handle.stiffness_mm * handle.weights[k] * handle.weights[l];
        add_block(handle.corners, k, l, offsets_[t][pair_index(k, l)],
                  {{{{value, 0, 0}, {0, value, 0}, {0, 0, value}}}});
      }
  }
  return hessian_;
}

}  // namespace aplomb::detail
