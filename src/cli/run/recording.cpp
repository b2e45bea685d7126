// SPDX-License-Identifier: LGPL-3.0-or-later
// The choice of the interval between frames, and how each motion was decided.
#include "recording.h"

#include <cellwalk/internal/io/vtu.h>

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

template <int D>
void add_bodies(const World<D>& world, Recording_scene& scene) {
  std::uint32_t first = 0;
  for (const Moving_body<D>& moving : world.bodies()) {
    const Body<D>& body = moving.body();
    const auto count = [](std::size_t size) { return static_cast<std::uint32_t>(size); };
    scene.bodies.push_back({moving.template as<Rod<D>>() != nullptr, count(body.vertex_count()),
                            count(body.edges().size()), count(body.faces().size())});
    for (std::size_t e = 0; e < body.edges().size(); ++e)
      scene.bodies.back().radius = std::max(scene.bodies.back().radius, body.radius(e));
    for (const auto& [u, v] : body.edges()) scene.edges.push_back({first + u, first + v});
    for (const auto& [u, v, w] : body.faces()) scene.faces.push_back({first + u, first + v, first + w});
    first += count(body.vertex_count());
  }
}

template <int D>
Recording_scene scene_of(const Snapshot<D>& snapshot, const World<D>& world, const Motion_times& times,
                         const Wall_motion& motion, Walls_change start) {
  Recording_scene scene;
  scene.dimension = D;
  scene.time_step = times.step;
  scene.steps = times.steps;
  scene.every = times.every;
  scene.walls_move = motion.walls_move;
  scene.walls_change = motion.walls_change;
  scene.cells = static_cast<std::uint32_t>(snapshot.cell_count());
  scene.particles = static_cast<std::uint32_t>(world.particles().size());
  scene.lower.fill(std::numeric_limits<double>::max());
  scene.upper.fill(std::numeric_limits<double>::lowest());
  for (const Point<D>& x : snapshot.points()) {
    const Point<3> point = in_space(x);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scene.lower[axis] = std::min(scene.lower[axis], point[axis]);
      scene.upper[axis] = std::max(scene.upper[axis], point[axis]);
    }
  }
  for (std::size_t axis = 0; motion.walls_move && axis < D; ++axis) {
    const double room = room_for_walls * (scene.upper[axis] - scene.lower[axis]);
    scene.lower[axis] -= room;
    scene.upper[axis] += room;
  }
  add_bodies(world, scene);
  scene.points = std::move(start.points);
  scene.walls = std::move(start.walls.added);
  scene.floor = std::move(start.floor.added);
  for (const auto& line : start.lines.added) scene.lines.push_back({line[0], line[1]});
  return scene;
}

/// The costliest way in which something was decided between two counts.
Decision decision(const Body_counts& before, const Body_counts& now) {
  const auto grew = [&](auto member) { return now.edges.*member > before.edges.*member; };
  if (now.contacts > before.contacts) return Decision::contact;
  if (grew(&Edge_counts::event_sweeps)) return Decision::events;
  if (grew(&Edge_counts::relinked)) return Decision::relinked;
  if (grew(&Edge_counts::same_chain)) return Decision::same_chain;
  if (grew(&Edge_counts::same_cell)) return Decision::same_cell;
  const auto moves = now.moves - before.moves, in_region = now.in_region - before.in_region;
  if (moves == 0) return Decision::none;
  if (moves == in_region) return Decision::region;
  return grew(&Edge_counts::edges) ? Decision::events : Decision::same_cell;
}

}  // namespace

template <int D>
Run_recording<D>::Run_recording(Result_files& place, const Snapshot<D>& snapshot, const World<D>& world,
                                const Motion_times& times, const Wall_motion& motion)
    : snapshot_(snapshot),
      every_(times.every),
      motion_(motion),
      walls_(snapshot),
      writer_(place.packed("motion.gz"), scene_of(snapshot, world, times, motion, walls_.follow())),
      before_(world.bodies().size()) {
  add(world);
}

template <int D>
Run_recording<D>::Run_recording(Result_files& place, const Snapshot<D>& snapshot, const Wall_motion& motion,
                                detail::Byte_reader& saved)
    : snapshot_(snapshot),
      every_(1),
      motion_(motion),
      walls_(snapshot),
      writer_(place.packed("motion.gz"), {}, true) {
  saved(every_, walls_, writer_, before_);
  if (every_ == 0) detail::Byte_reader::refuse();
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
    const std::span<const Point<D>> of_body = world.positions(b);
    for (std::uint32_t v = 0; v < of_body.size(); ++v) {
      positions.push_back(in_space(of_body[v]));
      cells.push_back(world.cell_of(b, v));
    }
    const Body_counts now = world.body_counts(b);
    decisions.push_back(decision(before_[b], now));
    before_[b] = now;
  }
  Walls_change change;
  if (motion_.walls_change) change = walls_.follow();
  if (motion_.walls_move)
    for (const std::uint32_t i : walls_.points()) positions.push_back(in_space(snapshot_.point(i)));
  writer_.add({positions, cells, decisions, motion_.walls_change ? &change : nullptr});
}

template <int D>
Wall_motion wall_motion(const Scene<D>& scene) {
  const bool has_cut = std::any_of(scene.changes.list.begin(), scene.changes.list.end(),
                                   [](const auto& change) { return change.kind == Change_kind::cut; });
  const bool is_relaxed = scene.walls && scene.walls->relax;
  return {scene.walls.has_value() || has_cut, !scene.changes.list.empty() || is_relaxed};
}

template <int D>
std::uint32_t motion_interval(const Scene<D>& scene, const Snapshot<D>& snapshot, const World<D>& world,
                              std::uint32_t steps) {
  if (scene.output.motion_every) return *scene.output.motion_every;
  std::uint64_t points =
      world.particles().size() + (wall_motion(scene).walls_move ? snapshot.points().size() : 0);
  for (const Moving_body<D>& moving : world.bodies()) points += moving.body().vertex_count();
  return static_cast<std::uint32_t>(1 + steps * points / most_recorded_points);
}

template class Run_recording<2>;
template class Run_recording<3>;
template Wall_motion wall_motion(const Scene<2>&);
template Wall_motion wall_motion(const Scene<3>&);
template std::uint32_t motion_interval(const Scene<2>&, const Snapshot<2>&, const World<2>&, std::uint32_t);
template std::uint32_t motion_interval(const Scene<3>&, const Snapshot<3>&, const World<3>&, std::uint32_t);

}  // namespace cellwalk::cli
