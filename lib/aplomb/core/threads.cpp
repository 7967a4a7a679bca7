#include "aplomb/core/threads.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

namespace aplomb {

struct ThreadLimit::Impl {
  explicit Impl(std::size_t threads) : control(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  const int count = threads > 0 ? threads : tbb::info::default_concurrency();
  impl_ = std::make_unique<Impl>(static_cast<std::size_t>(count));
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace aplomb
