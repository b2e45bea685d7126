// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes that grow at random, slits between them, and the points of their cells.
#include "lattice_partition.h"

#include <cellwalk/internal/generators/slits.h>

#include <algorithm>

namespace cellwalk::detail {
namespace {

constexpr std::uint32_t no_index = 0xffffffffu;

/// True if every cube of the box lies in the lattice and belongs to no box yet.
template <int D>
bool is_free(const Lattice_partition<D>& partition, const Lattice_box<D>& box) {
  for (int a = 0; a < D; ++a)
    if (box.low[a] + box.size[a] > partition.cells[a]) return false;
  std::array<std::uint32_t, D> k{};
  for (;;) {
    auto cube = box.low;
    for (int a = 0; a < D; ++a) cube[a] += k[a];
    if (partition.box_of[partition.cube(cube)] != no_index) return false;
    int a = 0;
    for (; a < D && ++k[a] == box.size[a]; ++a) k[a] = 0;
    if (a == D) return true;
  }
}

template <int D>
void claim(Lattice_partition<D>& partition, const Lattice_box<D>& box) {
  const auto index = static_cast<std::uint32_t>(partition.boxes.size());
  std::array<std::uint32_t, D> k{};
  for (;;) {
    auto cube = box.low;
    for (int a = 0; a < D; ++a) cube[a] += k[a];
    partition.box_of[partition.cube(cube)] = index;
    int a = 0;
    for (; a < D && ++k[a] == box.size[a]; ++a) k[a] = 0;
    if (a == D) break;
  }
  partition.boxes.push_back(box);
}

/// Doubles a unit box along random axes, if any choice of them is free.
template <int D>
void grow(const Lattice_partition<D>& partition, Lattice_box<D>& box, Random& random) {
  std::vector<unsigned> axes;  // sets of axes, as bits
  for (unsigned set = 1; set < (1u << D); ++set) axes.push_back(set);
  random.shuffle(axes);
  for (unsigned set : axes) {
    Lattice_box<D> larger = box;
    for (int a = 0; a < D; ++a) larger.size[a] = 1 + ((set >> a) & 1);
    if (!is_free(partition, larger)) continue;
    box = larger;
    return;
  }
}

}  // namespace

template <int D>
Lattice_partition<D> make_lattice_partition(const Lattice_world_options<D>& options) {
  Lattice_partition<D> partition;
  partition.cells = options.cells;
  std::size_t total = 1;
  for (std::uint32_t n : options.cells) total *= n;
  partition.box_of.assign(total, no_index);
  Random random(options.seed);
  for (std::size_t i = 0; i < total; ++i) {
    if (partition.box_of[i] != no_index) continue;
    Lattice_box<D> box{{}, {}, Lattice_shape::box, 0};
    std::size_t rest = i;
    for (int a = 0; a < D; ++a) {
      box.low[a] = static_cast<std::uint32_t>(rest % options.cells[a]);
      box.size[a] = 1;
      rest /= options.cells[a];
    }
    double r = random.real();
    if ((r -= options.box_share) < 0)
      grow(partition, box, random);
    else if ((r -= options.simplex_share) < 0)
      box.shape = Lattice_shape::simplices;
    else if ((r -= options.prism_share) < 0)
      box.shape = Lattice_shape::prisms, box.axis = static_cast<int>(random.below(D));
    else if ((r -= options.star_share) < 0)
      box.shape = Lattice_shape::star;
    claim(partition, box);
  }
  return partition;
}

template <int D>
Lattice_builder<D>::Lattice_builder(const Lattice_world_options<D>& options)
    : options_(options), random_(scramble(options.seed)) {
  std::size_t names = 1;
  for (std::uint32_t n : options.cells) names *= 2 * n + 1;
  index_of_.assign(names, no_index);
  if (options.slit_share > 0) draw_slits();
}

/// Rectangles of squares (2D: rows of edges) that begin at random squares.
template <int D>
void Lattice_builder<D>::draw_slits() {
  Random random(scramble(options_.seed + 1));
  std::size_t total = 1;
  for (const std::uint32_t n : options_.cells) total *= n;
  for (int axis = 0; axis < D; ++axis) {
    slit_squares_[axis].assign(total, 0);
    for (std::size_t i = 0; i < total; ++i) {
      if (!random.chance(options_.slit_share)) continue;
      Name low, high;  // the cubes above the squares
      std::size_t rest = i;
      for (int a = 0; a < D; ++a) {
        low[a] = static_cast<std::uint32_t>(rest % options_.cells[a]);
        rest /= options_.cells[a];
        const auto size = a == axis ? 1 : 1 + static_cast<std::uint32_t>(random.below(3));
        high[a] = std::min(low[a] + size, options_.cells[a]);
      }
      for (Name at = low;;) {
        std::size_t cube = 0;
        for (int a = D - 1; a >= 0; --a) cube = cube * options_.cells[a] + at[a];
        slit_squares_[axis][cube] = 1;
        int a = 0;
        for (; a < D && ++at[a] == high[a]; ++a) at[a] = low[a];
        if (a == D) break;
      }
    }
  }
}

template <int D>
bool Lattice_builder<D>::is_in_slit(const std::vector<Name>& loop, std::uint64_t facet_hash) const {
  Name low = loop[0], high = loop[0];
  for (const Name& name : loop)
    for (int a = 0; a < D; ++a) {
      low[a] = std::min(low[a], name[a]);
      high[a] = std::max(high[a], name[a]);
    }
  for (int axis = 0; axis < D; ++axis) {
    if (low[axis] != high[axis] || low[axis] % 2 != 0) continue;
    std::size_t cube = 0;  // above the square in the middle of the facet
    for (int a = D - 1; a >= 0; --a) {
      const std::uint32_t middle = (low[a] + high[a]) / 4;
      if (middle >= options_.cells[a]) return false;  // on the high side of the world
      cube = cube * options_.cells[a] + middle;
    }
    return slit_squares_[axis][cube];
  }
  const std::uint64_t hash = scramble(facet_hash + 1);
  return static_cast<double>(hash >> 11) * 0x1p-53 < options_.slit_share / 2;
}

template <int D>
bool Lattice_builder<D>::begin_cell() {
  solid_ = random_.chance(options_.solid_share);
  return !random_.chance(options_.removed_share);
}

template <int D>
void Lattice_builder<D>::add_facet(const std::vector<Name>& loop) {
  loop_.clear();
  std::uint64_t facet_hash = scramble(options_.seed);  // the same for both sides of the facet
  for (const Name& name : loop) {
    std::size_t index = 0;
    for (int a = D - 1; a >= 0; --a) index = index * (2 * options_.cells[a] + 1) + name[a];
    facet_hash += scramble(index);
    if (index_of_[index] == no_index) {
      index_of_[index] = static_cast<std::uint32_t>(soup_.points.size());
      Point<D> lattice;
      for (int a = 0; a < D; ++a) lattice[a] = name[a] * 0.5;
      soup_.points.push_back(options_.map(lattice));
    }
    loop_.push_back(index_of_[index]);
  }
  const bool membrane = static_cast<double>(scramble(facet_hash) >> 11) * 0x1p-53 < options_.membrane_share;
  soup_.add_facet(loop_, solid_ || membrane);
  if (options_.slit_share > 0) is_slit_.push_back(is_in_slit(loop, facet_hash));
}

template <int D>
Cell_soup<D> Lattice_builder<D>::take() {
  if (options_.slit_share > 0) open_slits<D>(soup_, is_slit_);
  return std::move(soup_);
}

template <int D>
void Lattice_builder<D>::end_cell() {
  soup_.end_cell(solid_);
}

template Lattice_partition<2> make_lattice_partition(const Lattice_world_options<2>&);
template Lattice_partition<3> make_lattice_partition(const Lattice_world_options<3>&);
template class Lattice_builder<2>;
template class Lattice_builder<3>;

}  // namespace cellwalk::detail
