// SPDX-License-Identifier: LGPL-3.0-or-later
// The exact times at which a point passes the moving planes, and the sides between them.
#include "star_clock.h"

#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/internal/walk/signs.h>

#include <algorithm>
#include <array>
#include <utility>

namespace cellwalk::detail {
namespace {

/// The side of x with respect to facet i, positive outside, with the vertex of the star at a place: its sign
/// by of(points ..), the sign of their orientation, or its value.
template <int D, class Orientation>
auto side_with(const Moving_star<D>& star, const Cell_view<D>& cell, std::size_t i, const Point<D>& x,
               const Point<D>& place, const Orientation& of) {
  const auto loop = cell.loop(i);
  const auto at = [&](std::size_t k) -> const Point<D>& {
    return cell.point_index(loop[k]) == star.vertex() ? place : cell.point(loop[k]);
  };
  if constexpr (D == 2)
    return of(at(1), at(0), x);
  else
    return of(at(0), at(1), at(2), x);
}

template <int D>
int sign_with(const Moving_star<D>& star, const Cell_view<D>& cell, std::size_t i, const Point<D>& x,
              const Point<D>& place) {
  return side_with(star, cell, i, x, place, [&](const auto&... points) {
    return Exact::orientation(star.counts().predicates, points...);
  });
}

template <int D>
Ring value_with(const Moving_star<D>& star, const Cell_view<D>& cell, std::size_t i, const Point<D>& x,
                const Point<D>& place) {
  return side_with(star, cell, i, x, place,
                   [](const auto&... points) { return Exact_value::orientation(points...); });
}

Ring turn(const std::array<Ring, 2>& u, const std::array<Ring, 2>& v, const std::array<Ring, 2>& w) {
  return (v[0] - u[0]) * (w[1] - u[1]) - (v[1] - u[1]) * (w[0] - u[0]);
}

/// Weights of the corners of a segment or triangle at a point of it.
std::vector<Ring> weights_at(const std::array<Ring_vector<2>, 2>& corners, const Ring_vector<2>& x) {
  const auto& [u, v] = corners;
  const std::size_t axis = u[0] == v[0] ? 1 : 0;
  if (u[axis] < v[axis]) return {v[axis] - x[axis], x[axis] - u[axis]};
  return {x[axis] - v[axis], u[axis] - x[axis]};
}

std::vector<Ring> weights_at(const std::array<Ring_vector<3>, 3>& corners, const Ring_vector<3>& x) {
  for (std::size_t axis = 0;; ++axis) {
    const auto drop = [axis](const Ring_vector<3>& y) {
      return std::array<Ring, 2>{y[(axis + 1) % 3], y[(axis + 2) % 3]};
    };
    const auto u = drop(corners[0]), v = drop(corners[1]), w = drop(corners[2]), at = drop(x);
    const int sense = CGAL::sign(turn(u, v, w));
    if (sense == 0 && axis < 2) continue;
    std::vector<Ring> weights{turn(at, v, w), turn(u, at, w), turn(u, v, at)};
    if (sense < 0)
      for (Ring& weight : weights) weight = -weight;
    return weights;
  }
}

}  // namespace

Fraction time_between(const Fraction& s, const Fraction& t) {
  const Fraction near(0.5 * (to_double(s) + to_double(t)));
  return s < near && near < t ? near : middle(s, t);
}

void complete_times(std::vector<Fraction>& times) {
  times.emplace_back(0);
  times.emplace_back(1);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
}

template <int D>
int Star_clock<D>::side(const Cell_view<D>& cell, std::size_t i, const Point<D>& x,
                        const Fraction& time) const {
  const Point<D>&from = star_.from(), &to = star_.to();
  const bool moves = has_point(cell, i, star_.vertex());
  if (!moves || time == Fraction(1)) return detail::side<Exact>(cell, i, x, star_.counts());
  const int at_0 = sign_with(star_, cell, i, x, from);
  if (time.sign() == 0) return at_0;
  const int at_1 = sign_with(star_, cell, i, x, to);
  if (at_0 * at_1 >= 0) return at_0 != 0 ? at_0 : at_1;
  const Ring rest = time.denominator() - time.numerator();
  return CGAL::sign(Ring(value_with(star_, cell, i, x, from) * rest +
                         value_with(star_, cell, i, x, to) * time.numerator()));
}

template <int D>
bool Star_clock<D>::holds(Cell c, const Point<D>& x, const Fraction& time) const {
  const Cell_view<D> cell = star_.snapshot().view(c);
  for (std::size_t i = 0; i < cell.facet_count(); ++i)
    if (side(cell, i, x, time) > 0) return false;
  return true;
}

template <int D>
bool Star_clock<D>::holds_in_facet(const Cell_view<D>& cell, std::size_t i, const Point<D>& x,
                                   const Fraction& time) const {
  // Cells around the vertex are simplices: points of them in the plane of a facet lie in the facet.
  return side(cell, i, x, time) == 0 && (cell.vertex_count() == D + 1 || in_facet(cell, i, x));
}

template <int D>
void Star_clock<D>::add_passings(const Point<D>& x, std::vector<Fraction>& times) const {
  for (const Cell c : star_.cells()) {
    if (star_.snapshot().is_solid(c)) continue;
    const Cell_view<D> cell = star_.snapshot().view(c);
    for (std::size_t i = 0; i < cell.facet_count(); ++i) {
      if (!has_point(cell, i, star_.vertex())) continue;
      if (sign_with(star_, cell, i, x, star_.from()) * sign_with(star_, cell, i, x, star_.to()) >= 0)
        continue;
      const Ring before = value_with(star_, cell, i, x, star_.from());
      const Ring after = value_with(star_, cell, i, x, star_.to());
      const Fraction root(before, before - after);
      if (holds(c, x, root)) times.push_back(root);
    }
  }
}

template <int D>
Ring_vector<D> Star_clock<D>::vertex_at(const Fraction& time) const {
  const Ring rest = time.denominator() - time.numerator();
  Ring_vector<D> place;
  for (int k = 0; k < D; ++k)
    place[k] = rest * Ring(star_.from()[k]) + time.numerator() * Ring(star_.to()[k]);
  return place;
}

template <int D>
Collision collision_at(const Moving_star<D>& star, std::size_t wall, const Fraction& time,
                       const Exact_point<D>& x, std::vector<Ring> weights) {
  const auto& corners = star.walls()[wall].swept.corners();
  // All points times both denominators.
  std::array<Ring_vector<D>, static_cast<std::size_t>(D)> scaled{Star_clock<D>(star).vertex_at(time)};
  const Ring both = x.denominator * time.denominator();
  for (int k = 0; k < D; ++k) scaled[0][k] = scaled[0][k] * x.denominator;
  for (std::size_t c = 1; c < scaled.size(); ++c)
    for (int k = 0; k < D; ++k) scaled[c][k] = both * Ring(corners[c + 1][k]);
  Ring_vector<D> place = x.numerator;
  for (Ring& coordinate : place) coordinate = coordinate * time.denominator();
  return {time, weights_at(scaled, place), std::move(weights), wall};
}

#define CELLWALK_INSTANTIATE(D)                                                           \
  template class Star_clock<D>;                                                           \
  template Collision collision_at<D>(const Moving_star<D>&, std::size_t, const Fraction&, \
                                     const Exact_point<D>&, std::vector<Ring>);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
