// SPDX-License-Identifier: LGPL-3.0-or-later
// The cells, planes and vertices of a walk in 2D, chosen for display.
#include "picture.h"

#include <cellwalk/edge/chain.h>
#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/walk/strategy.h>

#include <algorithm>

#include "picture_motion.h"
#include "picture_plot.h"

namespace cellwalk::cli {
namespace {

using namespace query_colours;
using drawing::Legend_entry;

constexpr double thin = 1, usual = 1.6, thick = 2.6, heavy = 3.4, widest = 5.5;

/// A walk with the data that a picture shows of it.
struct Shown_walk {
  Walk_result<2> result;
  std::vector<Cell> visited;
  std::vector<Half_facet> crossed;

  std::set<Cell> cells() const { return {visited.begin(), visited.end()}; }
};

/// The paper's walk, which reports the facets at which it aims; all exact walks visit the same cells.
Shown_walk shown_walk(const Snapshot<2>& snapshot, const Particle<2>& particle, const Point<2>& to) {
  Shown_walk walk;
  Walk_counts counts;
  walk.result = cellwalk::walk(snapshot, particle, to, counts, Walk_strategy::predictive_simplex,
                               {&walk.visited, &walk.crossed});
  return walk;
}

/// The walk of an answer, among those from all sides of the start.
Shown_walk walk_of(const Snapshot<2>& snapshot, const Locator<2>& locator, const Point<2>& from,
                   const Point<2>& to, const Answer<2>& answer) {
  for (const Particle<2>& start : locator.particles_at(from)) {
    Shown_walk walk = shown_walk(snapshot, start, to);
    if (walk.result.cell == answer.cell && walk.result.contact.has_value() == answer.contact.has_value())
      return walk;
  }
  return shown_walk(snapshot, locator.particle_at(from).value(), to);
}

/// The vertices of the environment through which a walk passes: those on its line at which it changes cells.
std::set<std::uint32_t> passed_vertices(const Snapshot<2>& snapshot, const Shown_walk& walk,
                                        const Point<2>& from, const Point<2>& to) {
  std::set<std::uint32_t> result;
  for (const Half_facet f : walk.crossed)
    for (const std::uint32_t v : snapshot.loop(f))
      if (CGAL::sign(Exact_value::orientation(from, to, snapshot.point(v))) == 0) result.insert(v);
  return result;
}

/// True if b lies strictly in the cone of a facet over a. False if the rule ended the walk, on a facet or
/// vertex.
bool is_aimed_at(const Snapshot<2>& snapshot, Half_facet f, const Point<2>& a, const Point<2>& b) {
  const auto loop = snapshot.loop(f);
  const auto turn = [](const Point<2>& x, const Point<2>& y, const Point<2>& z) {
    return CGAL::sign(Exact_value::orientation(x, y, z));
  };
  const Point<2>&u = snapshot.point(loop[0]), &v = snapshot.point(loop[1]);
  const auto whole = turn(a, u, v);
  return whole != 0 && turn(a, u, b) == whole && turn(a, b, v) == whole;
}

/// The free cells at the given vertices.
std::set<Cell> star_of(const Snapshot<2>& snapshot, const std::set<std::uint32_t>& vertices) {
  std::set<Cell> result;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell cell = snapshot.cell(i);
    for (std::size_t f = 0; f < snapshot.facet_count(cell); ++f)
      if (!snapshot.is_solid(cell) && vertices.contains(snapshot.loop(Snapshot<2>::half_facet(cell, f))[0]))
        result.insert(cell);
  }
  return result;
}

void add_contact(Query_plot& plot, const Answer<2>& answer) {
  if (!answer.contact) return;
  plot.contact(answer.contact->point, answer.contact->normal);
  plot.key(Legend_entry::disc, contact, "contact, and its normal");
}

}  // namespace

void write_picture(io::Atomic_file& file, const Snapshot<2>& snapshot, const Locator<2>& locator,
                   std::size_t row, const std::array<Point<2>, 2>& points, const Answer<2>& answer) {
  const auto& [a, b] = points;
  if (answer.cell == Cell::none) {
    Query_plot plot(snapshot, points, {});
    plot.dashes(a, b, usual, Layer::lines, motion);
    return plot.write(file, title_of(row, answer, "a"));
  }
  const Shown_walk walk = walk_of(snapshot, locator, a, b, answer);
  const std::set<std::uint32_t> vertices = passed_vertices(snapshot, walk, a, b);
  const std::array<Tint, 2> tints{{{star_of(snapshot, vertices), star}, {walk.cells(), visited}}};
  Query_plot plot(snapshot, points, tints);
  plot.key(Legend_entry::patch, visited, "cells visited");
  const Point<2> end = answer.contact ? answer.contact->point : b;
  plot.line(a, end, usual, Layer::lines, motion);
  if (answer.contact) plot.dashes(end, b, usual, Layer::lines, motion);
  plot.key(Legend_entry::line, motion,
           answer.contact ? "the motion from a towards b" : "the motion from a to b");
  for (const Half_facet f : walk.crossed) plot.facet(f, heavy, crossed);
  if (!walk.crossed.empty()) plot.key(Legend_entry::line, crossed, "facets crossed");
  for (const std::uint32_t v : vertices) plot.spot(snapshot.point(v), 1.3, passed_vertex);
  if (!vertices.empty()) {
    plot.key(Legend_entry::disc, passed_vertex, "vertices passed through");
    plot.key(Legend_entry::patch, star, "other cells round them");
  }
  const Half_facet f = Snapshot<2>::half_facet(walk.result.cell, walk.result.aimed);
  if (!answer.contact && vertices.empty() && is_aimed_at(snapshot, f, a, b)) {
    const auto loop = snapshot.loop(f);
    plot.triangle(a, snapshot.point(loop[0]), snapshot.point(loop[1]), cone);
    plot.facet(f, heavy, aimed);
    plot.key(Legend_entry::line, aimed, "facet aimed at; its cone over a");
  }
  add_contact(plot, answer);
  plot.point(a, "a", motion);
  plot.point(b, "b", motion);
  plot.write(file, title_of(row, answer, "a"));
}

void write_picture(io::Atomic_file& file, const Snapshot<2>& snapshot, const Locator<2>& locator,
                   std::size_t row, const std::array<Point<2>, 3>& points, const Answer<2>& answer) {
  const auto& [p, t, q] = points;
  if (answer.cell == Cell::none) {
    Query_plot plot(snapshot, points, {});
    plot.dashes(p, q, usual, Layer::lines, motion);
    return plot.write(file, title_of(row, answer, "p"));
  }
  const Particle<2> start = locator.particle_at(p).value(), still = locator.particle_at(q).value();
  Walk_counts counts;
  const Chain before = find_any_chain(snapshot, start, still, counts).chain;
  const Shown_walk way = shown_walk(snapshot, start, t);
  Shown_walk along;
  if (!way.result.contact) along = shown_walk(snapshot, {t, way.result.cell, way.result.dimension, 0}, q);

  const std::array<Tint, 2> tints{{{along.cells(), along_edge}, {way.cells(), visited}}};
  Query_plot plot(snapshot, points, tints);
  plot.triangle(p, t, q, cone);
  plot.line(p, q, thick, Layer::edges, motion);
  plot.dashes(p, t, thin, Layer::lines, motion);
  plot.key(Legend_entry::line, motion, "pq before the motion");
  plot.key(Legend_entry::patch, cone, "swept while p moves to t");
  plot.key(Legend_entry::patch, visited, "cells that p visits");
  for (const Half_facet f : before) plot.facet(f, widest, chain);
  if (!before.empty()) plot.key(Legend_entry::line, chain, "chain of pq: the facets it passes");
  if (!way.result.contact) {
    plot.dashes(t, q, usual, Layer::lines, motion);
    plot.key(Legend_entry::dashes, motion, "tq after the motion");
    plot.key(Legend_entry::patch, along_edge, "cells the temporary particle visits");
    for (const Half_facet f : along.crossed) plot.facet(f, thick, crossed, Layer::kept_facets);
    if (!along.crossed.empty())
      plot.key(
          Legend_entry::line, crossed,
          along.result.contact ? "facets it crosses up to a wall" : "chain of tq: the facets it crosses");
  }
  if (answer.contact && answer.contact->body != Body_feature::vertex)
    plot.line(p + answer.contact->time * (t - p), q, thick, Layer::edges, contact);
  add_contact(plot, answer);
  plot.point(p, "p", motion);
  plot.point(t, "t", motion);
  plot.point(q, "q", motion);
  plot.write(file, title_of(row, answer, "p"));
}

void write_thick_picture(io::Atomic_file& file, const Snapshot<2>& snapshot, const Locator<2>& locator,
                         std::size_t row, const Pictured_motion<2>& shown, const Answer<2>& answer) {
  const Point<2>&from = shown.points[0], &to = shown.points[1];
  const double r = shown.radius;
  std::vector<Point<2>> within{from};  // all that is to be seen
  for (const Point<2>& x : shown.points)
    for (const double side : {-r, r})
      within.insert(within.end(), {x + Vector<2>{side, 0}, x + Vector<2>{0, side}});
  within.push_back(to);
  std::array<Tint, 1> tints{{{{}, visited}}};
  if (answer.cell != Cell::none)
    tints[0].cells = shown_walk(snapshot, locator.particle_at(from).value(), shown.end).cells();
  Query_plot plot(snapshot, within, tints);
  plot.rounded(shown.at(from), r, Layer::starts, thick_start);
  plot.key(Legend_entry::patch, thick_start, "before the motion, as thick as it is");
  plot.dashes(from, to, thin, Layer::lines, motion);
  if (shown.is_edge()) plot.line(from, shown.points[2], usual, Layer::lines, motion);
  if (answer.status == Motion_status::free || answer.status == Motion_status::contact) {
    const bool stops = answer.contact.has_value();
    plot.rounded(shown.swept(), r, Layer::patches, thick_way);
    plot.key(Legend_entry::patch, thick_way, "swept");
    plot.rounded(shown.at(shown.end), r, Layer::ends, stops ? thick_stop : thick_start);
    if (shown.is_edge()) plot.line(shown.end, shown.points[2], usual, Layer::lines, stops ? contact : motion);
    if (stops) plot.key(Legend_entry::patch, thick_stop, "where it stops");
    plot.key(Legend_entry::patch, visited, "cells that its axis visits");
  }
  if (answer.contact) {
    plot.contact(answer.contact->point, answer.contact->normal);
    plot.key(Legend_entry::disc, contact,
             answer.status == Motion_status::close ? "the nearest point of walls"
                                                   : "the point of the wall, and the normal");
  }
  for (std::size_t i = 0; i < shown.points.size(); ++i) plot.point(shown.points[i], shown.name(i), motion);
  plot.write(file, title_of(row, answer, shown.name(0)));
}

}  // namespace cellwalk::cli
