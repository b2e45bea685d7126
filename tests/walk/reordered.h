// SPDX-License-Identifier: LGPL-3.0-or-later
// The same geometry listed in another order: no answer may depend on it.
#ifndef CELLWALK_TESTS_WALK_REORDERED_H
#define CELLWALK_TESTS_WALK_REORDERED_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/walk.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace cellwalk::oracle {

/// A soup with cells, points, facets of cells and the beginnings of their loops in another order.
template <int D>
struct Reordered_soup {
  Cell_soup<D> soup;
  std::vector<std::uint32_t> cell, point;  ///< of each of the original: its index here
};

/// Seed 0 leaves everything as it is.
template <int D>
Reordered_soup<D> reordered(const Cell_soup<D>& original, std::uint64_t seed) {
  Random random(seed);
  const auto shuffled = [&](std::size_t n) {
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    if (seed != 0) random.shuffle(order);
    return order;
  };
  Reordered_soup<D> result;
  result.point = shuffled(original.points.size());
  result.soup.points.resize(original.points.size());
  for (std::size_t p = 0; p < original.points.size(); ++p)
    result.soup.points[result.point[p]] = original.points[p];
  result.cell.resize(original.cell_count());
  const auto rotate = [&](auto begin, auto end) {
    if (seed != 0) std::rotate(begin, begin + static_cast<std::ptrdiff_t>(random.below(end - begin)), end);
  };
  for (const std::uint32_t c : shuffled(original.cell_count())) {
    std::vector<std::uint32_t> facets(original.cell_begin[c + 1] - original.cell_begin[c]);
    std::iota(facets.begin(), facets.end(), original.cell_begin[c]);
    // Facets of a polygon stand in the order of its rim.
    if (D == 2)
      rotate(facets.begin(), facets.end());
    else if (seed != 0)
      random.shuffle(facets);
    for (const std::uint32_t f : facets) {
      std::vector<std::uint32_t> loop;
      for (const std::uint32_t v : original.facet(f)) loop.push_back(result.point[v]);
      if (D == 3) rotate(loop.begin(), loop.end());
      result.soup.add_facet(loop, original.impassable[f]);
    }
    result.cell[c] = static_cast<std::uint32_t>(result.soup.end_cell(original.solid[c]));
  }
  return result;
}

/// A world in another order, ready to be walked, and its names in those of the original.
template <int D>
class Reordered_world {
 public:
  Reordered_world(const Cell_soup<D>& original, std::uint64_t seed)
      : original_(original),
        order_(reordered(original, seed)),
        snapshot(Snapshot<D>::compile(order_.soup, glue(order_.soup))),
        old_cell_(inverse(order_.cell)),
        old_point_(inverse(order_.point)) {}

  Cell cell(std::uint32_t index_of_original) const { return snapshot.cell(order_.cell[index_of_original]); }
  std::uint32_t original_cell(Cell c) const { return old_cell_[snapshot.index(c)]; }
  /// The half-facet of the original.
  std::uint32_t original_facet(Half_facet f) const {
    const std::uint32_t c = original_cell(snapshot.cell_of(f));
    std::vector<std::uint32_t> loop = snapshot.loop(f);
    for (std::uint32_t& v : loop) v = old_point_[v];
    for (std::uint32_t g = original_.cell_begin[c]; g < original_.cell_begin[c + 1]; ++g)
      if (std::is_permutation(original_.facet(g).begin(), original_.facet(g).end(), loop.begin(), loop.end()))
        return g;
    throw std::logic_error("a facet that the original lacks");
  }
  const Cell_soup<D>& soup() const { return order_.soup; }

 private:
  static std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& order) {
    std::vector<std::uint32_t> result(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) result[order[i]] = i;
    return result;
  }

  const Cell_soup<D>& original_;
  const Reordered_soup<D> order_;

 public:
  const Snapshot<D> snapshot;

 private:
  const std::vector<std::uint32_t> old_cell_, old_point_;
};

/// Where a contact is on the environment, in coordinates: a vertex, the two ends of an edge, or all corners
/// of a facet. Any struct that names it as Contact does.
template <int D, class Met>
std::vector<Point<D>> feature_of(const Snapshot<D>& snapshot, const Met& contact) {
  const std::vector<std::uint32_t> loop = snapshot.loop(contact.facet);
  std::vector<Point<D>> feature;
  const auto add = [&](std::size_t i) { feature.push_back(snapshot.point(loop[i % loop.size()])); };
  if (contact.kind == Contact_kind::facet)
    for (std::size_t i = 0; i < loop.size(); ++i) add(i);
  else
    add(contact.corner);
  if (contact.kind == Contact_kind::edge) add(contact.corner + 1u);
  std::sort(feature.begin(), feature.end());
  return feature;
}

}  // namespace cellwalk::oracle

#endif  // CELLWALK_TESTS_WALK_REORDERED_H
