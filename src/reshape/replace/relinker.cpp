// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells of particles and the runs of chains in replaced cells, found anew among the new ones.
#include "relinker.h"

#include <cellwalk/internal/edge/path_within_cells.h>
#include <cellwalk/internal/walk/certified_exit.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>

namespace cellwalk::detail {

template <int D>
typename Relinker<D>::Points Relinker<D>::points_of(Half_facet f) const {
  const Cell_view<D> cell = snapshot_.view(snapshot_.cell_of(f));
  const auto loop = cell.loop(snapshot_.facet_of(f));
  Points points;
  for (std::size_t k = 0; k < points.size(); ++k) points[k] = cell.point_index(loop[k]);
  return points;
}

template <int D>
const typename Relinker<D>::Side* Relinker<D>::find(Half_facet old) const {
  const auto side = std::ranges::lower_bound(sides_, old, {}, &Side::old);
  return side != sides_.end() && side->old == old ? &*side : nullptr;
}

template <int D>
const typename Relinker<D>::Moved* Relinker<D>::find(Member vertex) const {
  const auto moved = std::ranges::lower_bound(moved_, vertex, {}, &Moved::member);
  return moved != moved_.end() && moved->member == vertex ? &*moved : nullptr;
}

template <int D>
void Relinker<D>::note(std::span<const Cell> removed) {
  removed_.assign(removed.begin(), removed.end());
  std::sort(removed_.begin(), removed_.end());
  sides_.clear();
  faces_.clear();
  vertices_.clear();
  edges_.clear();
  if (!groups_.has_open()) return;
  groups_.find(removed_, vertices_, edges_);
  for (const Cell c : removed_)
    for (std::size_t i = 0; i < snapshot_.facet_count(c); ++i) {
      const Half_facet f = Snapshot<D>::half_facet(c, i);
      const bool is_inner = std::ranges::binary_search(removed_, snapshot_.neighbour(f));
      const Half_facet outside = is_inner ? Half_facet::none : snapshot_.opposite(f);
      const bool is_boundary = !is_inner && outside == Half_facet::none;
      sides_.push_back({f, is_inner, outside, is_boundary ? points_of(f) : Points{}});
    }
  if (D == 2) return;
  for (std::uint32_t g = 0; g < groups_.all().size(); ++g) {
    const Resident_group<D>& group = groups_.all()[g];
    if (!group.is_open || !group.body || !group.body->has_supporting_walls()) continue;
    for (std::uint32_t f = 0; f < group.faces.size(); ++f)
      if (std::ranges::any_of(group.body->supporting_walls(f), [&](Half_facet w) { return find(w); }))
        faces_.push_back({g, f});
  }
}

/// Facets to cells that stay, and those of the boundary, have new names.
template <int D>
void Relinker<D>::name_sides(std::span<const Cell> added) {
  for (Side& side : sides_) {
    if (side.is_inner) continue;
    if (side.outside != Half_facet::none) {
      side.now = snapshot_.opposite(side.outside);
      continue;
    }
    std::sort(side.points.begin(), side.points.end());
    for (const Cell c : added)
      for (std::size_t i = 0; i < snapshot_.facet_count(c); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(c, i);
        if (snapshot_.neighbour(f) != Cell::none) continue;
        Points points = points_of(f);
        std::sort(points.begin(), points.end());
        if (points == side.points) side.now = f;
      }
  }
}

template <int D>
Particle<D> Relinker<D>::placed(const Particle<D>& p, std::span<const Cell> added) const {
  Float_point<D> y{};
  const bool is_framed = snapshot_.frame().map(p.position, y);
  for (const Cell c : added) {
    if (is_framed) {
      const Block_sides sides = classify<D>(*snapshot_.blocks(c), y);
      if (sides.outside != 0) continue;
      if (sides.inside == 0xf) return {p.position, c, D, c == p.cell ? p.aimed : std::uint16_t{0}};
    }
    if (in_closure(snapshot_, c, p.position)) return particle_in(snapshot_, c, p, counts_);
  }
  throw Error(Error_code::other,
              "what stands in the environment lies in none of the cells that replaced its own: the "
              "environment is not certified, or it was not listed");
}

/// True for an edge whose chain passes a removed cell, or ends there.
template <int D>
bool Relinker<D>::renames(Member edge) const {
  const auto [u, v] = groups_.all()[edge.group].edges[edge.number];
  const Chain& chain = groups_.chain(edge);
  return find(Member{edge.group, u}) || find(Member{edge.group, v}) ||
         std::ranges::any_of(chain, [&](Half_facet f) { return find(f); });
}

/// The chain of an edge: each maximal run of removed cells becomes a way through the new ones, between the
/// same facets of their boundary.
template <int D>
void Relinker<D>::write_chain(Member edge, std::span<const Cell> sorted, Chain& chain) const {
  const auto [u, v] = groups_.all()[edge.group].edges[edge.number];
  const auto end_of = [&](std::uint32_t vertex) {
    const Member member{edge.group, vertex};
    const Moved* moved = find(member);
    return moved ? moved->now : groups_.particle(member);
  };
  const Particle<D> p = end_of(u), q = end_of(v);
  const Path_within_cells<D> way(snapshot_, sorted, counts_);
  Cell now = p.cell;
  const auto go_to = [&](Cell goal) {
    if (now != goal) way.append(chain, now, goal, p.position, q.position);
    now = goal;
  };
  for (const Half_facet f : groups_.chain(edge)) {
    const Side* side = find(f);
    if (side && side->is_inner) continue;
    if (side) go_to(snapshot_.cell_of(side->now));
    const Half_facet letter = side ? side->now : f;
    append_reduced(snapshot_, chain, letter);
    now = snapshot_.neighbour(letter);
  }
  go_to(q.cell);
}

template <int D>
bool Relinker<D>::has_rests() const {
  return std::ranges::any_of(faces_,
                             [&](Member face) { return groups_.all()[face.group].body->keeps_faces(); });
}

template <int D>
std::size_t Relinker<D>::relink(std::span<const Cell> added) {
  moved_.clear();
  chains_.clear();
  if (vertices_.empty() && edges_.empty() && faces_.empty()) {
    groups_.forget(removed_);
    return 0;
  }
  name_sides(added);
  std::vector<Cell> sorted(added.begin(), added.end());
  std::sort(sorted.begin(), sorted.end());
  for (const Member v : vertices_) {
    moved_.push_back({v, placed(groups_.particle(v), added)});
  }
  for (const Member e : edges_)
    if (renames(e)) {
      auto& [edge, chain] = chains_.emplace_back();
      edge = e;
      write_chain(e, sorted, chain);
    }
  std::vector<std::pair<Member, Supporting_walls>> rests;
  for (const Member face : faces_) {
    auto& [of, walls] =
        rests.emplace_back(face, groups_.all()[face.group].body->supporting_walls(face.number));
    for (Half_facet& w : walls)
      if (const Side* side = find(w)) w = side->now;
    // A face that is not swept may have left its walls, and they may be gone.
    walls.erase(std::remove(walls.begin(), walls.end(), Half_facet::none), walls.end());
    std::sort(walls.begin(), walls.end());
  }
  for (const auto& [edge, chain] : chains_) {
    const Member first{edge.group, groups_.all()[edge.group].edges[edge.number][0]};
    const Moved* moved = find(first);
    groups_.enter_edge_among(edge, moved ? moved->now.cell : groups_.particle(first).cell, chain, sorted);
  }
  for (const Moved& moved : moved_) groups_.enter_vertex(moved.member, moved.now.cell);
  // Nothing takes memory from here on.
  for (const Moved& moved : moved_) groups_.particle(moved.member) = moved.now;
  for (auto& [edge, chain] : chains_) groups_.chain(edge) = std::move(chain);
  for (auto& [face, walls] : rests) groups_.rest(face, std::move(walls));
  groups_.forget(removed_);
  return chains_.size();
}

template class Relinker<2>;
template class Relinker<3>;

}  // namespace cellwalk::detail
