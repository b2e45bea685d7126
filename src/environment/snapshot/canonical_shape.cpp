// SPDX-License-Identifier: LGPL-3.0-or-later
// A traversal of the facets of a cell, edge by edge, which numbers vertices as it meets them.
#include "canonical_shape.h"

#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>

namespace cellwalk {
namespace {

constexpr std::uint16_t unseen = std::numeric_limits<std::uint16_t>::max();

/// The entry of the traversal into a facet: its number in the cell, and the position in its loop at which the
/// traversal starts.
struct Entry {
  std::uint16_t facet;
  std::uint16_t start;
};

/// The facet at each directed edge of the cell, by local vertex numbers of first appearance.
class Edge_table {
 public:
  void reset(std::size_t vertex_count) {
    count_ = vertex_count;
    entries_.assign(vertex_count * vertex_count, Entry{unseen, 0});
  }
  Entry& at(std::size_t u, std::size_t v) { return entries_[u * count_ + v]; }

 private:
  std::size_t count_ = 0;
  std::vector<Entry> entries_;
};

/// Buffers of one thread.
struct Scratch {
  std::vector<std::uint32_t> points;    // distinct point indices by first appearance
  std::vector<std::uint16_t> local;     // local number by first appearance, for each loop entry of the cell
  std::vector<std::uint16_t> renumber;  // canonical number of each local vertex
  std::vector<std::uint8_t> reached;    // per facet
  std::vector<Entry> queue;
  Edge_table edges;
};

template <int D>
void number_by_appearance(const Cell_soup<D>& soup, std::size_t c, Scratch& s) {
  s.points.clear();
  s.local.clear();
  const std::size_t begin = soup.facet_begin[soup.cell_begin[c]],
                    end = soup.facet_begin[soup.cell_begin[c + 1]];
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint32_t v = soup.vertices[i];
    const auto it = std::find(s.points.begin(), s.points.end(), v);
    s.local.push_back(static_cast<std::uint16_t>(it - s.points.begin()));
    if (it == s.points.end()) s.points.push_back(v);
  }
  if (s.points.size() >= unseen / 4 || s.local.size() >= unseen)
    throw Error(Error_code::input, "cell " + std::to_string(c) + " has more than 16,000 vertices: split it");
}

/// The result of the traversal for a tetrahedron, without one. False if the cell is none.
bool canonicalize_tetrahedron(const Cell_soup<3>& soup, std::size_t c, Canonical_cell& out) {
  const std::uint32_t first = soup.cell_begin[c];
  if (soup.cell_begin[c + 1] - first != 4) return false;
  for (std::uint32_t f = first; f < first + 4; ++f)
    if (soup.facet(f).size() != 3) return false;
  const auto base = soup.facet(first);
  const std::uint32_t a = base[0], b = base[1], e = base[2];
  // Beyond the edges of the base in their order, each facet with its edge reversed, then the apex.
  const std::array<std::array<std::uint32_t, 2>, 3> edges{{{b, a}, {e, b}, {a, e}}};
  std::array<std::uint32_t, 3> facets{}, apices{};
  for (std::size_t k = 0; k < 3; ++k) {
    std::uint32_t f = first;
    bool is_found = false;
    while (!is_found && ++f < first + 4) {
      const auto loop = soup.facet(f);
      for (std::size_t i = 0; i < 3 && !is_found; ++i)
        if (loop[i] == edges[k][0] && loop[(i + 1) % 3] == edges[k][1]) {
          facets[k] = f;
          apices[k] = loop[(i + 2) % 3];
          is_found = true;
        }
    }
    if (!is_found) return false;
  }
  const std::uint32_t d = apices[0];
  if (apices[1] != d || apices[2] != d || d == a || d == b || d == e) return false;
  if (facets[0] == facets[1] || facets[1] == facets[2] || facets[0] == facets[2]) return false;
  out.shape.vertex_count = 4;
  out.shape.loop_begin.assign({0, 3, 6, 9, 12});
  out.shape.loops.assign({0, 1, 2, 1, 0, 3, 2, 1, 3, 0, 2, 3});
  out.vertices.assign({a, b, e, d});
  out.facets.assign({first, facets[0], facets[1], facets[2]});
  return true;
}

}  // namespace

void turn_off_line(std::span<const Point<3>> points, std::span<const std::uint32_t> vertices,
                   std::span<std::uint16_t> loop) {
  const std::size_t n = loop.size();
  if (n <= 3) return;
  const auto at = [&](std::size_t i) -> const Point<3>& { return points[vertices[loop[i % n]]]; };
  for (std::size_t i = 0; i < n; ++i) {
    if (are_collinear(at(i), at(i + 1), at(i + 2))) continue;
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(i), loop.end());
    return;
  }
}

template <int D>
void canonicalize(const Cell_soup<D>& soup, std::span<const Point<D>> points, std::size_t c,
                  Canonical_cell& out) {
  if constexpr (D == 3)
    if (canonicalize_tetrahedron(soup, c, out)) return;
  thread_local Scratch s;
  number_by_appearance(soup, c, s);
  const std::uint32_t first_facet = soup.cell_begin[c];
  const std::size_t facets = soup.cell_begin[c + 1] - first_facet;
  const std::uint32_t first_entry = soup.facet_begin[first_facet];
  const auto loop_of = [&](std::size_t f) {
    const std::uint32_t begin = soup.facet_begin[first_facet + f] - first_entry;
    const std::uint32_t end = soup.facet_begin[first_facet + f + 1] - first_entry;
    return std::span<const std::uint16_t>(s.local.data() + begin, s.local.data() + end);
  };
  s.edges.reset(s.points.size());
  for (std::size_t f = 0; f < facets; ++f) {
    const auto loop = loop_of(f);
    // In 2D a facet is one directed edge; the next one around the cell starts at its end.
    const std::size_t edges_of_loop = D == 2 ? 1 : loop.size();
    for (std::size_t i = 0; i < edges_of_loop; ++i) {
      const Entry entry{static_cast<std::uint16_t>(f), static_cast<std::uint16_t>(i)};
      if constexpr (D == 2)
        s.edges.at(loop[0], 0) = entry;
      else
        s.edges.at(loop[i], loop[(i + 1) % loop.size()]) = entry;
    }
  }

  out.shape.loop_begin.assign(1, 0);
  out.shape.loops.clear();
  out.shape.vertex_count = static_cast<std::uint16_t>(s.points.size());
  out.vertices.clear();
  out.facets.clear();
  s.renumber.assign(s.points.size(), unseen);
  s.reached.assign(facets, 0);
  s.queue.clear();
  for (std::size_t seed = 0; seed < facets; ++seed) {
    if (s.reached[seed]) continue;
    s.reached[seed] = 1;
    std::size_t head = s.queue.size();
    s.queue.push_back({static_cast<std::uint16_t>(seed), 0});
    for (; head < s.queue.size(); ++head) {
      const Entry entry = s.queue[head];
      const auto loop = loop_of(entry.facet);
      const std::size_t n = loop.size(), loop_start = out.shape.loops.size();
      out.facets.push_back(first_facet + entry.facet);
      for (std::size_t k = 0; k < n; ++k) {
        const std::uint16_t u = loop[(entry.start + k) % n];
        if (s.renumber[u] == unseen) {
          s.renumber[u] = static_cast<std::uint16_t>(out.vertices.size());
          out.vertices.push_back(s.points[u]);
        }
        out.shape.loops.push_back(s.renumber[u]);
        const std::uint16_t v = loop[(entry.start + k + 1) % n];
        const Entry next = D == 2 ? s.edges.at(loop[1], 0) : s.edges.at(v, u);
        if (next.facet == unseen || s.reached[next.facet]) continue;
        s.reached[next.facet] = 1;
        s.queue.push_back(next);
      }
      if constexpr (D == 3) turn_off_line(points, out.vertices, {out.shape.loops.data() + loop_start, n});
      out.shape.loop_begin.push_back(static_cast<std::uint16_t>(out.shape.loops.size()));
    }
  }
}

template <int D>
void check_size(const Cell_soup<D>& soup, std::size_t c) {
  // Hardly any cell needs a closer look.
  if (soup.facet_begin[soup.cell_begin[c + 1]] - soup.facet_begin[soup.cell_begin[c]] < unseen / 4) return;
  Scratch s;
  number_by_appearance(soup, c, s);
}

template void check_size(const Cell_soup<2>&, std::size_t);
template void check_size(const Cell_soup<3>&, std::size_t);
template void canonicalize<2>(const Cell_soup<2>&, std::span<const Point<2>>, std::size_t, Canonical_cell&);
template void canonicalize<3>(const Cell_soup<3>&, std::span<const Point<3>>, std::size_t, Canonical_cell&);

}  // namespace cellwalk
