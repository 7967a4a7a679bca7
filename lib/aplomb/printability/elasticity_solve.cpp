#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>
#include <numeric>

#include "aplomb/adapters/cholmod/sparse_cholesky.h"
#include "aplomb/core/isolated.h"
#include "aplomb/printability/detail/quadratic_tet.h"
#include "aplomb/printability/elasticity.h"

namespace aplomb {
namespace {

using adapters::SparseCholesky;
using adapters::SparseSymmetric;

constexpr std::uint32_t held = std::numeric_limits<std::uint32_t>::max();

/// The tetrahedra round each node, and which of its nodes it is there.
struct Fans {
  struct Entry {
    std::uint32_t tet, corner;
  };
  std::vector<std::size_t> starts;
  std::vector<Entry> entries;

  explicit Fans(const QuadraticTets& mesh) : starts(mesh.nodes.size() + 1), entries(10 * mesh.tets.size()) {
    for (const auto& tet : mesh.tets)
      for (const std::uint32_t node : tet) ++starts[node + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
    for (std::uint32_t t = 0; t < mesh.tets.size(); ++t)
      for (std::uint32_t corner = 0; corner < 10; ++corner) entries[next[mesh.tets[t][corner]]++] = {t, corner};
  }
};

/// Assembles the free nodes' part of K, three rows and columns a node, a column of blocks at a time.
class Stiffness {
 public:
  Stiffness(const QuadraticTets& mesh, const ElasticMaterial& material, const std::vector<bool>& is_held)
      : mesh_(mesh), lame_(material), fans_(mesh), row_of_(mesh.nodes.size(), held) {
    for (std::uint32_t node = 0; node < row_of_.size(); ++node)
      if (!is_held[node]) {
        row_of_[node] = static_cast<std::uint32_t>(free_.size());
        free_.push_back(node);
      }
    shapes_.resize(mesh.tets.size());
    tbb::parallel_for(std::size_t{0}, shapes_.size(), [&](std::size_t t) { shapes_[t] = detail::tet_shape(mesh_, t); });
  }

  const std::vector<std::uint32_t>& free_nodes() const { return free_; }

  SparseSymmetric matrix() const {
    std::vector<std::vector<std::uint32_t>> below(free_.size());  // the rows of blocks in a column of blocks
    tbb::parallel_for(std::size_t{0}, free_.size(), [&](std::size_t column) { below[column] = neighbours(column); });
    SparseSymmetric matrix;
    matrix.column_starts.resize(3 * free_.size() + 1);
    for (std::size_t column = 0; column < free_.size(); ++column)
      for (std::size_t k = 0; k < 3; ++k)
        matrix.column_starts[3 * column + k + 1] =
            matrix.column_starts[3 * column + k] + static_cast<int>(3 * below[column].size() - k);
    matrix.rows.resize(std::size_t(matrix.column_starts.back()));
    matrix.values.resize(matrix.rows.size());
    tbb::parallel_for(std::size_t{0}, free_.size(), [&](std::size_t column) { fill(column, below[column], matrix); });
    return matrix;
  }

 private:
  std::vector<std::uint32_t> neighbours(std::size_t column) const {
    std::vector<std::uint32_t> rows;
    const std::uint32_t node = free_[column];
    for (std::size_t e = fans_.starts[node]; e < fans_.starts[node + 1]; ++e)
      for (const std::uint32_t other : mesh_.tets[fans_.entries[e].tet])
        if (row_of_[other] != held && row_of_[other] >= column) rows.push_back(row_of_[other]);
    std::ranges::sort(rows);
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    return rows;
  }

  void fill(std::size_t column, const std::vector<std::uint32_t>& below, SparseSymmetric& matrix) const {
    std::vector<Mat3> blocks(below.size(), Mat3{{{{}, {}, {}}}});
    const std::uint32_t node = free_[column];
    for (std::size_t e = fans_.starts[node]; e < fans_.starts[node + 1]; ++e) {
      const auto [tet, corner] = fans_.entries[e];
      for (const auto& place : detail::tet_points) {
        const auto gradients = detail::shape_gradients(shapes_[tet], place);
        const Vec3 b = shapes_[tet].volume_mm3 / 4 * gradients[corner];
        for (std::size_t n = 0; n < 10; ++n) {
          const std::uint32_t row = row_of_[mesh_.tets[tet][n]];
          if (row == held || row < column) continue;
          add(blocks[std::size_t(std::ranges::lower_bound(below, row) - below.begin())], gradients[n], b);
        }
      }
    }
    for (int k = 0; k < 3; ++k) {
      auto at = std::size_t(matrix.column_starts[3 * column + std::size_t(k)]);
      for (std::size_t block = 0; block < below.size(); ++block)
        for (int i = block == 0 ? k : 0; i < 3; ++i, ++at) {
          matrix.rows[at] = static_cast<int>(3 * below[block]) + i;
          matrix.values[at] = blocks[block].rows[std::size_t(i)][k];
        }
    }
  }

  /// lambda a b^T + mu b a^T + mu (a . b) 1
  void add(Mat3& block, Vec3 a, Vec3 b) const {
    const double both = lame_.mu_mpa * dot(a, b);
    for (int i = 0; i < 3; ++i) {
      Vec3& row = block.rows[std::size_t(i)];
      row += lame_.lambda_mpa * a[i] * b + lame_.mu_mpa * b[i] * a;
      row[i] += both;
    }
  }

  const QuadraticTets& mesh_;
  detail::Lame lame_;
  Fans fans_;
  std::vector<std::uint32_t> row_of_, free_;
  std::vector<detail::TetShape> shapes_;
};

/// The forces at free nodes, one load case after the other, without those that the held nodes' displacement causes.
std::vector<double> right_sides(const QuadraticTets& mesh, const ElasticMaterial& material, const ElasticLoads& loads,
                                const std::vector<std::uint32_t>& free) {
  NodalField by_support(mesh.nodes.size());
  if (!loads.held_at_mm.empty()) {
    NodalField moved(mesh.nodes.size());
    for (std::size_t n = 0; n < moved.size(); ++n)
      if (loads.held[n]) moved[n] = loads.held_at_mm[n];
    by_support = elastic_forces_n(mesh, material, moved);
  }
  std::vector<double> right;
  right.reserve(3 * free.size() * loads.forces_n.size());
  for (const NodalField& forces : loads.forces_n)
    for (const std::uint32_t node : free)
      for (int axis = 0; axis < 3; ++axis) right.push_back(forces[node][axis] - by_support[node][axis]);
  return right;
}

constexpr double most_seconds = 600;
constexpr double byte_per_mb = 1 << 20;

/// What the child says: 's' and the solution, 'm' and the bytes it would need, or 'f'.
std::string solve_bytes(const SparseSymmetric& matrix, const std::vector<double>& right, int columns, double most) {
  const auto said = [](char kind, const double* values, std::size_t count) {
    return std::string(1, kind).append(reinterpret_cast<const char*>(values), count * sizeof(double));
  };
  auto cholesky = SparseCholesky::analyse(matrix);
  if (!cholesky) return "f";
  if (const double bytes = cholesky->factor_bytes(); bytes > most) return said('m', &bytes, 1);
  if (!cholesky->factorise(matrix)) return "f";
  const std::vector<double> solved = cholesky->solve(right, columns);
  return said('s', solved.data(), solved.size());
}

/// In a child process, since CHOLMOD can neither be stopped nor be held to a budget.
Result<std::vector<double>> solved_apart(const SparseSymmetric& matrix, const std::vector<double>& right, int columns,
                                         std::size_t memory_bytes, const Job& job) {
  const double most = static_cast<double>(memory_bytes);
  const IsolationLimits limits{most_seconds, 1024 + static_cast<std::size_t>(2 * most / byte_per_mb)};
  const auto bytes = run_isolated([&] { return solve_bytes(matrix, right, columns, most); }, limits, job, "elasticity");
  if (!bytes) return tl::unexpected(bytes.error());
  const char kind = bytes->empty() ? 'f' : bytes->front();
  const std::size_t expected = kind == 's' ? right.size() : kind == 'm' ? 1 : 0;
  if (kind != 'f' && bytes->size() != 1 + expected * sizeof(double))
    return fail(ErrorCode::third_party, "the elastic system's solution came back spoilt");
  std::vector<double> values(expected);
  if (expected > 0) std::memcpy(values.data(), bytes->data() + 1, expected * sizeof(double));
  if (kind == 'm')
    return fail(ErrorCode::over_budget,
                fmt::format("elasticity with {} unknowns would take {:.0f} MB; allowed are {:.0f}", matrix.size(),
                            values.front() / byte_per_mb, most / byte_per_mb));
  if (kind != 's') return fail(ErrorCode::third_party, "CHOLMOD could not solve the elastic system");
  return values;
}

}  // namespace

Result<std::vector<NodalField>> solve_elasticity(const QuadraticTets& mesh, const ElasticMaterial& material,
                                                 const ElasticLoads& loads, std::size_t memory_bytes, const Job& job) {
  assert(loads.held.size() == mesh.nodes.size());
  if (!job.report(0, "elasticity")) return cancelled();
  const Stiffness stiffness(mesh, material, loads.held);
  const std::vector<std::uint32_t>& free = stiffness.free_nodes();
  std::vector<NodalField> moved(loads.forces_n.size(), NodalField(mesh.nodes.size()));
  for (NodalField& field : moved)
    for (std::size_t n = 0; n < loads.held_at_mm.size(); ++n)
      if (loads.held[n]) field[n] = loads.held_at_mm[n];
  if (free.empty() || moved.empty()) return moved;
  const SparseSymmetric matrix = stiffness.matrix();
  if (!job.report(0.1, "elasticity")) return cancelled();
  const auto solved = solved_apart(matrix, right_sides(mesh, material, loads, free), static_cast<int>(moved.size()),
                                   memory_bytes, job.part(0.1, 1));
  if (!solved) return tl::unexpected(solved.error());
  for (std::size_t load = 0; load < moved.size(); ++load)
    for (std::size_t row = 0; row < free.size(); ++row) {
      const double* u = &(*solved)[3 * (load * free.size() + row)];
      moved[load][free[row]] = {u[0], u[1], u[2]};
    }
  return moved;
}

}  // namespace aplomb
