// SPDX-License-Identifier: LGPL-3.0-or-later
// The vertices, edges and faces at new walls, and the sides that they are given together.
#include "shrinkage.h"

#include <cellwalk/internal/kernel/distance.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/walk/signs.h>

#include <algorithm>
#include <utility>

namespace cellwalk::detail {
namespace {

/// Faces in the plane of a new wall are tried on both of its sides: up to this number in all combinations,
/// more of them all on one side, then all on the other.
constexpr std::size_t most_free_faces = 4;

template <int D>
bool are_in_line(const Point<D>& p, const Point<D>& q, const Point<D>& r) {
  if constexpr (D == 3)
    return are_collinear(p, q, r);
  else
    return false;
}

}  // namespace

template <int D>
Shrinkage<D>::Shrinkage(Wall_editor<D>& editor, Resident_groups<D>& groups, Half_facet closed,
                        Walk_counts& counts)
    : editor_(editor),
      snapshot_(editor.snapshot()),
      groups_(groups),
      aim_(Aim::close),
      walls_{closed},
      counts_(counts) {
  find_box();
}

template <int D>
Shrinkage<D>::Shrinkage(Wall_editor<D>& editor, Resident_groups<D>& groups, Cell filled, Walk_counts& counts)
    : Shrinkage(editor, groups, std::span<const Cell>(&filled, 1), counts) {
  aim_ = Aim::fill;
  closing_.filled = filled;
}

template <int D>
Shrinkage<D>::Shrinkage(Wall_editor<D>& editor, Resident_groups<D>& groups, std::span<const Cell> left,
                        Walk_counts& counts)
    : editor_(editor),
      snapshot_(editor.snapshot()),
      groups_(groups),
      aim_(Aim::leave),
      filled_(left.begin(), left.end()),
      counts_(counts) {
  std::sort(filled_.begin(), filled_.end());
  for (const Cell c : filled_)
    for (const Half_facet f : editor_.passages(c, false))
      if (!is_filled(snapshot_.neighbour(f))) walls_.push_back(f);
  find_box();
}

template <int D>
void Shrinkage<D>::find_box() {
  for (const Half_facet f : walls_) {
    both_sides_.push_back(f);
    both_sides_.push_back(snapshot_.opposite(f));
    for (const std::uint32_t p : snapshot_.loop(f)) box_.extend(snapshot_.point(p));
  }
  for (const Cell c : filled_) {
    const Cell_view<D> cell = snapshot_.view(c);
    for (std::size_t v = 0; v < cell.vertex_count(); ++v) box_.extend(cell.point(v));
  }
  std::sort(both_sides_.begin(), both_sides_.end());
  closing_.facets = both_sides_;
}

template <int D>
std::vector<Resident> Shrinkage<D>::holders() {
  groups_.open(box_);
  if (!groups_.has_open()) return {};
  const Cell own = aim_ == Aim::close ? snapshot_.cell_of(walls_.front()) : Cell::none;
  groups_.find(aim_ == Aim::close ? std::span(&own, 1) : std::span<const Cell>(filled_), vertices_, edges_);
  const auto& groups = groups_.all();
  for (std::uint32_t g = 0; g < groups.size(); ++g)
    if (groups[g].is_open && groups[g].reach.meets(box_)) try_group(g);
  is_too_near_ = held_by_.empty();
  find_thick_holders();
  is_too_near_ &= !held_by_.empty();
  std::sort(held_by_.begin(), held_by_.end());
  held_by_.erase(std::unique(held_by_.begin(), held_by_.end()), held_by_.end());
  return held_by_;
}

/// What would be nearer to a new wall than its radius, or is inside of a cell that is filled.
template <int D>
void Shrinkage<D>::find_thick_holders() {
  if (aim_ == Aim::leave) return;  // whoever moves the walls tests them
  std::vector<Point<D>> corners;
  for (const Half_facet wall : walls_) {
    corners.clear();
    for (const std::uint32_t p : snapshot_.loop(wall)) corners.push_back(snapshot_.point(p));
    for (const Thick_member<D>* member : groups_.thick().nearer_to(corners))
      hold(*member, distance_rounded_down<D>(member->hull(), corners));
  }
  if (aim_ == Aim::close) return;
  for (const Thick_member<D>* member : groups_.thick().near(box_))
    if (in_closure(snapshot_, filled_.front(), member->points[0])) hold(*member, 0);
}

template <int D>
void Shrinkage<D>::hold(const Thick_member<D>& member, double distance) {
  held_by_.push_back(groups_.at(member.member, member.feature));
  distance_ = std::min(distance_, distance);
}

template <int D>
void Shrinkage<D>::make() {
  for (Group& group : free_) group.choice.prepare();
  if (aim_ == Aim::fill) editor_.fill(filled_.front(), walls_);
  if (aim_ == Aim::close) editor_.set_wall(walls_.front(), true);
  // Nothing takes memory from here on.
  for (Group& group : free_) {
    group.choice.commit();
    for (auto& [face, walls] : group.rests) groups_.rest({group.number, face}, std::move(walls));
  }
}

/// True if an edge is at a facet or cell that is closed, so that its chain may have to change.
/// \param is_parted set if the edge passes a new wall inside, so that it has no chain then
template <int D>
bool Shrinkage<D>::touches(std::uint32_t group, std::uint32_t edge, bool& is_parted) const {
  const auto [u, v] = groups_.all()[group].edges[edge];
  const Particle<D>&p = groups_.particle({group, u}), &q = groups_.particle({group, v});
  bool result = is_filled(p.cell) || is_filled(q.cell);
  for (const Half_facet f : groups_.chain({group, edge})) {
    if (!closing_.has(f)) continue;
    result = true;
    is_parted |= crosses_inside(snapshot_, f, p.position, q.position, counts_);
  }
  return result;
}

/// False proves that a face touches nothing that is closed.
template <int D>
bool Shrinkage<D>::is_near(const std::array<Point<D>, 3>& corners) const {
  Box<D> box;
  for (const Point<D>& x : corners) box.extend(x);
  if (!box.meets(box_)) return false;
  const auto lies_on = [&](const Cell_view<D>& cell, std::size_t i, int at) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Point<D>& x) { return at * side<Exact>(cell, i, x, counts_) > 0; });
  };
  if (aim_ == Aim::close) {
    const Cell_view<D> cell = snapshot_.view(snapshot_.cell_of(walls_.front()));
    const std::size_t i = snapshot_.facet_of(walls_.front());
    return !lies_on(cell, i, 1) && !lies_on(cell, i, -1);
  }
  const Cell_view<D> cell = snapshot_.view(filled_.front());
  for (std::size_t i = 0; i < cell.facet_count(); ++i)
    if (lies_on(cell, i, 1)) return false;
  return true;
}

template <int D>
void Shrinkage<D>::find_near_faces(std::uint32_t group) {
  faces_.clear();
  in_plane_.clear();
  const Resident_group<D>& of = groups_.all()[group];
  if (D == 2 || aim_ == Aim::leave || !of.body || !of.body->keeps_faces()) return;  // in 2D bodies keep none
  for (std::uint32_t f = 0; f < of.faces.size(); ++f) {
    Near_face face{f, {}};
    for (std::size_t k = 0; k < 3; ++k) face.corners[k] = of.particles[of.faces[f][k]].position;
    const auto& [p, q, r] = face.corners;
    if (is_near(face.corners) && !are_in_line<D>(p, q, r)) faces_.push_back(face);
  }
}

/// True if a face forbids the change by itself. Else notes the walls in its plane that it overlaps.
template <int D>
bool Shrinkage<D>::is_parted(std::uint32_t group, const Near_face& face) {
  if constexpr (D == 3) {
    for (const Half_facet rest : groups_.all()[group].body->supporting_walls(face.number))
      if (is_filled(snapshot_.cell_of(rest))) return true;
    for (const Half_facet wall : walls_) {
      const Face_at_facet place = place_of_face(snapshot_, wall, face.corners, counts_);
      if (place == Face_at_facet::pierced) return true;
      if (place == Face_at_facet::in_plane) in_plane_.emplace_back(face.number, wall);
    }
  }
  return false;
}

/// Adds the sides of a face that lie along new walls, and notes whereto the face extends from there.
template <int D>
void Shrinkage<D>::add_sides(std::uint32_t group, const Near_face& face, Side_choice<D>& choice,
                             Tips& tips) const {
  const auto& sides = groups_.all()[group].body->sides(face.number);
  for (std::size_t k = 0; k < 3; ++k) {
    const Point<D>&p = face.corners[k], &q = face.corners[(k + 1) % 3];
    if (std::none_of(walls_.begin(), walls_.end(),
                     [&](Half_facet wall) { return lies_along(snapshot_, wall, p, q, counts_); }))
      continue;
    choice.add_edge(sides[k]);
    tips.emplace_back(sides[k], face.corners[(k + 2) % 3]);
  }
}

/// Puts the sides of faces in the plane of new walls on the sides of these on which the faces are to be.
template <int D>
void Shrinkage<D>::demand(std::uint32_t group, std::size_t choice, Side_choice<D>& of_group) const {
  of_group.forget_demands();
  for (std::size_t n = 0; n < in_plane_.size(); ++n) {
    const auto& [number, wall] = in_plane_[n];
    const bool is_other = aim_ == Aim::fill || (choice >> std::min(n, most_free_faces - 1) & 1) != 0;
    const auto face = std::ranges::find(faces_, number, &Near_face::number);
    const auto& sides = groups_.all()[group].body->sides(number);
    for (std::size_t k = 0; k < 3; ++k)
      if (lies_along(snapshot_, wall, face->corners[k], face->corners[(k + 1) % 3], counts_))
        of_group.demand(sides[k], is_other ? snapshot_.opposite(wall) : wall);
  }
}

template <int D>
void Shrinkage<D>::try_group(std::uint32_t group) {
  const std::size_t held_before = held_by_.size();
  const auto hold = [&](std::uint32_t number, Body_feature feature) {
    held_by_.push_back(groups_.at({group, number}, feature));
  };
  Group result{group, {snapshot_, groups_, group, closing_, filled_, counts_}, {}};
  Side_choice<D>& choice = result.choice;
  bool is_any = false;
  if (aim_ != Aim::close)
    for (const Member v : vertices_)
      if (v.group == group) {
        choice.add_vertex(v.number);
        is_any = true;
      }
  for (const Member e : edges_) {
    bool is_parted = false;
    if (e.group != group || !touches(group, e.number, is_parted)) continue;
    is_any = true;
    if (is_parted)
      hold(e.number, Body_feature::edge);
    else
      choice.add_edge(e.number);
  }
  find_near_faces(group);
  Tips tips;
  for (const Near_face& face : faces_) {
    if (is_parted(group, face)) hold(face.number, Body_feature::face);
    add_sides(group, face, choice, tips);
  }
  if (!is_any && faces_.empty()) return;
  choice.complete();
  choice.find_holders(held_by_, aim_ == Aim::leave);
  if (held_by_.size() != held_before) return;
  for (const auto& [edge, tip] : tips) choice.add_tip(edge, tip);

  const std::size_t bits = aim_ != Aim::close ? 0 : std::min(in_plane_.size(), most_free_faces);
  const std::size_t ways = std::size_t{1} << bits;
  std::vector<Resident> failed;
  for (std::size_t k = 0; k < ways; ++k) {
    // All on one side, all on the other, then the rest.
    demand(group, k == 0 ? 0 : ways - k, choice);
    std::uint32_t face = 0;
    if (choice.choose()) {
      if (faces_.empty() || stand(group, result, face)) {
        free_.push_back(std::move(result));
        return;
      }
      failed = {groups_.at({group, face}, Body_feature::face)};
    } else {
      failed = who_failed(group, choice.failed(), tips);
    }
  }
  held_by_.insert(held_by_.end(), failed.begin(), failed.end());
}

/// The faces along new walls of an edge that found no side, or the edge if there are none.
template <int D>
std::vector<Resident> Shrinkage<D>::who_failed(std::uint32_t group, std::uint32_t edge,
                                               const Tips& tips) const {
  std::vector<Resident> result;
  if (std::ranges::find(tips, edge, &Tips::value_type::first) != tips.end())
    for (const Near_face& face : faces_) {
      const auto& sides = groups_.all()[group].body->sides(face.number);
      if (std::find(sides.begin(), sides.end(), edge) != sides.end())
        result.push_back(groups_.at({group, face.number}, Body_feature::face));
    }
  if (result.empty()) result.push_back(groups_.at({group, edge}, Body_feature::edge));
  return result;
}

/// True if all faces near can stand among the walls then.
template <int D>
bool Shrinkage<D>::stand(std::uint32_t group, Group& of_group, std::uint32_t& failed) {
  if constexpr (D == 3) {
    const Resident_group<3>& of = groups_.all()[group];
    Side_choice<3>& choice = of_group.choice;
    of_group.rests.clear();
    for (const Near_face& face : faces_)  // while all is as it was
      for (const std::uint32_t e : of.body->sides(face.number)) choice.chain(e);
    bool is_free = true;
    editor_.with_walls(walls_, aim_ == Aim::fill ? filled_.front() : Cell::none, [&] {
      for (const Near_face& face : faces_) {
        const auto& at = of.faces[face.number];
        const auto& sides = of.body->sides(face.number);
        const auto side_chain = [&](std::size_t k) -> Side_chain {
          return {&choice.chain(sides[k]), at[k] > at[(k + 1) % 3]};
        };
        Face_registration found = stand_among_walls(
            snapshot_, {choice.particle(at[0]), choice.particle(at[1]), choice.particle(at[2])},
            {side_chain(0), side_chain(1), side_chain(2)}, of.body->supporting_walls(face.number), counts_);
        if (found.piercing != Half_facet::none) {
          failed = face.number;
          is_free = false;
          return;
        }
        of_group.rests.emplace_back(face.number, std::move(found.supporting_walls));
      }
    });
    return is_free;
  } else {
    return true;
  }
}

template class Shrinkage<2>;
template class Shrinkage<3>;

}  // namespace cellwalk::detail
