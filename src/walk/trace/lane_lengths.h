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
// of the difference of two positions. The length of the segment itself is known within 2^6 u^2 M. Its two
// ends have the error of one unit, though the start has none.
//
// The bound holds at ridges and vertices, too: those of a facet lie in its plane, which a segment that passes
// them meets there and nowhere else, if n.e is not 0; and if it is, the error leaves all lengths open.
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

/// The most that lanes read or write beyond the end of an array, and which has to be there.
inline constexpr unsigned long lane_room = 8;

/// The facets that a segment meets, in order.
struct Lane_crossings {
  const Lane_plane* planes;    ///< of all half-facets
  const unsigned* half_facet;  ///< every stride-th is one that is met; lane_room others follow
  unsigned long stride, count;
  bool end_on_last;  ///< the last of them ends the segment
};

/// Where pieces begin and end, as quotients height / slope. Each segment has a place that is no number, its
/// start, which is at 0, and then the places of facets, to its end. The first of these parts segments: no
/// length up to it, or from it on, is certain. Arrays with room for lane_room more.
struct Lane_places {
  double *height_high, *height_low, *slope_high, *slope_low;
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

/// Appends the places of a segment at the index `at`, which is raised to the end.
template <class Lanes>
inline void place_in_lanes(const Lane_segments& segments, unsigned long segment,
                           const Lane_crossings& crossings, const Lane_places& places, unsigned long& at) {
  using V = typename Lanes::Vector;
  const auto put = [&](double height, double low) {
    places.height_high[at] = height;
    places.height_low[at] = low;
    places.slope_high[at] = 1;
    places.slope_low[at] = 0;
    ++at;
  };
  put(__builtin_nan(""), 0);
  put(0, 0);
  V from[3], e[3], e_low[3];
  for (int k = 0; k < 3; ++k) {
    from[k] = Lanes::all(segments.from[k][segment]);
    e[k] = Lanes::all(segments.direction_high[k][segment]);
    e_low[k] = Lanes::all(segments.direction_low[k][segment]);
  }
  double *const height_high = places.height_high + at, *const height_low = places.height_low + at,
                *const slope_high = places.slope_high + at, *const slope_low = places.slope_low + at;
  const unsigned long count = crossings.count, stride = crossings.stride;
  const unsigned* const half_facet = crossings.half_facet;
  const Lane_plane* const planes = crossings.planes;
  for (unsigned long i = 0; i < count; i += Lanes::width) {
    V n[4], n_low[4];
    Lanes::load(planes, half_facet + i * stride, stride, n, n_low);
    V along[3], along_low[3], across[3], across_low[3];
    for (int k = 0; k < 3; ++k) {
      along[k] = n[k] * e[k];
      across[k] = n[k] * from[k];
      along_low[k] = Lanes::multiply_add(
          n[k], e_low[k], Lanes::multiply_add(n_low[k], e[k], Lanes::product_error(n[k], e[k], along[k])));
      across_low[k] = Lanes::multiply_add(n_low[k], from[k], Lanes::product_error(n[k], from[k], across[k]));
    }
    V sum, slope, height;
    V low = (along_low[0] + along_low[1]) + along_low[2];
    low = low + sum_with_error(along[0], along[1], sum);
    low = low + sum_with_error(sum, along[2], slope);
    // Along a facet the terms nearly cancel, and the low part may be large beside their sum.
    const V whole_slope = slope + low;
    Lanes::store(slope_high + i, whole_slope);
    Lanes::store(slope_low + i, low - (whole_slope - slope));
    low = (n_low[3] - across_low[0]) - (across_low[1] + across_low[2]);
    low = low + sum_with_error(n[3], -across[0], sum);
    low = low + sum_with_error(sum, -across[1], height);
    low = low + sum_with_error(height, -across[2], sum);
    Lanes::store(height_high + i, sum);
    Lanes::store(height_low + i, low);
  }
  at += crossings.count;
  if (!crossings.end_on_last) put(segments.length_high[segment], segments.length_low[segment]);
}

/// Computes the length of the piece between each of `count` places and the one before: the double nearest to
/// the exact length, or 0 where that is not certain.
/// \param error that of Lane_segments
/// \return how many are certain: of each segment all but two if the lengths of its pieces are
template <class Lanes>
inline unsigned long measure_in_lanes(const Lane_places& places, unsigned long count, double error,
                                      double* lengths) {
  using V = typename Lanes::Vector;
  unsigned long certain = 0;
  const V unit = Lanes::all(error);
  V before = Lanes::all(0), before_low = before, before_error = before;
  for (unsigned long i = 0; i < count; i += Lanes::width) {
    const V slope = Lanes::load(places.slope_high + i), height = Lanes::load(places.height_high + i);
    const V inverse = Lanes::all(1) / slope;
    const V quotient = height * inverse, product = quotient * slope;
    const V rest = ((height - product) - Lanes::product_error(quotient, slope, product)) +
                   (Lanes::load(places.height_low + i) - quotient * Lanes::load(places.slope_low + i));
    const V correction = rest * inverse;
    const V end = quotient + correction, end_low = correction - (end - quotient),
            end_error = unit * Lanes::magnitude(inverse);
    V difference;
    V low = sum_with_error(end, -Lanes::shift(before, end), difference);
    low = low + (end_low - Lanes::shift(before_low, end_low));
    const V length = difference + low;
    low = low - (length - difference);
    certain += Lanes::store_certain(lengths + i, length, low,
                                    Lanes::shift(before_error, end_error) + end_error, count - i);
    before = end;
    before_low = end_low;
    before_error = end_error;
  }
  return certain;
}

}  // namespace

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_LANE_LENGTHS_H
