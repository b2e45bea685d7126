// SPDX-License-Identifier: LGPL-3.0-or-later
#include "picture.h"

#include <cellwalk/internal/drawing/drawing.h>
#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/io/vtu.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include "picture_walls.h"

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
constexpr double catheter_size = 0.003;
constexpr double contact_grid = 0.02;  // at most one contact is drawn in a cube of this side
constexpr std::uint32_t trail_steps =
    24;  // points of a free particle's trail; steps whose contacts are shown
constexpr std::size_t most_trail_pieces = 12000;  // shorter trails where there are many particles
constexpr std::size_t most_marks = 50000;         // of each kind, beyond those that would not be drawn
// Triangles but those of walls; about 270 bytes each while they are drawn.
constexpr std::size_t most_triangles = 750000;
constexpr int spline_pieces = 5;         // of the catheter, between two vertices
constexpr std::size_t arrow_pieces = 3;  // of a tube, with as many triangles as an arrow

struct Materials {
  Wall_materials environment;
  std::uint32_t catheter, particle, trail, contact, body, body_face;
};

Materials add_materials(Drawing& d, bool planar) {
  const bool lit = !planar;
  Materials m;
  m.environment.wall = d.add_material({{0.80, 0.37, 0.33, planar ? 1 : 0.09}, 0.55, lit});
  m.catheter = d.add_material({{0.10, 0.27, 0.53}, 0, lit});
  m.particle = d.add_material({{0.05, 0.52, 0.50}, 0, lit});
  m.trail = d.add_material(
      {planar ? drawing::Colour{0.55, 0.77, 0.76} : drawing::Colour{0.05, 0.52, 0.50, 0.45}, 0, lit});
  m.contact = d.add_material({{0.96, 0.58, 0.08}, 0, lit});
  m.environment.free_cell = d.add_material({{0.98, 0.96, 0.94}, 0, lit});
  m.environment.solid_cell = d.add_material({{0.70, 0.72, 0.75}, 0, lit});
  m.environment.inner_edge = d.add_material({{0.86, 0.84, 0.82}, 0, lit});
  m.body = d.add_material({{0.38, 0.18, 0.58}, 0, lit});
  m.body_face = d.add_material({{0.60, 0.45, 0.78, 0.55}, 0.2, lit});
  return m;
}

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

/// Points where no vertex of a catheter waits at the entry.
template <int D>
std::vector<Point<D>> catheter_line(const Rod<D>& rod) {
  std::vector<Point<D>> chain;
  for (const Point<D>& x : rod.body().positions())
    if (chain.empty() || x != chain.back()) chain.push_back(x);
  return chain;
}

/// How much of the bodies is drawn.
struct Share {
  double faces = 1, shapes = 1;
  bool edges_of_faces = true;  ///< draws the edges of bodies that have faces
};

template <int D>
bool has_edges_drawn(const Body<D>& body, const Share& share) {
  return body.faces().empty() || share.edges_of_faces;
}

/// Calls f with each body that is no catheter, and its number.
template <int D, class F>
void for_each_body(const World<D>& world, F f) {
  for (std::size_t b = 0; b < world.bodies().size(); ++b)
    if (!world.bodies()[b].template as<Rod<D>>()) f(b, world.bodies()[b].body());
}

/// Adds the bodies' share of shapes.
template <int D>
void count_bodies(const World<D>& world, const Share& share, drawing::Round_shapes& shapes) {
  for_each_body(world, [&](std::size_t, const Body<D>& body) {
    if (!has_edges_drawn(body, share)) return;
    if (body.edges().empty()) shapes.balls += body.vertex_count();
    shapes.pieces += body.edges().size();
    shapes.ends += 2 * body.edges().size();
  });
}

template <int D>
Share share_of_faces(const World<D>& world) {
  std::size_t edges = 0, faces = 0;
  for_each_body(world, [&](std::size_t, const Body<D>& body) {
    edges += body.edges().size();
    faces += body.faces().size();
  });
  Share share;
  share.edges_of_faces = edges <= most_body_edges;
  if (faces > most_triangles / 2)
    share.faces = static_cast<double>(most_triangles) / 2 / static_cast<double>(faces);
  return share;
}

template <int D>
void draw_faces(Drawing& drawing, const Body<D>& body, std::span<const Point<D>> positions, double share,
                std::size_t& number, std::uint32_t material) {
  std::vector<Point<3>> points;
  for (const Point<D>& x : positions) points.push_back(io::in_space(x));
  std::vector<std::vector<std::uint32_t>> loops;
  for (const auto& face : body.faces())
    if (is_among(share, number++)) loops.emplace_back(face.begin(), face.end());
  drawing::add_surface(drawing, points, loops, material);
}

template <int D>
void draw_bodies(Drawing& drawing, const World<D>& world, const Materials& m, const Share& share, double unit,
                 double height) {
  std::size_t face = 0, shape = 0;  // numbers
  for_each_body(world, [&](std::size_t b, const Body<D>& body) {
    const std::span<const Point<D>> positions = world.positions(b);
    if (!body.faces().empty()) draw_faces(drawing, body, positions, share.faces, face, m.body_face);
    if (!has_edges_drawn(body, share)) return;
    const double edge_size = body.faces().empty() ? edge_share : surface_edge_share;
    double sum = 0;
    for (const auto& [u, v] : body.edges()) sum += length(positions[v] - positions[u]);
    const double size =
        body.edges().empty()
            ? particle_size * unit
            : std::min(body_edge_size * unit, edge_size * sum / static_cast<double>(body.edges().size()));
    for (const auto& [u, v] : body.edges())
      if (is_among(share.shapes, shape++))
        draw_line(drawing, std::vector<Point<D>>{positions[u], positions[v]}, size, height, m.body);
    if (body.edges().empty())
      for (const Point<D>& x : positions)
        if (is_among(share.shapes, shape++)) draw_dot(drawing, x, size, height, m.body);
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
double Run_picture<D>::diagonal() const {
  detail::Box<D> box;
  for (const Point<D>& p : snapshot_->points()) box.extend(p);
  return length(box.high - box.low);
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
  const double grid = contact_grid * diagonal();
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
Drawing Run_picture<D>::draw(const World<D>& world, const Scene<D>& scene, std::string caption) const {
  Drawing drawing;
  const Materials m = add_materials(drawing, D == 2);
  const double unit = diagonal();
  const auto layer = [unit](int i) { return 1e-4 * unit * i; };
  const std::array<Marks, 3> marks{thinned(catheter_), thinned(bodies_), thinned(particles_)};
  const std::array<double, 3> mark_sizes{1, medium, small};

  drawing::Round_shapes shapes = lines_of_walls(*snapshot_);
  shapes.balls += world.particles().size();
  for (const Marks& some : marks) shapes.balls += some.size(), shapes.pieces += arrow_pieces * some.size();
  for (const auto& trail : trails_) shapes.pieces += trail.size(), shapes.ends += 2;
  std::vector<Point<D>> catheter;
  if (const Rod<D>* rod = world.catheter()) catheter = catheter_line(*rod);
  shapes.pieces += catheter.size() * spline_pieces;
  Share share = share_of_faces(world);
  count_bodies(world, share, shapes);
  drawing.sides = drawing::sides_within(shapes, most_triangles, D == 2);
  const std::size_t triangles = drawing::triangles_of(shapes, drawing.sides, D == 2);
  if (triangles > most_triangles)
    share.shapes = static_cast<double>(most_triangles) / static_cast<double>(triangles);

  draw_walls(drawing, *snapshot_, m.environment, share.shapes, unit);
  drawing.triangles.reserve(drawing.triangles.size() + std::min(triangles, most_triangles));
  for (std::size_t i = 0; i < world.particles().size(); ++i) {
    if (!is_among(share.shapes, i)) continue;
    if (i < trails_.size() && trails_[i].size() > 1)
      draw_line(drawing, trails_[i], trail_size * unit, layer(3), m.trail);
    draw_dot(drawing, world.particles()[i].position, particle_size * unit, layer(6), m.particle);
  }
  draw_bodies(drawing, world, m, share, unit, layer(4));
  if (!catheter.empty()) {
    const double size = std::min(catheter_size * unit, 0.3 * scene.catheter->spacing);
    draw_line(drawing, smooth<D>(catheter), size, layer(4), m.catheter);
    draw_dot(drawing, catheter.front(), 1.6 * size, layer(5), m.catheter);
  }
  for (std::size_t kind = 0; kind < marks.size(); ++kind) {
    const double scale = mark_sizes[kind] * unit;
    for (std::size_t i = 0; i < marks[kind].size(); ++i) {
      if (!is_among(share.shapes, i)) continue;
      const Mark& mark = marks[kind][i];
      draw_dot(drawing, mark.point, contact_size * scale, layer(7), m.contact);
      draw_arrow(drawing, mark.point, mark.normal, arrow_length * scale, arrow_size * scale, layer(8),
                 m.contact);
    }
  }
  if (share.shapes < 1) caption += fmt::format(", {:.2g} % of them drawn", 100 * share.shapes);
  drawing.caption = std::move(caption);
  return drawing;
}

template class Run_picture<2>;
template class Run_picture<3>;

}  // namespace cellwalk::cli
