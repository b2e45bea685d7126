// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies and contacts in a picture.
#include <cellwalk/internal/drawing/bodies.h>
#include <cellwalk/internal/io/vtu.h>
#include <cellwalk/internal/kernel/box.h>

#include <algorithm>

namespace cellwalk::drawing {
namespace {

// Sizes are shares of the diagonal of the environment's box.
constexpr double arrow_length = 0.028, arrow_size = 0.0012, body_edge_size = 0.0013;
// Edges of bodies are no thicker than this share of their mean length: those of a surface, and others.
constexpr double surface_edge_share = 0.06, edge_share = 0.15;
constexpr std::size_t most_body_edges =
    8000;  // where there are more, only faces are drawn of bodies that have some
// Triangles but those of walls; about 270 bytes each while they are drawn.
constexpr std::size_t most_triangles = 750000;

void draw_arrow(Drawing& drawing, const Point<3>& p, const Vector<3>& n, double arrow, double size, double,
                std::uint32_t material) {
  add_arrow(drawing, p, n, arrow, size, material);
}
void draw_arrow(Drawing& drawing, const Point<2>& p, const Vector<2>& n, double arrow, double size,
                double height, std::uint32_t material) {
  add_flat_arrow(drawing, p, n, arrow, 2 * size, height, material);
}

template <int D>
void draw_faces(Drawing& drawing, const Body<D>& body, std::span<const Point<D>> positions, double share,
                std::size_t& number, std::uint32_t material) {
  std::vector<Point<3>> points;
  for (const Point<D>& x : positions) points.push_back(io::in_space(x));
  std::vector<std::vector<std::uint32_t>> loops;
  for (const auto& face : body.faces())
    if (is_among(share, number++)) loops.emplace_back(face.begin(), face.end());
  add_surface(drawing, points, loops, material);
}

}  // namespace

Scene_materials add_materials(Drawing& drawing, bool planar) {
  const bool lit = !planar;
  Scene_materials m;
  m.environment.wall = drawing.add_material({{0.80, 0.37, 0.33, planar ? 1 : 0.09}, 0.55, lit});
  m.catheter = drawing.add_material({{0.10, 0.27, 0.53}, 0, lit});
  m.particle = drawing.add_material({{0.05, 0.52, 0.50}, 0, lit});
  m.trail =
      drawing.add_material({planar ? Colour{0.55, 0.77, 0.76} : Colour{0.05, 0.52, 0.50, 0.45}, 0, lit});
  m.contact = drawing.add_material({{0.96, 0.58, 0.08}, 0, lit});
  m.environment.free_cell = drawing.add_material({{0.98, 0.96, 0.94}, 0, lit});
  m.environment.solid_cell = drawing.add_material({{0.70, 0.72, 0.75}, 0, lit});
  m.environment.inner_edge = drawing.add_material({{0.86, 0.84, 0.82}, 0, lit});
  m.body = drawing.add_material({{0.38, 0.18, 0.58}, 0, lit});
  m.body_face = drawing.add_material({{0.60, 0.45, 0.78, 0.55}, 0.2, lit});
  return m;
}

void draw_line(Drawing& drawing, const std::vector<Point<3>>& line, double size, double,
               std::uint32_t material) {
  add_tube(drawing, line, size, material);
}
void draw_line(Drawing& drawing, const std::vector<Point<2>>& line, double size, double height,
               std::uint32_t material) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    add_flat_line(drawing, line[i], line[i + 1], 2 * size, height, material);
}
void draw_dot(Drawing& drawing, const Point<3>& p, double size, double, std::uint32_t material) {
  add_ball(drawing, p, size, material);
}
void draw_dot(Drawing& drawing, const Point<2>& p, double size, double height, std::uint32_t material) {
  add_disc(drawing, p, size, height, material);
}

template <int D>
void draw_contact(Drawing& drawing, const Point<D>& point, const Vector<D>& normal, double scale,
                  double height, double arrow_height, std::uint32_t material) {
  draw_dot(drawing, point, contact_size * scale, height, material);
  draw_arrow(drawing, point, normal, arrow_length * scale, arrow_size * scale, arrow_height, material);
}

Body_share::Body_share(std::size_t edges, std::size_t of_faces) : edges_of_faces(edges <= most_body_edges) {
  if (of_faces > most_triangles / 2)
    faces = static_cast<double>(most_triangles) / 2 / static_cast<double>(of_faces);
}

void Body_share::bound(const Round_shapes& round, Drawing& drawing, bool flat) {
  drawing.sides = sides_within(round, most_triangles, flat);
  const std::size_t triangles = triangles_of(round, drawing.sides, flat);
  if (triangles > most_triangles)
    shapes = static_cast<double>(most_triangles) / static_cast<double>(triangles);
  triangles_of_shapes = std::min(triangles, most_triangles);
}

template <int D>
void count_shapes(const Body<D>& body, const Body_share& share, Round_shapes& shapes) {
  if (!share.draws_edges_of(body)) return;
  if (body.edges().empty()) shapes.balls += body.vertex_count();
  shapes.pieces += body.edges().size();
  shapes.ends += 2 * body.edges().size();
}

template <int D>
void draw_body(Drawing& drawing, const Body<D>& body, std::span<const Point<D>> positions,
               const Scene_materials& materials, const Body_share& share, double unit, double height,
               Numbers_drawn& numbers) {
  if (!body.faces().empty())
    draw_faces(drawing, body, positions, share.faces, numbers.faces, materials.body_face);
  if (!share.draws_edges_of(body)) return;
  const double edge_size = body.faces().empty() ? edge_share : surface_edge_share;
  double sum = 0;
  for (const auto& [u, v] : body.edges()) sum += length(positions[v] - positions[u]);
  const double size =
      body.edges().empty()
          ? particle_size * unit
          : std::min(body_edge_size * unit, edge_size * sum / static_cast<double>(body.edges().size()));
  for (std::size_t e = 0; e < body.edges().size(); ++e) {
    if (!is_among(share.shapes, numbers.shapes++)) continue;
    const auto& [u, v] = body.edges()[e];
    draw_line(drawing, std::vector<Point<D>>{positions[u], positions[v]},
              body.radius(e) > 0 ? body.radius(e) : size, height, materials.body);
  }
  if (body.edges().empty())
    for (const Point<D>& x : positions)
      if (is_among(share.shapes, numbers.shapes++)) draw_dot(drawing, x, size, height, materials.body);
}

template <int D>
double diagonal_of(const Snapshot<D>& snapshot) {
  detail::Box<D> box;
  for (const Point<D>& p : snapshot.points()) box.extend(p);
  return length(box.high - box.low);
}

#define CELLWALK_INSTANTIATE(D)                                                                           \
  template void draw_contact<D>(Drawing&, const Point<D>&, const Vector<D>&, double, double, double,      \
                                std::uint32_t);                                                           \
  template void count_shapes(const Body<D>&, const Body_share&, Round_shapes&);                           \
  template void draw_body<D>(Drawing&, const Body<D>&, std::span<const Point<D>>, const Scene_materials&, \
                             const Body_share&, double, double, Numbers_drawn&);                          \
  template double diagonal_of(const Snapshot<D>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::drawing
