// SPDX-License-Identifier: LGPL-3.0-or-later
#include "chain.h"

#include <algorithm>
#include <cmath>

namespace cellwalk::detail {
namespace {

/// Passes of a relaxation: a bend is felt so many links away in one step.
constexpr int passes = 12;

/// Takes a vector across one direction to one across another, by the least rotation.
Vector<2> transported(const Vector<2>& v, const Vector<2>& from, const Vector<2>& to) {
  const double c = dot(from, to), s = from[0] * to[1] - from[1] * to[0];
  return {c * v[0] - s * v[1], s * v[0] + c * v[1]};
}
Vector<3> transported(const Vector<3>& v, const Vector<3>& from, const Vector<3>& to) {
  const double c = dot(from, to);
  if (!(c > -1 + 1e-9)) return v;  // turned right back: across both
  const Vector<3> axis = cross(from, to);
  return c * v + cross(axis, v) + (dot(axis, v) / (1 + c)) * axis;
}

/// Across the guide, turned by the twist.
Vector<2> base_direction(const Vector<2>& guide, double twist) {
  return std::cos(twist) * Vector<2>{-guide[1], guide[0]};
}
Vector<3> base_direction(const Vector<3>& guide, double twist) {
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k)
    if (std::abs(guide[k]) < std::abs(guide[least])) least = k;
  Vector<3> axis{};
  axis[least] = 1;
  const Vector<3> across = unit(axis - dot(axis, guide) * guide, axis);
  return std::cos(twist) * across + std::sin(twist) * cross(guide, across);
}

}  // namespace

template <int D>
std::size_t Chain_state<D>::count(std::size_t vertices) const {
  std::size_t n = 0;
  while (n < vertices && rest(n) > 0) ++n;
  return n;
}

template <int D>
void push_along(const Chain_state<D>& state, const Vector<D>& heading, double most,
                std::span<Point<D>> vertices) {
  const std::size_t count = state.count(vertices.size());
  const std::vector<Point<D>> before(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(count));
  // From the base on: how far along the chain each vertex is.
  std::vector<double> at(count);
  double sum = 0;
  for (std::size_t i = count; i-- > 0;) {
    sum += length(before[i] - (i + 1 < count ? before[i + 1] : state.entry));
    at[i] = sum;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double place = at[i] + std::clamp(state.rest(i) - at[i], 0.0, most);
    std::size_t k = i;  // the vertex before which the place is
    while (k > 0 && at[k - 1] <= place) --k;
    const double over = place - at[k];
    const Vector<D> towards = k == 0 ? heading : unit(before[k - 1] - before[k], heading);
    vertices[i] = before[k] + over * towards;
  }
}

template <int D>
std::vector<Vector<D>> curve_directions(const Chain_state<D>& state, double twist,
                                        std::span<const Point<D>> vertices) {
  std::vector<Vector<D>> result(state.count(vertices.size()));
  Vector<D> tangent = state.direction, across = base_direction(tangent, twist);
  for (std::size_t i = result.size(); i-- > 0;) {
    const Point<D>& before = i + 1 < result.size() ? vertices[i + 1] : state.entry;
    const Vector<D> next = unit(vertices[i] - before, tangent);
    across = transported(across, tangent, next);
    tangent = next;
    result[i] = across;
  }
  return result;
}

template <int D>
void relax(const Chain_state<D>& state, const Natural_bend<D>& bend, std::span<Point<D>> vertices) {
  const std::size_t count = state.count(vertices.size());
  if (count == 0) return;
  const std::vector<Vector<D>> across = curve_directions<D>(state, bend.twist, vertices);
  Point<D> entry = state.entry, guide = state.entry - state.spacing * state.direction;  // never moved
  const auto vertex = [&](std::size_t i) -> Point<D>& { return i < count ? vertices[i] : i == count ? entry : guide; };
  const auto is_held = [&](std::size_t i) { return i >= count || (i == 0 && bend.holds_tip); };
  const auto rest = [&](std::size_t i) {  // of the link from i to i + 1
    return i + 1 == count ? state.rest(i) : state.spacing;
  };
  for (int pass = 0; pass < passes; ++pass) {
    // Bends at the vertices between i and i + 2. Each should lie on the line through its neighbours, but for the curvature.
    for (std::size_t i = count; i-- > 0;) {
      Point<D>&a = vertex(i), &m = vertex(i + 1), &b = vertex(i + 2);
      const double la = rest(i), lb = rest(i + 1), t = la / (la + lb);
      Vector<D> off = (1 - t) * a + t * b - m;
      // A curved piece of the middle vertex: its chord lies la lb / 2 times the curvature towards the inside.
      const double from_tip = static_cast<double>(i + 1) * state.spacing;
      if (i + 1 < count && from_tip < bend.length) off = off - (0.5 * la * lb * bend.curvature) * across[i + 1];
      const double wa = is_held(i) ? 0 : 1, wm = is_held(i + 1) ? 0 : 1, wb = is_held(i + 2) ? 0 : 1;
      const double weight = wa * (1 - t) * (1 - t) + wb * t * t + wm;
      if (!(weight > 0)) continue;
      const Vector<D> change = (bend.stiffness / weight) * off;
      a = a - (wa * (1 - t)) * change;
      b = b - (wb * t) * change;
      m = m + wm * change;
    }
    for (std::size_t i = count; i-- > 0;) {
      Point<D>&a = vertex(i), &b = vertex(i + 1);
      const Vector<D> link = a - b;
      const double now = length(link), wa = is_held(i) ? 0 : 1, wb = is_held(i + 1) ? 0 : 1;
      if (!(now > 0) || !(wa + wb > 0)) continue;
      const Vector<D> change = ((now - rest(i)) / now / (wa + wb)) * link;
      a = a - wa * change;
      b = b + wb * change;
    }
  }
}

#define CELLWALK_INSTANTIATE(D)                                                                           \
  template struct Chain_state<D>;                                                                         \
  template void push_along(const Chain_state<D>&, const Vector<D>&, double, std::span<Point<D>>);         \
  template std::vector<Vector<D>> curve_directions(const Chain_state<D>&, double, std::span<const Point<D>>); \
  template void relax(const Chain_state<D>&, const Natural_bend<D>&, std::span<Point<D>>);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
