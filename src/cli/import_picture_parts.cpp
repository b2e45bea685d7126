// SPDX-License-Identifier: LGPL-3.0-or-later
// Surfaces by the uses of their edges; groups by sums over their facets.
#include "import_picture_parts.h"

#include <cellwalk/internal/drawing/walls.h>
#include <cellwalk/internal/io/vtu.h>

#include <algorithm>
#include <map>

namespace cellwalk::cli {
namespace {

constexpr std::size_t most_facets = 300000;  // of a surface; of more only a share is drawn
constexpr std::size_t most_open_edges = 30000;
constexpr int tube_sides = 6;
constexpr std::size_t longest_legend = 70;  // letters

}  // namespace

template <int D>
Patch patch_of(const std::string& name, const Snapshot<D>& snapshot, const Selection<D>& group) {
  Patch patch{name, {}};
  Vector<3> sum{};
  double corners = 0;
  for (const Half_facet h : group.facets) {
    std::vector<Point<3>>& facet = patch.facets.emplace_back();
    for (const std::uint32_t p : snapshot.loop(h)) facet.push_back(io::in_space(snapshot.point(p)));
    Vector<3> area{};
    for (std::size_t i = 1; i + 1 < facet.size(); ++i)
      area = area + cross(facet[i] - facet[0], facet[i + 1] - facet[0]);
    patch.normal = patch.normal + area;
    patch.extent += D == 2 ? length(facet[1] - facet[0]) : length(area) / 2;
    for (const Point<3>& x : facet) sum = sum + x, ++corners;
  }
  if (corners != 0) patch.centre = (1 / corners) * sum;
  return patch;
}

template Patch patch_of(const std::string&, const Snapshot<2>&, const Selection<2>&);
template Patch patch_of(const std::string&, const Snapshot<3>&, const Selection<3>&);

std::vector<std::array<Point<3>, 2>> border_of(const Patch& patch) {
  std::map<std::array<Point<3>, 2>, std::size_t> uses;
  for (const auto& facet : patch.facets)
    for (std::size_t i = 0; i < facet.size(); ++i) {
      const auto [a, b] = std::minmax(facet[i], facet[(i + 1) % facet.size()]);
      ++uses[{a, b}];
    }
  std::vector<std::array<Point<3>, 2>> result;
  for (const auto& [edge, n] : uses)
    if (n == 1) result.push_back(edge);
  return result;
}

std::size_t draw_given(drawing::Drawing& drawing, const Surface_soup& surface, drawing::Colour colour,
                       drawing::Colour open_edges, double tube_radius) {
  std::map<Point<3>, std::uint32_t> numbers;  // readers keep points in the same place apart
  std::vector<std::uint32_t> number;
  for (const Point<3>& p : surface.points)
    number.push_back(numbers.try_emplace(p, static_cast<std::uint32_t>(numbers.size())).first->second);
  std::vector<Point<3>> points(numbers.size());
  for (const auto& [p, i] : numbers) points[i] = p;
  const double share =
      static_cast<double>(most_facets) / static_cast<double>(std::max(most_facets, surface.facets.size()));
  std::vector<std::vector<std::uint32_t>> facets;
  std::map<std::array<std::uint32_t, 2>, std::size_t> uses;
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    std::vector<std::uint32_t> loop;
    for (const std::uint32_t p : surface.facets[f]) loop.push_back(number[p]);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
      if (a != b) ++uses[{a, b}];
    }
    if (loop.size() > 2 && drawing::is_among(share, f)) facets.push_back(std::move(loop));
  }
  drawing::add_surface(drawing, points, facets, drawing.add_material({colour}));
  const std::uint32_t border = drawing.add_material({open_edges});
  std::size_t open = 0;
  drawing.sides = tube_sides;
  for (const auto& [edge, count] : uses)
    if (count % 2 != 0 && ++open <= most_open_edges)
      drawing::add_tube(drawing, std::array{points[edge[0]], points[edge[1]]}, tube_radius, border);
  return open;
}

std::vector<Point<3>> spread(const nlohmann::ordered_json& places, std::size_t most, double distance) {
  std::vector<Point<3>> result;
  for (const nlohmann::ordered_json& place : places) {
    const auto p = place.get<Point<3>>();
    const bool is_near = std::any_of(result.begin(), result.end(),
                                     [&](const Point<3>& q) { return length(p - q) < distance; });
    if (!is_near && result.size() < most) result.push_back(p);
  }
  return result;
}

std::string drawable(std::string text) {
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return text;
}

std::string in_brief(const std::string& text) {
  std::string words = text.substr(0, std::min(text.find(", the f"), text.find(", a")));
  if (words.size() > longest_legend) words = words.substr(0, words.find(": "));
  return drawable(words.substr(0, longest_legend));
}

}  // namespace cellwalk::cli
