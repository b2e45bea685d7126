// SPDX-License-Identifier: LGPL-3.0-or-later
// Particles, bodies and contacts as cells with velocities and normals.
#include "grids.h"

#include <numeric>
#include <utility>

namespace cellwalk::cli {
namespace {

using io::in_space;
using Integers = std::vector<std::int64_t>;

template <int D>
void append_vector(std::vector<double>& values, const std::array<double, D>& v) {
  const Point<3> p = in_space(v);
  values.insert(values.end(), p.begin(), p.end());
}

}  // namespace

template <int D>
io::Vtu_grid particles_grid(const World<D>& world, const std::vector<Run_contact<D>>& contacts) {
  io::Vtu_grid grid;
  const auto particles = world.particles();
  std::vector<double> velocity;
  Integers number(particles.size()), met(particles.size(), 0);
  std::iota(number.begin(), number.end(), 0);
  for (const Run_contact<D>& c : contacts)
    if (!c.body) ++met[c.particle];
  for (std::uint32_t i = 0; i < particles.size(); ++i) {
    grid.points.push_back(in_space(particles[i].position));
    append_vector<D>(velocity, world.velocities()[i]);
    const std::uint32_t vertex[] = {i};
    grid.add_cell(io::Vtu_cell::vertex, vertex);
  }
  grid.point_data.push_back({"particle", 1, std::move(number)});
  grid.point_data.push_back({"contacts", 1, std::move(met)});
  grid.point_data.push_back({"velocity", 3, std::move(velocity)});
  return grid;
}

template <int D>
io::Vtu_grid bodies_grid(const World<D>& world, const std::vector<Run_contact<D>>& contacts,
                         const std::vector<Point<D>>& before, double time_step) {
  io::Vtu_grid grid;
  Integers body_of_point, vertex_of_point, body, feature, number;
  std::vector<double> velocity, radius;
  bool has_radii = false;
  std::vector<std::array<std::size_t, 3>> begin;  // cells of each body: its vertices, edges, faces
  for (std::size_t b = 0; b < world.bodies().size(); ++b) {
    const Moving_body<D>& moving = world.bodies()[b];
    const auto first = static_cast<std::uint32_t>(grid.points.size());
    const auto add = [&, i = static_cast<std::int64_t>(b)](io::Vtu_cell type, Body_feature of, std::size_t at,
                                                           auto vertices) {
      for (std::uint32_t& v : vertices) v += first;
      grid.add_cell(type, vertices);
      body.push_back(i);
      feature.push_back(static_cast<std::int64_t>(of));
      number.push_back(static_cast<std::int64_t>(at));
      radius.push_back(of == Body_feature::edge ? moving.body().radius(at) : 0);
      has_radii |= radius.back() > 0;
    };
    for (const Point<D>& x : world.positions(b)) {
      const std::size_t point = grid.points.size();
      grid.points.push_back(in_space(x));
      body_of_point.push_back(static_cast<std::int64_t>(b));
      vertex_of_point.push_back(static_cast<std::int64_t>(point - first));
      append_vector<D>(velocity, before.empty() ? moving.velocity() : (1 / time_step) * (x - before[point]));
    }
    const auto edges = moving.body().edges();
    const auto faces = moving.body().faces();
    const std::size_t vertices = moving.body().vertex_count(), cells = grid.cell_count();
    begin.push_back({cells, cells + vertices, cells + vertices + edges.size()});
    for (std::uint32_t v = 0; v < vertices; ++v)
      add(io::Vtu_cell::vertex, Body_feature::vertex, v, std::array{v});
    for (std::size_t e = 0; e < edges.size(); ++e) add(io::Vtu_cell::line, Body_feature::edge, e, edges[e]);
    for (std::size_t f = 0; f < faces.size(); ++f)
      add(io::Vtu_cell::triangle, Body_feature::face, f, faces[f]);
  }
  Integers met(grid.cell_count(), 0);
  for (const Run_contact<D>& c : contacts)
    if (c.body) ++met[begin[*c.body][static_cast<std::size_t>(c.contact.body)] + c.contact.feature];
  grid.point_data.push_back({"body", 1, std::move(body_of_point)});
  grid.point_data.push_back({"vertex", 1, std::move(vertex_of_point)});
  grid.point_data.push_back({"velocity", 3, std::move(velocity)});
  grid.cell_data.push_back({"body", 1, std::move(body)});
  grid.cell_data.push_back({"feature", 1, std::move(feature)});
  grid.cell_data.push_back({"number", 1, std::move(number)});
  grid.cell_data.push_back({"contacts", 1, std::move(met)});
  if (has_radii) grid.cell_data.push_back({"radius", 1, std::move(radius)});
  return grid;
}

template <int D>
io::Vtu_grid contacts_grid(const std::vector<Run_contact<D>>& contacts) {
  constexpr std::int64_t none = -1;
  io::Vtu_grid grid;
  Integers step, particle, kind, body, vertex, feature, number;
  std::vector<double> normal;
  for (const Run_contact<D>& c : contacts) {
    const std::uint32_t point[] = {static_cast<std::uint32_t>(grid.points.size())};
    grid.points.push_back(in_space(c.contact.point));
    grid.add_cell(io::Vtu_cell::vertex, point);
    step.push_back(c.step);
    particle.push_back(c.body ? none : c.particle);
    kind.push_back(static_cast<std::int64_t>(c.contact.kind));
    body.push_back(c.body ? *c.body : none);
    vertex.push_back(c.body ? c.contact.vertex : none);
    feature.push_back(c.body ? static_cast<std::int64_t>(c.contact.body) : none);
    number.push_back(c.body ? c.contact.feature : none);
    append_vector<D>(normal, c.contact.normal);
  }
  grid.point_data.push_back({"step", 1, std::move(step)});
  grid.point_data.push_back({"particle", 1, std::move(particle)});
  grid.point_data.push_back({"kind", 1, std::move(kind)});
  grid.point_data.push_back({"body", 1, std::move(body)});
  grid.point_data.push_back({"vertex", 1, std::move(vertex)});
  grid.point_data.push_back({"feature", 1, std::move(feature)});
  grid.point_data.push_back({"number", 1, std::move(number)});
  grid.point_data.push_back({"normal", 3, std::move(normal)});
  return grid;
}

template <int D>
std::vector<Point<D>> body_positions(const World<D>& world) {
  std::vector<Point<D>> positions;
  for (std::size_t b = 0; b < world.bodies().size(); ++b) {
    const auto of_body = world.positions(b);
    positions.insert(positions.end(), of_body.begin(), of_body.end());
  }
  return positions;
}

#define CELLWALK_INSTANTIATE(D)                                                              \
  template io::Vtu_grid particles_grid(const World<D>&, const std::vector<Run_contact<D>>&); \
  template io::Vtu_grid bodies_grid(const World<D>&, const std::vector<Run_contact<D>>&,     \
                                    const std::vector<Point<D>>&, double);                   \
  template io::Vtu_grid contacts_grid(const std::vector<Run_contact<D>>&);                   \
  template std::vector<Point<D>> body_positions(const World<D>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::cli
