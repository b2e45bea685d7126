// SPDX-License-Identifier: LGPL-3.0-or-later
// Every public member of the classes and every function that headers declare `extern template`, so that a
// program which inlines nothing links. check_members.py sees that none is missing. Nothing is run.
#include <cellwalk/body/saved_body.h>
#include <cellwalk/cellwalk.h>
#include <cellwalk/environment/compiled.h>
#include <cellwalk/environment/groups.h>
#include <cellwalk/environment/map.h>
#include <cellwalk/io/body_file.h>
#include <cellwalk/io/changes_file.h>
#include <cellwalk/io/ovm.h>
#include <cellwalk/io/vtu.h>
#include <cellwalk/loading/environment_file.h>
#include <cellwalk/paper.h>
#include <cellwalk/records/make_body.h>
#include <cellwalk/simulation/change_schedule.h>
#include <cellwalk/simulation/elastic_foundation.h>
#include <cellwalk/simulation/tissue.h>
#include <cellwalk/simulation/wall_pulsation.h>
#include <cellwalk/simulation/world.h>

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
      &Locator<D>::particle_at, &Locator<D>::particles_at);
  keep(+[](const Snapshot<D>& s, const Locator<D>& l, const Point<D>& x, Edge_counts& c) {
    return answer_move(s, l, x, x, Touch::pass, Walk_method{}, c);
  });

  keep(&Environment<D>::build, &moved<Environment<D>>,
       static_cast<const Snapshot<D>& (Environment<D>::*)() const&>(&Environment<D>::snapshot),
       static_cast<const Map_storage<D>& (Environment<D>::*)() const&>(&Environment<D>::storage),
       &Environment<D>::is_frozen, &Environment<D>::freeze, &Environment<D>::thaw, &Environment<D>::compact,
       &Environment<D>::soup, &Environment<D>::set_impassable, &Environment<D>::excavate,
       &Environment<D>::fill, &Environment<D>::move_vertex, &Environment<D>::insert_point,
       &Environment<D>::certify, &Environment<D>::cells_around);

  keep(
      +[](const Cell_soup<D>& s, const Soup_groups& g) { return Group_places<D>(s, g); },
      &Group_places<D>::find,
      +[](const Snapshot<D>& s, const Groups<D>& g) { return Lasting_groups<D>(s, g); },
      &Lasting_groups<D>::names, &Lasting_groups<D>::now, &soup_groups<D>);
  keep(&write_compiled<D>, &compile_to_bytes<D>, &check_compiled<D>, &write_environment<D>);

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
      &Body<D>::faces, &Body<D>::neighbours, &Body<D>::move_vertex, &Body<D>::refresh, &Body<D>::leave_region,
      &Body<D>::particles, &Body<D>::chain, &Body<D>::cell_of, &Body<D>::validate);

  keep(&save<D>, &restore_body<D>, &transformed<D>, &make_body<D>, &rope<D>,
       static_cast<Body_soup<D> (*)(const Catheter_shape<D>&)>(&generate_body),
       static_cast<Body_soup<D> (*)(const Polyline_shape<D>&)>(&generate_body));
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
void keep_simulation() {
  keep(
      +[](Body<D> b, const Shape_material& m) { return Deformable<D>(std::move(b), m, Vector<D>{}); },
      &moved<Deformable<D>>, &Deformable<D>::step, &Deformable<D>::targets, &Deformable<D>::velocity,
      &Deformable<D>::velocities, &Deformable<D>::has_arrived, &Deformable<D>::kinetic_energy,
      &Deformable<D>::energy);
  keep_both(&Deformable<D>::body, &Deformable<D>::body);

  keep(
      +[](const Shape_material& m) { return Shape_matching<D>({}, m); }, &moved<Shape_matching<D>>,
      &Shape_matching<D>::material, &Shape_matching<D>::goals, &nearest_rotation<D>);

  keep(
      +[](Body<D> b) { return Rigid_body<D>(std::move(b), Vector<D>{}, Spin<D>{}); },
      +[](Body<D> b, Guided_motion<D> g) { return Rigid_body<D>(std::move(b), std::move(g)); },
      &moved<Rigid_body<D>>, &Rigid_body<D>::step, &Rigid_body<D>::targets, &Rigid_body<D>::velocity,
      &Rigid_body<D>::has_arrived);
  keep_both(&Rigid_body<D>::body, &Rigid_body<D>::body);

  keep(
      +[](const Snapshot<D>& s, Body<D> b, const Catheter<D>& c) { return Rod<D>(s, std::move(b), c, {}); },
      &moved<Rod<D>>, &Rod<D>::at_entry, &Rod<D>::step, &Rod<D>::targets, &Rod<D>::tip,
      &Rod<D>::length_inside, &Rod<D>::twist, &Rod<D>::waypoints, &Rod<D>::next_waypoint,
      &Rod<D>::steps_waited, &Rod<D>::velocity, &Rod<D>::has_arrived);
  keep_both(&Rod<D>::body, &Rod<D>::body);

  keep(
      +[](const Snapshot<D>& s, const Scene<D>& c) { return new World<D>(s, c); }, &World<D>::most_tries,
      &World<D>::step, &World<D>::steps_done, &World<D>::particles, &World<D>::velocities, &World<D>::bodies,
      &World<D>::entry_of, &World<D>::catheter, &World<D>::contacts, &World<D>::counts,
      static_cast<Body_counts (World<D>::*)() const>(&World<D>::body_counts),
      static_cast<Body_counts (World<D>::*)(std::size_t) const>(&World<D>::body_counts), &World<D>::validate,
      &World<D>::move_walls, &World<D>::relax, &World<D>::change, &World<D>::positions, &World<D>::cell_of,
      &World<D>::has_arrived);
  keep(
      +[](const Snapshot<D>& s, const Pulsation<D>& p) { return Wall_pulsation<D>(s, p, {}); },
      &Wall_pulsation<D>::targets,
      +[](const Snapshot<D>& s, const Soft_walls& w) { return Elastic_foundation<D>(s, w, {}); },
      &Elastic_foundation<D>::press, &Elastic_foundation<D>::yielding, &Elastic_foundation<D>::targets,
      &Elastic_foundation<D>::follow, &Elastic_foundation<D>::yield, &Elastic_foundation<D>::yielding_count,
      &Elastic_foundation<D>::largest_yield, &Elastic_foundation<D>::force);
  keep(
      +[](const Snapshot<D>& s, const Tissue_material& m) { return Tissue<D>(s, m, {}); },
      &Tissue<D>::targets, &Tissue<D>::follow, &Tissue<D>::follow_changes, &Tissue<D>::largest_stretch,
      &Tissue<D>::edge_count);
  keep(
      &select<D>, static_cast<Point<D> (*)(const Snapshot<D>&, Half_facet)>(&centroid<D>),
      static_cast<Point<D> (*)(const Snapshot<D>&, Cell)>(&centroid<D>),
      +[](const Snapshot<D>& s, const Environment_changes<D>& c) { return Change_schedule<D>(s, c); },
      &Change_schedule<D>::is_due, &Change_schedule<D>::apply);
}

template <int D>
void keep_readers() {
  keep(&io::read_body<D>, static_cast<Environment<D> (*)(const std::string&)>(&import_environment<D>),
       static_cast<void (*)(const Snapshot<D>&, const std::vector<const Body<D>*>&,
                            const std::vector<Contact<D>>&, const std::string&)>(&draw<D>),
       static_cast<void (*)(const std::filesystem::path&, const Cell_soup<D>&, const Soup_groups&)>(
           &io::write_ovm<D>),
       static_cast<void (*)(io::Atomic_file&, const Cell_soup<D>&, const Soup_groups&)>(&io::write_ovm<D>),
       &io::vtu_of_cells<D>, &io::vtu_of_walls<D>, &io::read_changes<D>, &io::parse_changes<D>);
}

}  // namespace

int main() {
  keep_environments<2>(), keep_bodies<2>(), keep_reshaping<2>(), keep_simulation<2>(), keep_readers<2>();
  keep_environments<3>(), keep_bodies<3>(), keep_reshaping<3>(), keep_simulation<3>(), keep_readers<3>();
  std::printf("%d members and functions\n", kept_count);
}
