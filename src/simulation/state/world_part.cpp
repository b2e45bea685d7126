// SPDX-License-Identifier: LGPL-3.0-or-later
// The bodies of each part by their vertices, and the states that are handed over.
#include <cellwalk/internal/kernel/byte_archive.h>
#include <cellwalk/internal/simulation/saved_contacts.h>
#include <cellwalk/internal/simulation/world_part.h>
#include <cellwalk/internal/walk/saved_particle.h>

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace cellwalk {
namespace {

/// The first body of a part, of those without the catheter: parts hold about as many vertices.
template <int D>
std::uint32_t first_body(const World<D>& world, std::size_t number, std::size_t count) {
  const auto bodies = world.bodies();
  const std::size_t ordinary = bodies.size() - (world.catheter() != nullptr);
  if (number == 0) return 0;
  if (number == count) return static_cast<std::uint32_t>(ordinary);
  std::size_t all = 0, before = 0;
  for (const Moving_body<D>& moving : bodies) all += moving.body().vertex_count();
  if (world.catheter() != nullptr) before = bodies.back().body().vertex_count();
  std::uint32_t i = 0;
  while (i < ordinary && before * count < all * number) before += bodies[i++].body().vertex_count();
  return i;
}

}  // namespace

template <int D>
World_part<D>::World_part(World<D>& world, std::size_t number, std::size_t count)
    : world_(world), number_(number) {
  const std::size_t particles = world.particles_.size();
  const auto particle_of = [&](std::size_t part) {
    return static_cast<std::uint32_t>(particles * part / count);
  };
  world.own_particles_ = {particle_of(number), particle_of(number + 1)};
  world.own_bodies_.clear();
  const std::uint32_t end = first_body(world, number + 1, count);
  for (std::uint32_t b = first_body(world, number, count); b < end; ++b) world.own_bodies_.push_back(b);
  if (number == 0 && world.catheter() != nullptr)
    world.own_bodies_.push_back(static_cast<std::uint32_t>(world.bodies_.size() - 1));
  world.remote_bodies_.resize(world.bodies_.size());
  for (std::size_t b = 0; b < world.bodies_.size(); ++b) {
    const auto positions = world.bodies_[b].body().positions();
    const bool is_own = std::ranges::binary_search(world.own_bodies_, static_cast<std::uint32_t>(b));
    if (is_own) continue;
    auto& remote = world.remote_bodies_[b].emplace();
    remote.positions.assign(positions.begin(), positions.end());
    for (std::uint32_t v = 0; v < positions.size(); ++v)
      remote.cells.push_back(world.snapshot_->index(world.bodies_[b].body().cell_of(v)));
  }
  world.remote_counts_.resize(count);
  if (number > 0) world.counts_ = {};  // those of placing all are counted by the first part
}

template <int D>
std::string World_part<D>::state_of_part(const State_request& request) const {
  detail::Byte_writer out;
  if (request.contacts)
    out(world_.contacts_);
  else
    out(std::vector<Run_contact<D>>());
  out(request.states);
  if (!request.states) return out.message();
  const auto [begin, end] = world_.own_particles_;
  const auto own = [begin = begin, end = end](const auto& all) {
    return std::vector(all.begin() + begin, all.begin() + end);
  };
  out(number_, begin, own(world_.particles_), own(world_.velocities_), world_.counts_, world_.own_bodies_);
  for (const std::uint32_t b : world_.own_bodies_) {
    const std::span<const Point<D>> positions = world_.positions(b);
    std::vector<std::uint32_t> cells;
    for (std::uint32_t v = 0; v < positions.size(); ++v) cells.push_back(world_.cell_of(b, v));
    out(std::vector(positions.begin(), positions.end()), cells, world_.body_counts(b), world_.has_arrived(b));
  }
  return out.message();
}

template <int D>
void World_part<D>::take_over(std::string_view state) {
  detail::Byte_reader in(state);
  for (const auto& met : in.next<std::vector<Run_contact<D>>>()) world_.contacts_.push_back(met);
  if (!in.next<bool>()) return;
  const auto part = in.next<std::size_t>();
  const auto begin = in.next<std::uint32_t>();
  const auto particles = in.next<std::vector<Particle<D>>>();
  const auto velocities = in.next<std::vector<Vector<D>>>();
  if (begin > world_.particles_.size() || particles.size() > world_.particles_.size() - begin ||
      velocities.size() != particles.size() || part >= world_.remote_counts_.size())
    throw Error(Error_code::other, "particles of another process are not those of this scene");
  std::ranges::copy(particles, world_.particles_.begin() + begin);
  std::ranges::copy(velocities, world_.velocities_.begin() + begin);
  in(world_.remote_counts_[part]);
  for (const auto b : in.next<std::vector<std::uint32_t>>()) {
    if (b >= world_.remote_bodies_.size() || !world_.remote_bodies_[b])
      throw Error(Error_code::other, "bodies of another process are not those of this scene");
    auto& remote = *world_.remote_bodies_[b];
    in(remote.positions, remote.cells, remote.counts, remote.has_arrived);
  }
}

template <int D>
void World_part<D>::sort_contacts() {
  const auto key = [](const Run_contact<D>& met) {
    return std::pair(met.body.has_value(), met.body ? *met.body : met.particle);
  };
  std::ranges::stable_sort(world_.contacts_, {}, key);
}

template class World_part<2>;
template class World_part<3>;

}  // namespace cellwalk
