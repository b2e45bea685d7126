// SPDX-License-Identifier: LGPL-3.0-or-later
// The residents of cells that are replaced by others over the same region. Theory: docs/cutting.md, replacing
// cells.
#ifndef CELLWALK_RESHAPE_REPLACE_RELINKER_H
#define CELLWALK_RESHAPE_REPLACE_RELINKER_H

#include <cellwalk/edge/chain.h>

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "reshape/residents/resident_groups.h"

namespace cellwalk::detail {

/// First note(), then the cells are replaced, then relink(). Kept for its memory.
template <int D>
class Relinker {
 public:
  Relinker(Resident_groups<D>& groups, const Snapshot<D>& snapshot, Walk_counts& counts)
      : groups_(groups), snapshot_(snapshot), counts_(counts) {}

  /// Notes the residents of cells that will be replaced.
  /// \pre they are simplices, all facets between them are passable, and the groups near them are open
  void note(std::span<const Cell> removed);
  /// True if a face that is kept rests on their walls.
  bool has_rests() const;
  /// Registers it in the cells that have replaced them. Returns the number of chains that are new.
  /// \throw Error(other) if something has no place there
  std::size_t relink(std::span<const Cell> added);

 private:
  using Points = std::array<std::uint32_t, static_cast<std::size_t>(D)>;
  /// A side of a facet of a removed cell.
  struct Side {
    Half_facet old;
    bool is_inner;       ///< between two of them
    Half_facet outside;  ///< the other side, in a cell that stays; Half_facet::none on the boundary
    Points points;       ///< on the boundary
    Half_facet now = Half_facet::none;
  };
  struct Moved {
    Member member;
    Particle<D> now;
  };
  Points points_of(Half_facet f) const;
  const Side* find(Half_facet old) const;
  const Moved* find(Member vertex) const;
  void name_sides(std::span<const Cell> added);
  Particle<D> placed(const Particle<D>& p, std::span<const Cell> added) const;
  bool renames(Member edge) const;
  void write_chain(Member edge, std::span<const Cell> sorted, Chain& chain) const;

  Resident_groups<D>& groups_;
  const Snapshot<D>& snapshot_;
  Walk_counts& counts_;
  std::vector<Cell> removed_;  ///< ascending
  std::vector<Side> sides_;    ///< by the old name
  std::vector<Member> vertices_, edges_, faces_;
  std::vector<Moved> moved_;
  std::vector<std::pair<Member, Chain>> chains_;
};

extern template class Relinker<2>;
extern template class Relinker<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_REPLACE_RELINKER_H
