// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of each simulated thing in their order, for reading and writing alike.
#include <cellwalk/body/body.h>
#include <cellwalk/internal/simulation/saved_contacts.h>
#include <cellwalk/internal/simulation/saved_state.h>
#include <cellwalk/internal/walk/saved_particle.h>

#include <algorithm>
#include <array>
#include <utility>

namespace cellwalk::detail {

template <class Archive, int D>
void visit_parts(Archive& a, Scene_box<D>& box) {
  a(box.lower, box.upper);
}
template <class Archive, int D>
void visit_parts(Archive& a, Scene_ball<D>& ball) {
  a(ball.centre, ball.radius);
}
template <class Archive, int D>
void visit_parts(Archive& a, Scene_plane<D>& plane) {
  a(plane.point, plane.normal);
}
template <class Archive, int D>
void visit_parts(Archive& a, Environment_part<D>& part) {
  a(part.group, part.shape, part.plane);
}
template <class Archive, int D>
void visit_parts(Archive& a, Blade_stroke<D>& stroke) {
  a(stroke.points, stroke.sweep, stroke.opening);
}
template <class Archive>
void visit_parts(Archive& a, Stitch& stitch) {
  a(stitch.point, stitch.onto);
}

/// Of whatever State_access visits.
template <class Archive, template <int> class Part, int D>
requires requires(Archive& a, Part<D>& part) { State_access<D>::visit(a, part); }
void visit_parts(Archive& a, Part<D>& part) { State_access<D>::visit(a, part); }

template <int D>
template <class Archive>
void State_access<D>::visit(Archive& a, Wall_pulsation<D>& pulsation) {
  a.list(pulsation.movers_, [&](auto& mover) { a(mover.point, mover.start, mover.direction, mover.bend); });
}

template <int D>
template <class Archive>
void State_access<D>::visit(Archive& a, Elastic_foundation<D>& walls) {
  a(walls.least_yield_, walls.starts_, walls.yields_, walls.may_yield_, walls.first_, walls.neighbours_,
    walls.active_);
}

template <int D>
template <class Archive>
void State_access<D>::visit(Archive& a, Tissue<D>& tissue) {
  a(tissue.least_move_, tissue.rest_, tissue.before_, tissue.wanted_, tissue.velocities_, tissue.may_move_);
  a.list(tissue.edges_, [&](auto& edge) { a(edge.ends, edge.rest); });
  a(tissue.multipliers_);
  a.list(tissue.simplices_, [&](auto& simplex) { a(simplex.corners, simplex.rest); });
  a(tissue.followers_, tissue.first_, tissue.neighbours_);
}

template <int D>
template <class Archive>
void State_access<D>::visit(Archive& a, Change_schedule<D>& schedule) {
  const auto visit_named = [&](auto& named) { a.list(named, [&](auto& one) { a(one.name, one.points); }); };
  a.list(schedule.planned_, [&](auto& planned) {
    a(planned.number, planned.kind, planned.step, planned.until);
    visit_named(planned.facets);
    visit_named(planned.cells);
    a(planned.blade, planned.suture, planned.has_sewn);
  });
  a(schedule.stitches_);
}

template <int D>
template <class Archive>
void State_access<D>::visit(Archive& a, Deformable<D>& body) {
  a(body.matching_, body.velocities_, body.moved_, body.targets_, body.stored_);
  if constexpr (Archive::is_reading) {
    const std::size_t vertices = body.body_.vertex_count();
    if (body.velocities_.size() != vertices || body.targets_.size() != vertices ||
        body.moved_.size() != vertices)
      Archive::refuse();
  }
}

template <int D>
template <class Archive>
void State_access<D>::visit(Archive& a, Shape_matching<D>& matching) {
  const auto lengths = [&] {
    return std::array{matching.masses_.size(), matching.rest_.size(), matching.monomials_.size()};
  };
  const auto before = lengths();
  a(matching.radius_, matching.total_mass_, matching.masses_, matching.rest_, matching.monomials_,
    matching.linear_inverse_, matching.inverse_, matching.is_full_);
  if constexpr (Archive::is_reading)
    if (lengths() != before) Archive::refuse();
}

template <int D>
template <class Archive>
void State_access<D>::visit(Archive& a, Rigid_body<D>& body) {
  a(body.shape_, body.velocity_, body.spin_, body.angle_, body.turning_, body.travelled_, body.path_length_,
    body.targets_);
  if constexpr (Archive::is_reading)
    if (body.shape_.size() != body.body_.vertex_count() || body.targets_.size() != body.shape_.size())
      Archive::refuse();
}

template <int D>
template <class Archive>
void State_access<D>::visit(Archive& a, Rod<D>& rod) {
  a(rod.waypoints_, rod.targets_, rod.direction_, rod.heading_, rod.inside_, rod.twist_, rod.next_,
    rod.waited_, rod.catheter_.spacing, rod.catheter_.advance);
  if constexpr (Archive::is_reading)
    if (rod.waypoints_.size() < 2 || rod.next_ == 0 || rod.next_ > rod.waypoints_.size() ||
        !(rod.catheter_.spacing > 0) || !(rod.catheter_.advance > 0))
      Archive::refuse();
}

template <int D>
void State_access<D>::write(Byte_writer& out, const World<D>& world) {
  world.check_epoch();
  out(world.steps_done_, world.particles_, world.velocities_, world.contacts_, world.counts_,
      world.entry_of_);
  for (const Moving_body<D>& moving : world.bodies_) {
    out(cellwalk::save(moving.body()));
    moving.visit([&](const auto& kind) { out(kind); });
  }
  for (std::size_t i = 0; i < world.bodies_.size(); ++i) out(world.body_counts(i));
}

/// Its kind follows from the scene: all that its constructor finds is then replaced.
template <int D>
Moving_body<D> State_access<D>::read_body(Byte_reader& in, const std::optional<std::size_t>& entry) const {
  Body<D> body = restore_body<D>(snapshot_, in.next<std::vector<std::byte>>());
  const auto made = [&](auto kind) {
    in(kind);
    if (kind.targets().size() != kind.body().vertex_count() && !kind.targets().empty()) Byte_reader::refuse();
    return Moving_body<D>(std::move(kind));
  };
  if (body.vertex_count() == 0 || (entry ? *entry >= scene_.bodies.size() : !scene_.catheter))
    Byte_reader::refuse();
  // Its path, too: that of a centre line is found at the start only.
  if (!entry) return made(Rod<D>(snapshot_, std::move(body), *scene_.catheter, std::vector<Point<D>>(2)));
  const Body_start<D>& start = scene_.bodies[*entry];
  if (start.guided) return made(Rigid_body<D>(std::move(body), *start.guided, start.spin));
  if (start.material) return made(Deformable<D>(std::move(body), *start.material, Vector<D>{}, start.spin));
  return made(Rigid_body<D>(std::move(body), Vector<D>{}, start.spin));
}

template <int D>
World<D> State_access<D>::read_world(Byte_reader& in, const Body_options& options) const {
  World<D> world(snapshot_, scene_, options, typename World<D>::Empty{});
  in(world.steps_done_, world.particles_, world.velocities_, world.contacts_, world.counts_, world.entry_of_);
  const auto is_lost = [&](const Particle<D>& p) {
    return !snapshot_.is_cell(p.cell) || snapshot_.is_solid(p.cell) ||
           !in_closure(snapshot_, p.cell, p.position);
  };
  if (world.velocities_.size() != world.particles_.size() || std::ranges::any_of(world.particles_, is_lost))
    Byte_reader::refuse();
  for (const std::optional<std::size_t>& entry : world.entry_of_)
    world.bodies_.push_back(read_body(in, entry));
  const auto is_met = [&](const Run_contact<D>& met) {
    const Half_facet f = met.contact.facet;
    const bool is_there =
        f == Half_facet::none || (to_index(f) < snapshot_.half_facet_slots() &&
                                  snapshot_.facet_of(f) < snapshot_.facet_count(snapshot_.cell_of(f)));
    return is_there && (!met.body || (*met.body < world.bodies_.size() &&
                                      met.contact.vertex < world.bodies_[*met.body].body().vertex_count()));
  };
  if (!std::ranges::all_of(world.contacts_, is_met)) Byte_reader::refuse();
  world.body_steps_.resize(world.bodies_.size());
  for (auto& step : world.body_steps_) in(step.counts);
  world.own_all();
  return world;
}

template <int D>
Change_schedule<D> State_access<D>::read_schedule(Byte_reader& in) const {
  Change_schedule<D> schedule;
  in(schedule);
  return schedule;
}

template <int D>
Wall_pulsation<D> State_access<D>::read_pulsation(Byte_reader& in) const {
  if (!scene_.walls || !scene_.walls->pulsation) Byte_reader::refuse();
  Wall_pulsation<D> pulsation(*scene_.walls->pulsation);
  in(pulsation);
  return pulsation;
}

template <int D>
Elastic_foundation<D> State_access<D>::read_foundation(Byte_reader& in) const {
  if (!scene_.walls || !scene_.walls->soft) Byte_reader::refuse();
  Elastic_foundation<D> foundation(snapshot_, *scene_.walls->soft);
  in(foundation);
  if (!foundation.is_consistent()) Byte_reader::refuse();
  return foundation;
}

template <int D>
Tissue<D> State_access<D>::read_tissue(Byte_reader& in) const {
  if (!scene_.walls || !scene_.walls->tissue) Byte_reader::refuse();
  Tissue<D> tissue(snapshot_, *scene_.walls->tissue);
  tissue.fixed_ = scene_.walls->fixed;
  in(tissue);
  if (!tissue.is_consistent()) Byte_reader::refuse();
  return tissue;
}

template <int D>
void save(Byte_writer& out, const World<D>& world) {
  State_access<D>::write(out, world);
}
template <int D>
void save(Byte_writer& out, const Change_schedule<D>& schedule) {
  out(schedule);
}
template <int D>
void save(Byte_writer& out, const Wall_pulsation<D>& pulsation) {
  out(pulsation);
}
template <int D>
void save(Byte_writer& out, const Elastic_foundation<D>& foundation) {
  out(foundation);
}
template <int D>
void save(Byte_writer& out, const Tissue<D>& tissue) {
  out(tissue);
}

#define CELLWALK_INSTANTIATE(D)                                   \
  template class State_access<D>;                                 \
  template void save(Byte_writer&, const World<D>&);              \
  template void save(Byte_writer&, const Change_schedule<D>&);    \
  template void save(Byte_writer&, const Wall_pulsation<D>&);     \
  template void save(Byte_writer&, const Elastic_foundation<D>&); \
  template void save(Byte_writer&, const Tissue<D>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
