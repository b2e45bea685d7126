// SPDX-License-Identifier: LGPL-3.0-or-later
// The counts of a certificate.
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <numeric>

#include "complex.h"

namespace cellwalk::detail {
namespace {

/// Classes of joined numbers, joined from many threads. The least member of a class is its root, so the
/// result does not depend on the order.
class Classes {
 public:
  explicit Classes(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0u); }

  void join(std::uint32_t a, std::uint32_t b) {
    for (;;) {
      a = root(a);
      b = root(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      std::uint32_t expected = a;
      if (at(a).compare_exchange_strong(expected, b)) return;
    }
  }

  bool is_root(std::uint32_t a) const { return parent_[a] == a; }

 private:
  std::atomic_ref<std::uint32_t> at(std::uint32_t a) { return std::atomic_ref<std::uint32_t>(parent_[a]); }

  std::uint32_t root(std::uint32_t a) {
    for (;;) {
      std::uint32_t up = at(a).load(std::memory_order_relaxed);
      if (up == a) return a;
      const std::uint32_t upper = at(up).load(std::memory_order_relaxed);
      if (upper != up) at(a).compare_exchange_weak(up, upper, std::memory_order_relaxed);
      a = upper;
    }
  }

  std::vector<std::uint32_t> parent_;
};

/// Joins the corners of the two sides of a facet.
template <int D>
void join_corners(const Complex<D>& complex, Half_facet f, Half_facet g, Classes& corners) {
  const Snapshot<D>& snapshot = complex.snapshot();
  const Cell c = snapshot.cell_of(f), d = snapshot.cell_of(g);
  const Cell_view<D> own = snapshot.view(c), other = snapshot.view(d);
  const auto loop = own.loop(snapshot.facet_of(f)), reversed = other.loop(snapshot.facet_of(g));
  const std::size_t n = loop.size();
  std::size_t start = 0;
  while (other.point_index(reversed[start]) != own.point_index(loop[0])) ++start;
  for (std::size_t i = 0; i < n; ++i)
    corners.join(complex.first_corner(c) + loop[i], complex.first_corner(d) + reversed[(start + n - i) % n]);
}

/// D! times the volume (2D: area), rounded: exact if coordinates are small multiples of a power of two.
double scaled_volume(const Cell_view<3>& cell) {
  const Point<3>& o = cell.point(0);
  double sum = 0;
  for (std::size_t f = 0; f < cell.facet_count(); ++f) {
    const auto loop = cell.loop(f);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += dot(cell.point(loop[0]) - o, cross(cell.point(loop[i]) - o, cell.point(loop[i + 1]) - o));
  }
  return sum;
}

double scaled_volume(const Cell_view<2>& cell) {
  const Point<2>& o = cell.point(0);
  double sum = 0;
  for (std::size_t f = 0; f < cell.facet_count(); ++f) {
    const Vector<2> a = cell.point(cell.loop(f)[0]) - o, b = cell.point(cell.loop(f)[1]) - o;
    sum += a[0] * b[1] - a[1] * b[0];
  }
  return sum;
}

/// Sums in an order that does not depend on the number of threads.
template <int D>
void add_volumes(const Snapshot<D>& snapshot, Certificate& certificate) {
  struct Sums {
    double all = 0, free = 0;
  };
  const Sums sums = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, snapshot.cell_slots(), 4096), Sums{},
      [&](const auto& range, Sums sum) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          const Cell c = snapshot.cell(i);
          if (c == Cell::none) continue;
          const double v = scaled_volume(snapshot.view(c));
          sum.all += v;
          if (!snapshot.is_solid(c)) sum.free += v;
        }
        return sum;
      },
      [](const Sums& a, const Sums& b) {
        return Sums{a.all + b.all, a.free + b.free};
      });
  constexpr double scale = D == 2 ? 2 : 6;
  certificate.volume = sums.all / scale;
  certificate.free_volume = sums.free / scale;
}

/// Counts vertices in use, and those with more than one class of corners.
template <int D>
void count_vertices(const Complex<D>& complex, const Classes& corners, Certificate& certificate) {
  const Snapshot<D>& snapshot = complex.snapshot();
  std::vector<std::uint8_t> classes(snapshot.points().size(), 0);  // 0, 1, or 2 for more
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none) continue;
    const auto vertices = snapshot.view(c).vertices;
    for (std::uint32_t k = 0; k < vertices.size(); ++k)
      if (corners.is_root(complex.first_corner(c) + k))
        classes[vertices[k]] = static_cast<std::uint8_t>(std::min(classes[vertices[k]] + 1, 2));
  }
  for (const std::uint8_t n : classes) {
    certificate.vertices += n > 0;
    certificate.pinched_vertices += n > 1;
  }
}

}  // namespace

template <int D>
Certificate count_cells(const Complex<D>& complex) {
  const Snapshot<D>& snapshot = complex.snapshot();
  Certificate total;
  Classes corners(complex.corner_count()), cells(snapshot.half_facet_slots() / 4);
  complex.for_each_cell([&] {
    return [&](Cell c) {
      for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
        const Half_facet f = snapshot.half_facet(c, i), g = complex.opposite(f);
        if (g == Half_facet::none || g < f) continue;
        join_corners(complex, f, g, corners);
        if (!snapshot.is_impassable(f) && !snapshot.is_solid(c))
          cells.join(to_index(c), to_index(snapshot.cell_of(g)));
      }
    };
  });
  for (std::size_t k = 0; k < snapshot.cell_slots(); ++k) {
    const Cell c = snapshot.cell(k);
    if (c == Cell::none) continue;
    ++total.cells;
    total.solid_cells += snapshot.is_solid(c);
    total.components += !snapshot.is_solid(c) && cells.is_root(to_index(c));
    for (std::size_t i = 0; i < snapshot.facet_count(c); ++i) {
      const Half_facet f = snapshot.half_facet(c, i), g = complex.opposite(f);
      if (g != Half_facet::none && g < f) continue;
      ++total.facets;
      total.walls += snapshot.is_impassable(f);
      total.boundary_facets += g == Half_facet::none;
      total.membranes += g != Half_facet::none && snapshot.is_impassable(f) && !snapshot.is_solid(c) &&
                         !snapshot.is_solid(snapshot.cell_of(g));
    }
  }
  count_vertices(complex, corners, total);
  add_volumes(snapshot, total);
  return total;
}

template Certificate count_cells(const Complex<2>&);
template Certificate count_cells(const Complex<3>&);

}  // namespace cellwalk::detail
