// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions in one world, judged one by one.
#ifndef CELLWALK_EXPERIMENTS_ENDURANCE_TRIAL_H
#define CELLWALK_EXPERIMENTS_ENDURANCE_TRIAL_H

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "world.h"

namespace cellwalk::endurance {

/// From where to where motions lead.
enum class Grid {
  coarse,  ///< multiples of a cell, of a half or a quarter: all in one run
  mixed,   ///< all bits, and such multiples; through such points, in planes of facets, parallel to them
  fine     ///< anywhere: all bits
};
inline constexpr std::array<const char*, 3> grid_names{"coarse", "mixed", "fine"};

/// A sort of worlds and motions, which has a row of the table.
struct Population {
  int dimension = 2;
  Cut cut = Cut::cubes;
  Grid grid = Grid::coarse;

  /// Of so many worlds together: more than half of all motions shall be degenerate.
  std::uint64_t share() const { return grid == Grid::coarse ? 3 : 1; }
  std::string name() const {
    return std::to_string(dimension) + "D " + cut_names[static_cast<std::size_t>(cut)] + " " +
           grid_names[static_cast<std::size_t>(grid)];
  }
};
std::vector<Population> populations();

struct Tally {
  std::uint64_t motions = 0, degenerate = 0, blocked = 0;
  std::uint64_t by_edge = 0;  ///< blocked before the end that moves is
  std::uint64_t wrong = 0;

  void operator+=(const Tally& other) {
    motions += other.motions;
    degenerate += other.degenerate;
    blocked += other.blocked;
    by_edge += other.by_edge;
    wrong += other.wrong;
  }
};

/// One world of a population.
struct Trial {
  Population population;
  std::uint64_t seed = 0;
  std::uint64_t motions = 0;
  std::filesystem::path folder;  ///< receives the first wrong answer of each world
};

Tally judge_walks(const Trial& trial);
/// Complete sweeps of edges without a radius, among solid cells and among membranes, too; and with a radius.
Tally judge_sweeps(const Trial& trial);
Tally judge_membrane_sweeps(const Trial& trial);
Tally judge_thick_sweeps(const Trial& trial);

/// Sites of motions.
template <int D>
class Sites {
 public:
  /// \param bits of the units of a cell
  Sites(const Lattice<D>& lattice, Grid grid, int bits) : lattice_(lattice), grid_(grid), bits_(bits) {}

  /// A site in the box of the lattice, with which a run of motions begins.
  Site<D> begin(Draw& draw);
  /// Where a motion from there leads, mostly at most half a cell or a cell away along each axis, at times out
  /// of the box.
  Site<D> next(const Site<D>& from, Draw& draw);
  /// The same on the coarse grid, wherever it begins.
  Site<D> coarse_near(const Site<D>& from, Draw& draw) const;

 private:
  Whole unit() const { return Whole{1} << bits_; }
  Site<D> near(const Site<D>& from, Whole step, Draw& draw) const;
  Site<D> degenerate_near(const Site<D>& from, Draw& draw) const;

  const Lattice<D>& lattice_;
  const Grid grid_;
  const int bits_;
  Whole step_ = 1;  ///< of the run
};

/// Units of a cell are 2^bits: on the coarse grid, and on others. Walks then have coordinates of up to 52
/// bits in space; the judge of sweeps multiplies four coordinates in 128 bits, that of thick ones more in
/// 113.
constexpr int coarse_bits = 3, walk_bits = 40, sweep_bits = 24, thick_bits = 16;
constexpr int bits_of(Grid grid, int fine_bits) { return grid == Grid::coarse ? coarse_bits : fine_bits; }
/// Of all sites, off the origin, in cells.
constexpr int reach_in_cells = 10;
/// Of a particle or an edge; then another one begins.
constexpr int moves_of_run = 24;

/// A lattice with walls and at least one free cell.
template <int D>
Lattice<D> random_lattice(Cut cut, Walls walls, Draw& draw);

extern template class Sites<2>;
extern template class Sites<3>;

}  // namespace cellwalk::endurance

#endif  // CELLWALK_EXPERIMENTS_ENDURANCE_TRIAL_H
