// SPDX-License-Identifier: LGPL-3.0-or-later
// Where the particles of a scene start.
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/random.h>
#include <cellwalk/simulation/route.h>
#include <cellwalk/simulation/world.h>

#include <fmt/format.h>

#include <algorithm>

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

/// A random unit vector.
template <int D>
Vector<D> direction(Random& random) {
  for (;;) {
    Vector<D> v;
    for (double& x : v) x = random.real(-1, 1);
    const double l = length(v);
    if (l > 0.01 && l <= 1) return (1 / l) * v;
  }
}

template <int D>
struct Box {
  Point<D> low, high;
};

template <int D>
Box<D> box_of(const Snapshot<D>& snapshot, Cell c) {
  const Cell_view<D> view = snapshot.view(c);
  Box<D> box{view.point(0), view.point(0)};
  for (std::size_t i = 1; i < view.vertex_count(); ++i)
    for (std::size_t d = 0; d < D; ++d) {
      box.low[d] = std::min(box.low[d], view.point(i)[d]);
      box.high[d] = std::max(box.high[d], view.point(i)[d]);
    }
  return box;
}

}  // namespace

template <int D>
World<D>::World(const Snapshot<D>& snapshot, const Scene<D>& scene) : snapshot_(snapshot), scene_(scene) {
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
  free_count_ = particles_.size();
  if (scene.catheter) place_catheter(*scene.catheter, locator);
}

template <int D>
void World<D>::place_cloud(const Particle_cloud& cloud, const std::string& key) {
  // A cell is drawn by the size of its box, a point uniformly in the box, and both again unless the point is in the
  // cell: uniform in free space, whatever the cells' shapes.
  std::vector<std::uint32_t> cells;
  std::vector<double> sum;
  for (std::uint32_t i = 0; i < snapshot_.cell_count(); ++i) {
    const Cell c = snapshot_.cell(i);
    if (snapshot_.is_solid(c)) continue;
    const Box<D> box = box_of(snapshot_, c);
    double volume = 1;
    for (std::size_t d = 0; d < D; ++d) volume *= box.high[d] - box.low[d];
    cells.push_back(i);
    sum.push_back((sum.empty() ? 0 : sum.back()) + volume);
  }
  if (cells.empty()) throw Error(Error_code::usage, key + ": the environment has no free cell");
  Random random(cloud.seed);
  for (std::uint32_t placed = 0; placed < cloud.count;) {
    const double drawn = random.real(0, sum.back());
    const auto at = static_cast<std::size_t>(std::upper_bound(sum.begin(), sum.end(), drawn) - sum.begin());
    const Cell c = snapshot_.cell(cells[std::min(at, cells.size() - 1)]);
    const Box<D> box = box_of(snapshot_, c);
    Point<D> p;
    for (std::size_t d = 0; d < D; ++d) p[d] = random.real(box.low[d], box.high[d]);
    if (!in_closure(snapshot_, c, p)) continue;
    Particle<D> particle{p, c, static_cast<std::uint16_t>(D), 0};
    move<Exact>(snapshot_, particle, p, counts_);  // finds the dimension, should the point lie on a facet
    particles_.push_back(particle);
    velocities_.push_back(cloud.speed * direction<D>(random));
    ++placed;
  }
}

template <int D>
void World<D>::place_catheter(const Catheter<D>& catheter, const Locator<D>& locator) {
  entry_ = place(locator, catheter.path[0], "catheter.path[0]");
  enter();
  path_ = {entry_.position};
  Particle<D> here = entry_;
  for (std::size_t i = 1; i < catheter.path.size(); ++i) {
    if (!catheter.find_route) {
      path_.push_back(catheter.path[i]);
      continue;
    }
    const std::string key = fmt::format("catheter.path[{}]", i);
    const Particle<D> next = place(locator, catheter.path[i], key);
    const std::vector<Point<D>> route = find_route(snapshot_, here, next, counts_);
    if (route.empty())
      throw Error(Error_code::outside,
                  fmt::format("{}: walls cut it off from the way point before; move it or open a wall", key));
    path_.insert(path_.end(), route.begin() + 1, route.end());
    here = next;
  }
}

template World<2>::World(const Snapshot<2>&, const Scene<2>&);
template World<3>::World(const Snapshot<3>&, const Scene<3>&);
template void World<2>::place_cloud(const Particle_cloud&, const std::string&);
template void World<3>::place_cloud(const Particle_cloud&, const std::string&);
template void World<2>::place_catheter(const Catheter<2>&, const Locator<2>&);
template void World<3>::place_catheter(const Catheter<3>&, const Locator<3>&);

}  // namespace cellwalk
