// SPDX-License-Identifier: LGPL-3.0-or-later
// The residents near a star, followed on one combination of sides after the other.
#include "vertex_trial.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

namespace cellwalk::detail {

/// Bodies do not depend on each other: each has choices of its own.
template <int D>
bool Vertex_trial<D>::run(const Moving_star<D>& star, std::span<const Cell> cells, bool any) {
  any_ = any;
  groups_.find(cells, vertices_, edges_);
  find_groups_near(star);
  clear();
  near_ = certified_ = 0;
  first_.reset();
  bool is_free = true;
  for (const std::uint32_t group : groups_near_) {
    is_free &= try_group(star, group);
    if (any && !is_free) break;
  }
  return is_free;
}

template <int D>
void Vertex_trial<D>::find_groups_near(const Moving_star<D>& star) {
  groups_near_.clear();
  const auto add = [&](std::uint32_t group) {
    if (groups_near_.empty() || groups_near_.back() != group) groups_near_.push_back(group);
  };
  for (const Member v : vertices_) add(v.group);
  for (const Member e : edges_) add(e.group);
  if (D == 3 && !star.walls().empty())
    for (std::uint32_t g = 0; g < groups_.all().size(); ++g)
      if (has_faces_near(star, g)) add(g);
  std::ranges::sort(groups_near_);
  groups_near_.erase(std::unique(groups_near_.begin(), groups_near_.end()), groups_near_.end());
}

template <int D>
bool Vertex_trial<D>::try_group(const Moving_star<D>& star, std::uint32_t group) {
  const Reshape_counts before = counts_;
  const auto members = [group](const std::vector<Member>& all) {
    const auto first = std::ranges::lower_bound(all, group, {}, &Member::group);
    const auto last = std::ranges::upper_bound(all, group, {}, &Member::group);
    return std::span<const Member>(first, last);
  };
  const auto moved = moved_.size(), chains = chains_.size(), walls = supporting_walls_.size();
  const auto shorten = [](auto& list, std::size_t size) {
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(size), list.end());
  };
  const auto try_choice = [&] {
    is_free_ = true;
    collision_.reset();
    passed_ = with_choice_ = 0;
    blamed_.clear();
    shorten(moved_, moved);
    shorten(chains_, chains);
    shorten(supporting_walls_, walls);
    if (try_vertices(star, members(vertices_)) && try_edges(star, members(edges_))) try_faces(star, group);
    return is_free_;
  };
  std::optional<Collision> last;
  follows_all_ = to_dead_end_ = false;
  dead_ends_ = 0;
  bool have_several_choices = false;
  for (choice_ = 0, choices_ = 1; choice_ < std::min(choices_, most_choices); ++choice_) {
    const bool is_free = try_choice();
    if (choice_ == 0) note_first_choice(before);
    if (is_free) return true;
    if (choice_ == 0 || goes_further_than(last)) last = std::move(collision_);
    have_several_choices |= with_choice_ > 1;
  }
  if (have_several_choices && try_combinations(try_choice, last)) return true;
  // It is blocked. A side on which a vertex gets not to the end may go further than others.
  follows_all_ = to_dead_end_ = true;
  for (choice_ = 0; last && choice_ < std::min(dead_ends_, most_choices); ++choice_)
    if (!try_choice() && goes_further_than(last)) last = std::move(collision_);
  if (last) keep_first(first_, *std::move(last));
  return false;
}

/// Each vertex on a side of its own, and each edge on one on which it is free then. What blocks a combination
/// first blocks all that agree in the choices on which it depends, no later: they are left out.
template <int D>
bool Vertex_trial<D>::try_combinations(const std::function<bool()>& try_choice,
                                       std::optional<Collision>& last) {
  combines_ = follows_all_ = true;
  combined_.clear();
  followed_vertices_.clear();
  followed_edges_.clear();
  bool is_free = false;
  for (std::size_t tries = 0; tries < most_combinations; ++tries) {
    is_free = try_choice();
    if (is_free) break;
    if (goes_further_than(last)) last = std::move(collision_);
    if (!take_next()) break;
  }
  combines_ = false;
  return is_free;
}

/// Another side at the last choice that leaves one, of those that may help; false if there is none. Where a
/// choice leaves none, those may help on which it depends what blocked on its sides.
template <int D>
bool Vertex_trial<D>::take_next() {
  while (!blamed_.empty()) {
    combined_.resize(*blamed_.rbegin());
    Choice& last = combined_.back();
    blamed_.erase(std::prev(blamed_.end()));
    last.blamed.merge(blamed_);
    if (++last.taken < last.sides) return true;
    blamed_ = std::move(last.blamed);
  }
  return false;
}

/// The side of the vertex that is followed next.
template <int D>
std::size_t Vertex_trial<D>::choice_of_next() const {
  if (!combines_) return choice_;
  return passed_ < combined_.size() ? combined_[passed_].taken : 0;
}

/// Notes how many sides it had.
template <int D>
void Vertex_trial<D>::note_choices(std::size_t choices) {
  choices_ = std::max(choices_, choices);
  with_choice_ += choices > 1;
  if (!combines_) return;
  if (passed_ == combined_.size()) combined_.push_back({choices, 0, {}});
  ++passed_;
}

/// True if this choice of sides goes further than another one: nothing is passed by it, or later.
template <int D>
bool Vertex_trial<D>::goes_further_than(const std::optional<Collision>& other) const {
  return other && (!collision_ || other->time < collision_->time);
}

template <int D>
void Vertex_trial<D>::note_first_choice(const Reshape_counts& before) {
  const auto grew = [&](std::uint64_t Reshape_counts::*count) { return counts_.*count - before.*count; };
  near_ += grew(&Reshape_counts::vertices) + grew(&Reshape_counts::edges) + grew(&Reshape_counts::faces);
  certified_ +=
      grew(&Reshape_counts::same_cell) + grew(&Reshape_counts::same_chain) + grew(&Reshape_counts::apart);
}

/// False if nothing else needs to be looked at.
template <int D>
bool Vertex_trial<D>::try_vertices(const Moving_star<D>& star, std::span<const Member> vertices) {
  for (const Member v : vertices) {
    ++counts_.vertices;
    const Particle<D>& p = groups_.particle(v);
    const bool keeps_cell = !follows_all_ && star.keeps_cell(p);
    counts_.same_cell += keeps_cell;
    Moved_vertex moved{v, p, {}, keeps_cell, true};
    if (keeps_cell)
      moved.now = star.registered(p);
    else
      moved.is_free = try_vertex(star, moved);
    if (!moved.is_free && any_) return false;
    moved_.push_back(std::move(moved));
  }
  return true;
}

/// Where something is not free because of its sides of walls: a vertex of it that keeps its cell may take a
/// side away from its cell. Then all vertices of the body are followed by the choices to come.
template <int D>
void Vertex_trial<D>::follow_kept(const Moving_star<D>& star,
                                  std::initializer_list<const Moved_vertex*> vertices) {
  if (follows_all_) return;
  for (const Moved_vertex* moved : vertices) {
    if (!moved || !moved->keeps_cell) continue;
    const Particle<D>& p = groups_.particle(moved->member);
    if (!star.meet(std::span<const Point<D>>(&p.position, 1), false).touches) continue;
    const Followed_vertex<D> followed = follow_vertex(star, p);
    dead_ends_ = std::max(dead_ends_, followed.dead_ends);
    const std::size_t sides = followed.choices;
    if (sides == 1) continue;
    follows_all_ = true;
    choices_ = std::max(choices_, choice_ + 1 + sides);
  }
}

/// True if a vertex that does not keep its cell is free; then it is registered.
template <int D>
bool Vertex_trial<D>::try_vertex(const Moving_star<D>& star, Moved_vertex& vertex) {
  const Particle<D>& p = vertex.now;
  const auto keeps_at_start = [&] { return star.keeps_cell_at_start(p); };
  Star_meeting met;
  if (!meets(star, std::span<const Point<D>>(&p.position, 1), keeps_at_start, met)) {
    vertex.now = star.registered(p);
    return true;
  }
  // Where something is touched as well, that may block it before it is hit.
  if (met.meeting == Encounter::touch || (met.touches && !any_)) {
    vertex.taken = choice_of_next();
    Followed_vertex<D> followed = follow(star, vertex.member);
    // Of a vertex that is blocked, sides matter to its edges until then.
    note_choices(followed.is_free() || !any_ ? std::max<std::size_t>(followed.choices, 1) : 1);
    vertex.choice = passed_;
    dead_ends_ = std::max(dead_ends_, followed.dead_ends);
    ++counts_.followed;
    vertex.stays = std::move(followed.stays);
    if (followed.is_free()) {
      vertex.now = star.registered_in(followed.end, p);
      return true;
    }
    take(followed.collision, met);
  }
  block(std::move(met), vertex.member, {&vertex});
  return false;
}

/// Takes over the collision of a resident that walls touch.
template <int D>
void Vertex_trial<D>::take(std::optional<Collision>& collision, Star_meeting& met) const {
  if (!collision) return;
  met.meeting = Encounter::hit;
  if (!any_) met.collision = std::move(collision);
}

template <int D>
bool Vertex_trial<D>::try_edges(const Moving_star<D>& star, std::span<const Member> edges) {
  for (const Member e : edges)
    if (!try_edge(star, e) && any_) return false;
  return true;
}

template <int D>
const typename Vertex_trial<D>::Moved_vertex* Vertex_trial<D>::find(Member vertex) const {
  const auto found = std::ranges::lower_bound(moved_, vertex, {}, &Moved_vertex::member);
  return found != moved_.end() && found->member == vertex ? &*found : nullptr;
}

/// True if an edge is free; then its chain is kept, or a new one found.
template <int D>
bool Vertex_trial<D>::try_edge(const Moving_star<D>& star, Member edge) {
  const auto [u, v] = groups_.all()[edge.group].edges[edge.number];
  const Member first{edge.group, u}, second{edge.group, v};
  const Particle<D>&p = groups_.particle(first), &q = groups_.particle(second);
  const Chain& chain = groups_.chain(edge);
  const Moved_vertex *moved_p = find(first), *moved_q = find(second);
  in_star_.clear();
  for (const Half_facet f : chain)
    if (star.has(f)) in_star_.push_back(f);
  const bool passes_star = !in_star_.empty();
  if (!moved_p && !moved_q && !passes_star) return true;
  ++counts_.edges;
  const bool keeps_ends = (!moved_p || moved_p->keeps_cell) && (!moved_q || moved_q->keeps_cell);
  if (keeps_ends && (!passes_star || star.keeps_facets(in_star_, p.position, q.position))) {
    ++counts_.same_chain;
    return true;
  }
  const auto keeps_at_start = [&] {
    return star.keeps_cell_at_start(p) && star.keeps_cell_at_start(q) &&
           star.keeps_chain_at_start(chain, p.position, q.position);
  };
  const auto is_blocked = [](const Moved_vertex* moved) { return moved && !moved->is_free; };
  Star_meeting met;
  if (meets(star, std::array{p.position, q.position}, keeps_at_start, met)) {
    const bool are_ends_free = !is_blocked(moved_p) && !is_blocked(moved_q);
    // Where an end is blocked, the edge may be so before.
    if (met.meeting == Encounter::touch || (met.touches && !any_)) {
      ++counts_.followed;
      Followed_edge followed = follow(star, edge, moved_p, moved_q);
      if (followed.is_free()) {
        chains_.emplace_back(edge, followed.chain);
        return true;
      }
      take(followed.collision, met);
    }
    // A blocked end decides for an edge that is only touched until then.
    if (are_ends_free || met.meeting == Encounter::hit) block(std::move(met), edge, {moved_p, moved_q});
    return false;
  }
  if (is_blocked(moved_p) || is_blocked(moved_q)) return false;
  ++counts_.relinked;
  chains_.emplace_back(edge,
                       star.relinked(chain, p.cell, moved_p ? moved_p->now : p, moved_q ? moved_q->now : q));
  return true;
}

/// Follows a vertex on the side that is its turn.
template <int D>
Followed_vertex<D> Vertex_trial<D>::follow(const Moving_star<D>& star, Member vertex) {
  const Particle<D>& p = groups_.particle(vertex);
  if (!combines_) return follow_vertex(star, p, choice_, to_dead_end_);
  const std::size_t side = choice_of_next();
  const auto [known, is_new] = followed_vertices_.try_emplace({vertex, side});
  if (is_new) known->second = follow_vertex(star, p, side);
  return known->second;
}

/// Follows an edge that walls touch, whose ends are free.
template <int D>
Followed_edge Vertex_trial<D>::follow(const Moving_star<D>& star, Member edge, const Moved_vertex* moved_p,
                                      const Moved_vertex* moved_q) {
  if (!combines_) return follow_anew(star, edge, moved_p, moved_q);
  const auto side = [](const Moved_vertex* moved) { return moved ? moved->taken : 0; };
  const auto [known, is_new] = followed_edges_.try_emplace({edge, side(moved_p), side(moved_q)});
  if (is_new) known->second = follow_anew(star, edge, moved_p, moved_q);
  return known->second;
}

template <int D>
Followed_edge Vertex_trial<D>::follow_anew(const Moving_star<D>& star, Member edge,
                                           const Moved_vertex* moved_p, const Moved_vertex* moved_q) {
  const auto [u, v] = groups_.all()[edge.group].edges[edge.number];
  const auto end = [&](std::uint32_t vertex, const Moved_vertex* moved) {
    const Particle<D>& before = groups_.particle({edge.group, vertex});
    Followed_vertex<D> result;
    if (!moved || moved->keeps_cell)
      result.stays = {{before.cell, Fraction(1)}};
    else if (!moved->stays.empty())
      result.stays = moved->stays;
    else  // it was free for another reason: whatever cells are found, they are linked with its own
      result = follow_vertex(star, before);
    result.before = before;
    result.end = moved ? moved->now.cell : before.cell;
    return result;
  };
  const Followed_vertex<D> p = end(u, moved_p), q = end(v, moved_q);
  Followed_edge followed = follow_edge(star, p, q, groups_.chain(edge), combines_ ? 0 : choice_);
  choices_ = std::max(choices_, followed.choices);
  for (std::size_t k = 1; combines_ && !followed.is_free() && k < followed.choices; ++k)
    followed = follow_edge(star, p, q, groups_.chain(edge), k);
  if (!followed.is_free()) follow_kept(star, {moved_p, moved_q});
  return followed;
}

/// False if no wall meets a set, or all that do leave it at once.
/// \param keeps_at_start whether it keeps its registration just after the vertex began to move
template <int D>
template <class Starts>
bool Vertex_trial<D>::meets(const Moving_star<D>& star, std::span<const Point<D>> points,
                            const Starts& keeps_at_start, Star_meeting& met) const {
  met = star.meet(points, !any_);
  if (met.meeting == Encounter::apart) {
    ++counts_.apart;
    return false;
  }
  if (met.meeting == Encounter::touch && met.leaves && keeps_at_start()) {
    ++counts_.left;
    return false;
  }
  return true;
}

/// Notes that something is in the way.
/// \param vertices on whose sides it depends; null for those that are not near
template <int D>
void Vertex_trial<D>::block(Star_meeting met, Member member,
                            std::initializer_list<const Moved_vertex*> vertices) {
  ++(met.meeting == Encounter::hit ? counts_.hits : counts_.touches);
  std::set<std::size_t> blamed;
  for (const Moved_vertex* vertex : vertices)
    if (combines_ && vertex && vertex->choice > 0) blamed.insert(vertex->choice);
  const auto last = [](const std::set<std::size_t>& choices) {
    return choices.empty() ? 0 : *choices.rbegin();
  };
  const bool is_first = met.collision ? !collision_ || met.collision->time < collision_->time
                                      : is_free_ || (!collision_ && last(blamed) < last(blamed_));
  if (is_first) blamed_ = std::move(blamed);
  is_free_ = false;
  if (!met.collision) return;
  met.collision->group = member.group;
  met.collision->feature = member.number;
  keep_first(collision_, *std::move(met.collision));
}

template <int D>
void Vertex_trial<D>::prepare() {
  for (const Moved_vertex& moved : moved_)
    if (!moved.keeps_cell) groups_.enter_vertex(moved.member, moved.now.cell);
  for (const auto& [edge, chain] : chains_) {
    const Member first{edge.group, groups_.all()[edge.group].edges[edge.number][0]};
    const Moved_vertex* moved = find(first);
    groups_.enter_edge(edge, moved ? moved->now.cell : groups_.particle(first).cell, chain,
                       groups_.chain(edge));
  }
}

template <int D>
void Vertex_trial<D>::commit() noexcept {
  for (const Moved_vertex& moved : moved_) groups_.particle(moved.member) = moved.now;
  for (auto& [edge, chain] : chains_) groups_.chain(edge) = std::move(chain);
  for (auto& [face, walls] : supporting_walls_) groups_.rest(face, std::move(walls));
}

template class Vertex_trial<2>;
template class Vertex_trial<3>;

}  // namespace cellwalk::detail
