// SPDX-License-Identifier: LGPL-3.0-or-later
// Bends transported along the links, and the passes of the relaxation.
#include "rod_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cellwalk::detail {
namespace {

/// Passes of a relaxation: in one step a bend is felt at this distance in links, and the rest of it goes in
/// the steps that follow.
constexpr int relaxation_passes = 12;

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

/// A direction turned by an angle towards another one across it.
template <std::size_t D>
std::array<double, D> bent(const std::array<double, D>& v, const std::array<double, D>& across,
                           double angle) {
  return std::cos(angle) * v + std::sin(angle) * across;
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
  const Vector<3> across = normalized(axis - dot(axis, guide) * guide, axis);
  return std::cos(twist) * across + std::sin(twist) * cross(guide, across);
}

}  // namespace

template <int D>
std::size_t Rod_state<D>::count(std::size_t vertices) const {
  std::size_t n = 0;
  while (n < vertices && has_entered(n)) ++n;
  return n;
}

template <int D>
Point<D> Rod_state<D>::before(std::span<const Point<D>> vertices, std::size_t i) const {
  return i + 1 < vertices.size() && has_entered(i + 1) ? vertices[i + 1] : entry;
}

template <int D>
double Rod_state<D>::rest_before(std::size_t vertices, std::size_t i) const {
  return i + 1 < vertices && has_entered(i + 1) ? rest(i + 1) : 0;
}

template <int D>
Vector<D> Rod_state<D>::tangent(std::span<const Point<D>> vertices, std::size_t i) const {
  return i < vertices.size() && has_entered(i) ? normalized(vertices[i] - before(vertices, i), direction)
                                               : direction;
}

template <int D>
void push_along(const Rod_state<D>& state, const Vector<D>& heading, double most,
                std::span<Point<D>> vertices) {
  const std::size_t count = state.count(vertices.size());
  const std::vector<Point<D>> before(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(count));
  // From the base on: how far along the chain each vertex is.
  std::vector<double> at(count);
  double sum = 0;
  for (std::size_t i = count; i-- > 0;) {
    sum += length(before[i] - state.before(vertices, i));
    at[i] = sum;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double place = at[i] + std::clamp(state.rest(i) - at[i], 0.0, most);
    std::size_t k = i;  // the vertex before which the place is
    while (k > 0 && at[k - 1] <= place) --k;
    const Vector<D> towards = k == 0 ? heading : normalized(before[k - 1] - before[k], heading);
    vertices[i] = before[k] + (place - at[k]) * towards;
  }
}

template <int D>
std::vector<Vector<D>> curve_directions(const Rod_state<D>& state, double twist,
                                        std::span<const Point<D>> vertices) {
  const std::size_t count = state.count(vertices.size());
  std::vector<Vector<D>> result(count + 1);
  Vector<D> tangent = state.direction;
  result[count] = base_direction(tangent, twist);
  for (std::size_t i = count; i-- > 0;) {
    const Vector<D> next = state.tangent(vertices, i);
    result[i] = transported(result[i + 1], tangent, next);
    tangent = next;
  }
  return result;
}

template <int D>
void bend_tip(const Rod_state<D>& before, double twist_before, std::span<const Point<D>> old,
              const Rod_state<D>& state, const Natural_bend<D>& bend, std::span<Point<D>> vertices) {
  const std::size_t count = state.count(vertices.size()), count_before = before.count(old.size());
  std::size_t last = 1;  // the first vertex, from the tip on, that is straight by nature
  while (last < count && bend.angle(last, state.spacing) > 0) ++last;
  if (last < 2) return;
  // The bend of each vertex beside its natural one, before. It stays where it is while vertices go on by part
  // of a link.
  const std::vector<Vector<D>> across = curve_directions<D>(before, twist_before, old);
  std::vector<Vector<D>> excess(last + 1, Vector<D>{});
  // At the entry the guide holds the rod straight.
  const auto natural = [&](std::size_t i, std::size_t inside) {
    return i < inside ? bend.angle(i, state.spacing) : 0;
  };
  for (std::size_t i = 1; i <= std::min(last, count_before); ++i)
    excess[i] =
        before.tangent(old, i - 1) - bent(before.tangent(old, i), across[i], natural(i, count_before));
  const double share = std::clamp((state.inside - before.inside) / state.spacing, 0.0, 1.0);
  Vector<D> tangent = state.tangent(vertices, last);
  Vector<D> side = curve_directions<D>(state, bend.twist, vertices)[last];
  for (std::size_t i = last; i > 0; --i) {
    const Vector<D> from_walls = (1 - share) * excess[i] + share * excess[i - 1];
    const Vector<D> next = normalized(bent(tangent, side, natural(i, count)) + from_walls, tangent);
    side = transported(side, tangent, next);
    tangent = next;
    vertices[i - 1] = state.before(vertices, i - 1) +
                      (state.rest(i - 1) - state.rest_before(vertices.size(), i - 1)) * tangent;
  }
}

namespace {

/// The constants of a vertex between two links in the passes of a relaxation.
struct Joint {
  double t, one_less_t;        ///< the share of the second end in the place of the vertex on a line
  double first, second, step;  ///< shares of the ends in a correction, and its size
  double angle, cosine, sine;  ///< of half the natural bend
  double inwards;              ///< the distance from the line where it is bent by nature
  bool is_free;                ///< some of the three vertices may move
};

/// The same, of a link.
struct Link {
  double rest, first, second;  ///< its length, and whether its ends move, 0 or 1
  double share;                ///< of each end that moves
};

}  // namespace

template <int D>
void relax(const Rod_state<D>& state, const Natural_bend<D>& bend, std::span<Point<D>> vertices) {
  const std::size_t count = state.count(vertices.size());
  if (count == 0) return;
  const std::vector<Vector<D>> across = curve_directions<D>(state, bend.twist, vertices);
  // The entry and a point of the guide follow, which never move.
  std::vector<Point<D>> points(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(count));
  points.push_back(state.entry);
  points.push_back(state.entry - state.spacing * state.direction);
  const auto weight = [&](std::size_t i) { return i >= count || (i == 0 && bend.holds_tip) ? 0.0 : 1.0; };
  std::vector<Link> links(count + 1);
  for (std::size_t i = 0; i <= count; ++i) {
    const double rest = i < count ? state.rest(i) - state.rest_before(vertices.size(), i) : state.spacing;
    const double sum = weight(i) + weight(i + 1);
    links[i] = {rest, weight(i), weight(i + 1), sum > 0 ? 1 / sum : 0};
  }
  std::vector<Joint> joints(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double la = links[i].rest, lb = links[i + 1].rest, t = la / (la + lb);
    const double sum = weight(i) * (1 - t) * (1 - t) + weight(i + 2) * t * t + weight(i + 1);
    const double angle = i + 1 < count ? bend.angle(i + 1, state.spacing) : 0;
    joints[i] = {t,
                 1 - t,
                 weight(i) * (1 - t),
                 weight(i + 2) * t,
                 bend.stiffness / sum,
                 angle,
                 std::cos(angle / 2),
                 std::sin(angle / 2),
                 2 * la * lb / (la + lb) * std::sin(angle / 2),
                 sum > 0};
  }
  const auto straighten = [&](std::size_t i) {
    // The middle one of three vertices should lie on the line through the others, but for its natural bend.
    const Joint& joint = joints[i];
    Point<D>&a = points[i], &m = points[i + 1], &b = points[i + 2];
    Vector<D> off = joint.one_less_t * a + joint.t * b - m;
    if (joint.angle > 0) {
      const Vector<D> back = -1.0 * normalized(m - b, state.direction);
      off = off - joint.inwards * (joint.cosine * across[i + 1] + joint.sine * back);
    }
    if (!joint.is_free) return;
    const Vector<D> change = joint.step * off;
    a = a - joint.first * change;
    b = b - joint.second * change;
    m = m + links[i].second * change;
  };
  const auto stretch = [&](std::size_t i) {
    const Link& link = links[i];
    Point<D>&a = points[i], &b = points[i + 1];
    const Vector<D> way = a - b;
    const double now = length(way);
    if (!(now > 0) || !(link.share > 0)) return;
    const Vector<D> change = ((now - link.rest) / now * link.share) * way;
    a = a - link.first * change;
    b = b + link.second * change;
  };
  for (int pass = 0; pass < relaxation_passes; ++pass) {
    for (std::size_t i = count; i-- > 0;) straighten(i);
    for (std::size_t i = count; i-- > 0;) stretch(i);
  }
  std::copy_n(points.begin(), count, vertices.begin());
}

#define CELLWALK_INSTANTIATE(D)                                                                             \
  template struct Rod_state<D>;                                                                             \
  template void push_along(const Rod_state<D>&, const Vector<D>&, double, std::span<Point<D>>);             \
  template std::vector<Vector<D>> curve_directions(const Rod_state<D>&, double, std::span<const Point<D>>); \
  template void bend_tip(const Rod_state<D>&, double, std::span<const Point<D>>, const Rod_state<D>&,       \
                         const Natural_bend<D>&, std::span<Point<D>>);                                      \
  template void relax(const Rod_state<D>&, const Natural_bend<D>&, std::span<Point<D>>);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
