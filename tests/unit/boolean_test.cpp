#include "aplomb/adapters/cgal/boolean.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <vector>

#include "aplomb/adapters/cgal/surface_repair.h"
#include "support/shapes.h"

namespace aplomb {
namespace {

/// Holds a heap in another state for as long as it lives: blocks of many sizes, every other one free again.
class OtherHeap {
 public:
  explicit OtherHeap(unsigned seed) {
    std::minstd_rand random(seed);
    for (std::size_t i = 0; i < 4000; ++i) blocks_.emplace_back(16 + random() % (1u << (4 + random() % 12)));
    for (std::size_t i = random() % 3; i < blocks_.size(); i += 2) std::vector<char>().swap(blocks_[i]);
  }

 private:
  std::vector<std::vector<char>> blocks_;
};

/// What `operation` gives in ten heaps is what it gives in the first.
template <class Operation>
void expect_same_in_every_heap(const Operation& operation) {
  const std::optional<TriangleMesh> first = operation();
  ASSERT_TRUE(first.has_value());
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const OtherHeap heap(seed);
    EXPECT_EQ(operation(), first) << "heap " << seed;
  }
}

TEST(Boolean, what_is_united_does_not_depend_on_where_memory_lies) {
  const std::vector<TriangleMesh> round{test::sphere({}, 5, 3), test::sphere({4, 1, 0.5}, 4, 3),
                                        test::sphere({-3, 2, 1}, 3, 3)};
  expect_same_in_every_heap([&] { return adapters::united(round); });
  const std::vector<TriangleMesh> square{test::box({}, {10, 10, 10}), test::box({5, 5, 5}, {15, 15, 15}),
                                         test::box({2, 2, 10}, {8, 8, 12})};
  expect_same_in_every_heap([&] { return adapters::united(square); });
}

TEST(Boolean, what_is_cut_does_not_depend_on_where_memory_lies) {
  const TriangleMesh rod = test::cylinder({}, 5, 10, 24), slot = test::box({-1, -1, -1}, {1, 1, 11});
  expect_same_in_every_heap([&] { return adapters::difference(rod, slot); });
  const TriangleMesh ball = test::sphere({}, 5, 3), dent = test::sphere({-3, 2, 1}, 3, 3);
  expect_same_in_every_heap([&] { return adapters::difference(ball, dent); });
  expect_same_in_every_heap([&] { return adapters::intersection(ball, dent); });
}

}  // namespace
}  // namespace aplomb
