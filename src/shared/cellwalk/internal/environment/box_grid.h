// SPDX-License-Identifier: LGPL-3.0-or-later
// Boxes that move little by little, found by place.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_BOX_GRID_H
#define CELLWALK_INTERNAL_ENVIRONMENT_BOX_GRID_H

#include <cellwalk/internal/kernel/box.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cellwalk::detail {

/// Numbered boxes in grids of cubes whose sizes are powers of four. Each box is entered in the smallest cubes
/// that are as large as it is, in that one which has its lowest corner. So boxes that meet a query are
/// entered in the cubes from its lowest corner, less one cube, to its highest.
template <int D>
class Box_grid {
 public:
  /// Enters a box, or changes it.
  /// Cost: constant, and nothing but the box is written if it stays in its cube.
  void set(std::uint32_t number, const Box<D>& box);
  /// \pre there is such a box
  void remove(std::uint32_t number);
  const Box<D>& box(std::uint32_t number) const { return boxes_[number]; }

  /// Appends the numbers of the boxes that meet a box, in any order.
  /// Cost: some 30 to 60 cubes for each size of boxes near the size of the query; at most all boxes.
  void find(const Box<D>& box, std::vector<std::uint32_t>& numbers) const;

 private:
  static constexpr std::uint32_t none = 0xffffffffu;
  struct Cube {
    int level = 0;
    std::array<std::int64_t, static_cast<std::size_t>(D)> at{};
    /// The same for equal cubes, and hardly ever for others.
    std::uint64_t key() const;
  };
  struct Item {
    std::uint64_t key = 0;                       ///< of its cube
    std::uint32_t next = none, previous = none;  ///< in the chain of its bucket
    std::int16_t level = unused;                 ///< of its cube
  };
  static constexpr std::int16_t unused = 2000;

  static Cube cube_of(const Box<D>& box);
  std::size_t bucket(std::uint64_t key) const { return key & (first_.size() - 1); }
  void link(std::uint32_t number);
  void unlink(std::uint32_t number);
  void count(int level, int change);

  std::vector<Box<D>> boxes_;
  std::vector<Item> items_;
  std::vector<std::uint32_t> first_;         ///< of each bucket; a power of two of them
  std::vector<std::pair<int, int>> levels_;  ///< those in use, and how many boxes each has
  std::size_t used_ = 0;
};

extern template class Box_grid<2>;
extern template class Box_grid<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_BOX_GRID_H
