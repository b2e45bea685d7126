// SPDX-License-Identifier: LGPL-3.0-or-later
// Sets without neighbours, drawn with equal probability along each axis or cell by cell.
#include "apart.h"

#include <algorithm>
#include <numeric>

namespace cellwalk::detail {
namespace {

/// The largest size of a set of numbers in [0,n) no two of which are neighbours.
std::uint64_t most_apart(std::uint64_t n) { return (n + 1) / 2; }

/// `count` numbers in [0,n), no two of them neighbours, with equal probability for every such set; ascending.
/// Closing the gap after each number maps these sets onto the subsets of [0, n-count+1).
std::vector<std::uint32_t> numbers_apart(std::uint32_t n, std::uint64_t count, Random& random) {
  const std::uint64_t range = n - count + 1;
  std::vector<std::uint32_t> chosen;
  for (std::uint64_t i = 0; i < range && chosen.size() < count; ++i)  // selection sampling
    if (random.below(range - i) < count - chosen.size())
      chosen.push_back(static_cast<std::uint32_t>(i + chosen.size()));
  return chosen;
}

/// Spreads `count` cells over random parts that lie apart along the last of `Axes` axes, recursively. A part
/// (a layer, a row) starts at cell `first`.
template <int D, int Axes>
void spread(const std::array<std::uint32_t, D>& cells, std::uint64_t count, std::uint64_t first,
            Random& random, std::vector<std::uint32_t>& chosen) {
  if (count == 0) return;
  const std::uint32_t n = cells[Axes - 1];
  if constexpr (Axes == 1) {
    for (std::uint32_t i : numbers_apart(n, count, random))
      chosen.push_back(static_cast<std::uint32_t>(first + i));
  } else {
    std::uint64_t stride = 1, capacity = 1;  // of one part
    for (int a = 0; a + 1 < Axes; ++a) {
      stride *= cells[a];
      capacity *= most_apart(cells[a]);
    }
    // Between the fewest parts that can contain them and the most that fit: leaves freedom along every axis.
    const std::uint64_t fewest = (count + capacity - 1) / capacity;
    const std::uint64_t parts = std::min((fewest + most_apart(n) + 1) / 2, count);
    std::vector<std::uint64_t> share(parts, count / parts);
    for (std::uint64_t i = 0; i < count % parts; ++i) ++share[i];
    random.shuffle(share);
    const auto places = numbers_apart(n, parts, random);
    for (std::uint64_t i = 0; i < parts; ++i)
      spread<D, Axes - 1>(cells, share[i], first + places[i] * stride, random, chosen);
  }
}

/// Draws cells one by one among those that touch none drawn before; fewer than `count` if it gets stuck.
template <int D>
std::vector<std::uint32_t> draw(const std::array<std::uint32_t, D>& cells, std::uint64_t count,
                                Random& random) {
  std::uint64_t total = 1;
  for (std::uint32_t n : cells) total *= n;
  std::vector<std::uint32_t> order(total);
  std::iota(order.begin(), order.end(), 0u);
  std::vector<std::uint8_t> taken(total, 0);
  std::vector<std::uint32_t> chosen;
  for (std::uint64_t i = 0; i < total && chosen.size() < count; ++i) {
    std::swap(order[i], order[i + random.below(total - i)]);
    const std::uint32_t cell = order[i];
    if (taken[cell]) continue;
    chosen.push_back(cell);
    // Blocks the neighbours axis by axis: the box of cells around it.
    std::array<std::uint32_t, D> low, high;
    std::uint32_t rest = cell;
    for (int a = 0; a < D; ++a) {
      const std::uint32_t k = rest % cells[a];
      rest /= cells[a];
      low[a] = k == 0 ? 0 : k - 1;
      high[a] = std::min(k + 1, cells[a] - 1);
    }
    std::array<std::uint32_t, D> k = low;
    for (;;) {
      std::uint64_t index = 0;
      for (int a = D - 1; a >= 0; --a) index = index * cells[a] + k[a];
      taken[index] = 1;
      int a = 0;
      for (; a < D && k[a] == high[a]; ++a) k[a] = low[a];
      if (a == D) break;
      ++k[a];
    }
  }
  return chosen;
}

}  // namespace

template <int D>
std::uint64_t most_cells_apart(const std::array<std::uint32_t, D>& cells) {
  std::uint64_t most = 1;
  for (std::uint32_t n : cells) most *= most_apart(n);
  return most;
}

template <int D>
std::vector<std::uint32_t> cells_apart(const std::array<std::uint32_t, D>& cells, std::uint64_t count,
                                       Random& random) {
  std::vector<std::uint32_t> chosen = draw<D>(cells, count, random);
  if (chosen.size() < count) {
    chosen.clear();
    spread<D, D>(cells, count, 0, random, chosen);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

template std::uint64_t most_cells_apart<2>(const std::array<std::uint32_t, 2>&);
template std::uint64_t most_cells_apart<3>(const std::array<std::uint32_t, 3>&);
template std::vector<std::uint32_t> cells_apart<2>(const std::array<std::uint32_t, 2>&, std::uint64_t,
                                                   Random&);
template std::vector<std::uint32_t> cells_apart<3>(const std::array<std::uint32_t, 3>&, std::uint64_t,
                                                   Random&);

}  // namespace cellwalk::detail
