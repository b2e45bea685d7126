// SPDX-License-Identifier: LGPL-3.0-or-later
// What a cut did, in rational numbers: of the library it uses which cells there are, which of them are solid,
// and how they are joined.
#ifndef CELLWALK_TESTS_RESHAPE_CUT_JUDGE_H
#define CELLWALK_TESTS_RESHAPE_CUT_JUDGE_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include "reshape/near_cells.h"

namespace cellwalk::test {

/// A simplex with its box, in doubles, which are exact.
template <int D>
struct Exact_simplex {
  std::array<Place<D>, static_cast<std::size_t>(D) + 1> corners;
  std::vector<std::uint32_t> points;
  Cell cell;

  Point<D> low, high;

  Exact_simplex(const Snapshot<D>& snapshot, Cell c) : cell(c) {
    const auto vertices = snapshot.view(c).vertices;
    points.assign(vertices.begin(), vertices.end());
    low = high = snapshot.point(points[0]);
    for (std::size_t k = 0; k <= D; ++k) {
      const Point<D>& x = snapshot.point(points[k]);
      corners[k] = exact_place<D>(x, 0);
      for (std::size_t axis = 0; axis < D; ++axis) {
        low[axis] = std::min(low[axis], x[axis]);
        high[axis] = std::max(high[axis], x[axis]);
      }
    }
  }
  bool is_same(const Exact_simplex& other) const {
    return cell == other.cell && points == other.points && corners == other.corners;
  }
  bool may_meet(const Exact_simplex& other) const {
    for (std::size_t axis = 0; axis < D; ++axis)
      if (high[axis] < other.low[axis] || other.high[axis] < low[axis]) return false;
    return true;
  }
};

inline Fraction scalar(const Place<2>& a, const Place<2>& b) { return a[0] * b[0] + a[1] * b[1]; }
inline Fraction scalar(const Place<3>& a, const Place<3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <std::size_t D>
std::array<Fraction, D> difference(const std::array<Fraction, D>& a, const std::array<Fraction, D>& b) {
  std::array<Fraction, D> d;
  for (std::size_t k = 0; k < D; ++k) d[k] = a[k] - b[k];
  return d;
}

/// Visits the directions of which one separates two simplices that are apart, until a visit returns true:
/// normals of facets, and in space also those of an edge of each.
template <class Visit>
bool visit_directions(const Exact_simplex<2>& a, const Exact_simplex<2>& b, const Visit& visit) {
  for (const auto* simplex : {&a, &b})
    for (std::size_t k = 0; k < 3; ++k) {
      const Place<2> edge = difference(simplex->corners[(k + 1) % 3], simplex->corners[k]);
      if (visit(Place<2>{-edge[1], edge[0]})) return true;
    }
  return false;
}
template <class Visit>
bool visit_directions(const Exact_simplex<3>& a, const Exact_simplex<3>& b, const Visit& visit) {
  const auto across = [&](const Place<3>& u, const Place<3>& v) {
    return visit(Place<3>{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]});
  };
  const auto edge = [](const Exact_simplex<3>& of, std::size_t i, std::size_t j) {
    return difference(of.corners[i], of.corners[j]);
  };
  for (const auto* simplex : {&a, &b})
    for (std::size_t k = 0; k < 4; ++k)
      if (across(edge(*simplex, (k + 1) % 4, (k + 2) % 4), edge(*simplex, (k + 1) % 4, (k + 3) % 4)))
        return true;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t m = 0; m < k; ++m)
          if (across(edge(a, i, j), edge(b, k, m))) return true;
  return false;
}

/// How two closed simplices meet.
enum class Meeting { apart, touching, inside };

template <int D>
Meeting meeting(const Exact_simplex<D>& a, const Exact_simplex<D>& b) {
  if (!a.may_meet(b)) return Meeting::apart;
  Meeting result = Meeting::inside;
  const bool are_apart = visit_directions(a, b, [&](const Place<D>& direction) {
    std::vector<Fraction> of_a, of_b;
    for (std::size_t k = 0; k <= D; ++k) {
      of_a.push_back(scalar(direction, a.corners[k]));
      of_b.push_back(scalar(direction, b.corners[k]));
    }
    const auto [low_a, high_a] = std::ranges::minmax(of_a);
    const auto [low_b, high_b] = std::ranges::minmax(of_b);
    if (low_a == high_a && low_b == high_b) return false;  // edges in parallel span no direction
    if (high_a == low_b || high_b == low_a) result = Meeting::touching;
    return high_a < low_b || high_b < low_a;
  });
  return are_apart ? Meeting::apart : result;
}

struct Cut_findings {
  bool has_same_volume = false;
  std::size_t flat = 0;      ///< cells of no volume
  std::size_t entered = 0;   ///< pairs of a solid cell and one that was free before, which meet inside
  std::size_t unmarked = 0;  ///< facets with a wall on one side, or passable between solid and free
  std::size_t front = 0, back = 0, mixed = 0;  ///< solid cells, by the side of their corners
  std::size_t parts = 0;                       ///< solid, joined through facets that have a point off the rim
  std::size_t both = 0;                        ///< of these, such with cells in front and cells behind
  std::size_t touching =
      0;  ///< pairs of a cell in front and one behind that touch, but share no point of the rim
  std::size_t gap_cells = 0;  ///< free, where there was solid before
};

template <int D>
class Cut_judge {
 public:
  /// Before the cut.
  explicit Cut_judge(const Snapshot<D>& snapshot) : snapshot_(snapshot) {
    for_each_cell([&](Cell c) {
      Exact_simplex<D> simplex(snapshot_, c);
      const Fraction size = size_of(simplex);
      volume_ += size;
      if (snapshot_.is_solid(c))
        solid_.push_back(std::move(simplex));
      else
        free_.push_back(std::move(simplex));
    });
  }

  /// What has become of all cells, and which are in front and behind.
  /// \param plane of the blade
  /// \param is_rim whether a point lies at the rim of the cut, where both sides hold together
  template <class Is_rim>
  Cut_findings judge(const std::array<Point<D>, static_cast<std::size_t>(D)>& plane,
                     const Is_rim& is_rim) const {
    Cut_findings found = changes();
    std::vector<Exact_simplex<D>> solid;
    for_each_cell([&](Cell c) {
      if (snapshot_.is_solid(c)) solid.emplace_back(snapshot_, c);
    });
    std::vector<int> sides;
    for (const auto& simplex : solid) {
      sides.push_back(side_of(simplex, plane));
      ++(sides.back() > 0 ? found.front : sides.back() < 0 ? found.back : found.mixed);
    }
    judge_parts(solid, sides, is_rim, found);
    return found;
  }

  /// What has become of all cells.
  Cut_findings changes() const {
    Cut_findings found;
    Fraction volume_now;
    for_each_cell([&](Cell c) {
      const Exact_simplex<D> simplex(snapshot_, c);
      const Fraction size = size_of(simplex);
      found.flat += size.sign() <= 0;
      volume_now += size;
      judge_marks(c, found);
      if (std::ranges::any_of(snapshot_.is_solid(c) ? solid_ : free_,
                              [&](const auto& before) { return before.is_same(simplex); }))
        return;
      const auto is_met = [&](const auto& before) { return meeting(before, simplex) == Meeting::inside; };
      if (snapshot_.is_solid(c))
        found.entered += static_cast<std::size_t>(std::ranges::count_if(free_, is_met));
      else
        found.gap_cells += std::ranges::any_of(solid_, is_met);
    });
    found.has_same_volume = volume_now == volume_;
    return found;
  }

 private:
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    for (std::size_t i = 0; i < snapshot_.cell_slots(); ++i)
      if (const Cell c = snapshot_.cell(i); c != Cell::none) visit(c);
  }
  /// Positive for any simplex that is not flat.
  static Fraction size_of(const Exact_simplex<D>& simplex) { return abs(volume(simplex.corners)); }

  void judge_marks(Cell c, Cut_findings& found) const {
    for (std::size_t k = 0; k <= D; ++k) {
      const Half_facet f = Snapshot<D>::half_facet(c, k);
      const Cell other = snapshot_.neighbour(f);
      if (other == Cell::none)
        found.unmarked += !snapshot_.is_impassable(f);
      else
        found.unmarked += snapshot_.is_impassable(f) != snapshot_.is_impassable(snapshot_.opposite(f)) ||
                          (snapshot_.is_solid(c) != snapshot_.is_solid(other) && !snapshot_.is_impassable(f));
    }
  }

  /// The side of all corners off the plane, 0 if they lie on both.
  static int side_of(const Exact_simplex<D>& simplex,
                     const std::array<Point<D>, static_cast<std::size_t>(D)>& plane) {
    int side = 0;
    for (const Place<D>& x : simplex.corners) {
      std::array<Place<D>, static_cast<std::size_t>(D) + 1> spanned;
      for (std::size_t k = 0; k < D; ++k) spanned[k] = exact_place<D>(plane[k], 0);
      spanned[D] = x;
      const int own = volume(spanned).sign();
      if (own * side < 0) return 0;
      if (own != 0) side = own;
    }
    return side;
  }

  template <class Is_rim>
  void judge_parts(const std::vector<Exact_simplex<D>>& solid, const std::vector<int>& sides,
                   const Is_rim& is_rim, Cut_findings& found) const {
    std::vector<std::size_t> part(solid.size(), solid.size());
    const auto index_of = [&](Cell c) {
      return static_cast<std::size_t>(std::ranges::find(solid, c, &Exact_simplex<D>::cell) - solid.begin());
    };
    for (std::size_t first = 0; first < solid.size(); ++first) {
      if (part[first] != solid.size()) continue;
      bool has_front = false, has_back = false;
      std::vector<std::size_t> todo{first};
      part[first] = found.parts;
      while (!todo.empty()) {
        const std::size_t i = todo.back();
        todo.pop_back();
        has_front |= sides[i] > 0;
        has_back |= sides[i] < 0;
        for (std::size_t k = 0; k <= D; ++k) {
          const Half_facet f = Snapshot<D>::half_facet(solid[i].cell, k);
          const Cell other = snapshot_.neighbour(f);
          if (other == Cell::none || !snapshot_.is_solid(other)) continue;
          if (std::ranges::all_of(snapshot_.loop(f), is_rim)) continue;
          const std::size_t j = index_of(other);
          if (part[j] != solid.size()) continue;
          part[j] = found.parts;
          todo.push_back(j);
        }
      }
      ++found.parts;
      found.both += has_front && has_back;
    }
    for (std::size_t i = 0; i < solid.size(); ++i)
      for (std::size_t j = 0; j < solid.size(); ++j) {
        if (sides[i] <= 0 || sides[j] >= 0) continue;
        const bool share_rim = std::ranges::any_of(solid[i].points, [&](std::uint32_t p) {
          return is_rim(p) && std::ranges::find(solid[j].points, p) != solid[j].points.end();
        });
        found.touching += !share_rim && meeting(solid[i], solid[j]) != Meeting::apart;
      }
  }

  const Snapshot<D>& snapshot_;
  std::vector<Exact_simplex<D>> solid_, free_;
  Fraction volume_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_CUT_JUDGE_H
