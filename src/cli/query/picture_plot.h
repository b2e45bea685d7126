// SPDX-License-Identifier: LGPL-3.0-or-later
// A part of a planar environment with a motion, as a panel with a legend.
#ifndef CELLWALK_CLI_QUERY_PICTURE_PLOT_H
#define CELLWALK_CLI_QUERY_PICTURE_PLOT_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/drawing/figure.h>
#include <cellwalk/internal/io/atomic_file.h>
#include <cellwalk/walk/contact.h>

#include <set>
#include <span>
#include <string>
#include <vector>

namespace cellwalk::cli {

namespace query_colours {
constexpr drawing::Colour free_cell{0.99, 0.99, 0.99}, solid{0.76, 0.77, 0.79}, wall{0.36, 0.37, 0.40},
    grid{0.74, 0.76, 0.79}, visited{0.86, 0.92, 0.985}, star{1.0, 0.94, 0.76}, along_edge{0.86, 0.94, 0.84},
    motion{0.08, 0.16, 0.42}, crossed{0.08, 0.58, 0.32}, aimed{0.90, 0.45, 0.05},
    cone{0.95, 0.62, 0.12, 0.22}, chain{0.25, 0.45, 0.85}, passed_vertex{0.55, 0.20, 0.65},
    contact{0.80, 0.10, 0.10}, thick_start{0.08, 0.16, 0.42, 0.30}, thick_way{0.08, 0.16, 0.42, 0.10},
    thick_stop{0.80, 0.10, 0.10, 0.35}, wall_in_space{0.36, 0.37, 0.40, 0.13};
}

/// A set of cells and their colour.
struct Tint {
  std::set<Cell> cells;
  drawing::Colour colour;
};

/// The layers from the lowest to the highest, which covers the others, by their heights.
enum class Layer {
  ground = 0,
  cells = 4,
  patches = 8,
  starts = 9,
  ends = 10,
  grid = 12,
  walls = 16,
  facets = 20,
  kept_facets = 24,
  lines = 28,
  edges = 32,
  spots = 36,
  arrows = 40
};

/// Widths are in units of the picture: 1 is a clearly visible line.
class Query_plot {
 public:
  /// Shows the cells near the given points and all tinted cells, the latter with their numbers. Later tints
  /// cover earlier ones.
  Query_plot(const Snapshot<2>& snapshot, std::span<const Point<2>> points, std::span<const Tint> tints);

  void line(const Point<2>& from, const Point<2>& to, double width, Layer layer,
            const drawing::Colour& colour);
  void dashes(const Point<2>& from, const Point<2>& to, double width, Layer layer,
              const drawing::Colour& colour);
  void facet(Half_facet f, double width, const drawing::Colour& colour, Layer layer = Layer::facets);
  void triangle(const Point<2>& a, const Point<2>& b, const Point<2>& c, const drawing::Colour& colour);
  /// All that is within a radius of the hull of points.
  void rounded(const std::vector<Point<2>>& corners, double radius, Layer layer,
               const drawing::Colour& colour);
  void spot(const Point<2>& x, double size, const drawing::Colour& colour);
  /// A point with its name beside it.
  void point(const Point<2>& x, const std::string& name, const drawing::Colour& colour);
  /// Point and normal.
  void contact(const Point<2>& x, const Vector<2>& normal);
  void key(drawing::Legend_entry::Swatch swatch, const drawing::Colour& colour, const std::string& text);

  /// \throw Error(other) if it cannot be written
  void write(io::Atomic_file& file, const std::string& title);

 private:
  void add_cell(Cell cell, const drawing::Colour& colour);
  void label(const Point<2>& x, const std::string& text, double right, double up);
  double height(Layer layer) const;
  std::uint32_t material(const drawing::Colour& colour) {
    return panel_.drawing.add_material({colour, 0, false});
  }

  const Snapshot<2>& snapshot_;
  drawing::Panel panel_;
  std::vector<drawing::Legend_entry> legend_;
  Point<2> lower_, upper_;
  double unit_ = 1;
};

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_PICTURE_PLOT_H
