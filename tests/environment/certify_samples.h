// SPDX-License-Identifier: LGPL-3.0-or-later
// Small complexes by hand, and an exact test of overlap that shares nothing with the library.
#ifndef CELLWALK_TESTS_ENVIRONMENT_CERTIFY_SAMPLES_H
#define CELLWALK_TESTS_ENVIRONMENT_CERTIFY_SAMPLES_H

#include <cellwalk/environment/certify.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/kernel/error.h>

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "cell_samples.h"

namespace cellwalk::test {

template <int D>
Sample_cell<D> moved(Sample_cell<D> cell, const Point<D>& by) {
  for (Point<D>& p : cell.points) p = p + by;
  return cell;
}

/// Appends the cells of a soup; points in the same place become one if asked for.
template <int D>
void append(Cell_soup<D>& soup, const Cell_soup<D>& other, bool merge) {
  std::vector<std::uint32_t> number;
  for (const Point<D>& p : other.points) {
    const auto same = std::find(soup.points.begin(), soup.points.end(), p);
    const bool found = merge && same != soup.points.end();
    number.push_back(static_cast<std::uint32_t>(found ? same - soup.points.begin() : soup.points.size()));
    if (!found) soup.points.push_back(p);
  }
  for (std::size_t c = 0; c < other.cell_count(); ++c) {
    for (std::size_t f = other.cell_begin[c]; f < other.cell_begin[c + 1]; ++f) {
      std::vector<std::uint32_t> loop;
      for (const std::uint32_t v : other.facet(f)) loop.push_back(number[v]);
      soup.add_facet(loop, other.impassable[f]);
    }
    soup.end_cell(other.solid[c]);
  }
}

template <int D>
Certificate certificate_of(const Cell_soup<D>& soup, bool allow_duplicates = false) {
  return certify(Snapshot<D>::compile(soup, glue(soup)), allow_duplicates);
}

/// Why a soup is refused; empty if it is not.
template <int D>
std::string refusal_or_none(const Cell_soup<D>& soup, bool allow_duplicates = false,
                            const std::optional<Gluing>& gluing = {}) {
  const Snapshot<D> snapshot = Snapshot<D>::compile(soup, gluing ? *gluing : glue(soup));
  try {
    certify(snapshot, allow_duplicates);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Error_code::not_certified);
    return error.what();
  }
  return {};
}

template <int D>
std::string refusal_of(const Cell_soup<D>& soup, bool allow_duplicates = false) {
  const std::string message = refusal_or_none(soup, allow_duplicates);
  EXPECT_FALSE(message.empty());
  EXPECT_EQ(message.find('\n'), std::string::npos);
  return message;
}

template <int D>
std::string refusal_of(const Cell_soup<D>& soup, const Gluing& gluing) {
  return refusal_or_none(soup, false, gluing);
}

/// Triangles round the origin, `per_turn` to a turn, spiralling outwards so that no vertices coincide.
/// Exactly per_turn of them turn exactly once. Closed: the last one ends where the first begins.
inline Cell_soup<2> ring(int cells, int per_turn, bool closed) {
  Cell_soup<2> soup;
  soup.points.push_back({0, 0});
  const std::array<Point<2>, 5> rays{{{4, 0}, {1, 4}, {-3, 2}, {-3, -2}, {1, -4}}};
  for (int i = 0; i < cells + !closed; ++i) soup.points.push_back((1 + 0.125 * i) * rays[i % per_turn]);
  for (int i = 0; i < cells; ++i) {
    const auto u = static_cast<std::uint32_t>(1 + i);
    const auto v = static_cast<std::uint32_t>(closed ? 1 + (i + 1) % cells : 2 + i);
    add_polygon(soup, std::vector<std::uint32_t>{0, u, v});
  }
  return soup;
}

/// The prisms over the triangles of a plane complex.
inline Cell_soup<3> prisms(const Cell_soup<2>& flat) {
  Cell_soup<3> soup;
  const auto n = static_cast<std::uint32_t>(flat.points.size());
  for (const double z : {0.0, 1.0})
    for (const Point<2>& p : flat.points) soup.points.push_back({p[0], p[1], z});
  for (std::size_t c = 0; c < flat.cell_count(); ++c) {
    std::array<std::uint32_t, 6> v;
    for (std::uint32_t i = 0; i < 3; ++i) {
      v[i] = flat.facet(flat.cell_begin[c] + i)[0];
      v[i + 3] = v[i] + n;
    }
    add_prism(soup, v);
  }
  return soup;
}

/// An open half-space a.x < b, in rationals.
template <int D>
struct Half_space {
  std::array<Rational, D> a;
  Rational b;
};

inline Half_space<3> half_space(const std::array<Point<3>, 3>& p) {
  std::array<Rational, 3> u, v, a;
  for (int i = 0; i < 3; ++i) {
    u[i] = Rational(p[1][i]) - Rational(p[0][i]);
    v[i] = Rational(p[2][i]) - Rational(p[0][i]);
  }
  Rational b = 0;
  for (int i = 0; i < 3; ++i) {
    a[i] = u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3];
    b += a[i] * Rational(p[0][i]);
  }
  return {a, b};
}

inline Half_space<2> half_space(const std::array<Point<2>, 2>& p) {
  const std::array<Rational, 2> a{Rational(p[1][1]) - Rational(p[0][1]),
                                  Rational(p[0][0]) - Rational(p[1][0])};
  return {a, a[0] * Rational(p[0][0]) + a[1] * Rational(p[0][1])};
}

/// Solves the D equations a.x = b by elimination; nothing if they are dependent.
template <int D>
std::optional<std::array<Rational, D>> common_point(std::array<Half_space<D>, D> rows) {
  for (int i = 0; i < D; ++i) {
    int pivot = i;
    while (pivot < D && rows[pivot].a[i] == 0) ++pivot;
    if (pivot == D) return {};
    std::swap(rows[i], rows[pivot]);
    for (int k = 0; k < D; ++k) {
      if (k == i || rows[k].a[i] == 0) continue;
      const Rational factor = rows[k].a[i] / rows[i].a[i];
      for (int j = 0; j < D; ++j) rows[k].a[j] -= factor * rows[i].a[j];
      rows[k].b -= factor * rows[i].b;
    }
  }
  std::array<Rational, D> x;
  for (int i = 0; i < D; ++i) x[i] = rows[i].b / rows[i].a[i];
  return x;
}

template <int D>
Rational excess(const Half_space<D>& h, const std::array<Rational, D>& x) {
  Rational sum = -h.b;
  for (int i = 0; i < D; ++i) sum += h.a[i] * x[i];
  return sum;
}

/// True if two simplices have interior points in common: the mean of all corners of their intersection is
/// then strictly inside both.
template <int D>
bool interiors_meet(const Cell_soup<D>& soup, std::size_t c, std::size_t d) {
  std::vector<Half_space<D>> planes;
  for (const std::size_t cell : {c, d})
    for (std::size_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f) {
      std::array<Point<D>, D> p;
      for (int i = 0; i < D; ++i) p[i] = soup.points[soup.facet(f)[i]];
      planes.push_back(half_space(p));
    }
  std::array<Rational, D> sum{};
  int corners = 0;
  std::vector<std::size_t> chosen(D);
  for (unsigned subset = 0; subset < 1u << planes.size(); ++subset) {
    if (__builtin_popcount(subset) != D) continue;
    std::array<Half_space<D>, D> rows;
    for (std::size_t i = 0, k = 0; i < planes.size(); ++i)
      if (subset >> i & 1) rows[k++] = planes[i];
    const auto x = common_point<D>(rows);
    if (!x) continue;
    if (std::any_of(planes.begin(), planes.end(), [&](const auto& h) { return excess<D>(h, *x) > 0; }))
      continue;
    for (int i = 0; i < D; ++i) sum[i] += (*x)[i];
    ++corners;
  }
  if (corners == 0) return false;
  for (Rational& x : sum) x /= corners;
  return std::all_of(planes.begin(), planes.end(), [&](const auto& h) { return excess<D>(h, sum) < 0; });
}

/// True if the open bounding boxes of two cells meet.
template <int D>
bool boxes_meet(const Cell_soup<D>& soup, std::size_t c, std::size_t d) {
  const auto range = [&](std::size_t cell, int i) {
    double low = 1e300, high = -1e300;
    for (std::size_t f = soup.cell_begin[cell]; f < soup.cell_begin[cell + 1]; ++f)
      for (const std::uint32_t v : soup.facet(f)) {
        low = std::min(low, soup.points[v][i]);
        high = std::max(high, soup.points[v][i]);
      }
    return std::pair{low, high};
  };
  for (int i = 0; i < D; ++i)
    if (!(range(c, i).first < range(d, i).second && range(d, i).first < range(c, i).second)) return false;
  return true;
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_ENVIRONMENT_CERTIFY_SAMPLES_H
