// SPDX-License-Identifier: LGPL-3.0-or-later
// Hashed cubes on levels by the size of boxes, with chains of buckets.
#include <cellwalk/internal/environment/box_grid.h>

#include <algorithm>
#include <cmath>

namespace cellwalk::detail {
namespace {

/// Cubes are not smaller than this share of the coordinates of their boxes, so that their numbers are exact.
constexpr double least_share = 0x1p-40;
/// Levels of cubes outside this range are not used: boxes that need them are looked at by every query.
constexpr int lowest_level = -900, highest_level = 900, everywhere = 1000;
/// Boxes a bucket.
constexpr std::size_t load = 1;

std::int64_t cube_number(double x, int level) {
  return static_cast<std::int64_t>(std::floor(std::ldexp(x, -level)));
}

}  // namespace

template <int D>
typename Box_grid<D>::Cube Box_grid<D>::cube_of(const Box<D>& box) {
  double size = 0;
  for (std::size_t k = 0; k < D; ++k)
    size = std::max({size, box.high[k] - box.low[k], least_share * std::abs(box.low[k]),
                     least_share * std::abs(box.high[k])});
  Cube cube;
  cube.level = size > 0 && std::isfinite(size) ? std::ilogb(size) + 1 : everywhere;
  cube.level += cube.level & 1;  // even ones only, so that queries have fewer to look at
  if (cube.level < lowest_level || cube.level > highest_level) cube.level = everywhere;
  if (cube.level != everywhere)
    for (std::size_t k = 0; k < D; ++k) cube.at[k] = cube_number(box.low[k], cube.level);
  return cube;
}

template <int D>
std::uint64_t Box_grid<D>::Cube::key() const {
  std::uint64_t hash = static_cast<std::uint64_t>(level) * 0xbf58476d1ce4e5b9u;
  for (const std::int64_t x : at) {
    hash = (hash ^ static_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

template <int D>
void Box_grid<D>::count(int level, int change) {
  const auto found = std::find_if(levels_.begin(), levels_.end(),
                                  [&](const std::pair<int, int>& entry) { return entry.first == level; });
  if (found == levels_.end())
    levels_.emplace_back(level, change);
  else if ((found->second += change) == 0)
    levels_.erase(found);
}

template <int D>
void Box_grid<D>::link(std::uint32_t number) {
  Item& item = items_[number];
  std::uint32_t& first = first_[bucket(item.key)];
  item.previous = none;
  item.next = first;
  if (first != none) items_[first].previous = number;
  first = number;
}

template <int D>
void Box_grid<D>::unlink(std::uint32_t number) {
  const Item& item = items_[number];
  if (item.previous != none)
    items_[item.previous].next = item.next;
  else
    first_[bucket(item.key)] = item.next;
  if (item.next != none) items_[item.next].previous = item.previous;
}

template <int D>
void Box_grid<D>::set(std::uint32_t number, const Box<D>& box) {
  if (number >= items_.size()) {
    items_.resize(std::size_t{number} + 1);
    boxes_.resize(items_.size());
  }
  boxes_[number] = box;
  const Cube cube = cube_of(box);
  const std::uint64_t key = cube.key();
  Item& item = items_[number];
  const bool was_used = item.level != unused;
  if (was_used && item.key == key && item.level == cube.level) return;
  count(cube.level, 1);
  if (was_used) {
    count(item.level, -1);
    unlink(number);
  }
  used_ += was_used ? 0 : 1;
  item.key = key;
  item.level = static_cast<std::int16_t>(cube.level);
  if (used_ <= load * first_.size()) {
    link(number);
    return;
  }
  first_.assign(std::max<std::size_t>(16, 2 * first_.size()), none);
  for (std::uint32_t i = 0; i < items_.size(); ++i)
    if (items_[i].level != unused) link(i);
}

template <int D>
void Box_grid<D>::remove(std::uint32_t number) {
  count(items_[number].level, -1);
  unlink(number);
  items_[number].level = unused;
  --used_;
}

template <int D>
void Box_grid<D>::find(const Box<D>& box, std::vector<std::uint32_t>& numbers) const {
  const auto append_chain = [&](int level, std::uint64_t key) {
    for (std::uint32_t i = first_[bucket(key)]; i != none; i = items_[i].next)
      if (items_[i].key == key && items_[i].level == level && boxes_[i].meets(box)) numbers.push_back(i);
  };
  for (const auto& [level, boxes] : levels_) {
    Cube low, high;
    low.level = level;
    double cubes = 1;
    for (std::size_t k = 0; k < D && level != everywhere; ++k) {
      const double first = std::floor(std::ldexp(box.low[k], -level)) - 1,
                   last = std::floor(std::ldexp(box.high[k], -level));
      cubes *= last - first + 1;
      // Numbers that are not exact make the product large.
      if (!(std::abs(first) < 0x1p52 && std::abs(last) < 0x1p52))
        cubes = static_cast<double>(items_.size()) + 1;
      if (!(cubes <= static_cast<double>(items_.size()))) break;
      low.at[k] = static_cast<std::int64_t>(first);
      high.at[k] = static_cast<std::int64_t>(last);
    }
    if (level == everywhere || !(cubes <= static_cast<double>(items_.size()))) {
      for (std::uint32_t i = 0; i < items_.size(); ++i)
        if (items_[i].level == level && boxes_[i].meets(box)) numbers.push_back(i);
      continue;
    }
    Cube cube = low;
    for (;;) {
      append_chain(level, cube.key());
      std::size_t k = 0;
      while (k < D && cube.at[k] == high.at[k]) cube.at[k] = low.at[k], ++k;
      if (k == D) break;
      ++cube.at[k];
    }
  }
}

template class Box_grid<2>;
template class Box_grid<3>;

}  // namespace cellwalk::detail
