// SPDX-License-Identifier: LGPL-3.0-or-later
// The order of a step, free particles and then bodies in parallel, and the edits of the environment.
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "simulation/traces/check_motion.h"

namespace cellwalk {
namespace {

[[noreturn]] void refuse_particle(std::size_t particle, std::uint32_t step) {
  detail::refuse_motion(fmt::format("particle {} in step {}: its motion", particle, step));
}

}  // namespace

template <int D>
void World<D>::check_epoch() const {
  snapshot_->check_epoch(epoch_, "this World was made: make a new one");
}

template <int D>
void World<D>::step() {
  check_epoch();
  if (is_stepping_) throw Error(Error_code::usage, "a step of this World failed: make a new one");
  if (!std::isfinite((steps_done_ + 1.0) * scene_.time_step))
    throw Error(
        Error_code::input,
        fmt::format("the time after step {} is not finite: take a smaller time step", steps_done_ + 1));
  is_stepping_ = true;
  ++steps_done_;
  contacts_.clear();
  step_free();
  step_bodies();
  is_stepping_ = false;
}

/// Opens the environment with all that moves in it, and calls use(reshaping).
template <int D>
template <class Use>
auto World<D>::reshape(Environment<D>& environment, Reshape_options options, Reshape_counts& counts,
                       const Use& use) {
  if (&environment.snapshot() != snapshot_)
    throw Error(Error_code::usage, "this World lies in another environment");
  check_epoch();
  Residents<D> residents;
  for (Moving_body<D>& moving : bodies_) residents.bodies.push_back(&moving.body());
  if (!particles_.empty()) residents.particles.emplace_back(particles_);
  options.body = conditions_.body;
  Reshaping<D> reshaping(environment, residents, options);
  auto result = use(reshaping);
  reshaping.finish();
  epoch_ = snapshot_->epoch();
  counts += reshaping.counts();
  return result;
}

template <int D>
Move_report<D> World<D>::move_walls(Environment<D>& environment, std::span<const Vertex_move<D>> moves,
                                    Reshape_options options, Reshape_counts& counts) {
  return reshape(environment, options, counts, [&](Reshaping<D>& open) { return open.move(moves); });
}

template <int D>
Relax_report World<D>::relax(Environment<D>& environment, std::span<const std::uint32_t> points,
                             const Relax_options& options, Reshape_counts& counts) {
  const Relax_report report =
      reshape(environment, {}, counts, [&](Reshaping<D>& open) { return open.relax(points, options); });
  if (report.operations() > report.smoothed) forget_cells();
  return report;
}

template <int D>
std::vector<Change_outcome> World<D>::change(Environment<D>& environment, Change_schedule<D>& schedule,
                                             Reshape_counts& counts) {
  if (!schedule.is_due(steps_done_ + 1)) return {};
  auto made = reshape(environment, {}, counts,
                      [&](Reshaping<D>& open) { return schedule.apply(*snapshot_, open, steps_done_ + 1); });
  if (std::any_of(made.begin(), made.end(), [](const Change_outcome& one) { return one.cut.has_value(); }))
    forget_cells();
  return made;
}

/// Cells were replaced: the cells of contacts may be gone, or others may have their names.
template <int D>
void World<D>::forget_cells() {
  for (Run_contact<D>& met : contacts_) {
    met.contact.facet = Half_facet::none;
    met.contact.cell = Cell::none;
  }
}

template <int D>
void World<D>::record_contacts(std::size_t particle) {
  for (Contact<D>& met : timed_contacts_) {
    met.normal = met.normal + Vector<D>{};  // no negative zeros for readers of tables
    contacts_.push_back(
        {steps_done_, static_cast<std::uint32_t>(particle), met, snapshot_->index(met.cell), {}});
  }
  timed_contacts_.clear();
}

template <int D>
void World<D>::step_free() {
  const double dt = scene_.time_step;
  const Wall_response response{scene_.restitution, scene_.friction};
  for (std::size_t i = own_particles_.first; i < own_particles_.second; ++i) {
    const Vector<D> displacement = dt * (velocities_[i] + dt * scene_.gravity);
    if (!is_finite(particles_[i].position + displacement)) refuse_particle(i, steps_done_);
    velocities_[i] =
        (1 / dt) * advance(*snapshot_, particles_[i], displacement, response, timed_contacts_, counts_);
    if (!is_finite(velocities_[i])) refuse_particle(i, steps_done_);
    record_contacts(i);
  }
}

/// Nothing that moves meets anything else that moves, so all bodies may move at the same time; contacts are
/// reported in their order.
template <int D>
void World<D>::step_bodies() {
  constexpr std::size_t bodies_at_once = 8;
  body_steps_.resize(bodies_.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, own_bodies_.size(), bodies_at_once),
                    [&](const auto& range) {
                      for (std::size_t own = range.begin(); own < range.end(); ++own) {
                        const std::uint32_t i = own_bodies_[own];
                        auto& [report, counts, refusal] = body_steps_[i];
                        report.clear();
                        try {
                          bodies_[i].step(conditions_, report, counts);
                        } catch (const Error& error) {
                          refusal = error;
                        }
                      }
                    });
  for (const std::uint32_t i : own_bodies_)
    if (const std::optional<Error>& refusal = body_steps_[i].refusal)
      throw Error(refusal->code(), fmt::format("body {} in step {}: {}", i, steps_done_, refusal->what()));
  for (const std::uint32_t i : own_bodies_)
    for (Contact<D> met : body_steps_[i].report.contacts) {
      met.normal = met.normal + Vector<D>{};
      contacts_.push_back({steps_done_, 0, met, snapshot_->index(met.cell), i});
    }
}

template <int D>
Body_counts World<D>::body_counts() const {
  Body_counts sum;
  for (std::size_t i = 0; i < bodies_.size(); ++i) sum += body_counts(i);
  return sum;
}

template <int D>
Walk_counts World<D>::counts() const {
  Walk_counts sum = counts_;
  for (const Walk_counts& more : remote_counts_) sum += more;
  return sum;
}

template <int D>
Body_counts World<D>::body_counts(std::size_t body) const {
  if (is_remote(body)) return remote_bodies_[body]->counts;
  return body < body_steps_.size() ? body_steps_[body].counts : Body_counts{};  // empty before the first step
}

template <int D>
void World<D>::validate() {
  check_epoch();
  for (std::size_t i = own_particles_.first; i < own_particles_.second; ++i) {
    const Particle<D>& p = particles_[i];
    if (p.cell != Cell::none && !snapshot_->is_solid(p.cell) && in_closure(*snapshot_, p.cell, p.position))
      continue;
    throw Error(Error_code::other,
                fmt::format("particle {} is not in the closure of its cell after step {} (position {})", i,
                            steps_done_, fmt::join(p.position, ", ")));
  }
  body_steps_.resize(bodies_.size());
  for (const std::uint32_t i : own_bodies_) {
    bodies_[i].body().refresh(body_steps_[i].counts);
    try {
      bodies_[i].body().validate();
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("body {} after step {}: {}", i, steps_done_, error.what()));
    }
  }
}

template <int D>
const Rod<D>* World<D>::catheter() const {
  for (const Moving_body<D>& moving : bodies_)
    if (const auto* rod = moving.template as<Rod<D>>()) return rod;
  return nullptr;
}

// Functions that the header defines too, for programs that do not inline them.
template class World<2>;
template class World<3>;

}  // namespace cellwalk
