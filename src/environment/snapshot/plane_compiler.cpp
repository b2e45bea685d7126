// SPDX-License-Identifier: LGPL-3.0-or-later
// The frame of the planes, and the error analysis of their conversion to single precision.
#include "plane_compiler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellwalk {
namespace {

constexpr double float_unit = 0x1p-24;
constexpr double double_unit = 0x1p-53;
/// The error bound that planes.h states for a stored plane.
constexpr double coefficient_error = 3 * float_unit;

/// Covers the roundings below in double: mapping the point, normalising, the scalar product and the sum of
/// the bound itself are fewer than 40 operations on values of magnitude at most 4.
constexpr double double_slack = 256 * double_unit;

/// Rounds n and -n.y0 to float and accepts them if the error over the box is within the bound. The components
/// of `normal` have absolute errors `normal_error`, neither yet normalised; y0 is the mapped point on the
/// plane.
template <int D>
Float_plane<D> certify_plane(const Vector<D>& normal, const Vector<D>& normal_error, const Point<D>& y0) {
  const double size = length(normal);
  // Squares of smaller or larger components lose accuracy; such planes are left to exact signs.
  if (!(size > 1e-150 && size < 1e150)) return {};
  Float_plane<D> plane;
  double error = double_slack, offset = 0;
  for (int i = 0; i < D; ++i) {
    const double n = normal[i] / size;
    plane.normal[i] = static_cast<float>(n);
    offset -= n * y0[i];
    // The plane function is n.(y - y0) and |y - y0| <= 2 in the box.
    error += std::abs(double{plane.normal[i]} - n) + 2 * normal_error[i] / size;
  }
  plane.offset = static_cast<float>(offset);
  error += std::abs(double{plane.offset} - offset);
  if (!(error <= coefficient_error) || !(std::abs(offset) <= std::sqrt(double{D}) + float_unit)) return {};
  return plane;
}

/// Maps a point of the plane; false if it lies outside the box, where the bound of the offset does not hold.
template <int D>
bool map_exactly(const Plane_frame<D>& frame, const Point<D>& x, Point<D>& y) {
  for (int i = 0; i < D; ++i) {
    y[i] = (x[i] - frame.centre[i]) * frame.scale;
    if (!(std::abs(y[i]) <= 1)) return false;
  }
  return true;
}

}  // namespace

template <int D>
Plane_frame<D> make_frame(std::span<const Point<D>> points) {
  Plane_frame<D> frame;
  frame.scale = std::numeric_limits<double>::quiet_NaN();  // maps nothing
  if (points.empty()) return frame;
  Point<D> low = points[0], high = points[0];
  for (const Point<D>& p : points)
    for (int i = 0; i < D; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  double extent = 0;
  for (int i = 0; i < D; ++i) {
    frame.centre[i] = low[i] / 2 + high[i] / 2;
    extent = std::max({extent, frame.centre[i] - low[i], high[i] - frame.centre[i]});
  }
  if (!(extent > 1e-100 && extent < 1e100)) return frame;
  int exponent = 0;
  std::frexp(extent, &exponent);
  frame.scale = std::ldexp(1.0, -exponent);
  return frame;
}

template Plane_frame<2> make_frame<2>(std::span<const Point<2>>);
template Plane_frame<3> make_frame<3>(std::span<const Point<3>>);

Float_plane<2> make_plane(const Plane_frame<2>& frame, const Point<2>& p0, const Point<2>& p1) {
  Point<2> y0;
  if (!map_exactly(frame, p0, y0)) return {};
  const Vector<2> d = p1 - p0;
  const Vector<2> normal{d[1], -d[0]};
  return certify_plane<2>(normal, {double_unit * std::abs(d[1]), double_unit * std::abs(d[0])}, y0);
}

Float_plane<3> make_plane(const Plane_frame<3>& frame, const Point<3>& p0, const Point<3>& p1,
                          const Point<3>& p2) {
  Point<3> y0;
  if (!map_exactly(frame, p0, y0)) return {};
  const Vector<3> a = p1 - p0, b = p2 - p0;
  Vector<3> error;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    // Each product has two rounded factors and is rounded; so is the difference: 4 units of each magnitude.
    error[i] = 5 * double_unit * (std::abs(a[j] * b[k]) + std::abs(a[k] * b[j]));
  }
  return certify_plane<3>(cross(a, b), error, y0);
}

}  // namespace cellwalk
