// SPDX-License-Identifier: LGPL-3.0-or-later
// A complex in integers of any size, for oracles that follow moving edges. Shares nothing with the library
// but the record Cell_soup.
#ifndef CELLWALK_TESTS_EDGE_INTEGER_COMPLEX_H
#define CELLWALK_TESTS_EDGE_INTEGER_COMPLEX_H

#include <cellwalk/records/cell_soup.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "oracle/exact_world.h"

namespace cellwalk::oracle {

/// Integers of any size. The first 768 bits need no allocation.
using Big = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<768, 0, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked>,
    boost::multiprecision::et_off>;
template <>
struct Product<Big> {
  using type = Big;
};
/// A time, or a parameter along the segment from p (0) to q (1).
using Share = Fraction<Big>;

/// Sign of s - t: by leading digits where they decide it, else by products.
int order(const Share& s, const Share& t);
inline bool operator<(const Share& s, const Share& t) { return order(s, t) < 0; }
inline bool operator==(const Share& s, const Share& t) { return order(s, t) == 0; }

/// A double as a fraction.
Share exact_share(double x);

/// A time strictly between two.
Share between(const Share& s, const Share& t);

/// A cell soup in integers.
template <int D>
struct Integer_complex {
  explicit Integer_complex(const Cell_soup<D>& soup);

  Cell_soup<D> soup;
  Facet_table table;
  int shift = 0;  ///< points are scaled by 2^shift
  std::vector<std::array<Big, D>> points;
  std::vector<std::array<Point<D>, 2>> boxes;  ///< of the cells
  /// Per half-facet: affine functions that are positive outside it, its plane and, in this plane, its rims.
  std::vector<Affine<D, Big>> planes;
  std::vector<std::vector<Affine<D, Big>>> rims;
};

template <std::size_t D>
std::array<Big, D> minus(const std::array<Big, D>& a, const std::array<Big, D>& b) {
  std::array<Big, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = a[i] - b[i];
  return r;
}

template <std::size_t D>
Big dot(const std::array<Big, D>& a, const std::array<Big, D>& b) {
  Big r = 0;
  for (std::size_t i = 0; i < D; ++i) r += a[i] * b[i];
  return r;
}

inline std::array<Big, 3> cross(const std::array<Big, 3>& a, const std::array<Big, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// A point scaled by 2^shift.
/// \pre its coordinates become integers
template <std::size_t D>
std::array<Big, D> integer(const std::array<double, D>& x, int shift) {
  std::array<Big, D> r;
  for (std::size_t i = 0; i < D; ++i) r[i] = scaled<Big>(x[i], shift);
  return r;
}

/// The least shift >= 0 that makes the coordinates integers.
template <std::size_t D>
int shift_of(const std::array<double, D>& x) {
  int shift = 0;
  for (const double c : x) shift = std::max(shift, integer_shift(c));
  return shift;
}

extern template struct Integer_complex<2>;
extern template struct Integer_complex<3>;

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_EDGE_INTEGER_COMPLEX_H
