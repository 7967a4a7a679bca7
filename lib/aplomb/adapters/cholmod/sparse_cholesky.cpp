#include "aplomb/adapters/cholmod/sparse_cholesky.h"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <cassert>
#include <new>

extern "C" {  // of libgomp, which CHOLMOD is linked to; a compiler's own omp.h may be another runtime's
int omp_get_max_active_levels(void);
void omp_set_max_active_levels(int levels);
}

namespace aplomb::adapters {

namespace {

/// While it lives, CHOLMOD works in this thread alone. It asks for four however many cores there are, to add up blocks
/// that take microseconds: measured, they cost up to half of a factorisation.
class OneThread {
 public:
  OneThread() { omp_set_max_active_levels(0); }
  ~OneThread() { omp_set_max_active_levels(levels_); }
  OneThread(const OneThread&) = delete;
  OneThread& operator=(const OneThread&) = delete;

 private:
  int levels_ = omp_get_max_active_levels();
};

}  // namespace

struct SparseCholesky::Impl {
  // CHOLMOD writes its status and workspace there, even in a solve, and wants it at one address.
  mutable cholmod_common common{};
  cholmod_factor* factor = nullptr;

  Impl() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.quick_return_if_not_posdef = true;
    common.nmethods = 2;  // the better of both: nested dissection takes half the time of a fat solid's factorisation
    common.method[0].ordering = CHOLMOD_AMD;
    common.method[1].ordering = CHOLMOD_METIS;
    common.postorder = true;
  }
  ~Impl() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
};

namespace {

/// CHOLMOD's view of the matrix; it only reads it.
cholmod_sparse view(const SparseSymmetric& matrix) {
  cholmod_sparse sparse{};
  sparse.nrow = sparse.ncol = std::size_t(matrix.size());
  sparse.nzmax = matrix.values.size();
  sparse.p = const_cast<int*>(matrix.column_starts.data());
  sparse.i = const_cast<int*>(matrix.rows.data());
  sparse.x = const_cast<double*>(matrix.values.data());
  sparse.stype = -1;  // the lower triangle
  sparse.itype = CHOLMOD_INT;
  sparse.xtype = CHOLMOD_REAL;
  sparse.dtype = CHOLMOD_DOUBLE;
  sparse.sorted = true;
  sparse.packed = true;
  return sparse;
}

}  // namespace

SparseCholesky::SparseCholesky(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;
SparseCholesky::~SparseCholesky() = default;

Result<SparseCholesky> SparseCholesky::analyse(const SparseSymmetric& matrix) {
  assert(matrix.size() > 0);
  auto impl = std::make_unique<Impl>();
  cholmod_sparse sparse = view(matrix);
  impl->factor = cholmod_analyze(&sparse, &impl->common);
  if (!impl->factor) return fail(ErrorCode::third_party, "CHOLMOD could not analyse the sparse system");
  return SparseCholesky(std::move(impl));
}

double SparseCholesky::factor_bytes() const { return 8 * impl_->common.lnz; }

bool SparseCholesky::factorise(const SparseSymmetric& matrix) {
  const OneThread one;
  cholmod_sparse sparse = view(matrix);
  const int done = cholmod_factorize(&sparse, impl_->factor, &impl_->common);
  return done && impl_->common.status == CHOLMOD_OK && impl_->factor->minor == impl_->factor->n;
}

std::vector<double> SparseCholesky::solve(const std::vector<double>& right, int columns) const {
  assert(right.size() == impl_->factor->n * std::size_t(columns));
  const OneThread one;
  cholmod_dense dense{};
  dense.nrow = dense.d = impl_->factor->n;
  dense.ncol = std::size_t(columns);
  dense.nzmax = right.size();
  dense.x = const_cast<double*>(right.data());
  dense.xtype = CHOLMOD_REAL;
  dense.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, impl_->factor, &dense, &impl_->common);
  if (!solution) throw std::bad_alloc();  // the only way for it to fail
  const double* x = static_cast<const double*>(solution->x);
  std::vector<double> result(x, x + right.size());
  cholmod_free_dense(&solution, &impl_->common);
  return result;
}

}  // namespace aplomb::adapters
