// SPDX-License-Identifier: LGPL-3.0-or-later
#include "find_rests.h"

#include <algorithm>
#include <vector>

#include "chain_side.h"

namespace cellwalk::detail {
namespace {

/// A wall that overlaps the face in its plane.
struct Patch {
  Half_facet wall;  ///< one of its sides
  int cell_side;    ///< side of the face on which the cell of that lies
  std::size_t group;
};

/// A ridge in the plane of the face that overlaps its inside.
struct Ridge {
  std::uint32_t u, v;
  bool is_above = false, is_below = false;  ///< walls stand on it there
  Half_facet wall;                          ///< one of them, or of the patches at it
  std::vector<std::size_t> patches;
};

/// Walls of one side: connected patches.
struct Group {
  bool may_be_above = true, may_be_below = true;  ///< as far as walls at its ridges say
  int side = 0;                                   ///< chosen: above > 0
};

class Rests {
 public:
  Rests(const Snapshot<3>& snapshot, const Triangle_in_plane& triangle, const Near_walls& near)
      : snapshot_(snapshot), triangle_(triangle), near_(near) {
    for (const Half_facet wall : near.walls) add(wall);
    groups_.resize(patches_.size());
    for (const Ridge& ridge : ridges_) join(ridge);
    for (const Ridge& ridge : ridges_) bound(ridge);
  }

  Face_registration choose(const std::array<Face_side, 3>& sides, const Face_rests& known) {
    for (const Face_side& side : sides) follow(side);
    for (const Half_facet rest : known) {
      for (const Patch& patch : patches_) {
        if (rest == patch.wall) settle(patch, patch.cell_side);
        if (rest == snapshot_.opposite(patch.wall)) settle(patch, -patch.cell_side);
      }
    }
    for (const Patch& patch : patches_) {
      const bool is_found = has_found(patch.wall), is_other_found = has_found(snapshot_.opposite(patch.wall));
      if (is_found != is_other_found) settle(patch, is_found ? patch.cell_side : -patch.cell_side);
    }
    for (const Patch& patch : patches_) settle(patch, first_side(patch));
    Face_registration result;
    result.piercing = piercing_;
    for (const Patch& patch : patches_)
      result.rests.push_back(groups_[patch.group].side == patch.cell_side ? patch.wall
                                                                          : snapshot_.opposite(patch.wall));
    sort(result.rests);
    return result;
  }

 private:
  Cell_view<3> view(Half_facet f) const { return snapshot_.view(snapshot_.cell_of(f)); }

  void add(Half_facet wall) {
    const Cell_view<3> cell = view(wall);
    const std::size_t i = snapshot_.facet_of(wall);
    const bool in_plane = triangle_.holds(cell, i);
    if (in_plane) {
      if (!triangle_.overlaps(cell, i)) return;
      patches_.push_back({wall, triangle_.side_of_cell(cell, i), patches_.size()});
    }
    const auto loop = cell.loop(i);
    std::vector<int> heights;
    for (const std::uint16_t v : loop) heights.push_back(triangle_.side(cell.point(v)));
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::size_t next = k + 1 == loop.size() ? 0 : k + 1;
      if (heights[k] != 0 || heights[next] != 0) continue;
      if (!triangle_.overlaps(cell.point(loop[k]), cell.point(loop[next]))) continue;
      Ridge& ridge = ridge_of(cell.point_index(loop[k]), cell.point_index(loop[next]), wall);
      if (in_plane) ridge.patches.push_back(patches_.size() - 1);
      // A wall that is not in the plane and has a ridge there lies on one side.
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

  void join(const Ridge& ridge) {
    for (const std::size_t other : ridge.patches) {
      const std::size_t from = patches_[other].group, to = patches_[ridge.patches.front()].group;
      for (Patch& patch : patches_)
        if (patch.group == from) patch.group = to;
    }
  }

  void bound(const Ridge& ridge) {
    if (ridge.is_above && ridge.is_below) piercing_ = ridge.wall;
    for (const std::size_t k : ridge.patches) {
      Group& group = groups_[patches_[k].group];
      group.may_be_above &= !ridge.is_above;
      group.may_be_below &= !ridge.is_below;
      if (!group.may_be_above && !group.may_be_below) piercing_ = ridge.wall;
    }
  }

  /// Takes a side unless another one was taken, or walls forbid it.
  void settle(const Patch& patch, int side) {
    Group& group = groups_[patch.group];
    if (group.side == 0 && (side > 0 ? group.may_be_above : group.may_be_below)) group.side = side;
  }

  /// Takes the sides on which the chain of an edge passes; if that is not possible, the face is pierced.
  void follow(const Face_side& side) {
    const Exact_edge edge(snapshot_, side.from, side.to);
    for (const Patch& patch : patches_) {
      const auto passed = passed_side(edge, side.start, *side.chain.chain, patch.wall);
      if (!passed) continue;
      const int passed_on = *passed == patch.wall ? patch.cell_side : -patch.cell_side;
      settle(patch, passed_on);
      if (groups_[patch.group].side != passed_on) piercing_ = patch.wall;
    }
  }

  bool has_found(Half_facet f) const {
    return f != Half_facet::none && near_.cells.contains(snapshot_.cell_of(f));
  }

  /// The side to take where any will do: that of the cell with the lower number; where walls leave one only, that.
  int first_side(const Patch& patch) const {
    const Group& group = groups_[patch.group];
    if (!group.may_be_above) return -1;
    if (!group.may_be_below) return 1;
    return snapshot_.opposite(patch.wall) < patch.wall ? -patch.cell_side : patch.cell_side;
  }

  const Snapshot<3>& snapshot_;
  const Triangle_in_plane& triangle_;
  const Near_walls& near_;
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

void sort(Face_rests& rests) { std::sort(rests.begin(), rests.end()); }

std::array<Face_side, 3> sides_of(const Face_chains& chains, const Particle<3>& p, const Particle<3>& q,
                                  const Particle<3>& r) {
  return {side_of(chains.pq, p, q), side_of(chains.qr, q, r), side_of(chains.rp, r, p)};
}

Face_registration find_rests(const Snapshot<3>& snapshot, const Triangle_in_plane& triangle,
                             const std::array<Face_side, 3>& sides, const Near_walls& near,
                             const Face_rests& known) {
  return Rests(snapshot, triangle, near).choose(sides, known);
}

}  // namespace cellwalk::detail
