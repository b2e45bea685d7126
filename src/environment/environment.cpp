// SPDX-License-Identifier: LGPL-3.0-or-later
// The building of an environment from a soup, in the steps of preparation and certification.
#include <cellwalk/environment/environment.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/internal/environment/boundary_index.h>
#include <cellwalk/internal/environment/build_map.h>
#include <cellwalk/internal/environment/flatten.h>
#include <cellwalk/internal/environment/split.h>
#include <cellwalk/internal/environment/star_index.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "environment/certify/facing.h"
#include "environment/map/map_matches_snapshot.h"
#include "environment/soup/parallel.h"
#include "prepare_soup.h"
#include "snapshot_soup.h"

namespace cellwalk {
namespace {

/// Drops points, flips and splits.
template <int D>
Cell_soup<D> prepare(Cell_soup<D> soup, const Build_options& options, Build_report& report) {
  report = {};
  report.cells_read = soup.cell_count();
  report.points_read = soup.points.size();
  check_soup(soup);
  if (soup.cell_count() == 0)
    throw Error(Error_code::input, "there are no cells: an environment needs at least one");
  clean_points(soup, options.duplicates, report);
  if (report.merged_points) check_soup(soup);  // after merging, a facet may have a vertex twice
  report.flipped = flip_if_inverted(soup);
  if (!options.split && !options.simplicial) return soup;
  std::vector<std::uint32_t> origin;
  soup = split(std::move(soup), report.split, &origin,
               options.simplicial ? Cells_to_split::all_but_simplices : Cells_to_split::invalid);
  if (report.split.cells_split) report.origin = std::move(origin);
  return soup;
}

/// Cells by their index in the input, where some were split.
void name_cells_of_input(Facing_walls& facing, const std::vector<std::uint32_t>& origin) {
  if (origin.empty()) return;
  for (Facing_facets* const found : {&facing.overlapping, &facing.near})
    for (std::uint32_t& cell : found->cells) cell = origin[cell];
}

}  // namespace

template <int D>
Environment<D>::Environment() = default;
template <int D>
Environment<D>::Environment(Environment&&) noexcept = default;
template <int D>
Environment<D>& Environment<D>::operator=(Environment&&) noexcept = default;
template <int D>
Environment<D>::~Environment() = default;

template <int D>
Environment<D> Environment<D>::build(Cell_soup<D> soup, const Build_options& options, Build_report* report) {
  Build_report own_report;
  Build_report& done = report ? *report : own_report;
  soup = prepare(std::move(soup), options, done);
  const Gluing gluing = glue(soup);
  mark_walls(soup, gluing);

  Environment environment;
  environment.allow_duplicates_ = options.duplicates == Duplicate_vertices::keep;
  if (options.keep_map) {
    environment.storage_ = build_map(soup, gluing);
    soup = {};
    Map_storage<D>& storage = *environment.storage_;
    check_map(storage);
    const Flat_cells<D> flat = flatten(storage);
    std::vector<Half_facet> slots;
    *environment.snapshot_ = Snapshot<D>::compile(flat.soup, flat.gluing, &slots);
    assign_half_facets<D>(storage, flat.darts, slots, environment.snapshot_->half_facet_slots());
  } else {
    // Flattening the map would return exactly this soup.
    *environment.snapshot_ = Snapshot<D>::compile(soup, gluing);
  }
  done.certificate = cellwalk::certify(*environment.snapshot_, environment.allow_duplicates_, &done.facing);
  name_cells_of_input(done.facing, done.origin);
  if (!environment.allow_duplicates_) detail::refuse_overlapping<D>(done.facing.overlapping);
  return environment;
}

template <int D>
const Map_storage<D>& Environment<D>::storage() const& {
  if (!storage_) throw Error(Error_code::usage, "the environment is frozen: thaw() it to use its map");
  return *storage_;
}

template <int D>
void Environment<D>::freeze() {
  storage_.reset();
  boundary_.reset();
}

template <int D>
void Environment<D>::thaw() {
  if (storage_) return;
  std::vector<Half_facet> names;
  const Cell_soup<D> cells = soup_of(*snapshot_, &names);
  std::unique_ptr<Map_storage<D>> storage = build_map(cells, gluing_of(*snapshot_, names));
  const std::vector<Dart<D>> darts = storage->dart_of_half_facet;
  assign_half_facets<D>(*storage, darts, names, snapshot_->half_facet_slots());
  storage->cell_slots = snapshot_->cell_slots();
  if (storage->cell_slots != storage->cell_count)  // edits left indices unused
    for_each_parallel(names.size(), [&](std::size_t f) {
      const std::uint32_t index = snapshot_->index(snapshot_->cell_of(names[f]));
      for_each_dart_of_half_facet<D>(storage->map, darts[f],
                                     [&](Dart<D> d) { storage->map.info(d).set_cell(index); });
    });
  storage_ = std::move(storage);
}

template <int D>
Cell_soup<D> Environment<D>::soup() const {
  return soup_of(*snapshot_, nullptr);
}

template <int D>
Certificate Environment<D>::certify(Facing_walls* facing) const {
  // First the snapshot: a map that was made from one that is none need not agree with it.
  Certificate certificate = cellwalk::certify(*snapshot_, allow_duplicates_, facing);
  if (storage_) {
    check_map(*storage_);
    check_map_matches_snapshot(*storage_, *snapshot_);
  }
  return certificate;
}

template class Environment<2>;
template class Environment<3>;

}  // namespace cellwalk
