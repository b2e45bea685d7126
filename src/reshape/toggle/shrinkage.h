// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether facets may become walls among residents, and how these are registered then. Theory:
// docs/cutting.md.
#ifndef CELLWALK_RESHAPE_TOGGLE_SHRINKAGE_H
#define CELLWALK_RESHAPE_TOGGLE_SHRINKAGE_H

#include <cellwalk/internal/edge/closing.h>
#include <cellwalk/internal/edge/closing_face.h>
#include <cellwalk/internal/environment/wall_editor.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "reshape/residents/resident_groups.h"
#include "side_choice.h"

namespace cellwalk::detail {

/// One change: a facet that is closed, a cell that is filled, or cells that must be vacated, where it can be
/// in others as well.
template <int D>
class Shrinkage {
 public:
  /// \param closed a passable facet, seen from either side
  Shrinkage(Wall_editor<D>& editor, Resident_groups<D>& groups, Half_facet closed, Walk_counts& counts);
  /// \param filled a free cell
  Shrinkage(Wall_editor<D>& editor, Resident_groups<D>& groups, Cell filled, Walk_counts& counts);
  /// \param left free cells that everything but faces is first moved out of; nothing else changes
  Shrinkage(Wall_editor<D>& editor, Resident_groups<D>& groups, std::span<const Cell> left,
            Walk_counts& counts);
  Shrinkage(const Shrinkage&) = delete;
  Shrinkage& operator=(const Shrinkage&) = delete;

  /// Finds the residents that forbid the change, sorted. Nothing is changed, but that groups near are opened.
  std::vector<Resident> holders();
  /// True if holders() found some that would only be nearer to new walls than their radius.
  bool is_too_near() const { return is_too_near_; }
  /// The least distance of those from new walls, rounded down.
  double distance() const { return distance_; }
  /// Makes the change, and registers the residents near. An error leaves all as it was.
  /// \pre holders() found none
  void make();

 private:
  /// A face near, whose corners are not collinear.
  struct Near_face {
    std::uint32_t number;
    std::array<Point<D>, 3> corners;
  };
  struct Group {
    std::uint32_t number;
    Side_choice<D> choice;
    std::vector<std::pair<std::uint32_t, Supporting_walls>> rests;
  };
  /// Edges along new walls, and points towards which faces extend from them.
  using Tips = std::vector<std::pair<std::uint32_t, Point<D>>>;
  bool is_filled(Cell c) const { return std::binary_search(filled_.begin(), filled_.end(), c); }
  bool touches(std::uint32_t group, std::uint32_t edge, bool& is_parted) const;
  bool is_near(const std::array<Point<D>, 3>& corners) const;
  void find_near_faces(std::uint32_t group);
  bool is_parted(std::uint32_t group, const Near_face& face);
  void add_sides(std::uint32_t group, const Near_face& face, Side_choice<D>& choice, Tips& tips) const;
  std::vector<Resident> who_failed(std::uint32_t group, std::uint32_t edge, const Tips& tips) const;
  void demand(std::uint32_t group, std::size_t choice, Side_choice<D>& of_group) const;
  void try_group(std::uint32_t group);
  bool stand(std::uint32_t group, Group& of_group, std::uint32_t& failed);
  enum class Aim : std::uint8_t { close, fill, leave };
  void find_box();
  void hold(const Thick_member<D>& member, double distance);
  void find_thick_holders();

  Wall_editor<D>& editor_;
  const Snapshot<D>& snapshot_;
  Resident_groups<D>& groups_;
  Aim aim_;
  std::vector<Cell> filled_;       ///< or left; ascending
  std::vector<Half_facet> walls_;  ///< each seen from one side: of cells to be filled, from there
  Walk_counts& counts_;
  std::vector<Half_facet> both_sides_;
  Closing closing_;
  Box<D> box_;
  std::vector<Member> vertices_, edges_;
  std::vector<Near_face> faces_;                                ///< of the group that is tried
  std::vector<std::pair<std::uint32_t, Half_facet>> in_plane_;  ///< of these, with the wall that they overlap
  std::vector<Group> free_;                                     ///< with their registration after the change
  std::vector<Resident> held_by_;
  bool is_too_near_ = false;
  double distance_ = std::numeric_limits<double>::infinity();
};

extern template class Shrinkage<2>;
extern template class Shrinkage<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_TOGGLE_SHRINKAGE_H
