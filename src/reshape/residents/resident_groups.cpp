// SPDX-License-Identifier: LGPL-3.0-or-later
// The table from cells to residents, entered when it is first needed, and renewed when outdated.
#include "resident_groups.h"

#include <cellwalk/body/verified_stop.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <string>
#include <utility>

namespace cellwalk::detail {
namespace {

/// The number of entries, outdated or not, beyond which all are made anew.
std::size_t most_for(std::size_t entries) { return 4 * entries + 4096; }

void sort_unique(std::vector<Member>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

[[noreturn]] void refuse_particle(std::size_t number) {
  throw Error(Error_code::usage, "particle " + std::to_string(number) +
                                     " of those listed does not lie in its cell: locate it again");
}

}  // namespace

template <int D>
Resident_groups<D>::Resident_groups(const Snapshot<D>& snapshot, const Residents<D>& residents)
    : snapshot_(snapshot) {
  for (Body<D>* body : residents.bodies) {
    if (body == nullptr)
      throw Error(Error_code::usage, "a body listed is null: list bodies only, each where it is in memory");
    Resident_group<D>& group = groups_.emplace_back();
    group.body.emplace(*body);
    if (&group.body->snapshot() != &snapshot)
      throw Error(Error_code::usage, "a body listed lies in another environment: list it where it is");
    group.body->check_epoch();
    group.edges = body->edges();
    group.faces = body->faces();
    group.reach = group.body->reach();
    group.radius = group.body->largest_radius();
  }
  for (const std::span<Particle<D>> particles : residents.particles) {
    Resident_group<D>& group = groups_.emplace_back();
    group.particles = particles;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (particles[i].cell == Cell::none || !is_finite(particles[i].position)) refuse_particle(i);
      group.reach.extend(particles[i].position);
    }
  }
  std::size_t edges = 0;
  for (const Resident_group<D>& group : groups_) {
    first_edge_.push_back(edges);
    edges += group.edges.size();
  }
  seen_.resize(edges);
  most_entries_ = most_for(0);
}

template <int D>
std::size_t Resident_groups<D>::open(const Box<D>& box) {
  if (open_ == groups_.size()) return 0;
  std::size_t opened = 0;
  for (std::uint32_t g = 0; g < groups_.size(); ++g) {
    Resident_group<D>& group = groups_[g];
    if (group.is_open || !group.reach.meets(box)) continue;
    if (group.body) {
      Body_counts uncounted;
      group.body->leave_regions(uncounted);
      group.particles = group.body->particles();
    } else {
      for (std::size_t i = 0; i < group.particles.size(); ++i)
        if (const Particle<D>& p = group.particles[i];
            !in_closure(snapshot_, p.cell, p.position) || snapshot_.is_solid(p.cell))
          refuse_particle(i);
    }
    enter_all(g);
    add_thick(g);
    group.is_open = true;
    ++open_;
    ++opened;
  }
  if (opened != 0 && most_entries_ != 0) most_entries_ = most_for(entries_.size());
  return opened;
}

template <int D>
void Resident_groups<D>::enter_all(std::uint32_t group) {
  const Resident_group<D>& of = groups_[group];
  for (std::uint32_t v = 0; v < of.particles.size(); ++v) enter_vertex({group, v}, of.particles[v].cell);
  for (std::uint32_t e = 0; e < of.edges.size(); ++e)
    enter_edge({group, e}, of.particles[of.edges[e][0]].cell, chain({group, e}), {});
}

template <int D>
void Resident_groups<D>::add_thick(std::uint32_t group) {
  const Resident_group<D>& of = groups_[group];
  if (of.radius == 0) return;
  const auto add = [&](std::uint32_t number, Body_feature feature, double radius,
                       std::span<const std::uint32_t> corners) {
    if (radius == 0) return;
    Thick_member<D> member{{group, number}, feature, radius, {corners.begin(), corners.end()}, {}};
    for (const std::uint32_t v : corners) member.points.push_back(of.particles[v].position);
    thick_.add(std::move(member));
  };
  for (std::uint32_t v = 0; v < of.particles.size(); ++v)
    add(v, Body_feature::vertex, of.body->radius_of_vertex(v), {&v, 1});
  for (std::uint32_t e = 0; e < of.edges.size(); ++e)
    add(e, Body_feature::edge, of.body->radius_of_edge(e), of.edges[e]);
  if (!of.body->keeps_faces()) return;
  for (std::uint32_t f = 0; f < of.faces.size(); ++f)
    add(f, Body_feature::face, of.body->radius_of_face(f), of.faces[f]);
}

template <int D>
void Resident_groups<D>::add_nearer(std::span<const Point<D>> hull, std::vector<Resident>& result) {
  for (const Thick_member<D>* member : thick_.nearer_to(hull))
    result.push_back(at(member->member, member->feature));
}

template <int D>
std::size_t Resident_groups<D>::body_count() const {
  return static_cast<std::size_t>(std::count_if(groups_.begin(), groups_.end(),
                                                [](const auto& group) { return group.body.has_value(); }));
}

template <int D>
std::vector<Member> Resident_groups<D>::vertices_of(const Resident& resident) const {
  const auto bodies = static_cast<std::uint32_t>(body_count());
  const std::uint32_t g = resident.is_particle ? bodies + resident.owner : resident.owner;
  std::vector<Member> result;
  if (resident.feature == Body_feature::vertex) return {{g, resident.number}};
  if (resident.feature == Body_feature::edge)
    for (const std::uint32_t v : groups_[g].edges[resident.number]) result.push_back({g, v});
  else
    for (const std::uint32_t v : groups_[g].faces[resident.number]) result.push_back({g, v});
  return result;
}

template <int D>
bool Resident_groups<D>::push(Member vertex, const Vector<D>& by, const Body_options& options) {
  Resident_group<D>& group = groups_[vertex.group];
  Particle<D>& particle = group.particles[vertex.number];
  const Point<D> from = particle.position, target = from + by;
  if (target == from || !is_finite(target)) return false;
  const std::size_t most_entries =
      std::exchange(most_entries_, 0);  // if memory runs out, all is entered anew
  if (group.body) {
    Body_counts uncounted;
    try {
      group.body->push(vertex.number, target, options, uncounted);
    } catch (...) {
      thick_.move(vertex, particle.position);
      throw;
    }
  } else {
    Walk_counts uncounted;
    std::vector<Contact<D>> met;
    advance(snapshot_, particle, by, {.restitution = 0, .most_contacts = options.most_contacts}, met,
            uncounted);
  }
  const bool has_moved = particle.position != from;
  if (has_moved) {
    group.reach.extend(enlarged(Box<D>{particle.position, particle.position}, group.radius));
    if (group.radius > 0) thick_.move(vertex, particle.position);
    enter_vertex(vertex, particle.cell);
    for (std::uint32_t e = 0; e < group.edges.size(); ++e)
      if (group.edges[e][0] == vertex.number || group.edges[e][1] == vertex.number)
        enter_edge({vertex.group, e}, group.particles[group.edges[e][0]].cell, chain({vertex.group, e}), {});
  }
  most_entries_ = most_entries;
  return has_moved;
}

template <int D>
Resident Resident_groups<D>::at(Member member, Body_feature feature) const {
  const auto bodies = static_cast<std::uint32_t>(body_count());
  const bool is_particle = member.group >= bodies;
  return {is_particle, is_particle ? member.group - bodies : member.group, feature, member.number};
}

template <int D>
void Resident_groups<D>::find(std::span<const Cell> cells, std::vector<Member>& vertices,
                              std::vector<Member>& edges) {
  if (entries_.size() >= most_entries_) enter_anew();
  vertices.clear();
  edges.clear();
  const std::uint64_t last_search = lists_;
  for (const Cell c : cells) {
    const auto first = first_.find(to_index(c));
    if (first == first_.end()) continue;
    ++lists_;
    std::uint32_t* link = &first->second;
    for (std::uint32_t e = *link; e != none; e = *link) {
      Entry& entry = entries_[e];
      if (entry.is_edge) {
        const std::uint64_t seen =
            std::exchange(seen_[first_edge_[entry.member.group] + entry.member.number], lists_);
        if (seen == lists_) {  // entered into this cell more than once
          *link = entry.next;
          continue;
        }
        if (seen <= last_search) edges.push_back(entry.member);
      } else if (groups_[entry.member.group].particles[entry.member.number].cell == c) {
        vertices.push_back(entry.member);
      }
      link = &entry.next;
    }
  }
  sort_unique(vertices);
  std::sort(edges.begin(), edges.end());
}

template <int D>
std::vector<Member> Resident_groups<D>::faces_near(const Box<D>& box) const {
  std::vector<Member> result;
  for (std::uint32_t g = 0; D == 3 && g < groups_.size(); ++g) {
    const Resident_group<D>& group = groups_[g];
    if (!group.is_open || !group.body || !group.body->keeps_faces()) continue;
    for (std::uint32_t f = 0; f < group.faces.size(); ++f) {
      Box<D> own;
      for (const std::uint32_t v : group.faces[f]) own.extend(group.particles[v].position);
      if (own.meets(box)) result.push_back({g, f});
    }
  }
  return result;
}

template <int D>
void Resident_groups<D>::enter(Cell cell, Member member, bool is_edge) {
  const auto [place, is_new] = first_.try_emplace(to_index(cell), none);
  entries_.push_back({member, is_edge, place->second});
  place->second = static_cast<std::uint32_t>(entries_.size() - 1);
}

/// It is known in the cells behind facets with which its chains begin and end alike.
template <int D>
void Resident_groups<D>::enter_edge(Member edge, Cell first, const Chain& now, const Chain& before) {
  enter(first, edge, true);
  const auto [begin, of_before] = std::ranges::mismatch(now, before);
  auto end = now.end();
  for (auto old = before.end(); end != begin && old != of_before && *(old - 1) == *(end - 1); --old) --end;
  for (auto f = begin; f != end; ++f) enter(snapshot_.neighbour(*f), edge, true);
}

/// Enters all anew, once most entries may be outdated.
template <int D>
void Resident_groups<D>::enter_anew() {
  auto first = std::exchange(first_, {});
  auto entries = std::exchange(entries_, {});
  try {
    for (std::uint32_t g = 0; g < groups_.size(); ++g)
      if (groups_[g].is_open) enter_all(g);
  } catch (...) {
    std::swap(first, first_);
    std::swap(entries, entries_);
    throw;
  }
  most_entries_ = most_for(entries_.size());
}

template <int D>
void Resident_groups<D>::enter_edge_among(Member edge, Cell first, const Chain& now,
                                          std::span<const Cell> among) {
  const auto enter_in = [&](Cell c) {
    if (std::ranges::binary_search(among, c)) enter(c, edge, true);
  };
  enter_in(first);
  for (const Half_facet f : now) enter_in(snapshot_.neighbour(f));
}

template <int D>
void Resident_groups<D>::forget(std::span<const Cell> cells) {
  for (const Cell c : cells) first_.erase(to_index(c));
}

template <int D>
void Resident_groups<D>::follow_epoch() {
  for (Resident_group<D>& group : groups_)
    if (group.body) group.body->follow_epoch();
}

template class Resident_groups<2>;
template class Resident_groups<3>;

}  // namespace cellwalk::detail
