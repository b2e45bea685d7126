// SPDX-License-Identifier: LGPL-3.0-or-later
// Signs that decide most meetings, and exact clipping of sets in the simplex for the others.
#include <cellwalk/internal/kernel/swept_simplex.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace cellwalk::detail {
namespace {

template <int D>
int orientation(Predicate_counts& counts, const std::array<Point<D>, static_cast<std::size_t>(D) + 1>& x) {
  return std::apply([&](const auto&... p) { return Exact::orientation(counts, p...); }, x);
}

template <int D>
Ring exact_orientation(const std::array<Point<D>, static_cast<std::size_t>(D) + 1>& x) {
  return std::apply([](const auto&... p) { return Exact_value::orientation(p...); }, x);
}

/// A point of a set: the values there of some affine functions, and the weights of the points that span the
/// set. All may have a common factor.
struct Place {
  std::vector<Ring> values, weights;
};
using Part = std::vector<Place>;

/// Keeps the part of a convex set in which value k is not negative.
Part clipped(const Part& part, std::size_t k) {
  Part result;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Place &u = part[i], &v = part[i + 1 == part.size() ? 0 : i + 1];
    const int at_u = CGAL::sign(u.values[k]), at_v = CGAL::sign(v.values[k]);
    if (at_u >= 0) result.push_back(u);
    if (at_u * at_v >= 0) continue;
    const Place &inside = at_u > 0 ? u : v, &outside = at_u > 0 ? v : u;
    const auto between = [&](const std::vector<Ring>& in, const std::vector<Ring>& out) {
      std::vector<Ring> x(in.size());
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = out[j] * inside.values[k] - in[j] * outside.values[k];
      return x;
    };
    result.push_back({between(inside.values, outside.values), between(inside.weights, outside.weights)});
  }
  return result;
}

/// The part of a set in which the first `bounds` values are not negative. values_at(x) are those at a point.
template <int D, class Values_at>
Part part_of(std::span<const Point<D>> feature, std::size_t bounds, const Values_at& values_at) {
  Part part;
  for (std::size_t i = 0; i < feature.size(); ++i) {
    Place& place = part.emplace_back();
    place.values = values_at(feature[i]);
    place.weights.assign(feature.size(), Ring(0));
    place.weights[i] = Ring(1);
  }
  for (std::size_t k = 0; k < bounds && !part.empty(); ++k) part = clipped(part, k);
  return part;
}

/// The part in a simplex of positive volume; the values are the volumes that a point spans with its facets,
/// opposite to each corner.
template <int D>
Part part_in(const std::array<Point<D>, static_cast<std::size_t>(D) + 1>& corners, int sense,
             std::span<const Point<D>> feature) {
  return part_of<D>(feature, corners.size(), [&](const Point<D>& x) {
    std::vector<Ring> volumes;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      auto replaced = corners;
      replaced[k] = x;
      volumes.push_back(exact_orientation<D>(replaced));
      if (sense < 0) volumes.back() = -volumes.back();
    }
    return volumes;
  });
}

/// True if all values number k are 0.
bool are_all_zero(const Part& part, std::size_t k) {
  return std::all_of(part.begin(), part.end(), [k](const Place& x) { return CGAL::is_zero(x.values[k]); });
}

Point<2> drop(const Point<3>& x, std::size_t axis) { return {x[(axis + 1) % 3], x[(axis + 2) % 3]}; }

/// Parts of a set in a simplex of no volume: in each of the segments (2D) or triangles (3D) of its corners
/// that are not degenerate, which cover it. Calls visit(part, beyond): value number `beyond` is 0 at a place
/// if and only if that lies on the point (2D) or line (3D) of the corners that stand still.
template <class Visit>
void for_each_part(const std::array<Point<2>, 3>& corners, std::span<const Point<2>> feature,
                   const Visit& visit) {
  std::size_t axis = 0;
  while (corners[0][axis] == corners[1][axis]) ++axis;
  const auto along = [axis](const Point<2>& u, const Point<2>& x) {
    return Ring(Ring(x[axis]) - Ring(u[axis]));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    Point<2> low = corners[i], high = corners[(i + 1) % 3];
    if (low == high) continue;
    if (low[axis] > high[axis]) std::swap(low, high);
    const Part part = part_of<2>(feature, 4, [&](const Point<2>& x) {
      const Ring off = Exact_value::orientation(corners[0], corners[1], x);
      return std::vector<Ring>{off, -off, along(low, x), -along(high, x), along(corners[2], x)};
    });
    visit(part, 4);
  }
}

template <class Visit>
void for_each_part(const std::array<Point<3>, 4>& corners, std::span<const Point<3>> feature,
                   const Visit& visit) {
  Predicate_counts counts;
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    std::array<Point<3>, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = corners[k < left_out ? k : k + 1];
    std::size_t axis = 0;
    int turn = 0;
    for (; axis < 3 && turn == 0; ++axis)
      turn = Exact::orientation(counts, drop(triangle[0], axis), drop(triangle[1], axis),
                                drop(triangle[2], axis));
    if (turn == 0) continue;
    --axis;
    const auto beside = [&](const Point<3>& u, const Point<3>& v, const Point<3>& x) {
      return Exact_value::orientation(drop(u, axis), drop(v, axis), drop(x, axis));
    };
    const Part part = part_of<3>(feature, 5, [&](const Point<3>& x) {
      const Ring off = Exact_value::orientation(triangle[0], triangle[1], triangle[2], x);
      std::vector<Ring> values{off, -off};
      for (std::size_t k = 0; k < 3; ++k) {
        values.push_back(beside(triangle[k], triangle[(k + 1) % 3], x));
        if (turn < 0) values.back() = -values.back();
      }
      values.push_back(beside(corners[2], corners[3], x));
      return values;
    });
    visit(part, 5);
  }
}

}  // namespace

std::size_t corners_used(const std::vector<Ring>& weights) {
  return static_cast<std::size_t>(
      std::count_if(weights.begin(), weights.end(), [](const Ring& w) { return !CGAL::is_zero(w); }));
}

void keep_first(std::optional<Collision>& first, Collision next) {
  const auto is_before = [](const Collision& a, const Collision& b) {
    if (const auto order = a.time <=> b.time; order != 0) return order < 0;
    return std::pair(corners_used(a.feature_weights), corners_used(a.wall_weights)) <
           std::pair(corners_used(b.feature_weights), corners_used(b.wall_weights));
  };
  if (!first || is_before(next, *first)) first = std::move(next);
}

template <int D>
Swept_simplex<D>::Swept_simplex(const Point<D>& from, const Point<D>& to, const Corners& still,
                                Predicate_counts& counts) {
  corners_[0] = from;
  corners_[1] = to;
  std::copy(still.begin(), still.end(), corners_.begin() + 2);
  for (const Point<D>& corner : corners_) box_.extend(corner);
  sense_ = orientation<D>(counts, corners_);
}

/// The side of x with respect to the facet opposite to a corner: > 0 inside.
template <int D>
int Swept_simplex<D>::side(std::size_t corner, const Point<D>& x, Predicate_counts& counts) const {
  auto replaced = corners_;
  replaced[corner] = x;
  return sense_ * orientation<D>(counts, replaced);
}

/// True proves that all of K lies strictly beside the line (3D of a segment) or plane of the feature.
/// \param is_strict whether no sign was 0
template <int D>
bool Swept_simplex<D>::passes_beside(std::span<const Point<D>> feature, bool& is_strict,
                                     Predicate_counts& counts) const {
  is_strict = true;
  if (D == 3 && feature.size() == 2) {
    if constexpr (D == 3) {
      std::array<std::array<int, 4>, 4> turns{};
      for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = i + 1; j < 4; ++j) {
          turns[i][j] = Exact::orientation(counts, feature[0], feature[1], corners_[i], corners_[j]);
          turns[j][i] = -turns[i][j];
          is_strict &= turns[i][j] != 0;
        }
      // Seen along the line, a corner from which all others lie on one side, as then does the line.
      for (std::size_t i = 0; i < 4; ++i) {
        int sum = 0;
        for (std::size_t j = 0; j < 4; ++j) sum += turns[i][j];
        if (sum == 3 || sum == -3) return true;
      }
      return false;
    }
  }
  int first = 0;
  bool is_beside = true;
  for (const Point<D>& corner : corners_) {
    int s = 0;
    if constexpr (D == 2)
      s = Exact::orientation(counts, feature[0], feature[1], corner);
    else
      s = Exact::orientation(counts, feature[0], feature[1], feature[2], corner);
    is_strict &= s != 0;
    if (first == 0) first = s;
    is_beside &= s != 0 && s == first;
  }
  return is_beside;
}

/// The encounter as far as signs of input points decide it.
/// \pre K is not flat
template <int D>
Encounter Swept_simplex<D>::by_signs(std::span<const Point<D>> feature, Predicate_counts& counts,
                                     bool& is_certain) const {
  is_certain = true;
  bool is_strict = true, has_inside = false;
  std::vector<int> least(feature.size(), 1);
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    bool is_outside = true;
    for (std::size_t i = 0; i < feature.size(); ++i) {
      const int s = side(k, feature[i], counts);
      is_outside &= s < 0;
      is_strict &= s != 0;
      least[i] = std::min(least[i], s);
    }
    if (is_outside) return Encounter::apart;
  }
  for (const int s : least) has_inside |= s > 0;
  if (has_inside) return Encounter::hit;
  if (feature.size() == 1) return Encounter::touch;
  bool is_line_strict = false;
  if (passes_beside(feature, is_line_strict, counts)) return Encounter::apart;
  // The line of a segment passes the inside of K. No end lies in the plane of a facet, and no facet has both
  // ends outside: so they are not both before the line enters K, nor both behind.
  if (feature.size() == 2 && is_strict && is_line_strict) return Encounter::hit;
  is_certain = false;
  return Encounter::touch;
}

template <int D>
Encounter Swept_simplex<D>::meet(std::span<const Point<D>> feature, Predicate_counts& counts) const {
  Box<D> box;
  for (const Point<D>& x : feature) box.extend(x);
  if (!box_.meets(box)) return Encounter::apart;
  if (is_flat()) {
    bool is_met = false;
    for_each_part(corners_, feature, [&](const Part& part, std::size_t) { is_met |= !part.empty(); });
    return is_met ? Encounter::touch : Encounter::apart;
  }
  bool is_certain = false;
  const Encounter meeting = by_signs(feature, counts, is_certain);
  if (is_certain) return meeting;
  const Part part = part_in<D>(corners_, sense_, feature);
  if (part.empty()) return Encounter::apart;
  for (std::size_t k = 0; k < corners_.size(); ++k)
    if (are_all_zero(part, k)) return Encounter::touch;
  return Encounter::hit;
}

template <int D>
Collision Swept_simplex<D>::first_hit(std::span<const Point<D>> feature) const {
  std::optional<Collision> first;
  for (const Place& x : part_in<D>(corners_, sense_, feature)) {
    const Ring moving = x.values[0] + x.values[1];
    if (CGAL::is_zero(moving)) continue;
    std::vector<Ring> wall_weights{moving};
    wall_weights.insert(wall_weights.end(), x.values.begin() + 2, x.values.end());
    keep_first(first, {Fraction(x.values[1], moving), std::move(wall_weights), x.weights});
  }
  return *first;
}

template <int D>
bool Swept_simplex<D>::leaves(std::span<const Point<D>> feature) const {
  if (is_flat()) return false;
  const Part part = part_in<D>(corners_, sense_, feature);
  return are_all_zero(part, 1) &&
         std::none_of(part.begin(), part.end(), [](const Place& x) { return CGAL::is_zero(x.values[0]); });
}

/// True proves that the set meets K only in the wall as it starts, or in the hull of its still corners: a
/// plane parts them weakly, and the part in it of the set, or of K, is no more than that.
/// \pre K is not flat
template <int D>
bool Swept_simplex<D>::is_surely_left(std::span<const Point<D>> feature, Predicate_counts& counts) const {
  const auto is_still = [&](const Point<D>& x) {
    return std::find(corners_.begin() + 2, corners_.end(), x) != corners_.end();
  };
  for (std::size_t k = 0; k < corners_.size(); ++k)
    if (std::all_of(feature.begin(), feature.end(), [&](const Point<D>& x) {
          if (x != corners_[k] && is_still(x)) return true;
          const int s = side(k, x, counts);
          return s < 0 || (s == 0 && k == 1);
        }))
      return true;
  if (feature.size() < D) return false;
  int own = 0;
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    if (std::find(feature.begin(), feature.end(), corners_[k]) != feature.end()) {
      if (k == 1) return false;
      continue;
    }
    int s = 0;
    if constexpr (D == 2)
      s = Exact::orientation(counts, feature[0], feature[1], corners_[k]);
    else
      s = Exact::orientation(counts, feature[0], feature[1], feature[2], corners_[k]);
    if (s * own < 0 || (s == 0 && k == 1)) return false;
    if (s != 0) own = s;
  }
  return own != 0;
}

template <int D>
bool Swept_simplex<D>::reaches(std::span<const Point<D>> feature, Predicate_counts& counts) const {
  Box<D> box;
  for (const Point<D>& x : feature) box.extend(x);
  if (!box_.meets(box)) return false;
  if (is_flat()) {
    bool result = false;
    for_each_part(corners_, feature,
                  [&](const Part& part, std::size_t beyond) { result |= !are_all_zero(part, beyond); });
    return result;
  }
  if (is_surely_left(feature, counts)) return false;
  bool is_certain = false;
  const Encounter meeting = by_signs(feature, counts, is_certain);
  if (is_certain && meeting != Encounter::touch) return meeting == Encounter::hit;
  // Where its second volume is 0, a point lies in the wall as that starts.
  return !are_all_zero(part_in<D>(corners_, sense_, feature), 1);
}

template class Swept_simplex<2>;
template class Swept_simplex<3>;

}  // namespace cellwalk::detail
