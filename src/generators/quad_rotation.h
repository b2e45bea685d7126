// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to body: cosine and sine of an angle in degrees, by an arithmetic of 113 binary digits that is the
// same on every machine (the functions of the C library differ in their last digits).
#ifndef CELLWALK_GENERATORS_QUAD_ROTATION_H
#define CELLWALK_GENERATORS_QUAD_ROTATION_H

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace cellwalk::detail {

using Quad = boost::multiprecision::cpp_bin_float_quad;

struct Sine_cosine {
  Quad cosine, sine;
};

/// Quarter turns are exact.
/// \pre |degrees| <= 360
inline Sine_cosine sine_cosine(const Quad& degrees) {
  const Quad quarters = floor(degrees / 90 + Quad(0.5));
  const Quad angle =
      (degrees - 90 * quarters) * boost::math::constants::pi<Quad>() / 180;  // at most an eighth
  const Quad c = cos(angle), s = sin(angle);
  switch ((quarters.convert_to<int>() + 4) % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

/// The nearest double.
inline double nearest(const Quad& value) { return value.convert_to<double>(); }

}  // namespace cellwalk::detail

#endif  // CELLWALK_GENERATORS_QUAD_ROTATION_H
