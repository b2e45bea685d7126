// SPDX-License-Identifier: LGPL-3.0-or-later
// Rotation matrices in quadruple precision, and the checks of their input.
#include <cellwalk/generators/transform.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "quad_rotation.h"

namespace cellwalk {
namespace {

using detail::Quad;
using detail::Sine_cosine;

template <int D>
using Matrix = std::array<std::array<Quad, static_cast<std::size_t>(D)>, static_cast<std::size_t>(D)>;

[[noreturn]] void refuse(const std::string& what) { throw Error(Error_code::usage, "placement: " + what); }

Sine_cosine sine_cosine_of(double degrees) {
  if (!std::isfinite(degrees)) refuse("the angle of the rotation must be a finite number of degrees");
  return detail::sine_cosine(std::fmod(degrees, 360.0));  // exact
}

Matrix<2> matrix(const Rotation<2>& rotation) {
  const auto [c, s] = sine_cosine_of(rotation.degrees);
  return {{{c, -s}, {s, c}}};
}

/// Rodrigues' formula: c I + (1 - c) u u^T + s [u]x for the unit vector u along the axis.
Matrix<3> matrix(const Rotation<3>& rotation) {
  if (!is_finite(rotation.axis) || rotation.axis == Vector<3>{})
    refuse("the axis of the rotation must be finite and not zero");
  const std::array<Quad, 3> a{rotation.axis[0], rotation.axis[1], rotation.axis[2]};
  const Quad squared = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  const auto [c, s] = sine_cosine_of(rotation.degrees);
  const Quad sine = s / sqrt(squared), rest = 1 - c;
  Matrix<3> m;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) m[i][j] = rest * a[i] * a[j] / squared;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    m[i][i] += c;
    m[k][j] += sine * a[i];
    m[j][k] -= sine * a[i];
  }
  return m;
}

}  // namespace

template <int D>
Body_soup<D> transformed(Body_soup<D> body, const Body_placement<D>& placement) {
  if (!(placement.scale > 0) || !std::isfinite(placement.scale))
    refuse(fmt::format("the scale must be a positive number, not {}", placement.scale));
  Matrix<D> m = matrix(placement.rotation);
  for (auto& row : m)
    for (Quad& x : row) x *= placement.scale;
  for (std::size_t v = 0; v < body.points.size(); ++v) {
    const Point<D> p = body.points[v];
    for (std::size_t i = 0; i < D; ++i) {
      Quad sum = placement.position[i];
      for (std::size_t j = 0; j < D; ++j) sum += m[i][j] * p[j];
      body.points[v][i] = detail::nearest(sum) + 0.0;  // no -0
    }
    if (!is_finite(body.points[v]))
      refuse(fmt::format("vertex {} gets a coordinate that is not finite: choose a smaller scale or position",
                         v));
  }
  for (double& radius : body.radii) radius *= placement.scale;
  return body;
}

template Body_soup<2> transformed(Body_soup<2>, const Body_placement<2>&);
template Body_soup<3> transformed(Body_soup<3>, const Body_placement<3>&);

}  // namespace cellwalk
