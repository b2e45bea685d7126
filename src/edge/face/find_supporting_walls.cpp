// SPDX-License-Identifier: LGPL-3.0-or-later
#include "find_supporting_walls.h"

#include <algorithm>
#include <vector>

#include "edge/chain/chain_side.h"

namespace cellwalk::detail {
namespace {

/// A side of a wall that overlaps in its plane what the face swept, with free space on it.
struct Patch {
  Half_facet half;
  int side;  ///< of the face, on which its cell lies
  std::size_t group;
  bool is_second;  ///< the other side of the wall of the patch before it
  /// Patches on the other side of the plane that overlap this one inside the face: the second side of the
  /// wall; for a one-sided wall those that coincide with it, or none.
  boost::container::small_vector<std::size_t, 2> behind{};
};

/// A ridge in the plane of the face that overlaps the interior of what it swept.
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
};

class Supporting_wall_search {
 public:
  Supporting_wall_search(const Snapshot<3>& snapshot, const Triangle_in_plane& triangle,
                         const Swept_in_plane& swept, const Candidate_walls& candidates)
      : snapshot_(snapshot), triangle_(triangle), swept_(swept) {
    for (const Half_facet wall : candidates.walls) add(wall);
    pair_one_sided();
    groups_.resize(patches_.size());
    for (std::size_t k = 0; k < patches_.size(); ++k) join(patches_[k].behind, k);
    for (const Ridge& ridge : ridges_) join(ridge.patches, ridge.patches.empty() ? 0 : ridge.patches.front());
    for (const Patch& patch : patches_)
      if (patch.behind.empty()) groups_[patch.group].may_be(-patch.side) = false;  // no free space there
    for (const Ridge& ridge : ridges_) bound(ridge);
  }

  Face_registration choose(const std::array<Face_side, 3>& sides, const Supporting_walls& known, Known use) {
    if (use == Known::binding) keep(known);
    for (const Face_side& side : sides) follow(side);
    if (use == Known::preferred) keep(known);
    Face_registration result;
    result.piercing = piercing_;
    for (const Patch& patch : patches_)
      if (side_of(groups_[patch.group]) == patch.side && is_under_face(patch))
        result.supporting_walls.push_back(patch.half);
    sort(result.supporting_walls);
    return result;
  }

 private:
  Cell_view<3> view(Half_facet f) const { return snapshot_.view(snapshot_.cell_of(f)); }

  /// True if two sets have points in common inside of what the face swept; one set, with that.
  template <class... Sets>
  bool overlap(const Sets&... sets) const {
    return std::any_of(swept_.begin(), swept_.end(),
                       [&](const Triangle_in_plane& part) { return part.overlaps(sets...); });
  }
  bool is_under_face(const Patch& patch) const {
    return triangle_.overlaps(view(patch.half), snapshot_.facet_of(patch.half));
  }

  void add(Half_facet wall) {
    const Cell_view<3> cell = view(wall);
    const std::size_t i = snapshot_.facet_of(wall);
    const bool in_plane = triangle_.holds(cell, i);
    const std::size_t first = patches_.size();
    if (in_plane) {
      if (!overlap(cell, i)) return;
      const int side = triangle_.side_of_cell(cell, i);
      patches_.push_back({wall, side, first, false});
      const Half_facet other = snapshot_.opposite(wall);
      if (other != Half_facet::none && !snapshot_.is_solid(snapshot_.cell_of(other))) {
        patches_.push_back({other, -side, first + 1, true, {first}});
        patches_[first].behind.push_back(first + 1);
      }
    }
    const auto loop = cell.loop(i);
    std::vector<int> heights;
    for (const std::uint16_t v : loop) heights.push_back(triangle_.side(cell.point(v)));
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::size_t next = k + 1 == loop.size() ? 0 : k + 1;
      if (heights[k] != 0 || heights[next] != 0) continue;
      if (!overlap(cell.point(loop[k]), cell.point(loop[next]))) continue;
      Ridge& ridge = ridge_of(cell.point_index(loop[k]), cell.point_index(loop[next]), wall);
      if (in_plane) ridge.patches.push_back(first);
      // A wall out of the plane with a ridge in it lies on one side.
      ridge.is_above |= std::any_of(heights.begin(), heights.end(), [](int h) { return h > 0; });
      ridge.is_below |= std::any_of(heights.begin(), heights.end(), [](int h) { return h < 0; });
    }
  }

  Ridge& ridge_of(std::uint32_t u, std::uint32_t v, Half_facet wall) {
    for (Ridge& ridge : ridges_)
      if ((ridge.u == u && ridge.v == v) || (ridge.u == v && ridge.v == u)) return ridge;
    ridges_.push_back({u, v, false, false, wall, {}});
    return ridges_.back();
  }

  /// Pairs one-sided walls, which may coincide without being glued.
  void pair_one_sided() {
    std::vector<std::size_t> above, below;
    for (std::size_t k = 0; k < patches_.size(); ++k)
      if (patches_[k].behind.empty()) (patches_[k].side > 0 ? above : below).push_back(k);
    for (const std::size_t k : above) {
      for (const std::size_t m : below) {
        const Half_facet f = patches_[k].half, g = patches_[m].half;
        if (!overlap(view(f), snapshot_.facet_of(f), view(g), snapshot_.facet_of(g))) continue;
        patches_[k].behind.push_back(m);
        patches_[m].behind.push_back(k);
      }
    }
  }

  template <class Patches>
  void join(const Patches& others, std::size_t with) {
    for (const std::size_t other : others) {
      const std::size_t from = patches_[other].group, to = patches_[with].group;
      if (from == to) continue;
      for (Patch& patch : patches_)
        if (patch.group == from) patch.group = to;
    }
  }

  void bound(const Ridge& ridge) {
    if (ridge.is_above && ridge.is_below) piercing_ = ridge.wall;
    for (const std::size_t k : ridge.patches) {
      Group& group = groups_[patches_[k].group];
      group.may_be(1) &= !ridge.is_above;
      group.may_be(-1) &= !ridge.is_below;
      if (!group.may_be(1) && !group.may_be(-1)) piercing_ = ridge.wall;
    }
  }

  /// Puts the face on the side of a patch. It is pierced if it lies on the other side too, or if walls
  /// exclude the side.
  void take(const Patch& patch) {
    Group& group = groups_[patch.group];
    if (group.side == 0 && group.may_be(patch.side)) group.side = patch.side;
    if (group.side == patch.side || piercing_ != Half_facet::none) return;
    piercing_ = patch.behind.empty() ? patch.half : patches_[patch.behind.front()].half;
  }

  void keep(const Supporting_walls& known) {
    for (const Half_facet supporting_wall : known)
      for (const Patch& patch : patches_)
        if (supporting_wall == patch.half) take(patch);
  }

  /// Chooses the sides on which the chain of an edge passes.
  void follow(const Face_side& side) {
    if (side.from == side.to) return;
    const Exact_edge edge(snapshot_, side.from, side.to);
    std::optional<Fraction> t;  // where the edge meets the wall
    std::vector<Cell> linked;
    const auto is_linked = [&](const Patch& patch) {
      return std::find(linked.begin(), linked.end(), snapshot_.cell_of(patch.half)) != linked.end();
    };
    for (const Patch& patch : patches_) {
      if (!patch.is_second) {
        const std::optional<Span> met = edge.in_facet(patch.half);
        t.reset();
        if (!met) continue;
        t = middle(met->low, met->high);
        linked = linked_cells(edge, side.start, *side.chain.chain, *t);
      }
      if (!t || !is_linked(patch)) continue;
      // Around the rim of a wall, the edge is linked with both sides.
      const bool is_round = std::any_of(patch.behind.begin(), patch.behind.end(), [&](std::size_t k) {
        return is_linked(patches_[k]) && holds(edge, patches_[k], *t);
      });
      if (!is_round) take(patch);
    }
  }

  static bool holds(const Exact_edge& edge, const Patch& patch, const Fraction& t) {
    const std::optional<Span> met = edge.in_facet(patch.half);
    return met && met->low <= t && t <= met->high;
  }

  /// The side of a group; if nothing determines it, the fixed side, as far as walls allow.
  int side_of(Group& group) const {
    const int fixed = triangle_.fixed_side();
    return group.side != 0 ? group.side : group.may_be(fixed) ? fixed : -fixed;
  }

  const Snapshot<3>& snapshot_;
  const Triangle_in_plane& triangle_;  ///< the face
  const Swept_in_plane& swept_;
  std::vector<Patch> patches_;
  std::vector<Ridge> ridges_;
  std::vector<Group> groups_;
  Half_facet piercing_ = Half_facet::none;
};

Face_side side_of(const Side_chain& chain, const Particle<3>& first, const Particle<3>& second) {
  if (chain.is_reversed) return {chain, second.position, first.position, second.cell};
  return {chain, first.position, second.position, first.cell};
}

}  // namespace

void sort(Supporting_walls& supporting_walls) { std::sort(supporting_walls.begin(), supporting_walls.end()); }

std::array<Face_side, 3> sides_of(const Face_chains& chains, const Particle<3>& p, const Particle<3>& q,
                                  const Particle<3>& r) {
  return {side_of(chains.pq, p, q), side_of(chains.qr, q, r), side_of(chains.rp, r, p)};
}

Swept_in_plane swept_in_plane(const Corners& corners, Walk_counts& counts) {
  Swept_in_plane triangles;
  // All triangles of the points: those on either side of one diagonal do not see what lies along it.
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    std::array<Point<3>, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = corners[k + (k >= left_out)];
    if (!are_collinear(triangle[0], triangle[1], triangle[2])) triangles.emplace_back(triangle, counts);
  }
  return triangles;
}

Face_registration find_supporting_walls(const Snapshot<3>& snapshot, const Triangle_in_plane& triangle,
                                        const Swept_in_plane& swept, const std::array<Face_side, 3>& sides,
                                        const Candidate_walls& candidates, const Supporting_walls& known,
                                        Known use) {
  return Supporting_wall_search(snapshot, triangle, swept, candidates).choose(sides, known, use);
}

}  // namespace cellwalk::detail
