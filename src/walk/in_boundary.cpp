// SPDX-License-Identifier: LGPL-3.0-or-later
// The places on a line in the boundary of a cell, ordered by their parameters.
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/internal/kernel/uncertified.h>
#include <cellwalk/internal/walk/in_boundary.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cellwalk::detail {
namespace {

template <int D>
class Boundary_run {
 public:
  Boundary_run(const Cell_view<D>& cell, const Point<D>& a, const Point<D>& b, Walk_counts& counts)
      : cell_(cell), a_(a), b_(b), counts_(counts) {
    for (std::size_t i = 0; i < cell.facet_count(); ++i)
      if (side<Exact>(cell, i, b, counts) == 0 && side<Exact>(cell, i, a, counts) == 0) facets_.push_back(i);
  }

  /// The number of facets in whose plane the line lies.
  std::size_t facet_count() const { return facets_.size(); }

  /// The ridge or vertex on which the start lies.
  Exit at_start() const {
    for (const std::size_t i : facets_) {
      const Facet_feature feature = lowest_feature(cell_, i, a_);
      if (feature.kind == Contact_kind::vertex) return vertex(i, feature.corner);
      if (feature.kind == Contact_kind::edge) return ridge(i, feature.corner);
    }
    return {};
  }

  Exit next(const Exit& passed, bool ends) const {
    const Fraction last = passed.kind == Exit::none ? Fraction(0) : place_of_passed(passed);
    std::optional<Fraction> first, end;
    Exit result;
    for_each_place([&](const Exit& place) {
      Fraction t = place_of(place);
      if (!end || *end < t) end = t;
      if (!(last < t) || (first && *first <= t)) return;
      first = std::move(t);
      result = place;
    });
    if (!first || *first >= Fraction(1) || (!ends && *first >= *end)) return {};
    return result;
  }

 private:
  const Point<D>& corner(std::size_t i, std::size_t k) const {
    const auto loop = cell_.loop(i);
    return cell_.point(loop[k % loop.size()]);
  }
  std::uint32_t index(std::size_t i, std::size_t k) const {
    const auto loop = cell_.loop(i);
    return cell_.point_index(loop[k % loop.size()]);
  }
  Exit vertex(std::size_t i, std::size_t k) const {
    return {Exit::vertex, static_cast<std::uint16_t>(i), index(i, k), index(i, k)};
  }
  Exit ridge(std::size_t i, std::size_t k) const {
    return {Exit::ridge, static_cast<std::uint16_t>(i), index(i, k), index(i, k + 1)};
  }

  /// All vertices on the line, and ridges that it crosses, of the facets in whose plane it lies.
  template <class Visit>
  void for_each_place(Visit visit) const {
    for (const std::size_t i : facets_) {
      const std::size_t size = cell_.loop(i).size();
      for (std::size_t k = 0; k < size; ++k) {
        if (are_collinear(a_, b_, corner(i, k)))
          visit(vertex(i, k));
        else if constexpr (D == 3)
          if (!are_collinear(a_, b_, corner(i, k + 1)) && crosses(i, k)) visit(ridge(i, k));
      }
    }
  }

  /// True if the ends of a ridge of facet i, whose plane contains the line, lie on different sides of the
  /// line.
  bool crosses(std::size_t i, std::size_t k) const {
    std::size_t off = 0;
    while (side<Exact>(cell_, i, cell_.point(off), counts_) == 0) ++off;
    const auto sign = [&](const Point<D>& x) {
      ++counts_.along_tests;
      return Exact::orientation(counts_.predicates, a_, b_, x, cell_.point(off));
    };
    return sign(corner(i, k)) * sign(corner(i, k + 1)) < 0;
  }

  /// The same as place_of(), but the ridge may also be the one on which the motion starts and along which it
  /// runs.
  Fraction place_of_passed(const Exit& passed) const {
    const Point<D>&u = cell_.points[passed.u], &v = cell_.points[passed.v];
    const bool runs_along =
        passed.kind == Exit::ridge && are_collinear(a_, b_, u) && are_collinear(a_, b_, v);
    return runs_along ? Fraction(0) : place_of(passed);
  }

  /// The parameter at which the line passes a ridge or vertex: 0 at a, 1 at b.
  Fraction place_of(const Exit& place) const {
    if (place.kind == Exit::vertex) {
      const Point<D>& x = cell_.points[place.u];
      int axis = 0;
      while (a_[axis] == b_[axis]) ++axis;
      return {Ring(x[axis]) - Ring(a_[axis]), Ring(b_[axis]) - Ring(a_[axis])};
    }
    if constexpr (D == 3) {
      const Point<D>&u = cell_.points[place.u], &v = cell_.points[place.v];
      for (std::size_t off = 0; off < cell_.vertex_count(); ++off) {
        const Ring at_a = Exact_value::orientation(u, v, cell_.point(off), a_);
        const Ring span = at_a - Exact_value::orientation(u, v, cell_.point(off), b_);
        if (CGAL::sign(span) != CGAL::ZERO) return {at_a, span};
      }
    }
    refuse_uncertified();
  }

  const Cell_view<D>& cell_;
  const Point<D>&a_, &b_;
  Walk_counts& counts_;
  boost::container::small_vector<std::size_t, 4> facets_;
};

}  // namespace

template <int D>
Exit next_in_boundary(const Cell_view<D>& cell, const Point<D>& a, const Point<D>& b, const Exit& passed,
                      bool ends, Walk_counts& counts) {
  const Boundary_run<D> run(cell, a, b, counts);
  if (run.facet_count() == 0 || a == b) return {};
  if (passed.kind == Exit::none)
    if (const Exit start = run.at_start(); start.kind != Exit::none) return start;
  // In the plane of one facet only, the motion stays in that facet.
  return run.facet_count() == 1 ? Exit{} : run.next(passed, ends);
}

template Exit next_in_boundary<2>(const Cell_view<2>&, const Point<2>&, const Point<2>&, const Exit&, bool,
                                  Walk_counts&);
template Exit next_in_boundary<3>(const Cell_view<3>&, const Point<3>&, const Point<3>&, const Exit&, bool,
                                  Walk_counts&);

}  // namespace cellwalk::detail
