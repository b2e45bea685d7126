// SPDX-License-Identifier: LGPL-3.0-or-later
// A lock-free union-find structure of darts, since Boost's disjoint_sets is for one thread: a root is linked
// only to a lower one, so the root of a finished orbit is its lowest dart, for any order of the unions.
#include "corner_orbits.h"

#include <algorithm>
#include <atomic>

#include "parallel.h"

namespace cellwalk {
namespace {

class Orbits {
 public:
  explicit Orbits(std::size_t n) : parent_(n) {}

  /// Before any union: puts dart d into the orbit of a lower dart, or its own.
  void start(std::uint32_t d, std::uint32_t lower) { parent_[d] = lower; }

  std::uint32_t find(std::uint32_t d) {
    for (;;) {
      const std::uint32_t p = load(d);
      if (p == d) return d;
      const std::uint32_t q = load(p);
      if (p == q) return p;
      std::atomic_ref(parent_[d]).store(q, std::memory_order_relaxed);
      d = q;
    }
  }

  void unite(std::uint32_t a, std::uint32_t b) {
    for (;;) {
      a = find(a);
      b = find(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      std::uint32_t expected = a;
      if (std::atomic_ref(parent_[a]).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
    }
  }

  void flatten(std::uint32_t d) { std::atomic_ref(parent_[d]).store(find(d), std::memory_order_relaxed); }

  std::vector<std::uint32_t> release() { return std::move(parent_); }

 private:
  std::uint32_t load(std::uint32_t d) { return std::atomic_ref(parent_[d]).load(std::memory_order_relaxed); }

  std::vector<std::uint32_t> parent_;
};

/// Joins the darts of one cell that start from the same point: all with the first of them.
template <int D>
void start_cell(const Soup_darts<D>& darts, std::size_t c, Orbits& orbits) {
  const std::uint32_t begin = darts.begin_of_cell(c), end = darts.end_of_cell(c);
  constexpr std::uint32_t few = 64;
  if (D == 2 || end - begin <= few) {
    for (std::uint32_t d = begin; d < end; ++d) {
      std::uint32_t e = D == 2 ? d : begin;
      while (darts.origin(e) != darts.origin(d)) ++e;
      orbits.start(d, e);
    }
    return;
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted;
  for (std::uint32_t d = begin; d < end; ++d) sorted.emplace_back(darts.origin(d), d);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0, first = 0; i < sorted.size(); ++i) {
    if (sorted[i].first != sorted[first].first) first = i;
    orbits.start(sorted[i].second, sorted[first].second);
  }
}

/// The dart after edge d of 2D cell c.
std::uint32_t next_edge(const Cell_soup<2>& soup, std::size_t c, std::uint32_t d) {
  return d + 1 == soup.cell_begin[c + 1] ? soup.cell_begin[c] : d + 1;
}

/// Joins the ends of facet f of cell c with those of its opposite.
void unite_facets(const Cell_soup<2>& soup, const std::vector<std::uint32_t>& cell_of, std::uint32_t f,
                  std::uint32_t g, Orbits& orbits) {
  orbits.unite(f, next_edge(soup, cell_of[g], g));
  orbits.unite(g, next_edge(soup, cell_of[f], f));
}

void unite_facets(const Cell_soup<3>& soup, const std::vector<std::uint32_t>&, std::uint32_t f,
                  std::uint32_t g, Orbits& orbits) {
  const auto a = soup.facet(f), b = soup.facet(g);
  std::size_t j = std::find(b.begin(), b.end(), a[0]) - b.begin();
  for (std::size_t i = 0; i < a.size(); ++i) {
    orbits.unite(soup.facet_begin[f] + static_cast<std::uint32_t>(i),
                 soup.facet_begin[g] + static_cast<std::uint32_t>(j));
    j = j == 0 ? b.size() - 1 : j - 1;
  }
}

}  // namespace

template <int D>
std::vector<std::uint32_t> vertex_orbits(const Cell_soup<D>& soup, const Gluing& gluing) {
  const Soup_darts<D> darts{soup};
  Orbits orbits(darts.count());
  std::vector<std::uint32_t> cell_of(D == 2 ? soup.facet_count() : 0);
  for_each_parallel(soup.cell_count(), [&](std::size_t c) {
    start_cell(darts, c, orbits);
    if constexpr (D == 2)
      std::fill(cell_of.begin() + soup.cell_begin[c], cell_of.begin() + soup.cell_begin[c + 1],
                static_cast<std::uint32_t>(c));
  });
  for_each_parallel(soup.facet_count(), [&](std::size_t f) {
    const std::uint32_t g = gluing.opposite[f];
    if (g != no_facet && f < g) unite_facets(soup, cell_of, static_cast<std::uint32_t>(f), g, orbits);
  });
  for_each_parallel(darts.count(), [&](std::size_t d) { orbits.flatten(static_cast<std::uint32_t>(d)); });
  return orbits.release();
}

template std::vector<std::uint32_t> vertex_orbits(const Cell_soup<2>&, const Gluing&);
template std::vector<std::uint32_t> vertex_orbits(const Cell_soup<3>&, const Gluing&);

}  // namespace cellwalk
