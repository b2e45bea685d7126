// SPDX-License-Identifier: LGPL-3.0-or-later
// The public functions of Body: they check their arguments, and steps within a region end here.
#include <cellwalk/body/body.h>
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/internal/kernel/gradual_underflow.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

#include "body/region/point_box.h"
#include "body/registration/register_again.h"
#include "body/registration/sides_of_faces.h"
#include "body/shape/body_faces.h"
#include "body/step/step_at_target.h"
#include "body/step/vertex_move.h"
#include "body_state.h"

namespace cellwalk {
namespace {

/// Bits in the sets of a Rejected_move.
constexpr std::size_t most_reported_edges = 64;

[[noreturn, gnu::noinline]] void refuse_rule() {
  throw Error(Error_code::usage, "a vertex of this body has more than 64 edges: use Step_rule::reject");
}

void check_rule(const Body_options& options, const detail::Body_topology& topology) {
  if (options.rule == Step_rule::reject_at_target && topology.max_degree() > most_reported_edges)
    refuse_rule();
}

[[noreturn, gnu::noinline]] void refuse_number(const char* what, std::size_t number, std::size_t count) {
  throw Error(Error_code::usage, fmt::format("there is no {} {}: the body has {}", what, number, count));
}

[[noreturn, gnu::noinline]] void refuse_target_count(std::size_t targets, std::size_t vertices) {
  throw Error(
      Error_code::usage,
      fmt::format("{} targets are given for a body of {} vertices: give one for each", targets, vertices));
}

[[noreturn]] void refuse_stale(const char* function) {
  throw Error(Error_code::usage,
              fmt::format("a body that moved in a region free of walls is not registered yet: "
                          "call Body::refresh() before {}",
                          function));
}

/// \throw Error(input) naming the first target that is not finite
template <int D>
void check_targets(std::span<const Point<D>> targets) {
  if (detail::are_finite<D>(targets)) [[likely]]
    return;
  for (std::size_t v = 0; v < targets.size(); ++v)
    detail::check_finite(targets[v], fmt::format("the target of vertex {} of a body", v));
}

/// A step of a body that leaves its region free of walls, or has none. Not to be inlined: others are short.
template <int D>
[[gnu::noinline]] void step_out_of_region(detail::Body_state<D>& body, std::span<const Point<D>> targets,
                                          const Body_options& options, Step_report<D>& report,
                                          Body_counts& counts) {
  expect_gradual_underflow();
  if (!body.thick.are_none()) detail::check_thick_sweep(options.sweep);
  check_targets<D>(targets);
  if (options.sweep.search) [[unlikely]]
    detail::check_search(*options.sweep.search);
  counts.moves += targets.size();
  if (targets.empty() || body.try_move_all_in_new_region(targets, options.clearance, counts)) return;
  if (options.rule == Step_rule::reject_at_target)
    detail::Target_step<D>(body, options.sweep, counts).move_each(targets, options.reports_blocked, report);
  else
    detail::move_each(body, targets, options, report.contacts, counts);
}

/// A step of a body whose region is cut by half-spaces, and its box holds the targets. Not to be inlined, as
/// above.
template <int D>
[[gnu::noinline]] void step_before_planes(detail::Body_state<D>& body, std::span<const Point<D>> targets,
                                          const Body_options& options, Step_report<D>& report,
                                          Body_counts& counts) {
  if (!body.region.region()->are_before_planes(targets))
    return step_out_of_region(body, targets, options, report, counts);
  counts.moves += targets.size();
  body.move_all(targets, counts);
}

template <int D>
std::unique_ptr<detail::Body_state<D>> registered(const Snapshot<D>& snapshot, const Locator<D>& locator,
                                                  const Body_soup<D>& soup) {
  auto state = std::make_unique<detail::Body_state<D>>(
      snapshot, locator, soup, detail::Registered_before<D>{}, detail::Body_certificates{});
  detail::check_distances(*state, state->thick, Error_code::outside);
  if constexpr (D == 3) {
    Face_counts uncounted;
    const auto pierced = detail::register_faces(*state, uncounted);
    if (pierced.empty()) return state;
    for (const detail::Pierced_face& of : pierced)
      if (detail::is_pierced_on_all_sides(*state, of))
        detail::refuse_pierced(*state, of, Error_code::outside);
    // The faces may pass on other sides of walls than those which the edges prefer.
    const detail::Side_search search =
        detail::find_sides_of_faces(*state, detail::sides_left(snapshot, locator, soup));
    if (search != detail::Side_search::found)
      detail::refuse_pierced(*state, pierced.front(), Error_code::outside,
                             search == detail::Side_search::ended);
    state->pool.prepare(snapshot, state->particles);
  }
  return state;
}

}  // namespace

template <int D>
Body<D>::Body(const Snapshot<D>& snapshot, const Locator<D>& locator, const Body_soup<D>& soup)
    : state_(registered<D>(snapshot, locator, soup)) {}

template <int D>
Body<D>::Body(const Environment<D>& environment, const Body_soup<D>& soup)
    : Body(environment.snapshot(), Locator<D>(environment.snapshot()), soup) {}

template <int D>
Body<D>::Body(std::unique_ptr<detail::Body_state<D>> state) : state_(std::move(state)) {}

template <int D>
Body<D>::Body(const Body& other) : state_(std::make_unique<detail::Body_state<D>>(*other.state_)) {}

template <int D>
Body<D>& Body<D>::operator=(const Body& other) {
  return *this = Body(other);
}

template <int D>
Body<D>::Body(Body&&) noexcept = default;
template <int D>
Body<D>& Body<D>::operator=(Body&&) noexcept = default;
template <int D>
Body<D>::~Body() = default;

template <int D>
void Body<D>::register_again(const Locator<D>& locator) {
  state_ = detail::registered_again(*state_, locator);
}

template <int D>
std::span<const Point<D>> Body<D>::positions() const {
  return state_->positions;
}
template <int D>
std::span<const std::array<std::uint32_t, 2>> Body<D>::edges() const {
  return state_->topology.edges();
}
template <int D>
std::span<const std::array<std::uint32_t, 3>> Body<D>::faces() const {
  return state_->topology.faces();
}
template <int D>
std::span<const Particle<D>> Body<D>::particles() const {
  return state_->particles;
}
template <int D>
const Chain& Body<D>::chain(std::size_t edge) const {
  if (edge >= state_->chains.size()) refuse_number("edge", edge, state_->chains.size());
  return state_->chains[edge];
}

template <int D>
double Body<D>::radius(std::size_t edge) const {
  if (edge >= state_->chains.size()) refuse_number("edge", edge, state_->chains.size());
  return state_->thick.radius(static_cast<std::uint32_t>(edge));
}

template <int D>
std::vector<double> Body<D>::clearances(double up_to) const {
  state_->check_epoch();
  if (!(up_to >= 0 && std::isfinite(up_to)))
    throw Error(Error_code::usage,
                fmt::format("clearances take a finite number of at least 0, not {}", up_to));
  if (state_->region.is_any_stale()) refuse_stale("Body::clearances()");
  std::vector<double> result;
  for (std::uint32_t e = 0; e < edges().size(); ++e) {
    const auto [u, v] = edges()[e];
    const double found = detail::clearance<D>(*state_->snapshot, state_->particles[u].cell, positions()[u],
                                              positions()[v], up_to);
    result.push_back(std::max(found, std::min(up_to, state_->thick.radius(e))));
  }
  return result;
}

template <int D>
void Body<D>::set_radii(std::span<const double> radii) {
  state_->check_epoch();
  detail::Thick_parts<D> thick(radii, state_->topology, vertex_count());
  Body_counts uncounted;
  leave_region(uncounted);
  detail::check_distances(*state_, thick, Error_code::outside);
  state_->thick = std::move(thick);
  state_->begin_regions(state_->certificates);
}

template <int D>
Cell Body<D>::cell_of(std::uint32_t vertex) const {
  if (vertex >= vertex_count()) refuse_number("vertex", vertex, vertex_count());
  Particle<D> particle = state_->particles[vertex];
  Walk_counts uncounted;
  if (const Point<D>& position = state_->positions[vertex]; particle.position != position)
    state_->follow(vertex, particle, uncounted);
  return particle.cell;
}

template <int D>
std::vector<std::uint32_t> Body<D>::neighbours(std::uint32_t vertex) const {
  if (vertex >= vertex_count()) refuse_number("vertex", vertex, vertex_count());
  std::vector<std::uint32_t> result;
  for (const detail::Corner& corner : state_->topology.corners_of(vertex)) result.push_back(corner.other);
  return result;
}

template <int D>
void Body<D>::step(std::span<const Point<D>> targets, const Body_options& options, Step_report<D>& report,
                   Body_counts& counts) {
  detail::Body_state<D>& body = *state_;
  check_rule(options, body.topology);
  body.check_epoch();
  // Pointers, since sizes would have to be divided by the size of a point.
  if (body.positions.data() + targets.size() != std::to_address(body.positions.end())) [[unlikely]]
    refuse_target_count(targets.size(), body.positions.size());
  const auto* region = options.clearance && body.region.holds_body() ? body.region.region() : nullptr;
  if (!region || !region->box().holds_all(targets)) [[unlikely]]
    return step_out_of_region(body, targets, options, report, counts);
  if (region->plane_count() > 0) [[unlikely]]
    return step_before_planes(body, targets, options, report, counts);
  counts.moves += targets.size();
  body.move_all(targets, counts);
}

template <int D>
std::vector<Contact<D>> Body<D>::step(std::span<const Point<D>> targets) {
  Step_report<D> report;
  Body_counts uncounted;
  step(targets, {}, report, uncounted);
  return std::move(report.contacts);
}

template <int D>
std::optional<Contact<D>> Body<D>::move_vertex(std::uint32_t vertex, const Point<D>& target,
                                               const Body_options& options, Body_counts& counts) {
  if (vertex >= vertex_count()) refuse_number("vertex", vertex, vertex_count());
  detail::check_finite(target, "the target of a vertex");
  if (options.sweep.search) detail::check_search(*options.sweep.search);
  if (!state_->thick.are_none()) detail::check_thick_sweep(options.sweep);
  leave_region(counts);
  return detail::try_move(*state_, state_->scratch, vertex, target, options.sweep, counts);
}

template <int D>
void Body<D>::refresh(Body_counts& counts) {
  state_->check_epoch();
  state_->refresh_all(counts);
}

template <int D>
void Body<D>::leave_region(Body_counts& counts) {
  refresh(counts);
  state_->give_region_up();
}

template <int D>
void Body<D>::validate() const {
  state_->check_epoch();
  if (state_->region.is_any_stale()) refuse_stale("Body::validate()");
  const Snapshot<D>& snapshot = *state_->snapshot;
  const auto& [positions, particles, chains] = std::tie(state_->positions, state_->particles, state_->chains);
  Walk_counts counts;
  for (std::size_t v = 0; v < particles.size(); ++v) {
    const Particle<D>& p = particles[v];
    if (p.position == positions[v] && p.cell != Cell::none && !snapshot.is_solid(p.cell) &&
        in_closure(snapshot, p.cell, p.position))
      continue;
    throw Error(Error_code::other,
                fmt::format("vertex {} of a body is not in the closure of its cell, at ({})", v,
                            fmt::join(p.position, ", ")));
  }
  for (std::size_t e = 0; e < chains.size(); ++e) {
    const auto [u, v] = state_->topology.edges()[e];
    if (is_chain(snapshot, particles[u], particles[v], chains[e], counts)) continue;
    throw Error(Error_code::other, fmt::format("edge {} of a body has no valid chain, from ({}) to ({})", e,
                                               fmt::join(positions[u], ", "), fmt::join(positions[v], ", ")));
  }
  detail::check_distances(*state_, state_->thick, Error_code::other);
  if constexpr (D == 3) {
    if (!state_->are_faces_swept) return;
    Face_counts face_counts;
    for (std::uint32_t f = 0; f < state_->supporting_walls.size(); ++f) {
      const Face_registration found = detail::registered_face(*state_, f, face_counts);
      if (found.piercing == Half_facet::none && found.supporting_walls == state_->supporting_walls[f])
        continue;
      throw Error(Error_code::other, fmt::format("a wall pierces face {} of a body, at ({})", f,
                                                 fmt::join(positions[faces()[f][0]], ", ")));
    }
  }
}

template class Body<2>;
template class Body<3>;

}  // namespace cellwalk
