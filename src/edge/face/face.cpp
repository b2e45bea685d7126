// SPDX-License-Identifier: LGPL-3.0-or-later
// The choice of the sweep, by volume or in the plane, and the first touch of all walls near.
#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/internal/walk/star.h>

#include <cmath>

#include "borders.h"
#include "broad_phase.h"
#include "edge/exact/exit_time.h"
#include "find_supporting_walls.h"
#include "swept_tetrahedron.h"
#include "triangle_in_plane.h"

namespace cellwalk {
namespace {

using detail::Candidate_walls;
using detail::Corners;
using detail::Swept_tetrahedron;
using detail::Triangle_in_plane;

/// A face whose swept tetrahedron has a volume, near walls.
class Face_sweep {
 public:
  Face_sweep(const Snapshot<3>& snapshot, const Corners& corners, Face_counts& counts)
      : snapshot_(snapshot), corners_(corners), tetrahedron_(corners, counts), counts_(counts) {}

  std::optional<Contact<3>> first_contact(const Candidate_walls& candidates,
                                          const Supporting_walls& supporting_walls) {
    for (const Half_facet supporting_wall : supporting_walls)
      if (side(supporting_wall, corners_[1]) > 0) note(supporting_wall);
    for (const Half_facet wall : candidates.walls)
      if (tetrahedron_.meets(view(wall), snapshot_.facet_of(wall))) note(wall);
    if (wall_ == Half_facet::none) return {};
    return contact();
  }

  /// The supporting walls of the face at the end of a free motion.
  Supporting_walls supporting_walls_at_end(const Candidate_walls& candidates) const {
    Supporting_walls supporting_walls;
    std::optional<Triangle_in_plane> face;
    for (const Half_facet wall : candidates.walls) {
      if (side(wall, corners_[1]) != 0) continue;
      if (!face) face.emplace(std::array{corners_[1], corners_[2], corners_[3]}, counts_.walk);
      const std::size_t i = snapshot_.facet_of(wall);
      if (!face->holds(view(wall), i) || !face->overlaps(view(wall), i)) continue;
      // Of coincident walls that are not glued, the face lies on the one whose cell is on its side.
      const Half_facet supporting_wall = side(wall, corners_[0]) < 0 ? wall : snapshot_.opposite(wall);
      if (supporting_wall != Half_facet::none) supporting_walls.push_back(supporting_wall);
    }
    detail::sort(supporting_walls);
    return supporting_walls;
  }

 private:
  Cell_view<3> view(Half_facet f) const { return snapshot_.view(snapshot_.cell_of(f)); }
  int side(Half_facet f, const Point<3>& x) const {
    return detail::side<Exact>(view(f), snapshot_.facet_of(f), x, counts_.walk);
  }

  /// Keeps the first touch of all walls: the earliest, then that on the lowest feature, then that of the
  /// lowest half-facet.
  void note(Half_facet wall) {
    const Swept_tetrahedron::Touch touch = tetrahedron_.first_touch(view(wall), snapshot_.facet_of(wall));
    if (wall_ != Half_facet::none) {
      if (first_.time < touch.time) return;
      if (first_.time == touch.time && (first_.feature.kind < touch.feature.kind ||
                                        (first_.feature.kind == touch.feature.kind && wall_ < wall)))
        return;
    }
    first_ = touch;
    wall_ = wall;
  }

  Contact<3> contact() const {
    Contact<3> contact;
    contact.set_time(to_time(first_.time));
    contact.point = first_.point.rounded();
    contact.kind = first_.feature.kind;
    contact.corner = first_.feature.corner;
    contact.body = first_.body;
    contact.facet = wall_;
    contact.cell = snapshot_.cell_of(wall_);
    contact.normal = first_.feature.kind == Contact_kind::facet
                         ? detail::inner_normal(view(wall_), snapshot_.facet_of(wall_))
                         : tetrahedron_.normal_at(first_.time);
    return contact;
  }

  const Snapshot<3>& snapshot_;
  Corners corners_;
  Swept_tetrahedron tetrahedron_;
  Face_counts& counts_;
  Swept_tetrahedron::Touch first_;
  Half_facet wall_ = Half_facet::none;
};

/// The supporting walls of a face that moved in its plane: walls in the plane that are joined under the area
/// that it swept have it on one side all the time, and its edges, too.
Face_registration moved_in_plane(const Snapshot<3>& snapshot, const Corners& corners, const Particle<3>& p,
                                 const Particle<3>& q, const Particle<3>& r, const Face_chains& chains,
                                 const Candidate_walls& candidates, const Supporting_walls& known,
                                 Face_counts& counts) {
  const detail::Swept_in_plane swept = detail::swept_in_plane(corners, counts.walk);
  if (swept.empty()) return {};
  const bool has_interior = !are_collinear(corners[1], corners[2], corners[3]);
  const Triangle_in_plane face =
      has_interior ? Triangle_in_plane({corners[1], corners[2], corners[3]}, counts.walk) : swept.front();
  Face_registration result = detail::find_supporting_walls(
      snapshot, face, swept, detail::sides_of(chains, p, q, r), candidates, known, detail::Known::binding);
  if (!has_interior) result.supporting_walls.clear();
  return result;
}

/// The supporting walls of a face that was placed in its plane.
Face_registration standing(const Snapshot<3>& snapshot, const Particle<3>& p, const Particle<3>& q,
                           const Particle<3>& r, const Face_chains& chains, const Candidate_walls& candidates,
                           const Supporting_walls& known, detail::Known use, Face_counts& counts) {
  if (are_collinear(p.position, q.position, r.position)) return {};
  const Triangle_in_plane triangle({p.position, q.position, r.position}, counts.walk);
  return detail::find_supporting_walls(snapshot, triangle, {triangle}, detail::sides_of(chains, p, q, r),
                                       candidates, known, use);
}

}  // namespace

Face_result sweep_face(const Snapshot<3>& snapshot, const Vertex_path<3>& path, const Particle<3>& q,
                       const Particle<3>& r, const Supporting_walls& supporting_walls,
                       const Face_chains& chains, Face_counts& counts) {
  ++counts.faces;
  const Corners corners{path.from.position, path.to.position, q.position, r.position};
  Candidate_walls candidates(path.from.cell);
  detail::find_candidate_walls(snapshot, corners, candidates, counts);
  if (candidates.walls.empty()) {
    ++counts.clear;
    return {};
  }
  counts.walls += candidates.walls.size();
  const bool is_made = !path.blocked && chains.are_complete();
  Face_result result;
  result.are_walls_near = true;
  if (Exact::orientation(counts.walk.predicates, corners[0], corners[1], corners[2], corners[3]) == 0) {
    if (!is_made) return result;
    ++counts.flat;
    const Face_registration end =
        moved_in_plane(snapshot, corners, path.to, q, r, chains, candidates, supporting_walls, counts);
    if (end.piercing != Half_facet::none)
      return {{}, detail::contact_at_start(snapshot, end.piercing, corners[0]), true, true};
    result.supporting_walls = end.supporting_walls;
  } else {
    Face_sweep sweep(snapshot, corners, counts);
    result.contact = sweep.first_contact(candidates, supporting_walls);
    if (result.contact && path.blocked) {
      const Cell last = path.visited.back();
      const auto blocked = detail::exit_time<3>(snapshot.view(last), corners[0], corners[1], counts.walk);
      if (result.contact->exact_time() >= blocked.exact()) result.contact.reset();
    }
    if (result.contact || !is_made) return result;
    result.supporting_walls = sweep.supporting_walls_at_end(candidates);
  }
  if (are_collinear(corners[1], corners[2], corners[3])) return result;
  const Half_facet wall = detail::wall_at_border(snapshot, detail::sides_of(chains, path.to, q, r),
                                                 candidates, result.supporting_walls, counts.walk);
  if (wall == Half_facet::none) return result;
  return {{}, detail::contact_at_start(snapshot, wall, corners[0]), true, true};
}

namespace detail {

Face_registration stand_face(const Snapshot<3>& snapshot, const Particle<3>& p, const Particle<3>& q,
                             const Particle<3>& r, const Face_chains& chains, const Supporting_walls& known,
                             Known use, Face_counts& counts) {
  ++counts.faces;
  Candidate_walls candidates(p.cell);
  find_candidate_walls(snapshot, {p.position, p.position, q.position, r.position}, candidates, counts);
  if (candidates.walls.empty()) {
    ++counts.clear;
    return {};
  }
  counts.walls += candidates.walls.size();
  Face_registration result = standing(snapshot, p, q, r, chains, candidates, known, use, counts);
  if (result.piercing != Half_facet::none || are_collinear(p.position, q.position, r.position)) return result;
  const Triangle_in_plane triangle({p.position, q.position, r.position}, counts.walk);
  for (const Half_facet wall : candidates.walls)
    if (triangle.is_pierced_by(snapshot.view(snapshot.cell_of(wall)), snapshot.facet_of(wall)))
      result.piercing = wall;
  if (result.piercing == Half_facet::none)
    result.piercing =
        wall_at_border(snapshot, sides_of(chains, p, q, r), candidates, result.supporting_walls, counts.walk);
  return result;
}

}  // namespace detail

Face_registration register_face(const Snapshot<3>& snapshot, const Particle<3>& p, const Particle<3>& q,
                                const Particle<3>& r, const Face_chains& chains, Face_counts& counts,
                                const Supporting_walls& known) {
  return detail::stand_face(snapshot, p, q, r, chains, known, detail::Known::preferred, counts);
}

}  // namespace cellwalk
