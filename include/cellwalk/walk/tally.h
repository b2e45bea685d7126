// SPDX-License-Identifier: LGPL-3.0-or-later
// Sums over many motions, by cell: track-length tallies.
#ifndef CELLWALK_WALK_TALLY_H
#define CELLWALK_WALK_TALLY_H

#include <cellwalk/kernel/point.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cellwalk {

/// A sum for each cell, in fixed point of 128 bits: it does not depend on the order of what is added, nor on
/// how that is divided among threads or ranks.
class Tally {
 public:
  /// \param cells their number
  /// \param largest a bound of the size of each value that is added, finite and positive
  /// \throw Error(usage) for another bound
  Tally(std::size_t cells, double largest);

  /// Adds a value to the sum of a cell; what lies below 2^-93 of the bound is rounded.
  /// \pre cell < size(), |value| <= largest; at most 2^32 values are added to a cell
  /// Cost: 4 ns.
  void add(std::size_t cell, double value);
  /// Adds the sums of another tally.
  /// \throw Error(usage) unless it has as many cells and the same bound
  void add(const Tally& other);

  std::size_t size() const { return sums_.size(); }
  /// The sum of a cell, rounded to nearest.
  double operator[](std::size_t cell) const;

  /// The sums, for another process, and their addition there.
  /// \pre the tally of the other process has as many cells and the same bound
  std::vector<std::uint64_t> words() const;
  void add_words(const std::vector<std::uint64_t>& words);

 private:
  __extension__ using Fixed = __int128;  // not of ISO C++
  std::vector<Fixed> sums_;
  double largest_;
  int unit_exponent_;  ///< of the last bit
};

}  // namespace cellwalk

#endif  // CELLWALK_WALK_TALLY_H
