// SPDX-License-Identifier: LGPL-3.0-or-later
// Cubes (squares) of a lattice, or the simplices into which they are cut, in integers: the tables by which
// the judges follow motions. They share nothing with the library.
//
// All facets lie in planes f(x) = k with a whole k (in cells), where f is a coordinate x_i or, for simplices,
// a difference x_i - x_k: a family of parallel planes each. All planes of all families are made of facets, so
// the cells at a point are known by its families alone.
#ifndef CELLWALK_EXPERIMENTS_ENDURANCE_LATTICE_H
#define CELLWALK_EXPERIMENTS_ENDURANCE_LATTICE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk::endurance {

using Whole = std::int64_t;
__extension__ using Wide = __int128;  // not of ISO C++

/// A point in units of which 2^bits are a cell.
template <int D>
using Site = std::array<Whole, static_cast<std::size_t>(D)>;  // D is not deduced from it

enum class Cut { cubes, simplices };
inline constexpr std::array<const char*, 2> cut_names{"cubes", "simplices"};

inline constexpr std::uint32_t no_cell = 0xffffffffu;

/// Of planes f(x) = k: f is x[i], or x[i] - x[k] if k is not negative.
struct Family {
  int i = 0, k = -1;

  template <std::size_t D>
  Whole operator()(const std::array<Whole, D>& x) const {
    return k < 0 ? x[static_cast<std::size_t>(i)]
                 : x[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(k)];
  }
};
inline constexpr std::size_t most_families = 6;

/// A facet of a cell, seen from it.
struct Side {
  std::uint32_t beyond = no_cell;  ///< the cell to which it can be passed
  std::int16_t plane = 0;          ///< k, in cells
  std::uint8_t family = 0;
  std::int8_t outwards = 0;  ///< +1: f grows on the way out of the cell
};

/// A lattice of cells with walls. Sides of the boundary, and between a solid and a free cell, are walls.
template <int D>
class Lattice {
 public:
  /// Without solid cells and inner walls.
  Lattice(const std::array<int, D>& size, Cut cut);

  Cut cut() const { return cut_; }
  const std::array<int, D>& size() const { return size_; }  ///< in cubes
  std::size_t cell_count() const { return floors_.size(); }
  std::size_t sides_of_cell() const { return sides_of_cell_; }
  std::size_t side_count() const { return sides_.size(); }
  const std::vector<Family>& families() const { return families_; }

  /// Side i of a cell has the number cell * sides_of_cell() + i.
  const Side& side(std::size_t number) const { return sides_[number]; }
  const Side* sides(std::uint32_t cell) const { return sides_.data() + cell * sides_of_cell_; }
  std::uint32_t cell_of(std::size_t side) const { return static_cast<std::uint32_t>(side / sides_of_cell_); }
  /// The same facet seen from the other cell; no_cell on the boundary.
  std::uint32_t opposite(std::size_t side) const { return opposite_[side]; }
  std::uint32_t neighbour(std::size_t side) const {
    return opposite_[side] == no_cell ? no_cell : cell_of(opposite_[side]);
  }
  /// The points of a side, counterclockwise seen from outside: numbers as in point().
  const std::vector<std::uint32_t>& loop(std::size_t side) const { return loops_[side]; }
  std::size_t point_count() const { return point_count_; }
  /// A corner of cells, in cells.
  std::array<int, D> point(std::size_t number) const;
  /// The greatest whole numbers below the families inside of a cell.
  const std::array<std::int8_t, most_families>& floors(std::uint32_t cell) const { return floors_[cell]; }

  bool is_solid(std::uint32_t cell) const { return solid_[cell]; }
  bool is_wall(std::size_t side) const { return sides_[side].beyond == no_cell; }
  void make_solid(std::uint32_t cell);
  void make_wall(std::size_t side);

  /// The dimension of the lowest cell of the lattice that holds the points at which these families, a bit
  /// each, are whole.
  int dimension(unsigned whole) const { return dimensions_[whole]; }

 private:
  void add_cells();
  void add_side(const std::vector<unsigned>& corners, const std::array<int, D>& cube);
  void pair_sides();
  void find_planes();

  const std::array<int, D> size_;
  const Cut cut_;
  const std::size_t sides_of_cell_;
  std::size_t point_count_ = 1;
  std::vector<Family> families_;
  std::vector<std::array<std::int8_t, most_families>> floors_;
  std::vector<Side> sides_;
  std::vector<std::uint32_t> opposite_;
  std::vector<std::vector<std::uint32_t>> loops_;
  std::vector<std::uint8_t> solid_;
  std::array<std::uint8_t, 1u << most_families> dimensions_{};
};

extern template class Lattice<2>;
extern template class Lattice<3>;

}  // namespace cellwalk::endurance

#endif  // CELLWALK_EXPERIMENTS_ENDURANCE_LATTICE_H
