// SPDX-License-Identifier: LGPL-3.0-or-later
// Every public member of the classes and every function that headers declare `extern template`, so that a
// program which inlines nothing links. check_members.py sees that none is missing. Nothing is run.
#include <cellwalk/body/body.h>
#include <cellwalk/body/boundary_tracer.h>
#include <cellwalk/cellwalk.h>
#include <cellwalk/environment/compiled.h>
#include <cellwalk/environment/map_edit.h>
#include <cellwalk/environment/selection.h>
#include <cellwalk/io/body_file.h>
#include <cellwalk/io/mesh_file.h>
#include <cellwalk/loading/environment_file.h>
#include <cellwalk/paper.h>
#include <cellwalk/records/body_soup.h>
#include <cellwalk/walk/tally.h>
#include <cellwalk/walk/trace.h>

#include <cstdio>
#include <utility>

namespace {

using namespace cellwalk;

volatile const void* kept_address;
int kept_count = 0;

/// The linker has to find what is kept.
template <class... Members>
void keep(Members... members) {
  ((kept_address = &members, ++kept_count), ...);
}

/// A member for what changes and for what does not.
template <class T, class Result>
void keep_both(Result& (T::*change)(), const Result& (T::*read)() const) {
  keep(change, read);
}

template <class T>
T moved(T& from) {
  T other(std::move(from));
  from = std::move(other);
  return std::move(from);
}

template <int D>
void keep_environments() {
  keep(
      +[](const Snapshot<D>& s) { return Locator<D>(s); }, &moved<Locator<D>>, &Locator<D>::locate,
      &Locator<D>::particle_at, &Locator<D>::particles_at, +[](const Snapshot<D>& s) { return Tracer<D>(s); },
      &moved<Tracer<D>>, &Tracer<D>::trace);
  keep(&Boundary_tracer<D>::reflect, &Boundary_tracer<D>::join, &Boundary_tracer<D>::trace);
  keep(+[](const Snapshot<D>& s, const Locator<D>& l, const Point<D>& x, Edge_counts& c) {
    return answer_move(s, l, x, x, Touch::pass, c);
  });

  keep(&Environment<D>::build, &moved<Environment<D>>,
       static_cast<const Snapshot<D>& (Environment<D>::*)() const&>(&Environment<D>::snapshot),
       static_cast<const Map_storage<D>& (Environment<D>::*)() const&>(&Environment<D>::storage),
       &Environment<D>::is_frozen, &Environment<D>::freeze, &Environment<D>::thaw, &Environment<D>::compact,
       &Environment<D>::soup, &Environment<D>::set_impassable, &Environment<D>::excavate,
       &Environment<D>::fill, &Environment<D>::move_vertex, &Environment<D>::insert_point,
       &Environment<D>::certify, &Environment<D>::cells_around,
       static_cast<Compaction (Environment<D>::*)(void (*&&)(Map<D>&))>(&Environment<D>::edit),
       &set_impassable<D>);

  keep(&write_compiled<D>, &compile_to_bytes<D>, &check_compiled<D>, &write_environment<D>, &soup_groups<D>);

  keep(
      +[] { return Map_storage<D>(); }, &Map_storage<D>::point_of, &Map_storage<D>::vertices_of);

  keep(
      +[] { return Snapshot<D>(); }, &moved<Snapshot<D>>, &Snapshot<D>::compile, &Snapshot<D>::cell_count,
      &Snapshot<D>::cell, &Snapshot<D>::clusters, &Snapshot<D>::tissue_boxes, &Snapshot<D>::edits,
      &Snapshot<D>::index, &Snapshot<D>::is_solid, &Snapshot<D>::view, &Snapshot<D>::facet_count,
      &Snapshot<D>::half_facet_slots, &Snapshot<D>::half_facet, &Snapshot<D>::cell_of, &Snapshot<D>::facet_of,
      &Snapshot<D>::is_impassable, &Snapshot<D>::impassable_facets, &Snapshot<D>::facets_to,
      &Snapshot<D>::neighbour, &Snapshot<D>::opposite, &Snapshot<D>::loop, &Snapshot<D>::points,
      &Snapshot<D>::point, &Snapshot<D>::frame, &Snapshot<D>::blocks, &Snapshot<D>::links,
      &Snapshot<D>::block_count, &Snapshot<D>::uniform_blocks, &Snapshot<D>::prefetch_neighbours,
      &Snapshot<D>::uncertified_planes, &Snapshot<D>::set_impassable, &Snapshot<D>::move_point,
      &Snapshot<D>::add_point, &Snapshot<D>::update_geometry, &Snapshot<D>::replace_cells,
      &Snapshot<D>::bytes, &Snapshot<D>::cell_slots, &Snapshot<D>::check_epoch,
      &Snapshot<D>::check_geometry_epoch, &Snapshot<D>::epoch, &Snapshot<D>::geometry_epoch,
      &Snapshot<D>::is_cell, &Snapshot<D>::is_point, &Snapshot<D>::next_point, &Snapshot<D>::remove_point);
}

template <int D>
void keep_bodies() {
  keep(
      +[](const Snapshot<D>& s, const Locator<D>& l, const Body_soup<D>& b) { return Body<D>(s, l, b); },
      +[](const Environment<D>& e, const Body_soup<D>& b) { return Body<D>(e, b); },
      static_cast<void (Body<D>::*)(std::span<const Point<D>>, const Body_options&, Step_report<D>&,
                                    Body_counts&)>(&Body<D>::step),
      static_cast<std::vector<Contact<D>> (Body<D>::*)(std::span<const Point<D>>)>(&Body<D>::step),
      &moved<Body<D>>, &Body<D>::register_again, &Body<D>::vertex_count, &Body<D>::positions, &Body<D>::edges,
      &Body<D>::faces, &Body<D>::radius, &Body<D>::set_radii, &Body<D>::clearances, &Body<D>::neighbours,
      &Body<D>::move_vertex, &Body<D>::refresh, &Body<D>::leave_region, &Body<D>::particles, &Body<D>::chain,
      &Body<D>::cell_of, &Body<D>::validate);

  keep(&save<D>, &restore_body<D>, &transformed<D>, &make_body<D>, &rope<D>, &catheter_body<D>,
       &polyline_body<D>);
}

template <int D>
void keep_reshaping() {
  keep(
      +[](Environment<D>& e, const Residents<D>& r) { return Reshaping<D>(e, r); }, &moved<Reshaping<D>>,
      static_cast<Vertex_result<D> (Reshaping<D>::*)(std::uint32_t, const Point<D>&)>(&Reshaping<D>::move),
      static_cast<Move_report<D> (Reshaping<D>::*)(std::span<const Vertex_move<D>>)>(&Reshaping<D>::move),
      &Reshaping<D>::test_move, &Reshaping<D>::finish, &Reshaping<D>::close, &Reshaping<D>::open,
      &Reshaping<D>::excavate, &Reshaping<D>::fill, &Reshaping<D>::counts, &Reshaping<D>::insert_point,
      &Reshaping<D>::split_edge, &Reshaping<D>::flip, &Reshaping<D>::remove_edge, &Reshaping<D>::collapse,
      &Reshaping<D>::relax, &Reshaping<D>::split_vertex, &Reshaping<D>::cut, &Reshaping<D>::merge_vertices);
  keep(&Relax_report::operations, &Cut_report::refused, &blade_along<D>, &swept_blade);
}

template <int D>
void keep_selections() {
  keep(&select<D>, static_cast<Point<D> (*)(const Snapshot<D>&, Half_facet)>(&centroid<D>),
       static_cast<Point<D> (*)(const Snapshot<D>&, Cell)>(&centroid<D>));
}

template <int D>
void keep_readers() {
  keep(&io::read_body<D>, static_cast<Environment<D> (*)(const std::string&)>(&import_environment<D>),
       static_cast<void (*)(const Snapshot<D>&, const std::vector<const Body<D>*>&,
                            const std::vector<Contact<D>>&, const std::string&)>(&draw<D>),
       &io::write_ovm<D>);
}

}  // namespace

int main() {
  keep_environments<2>(), keep_bodies<2>(), keep_reshaping<2>(), keep_selections<2>(), keep_readers<2>();
  keep_environments<3>(), keep_bodies<3>(), keep_reshaping<3>(), keep_selections<3>(), keep_readers<3>();
  std::printf("%d members and functions\n", kept_count);
}
