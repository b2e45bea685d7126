// SPDX-License-Identifier: LGPL-3.0-or-later
// The sides of new walls on which the vertices and edges of a body can be together. Theory: docs/cutting.md.
#ifndef CELLWALK_RESHAPE_TOGGLE_SIDE_CHOICE_H
#define CELLWALK_RESHAPE_TOGGLE_SIDE_CHOICE_H

#include <cellwalk/internal/edge/closing.h>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "reshape/residents/resident_groups.h"

namespace cellwalk::detail {

/// Of one group. First all is added that may have to change, then complete() and find_holders(), then
/// choose().
template <int D>
class Side_choice {
 public:
  /// \param left cells in which nothing may be, ascending; facets between them and others are closed
  Side_choice(const Snapshot<D>& snapshot, Resident_groups<D>& groups, std::uint32_t group,
              const Closing& closing, std::span<const Cell> left, Walk_counts& counts)
      : snapshot_(snapshot),
        groups_(groups),
        group_(group),
        closing_(closing),
        left_(left),
        counts_(counts) {}

  void add_vertex(std::uint32_t vertex);
  void add_edge(std::uint32_t edge);
  /// A face of an edge that was added extends from it towards a point.
  void add_tip(std::uint32_t edge, const Point<D>& tip);
  /// Adds the edges of all vertices that may change their side, and so on.
  void complete();
  /// Appends the vertices and edges that can be on no side, whatever others do.
  /// \param all_edges also those of which an end can be on none
  void find_holders(std::vector<Resident>& held_by, bool all_edges);

  /// In one of these closed facets an edge that was added must be on the side of its cell; until
  /// forget_demands().
  void demand(std::uint32_t edge, Half_facet at);
  void forget_demands();
  /// Finds sides for all. False if there are none, or after a limit of tries.
  bool choose();
  /// An edge that was without a side when the last choice failed.
  std::uint32_t failed() const { return failed_; }

  // As chosen.
  const Particle<D>& particle(std::uint32_t vertex) const;
  const Chain& chain(std::uint32_t edge);
  /// Before commit(), since it takes memory. If no commit() follows, it does no harm.
  /// \pre all is still as it was
  void prepare();
  void commit() noexcept;

 private:
  static constexpr int most_tries = 256;
  struct Vertex {
    std::vector<Particle<D>> sides;
    std::vector<bool> may_be;  ///< on that side, as far as is known
  };
  struct Edge {
    std::vector<Point<D>> tips;
    std::vector<Half_facet> at;
    std::map<std::pair<std::size_t, std::size_t>, std::optional<Chain>> chains;  ///< by sides of its ends
  };
  using Vertices = std::map<std::uint32_t, Vertex>;

  using Side_order = std::pair<bool, std::vector<Point<D>>>;
  Side_order order_of(const Particle<D>& side) const;
  bool may_change(std::uint32_t vertex) const;
  const std::optional<Chain>& chain_between(std::uint32_t edge, std::size_t of_u, std::size_t of_v);
  bool narrow();
  bool solve();
  static std::size_t chosen(const Vertex& vertex);

  const Snapshot<D>& snapshot_;
  Resident_groups<D>& groups_;
  std::uint32_t group_;
  const Closing& closing_;
  std::span<const Cell> left_;
  Walk_counts& counts_;
  Vertices vertices_;
  std::map<std::uint32_t, Edge> edges_;
  // Vertices and edges that are registered anew:
  std::vector<std::pair<std::uint32_t, Particle<D>>> moved_;
  std::vector<std::pair<std::uint32_t, Chain>> chains_;
  std::uint32_t failed_ = 0;
  int tries_ = 0;
};

extern template class Side_choice<2>;
extern template class Side_choice<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_TOGGLE_SIDE_CHOICE_H
