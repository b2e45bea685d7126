// SPDX-License-Identifier: LGPL-3.0-or-later
// The number of turns of cells around a ridge, by signs only.
//
// A fan is a ridge with the cells around it that are joined through facets that contain it, walls included.
// Its facets are rays of a half-turn scale: each lies in one of four classes relative to the first, in the
// same direction, to the left of it, opposite, or to the right. From one facet to the next a convex cell
// turns by more than 0 and at most half a turn. Therefore the classes show when a full turn is completed: at
// the step from {opposite, right} to {same, left}.
#include <algorithm>
#include <atomic>
#include <vector>

#include "complex.h"
#include "polygon.h"

namespace cellwalk::detail {
namespace {

/// A vertex in 2D, or the two ends of an edge in 3D, in the direction of the facet of the first cell.
template <int D>
using Ridge = std::array<std::uint32_t, D - 1>;

template <int D>
struct Fan {
  Cell lowest;                      ///< cell of the fan with the lowest input index
  bool is_closed = false;           ///< inner ridge: the first facet is the last
  std::vector<std::uint32_t> rays;  ///< per facet, in turning order: a vertex off the ridge
};

/// Examines the fans of a complex.
template <int D>
class Fans {
 public:
  explicit Fans(const Complex<D>& complex) : complex_(complex), snapshot_(complex.snapshot()) {}

  /// Gathers the fan of a ridge of cell c, turning from its facet f. With only_own, returns false if the fan
  /// has a cell before c in the snapshot, so that each fan belongs to one cell.
  bool gather(Cell c, std::size_t f, const Ridge<D>& ridge, bool only_own, Fan<D>& fan) {
    fan.rays.clear();
    fan.is_closed = false;
    fan.lowest = c;
    fan.rays.push_back(ray(c, f, ridge));
    if (!turn(c, f, ridge, c, only_own, fan)) return false;
    if (fan.is_closed) return true;
    // Open: the cells before the first facet go in front.
    const Half_facet before = complex_.opposite(snapshot_.half_facet(c, f));
    if (before == Half_facet::none) return true;
    Fan<D>& rest = rest_;
    rest.rays.clear();
    rest.lowest = fan.lowest;
    const Cell previous = snapshot_.cell_of(before);
    if (only_own && previous < c) return false;
    if (snapshot_.index(previous) < snapshot_.index(rest.lowest)) rest.lowest = previous;
    if (!turn(previous, snapshot_.facet_of(before), ridge, c, only_own, rest)) return false;
    fan.lowest = rest.lowest;
    fan.rays.insert(fan.rays.begin(), rest.rays.rbegin(), rest.rays.rend());
    return true;
  }

  /// True if an inner fan turns exactly once, and a boundary fan at most once.
  bool turns_once(const Fan<D>& fan, const Ridge<D>& ridge) {
    // At most half a turn a cell: three cells cannot turn twice, two cannot turn more than once.
    const std::size_t cells = fan.rays.size() - 1;
    if (cells <= (fan.is_closed ? 3u : 2u)) return true;
    enum Class { same, left, opposite, right };
    const auto class_of = [&](std::uint32_t ray) {
      if (ray == fan.rays[0]) return same;
      const int side = side_of_ray(ridge, fan.rays[0], ray);
      if (side != 0) return side > 0 ? left : right;
      return is_same_direction(ridge, fan.rays[0], ray) ? same : opposite;
    };
    int turns = 0;
    Class last = same;
    for (std::size_t i = 1; i < fan.rays.size(); ++i) {
      const Class next = class_of(fan.rays[i]);
      if ((last == opposite || last == right) && (next == same || next == left)) ++turns;
      if (turns > 1 || (turns == 1 && next != same)) return false;
      last = next;
      // Nothing may follow a full turn.
      if (turns == 1 && i + 1 < fan.rays.size()) return false;
    }
    return true;
  }

 private:
  static bool has_ridge_at(const Cell_view<D>& cell, std::span<const std::uint16_t> loop, std::size_t k,
                           const Ridge<D>& ridge) {
    const std::uint32_t u = cell.point_index(loop[k]);
    if constexpr (D == 2) return u == ridge[0];
    if constexpr (D == 3) {
      if (u != ridge[0] && u != ridge[1]) return false;
      const std::uint32_t v = cell.point_index(loop[k + 1 == loop.size() ? 0 : k + 1]);
      return v == (u == ridge[0] ? ridge[1] : ridge[0]);
    }
  }

  /// The facet of a cell other than `facet` that contains the ridge.
  std::size_t other_facet(const Cell_view<D>& cell, std::size_t facet, const Ridge<D>& ridge) const {
    for (std::size_t g = 0; g < cell.facet_count(); ++g) {
      if (g == facet) continue;
      const auto loop = cell.loop(g);
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (has_ridge_at(cell, loop, k, ridge)) return g;
    }
    return facet;  // not reached: cells are closed
  }

  /// Turns from facet f through cell c and further, adding rays, until the boundary or `start` is reached.
  bool turn(Cell c, std::size_t f, const Ridge<D>& ridge, Cell start, bool only_own, Fan<D>& fan) {
    for (;;) {
      const std::size_t g = other_facet(snapshot_.view(c), f, ridge);
      fan.rays.push_back(ray(c, g, ridge));
      const Half_facet next = complex_.opposite(snapshot_.half_facet(c, g));
      if (next == Half_facet::none) return true;
      c = snapshot_.cell_of(next);
      f = snapshot_.facet_of(next);
      if (c == start) {
        fan.is_closed = true;
        return true;
      }
      if (only_own && c < start) return false;
      if (snapshot_.index(c) < snapshot_.index(fan.lowest)) fan.lowest = c;
    }
  }

  /// A vertex of a facet that is not on the line of the ridge.
  std::uint32_t ray(Cell c, std::size_t f, const Ridge<D>& ridge) {
    const Cell_view<D> cell = snapshot_.view(c);
    const auto loop = cell.loop(f);
    for (const std::uint16_t local : loop) {
      const std::uint32_t v = cell.point_index(local);
      if (std::find(ridge.begin(), ridge.end(), v) != ridge.end()) continue;
      if constexpr (D == 3)
        if (loop.size() > 3 && projection_axis(counts_, point(ridge[0]), point(ridge[1]), point(v)) < 0)
          continue;
      return v;
    }
    return ridge[0];  // not reached: no facet has collinear vertices only
  }

  /// +1 if b is less than half a turn after a. The facet of the first cell has its interior to the left of
  /// the ridge, seen from outside, so the turn into the cell is to the right about the ridge, and to the left
  /// about the reversed ridge.
  int side_of_ray(const Ridge<D>& ridge, std::uint32_t a, std::uint32_t b) {
    if constexpr (D == 2) return Exact::orientation(counts_, point(ridge[0]), point(a), point(b));
    if constexpr (D == 3)
      return Exact::orientation(counts_, point(ridge[1]), point(ridge[0]), point(a), point(b));
  }

  /// \pre ridge, a and b are coplanar (2D: collinear)
  bool is_same_direction(const Ridge<D>& ridge, std::uint32_t a, std::uint32_t b) {
    if constexpr (D == 2) return (point(ridge[0]) < point(a)) == (point(ridge[0]) < point(b));
    if constexpr (D == 3) {
      const Point<3>&u = point(ridge[0]), &v = point(ridge[1]);
      const int axis = projection_axis(counts_, u, v, point(a));
      return detail::turn(counts_, u, v, point(a), axis) == detail::turn(counts_, u, v, point(b), axis);
    }
  }

  const Point<D>& point(std::uint32_t v) const { return snapshot_.point(v); }

  const Complex<D>& complex_;
  const Snapshot<D>& snapshot_;
  Fan<D> rest_;  // kept for its memory
  Predicate_counts counts_;
};

/// Calls visit(facet, ridge) for each ridge of a cell, once. In 3D the ridge is directed as in the facet.
template <int D, class Visit>
void for_each_ridge(const Cell_view<D>& cell, const Visit& visit) {
  for (std::size_t f = 0; f < cell.facet_count(); ++f) {
    const auto loop = cell.loop(f);
    if constexpr (D == 2) {
      visit(f, Ridge<2>{cell.point_index(loop[0])});
    } else {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t u = cell.point_index(loop[k]), v = cell.point_index(loop[(k + 1) % loop.size()]);
        if (u < v) visit(f, Ridge<3>{u, v});
      }
    }
  }
}

template <int D>
std::string name(const Ridge<D>& ridge) {
  if constexpr (D == 2) return "vertex " + std::to_string(ridge[0]);
  if constexpr (D == 3)
    return "the edge of vertices " + std::to_string(ridge[0]) + " and " + std::to_string(ridge[1]);
}

}  // namespace

template <int D>
std::size_t certify_turns(const Complex<D>& complex) {
  const Snapshot<D>& snapshot = complex.snapshot();
  std::atomic<std::size_t> ridges{0};
  const std::uint32_t failure = complex.lowest_failure([&] {
    return [&, fans = Fans<D>(complex), fan = Fan<D>()](Cell c) mutable {
      std::uint32_t lowest = complex.no_failure;
      std::size_t own = 0;
      for_each_ridge<D>(snapshot.view(c), [&](std::size_t f, const Ridge<D>& ridge) {
        if (!fans.gather(c, f, ridge, true, fan)) return;
        ++own;
        if (!fans.turns_once(fan, ridge)) lowest = std::min(lowest, snapshot.index(fan.lowest));
      });
      ridges.fetch_add(own, std::memory_order_relaxed);
      return lowest;
    };
  });
  if (failure == complex.no_failure) return ridges;
  const Cell c = snapshot.cell(failure);
  Fans<D> fans(complex);
  Fan<D> fan;
  for_each_ridge<D>(snapshot.view(c), [&](std::size_t f, const Ridge<D>& ridge) {
    fans.gather(c, f, ridge, false, fan);
    if (fans.turns_once(fan, ridge)) return;
    refuse(full_name(snapshot, snapshot.half_facet(c, f)) + ": the " + std::to_string(fan.rays.size() - 1) +
           " cells round " + name<D>(ridge) +
           " turn round it more than once, so that they overlap: repair the mesh");
  });
  return ridges;
}

template std::size_t certify_turns(const Complex<2>&);
template std::size_t certify_turns(const Complex<3>&);

}  // namespace cellwalk::detail
