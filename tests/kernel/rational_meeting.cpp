// SPDX-License-Identifier: LGPL-3.0-or-later
#include "kernel/rational_meeting.h"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

namespace cellwalk::test {
namespace {

using Row = std::vector<Fraction>;

/// Solves a linear system by elimination: the last column is the right side. None if there is not exactly one
/// solution.
std::optional<Row> solve(std::vector<Row> rows) {
  const std::size_t unknowns = rows[0].size() - 1;
  std::size_t done = 0;
  for (std::size_t column = 0; column < unknowns; ++column) {
    std::size_t pivot = done;
    while (pivot < rows.size() && rows[pivot][column] == 0) ++pivot;
    if (pivot == rows.size()) return {};
    std::swap(rows[pivot], rows[done]);
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (r == done || rows[r][column] == 0) continue;
      const Fraction factor = rows[r][column] / rows[done][column];
      for (std::size_t c = column; c <= unknowns; ++c) rows[r][c] -= factor * rows[done][c];
    }
    ++done;
  }
  for (std::size_t r = done; r < rows.size(); ++r)
    if (rows[r][unknowns] != 0) return {};
  Row result(unknowns);
  for (std::size_t k = 0; k < unknowns; ++k) result[k] = rows[k][unknowns] / rows[k][k];
  return result;
}

/// Weights, of sum 1, of points that give x; none if there is not exactly one set of them.
template <int D>
std::optional<Row> weights_of(std::span<const Point<D>> points, const Row& x) {
  std::vector<Row> rows;
  for (std::size_t k = 0; k < D; ++k) {
    Row& row = rows.emplace_back();
    for (const Point<D>& p : points) row.emplace_back(p[k]);
    row.push_back(x[k]);
  }
  rows.emplace_back(points.size() + 1, Fraction(1));
  return solve(std::move(rows));
}

template <int D>
Row exact(const Point<D>& x) {
  return {x.begin(), x.end()};
}

template <int D>
Fraction volume(std::span<const Point<D>> points) {
  std::array<std::array<Fraction, 3>, 3> m;
  for (std::size_t i = 0; i < D; ++i)
    for (std::size_t k = 0; k < D; ++k) m[i][k] = Fraction(points[i + 1][k]) - Fraction(points[0][k]);
  Fraction d;
  if (D == 2)
    d = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  else
    for (std::size_t k = 0; k < 3; ++k)
      d += m[0][k] * (m[1][(k + 1) % 3] * m[2][(k + 2) % 3] - m[1][(k + 2) % 3] * m[2][(k + 1) % 3]);
  return d;
}

/// True if the hulls of some points of one set and some of the other have exactly one point in common, which
/// is inside both. By the theorems of Caratheodory and Kirchberger two hulls meet if and only if those of
/// such subsets do.
template <int D>
bool hulls_cross(std::span<const Point<D>> a, unsigned of_a, std::span<const Point<D>> b, unsigned of_b) {
  const auto unknowns = static_cast<std::size_t>(std::popcount(of_a) + std::popcount(of_b));
  std::vector<Row> rows(D + 2, Row());
  const auto add = [&](std::span<const Point<D>> points, unsigned chosen, int sign) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!(chosen >> i & 1)) continue;
      for (std::size_t k = 0; k < D; ++k) rows[k].push_back(sign * Fraction(points[i][k]));
      rows[D].emplace_back(sign > 0);
      rows[D + 1].emplace_back(sign < 0);
    }
  };
  add(a, of_a, 1);
  add(b, of_b, -1);
  for (std::size_t k = 0; k < D + 2; ++k) rows[k].emplace_back(k >= D);
  if (unknowns > D + 2) return false;
  const auto weights = solve(std::move(rows));
  return weights && std::all_of(weights->begin(), weights->end(), [](const Fraction& w) { return w >= 0; });
}

template <int D>
bool hulls_meet(std::span<const Point<D>> a, std::span<const Point<D>> b) {
  for (unsigned of_a = 1; of_a < 1u << a.size(); ++of_a)
    for (unsigned of_b = 1; of_b < 1u << b.size(); ++of_b)
      if (hulls_cross<D>(a, of_a, b, of_b)) return true;
  return false;
}

template <int D>
bool boxes_apart(std::span<const Point<D>> a, std::span<const Point<D>> b) {
  for (std::size_t k = 0; k < D; ++k) {
    const auto less = [k](const Point<D>& x, const Point<D>& y) { return x[k] < y[k]; };
    const auto [low_a, high_a] = std::minmax_element(a.begin(), a.end(), less);
    const auto [low_b, high_b] = std::minmax_element(b.begin(), b.end(), less);
    if ((*high_a)[k] < (*low_b)[k] || (*high_b)[k] < (*low_a)[k]) return true;
  }
  return false;
}

/// The weights of the corners of a simplex of positive volume at x, by volumes.
template <int D>
Row weights_in(std::span<const Point<D>> simplex, const Point<D>& x) {
  std::vector<Point<D>> corners(simplex.begin(), simplex.end());
  Row weights;
  Fraction sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    corners[k] = x;
    weights.push_back(volume<D>(corners));
    corners[k] = simplex[k];
    sum += weights.back();
  }
  for (Fraction& w : weights) w /= sum;
  return weights;
}

/// The corners of the part of a set in a simplex, by their weights in the simplex.
template <int D>
std::vector<Row> part(std::span<const Point<D>> simplex, std::span<const Point<D>> set) {
  std::vector<Row> corners;
  for (const Point<D>& x : set) corners.push_back(weights_in<D>(simplex, x));
  for (std::size_t k = 0; k < simplex.size(); ++k) {
    std::vector<Row> kept;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Row &u = corners[i], &v = corners[(i + 1) % corners.size()];
      if (u[k] >= 0) kept.push_back(u);
      if (!((u[k] < 0 && v[k] > 0) || (u[k] > 0 && v[k] < 0))) continue;
      const Fraction t = u[k] / (u[k] - v[k]);
      Row x(u.size());
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = u[j] + t * (v[j] - u[j]);
      x[k] = 0;
      kept.push_back(x);
    }
    corners = kept;
  }
  return corners;
}

}  // namespace

template <int D>
int volume_sign(std::span<const Point<D>> points) {
  return volume<D>(points).sign();
}

template <int D>
Relation relation(std::span<const Point<D>> simplex, std::span<const Point<D>> set) {
  if (boxes_apart<D>(simplex, set) || !hulls_meet<D>(simplex, set)) return Relation::apart;
  return first_time<D>(simplex, set) ? Relation::hit : Relation::touch;
}

template <int D>
Relation relation_by_clipping(std::span<const Point<D>> simplex, std::span<const Point<D>> set) {
  if (volume_sign<D>(simplex) == 0) return relation<D>(simplex, set);
  if (boxes_apart<D>(simplex, set) || part<D>(simplex, set).empty()) return Relation::apart;
  return first_time<D>(simplex, set) ? Relation::hit : Relation::touch;
}

template <int D>
std::optional<Fraction> first_time(std::span<const Point<D>> simplex, std::span<const Point<D>> set) {
  if (boxes_apart<D>(simplex, set) || volume_sign<D>(simplex) == 0) return {};
  const std::vector<Row> corners = part<D>(simplex, set);
  if (corners.empty()) return {};
  // The middle of the corners lies inside if any point does.
  for (std::size_t k = 0; k < simplex.size(); ++k) {
    Fraction sum = 0;
    for (const Row& x : corners) sum += x[k];
    if (sum <= 0) return {};
  }
  std::optional<Fraction> first;
  for (const Row& x : corners) {
    const Fraction moving = x[0] + x[1];
    if (moving == 0) continue;
    const Fraction time = x[1] / moving;
    if (!first || time < *first) first = time;
  }
  return first;
}

template <int D>
bool meets_off_start(std::span<const Point<D>> simplex, std::span<const Point<D>> set) {
  const std::vector<Row> corners = part<D>(simplex, set);
  return std::any_of(corners.begin(), corners.end(), [](const Row& x) { return x[1] != 0; });
}

std::optional<Fraction> passing_time(const Point<3>& from, const Point<3>& to,
                                     std::span<const Point<3>> triangle) {
  if (boxes_apart<3>(std::array{from, to}, triangle)) return {};
  // from + s (to - from) is a weighted mean of the corners.
  std::vector<Row> rows;
  for (std::size_t k = 0; k < 3; ++k) {
    Row& row = rows.emplace_back(Row{Fraction(from[k]) - Fraction(to[k])});
    for (const Point<3>& x : triangle) row.emplace_back(x[k]);
    row.emplace_back(from[k]);
  }
  rows.push_back({0, 1, 1, 1, 1});
  const auto solution = solve(std::move(rows));
  if (!solution || (*solution)[0] >= 1) return {};
  if (std::any_of(solution->begin(), solution->end(), [](const Fraction& x) { return x <= 0; })) return {};
  return solution->front();
}

template <int D>
bool lies_inside(std::span<const Point<D>> facet, const Point<D>& x) {
  if (boxes_apart<D>(facet, std::span(&x, 1))) return false;
  const auto weights = weights_of<D>(facet, exact<D>(x));
  return weights && std::all_of(weights->begin(), weights->end(), [](const Fraction& w) { return w > 0; });
}

#define CELLWALK_INSTANTIATE(D)                                                                         \
  template Relation relation<D>(std::span<const Point<D>>, std::span<const Point<D>>);                  \
  template Relation relation_by_clipping<D>(std::span<const Point<D>>, std::span<const Point<D>>);      \
  template std::optional<Fraction> first_time<D>(std::span<const Point<D>>, std::span<const Point<D>>); \
  template int volume_sign<D>(std::span<const Point<D>>);                                               \
  template bool meets_off_start<D>(std::span<const Point<D>>, std::span<const Point<D>>);               \
  template bool lies_inside<D>(std::span<const Point<D>>, const Point<D>&);
CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::test
