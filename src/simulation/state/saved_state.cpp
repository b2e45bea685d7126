// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/body/saved_body.h>
#include <cellwalk/internal/simulation/saved_contacts.h>
#include <cellwalk/internal/simulation/saved_state.h>
#include <cellwalk/internal/walk/saved_particle.h>

#include <algorithm>
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

template <int D>
void Saved_simulation<D>::write(Byte_writer& out, const World<D>& world) {
  world.check_epoch();
  out(world.steps_done_, world.particles_, world.velocities_, world.contacts_, world.counts_,
      world.entry_of_);
  for (const Moving_body<D>& moving : world.bodies_) {
    out(cellwalk::save(moving.body()));
    moving.visit([&](const auto& kind) { out(kind); });
  }
  for (std::size_t i = 0; i < world.bodies_.size(); ++i) out(world.body_counts(i));
}

/// What kind it is follows from the scene: all that its constructor finds is then replaced.
template <int D>
Moving_body<D> Saved_simulation<D>::read_body(Byte_reader& in,
                                              const std::optional<std::size_t>& entry) const {
  Body<D> body = restore_body<D>(snapshot_, in.next<std::vector<std::byte>>());
  const auto made = [&](auto kind) {
    in(kind);
    if (kind.targets().size() != kind.body().vertex_count() && !kind.targets().empty()) Byte_reader::refuse();
    return Moving_body<D>(std::move(kind));
  };
  if (body.vertex_count() == 0 || (entry ? *entry >= scene_.bodies.size() : !scene_.catheter))
    Byte_reader::refuse();
  if (!entry) return made(Rod<D>(snapshot_, std::move(body), *scene_.catheter, scene_.catheter->path));
  const Body_start<D>& start = scene_.bodies[*entry];
  if (start.guided) return made(Rigid_body<D>(std::move(body), *start.guided, start.spin));
  if (start.material) return made(Deformable<D>(std::move(body), *start.material, Vector<D>{}, start.spin));
  return made(Rigid_body<D>(std::move(body), Vector<D>{}, start.spin));
}

template <int D>
World<D> Saved_simulation<D>::read_world(Byte_reader& in, const Body_options& options) const {
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
Change_schedule<D> Saved_simulation<D>::read_schedule(Byte_reader& in) const {
  Change_schedule<D> schedule;
  in(schedule);
  return schedule;
}

template <int D>
Wall_pulsation<D> Saved_simulation<D>::read_pulsation(Byte_reader& in) const {
  if (!scene_.walls || !scene_.walls->pulsation) Byte_reader::refuse();
  Wall_pulsation<D> pulsation(*scene_.walls->pulsation);
  in(pulsation);
  return pulsation;
}

template <int D>
Elastic_foundation<D> Saved_simulation<D>::read_foundation(Byte_reader& in) const {
  if (!scene_.walls || !scene_.walls->soft) Byte_reader::refuse();
  Elastic_foundation<D> foundation(snapshot_, *scene_.walls->soft);
  in(foundation);
  if (!foundation.is_consistent()) Byte_reader::refuse();
  return foundation;
}

template <int D>
Tissue<D> Saved_simulation<D>::read_tissue(Byte_reader& in) const {
  if (!scene_.walls || !scene_.walls->tissue) Byte_reader::refuse();
  Tissue<D> tissue(snapshot_, *scene_.walls->tissue);
  tissue.fixed_ = scene_.walls->fixed;
  in(tissue);
  if (!tissue.is_consistent()) Byte_reader::refuse();
  return tissue;
}

template <int D>
void save(Byte_writer& out, const World<D>& world) {
  Saved_simulation<D>::write(out, world);
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
  template class Saved_simulation<D>;                             \
  template void save(Byte_writer&, const World<D>&);              \
  template void save(Byte_writer&, const Change_schedule<D>&);    \
  template void save(Byte_writer&, const Wall_pulsation<D>&);     \
  template void save(Byte_writer&, const Elastic_foundation<D>&); \
  template void save(Byte_writer&, const Tissue<D>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
