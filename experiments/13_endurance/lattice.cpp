// SPDX-License-Identifier: LGPL-3.0-or-later
#include "lattice.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <stdexcept>

namespace cellwalk::endurance {
namespace {

/// Corners of a unit cube: bit i is coordinate i.
using Corners = std::vector<unsigned>;

int coordinate(unsigned corner, int axis) { return static_cast<int>(corner >> axis & 1u); }

/// Twice (2D) or six times (3D) the signed volume of a simplex.
int volume(const Corners& s, int dimension) {
  const auto edge = [&](std::size_t v, int axis) { return coordinate(s[v], axis) - coordinate(s[0], axis); };
  if (dimension == 2) return edge(1, 0) * edge(2, 1) - edge(1, 1) * edge(2, 0);
  int sum = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    sum += edge(1, i) * (edge(2, j) * edge(3, k) - edge(2, k) * edge(3, j));
  }
  return sum;
}

/// The sides of the cells into which a cube is cut, each counterclockwise seen from outside.
std::vector<std::vector<Corners>> cut_cube(int dimension, Cut cut) {
  if (cut == Cut::cubes && dimension == 2) return {{{0, 1}, {1, 3}, {3, 2}, {2, 0}}};
  if (cut == Cut::cubes) {
    std::vector<Corners> sides;
    for (unsigned i = 0; i < 3; ++i) {
      const unsigned j = 1u << (i + 1) % 3, k = 1u << (i + 2) % 3, far = 1u << i;
      sides.push_back({0, k, j | k, j});
      sides.push_back({far, far | j, far | j | k, far | k});
    }
    return {sides};
  }
  std::vector<std::vector<Corners>> cells;
  std::vector<int> order(static_cast<std::size_t>(dimension));
  std::iota(order.begin(), order.end(), 0);
  do {
    Corners path{0};
    for (const int axis : order) path.push_back(path.back() | 1u << axis);
    if (volume(path, dimension) < 0) std::swap(path[0], path[1]);
    if (dimension == 2)
      cells.push_back({{path[0], path[1]}, {path[1], path[2]}, {path[2], path[0]}});
    else
      cells.push_back({{path[0], path[2], path[1]},
                       {path[0], path[1], path[3]},
                       {path[1], path[2], path[3]},
                       {path[2], path[0], path[3]}});
  } while (std::next_permutation(order.begin(), order.end()));
  return cells;
}

/// The rank of the normals of some families.
int rank_of(const std::vector<Family>& families, unsigned chosen) {
  // Differences join coordinates, single ones join them with 0: a forest on coordinates and 0.
  std::array<int, 4> root{0, 1, 2, 3};
  int rank = 0;
  for (std::size_t j = 0; j < families.size(); ++j) {
    if (!(chosen >> j & 1u)) continue;
    const int a = root[static_cast<std::size_t>(families[j].i)];
    const int b = root[families[j].k < 0 ? 3 : static_cast<std::size_t>(families[j].k)];
    if (a == b) continue;
    ++rank;
    for (int& r : root)
      if (r == b) r = a;
  }
  return rank;
}

}  // namespace

template <int D>
Lattice<D>::Lattice(const std::array<int, D>& size, Cut cut)
    : size_(size), cut_(cut), sides_of_cell_(cut == Cut::cubes ? 2 * D : D + 1) {
  for (int i = 0; i < D; ++i) families_.push_back({i, -1});
  if (cut == Cut::simplices)
    for (int i = 0; i < D; ++i)
      for (int k = i + 1; k < D; ++k) families_.push_back({i, k});
  for (unsigned chosen = 0; chosen < 1u << families_.size(); ++chosen)
    dimensions_[chosen] = static_cast<std::uint8_t>(D - rank_of(families_, chosen));
  for (const int n : size_) point_count_ *= static_cast<std::size_t>(n) + 1;
  add_cells();
  pair_sides();
  find_planes();
}

template <int D>
std::array<int, D> Lattice<D>::point(std::size_t number) const {
  std::array<int, D> x{};
  for (std::size_t i = 0; i < D; ++i) {
    const auto count = static_cast<std::size_t>(size_[i]) + 1;
    x[i] = static_cast<int>(number % count);
    number /= count;
  }
  return x;
}

/// Cube after cube, the first coordinate fastest.
template <int D>
void Lattice<D>::add_cells() {
  const auto cells = cut_cube(D, cut_);
  std::array<int, D> cube{};
  for (;;) {
    for (const auto& sides : cells) {
      for (const Corners& corners : sides) add_side(corners, cube);
      floors_.push_back({});
      solid_.push_back(0);
    }
    std::size_t i = 0;
    while (i < D && ++cube[i] == size_[i]) cube[i++] = 0;
    if (i == D) return;
  }
}

template <int D>
void Lattice<D>::add_side(const std::vector<unsigned>& corners, const std::array<int, D>& cube) {
  auto& loop = loops_.emplace_back();
  for (const unsigned corner : corners) {
    std::size_t number = 0;
    for (int i = D - 1; i >= 0; --i)
      number = number * static_cast<std::size_t>(size_[static_cast<std::size_t>(i)] + 1) +
               static_cast<std::size_t>(cube[static_cast<std::size_t>(i)] + coordinate(corner, i));
    loop.push_back(static_cast<std::uint32_t>(number));
  }
}

template <int D>
void Lattice<D>::pair_sides() {
  opposite_.assign(loops_.size(), no_cell);
  std::map<std::vector<std::uint32_t>, std::uint32_t> open;
  for (std::uint32_t s = 0; s < loops_.size(); ++s) {
    std::vector<std::uint32_t> key = loops_[s];
    std::sort(key.begin(), key.end());
    const auto [at, is_new] = open.try_emplace(key, s);
    if (is_new) continue;
    opposite_[s] = at->second;
    opposite_[at->second] = s;
    open.erase(at);
  }
}

template <int D>
void Lattice<D>::find_planes() {
  sides_.resize(loops_.size());
  for (std::uint32_t cell = 0; cell < cell_count(); ++cell) {
    // Sums over all corners of sides: every corner of the cell is on as many of them.
    std::array<int, D> sum{};
    int count = 0;
    for (std::size_t s = cell * sides_of_cell_; s < (cell + 1) * sides_of_cell_; ++s)
      for (const std::uint32_t p : loops_[s]) {
        ++count;
        for (std::size_t i = 0; i < D; ++i) sum[i] += point(p)[i];
      }
    const auto value = [](const Family& f, const std::array<int, D>& x) {
      return x[static_cast<std::size_t>(f.i)] - (f.k < 0 ? 0 : x[static_cast<std::size_t>(f.k)]);
    };
    for (std::size_t j = 0; j < families_.size(); ++j) {
      const int inside = value(families_[j], sum);
      floors_[cell][j] = static_cast<std::int8_t>((inside + 64 * count) / count - 64);  // rounds down
      for (std::size_t s = cell * sides_of_cell_; s < (cell + 1) * sides_of_cell_; ++s) {
        const int first = value(families_[j], point(loops_[s][0]));
        if (!std::all_of(loops_[s].begin(), loops_[s].end(),
                         [&](std::uint32_t p) { return value(families_[j], point(p)) == first; }))
          continue;
        sides_[s] = {opposite_[s] == no_cell ? no_cell : cell_of(opposite_[s]),
                     static_cast<std::int16_t>(first), static_cast<std::uint8_t>(j),
                     static_cast<std::int8_t>(inside < first * count ? 1 : -1)};
      }
    }
  }
  if (std::any_of(sides_.begin(), sides_.end(), [](const Side& s) { return s.outwards == 0; }))
    throw std::logic_error("a side lies in no plane of the lattice");
}

template <int D>
void Lattice<D>::make_solid(std::uint32_t cell) {
  solid_[cell] = 1;
  for (std::size_t s = cell * sides_of_cell_; s < (cell + 1) * sides_of_cell_; ++s) make_wall(s);
}

template <int D>
void Lattice<D>::make_wall(std::size_t side) {
  sides_[side].beyond = no_cell;
  if (opposite_[side] != no_cell) sides_[opposite_[side]].beyond = no_cell;
}

template class Lattice<2>;
template class Lattice<3>;

}  // namespace cellwalk::endurance
