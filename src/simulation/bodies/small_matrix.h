// SPDX-License-Identifier: LGPL-3.0-or-later
// Decompositions of small matrices, with the same bits for every compiler and build type.
#ifndef CELLWALK_SIMULATION_BODIES_SMALL_MATRIX_H
#define CELLWALK_SIMULATION_BODIES_SMALL_MATRIX_H

#include <array>

namespace cellwalk::detail {

/// Rows first.
template <int N>
using Matrix = std::array<std::array<double, static_cast<std::size_t>(N)>, static_cast<std::size_t>(N)>;

template <int N>
struct Pseudo_inverse {
  Matrix<N> matrix{};
  int rank = 0;
};

/// The pseudo-inverse of a symmetric matrix without negative eigenvalues, and its rank. Eigenvalues below
/// `least_share` of the largest one count as zero.
/// \pre finite
template <int N>
Pseudo_inverse<N> pseudo_inverse(const Matrix<N>& moments);

/// Eigenvalues are squares of lengths: a shape is flat where it is thinner than 1e-6 of its size. Rounding of
/// a flat shape that is turned makes eigenvalues of about 1e-16.
constexpr double least_share = 1e-12;

/// U V^T of the singular value decomposition, with the direction of the least singular value turned round
/// where that is a reflection.
/// \pre finite
template <int N>
Matrix<N> rotation_of(const Matrix<N>& matrix);

template <int N>
Matrix<N> identity() {
  Matrix<N> result{};
  for (int i = 0; i < N; ++i) result[i][i] = 1;
  return result;
}

}  // namespace cellwalk::detail

#endif  // CELLWALK_SIMULATION_BODIES_SMALL_MATRIX_H
