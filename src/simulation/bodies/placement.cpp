// SPDX-License-Identifier: LGPL-3.0-or-later
// Where the particles of a scene start.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/internal/simulation/route.h>
#include <cellwalk/internal/simulation/world.h>
#include <cellwalk/kernel/error.h>

#include <fmt/format.h>

#include <numeric>
#include <utility>
#include <vector>

#include "random_start.h"

namespace cellwalk {
namespace {

template <int D>
Particle<D> place(const Locator<D>& locator, const Point<D>& position, const std::string& key) {
  const Location<D> location = locator.locate(position);
  if (location.status != Location_status::free)
    throw Error(Error_code::outside,
                fmt::format("{}: ({}) lies {}; put it into free space", key, fmt::join(position, ", "),
                            location.status == Location_status::solid ? "in a solid cell"
                                                                      : "outside the environment"));
  return {position, location.cell, location.dimension, 0};
}

/// A particle in a cell, at a point that may lie on its boundary: a walk to where it is finds the dimension
/// of its place.
template <int D>
Particle<D> particle_in(const Snapshot<D>& snapshot, Cell cell, const Point<D>& position,
                        Walk_counts& counts) {
  Particle<D> particle{position, cell, static_cast<std::uint16_t>(D), 0};
  move<Exact>(snapshot, particle, position, counts);
  return particle;
}

}  // namespace

template <int D>
World<D>::World(const Snapshot<D>& snapshot, const Scene<D>& scene, const Body_options& options, Empty)
    : snapshot_(&snapshot),
      epoch_(snapshot.epoch()),
      scene_(scene),
      conditions_{scene.time_step, scene.gravity, scene.restitution, scene.friction, options} {}

template <int D>
World<D>::World(const Snapshot<D>& snapshot, const Scene<D>& scene, std::vector<Body_soup<D>> shapes,
                const Body_options& options)
    : World(snapshot, scene, options, Empty{}) {
  shapes_ = std::move(shapes);
  const Locator<D> locator(snapshot);
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    const std::string key = fmt::format("particles[{}]", i);
    if (const auto* start = std::get_if<Particle_start<D>>(&scene.particles[i])) {
      particles_.push_back(place(locator, start->position, key + ".position"));
      velocities_.push_back(start->velocity);
    } else {
      place_cloud(std::get<Particle_cloud>(scene.particles[i]), key);
    }
  }
  place_bodies(locator);
  if (scene.catheter) place_catheter(*scene.catheter, locator);
  own_all();
}

template <int D>
void World<D>::own_all() {
  own_particles_ = {0, static_cast<std::uint32_t>(particles_.size())};
  own_bodies_.resize(bodies_.size());
  std::iota(own_bodies_.begin(), own_bodies_.end(), 0);
}

template <int D>
void World<D>::place_cloud(const Particle_cloud& cloud, const std::string& key) {
  const detail::Free_space<D> space(*snapshot_);
  if (space.is_empty()) throw Error(Error_code::usage, key + ": the environment has no free cell");
  Random random(cloud.seed);
  for (std::uint32_t placed = 0; placed < cloud.count; ++placed) {
    const auto [p, cell] = space.draw(random);
    particles_.push_back(particle_in(*snapshot_, cell, p, counts_));
    velocities_.push_back(cloud.speed * detail::random_direction<D>(random));
  }
}

template <int D>
void World<D>::place_catheter(const Catheter<D>& catheter, const Locator<D>& locator) {
  Particle<D> here = place(locator, catheter.path[0], "catheter.path[0]");
  std::vector<Point<D>> way{here.position};
  for (std::size_t i = 1; i < catheter.path.size(); ++i) {
    if (!catheter.find_route) {
      way.push_back(catheter.path[i]);
      continue;
    }
    const std::string key = fmt::format("catheter.path[{}]", i);
    const Particle<D> next = place(locator, catheter.path[i], key);
    const std::vector<Point<D>> route = find_route(*snapshot_, here, next, counts_);
    if (route.empty())
      throw Error(Error_code::outside,
                  fmt::format("{}: walls cut it off from the waypoint before; move it or open a wall", key));
    way.insert(way.end(), route.begin() + 1, route.end());
    here = next;
  }
  try {
    Body<D> body(*snapshot_, locator, Rod<D>::at_entry(catheter));
    bodies_.emplace_back(Rod<D>(*snapshot_, std::move(body), catheter, std::move(way)));
  } catch (const Error& error) {
    throw Error(error.code(), fmt::format("catheter: {}", error.what()));
  }
  entry_of_.push_back({});
}

template World<2>::World(const Snapshot<2>&, const Scene<2>&, const Body_options&, Empty);
template World<3>::World(const Snapshot<3>&, const Scene<3>&, const Body_options&, Empty);
template World<2>::World(const Snapshot<2>&, const Scene<2>&, std::vector<Body_soup<2>>, const Body_options&);
template World<3>::World(const Snapshot<3>&, const Scene<3>&, std::vector<Body_soup<3>>, const Body_options&);
template void World<2>::own_all();
template void World<3>::own_all();
template void World<2>::place_cloud(const Particle_cloud&, const std::string&);
template void World<3>::place_cloud(const Particle_cloud&, const std::string&);
template void World<2>::place_catheter(const Catheter<2>&, const Locator<2>&);
template void World<3>::place_catheter(const Catheter<3>&, const Locator<3>&);

}  // namespace cellwalk
