// SPDX-License-Identifier: LGPL-3.0-or-later
// The sentences and keys for certificates, changes of the input and facing walls.
#include <cellwalk/internal/loading/report.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace cellwalk {
namespace {

/// "1, 0.5, 0".
std::string first_place(const Facing_facets& facets) {
  std::string text;
  for (const double x : facets.place) text += (text.empty() ? "" : ", ") + rounded(x);
  return text;
}

nlohmann::ordered_json described(const Facing_facets& facets) {
  nlohmann::ordered_json json{{"pairs", facets.pairs}};
  if (facets.pairs != 0)
    json["first"] = {{"cells", facets.cells}, {"at", facets.place}, {"distance", facets.distance}};
  return json;
}

}  // namespace

std::string describe(const Certificate& c, int dimension) {
  std::string text;
  const auto line = [&text](const char* name, const std::string& value) {
    text += fmt::format("  {:<12}{}\n", name, value);
  };
  line("cells", fmt::format("{} ({} solid)", c.cells, c.solid_cells));
  line("facets", std::to_string(c.facets));
  line("walls",
       fmt::format("{} ({} boundary facets, {} membranes)", c.walls, c.boundary_facets, c.membranes));
  if (dimension == 3) line("edges", std::to_string(c.ridges));
  line("vertices", fmt::format("{} ({} pinched)", c.vertices, c.pinched_vertices));
  line(dimension == 3 ? "volume" : "area", rounded(c.volume));
  line("free space", fmt::format("{} in {} component{}", rounded(c.free_volume), c.components,
                                 c.components == 1 ? "" : "s"));
  return text;
}

nlohmann::ordered_json to_json(const Certificate& c, int dimension) {
  return {{"dimension", dimension},
          {"cells", c.cells},
          {"solid_cells", c.solid_cells},
          {"facets", c.facets},
          {"walls", c.walls},
          {"boundary_facets", c.boundary_facets},
          {"membranes", c.membranes},
          {"ridges", c.ridges},
          {"vertices", c.vertices},
          {"pinched_vertices", c.pinched_vertices},
          {"components", c.components},
          {"volume", c.volume},
          {"free_volume", c.free_volume}};
}

std::vector<std::string> changes(const Build_report& built) {
  std::vector<std::string> lines;
  const auto changed = [&lines](std::size_t count, const char* what) {
    if (count != 0) lines.push_back(fmt::format("{} {}", count, what));
  };
  if (built.flipped) lines.push_back("every cell was inverted: all turned round");
  changed(built.merged_points, "points merged with others in the same place");
  changed(built.unused_points, "points of no cell left out");
  const Split_report& split = built.split;
  if (split.cells_split != 0)
    lines.push_back(
        fmt::format("{} of {} cells split into {}: {} not exactly planar, {} not exactly convex, {}the "
                    "others beside them",
                    split.cells_split, built.cells_read, split.cells_made, split.not_planar, split.not_convex,
                    split.not_simplices ? fmt::format("{} no simplices, ", split.not_simplices) : ""));
  changed(split.facets_triangulated, "facets cut into triangles");
  changed(split.points_added, "points added inside cells");
  if (lines.empty()) lines.push_back("nothing: every cell is exact as it is");
  return lines;
}

nlohmann::ordered_json to_json(const Build_report& built) {
  const Split_report& split = built.split;
  return {{"cells_read", built.cells_read},
          {"points_read", built.points_read},
          {"unused_points", built.unused_points},
          {"merged_points", built.merged_points},
          {"flipped", built.flipped},
          {"cells_split", split.cells_split},
          {"cells_made", split.cells_made},
          {"facets_triangulated", split.facets_triangulated},
          {"points_added", split.points_added},
          {"not_planar", split.not_planar},
          {"not_convex", split.not_convex},
          {"not_simplices", split.not_simplices},
          {"facing_walls", to_json(built.facing)}};
}

std::vector<std::string> changes(const Refinement& refined) {
  const Facing_facets& facing = refined.facing;
  std::vector<std::string> lines;
  if (facing.pairs == 0) return lines;
  lines.push_back(
      fmt::format("cells did not conform: {} of facets overlapped, the first of cells {} and {} at ({})",
                  facing.pairs == 1 ? "1 pair" : fmt::format("{} pairs", facing.pairs), facing.cells[0],
                  facing.cells[1], first_place(facing)));
  if (refined.facets != 0)
    lines.push_back(fmt::format("{} {} divided into {} pieces", refined.facets,
                                refined.facets == 1 ? "facet" : "facets", refined.pieces));
  if (refined.points_added != 0)
    lines.push_back(fmt::format("{} points added where sides of facets cross", refined.points_added));
  if (refined.points_joined != 0)
    lines.push_back(fmt::format("{} points joined with others, the farthest by {}", refined.points_joined,
                                rounded(refined.farthest)));
  return lines;
}

nlohmann::ordered_json to_json(const Refinement& refined) {
  nlohmann::ordered_json json = described(refined.facing);
  json["facets"] = refined.facets;
  json["pieces"] = refined.pieces;
  json["points_added"] = refined.points_added;
  json["points_joined"] = refined.points_joined;
  json["farthest"] = refined.farthest;
  return json;
}

std::vector<std::string> notes(const Facing_walls& facing) {
  std::vector<std::string> lines;
  const auto note = [&lines](const Facing_facets& facets, const std::string& where) {
    if (facets.pairs == 0) return;
    lines.push_back(fmt::format("{} {}, with walls between free cells: the first of cells {} and {} at ({})",
                                facets.pairs, (facets.pairs == 1 ? "pair" : "pairs") + where, facets.cells[0],
                                facets.cells[1], first_place(facets)));
  };
  note(facing.overlapping, std::string(" of facets that overlap in a ") +
                               (facing.overlapping.place.size() == 2 ? "line" : "plane"));
  note(facing.near, " of facets within " + rounded(facing.tolerance) + " of each other");
  if (facing.near.pairs != 0) lines.back() += fmt::format(", {} apart", rounded(facing.near.distance));
  return lines;
}

nlohmann::ordered_json to_json(const Facing_walls& facing) {
  nlohmann::ordered_json near = described(facing.near);
  near["tolerance"] = facing.tolerance;
  return {{"overlapping", described(facing.overlapping)}, {"near", near}};
}

std::string rounded(double value) { return fmt::format("{:.6g}", value); }

}  // namespace cellwalk
