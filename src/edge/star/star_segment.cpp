// SPDX-License-Identifier: LGPL-3.0-or-later
// The intersections of an edge with still and moving facets as exact spans, kept for reuse.
#include "star_segment.h"

#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/walk/signs.h>

namespace cellwalk::detail {
namespace {

template <int D>
Ring_vector<D> times(const Ring& factor, const Point<D>& x) {
  Ring_vector<D> result;
  for (int k = 0; k < D; ++k) result[k] = factor * Ring(x[k]);
  return result;
}

}  // namespace

template <int D>
const std::optional<Span>& Still_segment<D>::in_facet(Half_facet f) const {
  const auto [found, is_new] = in_facets_.try_emplace(f);
  if (!is_new) return found->second;
  const Snapshot<D>& snapshot = star().snapshot();
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(f));
  const std::size_t i = snapshot.facet_of(f);
  if (side<Exact>(cell, i, p_, star().counts()) * side<Exact>(cell, i, q_, star().counts()) <= 0)
    found->second = segment_.in_facet(cell, i);
  return found->second;
}

template <int D>
const std::optional<Span>& Still_segment<D>::in_cell(Cell c) const {
  const auto [found, is_new] = in_cells_.try_emplace(c);
  if (!is_new) return found->second;
  const Cell_view<D> cell = star().snapshot().view(c);
  const auto p = exact<D>(p_), q = exact<D>(q_);
  Span span{0, 1};
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    // In the plane positive inside, in space outside.
    const Half_space<D> h = plane_of(cell, i);
    const Ring at_p = h.at(p), at_q = h.at(q);
    if (!(D == 2 ? clip(span, at_p, at_q, 0) : clip(span, -at_p, -at_q, 0))) return found->second;
  }
  found->second = span;
  return found->second;
}

template <int D>
Star_segment<D>::Star_segment(const Still_segment<D>& still, const Fraction& time)
    : still_(still),
      time_(time),
      vertex_(still.clock().vertex_at(time)),
      p_(times<D>(time.denominator(), still.p())),
      q_(times<D>(time.denominator(), still.q())) {}

template <int D>
Ring_vector<D> Star_segment<D>::corner(const Cell_view<D>& cell, std::uint16_t v) const {
  return cell.point_index(v) == still_.star().vertex() ? vertex_
                                                       : times<D>(time_.denominator(), cell.point(v));
}

/// The plane of a facet, positive outside.
template <int D>
Half_space<D> Star_segment<D>::plane(const Cell_view<D>& cell, std::size_t i) const {
  const auto loop = cell.loop(i);
  const auto u = corner(cell, loop[0]), v = corner(cell, loop[1]);
  if constexpr (D == 2)
    return {u, {v[1] - u[1], u[0] - v[0]}};
  else
    return {u, exact_cross(minus(v, u), minus(corner(cell, loop[2]), u))};
}

template <int D>
Half_space<D> Star_segment<D>::side_of(const Cell_view<D>& cell, std::size_t i, std::size_t k,
                                       const Half_space<D>& plane) const {
  const auto loop = cell.loop(i);
  const auto u = corner(cell, loop[k]), v = corner(cell, loop[k + 1 == loop.size() ? 0 : k + 1]);
  if constexpr (D == 2)
    return {u, minus(v, u)};
  else
    return {u, exact_cross(plane.normal, minus(v, u))};
}

/// True proves that both ends lie strictly on one side of a facet.
template <int D>
bool Star_segment<D>::is_apart(const Cell_view<D>& cell, std::size_t i) const {
  const Star_clock<D>& clock = still_.clock();
  const int at_p = clock.side(cell, i, still_.p(), time_);
  return at_p != 0 && at_p == clock.side(cell, i, still_.q(), time_);
}

template <int D>
std::optional<Span> Star_segment<D>::in_facet(Half_facet f) const {
  const Snapshot<D>& snapshot = still_.star().snapshot();
  if (!still_.star().has(f)) return still_.in_facet(f);
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(f));
  const std::size_t i = snapshot.facet_of(f);
  if (is_apart(cell, i)) return {};
  const Half_space<D> outside = plane(cell, i);
  const Ring at_p = outside.at(p_), at_q = outside.at(q_);
  Span span{0, 1};
  if (!clip(span, at_p, at_q, 0) || !clip(span, -at_p, -at_q, 1)) return {};
  for (std::size_t k = 0; k < cell.loop(i).size(); ++k) {
    const Half_space<D> inside = side_of(cell, i, k, outside);
    if (!clip(span, inside.at(p_), inside.at(q_), 2 + static_cast<int>(k))) return {};
  }
  return span;
}

template <int D>
std::optional<Span> Star_segment<D>::in_cell(Cell c) const {
  if (!still_.star().has(c)) return still_.in_cell(c);
  const Cell_view<D> cell = still_.star().snapshot().view(c);
  Span span{0, 1};
  for (std::size_t i = 0; i < cell.facet_count(); ++i) {
    const Half_space<D> outside = plane(cell, i);
    if (!clip(span, -outside.at(p_), -outside.at(q_), 0)) return {};
  }
  return span;
}

template <int D>
Fraction Star_segment<D>::at_border(Half_facet f, int border, const Fraction& otherwise) const {
  const Snapshot<D>& snapshot = still_.star().snapshot();
  const Cell_view<D> cell = snapshot.view(snapshot.cell_of(f));
  const std::size_t i = snapshot.facet_of(f);
  Half_space<D> h = plane(cell, i);
  if (border >= 2) h = side_of(cell, i, static_cast<std::size_t>(border - 2), h);
  const Ring at_p = h.at(p_), at_q = h.at(q_);
  if (CGAL::is_zero(at_p) && CGAL::is_zero(at_q)) return otherwise;
  return {at_p, at_p - at_q};
}

template class Still_segment<2>;
template class Still_segment<3>;
template class Star_segment<2>;
template class Star_segment<3>;

}  // namespace cellwalk::detail
