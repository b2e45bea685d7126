// SPDX-License-Identifier: LGPL-3.0-or-later
// The qualities of the simplices at a point, and the best of several places for it.
#include "star_smoother.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cellwalk::detail {
namespace {

constexpr std::uint32_t no_simplex = 0xffffffffu;
/// Shares of the ways to the middle of the neighbours, and off the facet opposite, that are tried.
constexpr int tried_halvings = 5;

/// The volume times D!, positive for a simplex in positive order.
double determinant(const std::array<Point<2>, 3>& p) {
  const Vector<2> u = p[1] - p[0], v = p[2] - p[0];
  return u[0] * v[1] - u[1] * v[0];
}

double determinant(const std::array<Point<3>, 4>& p) {
  return dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
}

template <int D>
double quality_of(const std::array<Point<D>, D + 1>& p) {
  double squares = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vector<D> edge = p[i] - p[j];
      squares += dot(edge, edge);
    }
  constexpr double edge_count = D == 2 ? 3 : 6;
  const double mean = squares / edge_count;
  if (!(mean > 0)) return 0;
  if constexpr (D == 2)
    return 2 / std::sqrt(3.0) * determinant(p) / mean;
  else
    return std::sqrt(2.0) * determinant(p) / (mean * std::sqrt(mean));
}

/// The corners of a cell in positive order; false if it is no simplex.
template <int D>
bool corners_of(const Snapshot<D>& snapshot, Cell cell, std::array<std::uint32_t, D + 1>& corners) {
  if (snapshot.facet_count(cell) != D + 1) return false;
  const std::vector<std::uint32_t> base = snapshot.loop(snapshot.half_facet(cell, 0));
  const std::vector<std::uint32_t> side = snapshot.loop(snapshot.half_facet(cell, 1));
  if (base.size() != D) return false;
  const auto top =
      std::ranges::find_if(side, [&](std::uint32_t v) { return std::ranges::find(base, v) == base.end(); });
  if (top == side.end()) return false;
  std::copy(base.begin(), base.end(), corners.begin());
  corners[D] = *top;
  // In 3D loops turn to the left as seen from outside, and the top lies behind.
  if (D == 3) std::swap(corners[0], corners[1]);
  return true;
}

}  // namespace

template <int D>
Star_smoother<D>::Star_smoother(const Snapshot<D>& snapshot, std::vector<char> may_move)
    : may_move_(std::move(may_move)) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (cell == Cell::none) continue;
    Simplex simplex;
    if (corners_of(snapshot, cell, simplex)) {
      simplices_.push_back(simplex);
      continue;
    }
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f)
      for (const std::uint32_t v : snapshot.loop(snapshot.half_facet(cell, f))) may_move_[v] = 0;
  }
  first_.assign(may_move_.size() + 1, 0);
  for (const Simplex& simplex : simplices_)
    for (const std::uint32_t v : simplex) ++first_[v + 1];
  for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
  around_.resize(first_.back());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t s = 0; s < simplices_.size(); ++s)
    for (const std::uint32_t v : simplices_[s]) around_[next[v]++] = s;
}

template <int D>
double Star_smoother<D>::quality(const Simplex& simplex, const std::vector<Point<D>>& places,
                                 std::uint32_t moved, const Point<D>& x) const {
  std::array<Point<D>, D + 1> p;
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = simplex[k] == moved ? x : places[simplex[k]];
  return quality_of<D>(p);
}

template <int D>
double Star_smoother<D>::least_at(std::uint32_t point, const Point<D>& x, const std::vector<Point<D>>& places,
                                  std::uint32_t* worst) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = first_[point]; k < first_[point + 1]; ++k) {
    const double q = quality(simplices_[around_[k]], places, point, x);
    if (!(q < least)) continue;
    least = q;
    if (worst) *worst = around_[k];
  }
  return least;
}

/// The best of some places towards the middle of the neighbours and off the facet opposite in the worst
/// simplex, if it is better.
template <int D>
bool Star_smoother<D>::improve(std::uint32_t point, std::vector<Point<D>>& places, double floor) const {
  const Point<D> from = places[point];
  std::uint32_t worst = no_simplex;
  double best = least_at(point, from, places, &worst);
  if (!(best < floor)) return false;
  Vector<D> sum{};
  std::size_t count = 0;
  double height = 0;
  Vector<D> off{};  // unit, off the facet opposite
  for (std::size_t k = first_[point]; k < first_[point + 1]; ++k)
    for (const std::uint32_t v : simplices_[around_[k]])
      if (v != point) {
        sum = sum + (places[v] - from);
        ++count;
        height = std::max(height, length(places[v] - from));
      }
  // The gradient of the volume is perpendicular to the facet opposite.
  const double step = 1e-3 * height;
  for (std::size_t k = 0; k < D; ++k) {
    Point<D> there = from, back = from;
    there[k] += step, back[k] -= step;
    off[k] =
        quality(simplices_[worst], places, point, there) - quality(simplices_[worst], places, point, back);
  }
  const double size = length(off);
  const Vector<D> to_middle = (1.0 / static_cast<double>(count)) * sum;
  Point<D> place = from;
  const auto consider = [&](const Point<D>& x) {
    const double q = least_at(point, x, places);
    if (q > best) best = q, place = x;
  };
  for (int k = 0; k < tried_halvings; ++k) {
    const double share = std::ldexp(1.0, -k);
    consider(from + share * to_middle);
    if (size > 0) consider(from + (share * height / size) * off);
  }
  if (size > 0)
    for (int k = tried_halvings; k < 2 * tried_halvings; ++k)
      consider(from + (std::ldexp(1.0, -k) * height / size) * off);
  if (place == from) return false;
  places[point] = place;
  return true;
}

template <int D>
std::vector<char> Star_smoother<D>::smooth(std::vector<Point<D>>& places, int sweeps, double floor) const {
  std::vector<char> moved(places.size(), 0);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    bool gets_on = false;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::size_t v = sweep % 2 == 0 ? i : places.size() - 1 - i;
      if (!may_move_[v] || first_[v] == first_[v + 1]) continue;
      if (improve(static_cast<std::uint32_t>(v), places, floor)) moved[v] = 1, gets_on = true;
    }
    if (!gets_on) break;
  }
  return moved;
}

template <int D>
double Star_smoother<D>::least_quality(const std::vector<Point<D>>& places) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Simplex& simplex : simplices_)
    least = std::min(least, quality(simplex, places, simplex[0], places[simplex[0]]));
  return least;
}

template class Star_smoother<2>;
template class Star_smoother<3>;

}  // namespace cellwalk::detail
