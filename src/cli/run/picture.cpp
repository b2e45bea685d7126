// SPDX-License-Identifier: LGPL-3.0-or-later
#include "picture.h"

#include <cellwalk/internal/drawing/drawing.h>
#include <cellwalk/io/vtu.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <span>

namespace cellwalk::cli {
namespace {

using drawing::Drawing;

// All sizes are shares of the diagonal of the environment's box.
constexpr double particle_size = 0.0032, trail_size = 0.0008, contact_size = 0.0036;
constexpr double arrow_length = 0.028, arrow_size = 0.0012;
// Size of the contacts of bodies and of free particles beside those of the catheter.
constexpr double medium = 0.8, small = 0.55;
constexpr double body_edge_size = 0.0013;
// Edges of bodies are no thicker than this share of their mean length: those of a surface, and others.
constexpr double surface_edge_share = 0.06, edge_share = 0.15;
constexpr std::size_t most_body_edges =
    8000;  // where there are more, only faces are drawn of bodies that have some
constexpr double catheter_size = 0.003, wall_width = 0.005, grid_width = 0.0009;
constexpr double contact_grid = 0.02;  // at most one contact is drawn in a cube of this side
constexpr std::uint32_t trail_steps =
    24;  // points of a free particle's trail; steps whose contacts are shown
constexpr std::size_t most_trail_pieces = 12000;  // shorter trails where there are many particles
constexpr std::size_t most_grid_cells = 4000;  // beyond that inner edges would only darken a planar picture

struct Materials {
  std::uint32_t wall, catheter, particle, trail, contact, free_cell, solid_cell, inner_edge, body, body_face;
};

Materials add_materials(Drawing& d, bool planar) {
  const bool lit = !planar;
  return {d.add_material({{0.80, 0.37, 0.33, planar ? 1 : 0.09}, 0.55, lit}),
          d.add_material({{0.10, 0.27, 0.53}, 0, lit}),
          d.add_material({{0.05, 0.52, 0.50}, 0, lit}),
          d.add_material(
              {planar ? drawing::Colour{0.55, 0.77, 0.76} : drawing::Colour{0.05, 0.52, 0.50, 0.45}, 0, lit}),
          d.add_material({{0.96, 0.58, 0.08}, 0, lit}),
          d.add_material({{0.98, 0.96, 0.94}, 0, lit}),
          d.add_material({{0.70, 0.72, 0.75}, 0, lit}),
          d.add_material({{0.86, 0.84, 0.82}, 0, lit}),
          d.add_material({{0.38, 0.18, 0.58}, 0, lit}),
          d.add_material({{0.60, 0.45, 0.78, 0.55}, 0.2, lit})};
}

template <int D>
double diagonal(const Cell_soup<D>& soup) {
  Point<D> low = soup.points.at(0), high = low;
  for (const Point<D>& p : soup.points)
    for (std::size_t i = 0; i < D; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
  return length(high - low);
}

/// The contacts to show: one in each cube of a coarse grid, the earliest.
template <int D>
std::vector<Run_contact<D>> thinned(const std::vector<Run_contact<D>>& contacts, double grid) {
  std::set<std::array<std::int64_t, D>> seen;
  std::vector<Run_contact<D>> result;
  for (const Run_contact<D>& c : contacts) {
    std::array<std::int64_t, D> cube;
    for (std::size_t i = 0; i < D; ++i) cube[i] = std::llround(c.contact.point[i] / grid);
    if (seen.insert(cube).second) result.push_back(c);
  }
  return result;
}

/// The catheter's vertices joined by a smooth line (a Catmull-Rom spline).
template <int D>
std::vector<Point<D>> smooth(const std::vector<Point<D>>& points) {
  constexpr int pieces = 5;
  if (points.size() < 3) return points;
  const auto at = [&](std::size_t i) { return points[std::min(i, points.size() - 1)]; };
  std::vector<Point<D>> fine{points[0]};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vector<D> d0 = 0.5 * (at(i + 1) - at(i == 0 ? 0 : i - 1)), d1 = 0.5 * (at(i + 2) - at(i));
    for (int k = 1; k <= pieces; ++k) {
      const double t = static_cast<double>(k) / pieces, s = 1 - t;
      fine.push_back((s * s * (1 + 2 * t)) * at(i) + (s * s * t) * d0 + (t * t * (3 - 2 * t)) * at(i + 1) -
                     (t * t * s) * d1);
    }
  }
  return fine;
}

void draw_walls(Drawing& drawing, const Cell_soup<3>& soup, const Materials& m, double) {
  const io::Vtu_grid grid = io::vtu_of_walls(soup);
  std::vector<std::vector<std::uint32_t>> facets;
  for (std::size_t c = 0, begin = 0; c < grid.cell_count();
       begin = static_cast<std::size_t>(grid.offsets[c++]))
    facets.emplace_back(grid.connectivity.begin() + static_cast<std::ptrdiff_t>(begin),
                        grid.connectivity.begin() + static_cast<std::ptrdiff_t>(grid.offsets[c]));
  drawing::add_surface(drawing, grid.points, facets, m.wall);
}

void draw_walls(Drawing& drawing, const Cell_soup<2>& soup, const Materials& m, double unit) {
  std::vector<Point<3>> points;
  for (const Point<2>& p : soup.points) points.push_back(io::in_space(p));
  const double layer = 1e-4 * unit;  // between flat things, for the depth buffer
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    std::vector<std::uint32_t> loop;
    for (std::uint32_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      loop.push_back(soup.facet(f)[0]);
    const std::vector<std::vector<std::uint32_t>> facets{loop};
    drawing::add_surface(drawing, points, facets, soup.solid[c] ? m.solid_cell : m.free_cell);
    if (soup.cell_count() > most_grid_cells) continue;
    for (std::size_t i = 0; i < loop.size(); ++i)
      drawing::add_flat_line(drawing, soup.points[loop[i]], soup.points[loop[(i + 1) % loop.size()]],
                             grid_width * unit, layer, m.inner_edge);
  }
  const io::Vtu_grid grid = io::vtu_of_walls(soup);
  for (std::size_t c = 0; c < grid.cell_count(); ++c) {
    const auto end = [&](std::size_t i) {
      const Point<3>& p = grid.points[static_cast<std::size_t>(grid.connectivity[2 * c + i])];
      return Point<2>{p[0], p[1]};
    };
    drawing::add_flat_line(drawing, end(0), end(1), wall_width * unit, 2 * layer, m.wall);
  }
}

void draw_line(Drawing& drawing, const std::vector<Point<3>>& line, double size, double,
               std::uint32_t material) {
  drawing::add_tube(drawing, line, size, material);
}
void draw_line(Drawing& drawing, const std::vector<Point<2>>& line, double size, double height,
               std::uint32_t material) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    drawing::add_flat_line(drawing, line[i], line[i + 1], 2 * size, height, material);
}
void draw_dot(Drawing& drawing, const Point<3>& p, double size, double, std::uint32_t material) {
  drawing::add_ball(drawing, p, size, material);
}
void draw_dot(Drawing& drawing, const Point<2>& p, double size, double height, std::uint32_t material) {
  drawing::add_disc(drawing, p, size, height, material);
}
void draw_arrow(Drawing& drawing, const Point<3>& p, const Vector<3>& n, double arrow, double size, double,
                std::uint32_t material) {
  drawing::add_arrow(drawing, p, n, arrow, size, material);
}
void draw_arrow(Drawing& drawing, const Point<2>& p, const Vector<2>& n, double arrow, double size,
                double height, std::uint32_t material) {
  drawing::add_flat_arrow(drawing, p, n, arrow, 2 * size, height, material);
}

template <int D>
void draw_bodies(Drawing& drawing, const World<D>& world, const Materials& m, double unit, double height) {
  std::size_t all_edges = 0;
  for (const Moving_body<D>& moving : world.bodies()) all_edges += moving.body().edges().size();
  for (std::size_t b = 0; b < world.bodies().size(); ++b) {
    const Moving_body<D>& moving = world.bodies()[b];
    if (moving.template as<Rod<D>>()) continue;
    const Body<D>& body = moving.body();
    const std::span<const Point<D>> positions = world.positions(b);
    const auto faces = body.faces();
    if (!faces.empty()) {
      std::vector<Point<3>> points;
      for (const Point<D>& x : positions) points.push_back(io::in_space(x));
      std::vector<std::vector<std::uint32_t>> loops;
      for (const auto& face : faces) loops.emplace_back(face.begin(), face.end());
      drawing::add_surface(drawing, points, loops, m.body_face);
      if (all_edges > most_body_edges) continue;
    }
    const double share = faces.empty() ? edge_share : surface_edge_share;
    double sum = 0;
    for (const auto& [u, v] : body.edges()) sum += length(positions[v] - positions[u]);
    const double size =
        body.edges().empty()
            ? particle_size * unit
            : std::min(body_edge_size * unit, share * sum / static_cast<double>(body.edges().size()));
    for (const auto& [u, v] : body.edges())
      draw_line(drawing, std::vector<Point<D>>{positions[u], positions[v]}, size, height, m.body);
    if (body.edges().empty())
      for (const Point<D>& x : positions) draw_dot(drawing, x, size, height, m.body);
  }
}

}  // namespace

template <int D>
Run_picture<D>::Run_picture(const World<D>& world, bool walls_move)
    : walls_move_(walls_move), trails_(world.particles().size()) {
  record(world);
}

template <int D>
void Run_picture<D>::record(const World<D>& world) {
  for (const Run_contact<D>& c : world.contacts())
    if (!c.body) trails_[c.particle].push_back(c.contact.point);
  for (std::size_t i = 0; i < trails_.size(); ++i) {
    auto& trail = trails_[i];
    trail.push_back(world.particles()[i].position);
    if (trail.size() > trail_steps) trail.erase(trail.begin(), trail.end() - trail_steps);
  }
  for (const Run_contact<D>& c : world.contacts()) {
    const bool is_catheter = c.body && world.bodies()[*c.body].template as<Rod<D>>();
    (!c.body ? free_contacts_ : is_catheter ? catheter_contacts_ : body_contacts_).push_back(c);
  }
  const auto old = [&](const Run_contact<D>& c) { return c.step + trail_steps <= world.steps_done(); };
  for (auto* latest : {&catheter_contacts_, &body_contacts_, &free_contacts_}) {
    if (latest == &catheter_contacts_ && !walls_move_) continue;
    latest->erase(latest->begin(), std::find_if_not(latest->begin(), latest->end(), old));
  }
}

template <int D>
Drawing Run_picture<D>::draw(const Cell_soup<D>& soup, const World<D>& world, const Scene<D>& scene,
                             const std::string& caption) const {
  Drawing drawing;
  drawing.caption = caption;
  const Materials m = add_materials(drawing, D == 2);
  const double unit = diagonal(soup);
  const auto layer = [unit](int i) { return 1e-4 * unit * i; };
  draw_walls(drawing, soup, m, unit);

  const std::size_t pieces = most_trail_pieces / std::max<std::size_t>(1, trails_.size());
  for (std::size_t i = 0; i < trails_.size(); ++i) {
    const auto& trail = trails_[i];
    const std::size_t steps = std::min(pieces, trail.size() - 1);
    if (steps > 0)
      draw_line(drawing,
                std::vector<Point<D>>(trail.end() - static_cast<std::ptrdiff_t>(steps + 1), trail.end()),
                trail_size * unit, layer(3), m.trail);
    draw_dot(drawing, world.particles()[i].position, particle_size * unit, layer(6), m.particle);
  }
  draw_bodies(drawing, world, m, unit, layer(4));
  if (const Rod<D>* rod = world.catheter()) {
    std::vector<Point<D>> chain;  // without the vertices that wait at the entry
    for (const Point<D>& x : rod->body().positions())
      if (chain.empty() || x != chain.back()) chain.push_back(x);
    const double size = std::min(catheter_size * unit, 0.3 * scene.catheter->spacing);
    draw_line(drawing, smooth<D>(chain), size, layer(4), m.catheter);
    draw_dot(drawing, chain.front(), 1.6 * size, layer(5), m.catheter);
  }
  const auto draw_contacts = [&](const std::vector<Run_contact<D>>& contacts, double factor) {
    const double scale = factor * unit;
    for (const Run_contact<D>& c : thinned<D>(contacts, contact_grid * unit)) {
      draw_dot(drawing, c.contact.point, contact_size * scale, layer(7), m.contact);
      draw_arrow(drawing, c.contact.point, c.contact.normal, arrow_length * scale, arrow_size * scale,
                 layer(8), m.contact);
    }
  };
  draw_contacts(catheter_contacts_, 1);
  draw_contacts(body_contacts_, medium);
  draw_contacts(free_contacts_, small);
  return drawing;
}

template class Run_picture<2>;
template class Run_picture<3>;

}  // namespace cellwalk::cli
