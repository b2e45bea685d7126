// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells near an edge while a vertex of the environment moves, in rational numbers: for the oracle that
// follows the definition.
#ifndef CELLWALK_TESTS_RESHAPE_NEAR_CELLS_H
#define CELLWALK_TESTS_RESHAPE_NEAR_CELLS_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <vector>

#include "edge/integer_scale.h"
#include "reshape/definition_oracle.h"

namespace cellwalk::test {

template <int D>
using Place = std::array<Fraction, static_cast<std::size_t>(D)>;

/// \param exponent of the power of two by which the place is scaled
template <int D>
Place<D> exact_place(const Point<D>& x, int exponent) {
  Place<D> result;
  for (int k = 0; k < D; ++k) result[k] = Fraction(std::ldexp(x[k], exponent));
  return result;
}

/// The volume that D+1 points span.
inline Fraction volume(const std::array<Place<2>, 3>& x) {
  return (x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[1][1] - x[0][1]) * (x[2][0] - x[0][0]);
}

inline Fraction volume(const std::array<Place<3>, 4>& x) {
  std::array<Place<3>, 3> e;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) e[i][k] = x[i + 1][k] - x[0][k];
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/// An affine function of time.
struct Affine_function {
  Fraction at_0, at_1;
  Fraction operator()(const Fraction& t) const { return at_0 + t * (at_1 - at_0); }
};

inline void add_root_in_time(std::set<Fraction>& times, const Affine_function& f) {
  if (f.at_0.sign() * f.at_1.sign() < 0) times.insert(Fraction(f.at_0 / (f.at_0 - f.at_1)));
}

/// A cell with the volumes that p and q span with its facets, opposite to its corners, positive inside.
template <int D>
struct Near_cell {
  Cell cell = Cell::none;
  std::array<Affine_function, static_cast<std::size_t>(D) + 1> at_p, at_q;
  std::array<int, static_cast<std::size_t>(D) + 1>
      neighbour{};  ///< over these facets; -1 if none near, or wall
  std::array<Half_facet, static_cast<std::size_t>(D) + 1> facet{};
};

struct Interval {
  Fraction low = 0, high = 1;
  bool is_empty() const { return high < low; }
};

inline void keep_positive(Interval& part, const Fraction& at_p, const Fraction& at_q) {
  if (at_p.sign() >= 0 && at_q.sign() >= 0) return;
  if (at_p.sign() < 0 && at_q.sign() < 0) {
    part = {1, 0};
    return;
  }
  const Fraction root = at_p / (at_p - at_q);
  if (at_p.sign() < 0)
    part.low = std::max(part.low, root);
  else
    part.high = std::min(part.high, root);
}

template <int D>
class Near {
 public:
  Near(const Wall_motion<D>& motion, const Point<D>& p, const Point<D>& q) : motion_(motion), p_(p), q_(q) {
    const Snapshot<D>& snapshot = motion.snapshot;
    std::map<Cell, int> numbers;
    Integer_scale scale;
    scale.add<static_cast<std::size_t>(D)>(std::array{p, q, motion.from, motion.to});
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell c = snapshot.cell(i);
      if (c == Cell::none || snapshot.is_solid(c) || !may_meet(c)) continue;
      const auto number = static_cast<int>(numbers.size());
      numbers.emplace(c, number);
      for (const std::uint32_t v : snapshot.view(c).vertices)
        scale.add<static_cast<std::size_t>(D)>(std::span(&snapshot.point(v), 1));
    }
    exponent_ = scale.exponent();
    cells.resize(numbers.size());
    for (const auto& [c, number] : numbers) cells[static_cast<std::size_t>(number)] = near_cell(c);
    for (Near_cell<D>& cell : cells)
      for (std::size_t k = 0; k <= D; ++k) {
        const Half_facet f = cell.facet[k];
        const auto next = snapshot.is_impassable(f) ? numbers.end() : numbers.find(snapshot.neighbour(f));
        cell.neighbour[k] = next == numbers.end() ? -1 : next->second;
      }
  }

  int number_of(Cell c) const {
    for (std::size_t k = 0; k < cells.size(); ++k)
      if (cells[k].cell == c) return static_cast<int>(k);
    return -1;
  }

  /// All times at which something may change, 0 and 1 included.
  std::set<Fraction> times() const {
    std::set<Fraction> times{0, 1};
    for (const Near_cell<D>& cell : cells)
      for (std::size_t k = 0; k <= D; ++k) {
        add_root_in_time(times, cell.at_p[k]);
        add_root_in_time(times, cell.at_q[k]);
      }
    add_turns(times);
    return times;
  }

  std::vector<Near_cell<D>> cells;

 private:
  bool may_meet(Cell c) const {
    const Cell_view<D> view = motion_.snapshot.view(c);
    for (int k = 0; k < D; ++k) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      const auto extend = [&](double x) {
        low = std::min(low, x);
        high = std::max(high, x);
      };
      for (const std::uint32_t v : view.vertices) {
        if (v == motion_.vertex) {
          extend(motion_.from[k]);
          extend(motion_.to[k]);
        } else {
          extend(motion_.snapshot.point(v)[k]);
        }
      }
      if (high < std::min(p_[k], q_[k]) || low > std::max(p_[k], q_[k])) return false;
    }
    return true;
  }

  Near_cell<D> near_cell(Cell c) const {
    const Snapshot<D>& snapshot = motion_.snapshot;
    const Cell_view<D> view = snapshot.view(c);
    if (view.vertices.size() != D + 1) throw std::logic_error("not a simplex");
    Near_cell<D> result;
    result.cell = c;
    const auto corners_at = [&](const Point<D>& place) {
      std::array<Place<D>, static_cast<std::size_t>(D) + 1> corners;
      for (std::size_t k = 0; k <= D; ++k)
        corners[k] = exact(view.vertices[k] == motion_.vertex ? place : snapshot.point(view.vertices[k]));
      return corners;
    };
    const bool moves = std::ranges::find(view.vertices, motion_.vertex) != view.vertices.end();
    const auto before = corners_at(motion_.from), after = corners_at(motion_.to);
    const int sense = volume(before).sign();
    const auto function = [&](std::size_t k, const Point<D>& x) {
      auto u = before, v = after;
      u[k] = v[k] = exact(x);
      const Fraction at_0 = sense * volume(u);
      return Affine_function{at_0, moves ? Fraction(sense * volume(v)) : at_0};
    };
    for (std::size_t k = 0; k <= D; ++k) {
      result.at_p[k] = function(k, p_);
      result.at_q[k] = p_ == q_ ? result.at_p[k] : function(k, q_);
      for (std::size_t i = 0; i < view.facet_count(); ++i) {
        const Half_facet f = Snapshot<D>::half_facet(c, i);
        const auto loop = snapshot.loop(f);
        if (std::ranges::find(loop, view.vertices[k]) == loop.end()) result.facet[k] = f;
      }
    }
    return result;
  }

  /// When the line pq passes edges at the vertex (2D: the vertex), or, where all lies in a plane or on a
  /// line, their images in planes and on axes.
  void add_turns(std::set<Fraction>& times) const {
    const auto v0 = exact(motion_.from), v1 = exact(motion_.to), p = exact(p_), q = exact(q_);
    if constexpr (D == 2) {
      add_root_in_time(times, {volume({p, q, v0}), volume({p, q, v1})});
    } else {
      std::set<std::uint32_t> link;
      for (const Near_cell<D>& cell : cells) {
        const auto vertices = motion_.snapshot.view(cell.cell).vertices;
        if (std::ranges::find(vertices, motion_.vertex) != vertices.end())
          link.insert(vertices.begin(), vertices.end());
      }
      for (const std::uint32_t u : link) {
        if (u == motion_.vertex) continue;
        const auto a = exact(motion_.snapshot.point(u));
        add_root_in_time(times, {volume({p, q, v0, a}), volume({p, q, v1, a})});
        if (volume({p, q, v0, a}).sign() != 0 || volume({p, q, v1, a}).sign() != 0) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const auto flat = [axis](const Place<3>& x) {
            return Place<2>{x[(axis + 1) % 3], x[(axis + 2) % 3]};
          };
          const auto add = [&](const Place<3>& x, const Place<3>& y) {
            add_root_in_time(times,
                             {volume({flat(x), flat(y), flat(v0)}), volume({flat(x), flat(y), flat(v1)})});
          };
          add(p, q);
          add(p, a);
          add(q, a);
        }
      }
    }
    for (std::size_t k = 0; k < D; ++k)
      for (const auto& x : {p, q}) add_root_in_time(times, {v0[k] - x[k], v1[k] - x[k]});
  }

  Place<D> exact(const Point<D>& x) const { return exact_place<D>(x, exponent_); }

  const Wall_motion<D>& motion_;
  const Point<D> p_, q_;
  int exponent_ = 0;  ///< of the power of two that makes all coordinates integers
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_NEAR_CELLS_H
