// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes that tile a larger box and do not conform.
#ifndef CELLWALK_TESTS_ENVIRONMENT_REFINE_RANDOM_BLOCKS_H
#define CELLWALK_TESTS_ENVIRONMENT_REFINE_RANDOM_BLOCKS_H

#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/records/cell_soup.h>

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace cellwalk::test {

template <int D>
struct Block {
  Point<D> low, high;
  bool is_there = true;

  double volume() const {
    double product = 1;
    for (std::size_t k = 0; k < D; ++k) product *= high[k] - low[k];
    return product;
  }
};

/// A box cut at random whole numbers until its parts are as many as asked for.
/// \param absent the probability that a part is left out
template <int D>
std::vector<Block<D>> random_blocks(Random& random, double extent, std::size_t count, double absent) {
  Block<D> whole;
  whole.low.fill(0);
  whole.high.fill(extent);
  std::vector<Block<D>> blocks{whole};
  for (int tries = 0; blocks.size() < count && tries < 1000; ++tries) {
    Block<D>& block = blocks[random.below(blocks.size())];
    const std::size_t k = random.below(D);
    const auto size = static_cast<std::uint64_t>(block.high[k] - block.low[k]);
    if (size < 2) continue;
    Block<D> upper = block;
    upper.low[k] = block.high[k] = block.low[k] + static_cast<double>(1 + random.below(size - 1));
    blocks.push_back(upper);
  }
  for (Block<D>& block : blocks) block.is_there = !random.chance(absent);
  return blocks;
}

/// The blocks that are there as cells, with common points.
/// \param in_tetrahedra the probability that a block is six tetrahedra (2D: two triangles)
template <int D>
Cell_soup<D> cells_of(const std::vector<Block<D>>& blocks, Random& random, double in_tetrahedra = 0) {
  Cell_soup<D> soup;
  std::map<Point<D>, std::uint32_t> indices;
  for (const Block<D>& block : blocks) {
    if (!block.is_there) continue;
    std::array<std::uint32_t, std::size_t{1} << D> v;
    for (std::size_t corner = 0; corner < v.size(); ++corner) {
      Point<D> p;
      for (std::size_t k = 0; k < D; ++k) p[k] = corner >> k & 1 ? block.high[k] : block.low[k];
      const auto [at, is_new] = indices.try_emplace(p, static_cast<std::uint32_t>(soup.points.size()));
      if (is_new) soup.points.push_back(p);
      v[corner] = at->second;
    }
    const bool is_divided = random.chance(in_tetrahedra);
    if constexpr (D == 2) {
      if (is_divided) {
        add_polygon(soup, std::vector<std::uint32_t>{v[0], v[1], v[3]});
        add_polygon(soup, std::vector<std::uint32_t>{v[0], v[3], v[2]});
      } else {
        add_polygon(soup, std::vector<std::uint32_t>{v[0], v[1], v[3], v[2]});
      }
    } else if (is_divided) {
      for (const auto& t : std::vector<std::array<std::uint32_t, 4>>{
               {0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}})
        add_tetrahedron(soup, v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
    } else {
      add_hexahedron(soup, {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]});
    }
  }
  return soup;
}

/// The components of the blocks that are there, joined where two share a part of a facet, and their volume.
template <int D>
std::pair<std::size_t, double> components_and_volume(const std::vector<Block<D>>& blocks) {
  std::vector<std::size_t> part(blocks.size());
  std::size_t components = 0;
  double volume = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    part[i] = i;
    if (!blocks[i].is_there) continue;
    ++components;
    volume += blocks[i].volume();
    for (std::size_t j = 0; j < i; ++j) {
      std::size_t touching = 0;
      bool is_apart = !blocks[j].is_there;
      for (std::size_t k = 0; k < D; ++k) {
        is_apart |= blocks[i].low[k] > blocks[j].high[k] || blocks[j].low[k] > blocks[i].high[k];
        touching += blocks[i].low[k] == blocks[j].high[k] || blocks[j].low[k] == blocks[i].high[k];
      }
      if (is_apart || touching > 1 || part[i] == part[j]) continue;
      const std::size_t from = part[j], to = part[i];
      for (std::size_t k = 0; k <= i; ++k)
        if (part[k] == from) part[k] = to;
      --components;
    }
  }
  return {components, volume};
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_ENVIRONMENT_REFINE_RANDOM_BLOCKS_H
