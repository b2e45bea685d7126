// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls in the plane of a motion, in groups that have the moving face or edge on one side. Theory:
// docs/sweep.md.
#ifndef CELLWALK_EDGE_FACE_SUPPORTING_WALL_SEARCH_H
#define CELLWALK_EDGE_FACE_SUPPORTING_WALL_SEARCH_H

#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "edge/chain/chain_side.h"
#include "find_supporting_walls.h"

namespace cellwalk::detail {

/// For each group of walls in a plane that overlap the area swept there by a face or an edge, finds the side
/// of them on which the face or edge is.
class Supporting_wall_search {
 public:
  /// \param triangle of the plane; where the face is in the end
  /// \param swept the area that it swept to come there
  /// These two and the environment outlive this.
  Supporting_wall_search(const Snapshot<3>& snapshot, const Triangle_in_plane& triangle,
                         const Swept_in_plane& swept, const Candidate_walls& candidates);

  /// Puts it on the side of a half-facet, if its wall belongs to a group. True if the group had no side yet.
  bool take(Half_facet half);
  /// Puts it on the sides of walls that are known to support it.
  void keep(const Supporting_walls& known) {
    for (const Half_facet half : known) take(half);
  }
  /// Puts it on the sides on which the chain of an edge passes.
  void follow(const Face_side& side);
  /// Gives the first group that may be on either side the fixed side. False if there is none.
  bool choose_next();

  /// A wall, if walls at one ridge, or the sides taken, leave no side. Seen from the side of the face if it
  /// is on one.
  Half_facet piercing() const { return piercing_; }
  /// The half-facets of walls on the sides that are determined.
  std::vector<Half_facet> taken() const;
  /// The half-facets of all walls whose cells are on a side of the plane.
  std::vector<Half_facet> halves_at(int side) const;
  /// Those that the face has under it in the end. Groups without a side get the fixed one, as far as walls
  /// allow.
  Supporting_walls under_face() const;

 private:
  /// A side of a wall that overlaps the area swept by the face in its plane, with free space on it.
  struct Patch {
    Half_facet half;
    int side;  ///< of the face, on which its cell lies
    std::size_t group;
    bool is_second;  ///< the other side of the wall of the patch before it
    /// Patches on the other side of the plane that overlap this one inside the face: the second side of the
    /// wall; for a one-sided wall those that coincide with it, or none.
    boost::container::small_vector<std::size_t, 2> behind{};
  };

  /// A ridge in the plane of the face that overlaps the interior of the area that it swept.
  struct Ridge {
    std::uint32_t u, v;
    bool is_above = false, is_below = false;  ///< walls at the ridge extend above or below the plane
    Half_facet wall;                          ///< one of these walls, or of the patches at the ridge
    std::vector<std::size_t> patches;
  };

  /// Patches for which the face lies on the same side of the plane: those behind each other, and those that
  /// share a ridge.
  struct Group {
    bool may_be_above = true, may_be_below = true;  ///< as far as walls allow
    int side = 0;                                   ///< chosen: > 0 above, < 0 below, 0 none yet

    bool& may_be(int at) { return at > 0 ? may_be_above : may_be_below; }
    bool may_be(int at) const { return at > 0 ? may_be_above : may_be_below; }
    /// The side if it is chosen, or the only one that walls allow; else 0.
    int determined() const {
      return side != 0 ? side : may_be_above == may_be_below ? 0 : may_be_above ? 1 : -1;
    }
  };

  Cell_view<3> view(Half_facet f) const { return snapshot_.view(snapshot_.cell_of(f)); }

  /// True if two sets have points in common inside the area that the face swept; one set, with the area
  /// itself.
  template <class... Sets>
  bool overlap(const Sets&... sets) const {
    return std::any_of(swept_.begin(), swept_.end(),
                       [&](const Triangle_in_plane& part) { return part.overlaps(sets...); });
  }
  void add(Half_facet wall);
  Ridge& ridge_of(std::uint32_t u, std::uint32_t v, Half_facet wall);
  /// Pairs one-sided walls, which may coincide without being glued.
  void pair_one_sided();
  template <class Patches>
  void join(const Patches& others, std::size_t with);
  void bound(const Ridge& ridge);
  std::vector<Fraction> ends_along(const Exact_edge& edge) const;
  /// Puts the face on the side of a patch. It is pierced if it lies on the other side too, or if walls
  /// exclude the side.
  void take(const Patch& patch);
  /// The side of a group; if nothing determines it, the fixed side, as far as walls allow.
  int side_of(const Group& group) const;

  const Snapshot<3>& snapshot_;
  const Triangle_in_plane& triangle_;  ///< the face
  const Swept_in_plane& swept_;
  const decltype(Candidate_walls::walls) walls_;  ///< all near
  std::vector<Patch> patches_;
  std::vector<Ridge> ridges_;
  std::vector<Group> groups_;
  Half_facet piercing_ = Half_facet::none;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_EDGE_FACE_SUPPORTING_WALL_SEARCH_H
