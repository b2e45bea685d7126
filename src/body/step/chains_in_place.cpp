// SPDX-License-Identifier: LGPL-3.0-or-later
// Chains confirmed or relinked from the stored corners of their facets, without a walk.
#include "chains_in_place.h"

#include <algorithm>

namespace cellwalk::detail {
namespace {

/// Where the corners of the first facets end.
template <int D>
std::size_t end_of(std::span<const Facet_corners<D>> corners, std::size_t facets) {
  std::size_t end = 0;
  for (; facets > 0; --facets)
    while (corners[end++].continues) {
    }
  return end;
}

}  // namespace

/// The facets crossed, from their other sides.
template <int D>
const std::vector<Half_facet>& Edge_words<D>::behind() {
  std::vector<Half_facet>& behind = body_.scratch.behind;
  for (std::size_t i = behind.size(); i < crossed_.size(); ++i)
    behind.push_back(snapshot_.opposite(crossed_[i]));
  return behind;
}

template <int D>
std::size_t Edge_words<D>::count_undone(const Corner& corner) {
  const Chain& chain = body_.chains[corner.edge];
  std::size_t undone = 0;
  const std::size_t most = std::min(chain.size(), crossed_.size());
  if (!corner.is_reversed) {
    while (undone < most && chain[undone] == crossed_[undone]) ++undone;
  } else if (most > 0) {
    const std::vector<Half_facet>& seen = behind();
    while (undone < most && chain[chain.size() - 1 - undone] == seen[undone]) ++undone;
  }
  return undone;
}

template <int D>
std::span<const Facet_corners<D>> Edge_words<D>::without(std::span<const Facet_corners<D>> all,
                                                         const Corner& corner, std::size_t undone) const {
  if (corner.is_reversed) return all.first(end_of(all, body_.chains[corner.edge].size() - undone));
  return all.subspan(end_of(all, undone));
}

template <int D>
const std::vector<Facet_corners<D>>& Edge_words<D>::corners_ahead() {
  std::vector<Facet_corners<D>>& corners = body_.scratch.corners_ahead;
  if (corners.empty())
    for (const Half_facet f : crossed_) append_corners(snapshot_, f, corners);
  return corners;
}

template <int D>
std::span<const Facet_corners<D>> Edge_words<D>::read_added(const Corner& corner, std::size_t undone) {
  if (corner.is_reversed) {
    const std::span<const Facet_corners<D>> all = corners_ahead();
    return all.subspan(end_of(all, undone));
  }
  std::vector<Facet_corners<D>>& corners = body_.scratch.corners_behind;
  if (corners.empty()) append_from_behind<D>(corners_ahead(), corners);
  const std::span<const Facet_corners<D>> all = corners;
  return all.first(end_of(all, crossed_.size() - undone));
}

template <int D>
Half_facet Edge_words<D>::first_facet(const Corner& corner, std::size_t undone) {
  const Chain& chain = body_.chains[corner.edge];
  if (undone < crossed_.size()) return corner.is_reversed ? crossed_.back() : behind().back();
  return corner.is_reversed ? chain[chain.size() - 1 - undone] : chain[undone];
}

template <int D>
std::span<const Half_facet> Edge_words<D>::facets(const Corner& corner, std::size_t undone) {
  const Chain& old = body_.chains[corner.edge];
  std::vector<Half_facet>& word = body_.scratch.word;
  if (corner.is_reversed) {
    word.assign(old.begin(), old.end() - static_cast<std::ptrdiff_t>(undone));
    word.insert(word.end(), crossed_.begin() + static_cast<std::ptrdiff_t>(undone), crossed_.end());
  } else {
    word.clear();
    if (undone < crossed_.size())
      word.assign(behind().rbegin(), behind().rend() - static_cast<std::ptrdiff_t>(undone));
    word.insert(word.end(), old.begin() + static_cast<std::ptrdiff_t>(undone), old.end());
  }
  return word;
}

template <int D>
void Edge_words<D>::take_over(const Corner& corner) {
  if (crossed_.empty()) return;
  const std::size_t undone = this->undone(corner);
  Chain& chain = body_.chains[corner.edge];
  std::vector<Facet_corners<D>>& corners = body_.corners_of_chains[corner.edge];
  const auto kept = static_cast<std::ptrdiff_t>(corners_kept(corner, undone).size());
  const auto added = corners_added(corner, undone);
  const std::vector<Half_facet>& seen = behind();
  // Nothing fails after this, so that the chain and its corners go together.
  chain.reserve(size(corner, undone));
  if (const std::size_t needed = static_cast<std::size_t>(kept) + added.size(); corners.capacity() < needed)
    corners.reserve(2 * needed);
  if (corner.is_reversed) {
    chain.resize(chain.size() - undone);
    for (std::size_t i = undone; i < crossed_.size(); ++i) chain.push_back(crossed_[i]);
    corners.erase(corners.begin() + kept, corners.end());
    corners.insert(corners.end(), added.begin(), added.end());
  } else {
    chain.erase(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(undone));
    for (std::size_t i = undone; i < crossed_.size(); ++i) chain.insert(chain.begin(), seen[i]);
    corners.erase(corners.begin(), corners.end() - kept);
    corners.insert(corners.begin(), added.begin(), added.end());
  }
}

template class Edge_words<2>;
template class Edge_words<3>;

template <int D>
bool Chains_in_place<D>::confirms(const Corner& corner) {
  const Particle<D>& q = body_.particles[corner.other];
  const std::size_t undone = words_.undone(corner), size = words_.size(corner, undone);
  if (size == 0) {
    // With a corner inside of a cell the triangle lies in no plane of a facet, along which walls may begin.
    if (!has_inner_end_ && q.dimension != D) return false;
    ++same_cell_;
  } else {
    line_.lead_to(q.position, corner.is_reversed);
    if (!passes(words_.corners_kept(corner, undone)) || !passes(words_.corners_added(corner, undone)))
      return false;
    if (is_blocked_ && !is_before_wall(corner, undone)) return false;
    chain_facets_ += size;
  }
  ++edges_;
  return true;
}

template <int D>
Relink_answer Chains_in_place<D>::relink(const Corner& corner, const Particle<D>& from, Half_facet wall,
                                         Moved_chain<D>& moved) {
  const Particle<D>& q = body_.particles[corner.other];
  line_.lead_to(q.position, corner.is_reversed);
  const Chain& chain = body_.chains[corner.edge];
  const Moving_edge<D> edge{from.position,
                            q.position,
                            line_,
                            corner.is_reversed,
                            has_inner_end_ || q.dimension == D,
                            body_.scratch.crossed,
                            body_.scratch.crosses_inside,
                            wall,
                            {chain.data(), chain.size()},
                            body_.corners_of(corner.edge)};
  const Relink_answer answer =
      relink_at_ridges<D>(*body_.snapshot, edge, body_.scratch.relink, moved.chain, moved.corners);
  if (answer == Relink_answer::free) {
    moved.is_relinked = true;
    ++edges_;
    ++relinked_;
  }
  return answer;
}

/// True if the target, beyond the wall that blocks the vertex, certainly lies before the first facet of the
/// word.
/// \pre the line passes the word, which is not empty
template <int D>
bool Chains_in_place<D>::is_before_wall(const Corner& corner, std::size_t undone) {
  const float d = distance_from_plane(*body_.snapshot, words_.first_facet(corner, undone), line_.start());
  return corner.is_reversed ? d > plane_error : d < -plane_error;
}

template class Chains_in_place<2>;
template class Chains_in_place<3>;

template <int D>
bool try_move_in_place(Body_state<D>& body, std::uint32_t vertex, const Point<D>& target,
                       Settled_move<D>& settled, Body_counts& counts) {
  const Snapshot<D>& snapshot = *body.snapshot;
  body.refresh_vertex(vertex, counts);
  const Particle<D>& from = body.particles[vertex];
  Float_point<D> mapped;
  if (!snapshot.frame().map(target, mapped)) return false;
  Particle<D> to{target, from.cell, D, from.aimed};
  Move_scratch<D>& scratch = body.scratch;
  scratch.clear_walk();
  if (!certainly_inside<D>(snapshot, from.cell, mapped, counts.edges.walk)) {
    to.cell = certain_end(snapshot, from, target, counts.edges.walk, &scratch.crossed);
    to.aimed = 0;
    if (to.cell == Cell::none) return false;
    scratch.crosses_inside = true;
  }
  settled.to = to;
  const bool is_inside = body.region.holds_way(vertex, target);
  const auto corners = body.topology.corners_of(vertex);
  scratch.take_up_chains(corners.size());
  bool is_changed = !scratch.crossed.empty();
  Chains_in_place<D> in_place(body, to, mapped, false);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    Moved_chain<D>& moved = scratch.chains[i];
    moved.is_relinked = false;
    // In the region, only edges that leave it can meet anything.
    moved.is_stale = is_inside && !body.region.is_outside(corners[i].other);
    is_changed |= moved.is_stale;
    if (moved.is_stale) continue;
    if (body.is_stale(corners[i])) body.refresh_edge(corners[i].edge, counts);
    moved.is_in_place = in_place.confirms(corners[i]);
    if (moved.is_in_place) continue;
    is_changed = true;
    const Relink_answer relinked = in_place.relink(corners[i], from, Half_facet::none, moved);
    if (relinked == Relink_answer::free) continue;
    settled.free_edges = i;
    settled.next_edge = relinked;
    in_place.add_to(counts.edges);
    return false;
  }
  in_place.add_to(counts.edges);
  if (is_changed) {
    body.commit(vertex, to, scratch.chains);
  } else {
    body.particles[vertex] = to;
    body.place(vertex, target);
  }
  return true;
}

template bool try_move_in_place(Body_state<2>&, std::uint32_t, const Point<2>&, Settled_move<2>&,
                                Body_counts&);
template bool try_move_in_place(Body_state<3>&, std::uint32_t, const Point<3>&, Settled_move<3>&,
                                Body_counts&);

}  // namespace cellwalk::detail
