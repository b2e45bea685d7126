// SPDX-License-Identifier: LGPL-3.0-or-later
// The length of a piece, by twice the precision of a double where its error bound decides how it is
// rounded, and exactly where it does not.
#include "piece_lengths.h"

#include <cellwalk/internal/kernel/crossing.h>
#include <cellwalk/internal/walk/sides_taken.h>
#include <cellwalk/internal/walk/star.h>

#include <cmath>
#include <optional>
#include <tuple>

namespace cellwalk::detail {
namespace {

/// An end of a piece: the time of the motion, bounded if possible, and exact once it is needed.
template <int D>
class Piece_end {
 public:
  explicit Piece_end(double time) : bounded_{{{time, 0}, 0}}, exact_(time) {}
  Piece_end(const Snapshot<D>& snapshot, const Point<D>& from, const Point<D>& to, const Cell_exit& exit) {
    if (exit.facet == Half_facet::none) {
      exact_ = passing_time(snapshot, from, to, exit.u, exit.v);
      return;
    }
    const auto corners =
        spanning_corners(snapshot.view(snapshot.cell_of(exit.facet)), snapshot.facet_of(exit.facet));
    crossing_ = std::apply(
        [&](const auto&... corner) {
          return Crossing<D>{from, to, {*corner...}};
        },
        corners);
    bounded_ = bounded_time(*crossing_);
  }

  const std::optional<Bounded_twofold>& bounded() const { return bounded_; }
  const Fraction& exact() const {
    if (!exact_) exact_ = fraction_of(*crossing_);
    return *exact_;
  }

 private:
  std::optional<Crossing<D>> crossing_;
  std::optional<Bounded_twofold> bounded_;
  mutable std::optional<Fraction> exact_;
};

/// Differences of coordinates of which squares neither overflow nor underflow.
constexpr double least_difference = 0x1p-150, largest_difference = 0x1p150;

/// The length of a segment. None if it is out of range.
template <int D>
std::optional<Bounded_twofold> bounded_length(const Point<D>& from, const Point<D>& to) {
  Twofold square;
  for (std::size_t k = 0; k < D; ++k) {
    const Twofold d = exact_difference(to[k], from[k]);
    const double size = std::abs(d.high);
    if (size != 0 && !(size > least_difference && size < largest_difference)) return {};
    square = square + d * d;
  }
  if (square.high == 0) return {};
  // The square is within 16 u^2, relatively. A step of Newton's method leaves half the square of the relative
  // error u of the root.
  const double root = std::sqrt(square.high);
  const Twofold rest = square - exact_product(root, root);
  const Twofold length = quick_sum(root, rest.high / (2 * root));
  return Bounded_twofold{length, 32 * twofold_unit * root};
}

/// The double nearest to a number, if its error allows one only.
std::optional<double> certain_nearest(const Bounded_twofold& x) {
  const double above = x.value.high + (x.value.low + x.error), below = x.value.high + (x.value.low - x.error);
  if (above != x.value.high || below != x.value.high) return {};
  return x.value.high;
}

template <int D>
std::optional<double> certain_length(const Piece_end<D>& begin, const Piece_end<D>& end,
                                     const std::optional<Bounded_twofold>& whole) {
  if (!whole || !begin.bounded() || !end.bounded()) return {};
  const Twofold share = end.bounded()->value - begin.bounded()->value;
  const double error = begin.bounded()->error + end.bounded()->error;
  if (!(share.high > 2 * error)) return {};
  const Twofold length = share * whole->value;
  // Twice the sum of the errors of the share, of the whole length, of the difference and of the product.
  return certain_nearest({length, 2 * (error * whole->value.high + share.high * whole->error +
                                       16 * twofold_unit * length.high)});
}

template <int D>
double exact_length(const Point<D>& from, const Point<D>& to, const Fraction& begin, const Fraction& end) {
  const Ring share = end.numerator() * begin.denominator() - begin.numerator() * end.denominator();
  if (CGAL::sign(share) != CGAL::POSITIVE) return -1;
  const Ring denominator = end.denominator() * begin.denominator();
  Ring square(0);
  for (std::size_t k = 0; k < D; ++k) {
    const Ring d = Ring(to[k]) - Ring(from[k]);
    square = square + d * d;
  }
  return root_to_nearest(Fraction(square * share * share, denominator * denominator));
}

}  // namespace

template <int D>
double length_of_piece(const Snapshot<D>& snapshot, const Point<D>& from, const Point<D>& to,
                       std::span<const Cell_exit> exits, std::size_t i) {
  const auto end_at = [&](std::size_t exit, double otherwise) {
    return exit < exits.size() ? Piece_end<D>(snapshot, from, to, exits[exit]) : Piece_end<D>(otherwise);
  };
  const Piece_end<D> begin = i == 0 ? Piece_end<D>(0.0) : end_at(i - 1, 0), end = end_at(i, 1);
  const auto certain = certain_length(begin, end, bounded_length<D>(from, to));
  return certain ? *certain : exact_length<D>(from, to, begin.exact(), end.exact());
}

template double length_of_piece<2>(const Snapshot<2>&, const Point<2>&, const Point<2>&,
                                   std::span<const Cell_exit>, std::size_t);
template double length_of_piece<3>(const Snapshot<3>&, const Point<3>&, const Point<3>&,
                                   std::span<const Cell_exit>, std::size_t);

}  // namespace cellwalk::detail
