// SPDX-License-Identifier: LGPL-3.0-or-later
// What the picture of an import shows: the surface given, groups of facets, places and words of the report.
#ifndef CELLWALK_CLI_IMPORT_PICTURE_PARTS_H
#define CELLWALK_CLI_IMPORT_PICTURE_PARTS_H

#include <cellwalk/environment/selection.h>
#include <cellwalk/internal/drawing/drawing.h>
#include <cellwalk/records/surface_soup.h>

#include <nlohmann/json.hpp>

#include <array>
#include <string>
#include <vector>

namespace cellwalk::cli {

/// The facets of a group.
struct Patch {
  std::string name;
  std::vector<std::vector<Point<3>>> facets;
  Point<3> centre{};
  Vector<3> normal{};  ///< out of the cells from which the facets are seen; times twice the area
  double extent = 0;   ///< area, in 2D length
};

template <int D>
Patch patch_of(const std::string& name, const Snapshot<D>& snapshot, const Selection<D>& group);
extern template Patch patch_of(const std::string&, const Snapshot<2>&, const Selection<2>&);
extern template Patch patch_of(const std::string&, const Snapshot<3>&, const Selection<3>&);

/// Its edges of one facet.
std::vector<std::array<Point<3>, 2>> border_of(const Patch& patch);

/// Adds a surface, and its edges of an odd number of facets as tubes; returns the number of these. Points in
/// the same place are one.
std::size_t draw_given(drawing::Drawing& drawing, const Surface_soup& surface, drawing::Colour colour,
                       drawing::Colour open_edges, double tube_radius);

/// Places that lie apart from each other, the first ones.
std::vector<Point<3>> spread(const nlohmann::ordered_json& places, std::size_t most, double distance);

/// A change of the report in words for a legend: without its place, and without explanations if these are
/// long; printable ASCII.
std::string in_brief(const std::string& text);

/// Text that the renderer can draw.
std::string drawable(std::string text);

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_IMPORT_PICTURE_PARTS_H
