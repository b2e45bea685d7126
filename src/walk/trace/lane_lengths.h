// SPDX-License-Identifier: LGPL-3.0-or-later
// The lengths of the pieces into which planes divide a segment, in numbers of twice the precision of a
// double, several planes at a time, with a bound of their errors. It includes nothing, so that the
// instructions of one kind of processor stay in the file that is compiled for it.
//
// Let e be the unit direction of the segment from a. It meets the plane n.x = o at s = (o - n.a) / (n.e).
//
// Bound, with u = 2^-53 and M at least the size of every coordinate of the start and of facets. A stored
// plane is that of a facet, scaled so that no component of n is above 1. The errors of the components are at
// most 2^11 u^2, and o = n.p for a corner p of the facet, within 2^6 u^2 M. Hence o - n.a = n.(p - a) is off
// by at most 3 2^11 u^2 2M + 2^6 u^2 M, and by 2^8 u^2 M more as it is computed, in all by less than 2^14 u^2
// M; n.e by 3 2^11 u^2 and, since e is known within 2^6 u^2, by 2^9 u^2 more, in all by less than 2^13 u^2.
// As s is at most 2 sqrt(3) M, it is within (2^14 + 3.5 2^13) u^2 M / |n.e|; the division adds less than 2^8
// u^2 M / |n.e|, as the low part of n.e is within u of the high one, relatively. (It is not if |n.e| < 2^5 u,
// but then the error leaves all lengths open.) Together that is less than 2^16 u^2 M / |n.e|. The unit of
// errors is twice as much, for terms of higher order, for 1 / (n.e), which is rounded, and for the rounding
// of the difference of two positions. The length of the segment itself is known within 2^6 u^2 M.
#ifndef CELLWALK_WALK_TRACE_LANE_LENGTHS_H
#define CELLWALK_WALK_TRACE_LANE_LENGTHS_H

namespace cellwalk::detail {

/// A plane n.x = o: the high parts of n and o, then the low parts. In 2D the last component of n is 0.
struct alignas(64) Lane_plane {
  double high[4], low[4];
};

/// The unit of errors, in units of M.
inline constexpr double lane_error = 0x1p17 * 0x1p-106;

/// Segments, a coordinate after the other, each an array with room for seven more: ends, and room for unit
/// directions and lengths. In 2D the third coordinates are 0.
struct Lane_segments {
  double *from[3], *to[3];
  double *direction_high[3], *direction_low[3], *length_high, *length_low;
  double error;  ///< lane_error M
};

/// The facets that a segment meets, in order.
struct Lane_crossings {
  const Lane_plane* planes;    ///< of all facets
  const unsigned* plane_of;    ///< the plane of each half-facet
  const unsigned* half_facet;  ///< those met
  unsigned long count;
  bool end_on_last;  ///< the last of them ends the segment
};

/// Positions on the segment, and the bounds of their errors: the start, those of the facets, the end; each
/// array has room for eight more. `length` receives the pieces between them.
struct Lane_positions {
  double *high, *low, *error, *length;
};

namespace {

/// a + b in `sum`; returns the error of the rounding.
template <class V>
inline V sum_with_error(V a, V b, V& sum) {
  sum = a + b;
  const V of_b = sum - a;
  return (a - (sum - of_b)) + (b - of_b);
}

/// Computes the directions and lengths of segments.
template <class Lanes>
inline void set_directions_in_lanes(const Lane_segments& segments, unsigned long count) {
  using V = typename Lanes::Vector;
  for (unsigned long i = 0; i < count; i += Lanes::width) {
    V d[3], d_low[3], square[3], low_sum = Lanes::all(0);
    for (int k = 0; k < 3; ++k) {
      d_low[k] = sum_with_error(Lanes::load(segments.to[k] + i), -Lanes::load(segments.from[k] + i), d[k]);
      square[k] = d[k] * d[k];
      low_sum = low_sum + (Lanes::product_error(d[k], d[k], square[k]) + Lanes::all(2) * d[k] * d_low[k]);
    }
    V sum, squared;
    low_sum = low_sum + sum_with_error(square[0], square[1], sum);
    low_sum = low_sum + sum_with_error(sum, square[2], squared);
    const V root = Lanes::square_root(squared), product = root * root, inverse = Lanes::all(1) / root;
    const V rest = ((squared - product) - Lanes::product_error(root, root, product)) + low_sum;
    const V correction = Lanes::all(0.5) * rest * inverse, length = root + correction;
    const V length_low = correction - (length - root);
    Lanes::store(segments.length_high + i, length);
    Lanes::store(segments.length_low + i, length_low);

    // The inverse of the length, to twice the precision, times the differences.
    const V one = inverse * length;
    const V inverse_low =
        (((Lanes::all(1) - one) - Lanes::product_error(inverse, length, one)) - inverse * length_low) *
        inverse;
    for (int k = 0; k < 3; ++k) {
      const V component = d[k] * inverse;
      const V small =
          Lanes::product_error(d[k], inverse, component) + (d[k] * inverse_low + d_low[k] * inverse);
      const V high = component + small;
      Lanes::store(segments.direction_high[k] + i, high);
      Lanes::store(segments.direction_low[k] + i, small - (high - component));
    }
  }
}

/// The positions of the facets met.
template <class Lanes>
inline void meet_planes(const Lane_segments& segments, unsigned long segment, const Lane_crossings& crossings,
                        const Lane_positions& positions) {
  using V = typename Lanes::Vector;
  constexpr unsigned long width = Lanes::width;
  V from[3], e[3], e_low[3];
  for (int k = 0; k < 3; ++k) {
    from[k] = Lanes::all(segments.from[k][segment]);
    e[k] = Lanes::all(segments.direction_high[k][segment]);
    e_low[k] = Lanes::all(segments.direction_low[k][segment]);
  }
  const V unit = Lanes::all(segments.error);
  for (unsigned long i = 0; i < crossings.count; i += width) {
    const Lane_plane* of_lane[width];
    for (unsigned long j = 0; j < width; ++j) {
      const unsigned long met = i + j < crossings.count ? i + j : crossings.count - 1;
      of_lane[j] = crossings.planes + crossings.plane_of[crossings.half_facet[met]];
    }
    V n[4], n_low[4];
    Lanes::load(of_lane, n, n_low);

    V slope_low = Lanes::all(0), height_low = n_low[3], along[3], at[3];
    for (int k = 0; k < 3; ++k) {
      along[k] = n[k] * e[k];
      at[k] = n[k] * from[k];
      slope_low = Lanes::multiply_add(
          n[k], e_low[k],
          Lanes::multiply_add(n_low[k], e[k], slope_low + Lanes::product_error(n[k], e[k], along[k])));
      height_low =
          Lanes::multiply_add(-n_low[k], from[k], height_low - Lanes::product_error(n[k], from[k], at[k]));
    }
    V sum, slope, height;
    slope_low = slope_low + sum_with_error(along[0], along[1], sum);
    slope_low = slope_low + sum_with_error(sum, along[2], slope);
    // Along a facet the terms nearly cancel, and the low part may be large beside their sum.
    const V whole_slope = slope + slope_low;
    slope_low = slope_low - (whole_slope - slope);
    slope = whole_slope;
    height_low = height_low + sum_with_error(n[3], -at[0], sum);
    height_low = height_low + sum_with_error(sum, -at[1], height);
    height_low = height_low + sum_with_error(height, -at[2], sum);
    height = sum;

    const V inverse = Lanes::all(1) / slope;
    const V quotient = height * inverse, product = quotient * slope;
    const V rest = ((height - product) - Lanes::product_error(quotient, slope, product)) +
                   (height_low - quotient * slope_low);
    const V correction = rest * inverse;
    const V position = quotient + correction;
    Lanes::store(positions.high + 1 + i, position);
    Lanes::store(positions.low + 1 + i, correction - (position - quotient));
    Lanes::store(positions.error + 1 + i, unit * Lanes::magnitude(inverse));
  }
}

/// Computes the lengths of the pieces of a segment.
/// \return true if each is positive and the double nearest to its exact value
template <class Lanes>
inline bool measure_in_lanes(const Lane_segments& segments, unsigned long segment,
                             const Lane_crossings& crossings, const Lane_positions& positions) {
  using V = typename Lanes::Vector;
  constexpr unsigned long width = Lanes::width;
  positions.high[0] = positions.low[0] = positions.error[0] = 0;
  meet_planes<Lanes>(segments, segment, crossings, positions);
  unsigned long pieces = crossings.count;
  if (!crossings.end_on_last) {
    ++pieces;
    positions.high[pieces] = segments.length_high[segment];
    positions.low[pieces] = segments.length_low[segment];
    positions.error[pieces] = segments.error;
  }
  bool are_certain = true;
  for (unsigned long i = 0; i < pieces; i += width) {
    V difference;
    V low = sum_with_error(Lanes::load(positions.high + i + 1), -Lanes::load(positions.high + i), difference);
    low = low + (Lanes::load(positions.low + i + 1) - Lanes::load(positions.low + i));
    const V length = difference + low;
    low = low - (length - difference);
    const V error = Lanes::load(positions.error + i + 1) + Lanes::load(positions.error + i);
    Lanes::store(positions.length + i, length);
    are_certain &= Lanes::are_certain(length, low, error, pieces - i);
  }
  return are_certain;
}

}  // namespace

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_LANE_LENGTHS_H
