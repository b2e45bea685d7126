// SPDX-License-Identifier: LGPL-3.0-or-later
// The cyclic order of half-planes around the way, and the wedges that edges, faces and cells occupy.
#include "ridge_wedges.h"

#include <cellwalk/internal/edge/swept_triangle.h>

#include <algorithm>
#include <utility>

#include "broad_phase.h"
#include "edge/exact/rational_segment.h"

namespace cellwalk::detail {

Ridge_wedges::Ridge_wedges(const Snapshot<3>& snapshot, const Vertex_path<3>& path, Face_counts& counts)
    : snapshot_(snapshot), a_(path.from.position), b_(path.to.position) {
  if (a_ == b_) return;
  Candidate_walls candidates(path.from.cell);
  find_candidate_walls(snapshot, {a_, b_, b_, b_}, candidates, counts);
  const Rational_segment<3> way(a_, b_);
  std::vector<Wall_on_way> walls;
  std::vector<Fraction> ends;
  for (const Half_facet wall : candidates.walls) {
    const std::optional<Span> met =
        way.in_facet(snapshot.view(snapshot.cell_of(wall)), snapshot.facet_of(wall));
    if (!met || !(met->low < met->high)) continue;
    walls.push_back({wall, met->low, met->high});
    ends.insert(ends.end(), {met->low, met->high});
  }
  std::sort(ends.begin(), ends.end());
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    if (!(ends[k] < ends[k + 1])) continue;
    Piece piece{ends[k]};
    for (const Wall_on_way& wall : walls)
      if (!(ends[k] < wall.low) && !(wall.high < ends[k + 1])) add_wall(piece, wall.wall);
    if (piece.half_planes.size() < 2) continue;
    const Half_plane first = piece.half_planes.front();
    std::sort(piece.half_planes.begin(), piece.half_planes.end(),
              [&](const Half_plane& x, const Half_plane& y) { return is_before(first, x, y); });
    piece.may_be_in.assign(piece.half_planes.size(), true);
    pieces_.push_back(std::move(piece));
  }
}

Ridge_wedges::Half_plane Ridge_wedges::half_plane(const Point<3>& x, Half_facet wall) const {
  const Ring_vector<3> a = exact<3>(a_);
  return {x, exact_cross(minus(exact<3>(b_), a), minus(exact<3>(x), a)), wall};
}

int Ridge_wedges::turn(const Half_plane& from, const Point<3>& y) const {
  return static_cast<int>(CGAL::sign(exact_dot(from.normal, minus(exact<3>(y), exact<3>(a_)))));
}

bool Ridge_wedges::is_before(const Half_plane& from, const Half_plane& x, const Half_plane& y) const {
  // 0: in the half-plane, 1: less than half a turn on, 2: opposite, 3: more.
  const auto quarter = [&](const Half_plane& z) {
    const int side = turn(from, z.point);
    return side > 0 ? 1 : side < 0 ? 3 : are_equal(from, z) ? 0 : 2;
  };
  const int of_x = quarter(x), of_y = quarter(y);
  return of_x != of_y ? of_x < of_y : turn(x, y.point) > 0;
}

bool Ridge_wedges::are_equal(const Half_plane& x, const Half_plane& y) {
  const Ring_vector<3> across = exact_cross(x.normal, y.normal);
  return std::all_of(across.begin(), across.end(), [](const Ring& c) { return CGAL::is_zero(c); }) &&
         CGAL::is_positive(exact_dot(x.normal, y.normal));
}

void Ridge_wedges::add_wall(Piece& piece, Half_facet wall) const {
  const Cell_view<3> cell = snapshot_.view(snapshot_.cell_of(wall));
  for (const std::uint16_t v : cell.loop(snapshot_.facet_of(wall))) {
    Half_plane half = half_plane(cell.point(v), wall);
    if (std::all_of(half.normal.begin(), half.normal.end(), [](const Ring& c) { return CGAL::is_zero(c); }))
      continue;  // on the line
    const auto known = std::find_if(piece.half_planes.begin(), piece.half_planes.end(),
                                    [&](const Half_plane& other) { return are_equal(half, other); });
    if (known == piece.half_planes.end()) piece.half_planes.push_back(std::move(half));
  }
}

std::size_t Ridge_wedges::wedge_of(const Piece& piece, const Half_plane& x) const {
  const auto& all = piece.half_planes;
  std::size_t k = 0;
  while (k + 1 < all.size() && !is_before(all.front(), x, all[k + 1])) ++k;
  return k;
}

void Ridge_wedges::hold(Piece& piece, std::size_t one, std::size_t other) {
  for (std::size_t k = 0; k < piece.may_be_in.size(); ++k)
    if (k != one && k != other) piece.may_be_in[k] = false;
}

void Ridge_wedges::hold_edge(const Point<3>& q) {
  const Half_plane edge = half_plane(q);
  for (Piece& piece : pieces_) {
    const std::size_t k = wedge_of(piece, edge), count = piece.half_planes.size();
    hold(piece, k, are_equal(edge, piece.half_planes[k]) ? (k + count - 1) % count : k);
  }
}

std::size_t Ridge_wedges::wedge_of_angle(const Piece& piece, const Point<3>& q, const Point<3>& r) const {
  Half_plane first = half_plane(q);
  if (turn(first, r) < 0) first = half_plane(r);
  return wedge_of(piece, first);
}

void Ridge_wedges::hold_face(const Point<3>& q, const Point<3>& r) {
  for (Piece& piece : pieces_) {
    const std::size_t k = wedge_of_angle(piece, q, r);  // no wall is between its sides
    hold(piece, k, k);
  }
}

Cell Ridge_wedges::cell_after(const Vertex_path<3>& path, const Fraction& time) const {
  const Rational_segment<3> way(a_, b_);
  Cell cell = path.from.cell;
  for (const Half_facet f : path.crossed) {
    const std::optional<Span> met = way.in_facet(snapshot_.view(cell), snapshot_.facet_of(f));
    if (met && time < met->low) break;
    cell = snapshot_.neighbour(f);  // if p crosses it later, the way is in it until then
  }
  return cell;
}

bool Ridge_wedges::is_in_border(const Cell_view<3>& cell, const Fraction& time) const {
  const Rational_segment<3> way(a_, b_);
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    const std::optional<Span> met = way.in_facet(cell, i);
    if (met && !(time < met->low) && time < met->high) return true;
  }
  return false;
}

void Ridge_wedges::hold_path(const Vertex_path<3>& path) {
  for (Piece& piece : pieces_) {
    const Cell_view<3> cell = snapshot_.view(cell_after(path, piece.low));
    if (!is_in_border(cell, piece.low)) continue;  // a wall blocks p before
    std::size_t u = 0;
    while (are_collinear(a_, b_, cell.point(u))) ++u;
    const Half_plane one = half_plane(cell.point(u));
    std::size_t v = 0;
    while (turn(one, cell.point(v)) == 0) ++v;
    const std::size_t k = wedge_of_angle(piece, cell.point(u), cell.point(v));
    hold(piece, k, k);
  }
}

template <class Pieces, class F>
void Ridge_wedges::for_each_place(Pieces& pieces, Half_facet half, const F& f) const {
  const Cell_view<3> cell = snapshot_.view(snapshot_.cell_of(half));
  const std::size_t i = snapshot_.facet_of(half);
  const std::optional<Span> met = Rational_segment<3>(a_, b_).in_facet(cell, i);
  if (!met || !(met->low < met->high)) return;
  std::vector<Half_plane> own;
  for (const std::uint16_t v : cell.loop(i)) own.push_back(half_plane(cell.point(v)));
  for (auto& piece : pieces)
    for (std::size_t k = 0; k < piece.half_planes.size(); ++k) {
      const Half_plane& plane = piece.half_planes[k];
      if (piece.low < met->low || !(piece.low < met->high) ||
          std::none_of(own.begin(), own.end(), [&](const Half_plane& x) { return are_equal(x, plane); }))
        continue;
      const std::size_t before = (k + piece.half_planes.size() - 1) % piece.half_planes.size();
      int side = 0;
      for (std::size_t v = 0; side == 0 && v < cell.vertex_count(); ++v) side = turn(plane, cell.point(v));
      f(piece, side > 0 ? k : before, side > 0 ? before : k);
    }
}

void Ridge_wedges::hold_side(Half_facet half) {
  for_each_place(pieces_, half, [&](Piece& piece, std::size_t own, std::size_t) { hold(piece, own, own); });
}

bool Ridge_wedges::needs(Half_facet half) const {
  bool is_needed = false;
  for_each_place(pieces_, half, [&](const Piece& piece, std::size_t, std::size_t beyond) {
    is_needed |= !piece.may_be_in[beyond];
  });
  return is_needed;
}

std::optional<Contact<3>> Ridge_wedges::conflict() const {
  for (const Piece& piece : pieces_) {
    if (std::find(piece.may_be_in.begin(), piece.may_be_in.end(), true) != piece.may_be_in.end()) continue;
    Contact<3> contact;
    contact.facet = piece.half_planes.front().wall;
    contact.cell = snapshot_.cell_of(contact.facet);
    const Exact_point<3> point = Rational_segment<3>(a_, b_).at(piece.low);
    const Facet_feature feature =
        lowest_feature<3>(snapshot_.view(contact.cell), snapshot_.facet_of(contact.facet), point);
    contact.set_time(to_time(piece.low));
    contact.point = point.rounded();
    contact.kind = feature.kind;
    contact.corner = feature.corner;
    contact.body = Body_feature::vertex;
    contact.normal = normalized(a_ - b_);
    return contact;
  }
  return {};
}

}  // namespace cellwalk::detail
