// SPDX-License-Identifier: LGPL-3.0-or-later
// The moments of a shape, their nearest rotation, and the scaling that keeps the volume.
#include <cellwalk/internal/simulation/shape_matching.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "small_matrix.h"

namespace cellwalk {
namespace {

/// A body that was pressed flat is not blown up by more than this factor a step to have its volume again.
constexpr double most_inflation = 2;

template <int D>
Point<D> centre_of(std::span<const Point<D>> points, const std::vector<double>& masses, double total) {
  Vector<D> sum{};  // from the first point: less is rounded away far from the origin
  for (std::size_t i = 0; i < points.size(); ++i) sum = sum + masses[i] * (points[i] - points[0]);
  return points[0] + (1 / total) * sum;
}

double determinant(const std::array<Vector<2>, 2>& m) { return m[0][0] * m[1][1] - m[0][1] * m[1][0]; }
double determinant(const std::array<Vector<3>, 3>& m) { return dot(m[0], cross(m[1], m[2])); }

template <int D>
double root(double x) {
  return D == 2 ? std::sqrt(x) : std::cbrt(x);
}

/// a * b, the rows of a being as long as b has rows.
template <std::size_t Rows, std::size_t Inner, std::size_t Columns>
std::array<std::array<double, Columns>, Rows> product(
    const std::array<std::array<double, Inner>, Rows>& a,
    const std::array<std::array<double, Columns>, Inner>& b) {
  std::array<std::array<double, Columns>, Rows> result{};
  for (std::size_t i = 0; i < Rows; ++i)
    for (std::size_t k = 0; k < Inner; ++k)
      for (std::size_t j = 0; j < Columns; ++j) result[i][j] += a[i][k] * b[k][j];
  return result;
}

/// sum += mass * p q^T
template <std::size_t Rows, std::size_t Columns>
void add_moment(std::array<std::array<double, Columns>, Rows>& sum, double mass,
                const std::array<double, Rows>& p, const std::array<double, Columns>& q) {
  for (std::size_t i = 0; i < Rows; ++i)
    for (std::size_t j = 0; j < Columns; ++j) sum[i][j] += mass * p[i] * q[j];
}

}  // namespace

template <int D>
std::array<Vector<D>, D> nearest_rotation(const std::array<Vector<D>, D>& matrix) {
  for (const Vector<D>& row : matrix)
    if (!is_finite(row)) return detail::identity<D>();
  return detail::rotation_of<D>(matrix);
}

template <int D>
Shape_matching<D>::Shape_matching(std::span<const Point<D>> rest, const Shape_material& material,
                                  std::span<const double> masses)
    : material_(material), masses_(masses.begin(), masses.end()) {
  masses_.resize(rest.size(), 1.0);
  for (const double mass : masses_) total_mass_ += mass;
  const Point<D> centre = centre_of<D>(rest, masses_, total_mass_);
  double radius = 0;
  for (const Point<D>& x : rest) {
    rest_.push_back(x - centre);
    for (const double c : rest_.back()) radius = std::max(radius, std::abs(c));
  }
  if (radius > 0) radius_ = radius;
  std::array<Vector<D>, D> moments{};
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    for (double& c : rest_[i]) c /= radius_;
    add_moment(moments, masses_[i], rest_[i], rest_[i]);
  }
  const auto inverse = detail::pseudo_inverse<D>(moments);
  linear_inverse_ = inverse.matrix;
  is_full_ = inverse.rank == D;
  if (material.mode != Shape_mode::quadratic) return;
  Monomials mean{};
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    Monomials m{};
    int k = 0;
    for (; k < D; ++k) m[k] = rest_[i][k];
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b) m[k++] = rest_[i][a] * rest_[i][b];
    for (std::size_t n = 0; n < m.size(); ++n) mean[n] += masses_[i] / total_mass_ * m[n];
    monomials_.push_back(m);
  }
  // Without their means, so that bending does not move the centre of mass.
  std::array<Monomials, most_monomials> all{};
  for (std::size_t i = 0; i < rest_.size(); ++i) {
    for (std::size_t n = D; n < mean.size(); ++n) monomials_[i][n] -= mean[n];
    add_moment(all, masses_[i], monomials_[i], monomials_[i]);
  }
  inverse_ = detail::pseudo_inverse<most_monomials>(all).matrix;
}

template <int D>
void Shape_matching<D>::goals(std::span<const Point<D>> positions, std::span<Point<D>> result) const {
  const Point<D> centre = centre_of<D>(positions, masses_, total_mass_);
  std::array<Vector<D>, D> moments{};
  const auto place = [&](std::size_t i) { return (1 / radius_) * (positions[i] - centre); };
  for (std::size_t i = 0; i < rest_.size(); ++i) add_moment(moments, masses_[i], place(i), rest_[i]);
  const std::array<Vector<D>, D> rotation = nearest_rotation<D>(moments);

  const double deformed = material_.mode == Shape_mode::rigid ? 0 : material_.deformation;
  const auto mixed = [&](double linear, double rigid) { return deformed * linear + (1 - deformed) * rigid; };
  if (material_.mode == Shape_mode::quadratic) {
    std::array<Monomials, D> sums{};
    for (std::size_t i = 0; i < rest_.size(); ++i) add_moment(sums, masses_[i], place(i), monomials_[i]);
    std::array<Monomials, D> map = product(sums, inverse_);
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < most_monomials; ++j) map[i][j] = mixed(map[i][j], j < D ? rotation[i][j] : 0);
    for (std::size_t i = 0; i < rest_.size(); ++i)
      for (int k = 0; k < D; ++k) result[i][k] = centre[k] + radius_ * dot(map[k], monomials_[i]);
    return;
  }
  std::array<Vector<D>, D> map = rotation;
  if (material_.mode == Shape_mode::linear) {
    std::array<Vector<D>, D> linear = product(moments, linear_inverse_);
    if (material_.keeps_volume && is_full_) {
      const double volume = determinant(linear);
      // A flat or inverted shape has no scale that gives it the volume of the rest shape; the rotation has
      // it.
      if (volume > 0)
        for (Vector<D>& row : linear) row = std::min(most_inflation, 1 / root<D>(volume)) * row;
      else
        linear = rotation;
    }
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) map[i][j] = mixed(linear[i][j], rotation[i][j]);
  }
  for (std::size_t i = 0; i < rest_.size(); ++i)
    for (int k = 0; k < D; ++k) result[i][k] = centre[k] + radius_ * dot(map[k], rest_[i]);
}

template class Shape_matching<2>;
template class Shape_matching<3>;
template std::array<Vector<2>, 2> nearest_rotation<2>(const std::array<Vector<2>, 2>&);
template std::array<Vector<3>, 3> nearest_rotation<3>(const std::array<Vector<3>, 3>&);

}  // namespace cellwalk
