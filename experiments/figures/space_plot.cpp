// SPDX-License-Identifier: LGPL-3.0-or-later
#include "space_plot.h"

#include <cellwalk/internal/drawing/drawing.h>

#include <algorithm>
#include <set>

namespace cellwalk::figures {
namespace {

constexpr double outline = 0.004, dash = 0.07, contact_ball = 0.045, arrow = 0.6, arrow_radius = 0.016;

}  // namespace

Space_plot::Space_plot(const std::string& title, const Snapshot<3>& snapshot,
                       const std::vector<Cell>& cells) {
  panel_.title = title;
  std::set<std::array<std::uint32_t, 2>> ridges;
  for (std::size_t i = 0; i < snapshot.cell_count(); ++i) {
    const Cell cell = snapshot.cell(i);
    if (snapshot.is_solid(cell)) continue;
    const bool is_outlined = std::find(cells.begin(), cells.end(), cell) != cells.end();
    for (std::size_t k = 0; k < snapshot.facet_count(cell); ++k) {
      const Half_facet f = Snapshot<3>::half_facet(cell, k);
      const std::vector<std::uint32_t> loop = snapshot.loop(f);
      for (std::size_t j = 0; j < loop.size() && is_outlined; ++j) {
        const auto [low, high] = std::minmax(loop[j], loop[(j + 1) % loop.size()]);
        ridges.insert({low, high});
      }
      if (!snapshot.is_impassable(f)) continue;
      std::vector<Point<3>> corners;
      for (const std::uint32_t v : loop) corners.push_back(snapshot.point(v));
      const bool is_floor =
          std::all_of(corners.begin(), corners.end(), [](const auto& x) { return x[2] == 0; });
      if (snapshot.neighbour(f) != Cell::none)
        drawing::add_patch(panel_.drawing, corners, material(colours::spike, true));
      else if (is_floor)
        drawing::add_patch(panel_.drawing, corners, material(colours::floor, false));
    }
  }
  for (const auto& [u, v] : ridges) line(snapshot.point(u), snapshot.point(v), outline, colours::cell);
}

void Space_plot::line(const Point<3>& from, const Point<3>& to, double radius,
                      const drawing::Colour& colour) {
  drawing::add_tube(panel_.drawing, std::vector{from, to}, radius, material(colour, true));
}

void Space_plot::dashes(const Point<3>& from, const Point<3>& to, double radius,
                        const drawing::Colour& colour) {
  drawing::add_dashes(panel_.drawing, from, to, radius, dash, false, material(colour, true));
}

void Space_plot::triangle(const Point<3>& x, const Point<3>& y, const Point<3>& z,
                          const drawing::Colour& colour) {
  drawing::add_patch(panel_.drawing, std::vector{x, y, z}, material(colour, false));
}

void Space_plot::ball(const Point<3>& at, double radius, const drawing::Colour& colour) {
  drawing::add_ball(panel_.drawing, at, radius, material(colour, true));
}

void Space_plot::contact(const Contact<3>& contact) {
  ball(contact.point, contact_ball, colours::contact);
  drawing::add_arrow(panel_.drawing, contact.point, contact.normal, arrow, arrow_radius,
                     material(colours::contact, true));
}

void Space_plot::label(const Point<3>& at, const std::string& text, double right, double up) {
  panel_.labels.push_back({at, text, right, up});
}

std::uint32_t Space_plot::material(const drawing::Colour& colour, bool lit) {
  return panel_.drawing.add_material({colour, 0, lit});
}

}  // namespace cellwalk::figures
