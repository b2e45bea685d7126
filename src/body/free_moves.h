// SPDX-License-Identifier: LGPL-3.0-or-later
// The moves of a step that known regions prove free, whatever becomes of the others: they are made at once,
// on several threads. Theory: docs/bodies.md, several threads.
#ifndef CELLWALK_BODY_FREE_MOVES_H
#define CELLWALK_BODY_FREE_MOVES_H

#include <cellwalk/body/step.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "body_topology.h"
#include "region_cache.h"
#include "region_pool.h"

namespace cellwalk::detail {

/// The parts of a body that such a move changes or reads.
template <int D>
struct Movable {
  std::vector<Point<D>>& positions;
  const Body_topology& topology;
  Region_cache<D>& region;
  Region_pool<D>& pool;
};

template <int D>
class Free_moves {
 public:
  Free_moves(std::size_t vertices, const Body_certificates& certificates);

  /// True if the body is one that makes such moves.
  bool is_used() const { return !left_.empty(); }
  /// Makes the moves of all plain vertices; the rest are left to be made one by one, in order. Which are left
  /// does not depend on the number of threads.
  /// \param is_supported bit by bit, the vertices of faces that rest on walls: they are left
  /// \pre is_used(); regions are used in this step
  /// Returns how many were made.
  std::size_t make(const Movable<D>& body, std::span<const Point<D>> targets,
                   std::span<const std::uint64_t> is_supported, bool parallel);
  /// Leaves all.
  void make_none();

  /// The first vertex from a given one on whose move is left; where there is none, the number of vertices.
  std::uint32_t next_left(std::uint32_t vertex) const { return left_.empty() ? vertex : find_left(vertex); }
  /// Takes back the moves of the neighbours that come after a vertex, and leaves them: to be called before
  /// the vertex is tested. Returns how many there were.
  std::size_t take_back_after(const Movable<D>& body, std::uint32_t vertex);

 private:
  static constexpr std::size_t bits = 64;
  std::size_t word_count() const { return left_.size(); }
  /// Vertices of a word.
  std::size_t begin(std::size_t word) const { return bits * word; }
  std::size_t end(std::size_t word) const { return std::min(bits * (word + 1), vertices_); }
  /// The vertex of the lowest bit of a word.
  static std::uint32_t first_of(std::size_t word, std::uint64_t set) {
    return static_cast<std::uint32_t>(bits * word) + static_cast<std::uint32_t>(std::countr_zero(set));
  }
  static bool has(std::span<const std::uint64_t> set, std::uint32_t vertex) {
    return (set[vertex / bits] >> vertex % bits & 1) != 0;
  }

  std::uint32_t find_left(std::uint32_t vertex) const;
  void find_plain(const Movable<D>& body, std::span<const Point<D>> targets,
                  std::span<const std::uint64_t> is_supported, std::size_t word);
  bool are_in_body_region(const Movable<D>& body, std::span<const Point<D>> targets, std::size_t word) const;
  void make(const Movable<D>& body, std::span<const Point<D>> targets, std::size_t word);

  std::size_t vertices_;
  std::vector<std::uint64_t> left_;          ///< bit by bit, the moves that are left
  std::vector<std::uint64_t> is_reordered_;  ///< those made in another region than that known first
  std::vector<std::uint8_t> chosen_;         ///< the number of that region
  std::vector<Point<D>> before_;             ///< positions before the step
};

extern template class Free_moves<2>;
extern template class Free_moves<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_FREE_MOVES_H
