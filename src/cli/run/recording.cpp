// SPDX-License-Identifier: LGPL-3.0-or-later
#include "recording.h"

#include <cellwalk/io/vtu.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace cellwalk::cli {
namespace {

using io::in_space;

/// Points times records of which a page stays below 30 MB: packed, a point takes 2 to 4 bytes a record, and
/// base64 adds a third.
constexpr std::uint64_t most_recorded_points = 5'000'000;
/// Where walls move, the box is wider by this share of its size on each side.
constexpr double room_for_walls = 0.1;
/// More passable edges of the plane than this are a grey area, not lines.
constexpr std::size_t most_lines = 40'000;

/// Free cells in the order of the input.
template <int D, class Visit>
void for_free_cells(const Snapshot<D>& snapshot, Visit&& visit) {
  for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
    if (const Cell cell = snapshot.cell(i); cell != Cell::none && !snapshot.is_solid(cell)) visit(cell);
}

/// The lower half-facet of a facet stands for it.
template <int D>
Half_facet name_of(const Snapshot<D>& snapshot, Half_facet facet) {
  const Half_facet other = snapshot.opposite(facet);
  return other == Half_facet::none ? facet : std::min(facet, other);
}

/// Walls that stay, then both sides of the facets that come and go.
/// \param changing ascending, each by its lower half-facet
template <int D>
void add_walls(const Snapshot<D>& snapshot, std::span<const Half_facet> changing, Recording_scene& scene) {
  for_free_cells(snapshot, [&](Cell cell) {
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f) {
      const Half_facet facet = snapshot.half_facet(cell, f);
      if (!snapshot.is_impassable(facet)) continue;
      if (changing.empty() || !std::binary_search(changing.begin(), changing.end(), name_of(snapshot, facet)))
        scene.walls.push_back(snapshot.loop(facet));
    }
  });
  for (const Half_facet facet : changing)
    for (const Half_facet side : {facet, snapshot.opposite(facet)})
      scene.walls.push_back(snapshot.loop(side));
  scene.changing_walls = static_cast<std::uint32_t>(2 * changing.size());
}

/// What pictures of the plane show besides walls: free cells and, unless they are too many, the edges between
/// them.
void add_areas(const Snapshot<3>&, const Selection<3>&, Recording_scene&) {}
void add_areas(const Snapshot<2>& snapshot, const Selection<2>& changing, Recording_scene& scene) {
  const auto add_floor = [&](Cell cell) {
    auto& loop = scene.floor.emplace_back();
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f)
      loop.push_back(snapshot.loop(snapshot.half_facet(cell, f))[0]);
  };
  for_free_cells(snapshot, [&](Cell cell) {
    if (!std::binary_search(changing.cells.begin(), changing.cells.end(), cell)) add_floor(cell);
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f) {
      const Half_facet facet = snapshot.half_facet(cell, f);
      const auto ends = snapshot.loop(facet);
      if (!snapshot.is_impassable(facet) && snapshot.index(snapshot.neighbour(facet)) > snapshot.index(cell))
        scene.lines.push_back({ends[0], ends[1]});
    }
  });
  std::for_each(changing.cells.begin(), changing.cells.end(), add_floor);
  scene.changing_floor = static_cast<std::uint32_t>(changing.cells.size());
  if (scene.lines.size() > most_lines) scene.lines.clear();
}

template <int D>
void add_bodies(const World<D>& world, Recording_scene& scene) {
  std::uint32_t first = 0;
  for (const Moving_body<D>& moving : world.bodies()) {
    const Body<D>& body = moving.body();
    const auto count = [](std::size_t size) { return static_cast<std::uint32_t>(size); };
    scene.bodies.push_back({moving.template as<Rod<D>>() != nullptr, count(body.vertex_count()),
                            count(body.edges().size()), count(body.faces().size())});
    for (const auto& [u, v] : body.edges()) scene.edges.push_back({first + u, first + v});
    for (const auto& [u, v, w] : body.faces()) scene.faces.push_back({first + u, first + v, first + w});
    first += count(body.vertex_count());
  }
}

template <int D>
Recording_scene scene_of(const Snapshot<D>& snapshot, const World<D>& world, const Motion_times& times,
                         bool walls_move, const Selection<D>& changing,
                         std::vector<std::uint32_t>& wall_points) {
  Recording_scene scene;
  scene.dimension = D;
  scene.time_step = times.step;
  scene.steps = times.steps;
  scene.every = times.every;
  scene.walls_move = walls_move;
  scene.cells = static_cast<std::uint32_t>(snapshot.cell_count());
  scene.particles = static_cast<std::uint32_t>(world.particles().size());
  scene.lower.fill(std::numeric_limits<double>::max());
  scene.upper.fill(std::numeric_limits<double>::lowest());
  for (const Point<D>& x : snapshot.points()) {
    const Point<3>& point = scene.points.emplace_back(in_space(x));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scene.lower[axis] = std::min(scene.lower[axis], point[axis]);
      scene.upper[axis] = std::max(scene.upper[axis], point[axis]);
    }
  }
  for (std::size_t axis = 0; walls_move && axis < D; ++axis) {
    const double room = room_for_walls * (scene.upper[axis] - scene.lower[axis]);
    scene.lower[axis] -= room;
    scene.upper[axis] += room;
  }
  add_walls<D>(snapshot, changing.facets, scene);
  add_areas(snapshot, changing, scene);
  add_bodies(world, scene);
  // Points that nothing names are not written.
  std::vector<std::uint32_t> number(scene.points.size(), 0);
  std::vector<Point<3>> named;
  const auto rename = [&](std::uint32_t& index) {
    if (number[index] == 0) {
      named.push_back(scene.points[index]);
      wall_points.push_back(index);
      number[index] = static_cast<std::uint32_t>(named.size());
    }
    index = number[index] - 1;
  };
  for (auto* loops : {&scene.walls, &scene.floor})
    for (auto& loop : *loops) std::for_each(loop.begin(), loop.end(), rename);
  for (auto& line : scene.lines) std::for_each(line.begin(), line.end(), rename);
  scene.points = std::move(named);
  return scene;
}

/// The costliest way in which something was decided between two counts.
Decision decision(const Body_counts& before, const Body_counts& now) {
  const auto grew = [&](auto member) { return now.edges.*member > before.edges.*member; };
  if (now.contacts > before.contacts) return Decision::contact;
  if (grew(&Edge_counts::event_sweeps)) return Decision::events;
  if (grew(&Edge_counts::clear)) return Decision::clear;
  if (grew(&Edge_counts::same_chain)) return Decision::same_chain;
  if (grew(&Edge_counts::convex_pair)) return Decision::convex_pair;
  if (grew(&Edge_counts::same_cell)) return Decision::same_cell;
  const auto moves = now.moves - before.moves, in_region = now.in_region - before.in_region;
  if (moves == 0) return Decision::none;
  if (moves == in_region) return Decision::region;
  return grew(&Edge_counts::edges) ? Decision::events : Decision::same_cell;
}

}  // namespace

template <int D>
Run_recording<D>::Run_recording(std::filesystem::path path, const Snapshot<D>& snapshot,
                                const World<D>& world, const Motion_times& times, bool walls_move,
                                const Selection<D>& changing)
    : snapshot_(snapshot),
      every_(times.every),
      walls_move_(walls_move),
      writer_(std::move(path), scene_of(snapshot, world, times, walls_move, changing, wall_points_)),
      before_(world.bodies().size()) {
  for (const Half_facet facet : changing.facets) {
    changing_walls_.push_back(facet);
    changing_walls_.push_back(snapshot.opposite(facet));
  }
  if (D == 2) changing_floor_ = changing.cells;
  add(world);
}

template <int D>
void Run_recording<D>::record(const World<D>& world, bool is_last) {
  if (is_last || world.steps_done() % every_ == 0) add(world);
}

template <int D>
void Run_recording<D>::add(const World<D>& world) {
  std::vector<Point<3>> positions;
  std::vector<std::uint32_t> cells;
  std::vector<Decision> decisions;
  const auto free = world.particles();
  for (const Particle<D>& particle : free) {
    positions.push_back(in_space(particle.position));
    cells.push_back(snapshot_.index(particle.cell));
  }
  for (std::size_t b = 0; b < world.bodies().size(); ++b) {
    const Body<D>& body = world.bodies()[b].body();
    for (std::uint32_t v = 0; v < body.vertex_count(); ++v) {
      positions.push_back(in_space(body.positions()[v]));
      cells.push_back(snapshot_.index(body.cell_of(v)));
    }
    const Body_counts now = world.body_counts(b);
    decisions.push_back(decision(before_[b], now));
    before_[b] = now;
  }
  if (walls_move_)
    for (const std::uint32_t i : wall_points_) positions.push_back(in_space(snapshot_.point(i)));
  std::vector<std::uint8_t> is_there;
  for (const Half_facet side : changing_walls_)
    is_there.push_back(snapshot_.is_impassable(side) && !snapshot_.is_solid(snapshot_.cell_of(side)));
  for (const Cell cell : changing_floor_) is_there.push_back(!snapshot_.is_solid(cell));
  writer_.add({positions, cells, decisions, is_there});
}

template <int D>
std::uint32_t motion_interval(const Scene<D>& scene, const Snapshot<D>& snapshot, const World<D>& world,
                              std::uint32_t steps) {
  if (scene.output.motion_every) return *scene.output.motion_every;
  std::uint64_t points = world.particles().size() + (scene.walls ? snapshot.points().size() : 0);
  for (const Moving_body<D>& moving : world.bodies()) points += moving.body().vertex_count();
  return static_cast<std::uint32_t>(1 + steps * points / most_recorded_points);
}

template class Run_recording<2>;
template class Run_recording<3>;
template std::uint32_t motion_interval(const Scene<2>&, const Snapshot<2>&, const World<2>&, std::uint32_t);
template std::uint32_t motion_interval(const Scene<3>&, const Snapshot<3>&, const World<3>&, std::uint32_t);

}  // namespace cellwalk::cli
