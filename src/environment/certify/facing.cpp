// SPDX-License-Identifier: LGPL-3.0-or-later
// Pairs of facets with opposite normals among those that certification compares anyway.
#include "facing.h"

#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/error.h>

#include <string>

#include "common_part.h"
#include "environment/soup/describe_place.h"
#include "environment/soup/parallel.h"

namespace cellwalk::detail {
namespace {

Vector<2> outer_normal(std::span<const Point<2>> points, const Plane_points<2>& plane) {
  return unit_normal(points[plane[1]], points[plane[0]]);
}

Vector<3> outer_normal(std::span<const Point<3>> points, const Plane_points<3>& plane) {
  return unit_normal(points[plane[0]], points[plane[1]], points[plane[2]]);
}

}  // namespace

template <int D>
Facing_search<D>::Facing_search(const Snapshot<D>& snapshot, std::span<const Boundary_facet<D>> facets)
    : snapshot_(snapshot), facets_(facets), normals_(facets.size()) {
  const auto points = snapshot.points();
  for_each_parallel(facets.size(),
                    [&](std::size_t i) { normals_[i] = outer_normal(points, facets[i].plane); });
  Box<D> box;
  for (const Boundary_facet<D>& facet : facets)
    for (const std::uint32_t v : facet.loop) box.extend(points[v]);
  tolerance_ = facing_tolerance<D>(box);
}

template <int D>
Box<D> Facing_search<D>::enlarged(const Box<D>& cell) const {
  const Vector<D> margin = with_all_coordinates<D>(largest_gap<D>(cell, tolerance_));
  return {cell.low - margin, cell.high + margin};
}

template <int D>
void Facing_search<D>::add(Pairs& pairs, std::uint32_t f, std::uint32_t g) {
  const auto index_of = [&](std::uint32_t i) { return snapshot_.index(snapshot_.cell_of(facets_[i].facet)); };
  const Key key{index_of(f), index_of(g), f, g};
  const std::lock_guard lock(mutex_);
  if (pairs.count++ == 0 || key < pairs.first) pairs.first = key;
}

template <int D>
void Facing_search<D>::compare(std::span<const std::uint32_t> own, std::span<const Facing_candidate> others) {
  if (own.empty()) return;
  const Cell c = snapshot_.cell_of(facets_[own[0]].facet);
  if (snapshot_.is_solid(c)) return;
  Predicate_counts counts;
  const auto points = snapshot_.points();
  for (const auto& [i, is_in_contact] : others) {
    const Boundary_facet<D>& f = facets_[i];
    const Cell d = snapshot_.cell_of(f.facet);
    if (snapshot_.is_solid(d) || snapshot_.index(d) > snapshot_.index(c)) continue;
    for (const std::uint32_t j : own) {
      const Boundary_facet<D>& g = facets_[j];
      if (is_in_contact && lies_in_plane<D>(counts, points, f, g.loop) &&
          overlap_in_plane<D>(counts, points, f, g.loop, true))
        add(overlapping_, i, j);
      else if (dot(normals_[i], normals_[j]) < facing_cosine &&
               is_near<D>(points, f.loop, normals_[i], g.loop, tolerance_))
        add(near_, i, j);
    }
  }
}

template <int D>
Facing_facets Facing_search<D>::described(const Pairs& pairs) const {
  Facing_facets result;
  result.pairs = pairs.count;
  if (pairs.count == 0) return result;
  result.cells = {pairs.first[0], pairs.first[1]};
  const auto points = snapshot_.points();
  const Facet_loop& loop = facets_[pairs.first[2]].loop;
  const Common_part<D> part =
      common_part<D>(points, loop, normals_[pairs.first[2]], facets_[pairs.first[3]].loop);
  result.place = centre_of<D>(part, points[loop[0]]);
  result.distance = part.gap;
  return result;
}

template <int D>
Facing_walls Facing_search<D>::result() const {
  return {described(overlapping_), described(near_), tolerance_};
}

template <int D>
void refuse_overlapping(const Facing_facets& facets) {
  if (facets.pairs == 0) return;
  throw Error(
      Error_code::not_certified,
      "cells " + std::to_string(facets.cells[0]) + " and " + std::to_string(facets.cells[1]) +
          " share a part of a " + (D == 2 ? "line" : "plane") + " at " + describe_place(facets.place) +
          " but no facet" +
          (facets.pairs == 1 ? "" : ", the first of " + std::to_string(facets.pairs) + " such pairs") +
          ": divide them by `cellwalk import`, with neither --strict nor --conform off, or keep duplicates "
          "(--duplicates keep) to have walls there");
}

template class Facing_search<2>;
template class Facing_search<3>;
template void refuse_overlapping<2>(const Facing_facets&);
template void refuse_overlapping<3>(const Facing_facets&);

}  // namespace cellwalk::detail
