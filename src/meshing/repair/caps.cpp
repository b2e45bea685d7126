// SPDX-License-Identifier: GPL-3.0-or-later
// The cycles of the border, and their triangulations.
#include "caps.h"

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>

#include "changes.h"
#include "edges.h"
#include "meshing/fill/surface_topology.h"

namespace cellwalk::detail {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Loop = std::vector<std::uint32_t>;

/// With more edges, the search for the best triangulation in space takes long.
constexpr std::size_t most_edges_in_space = 600, most_edges_in_plane = 20000;

/// The border as cycles in the direction in which caps run.
std::vector<Loop> border_cycles(const Facets& surface) {
  // Ways that caps go on from a point: against the triangles.
  std::map<std::uint32_t, std::vector<std::uint32_t>> next;
  const auto uses = edge_uses(surface.facets);
  for_each_edge(uses, [&](std::span<const Edge_use> edge) {
    if (edge.size() % 2 == 0) return;
    std::ptrdiff_t forward = 0;
    for (const Edge_use& use : edge) forward += use.forward ? 1 : -1;
    if (forward > 0)
      next[edge[0].high].push_back(edge[0].low);
    else
      next[edge[0].low].push_back(edge[0].high);
  });
  // A patch against another: at points where no way goes on, one that arrives is turned.
  std::map<std::uint32_t, std::vector<std::uint32_t>> previous;
  for (const auto& [from, ways] : next)
    for (const std::uint32_t to : ways) previous[to].push_back(from);
  const auto take = [](std::vector<std::uint32_t>& from, std::uint32_t value) {
    from.erase(std::find(from.begin(), from.end(), value));
  };
  std::vector<Loop> cycles;
  for (;;) {
    std::erase_if(next, [](const auto& ways) { return ways.second.empty(); });
    if (next.empty()) return cycles;
    Loop path{next.begin()->first};
    std::map<std::uint32_t, std::size_t> place{{path[0], 0}};
    do {
      const std::uint32_t at = path.back();
      const bool is_forward = !next[at].empty();
      // An even number of odd edges ends at each point: there is a way on.
      const std::uint32_t to = is_forward ? next[at].back() : previous[at].back();
      take(next[is_forward ? at : to], is_forward ? to : at);
      take(previous[is_forward ? to : at], is_forward ? at : to);
      const auto [seen, is_new] = place.insert({to, path.size()});
      if (is_new) {
        path.push_back(to);
        continue;
      }
      cycles.emplace_back(path.begin() + static_cast<std::ptrdiff_t>(seen->second), path.end());
      while (path.back() != to) {
        place.erase(path.back());
        path.pop_back();
      }
    } while (path.size() > 1);
  }
}

bool is_straight(const Facets& surface, const Loop& loop) {
  for (std::size_t i = 2; i < loop.size(); ++i)
    if (!is_on_one_line(surface.points[loop[0]], surface.points[loop[1]], surface.points[loop[i]]))
      return false;
  return true;
}

/// The size and place of a cap whose border is a loop.
Repaired_part measure(const Facets& surface, const Loop& loop) {
  Repaired_part cap;
  cap.edges = loop.size();
  for (const std::uint32_t v : loop)
    cap.centre = cap.centre + (1.0 / static_cast<double>(loop.size())) * surface.points[v];
  Vector<3> sum{};
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum = sum + cross(surface.points[loop[i]] - cap.centre,
                      surface.points[loop[(i + 1) % loop.size()]] - cap.centre);
  cap.area = length(sum) / 2;
  cap.normal = normalized(sum, {0, 0, 1});
  cap.width = 2 * std::sqrt(cap.area / std::numbers::pi);
  for (const std::uint32_t v : loop)
    cap.off_plane = std::max(cap.off_plane, std::abs(dot(surface.points[v] - cap.centre, cap.normal)));
  return cap;
}

std::vector<Triangle> triangulate(const Facets& surface, const Loop& loop) {
  std::vector<Repair_kernel::Point_3> border;
  for (const std::uint32_t v : loop) border.push_back(to_cgal(surface.points[v]));
  std::vector<CGAL::Triple<int, int, int>> cuts;
  const auto fill = [&](bool in_plane) {
    cuts.clear();
    PMP::triangulate_hole_polyline(
        border, std::back_inserter(cuts),
        CGAL::parameters::use_2d_constrained_delaunay_triangulation(in_plane).use_delaunay_triangulation(
            true));
    return cuts.size() + 2 == loop.size();
  };
  std::vector<Triangle> triangles;
  if ((loop.size() <= most_edges_in_plane && fill(true)) ||
      (loop.size() <= most_edges_in_space && fill(false)))
    for (const auto& t : cuts) triangles.push_back({loop[t.first], loop[t.second], loop[t.third]});
  return triangles;
}

/// A cone from the centre.
std::vector<Triangle> cone(const Loop& loop, std::uint32_t apex) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < loop.size(); ++i)
    triangles.push_back({apex, loop[i], loop[(i + 1) % loop.size()]});
  return triangles;
}

/// The volume between triangles over a loop and the cone from its centre.
double between(const Facets& surface, const std::vector<Triangle>& triangles, const Point<3>& apex) {
  double volume = 0;  // the cone has none seen from its apex
  for (const Triangle& t : triangles) {
    const Facet f{t};
    volume += signed_volume(surface, {&f, 1}, apex);
  }
  return std::abs(volume);
}

}  // namespace

std::vector<Repaired_part> add_caps(Facets& surface) {
  struct Cap {
    Repaired_part part;
    std::vector<Triangle> triangles;
  };
  std::vector<Cap> caps;
  for (const Loop& loop : border_cycles(surface)) {
    if (loop.size() < 3 || is_straight(surface, loop)) continue;
    Cap cap{measure(surface, loop), triangulate(surface, loop)};
    if (cap.triangles.empty()) {
      cap.triangles = cone(loop, static_cast<std::uint32_t>(surface.points.size()));
      surface.points.push_back(cap.part.centre);
    } else {
      cap.part.doubt = between(surface, cap.triangles, cap.part.centre);
    }
    caps.push_back(std::move(cap));
  }
  std::stable_sort(caps.begin(), caps.end(),
                   [](const Cap& a, const Cap& b) { return a.part.area > b.part.area; });
  std::vector<Repaired_part> parts;
  for (std::uint32_t i = 0; i < caps.size(); ++i) {
    caps[i].part.name = fmt::format("cap_{}", i + 1);
    for (const Triangle& t : caps[i].triangles) surface.facets.push_back({t, Part::cap, i});
    parts.push_back(std::move(caps[i].part));
  }
  return parts;
}

}  // namespace cellwalk::detail
