// SPDX-License-Identifier: LGPL-3.0-or-later
// A lattice placed in space by an exact affine map, and the environment that the library makes of it.
#ifndef CELLWALK_EXPERIMENTS_ENDURANCE_WORLD_H
#define CELLWALK_EXPERIMENTS_ENDURANCE_WORLD_H

#include <cellwalk/environment/environment.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/locate.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "lattice.h"

namespace cellwalk::endurance {

/// Random choices that are cheap, and the same on every machine.
class Draw : public Random {
 public:
  using Random::Random;
  /// A whole number in [0,n), as even as 64 bits allow.
  std::uint32_t whole(std::uint32_t n) {
    return static_cast<std::uint32_t>(Wide(bits()) * n >> 64 & 0xffffffffu);
  }
  Whole whole(Whole low, Whole high) {
    return low + static_cast<Whole>(Wide(bits()) * (high - low + 1) >> 64);
  }
};

/// x -> 2^exponent (origin + sum of x[i] columns[i]), in whole numbers below 2^53: every image is a double.
template <int D>
struct Placement {
  std::array<std::array<Whole, D>, D> columns{};
  std::array<Whole, D> origin{};
  double scale = 1;
  Whole length = 0;  ///< of the columns of a similarity

  Point<D> operator()(const Site<D>& x) const {
    Point<D> image;
    for (std::size_t row = 0; row < D; ++row) {
      Whole sum = origin[row];
      for (std::size_t i = 0; i < D; ++i) sum += x[i] * columns[i][row];
      image[row] = static_cast<double>(sum) * scale;
    }
    return image;
  }
  /// A length in space.
  /// \pre a similarity
  double operator()(Whole units) const { return static_cast<double>(units * length) * scale; }
};

enum class Placing {
  affine,     ///< sheared, turned or neither: facets have any direction
  similarity  ///< turned or not: distances have one scale
};

/// Placed at random.
/// \param bits of the units of a cell: 2^bits
/// \param most_cells along an axis, of all points that are mapped
template <int D>
Placement<D> random_placement(Placing placing, int bits, int most_cells, Draw& draw);

/// Not to be moved: the locator refers to the snapshot.
template <int D>
struct World {
  World(Lattice<D> cells, const Placement<D>& placed, int bits_of_cell);
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  Whole cell_units() const { return Whole{1} << bits; }
  const Snapshot<D>& snapshot() const { return environment.snapshot(); }
  Particle<D> particle(const Site<D>& x, std::uint32_t cell) const {
    return {place(x), snapshot().cell(cell)};
  }

  const Lattice<D> lattice;
  const Placement<D> place;
  const int bits;  ///< log2 of the units of a cell
  const Environment<D> environment;
  const Locator<D> locator;
  std::vector<std::uint32_t> side_of;  ///< of the lattice, by half-facet
  /// Unit normals of the families in space, up to rounding.
  std::array<Vector<D>, most_families> normals{};
};

/// The cells of a world as the library reads them.
template <int D>
Cell_soup<D> soup_of(const Lattice<D>& lattice, const Placement<D>& place, int bits);

/// Two to four cubes along each axis.
template <int D>
std::array<int, D> random_size(Draw& draw);

enum class Walls {
  any,    ///< solid cells and membranes
  few,    ///< the same, with room between them
  solid,  ///< solid cells only
};

/// Walls at random, scattered or, of membranes, in planes; shares of them are drawn, too.
template <int D>
void add_random_walls(Lattice<D>& lattice, Walls walls, Draw& draw);

/// Makes cells solid until all free cells at each point are linked there: no walls with free space on both
/// sides, and solid cells that meet in an edge or a vertex leave free space in one piece.
template <int D>
void link_free_cells(Lattice<D>& lattice);

}  // namespace cellwalk::endurance

#endif  // CELLWALK_EXPERIMENTS_ENDURANCE_WORLD_H
