// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/kernel/bytes.h>
#include <cellwalk/internal/simulation/world_part.h>

#include <algorithm>
#include <tuple>

namespace cellwalk {
namespace {

/// A contact as bytes, with its time as it is reported.
template <int D>
struct Told_contact {
  std::uint32_t step = 0, particle = 0, cell_index = 0, body = 0, vertex = 0, feature = 0;
  bool is_of_body = false;
  Body_feature body_feature = Body_feature::vertex;
  Contact_kind kind = Contact_kind::facet;
  std::uint16_t corner = 0;
  Half_facet facet = Half_facet::none;
  Cell cell = Cell::none;
  double time = 0;
  Point<D> point{};
  Vector<D> normal{};
};

template <int D>
Told_contact<D> told(const Run_contact<D>& met) {
  const Contact<D>& c = met.contact;
  return {met.step,
          met.particle,
          met.cell,
          met.body.value_or(0),
          c.vertex,
          c.feature,
          met.body.has_value(),
          c.body,
          c.kind,
          c.corner,
          c.facet,
          c.cell,
          c.rounded_time(),
          c.point,
          c.normal};
}

template <int D>
Run_contact<D> as_met(const Told_contact<D>& c) {
  Run_contact<D> met;
  met.step = c.step;
  met.particle = c.particle;
  met.cell = c.cell_index;
  if (c.is_of_body) met.body = c.body;
  met.contact = {Exact_time(c.time), c.point,  c.normal, c.kind, c.corner, c.facet, c.cell,
                 c.body_feature,     c.vertex, c.feature};
  return met;
}

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
  world.elsewhere_.resize(world.bodies_.size());
  for (std::size_t b = 0; b < world.bodies_.size(); ++b) {
    const auto positions = world.bodies_[b].body().positions();
    const bool is_own = std::ranges::binary_search(world.own_bodies_, static_cast<std::uint32_t>(b));
    if (is_own) continue;
    auto& stand_in = world.elsewhere_[b].emplace();
    stand_in.positions.assign(positions.begin(), positions.end());
    for (std::uint32_t v = 0; v < positions.size(); ++v)
      stand_in.cells.push_back(world.snapshot_->index(world.bodies_[b].body().cell_of(v)));
  }
  world.counts_elsewhere_.resize(count);
  if (number > 0) world.counts_ = {};  // those of placing all are counted by the first part
}

template <int D>
std::string World_part<D>::tell(const Told& what) const {
  Byte_writer bytes;
  std::vector<Told_contact<D>> contacts;
  if (what.contacts)
    for (const Run_contact<D>& met : world_.contacts_) contacts.push_back(told(met));
  bytes.list(contacts);
  bytes.value(what.states);
  if (!what.states) return bytes.take();
  const auto [begin, end] = world_.own_particles_;
  bytes.value(number_);
  bytes.value(begin);
  bytes.list(std::span<const Particle<D>>(world_.particles_).subspan(begin, end - begin));
  bytes.list(std::span<const Vector<D>>(world_.velocities_).subspan(begin, end - begin));
  bytes.value(world_.counts_);
  bytes.list(world_.own_bodies_);
  std::vector<std::uint32_t> cells;
  for (const std::uint32_t b : world_.own_bodies_) {
    const std::span<const Point<D>> positions = world_.positions(b);
    cells.clear();
    for (std::uint32_t v = 0; v < positions.size(); ++v) cells.push_back(world_.cell_of(b, v));
    bytes.list(positions);
    bytes.list(cells);
    bytes.value(world_.body_counts(b));
    bytes.value(world_.has_arrived(b));
  }
  return bytes.take();
}

template <int D>
void World_part<D>::take_over(std::string_view told_bytes) {
  Byte_reader bytes(told_bytes);
  for (const Told_contact<D>& c : bytes.list<Told_contact<D>>()) world_.contacts_.push_back(as_met(c));
  if (!bytes.value<bool>()) return;
  const auto part = bytes.value<std::size_t>();
  const auto begin = bytes.value<std::uint32_t>();
  const auto particles = bytes.list<Particle<D>>();
  const auto velocities = bytes.list<Vector<D>>();
  if (begin > world_.particles_.size() || particles.size() > world_.particles_.size() - begin ||
      velocities.size() != particles.size() || part >= world_.counts_elsewhere_.size())
    throw Error(Error_code::other, "particles of another process are not those of this scene");
  std::ranges::copy(particles, world_.particles_.begin() + begin);
  std::ranges::copy(velocities, world_.velocities_.begin() + begin);
  world_.counts_elsewhere_[part] = bytes.value<Walk_counts>();
  for (const std::uint32_t b : bytes.list<std::uint32_t>()) {
    if (b >= world_.elsewhere_.size() || !world_.elsewhere_[b])
      throw Error(Error_code::other, "bodies of another process are not those of this scene");
    auto& stand_in = *world_.elsewhere_[b];
    stand_in.positions = bytes.list<Point<D>>();
    stand_in.cells = bytes.list<std::uint32_t>();
    stand_in.counts = bytes.value<Body_counts>();
    stand_in.has_arrived = bytes.value<bool>();
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
