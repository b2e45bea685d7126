// SPDX-License-Identifier: LGPL-3.0-or-later
// The faces of bodies near a vertex that moves.
#include <algorithm>
#include <array>
#include <utility>

#include "vertex_trial.h"

namespace cellwalk::detail {

template <int D>
bool Vertex_trial<D>::has_faces_near(const Moving_star<D>& star, std::uint32_t number) const {
  const Resident_group<D>& group = groups_.all()[number];
  return group.is_open && group.body && group.reach.meets(star.box()) && group.body->keeps_faces();
}

/// A wall that is apart from a face is none of those that it rests on, and changes no side.
template <int D>
void Vertex_trial<D>::try_faces(const Moving_star<D>& star, std::uint32_t number) {
  if (D == 2 || star.walls().empty() || !has_faces_near(star, number)) return;
  const Resident_group<D>& group = groups_.all()[number];
  for (std::uint32_t f = 0; f < group.faces.size(); ++f) {
    std::array<Point<D>, 3> corners;
    Box<D> box;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = group.particles[group.faces[f][k]].position;
      box.extend(corners[k]);
    }
    if (!box.meets(star.box())) continue;
    ++counts_.faces;
    if (!try_face(star, {number, f}, corners) && any_) return;
  }
}

/// True if a face is free; then its supporting walls are kept, or found.
template <int D>
bool Vertex_trial<D>::try_face(const Moving_star<D>& star, Member face, std::span<const Point<D>> points) {
  Star_meeting met = star.meet(points, !any_);
  if (met.meeting == Encounter::apart) {
    ++counts_.apart;
    return true;
  }
  const auto corner = [&](std::size_t k) {
    return find({face.group, groups_.all()[face.group].faces[face.number][k]});
  };
  if (met.meeting == Encounter::touch) {
    Face_at_star result = after(star, face, points);
    if (result.is_free) {
      ++counts_.rested;
      supporting_walls_.emplace_back(face, std::move(result.supporting_walls));
      return true;
    }
    // Once something is in the way, only further hits matter.
    if (!result.collision && !is_free_) return false;
    if (!result.collision) follow_kept(star, {corner(0), corner(1), corner(2)});
    take(result.collision, met);
  }
  block(std::move(met), face, {corner(0), corner(1), corner(2)});
  return false;
}

/// A face that walls touch. If something is in the way already, its corners or edges need not be free, and
/// its supporting walls do not matter.
template <int D>
Face_at_star Vertex_trial<D>::after(const Moving_star<D>& star, Member face,
                                    std::span<const Point<D>> points) {
  if constexpr (D == 3) {
    if (auto collision = face_passed_by_vertex(star, {points[0], points[1], points[2]}))
      return {false, std::move(collision), {}};
    if (!is_free_) return {};
    const Resident_group<3>& group = groups_.all()[face.group];
    const auto& at = group.faces[face.number];
    const auto& sides = group.body->sides(face.number);
    const auto corner = [&](std::size_t k) {
      const Moved_vertex* moved = find({face.group, at[k]});
      return moved ? moved->now : group.particles[at[k]];
    };
    const auto side = [&](std::size_t k) -> Side_chain {
      const Member edge{face.group, sides[k]};
      const auto relinked = std::ranges::find(chains_, edge, &std::pair<Member, Chain>::first);
      return {relinked != chains_.end() ? &relinked->second : &groups_.chain(edge), at[k] > at[(k + 1) % 3]};
    };
    return face_at_star(star, {corner(0), corner(1), corner(2)}, {side(0), side(1), side(2)},
                        group.body->supporting_walls(face.number));
  } else {
    return {true, {}, {}};  // in the plane walls come in over edges only
  }
}

// Each member by itself: the class is instantiated in vertex_trial.cpp, without those that are defined here.
template bool Vertex_trial<2>::has_faces_near(const Moving_star<2>&, std::uint32_t) const;
template bool Vertex_trial<3>::has_faces_near(const Moving_star<3>&, std::uint32_t) const;
template void Vertex_trial<2>::try_faces(const Moving_star<2>&, std::uint32_t);
template void Vertex_trial<3>::try_faces(const Moving_star<3>&, std::uint32_t);
template bool Vertex_trial<2>::try_face(const Moving_star<2>&, Member, std::span<const Point<2>>);
template bool Vertex_trial<3>::try_face(const Moving_star<3>&, Member, std::span<const Point<3>>);
template Face_at_star Vertex_trial<2>::after(const Moving_star<2>&, Member, std::span<const Point<2>>);
template Face_at_star Vertex_trial<3>::after(const Moving_star<3>&, Member, std::span<const Point<3>>);

}  // namespace cellwalk::detail
