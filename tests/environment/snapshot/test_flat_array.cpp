// SPDX-License-Identifier: LGPL-3.0-or-later
// Arrays of snapshots keep their values wherever they lie.
#include <cellwalk/internal/environment/flat_array.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk::detail {
namespace {

using Array = Flat_array<std::uint32_t>;

std::vector<std::uint32_t> numbers(std::size_t count) {
  std::vector<std::uint32_t> values(count);
  std::iota(values.begin(), values.end(), 7u);
  return values;
}

void expect_numbers(const Array& array, std::size_t count) {
  ASSERT_EQ(array.size(), count);
  for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(array[i], 7 + i);
}

TEST(FlatArray, LiesInMemoryOfOthersUntilItGrows) {
  for (const std::size_t count : {1u, 2u, 100u}) {
    const auto held = std::make_shared<std::vector<std::uint32_t>>(numbers(count));
    const std::weak_ptr<const void> watch = held;
    Array array(std::span<std::uint32_t>(*held), held);
    EXPECT_EQ(array.data(), held->data());
    EXPECT_EQ(array.own_bytes(), 0u);
    array[0] = 8;
    EXPECT_EQ(held->front(), 8u);
    array[0] = 7;
    const Array copy = array;
    EXPECT_NE(copy.data(), held->data());

    array.push_back(array[count - 1] + 1);
    EXPECT_NE(array.data(), held->data());
    EXPECT_EQ(watch.use_count(), 1) << "the memory is held although nothing lies there";
    EXPECT_GE(array.own_bytes(), 4 * (count + 1));
    expect_numbers(array, count + 1);
    expect_numbers(copy, count);
  }
}

TEST(FlatArray, TakesAValueOfItsOwnAsItGrows) {
  Array array;
  array = numbers(1);
  for (std::size_t i = 1; i < 1000; ++i) array.push_back(array[0]);
  for (const std::uint32_t x : array) ASSERT_EQ(x, 7u);
}

TEST(FlatArray, IsCutShortAndGrowsByZeros) {
  const auto held = std::make_shared<std::vector<std::uint32_t>>(numbers(100));
  Array array(std::span<std::uint32_t>(*held), held);
  array.resize(10);
  expect_numbers(array, 10);
  array.resize(200);
  for (std::size_t i = 10; i < 200; ++i) EXPECT_EQ(array[i], 0u);
  array.resize(10);
  expect_numbers(array, 10);
}

TEST(FlatArray, IsMovedWithItsMemory) {
  Array array;
  array = numbers(50);
  const std::uint32_t* const memory = array.data();
  Array moved = std::move(array);
  EXPECT_EQ(moved.data(), memory);
  const auto held = std::make_shared<std::vector<std::uint32_t>>(numbers(5));
  moved = Array(std::span<std::uint32_t>(*held), held);
  EXPECT_EQ(moved.data(), held->data());
  expect_numbers(moved, 5);
  moved = numbers(3);
  EXPECT_EQ(held.use_count(), 1);
  expect_numbers(moved, 3);
}

}  // namespace
}  // namespace cellwalk::detail
