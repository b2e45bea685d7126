// SPDX-License-Identifier: LGPL-3.0-or-later
// A thin spike through the inside of a swept triangle: its three sides are free, the sweep is not.
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/internal/io/json_file.h>
#include <cellwalk/walk/locate.h>

#include "figures.h"
#include "numbers.h"
#include "space_plot.h"
#include "spike_world.h"

namespace cellwalk::figures {
namespace {

constexpr Point<3> a{3.625, 0.375, 0.625}, b{3.625, 2.75, 0.5}, q{0.25, 1.25, 0.75};  // p moves from a to b
constexpr double edge_radius = 0.022, dash_radius = 0.014;

Space_plot plot_of(const std::string& title, const Snapshot<3>& snapshot, const std::vector<Cell>& cells) {
  Space_plot plot(title, snapshot, cells);
  plot.triangle(a, b, q, colours::swept);
  plot.line(a, q, edge_radius, colours::start);
  plot.dashes(a, b, dash_radius, colours::start);
  plot.dashes(b, q, dash_radius, colours::start);
  for (const Point<3>& x : {a, b, q}) plot.ball(x, 2 * edge_radius, colours::start);
  plot.label(a, "p(0)", -10, -32);
  plot.label(b, "p(1)", 12, 4);
  plot.label(q, "q", -26, 4);
  return plot;
}

}  // namespace

void draw_sweep_3d(const std::filesystem::path& folder) {
  const Environment<3> environment = spike_world({4, 3, 1}, {{0, 0, 0.5, 0.125},
                                                             {1, 1, 0.375, 0.125},
                                                             {2, 1, 0.9375, 0.125},
                                                             {1, 2, 0.75, 0.125},
                                                             {3, 2, 0.25, 0.125},
                                                             {1, 0, 0.75, 0.125}});
  const Snapshot<3>& snapshot = environment.snapshot();
  const Locator<3> locator(snapshot);
  const Particle<3> p = locator.particle_at(a).value(), end = locator.particle_at(q).value();
  Edge_counts counts;
  const Chain_result<3> before = find_chain(snapshot, p, end, counts.walk);
  require(!before.contact, "3D: the edge is free at its start");
  const auto sweep = [&](const Sweep_options& options) {
    return sweep_edge(snapshot, p, b, end, before.chain, options, counts).contact;
  };
  require(!sweep({.sweep = Sweep::three_segments}), "3D: three segments miss the spike");
  const auto exact = sweep({});
  require(exact.has_value(), "3D: the sweep of the triangle finds it");
  require(exact->body == Body_feature::edge && exact->kind == Contact_kind::edge,
          "3D: the edge meets an edge of the spike");
  const Search_options obstacles{.method = Contact_search::exhaustive}, bisection;
  const auto exhaustive = sweep({.search = &obstacles}), dichotomic = sweep({.search = &bisection});
  require(exhaustive && exhaustive->exact_time() == exact->exact_time(),
          "3D: the exhaustive search finds the exact time");
  const double late = bisection.tolerance;
  require(
      dichotomic && dichotomic->exact_time() <= exact->exact_time() && exact->time - dichotomic->time <= late,
      "3D: the dichotomic search is within its tolerance");

  const std::vector<Cell> met = cells_met<3>(snapshot, p.cell, {a, b, q});
  std::vector<Cell> traversed;
  Walk_options options;
  options.visited = &traversed;
  walk(snapshot, p, b, counts.walk, options);
  walk(snapshot, locator.particle_at(b).value(), q, counts.walk, options);

  Space_plot segments = plot_of("Three segments: all of them are free", snapshot, traversed),
             triangle =
                 plot_of("The complete sweep: blocked at s = " + text_of(exact->exact_time()), snapshot, met);
  const Point<3> stop = a + exact->time * (b - a);
  triangle.line(stop, q, edge_radius, colours::contact);
  triangle.contact(*exact);
  triangle.label(stop, "s*", 12, -8);

  const std::vector<drawing::Legend_entry> legend{
      {drawing::Legend_entry::line, colours::start, "the edge at its start"},
      {drawing::Legend_entry::dashes, colours::start, "where it is to go"},
      {drawing::Legend_entry::line, colours::contact, "at the contact; point and normal"},
      {drawing::Legend_entry::patch, colours::swept, "swept triangle"},
      {drawing::Legend_entry::line, colours::cell, "cells looked at"},
      {drawing::Legend_entry::patch, colours::spike, "spikes"}};
  drawing::Figure_options figure;
  figure.panel_width = 660;
  figure.panel_height = 380;
  figure.camera = {{0.75, -0.9, 0.66}, {0, 0, 1}, 24};
  io::write_file(folder / "sweep_3d.png",
                 drawing::encode_png(
                     drawing::make_figure(std::vector{segments.panel(), triangle.panel()}, legend, figure)));
  io::write_json(
      folder / "sweep_3d.json",
      Json{{"motion", {{"p", a}, {"target", b}, {"q", q}}},
           {"three_segments", {{"contact", nullptr}, {"cells", to_json(snapshot, traversed)}}},
           {"triangle", {{"contact", to_json(snapshot, *exact)}, {"cells", to_json(snapshot, met)}}},
           {"exhaustive", {{"contact", to_json(snapshot, *exhaustive)}}},
           {"dichotomic", {{"contact", to_json(snapshot, *dichotomic)}, {"tolerance", late}}}});
}

}  // namespace cellwalk::figures
