// SPDX-License-Identifier: LGPL-3.0-or-later
// The grouping and cutting of the cubes of a lattice world.
#ifndef CELLWALK_GENERATORS_LATTICE_PARTITION_H
#define CELLWALK_GENERATORS_LATTICE_PARTITION_H

#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/kernel/random.h>

#include <array>
#include <cstdint>
#include <vector>

namespace cellwalk::detail {

enum class Lattice_shape : std::uint8_t { box, simplices, prisms, star };

/// A box of cubes that becomes one cell, or a single cube that is cut.
template <int D>
struct Lattice_box {
  std::array<std::uint32_t, D> low, size;
  Lattice_shape shape;
  int axis;  ///< of prisms
};

template <int D>
struct Lattice_partition {
  std::array<std::uint32_t, D> cells;
  std::vector<Lattice_box<D>> boxes;  ///< in the order of their lowest cubes
  std::vector<std::uint32_t> box_of;  ///< per cube

  std::size_t cube(const std::array<std::uint32_t, D>& k) const {
    std::size_t index = 0;
    for (int a = D - 1; a >= 0; --a) index = index * cells[a] + k[a];
    return index;
  }
};

template <int D>
Lattice_partition<D> make_lattice_partition(const Lattice_world_options<D>& options);

/// Collects the cells of a lattice world. The name of a point is twice its lattice coordinates, so that
/// centres of cubes have integer names as well.
template <int D>
class Lattice_builder {
 public:
  using Name = std::array<std::uint32_t, D>;

  explicit Lattice_builder(const Lattice_world_options<D>& options);

  /// Starts a cell; false if it is to be omitted.
  bool begin_cell();
  void add_facet(const std::vector<Name>& loop);
  void end_cell();

  /// Returns the world, with its slits opened.
  Cell_soup<D> take();

 private:
  void draw_slits();
  bool is_in_slit(const std::vector<Name>& loop, std::uint64_t facet_hash) const;

  const Lattice_world_options<D>& options_;
  Cell_soup<D> soup_;
  std::vector<std::uint32_t> index_of_;  ///< per name, or no_index
  std::vector<std::uint32_t> loop_;
  Random random_;
  bool solid_ = false;
  /// Per axis and cube: the square on the low side of the cube lies in a slit.
  std::array<std::vector<std::uint8_t>, D> slit_squares_;
  std::vector<std::uint8_t> is_slit_;  ///< per half-facet of the soup
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_GENERATORS_LATTICE_PARTITION_H
