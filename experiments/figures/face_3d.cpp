// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's figure 6: a spike comes through a face, and none of the edges meets it.
#include <cellwalk/internal/edge/face.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/edge/triangle.h>
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/walk/locate.h>

#include "figures.h"
#include "numbers.h"
#include "space_plot.h"
#include "spike_world.h"

namespace cellwalk::figures {
namespace {

constexpr Point<3> a{3.5, 1.5, 1.5}, b{3.5, 1.5, 0.5};  // p moves from a to b
constexpr Point<3> q{0.5, 0.25, 1.125}, r{0.5, 2.75, 1.125};
constexpr std::uint32_t spike_x = 2, spike_y = 1;
constexpr double spike_height = 0.875;
constexpr Point<3> tip{spike_x + 0.5, spike_y + 0.5, spike_height};
constexpr double edge_radius = 0.022, dash_radius = 0.014;
constexpr drawing::Colour face_colour{0.30, 0.45, 0.80, 0.55}, blocked_face{0.85, 0.35, 0.30, 0.60},
    swept_by_edges{0.98, 0.75, 0.25, 0.38};

/// Sweeps of the edges from p, then of the face.
struct Move {
  Move(const Snapshot<3>& snapshot, const Point<3>& target) {
    const Locator<3> locator(snapshot);
    const Particle<3> from = locator.particle_at(a).value(), at_q = locator.particle_at(q).value(),
                      at_r = locator.particle_at(r).value();
    Edge_counts counts;
    const Chain pq = find_chain(snapshot, from, at_q, counts.walk).chain,
                pr = find_chain(snapshot, from, at_r, counts.walk).chain,
                qr = find_chain(snapshot, at_q, at_r, counts.walk).chain;
    Face_counts face_counts;
    const Face_registration start =
        register_face(snapshot, from, at_q, at_r, {{&pq}, {&qr}, {&pr, true}}, face_counts);
    require(start.piercing == Half_facet::none, "face: free at its start");
    std::vector<Cell> visited;
    std::vector<Half_facet> crossed;
    Particle<3> to = from;
    is_vertex_free = !move(snapshot, to, target, counts.walk, {&visited, &crossed}).contact;
    require(is_vertex_free, "face: p itself is free");
    const Vertex_path<3> path{from, to, visited, crossed};
    const Sweep_result<3> to_q = sweep_triangle<3>(snapshot, path, at_q, pq, counts),
                          to_r = sweep_triangle<3>(snapshot, path, at_r, pr, counts);
    are_edges_free = !to_q.contact && !to_r.contact;
    require(are_edges_free, "face: the sweeps of its edges are free");
    face = sweep_face(snapshot, path, at_q, at_r, start.supporting_walls,
                      {{&to_q.chain}, {&qr}, {&to_r.chain, true}}, face_counts);
  }
  bool is_vertex_free = false, are_edges_free = false;
  Face_result face;
};

Space_plot plot_of(const std::string& title, const Snapshot<3>& snapshot) {
  Space_plot plot(title, snapshot, {});
  for (const Point<3>& x : {q, r}) plot.dashes(b, x, dash_radius, colours::start);
  plot.dashes(a, b, dash_radius, colours::start);
  plot.ball(b, 1.5 * edge_radius, colours::start);
  plot.label(b, "p(1)", 12, -14);
  return plot;
}

void add_face(Space_plot& plot, const Point<3>& p, const drawing::Colour& inside,
              const drawing::Colour& edges) {
  plot.triangle(p, q, r, inside);
  const std::array<Point<3>, 3> corners{p, q, r};
  for (std::size_t i = 0; i < 3; ++i) {
    plot.line(corners[i], corners[(i + 1) % 3], edge_radius, edges);
    plot.ball(corners[i], 2 * edge_radius, edges);
  }
  plot.label(q, "q", -10, -30);
  plot.label(r, "r", -24, 6);
}

}  // namespace

void draw_face_3d(const std::filesystem::path& folder) {
  const Environment<3> environment = spike_world({4, 3, 2}, {{spike_x, spike_y, spike_height, 0.1875},
                                                             {1, 0, 0.5, 0.125},
                                                             {1, 2, 0.5, 0.125},
                                                             {0, 1, 0.625, 0.125},
                                                             {3, 0, 0.625, 0.125}});
  const Snapshot<3>& snapshot = environment.snapshot();
  const Move move(snapshot, b);
  require(move.face.contact.has_value(), "face: its own sweep finds the spike");
  const Contact<3>& contact = *move.face.contact;
  require(contact.body == Body_feature::face && contact.kind == Contact_kind::vertex && contact.point == tip,
          "face: it is met by the tip");
  const Point<3> stop = a + contact.time * (b - a);
  require(!Move(snapshot, a + (contact.time * 0.5) * (b - a)).face.contact,
          "face: free half-way to the contact");

  Space_plot before = plot_of("Before: p is to go from p(0) to p(1)", snapshot),
             after = plot_of("At contact: s = " + text_of(contact.exact_time()) + "; all edges sweep free",
                             snapshot);
  for (const Point<3>& x : {q, r}) before.triangle(a, b, x, swept_by_edges);
  add_face(before, a, face_colour, colours::start);
  before.label(a, "p(0)", 12, 4);
  add_face(after, stop, blocked_face, colours::contact);
  after.ball(a, 1.5 * edge_radius, colours::start);
  after.label(a, "p(0)", 12, 4);
  after.label(stop, "p(s*)", 12, -8);
  after.contact(contact);

  const std::vector<drawing::Legend_entry> legend{
      {drawing::Legend_entry::patch, face_colour, "the face at its start"},
      {drawing::Legend_entry::patch, blocked_face, "at the contact; point and normal"},
      {drawing::Legend_entry::dashes, colours::start, "where its edges are to go"},
      {drawing::Legend_entry::patch, swept_by_edges, "swept by its edges: no wall"},
      {drawing::Legend_entry::patch, colours::spike, "spikes"}};
  drawing::Figure_options figure;
  figure.panel_width = 660;
  figure.panel_height = 420;
  figure.camera = {{0.7, -1, 0.38}, {0, 0, 1}, 24};
  io::write_file(folder / "face_3d.png", drawing::encode_png(drawing::make_figure(
                                             std::vector{before.panel(), after.panel()}, legend, figure)));
  io::write_json(folder / "face_3d.json",
                 Json{{"motion", {{"p", a}, {"target", b}, {"q", q}, {"r", r}}},
                      {"vertex_is_free", move.is_vertex_free},
                      {"edges_are_free", move.are_edges_free},
                      {"spike", {{"tip", tip}}},
                      {"face",
                       {{"contact", to_json(snapshot, static_cast<const Contact<3>&>(contact))},
                        {"p_at_contact", stop}}}});
}

}  // namespace cellwalk::figures
