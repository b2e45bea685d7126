// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's figure 4, and what three segments miss in the plane.
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/drawing/drawing.h>
#include <cellwalk/internal/drawing/figure.h>
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/walk/locate.h>

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "figures.h"
#include "numbers.h"
#include "planar_world.h"

namespace cellwalk::figures {
namespace {

using drawing::Colour;

constexpr int width = 10, height = 6;
constexpr Point<2> a{9.25, 5.25}, b{9.25, 1}, q{0.75, 2};  // p moves from a to b
constexpr double tolerance = 0x1p-5;  // of the dichotomic search: coarse, so that its steps can be seen
constexpr double thin = 0.022, medium = 0.04, thick = 0.085, dot = 0.1;  // units of the environment
constexpr Colour free_space{0.985, 0.985, 0.985}, flooded{0.88, 0.935, 0.985}, solid{0.42, 0.42, 0.44},
    grid{0.74, 0.76, 0.79}, swept{0.95, 0.62, 0.12, 0.45}, edge_colour{0.08, 0.16, 0.42},
    contact_colour{0.80, 0.10, 0.10}, free_step{0.08, 0.58, 0.32}, blocked_step{0.70, 0.46, 0.80};

const Polygon floating{{4.75, 2.5}, {7, 2.375}, {6.5, 3.5}};
const std::vector<Polygon> ceiling{{{2.25, 6}, {3.75, 6}, {2.75, 4}}, {{5.25, 6}, {6.5, 6}, {6, 4.75}}};
const std::vector<Polygon> low_spikes{{{2.5, 0}, {3.5, 0}, {3.25, 1.25}},
                                      {{5.25, 0}, {6.25, 0}, {5.5, 1}},
                                      {{7.25, 0}, {8.25, 0}, {7.5, 0.75}}};
const std::vector<Polygon> high_spikes{
    {{2.5, 0}, {3.5, 0}, {3.25, 2.25}}, {{5.25, 0}, {6.25, 0}, {5.5, 3}}, {{7.25, 0}, {8.25, 0}, {7.5, 2}}};

/// An environment, the edge at its start, and what the sweeps say of it.
struct Case {
  explicit Case(std::vector<Polygon> obstacles)
      : environment([&] {
          obstacles.insert(obstacles.end(), ceiling.begin(), ceiling.end());
          return planar_world(width, height, obstacles);
        }()),
        snapshot(environment.snapshot()) {
    const Locator<2> locator(snapshot);
    p = locator.particle_at(a).value();
    end = locator.particle_at(q).value();
    before = find_chain(snapshot, p, end, counts.walk).chain;
    met = cells_met<2>(snapshot, p.cell, {a, b, q});
    Walk_options options;
    options.visited = &traversed;
    require(!walk(snapshot, p, b, counts.walk, options).contact, "p itself is free");
    walk(snapshot, locator.particle_at(b).value(), q, counts.walk, options);
  }
  Sweep_result<2> sweep(const Sweep_options& options, const Point<2>& target = b) {
    return sweep_edge(snapshot, p, target, end, before, options, counts);
  }
  std::optional<Contact<2>> contact() { return sweep({}).contact; }
  std::optional<Contact<2>> contact(Contact_search method) {
    const Search_options search{.method = method, .tolerance = tolerance};
    return sweep({.search = &search}).contact;
  }

  Environment<2> environment;
  const Snapshot<2>& snapshot;
  Particle<2> p, end;
  Chain before;
  std::vector<Cell> met, traversed;  // by the triangle; by the walks of three segments
  Edge_counts counts;
};

Point<2> p_at(double s) { return a + s * (b - a); }

/// A panel under construction, its materials made when they are needed.
class Plot {
 public:
  Plot(const std::string& title, const Case& c, const std::vector<Cell>& tinted) {
    panel_.title = title;
    const Snapshot<2>& snapshot = c.snapshot;
    for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
      const Cell cell = snapshot.cell(i);
      const Cell_view<2> view = snapshot.view(cell);
      const bool is_tinted = std::find(tinted.begin(), tinted.end(), cell) != tinted.end();
      std::vector<Point<3>> loop;
      for (std::size_t k = 0; k < view.facet_count(); ++k)
        loop.push_back(at(view.point(view.loop(k)[0]), snapshot.is_solid(cell) ? 3 : 0));
      drawing::add_patch(panel_.drawing, loop,
                         material(snapshot.is_solid(cell) ? solid
                                  : is_tinted             ? flooded
                                                          : free_space));
      if (snapshot.is_solid(cell)) continue;
      for (std::size_t k = 0; k < loop.size(); ++k)
        if (!snapshot.is_impassable(Snapshot<2>::half_facet(cell, k)))
          line(loop[k], loop[(k + 1) % loop.size()], 1, thin, grid);
    }
    for (const auto& [from, to] : {std::pair<Point<2>, Point<2>>{{0, 0}, {width, 0}},
                                   {{width, 0}, {width, height}},
                                   {{width, height}, {0, height}},
                                   {{0, height}, {0, 0}}})
      line(at(from, 0), at(to, 0), 4, thick, solid);
    drawing::add_patch(panel_.drawing, std::vector{at(a, 2), at(b, 2), at(q, 2)}, material(swept));
    line(at(a, 0), at(q, 0), 6, thick, edge_colour);
    dashes(a, b, medium, edge_colour);
    dashes(b, q, 0.7 * thick, edge_colour);
    for (const Point<2>& x : {a, b, q})
      drawing::add_disc(panel_.drawing, x, dot, layer(8), material(edge_colour));
    label(a, "p(0)", -16, 18);
    label(b, "p(1)", -16, -30);
    label(q, "q", -26, -6);
  }

  void line(const Point<3>& from, const Point<3>& to, int z, double size, const Colour& colour) {
    drawing::add_flat_line(panel_.drawing, {from[0], from[1]}, {to[0], to[1]}, size, layer(z),
                           material(colour));
  }
  void edge(double s, double size, const Colour& colour) { line(at(p_at(s), 0), at(q, 0), 5, size, colour); }
  void dashes(const Point<2>& from, const Point<2>& to, double size, const Colour& colour) {
    drawing::add_dashes(panel_.drawing, at(from, 5), at(to, 5), size / 2, 0.15, true, material(colour));
  }
  void spot(const Point<2>& x, double size, const Colour& colour) {
    drawing::add_disc(panel_.drawing, x, size, layer(9), material(colour));
  }
  void contact(const Contact<2>& c, const std::string& time) {
    edge(c.time, thick, contact_colour);
    spot(c.point, 1.2 * dot, contact_colour);
    drawing::add_flat_arrow(panel_.drawing, c.point, c.normal, 0.9, 0.8 * thick, layer(10),
                            material(contact_colour));
    label(p_at(c.time), time, 14, -6);
  }
  void label(const Point<2>& x, const std::string& text, double right, double up) {
    panel_.labels.push_back({at(x, 0), text, right, up});
  }
  const drawing::Panel& panel() const { return panel_; }

 private:
  static double layer(int z) { return 1e-3 * z; }
  static Point<3> at(const Point<2>& x, int z) { return {x[0], x[1], layer(z)}; }
  std::uint32_t material(const Colour& c) { return panel_.drawing.add_material({c, 0, false}); }

  drawing::Panel panel_;
};

/// When the edge passes an obstacle's vertex: where the orientation of p(s), q and the vertex is 0.
Exact_time time_of(const Point<2>& vertex) {
  const Ring first = Exact_value::orientation(a, q, vertex), last = Exact_value::orientation(b, q, vertex);
  return to_time(Fraction(first, first - last));
}

/// The vertices of walls of the cells met that lie in the swept triangle, by their times.
std::map<Exact_time, Point<2>> vertices_inside(const Case& c) {
  std::map<Exact_time, Point<2>> result;
  for (const Cell cell : c.met)
    for (std::size_t i = 0; i < c.snapshot.facet_count(cell); ++i) {
      const Half_facet f = Snapshot<2>::half_facet(cell, i);
      if (!c.snapshot.is_impassable(f)) continue;
      for (const std::uint32_t v : c.snapshot.loop(f)) {
        const Point<2>& x = c.snapshot.point(v);
        const auto side = [&](const Point<2>& from, const Point<2>& to, const Point<2>& third) {
          return CGAL::sign(Exact_value::orientation(from, to, x)) *
                     CGAL::sign(Exact_value::orientation(from, to, third)) >=
                 0;
        };
        if (side(a, b, q) && side(b, q, a) && side(q, a, b)) result.emplace(time_of(x), x);
      }
    }
  return result;
}

drawing::Panel draw_three_segments(Case& c, Json& json) {
  Sweep_options options;
  options.sweep = Sweep::three_segments;
  const auto contact = c.sweep(options).contact;
  require(!contact, "2D: three segments miss an obstacle inside the triangle");
  json["three_segments"] = {{"contact", nullptr}, {"cells", to_json(c.snapshot, c.traversed)}};
  Plot plot("1. Three segments: all of them are free", c, c.traversed);
  return plot.panel();
}

drawing::Panel draw_triangle(Case& c, Json& json) {
  const auto contact = c.contact();
  require(contact.has_value(), "2D: the sweep of the triangle finds it");
  require(contact->exact_time() == time_of(floating[2]), "2D: at the time of its vertex");
  json["triangle"] = {{"contact", to_json(c.snapshot, *contact)}, {"cells", to_json(c.snapshot, c.met)}};
  Plot plot("2. The complete sweep: blocked at s = " + text_of(contact->exact_time()), c, c.met);
  plot.contact(*contact, "s*");
  return plot.panel();
}

drawing::Panel draw_exhaustive(Case& c, Json& json) {
  const auto exact = c.contact(), found = c.contact(Contact_search::exhaustive);
  require(exact && found && exact->exact_time() == found->exact_time(),
          "2D: the exhaustive search finds the exact time");
  const auto vertices = vertices_inside(c);
  require(vertices.size() == high_spikes.size(), "2D: one vertex of each spike in the triangle");
  require(vertices.begin()->first == found->exact_time(), "2D: the first of these vertices is the contact");
  Plot plot("3. Exact, and exhaustive: s = " + text_of(found->exact_time()), c, c.met);
  Json candidates = Json::array();
  for (const auto& [time, vertex] : vertices) {
    candidates.push_back({{"vertex", vertex}, {"time", to_json(time)}});
    if (time != found->exact_time()) {
      plot.edge(time.rounded(), medium, blocked_step);
      plot.spot(vertex, 0.8 * dot, blocked_step);
      plot.label(p_at(time.rounded()), fmt::format("{:.2f}", time.rounded()), 14, -6);
    }
  }
  plot.contact(*found, fmt::format("{:.2f}", found->time));
  json["exact"] = to_json(c.snapshot, *exact);
  json["exhaustive"] = {{"contact", to_json(c.snapshot, *found)},
                        {"candidates", candidates},
                        {"cells", to_json(c.snapshot, c.met)}};
  return plot.panel();
}

drawing::Panel draw_dichotomic(Case& c, Json& json) {
  const auto exact = c.contact(), found = c.contact(Contact_search::dichotomic);
  require(found && found->exact_time() <= exact->exact_time(), "2D: the dichotomic search is never late");
  Plot plot(fmt::format("4. Dichotomic, to 1/{:.0f}: free until s = {}", 1 / tolerance,
                        text_of(found->exact_time())),
            c, c.met);
  Json steps = Json::array();
  double low = 0, high = 1;
  while (high - low > tolerance) {
    // Exact: the ends have few binary digits. So this is the part of the motion that the search itself looks
    // at.
    const double middle = low + (high - low) / 2;
    const bool is_free = !c.sweep({}, p_at(middle)).contact;
    steps.push_back({{"time", to_json(Exact_time(middle))}, {"free", is_free}});
    plot.edge(middle, medium, is_free ? free_step : blocked_step);
    if (high - low >= 0.25)
      plot.label(p_at(middle), text_of(Exact_time(middle)) + (is_free ? " +" : " -"), 14, -6);
    (is_free ? low : high) = middle;
  }
  require(low == found->time, "2D: the dichotomic search ends where its bisection does");
  plot.contact(*found, "");
  json["dichotomic"] = {{"contact", to_json(c.snapshot, *found)}, {"tolerance", tolerance}, {"steps", steps}};
  return plot.panel();
}

}  // namespace

void draw_sweep_2d(const std::filesystem::path& folder) {
  std::vector<Polygon> with_floating = low_spikes;
  with_floating.push_back(floating);
  Case between(with_floating), spikes(high_spikes);
  Sweep_options paper;
  paper.sweep = Sweep::three_segments;
  const auto by_segments = spikes.sweep(paper).contact, by_triangle = spikes.contact();
  require(by_segments && by_triangle && by_segments->exact_time() == by_triangle->exact_time(),
          "2D: three segments find spikes that cross the third one");

  const Json motion{{"p", a}, {"target", b}, {"q", q}};
  Json json{{"motion", motion}, {"floating", Json::object()}, {"spikes", Json::object()}};
  std::vector<drawing::Panel> panels;
  panels.push_back(draw_three_segments(between, json["floating"]));
  panels.push_back(draw_triangle(between, json["floating"]));
  panels.push_back(draw_exhaustive(spikes, json["spikes"]));
  panels.push_back(draw_dichotomic(spikes, json["spikes"]));
  json["spikes"]["three_segments"] = {{"contact", to_json(spikes.snapshot, *by_segments)}};

  const std::vector<drawing::Legend_entry> legend{
      {drawing::Legend_entry::line, edge_colour, "the edge at its start"},
      {drawing::Legend_entry::dashes, edge_colour, "where it is to go"},
      {drawing::Legend_entry::line, contact_colour, "at the contact; point and normal"},
      {drawing::Legend_entry::patch, swept, "swept triangle"},
      {drawing::Legend_entry::patch, flooded, "cells looked at"},
      {drawing::Legend_entry::patch, solid, "obstacles"},
      {drawing::Legend_entry::line, free_step, "bisection: free until here (+)"},
      {drawing::Legend_entry::line, blocked_step, "blocked (-); vertices met later"}};
  drawing::Figure_options options;
  options.camera = {{0, 0, 1}, {0, 1, 0}, 0};
  options.panel_width = 600;
  options.panel_height = 360;
  const drawing::Image figure = drawing::make_figure(panels, legend, options);
  io::write_file(folder / "sweep_2d.png", drawing::encode_png(figure));
  io::write_json(folder / "sweep_2d.json", json);
}

}  // namespace cellwalk::figures
