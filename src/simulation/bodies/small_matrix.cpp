// SPDX-License-Identifier: LGPL-3.0-or-later
// Two-sided Jacobi rotations add and multiply single numbers in a fixed order. Without vectorisation, so do
// Eigen's products of small matrices; with it, the order of sums would depend on the instruction set.
#define EIGEN_DONT_VECTORIZE

#include "small_matrix.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <Eigen/SVD>

namespace cellwalk::detail {
namespace {

// Types of this file only: other files that use Eigen with vectorisation must not share their functions.
template <int N>
using Square = Eigen::Matrix<double, N, N, Eigen::RowMajor | Eigen::DontAlign>;

template <int N>
Square<N> to_eigen(const Matrix<N>& m) {
  Square<N> result;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) result(i, j) = m[i][j];
  return result;
}

}  // namespace

template <int N>
Pseudo_inverse<N> pseudo_inverse(const Matrix<N>& moments) {
  const Eigen::JacobiSVD<Square<N>> svd(to_eigen<N>(moments), Eigen::ComputeFullU | Eigen::ComputeFullV);
  Pseudo_inverse<N> result;
  const auto& values = svd.singularValues();
  for (int k = 0; k < N && values[k] > least_share * values[0]; ++k) {
    ++result.rank;
    for (int i = 0; i < N; ++i)
      for (int j = 0; j < N; ++j)
        result.matrix[i][j] += svd.matrixV()(i, k) * svd.matrixU()(j, k) / values[k];
  }
  return result;
}

template <int N>
Matrix<N> rotation_of(const Matrix<N>& matrix) {
  const Eigen::JacobiSVD<Square<N>> svd(to_eigen<N>(matrix), Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Square<N>&u = svd.matrixU(), &v = svd.matrixV();
  const double last = u.determinant() * v.determinant() < 0 ? -1 : 1;
  Matrix<N> result{};
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) {
      for (int k = 0; k + 1 < N; ++k) result[i][j] += u(i, k) * v(j, k);
      result[i][j] += last * u(i, N - 1) * v(j, N - 1);
    }
  return result;
}

template Pseudo_inverse<2> pseudo_inverse<2>(const Matrix<2>&);
template Pseudo_inverse<3> pseudo_inverse<3>(const Matrix<3>&);
template Pseudo_inverse<5> pseudo_inverse<5>(const Matrix<5>&);
template Pseudo_inverse<9> pseudo_inverse<9>(const Matrix<9>&);
template Matrix<2> rotation_of<2>(const Matrix<2>&);
template Matrix<3> rotation_of<3>(const Matrix<3>&);

}  // namespace cellwalk::detail
