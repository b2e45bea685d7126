// SPDX-License-Identifier: LGPL-3.0-or-later
// Lines and marks of all motions, thinned to a limit, and drawn with the walls.
#include "picture.h"

#include <cellwalk/internal/drawing/bodies.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <utility>

namespace cellwalk::cli {
namespace {

using namespace drawing;

// All sizes are shares of the diagonal of the environment's box.
constexpr double trail_size = 0.0008;
// Size of the contacts of bodies and of free particles beside those of the catheter.
constexpr double medium = 0.8, small = 0.55;
constexpr double catheter_size = 0.003;
constexpr double contact_grid = 0.02;  // at most one contact is drawn in a cube of this side
constexpr std::uint32_t trail_steps =
    24;  // points of a free particle's trail; steps whose contacts are shown
constexpr std::size_t most_trail_pieces = 12000;  // shorter trails where there are many particles
constexpr std::size_t most_marks = 50000;         // of each kind, beyond those that would not be drawn
constexpr int spline_pieces = 5;                  // of the catheter, between two vertices

/// The catheter's vertices joined by a smooth line (a Catmull-Rom spline).
template <int D>
std::vector<Point<D>> smooth(const std::vector<Point<D>>& points) {
  if (points.size() < 3) return points;
  const auto at = [&](std::size_t i) { return points[std::min(i, points.size() - 1)]; };
  std::vector<Point<D>> fine{points[0]};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vector<D> d0 = 0.5 * (at(i + 1) - at(i == 0 ? 0 : i - 1)), d1 = 0.5 * (at(i + 2) - at(i));
    for (int k = 1; k <= spline_pieces; ++k) {
      const double t = static_cast<double>(k) / spline_pieces, s = 1 - t;
      fine.push_back((s * s * (1 + 2 * t)) * at(i) + (s * s * t) * d0 + (t * t * (3 - 2 * t)) * at(i + 1) -
                     (t * t * s) * d1);
    }
  }
  return fine;
}

/// Points where no vertex of a catheter waits at the entry.
template <int D>
std::vector<Point<D>> catheter_line(const Rod<D>& rod) {
  std::vector<Point<D>> chain;
  for (const Point<D>& x : rod.body().positions())
    if (chain.empty() || x != chain.back()) chain.push_back(x);
  return chain;
}

/// Calls f with each body that is no catheter, and its number.
template <int D, class F>
void for_each_body(const World<D>& world, F f) {
  for (std::size_t b = 0; b < world.bodies().size(); ++b)
    if (!world.bodies()[b].template as<Rod<D>>()) f(b, world.bodies()[b].body());
}

template <int D>
Body_share share_of(const World<D>& world) {
  std::size_t edges = 0, faces = 0;
  for_each_body(world, [&](std::size_t, const Body<D>& body) {
    edges += body.edges().size();
    faces += body.faces().size();
  });
  return {edges, faces};
}

template <int D>
void draw_bodies(Drawing& drawing, const World<D>& world, const Scene_materials& m, const Body_share& share,
                 double unit, double height) {
  Numbers_drawn numbers;
  for_each_body(world, [&](std::size_t b, const Body<D>& body) {
    draw_body<D>(drawing, body, world.positions(b), m, share, unit, height, numbers);
  });
}

}  // namespace

template <int D>
Run_picture<D>::Run_picture(const Snapshot<D>& snapshot, const World<D>& world, bool walls_move)
    : snapshot_(&snapshot), walls_move_(walls_move) {
  if (world.particles().size() <= most_trail_pieces) trails_.resize(world.particles().size());
  record(world);
}

template <int D>
void Run_picture<D>::record(const World<D>& world) {
  const std::size_t n = std::min(trails_.size(), world.particles().size());
  for (const Run_contact<D>& c : world.contacts())
    if (!c.body && c.particle < n) trails_[c.particle].push_back(c.contact.point);
  const std::size_t most = n == 0 ? 0 : std::min<std::size_t>(trail_steps, most_trail_pieces / n + 1);
  for (std::size_t i = 0; i < n; ++i) {
    auto& trail = trails_[i];
    trail.push_back(world.particles()[i].position);
    if (trail.size() > most) trail.erase(trail.begin(), trail.end() - static_cast<std::ptrdiff_t>(most));
  }
  for (const Run_contact<D>& c : world.contacts()) {
    const bool is_catheter = c.body && world.bodies()[*c.body].template as<Rod<D>>();
    (!c.body       ? particles_
     : is_catheter ? catheter_
                   : bodies_)
        .push_back({c.step, c.contact.point, c.contact.normal});
  }
  const auto is_old = [&](const Mark& c) { return c.step + trail_steps <= world.steps_done(); };
  for (Marks* latest : {&catheter_, &bodies_, &particles_}) {
    if (latest == &catheter_ && !walls_move_) continue;
    latest->erase(latest->begin(), std::find_if_not(latest->begin(), latest->end(), is_old));
    if (latest->size() > most_marks) latest->erase(latest->begin(), latest->end() - most_marks);
  }
  if (catheter_.size() > std::max(most_marks, next_thinning_)) {
    catheter_ = thinned(catheter_);
    next_thinning_ = 2 * catheter_.size();
  }
}

template <int D>
typename Run_picture<D>::Marks Run_picture<D>::thinned(const Marks& marks) const {
  const double grid = contact_grid * diagonal_of(*snapshot_);
  std::set<std::array<std::int64_t, D>> seen;
  Marks result;
  for (const Mark& mark : marks) {
    std::array<std::int64_t, D> cube;
    for (std::size_t i = 0; i < D; ++i) cube[i] = std::llround(mark.point[i] / grid);
    if (seen.insert(cube).second) result.push_back(mark);
  }
  return result;
}

template <int D>
Drawing Run_picture<D>::draw(const World<D>& world, std::string caption) const {
  Drawing drawing;
  const Scene_materials m = add_materials(drawing, D == 2);
  const double unit = diagonal_of(*snapshot_);
  const auto layer = [unit](int i) { return 1e-4 * unit * i; };
  const std::array<Marks, 3> marks{thinned(catheter_), thinned(bodies_), thinned(particles_)};
  const std::array<double, 3> mark_sizes{1, medium, small};

  Round_shapes shapes = lines_of_walls(*snapshot_);
  shapes.balls += world.particles().size();
  for (const Marks& some : marks) shapes.balls += some.size(), shapes.pieces += arrow_pieces * some.size();
  for (const auto& trail : trails_) shapes.pieces += trail.size(), shapes.ends += 2;
  std::vector<Point<D>> catheter;
  if (const Rod<D>* rod = world.catheter()) catheter = catheter_line(*rod);
  shapes.pieces += catheter.size() * spline_pieces;
  Body_share share = share_of(world);
  for_each_body(world, [&](std::size_t, const Body<D>& body) { count_shapes(body, share, shapes); });
  share.bound(shapes, drawing, D == 2);

  draw_walls(drawing, *snapshot_, m.environment, share.shapes, unit);
  drawing.triangles.reserve(drawing.triangles.size() + share.triangles_of_shapes);
  for (std::size_t i = 0; i < world.particles().size(); ++i) {
    if (!is_among(share.shapes, i)) continue;
    if (i < trails_.size() && trails_[i].size() > 1)
      draw_line(drawing, trails_[i], trail_size * unit, layer(3), m.trail);
    draw_dot(drawing, world.particles()[i].position, particle_size * unit, layer(6), m.particle);
  }
  draw_bodies(drawing, world, m, share, unit, layer(4));
  if (!catheter.empty()) {
    const double radius = world.catheter()->body().radius(0);
    const double size =
        radius > 0 ? radius : std::min(catheter_size * unit, 0.3 * world.catheter()->spacing());
    draw_line(drawing, radius > 0 ? catheter : smooth<D>(catheter), size, layer(4), m.catheter);
    draw_dot(drawing, catheter.front(), (radius > 0 ? 1 : 1.6) * size, layer(5), m.catheter);
  }
  for (std::size_t kind = 0; kind < marks.size(); ++kind) {
    const double scale = mark_sizes[kind] * unit;
    for (std::size_t i = 0; i < marks[kind].size(); ++i) {
      if (!is_among(share.shapes, i)) continue;
      const Mark& mark = marks[kind][i];
      draw_contact<D>(drawing, mark.point, mark.normal, scale, layer(7), layer(8), m.contact);
    }
  }
  if (share.shapes < 1) caption += fmt::format(", {:.2g} % of them drawn", 100 * share.shapes);
  drawing.caption = std::move(caption);
  return drawing;
}

template class Run_picture<2>;
template class Run_picture<3>;

}  // namespace cellwalk::cli
