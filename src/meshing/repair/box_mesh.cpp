// SPDX-License-Identifier: GPL-3.0-or-later
// The call of TetGen with a box of odd proportions, and floods across facets that are no triangles.
#include "box_mesh.h"

#include <cellwalk/internal/kernel/random.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>

#include "changes.h"
#include "winding.h"

namespace cellwalk::detail {
namespace {

/// The corners of the box lie this far outside in parts of the size. They are not symmetric: TetGen fails if
/// all eight lie on a sphere with the surface.
constexpr std::array<Point<3>, 8> shift{{{0.241, 0.263, 0.257},
                                         {0.252, 0.244, 0.249},
                                         {0.247, 0.258, 0.243},
                                         {0.261, 0.251, 0.254},
                                         {0.256, 0.246, 0.262},
                                         {0.243, 0.259, 0.248},
                                         {0.259, 0.242, 0.245},
                                         {0.249, 0.254, 0.260}}};

Surface_soup box_around(const Facets& surface) {
  Point<3> low = surface.points[0], high = low;
  for (const Point<3>& p : surface.points)
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
  Surface_soup box;
  for (std::size_t i = 0; i < 8; ++i) {
    Point<3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool is_high = (i >> k & 1) != 0;
      p[k] = is_high ? high[k] + shift[i][k] * surface.size : low[k] - shift[i][k] * surface.size;
    }
    box.points.push_back(p);
  }
  box.facets = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return box;
}

/// Regions of smaller tetrahedra are slivers between almost equal triangles, whose winding numbers say
/// little.
constexpr double sliver = 1e-15;
constexpr double leak = 0.01;

/// Where TetGen fails, it may succeed with the points in another order. So many are tried.
constexpr std::uint64_t further_orders = 2;

/// The seconds after which another order is tried: it may succeed at once where TetGen's flips go round in
/// circles. With a size of cells, nobody can say how many there will be.
double patience(const Facets& surface, const Tetrahedralize_options& options) {
  if (options.cell_size > 0) return options.limits.seconds;
  const double several = options.quality > 0 ? 30 : 10;
  return several + 1e-3 * static_cast<double>(surface.facets.size());
}

/// Checks that neighbours lie on different sides of their common facet. With finer tolerances, TetGen may
/// return tetrahedra that fold over each other.
/// \pre all are positive
/// \throw Error(not_certified)
void check_unfolded(const Tetgen_result& mesh) {
  const auto runs_up = [&](std::uint32_t t, int i) {
    const auto& c = mesh.tetrahedra[t];
    Triangle f{c[(i + 1) & 3], c[(i + 2) & 3], c[(i + 3) & 3]};
    if ((i & 1) != 0) std::swap(f[1], f[2]);
    return runs_upwards(f);
  };
  for (std::uint32_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (int i = 0; i < 4; ++i) {
      const std::int32_t n = mesh.neighbours[t][i];
      if (n < static_cast<std::int32_t>(t)) continue;
      const auto& back = mesh.neighbours[n];
      const auto j =
          static_cast<int>(std::find(back.begin(), back.end(), static_cast<std::int32_t>(t)) - back.begin());
      if (runs_up(t, i) == runs_up(static_cast<std::uint32_t>(n), j))
        throw Error(Error_code::not_certified, "TetGen made no mesh: its tetrahedra overlap");
    }
}

/// Tetrahedra by TetGen, which gets the points in some order.
/// \param order the number of each of its points
Tetgen_result mesh_in_order(const Facets& surface, const std::vector<std::uint32_t>& order, Frame frame,
                            const Tetrahedralize_options& options, std::string& tolerance) {
  std::vector<std::uint32_t> place(order.size());
  std::vector<Surface_soup> surfaces(1);
  for (std::uint32_t i = 0; i < order.size(); ++i) {
    place[order[i]] = i;
    surfaces[0].points.push_back(surface.points[order[i]]);
  }
  for (const auto& [triangle, facet] : labels_of(surface.facets)) {
    const Triangle& t = facet.corners;
    surfaces[0].facets.push_back({place[t[0]], place[t[1]], place[t[2]]});
  }
  std::sort(surfaces[0].facets.begin(), surfaces[0].facets.end());  // whatever the order of the labels
  Feature_names names;
  names.add("the surface", {}, order.size(), {}, surfaces[0].facets.size());
  if (frame == Frame::box) {
    surfaces.push_back(box_around(surface));
    names.add("the box", {}, 8, {}, 12);
  }
  const Owners owners = owners_of(surfaces);
  Tetgen_result result;
  tolerance = mesh_by_tetgen(surfaces, names, options, [&](const Tetgen_result& mesh) {
    check_kept(mesh, surfaces, owners, names);
    result = mesh;
    for (auto& t : result.tetrahedra) t = positive(mesh, t);
    // Neighbours lie opposite the corners, two of which may have changed places.
    for (std::size_t t = 0; t < result.tetrahedra.size(); ++t)
      if (result.tetrahedra[t] != mesh.tetrahedra[t])
        std::swap(result.neighbours[t][0], result.neighbours[t][1]);
    check_unfolded(result);
  });
  std::copy(surface.points.begin(), surface.points.end(), result.points.begin());
  for (auto& t : result.tetrahedra)
    for (std::uint32_t& v : t)
      if (v < order.size()) v = order[v];
  return result;
}

}  // namespace

Labels labels_of(const std::vector<Facet>& facets) {
  Labels labels;
  for (const Facet& f : facets) {
    const auto [at, is_new] = labels.insert({sorted(f.corners), f});
    if (!is_new && f.part < at->second.part) at->second = f;
  }
  return labels;
}

void compact(Facets& surface) {
  std::vector<bool> is_used(surface.points.size(), false);
  for (const Facet& f : surface.facets)
    for (const std::uint32_t v : f.corners) is_used[v] = true;
  std::vector<std::uint32_t> number(surface.points.size());
  std::vector<Point<3>> points;
  std::size_t given = 0;
  for (std::size_t v = 0; v < is_used.size(); ++v) {
    if (!is_used[v]) continue;
    given += v < surface.given_points;
    number[v] = static_cast<std::uint32_t>(points.size());
    points.push_back(surface.points[v]);
  }
  for (Facet& f : surface.facets)
    for (std::uint32_t& v : f.corners) v = number[v];
  surface.points = std::move(points);
  surface.given_points = given;
}

Tetgen_result mesh_between(const Facets& surface, Frame frame, const Tetrahedralize_options& options,
                           std::string& tolerance) {
  std::vector<std::uint32_t> order(surface.points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto start = std::chrono::steady_clock::now();
  std::string first_problem;
  for (std::uint64_t attempt = 0;; ++attempt) {
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
    const double left = options.limits.seconds - elapsed.count();
    Tetrahedralize_options limited = options;
    limited.limits.seconds = attempt == further_orders ? left : std::min(left, patience(surface, options));
    try {
      return mesh_in_order(surface, order, frame, limited, tolerance);
    } catch (const Error& error) {
      if (error.code() != Error_code::not_certified) throw;
      const bool is_last = attempt == further_orders || limited.limits.seconds >= left;
      const bool is_impatience = ran_out_of_time(error) && !is_last;
      if (first_problem.empty() && !is_impatience) first_problem = error.what();
      if (is_last) throw Error(Error_code::not_certified, first_problem);
      Random(attempt + 1).shuffle(order);
    }
  }
}

double volume_of(const Tetgen_result& mesh, std::uint32_t tetrahedron) {
  const auto& t = mesh.tetrahedra[tetrahedron];
  const Point<3>& o = mesh.points[t[0]];
  return dot(mesh.points[t[1]] - o, cross(mesh.points[t[2]] - o, mesh.points[t[3]] - o)) / 6;
}

Point<3> centre_of(const Tetgen_result& mesh, std::uint32_t tetrahedron) {
  Point<3> sum{};
  for (const std::uint32_t v : mesh.tetrahedra[tetrahedron]) sum = sum + 0.25 * mesh.points[v];
  return sum;
}

Regions find_regions(const Tetgen_result& mesh, const Labels& labels) {
  constexpr std::uint32_t none = 0xffffffffu;
  Regions result{std::vector<std::uint32_t>(mesh.tetrahedra.size(), none), {}};
  std::vector<std::uint32_t> stack;
  for (std::uint32_t seed = 0; seed < mesh.tetrahedra.size(); ++seed) {
    if (result.of[seed] != none) continue;
    const auto number = static_cast<std::uint32_t>(result.regions.size());
    Region region{0, {seed, seed}, false};
    std::array<double, 2> most{0, 0};
    stack.assign(1, seed);
    result.of[seed] = number;
    while (!stack.empty()) {
      const std::uint32_t t = stack.back();
      stack.pop_back();
      const double volume = volume_of(mesh, t);
      region.volume += volume;
      if (volume > most[0]) {
        region.largest = {t, region.largest[0]};
        most = {volume, most[0]};
      } else if (volume > most[1]) {
        region.largest[1] = t, most[1] = volume;
      }
      for (int i = 0; i < 4; ++i) {
        const std::int32_t n = mesh.neighbours[t][i];
        const bool is_triangle = labels.contains(opposite(mesh.tetrahedra[t], i));
        if (n < 0) region.is_outer |= !is_triangle;
        if (n < 0 || is_triangle || result.of[n] != none) continue;
        result.of[n] = number;
        stack.push_back(static_cast<std::uint32_t>(n));
      }
    }
    result.regions.push_back(region);
  }
  return result;
}

Windings wind(const Tetgen_result& mesh, const Regions& regions, const Facets& oriented,
              const std::string& hint) {
  Windings result;
  const double least = sliver * oriented.size * oriented.size * oriented.size;
  for (const Region& region : regions.regions) {
    const Point<3> place = centre_of(mesh, region.largest[0]);
    const double number = winding_number(oriented, place);
    if (region.largest[1] != region.largest[0] && volume_of(mesh, region.largest[1]) > least) {
      const double other = winding_number(oriented, centre_of(mesh, region.largest[1]));
      if (std::abs(number - other) > leak)
        refuse_surface(
            fmt::format("has a hole that was not found: inside and outside are connected near {}; "
                        "close it, or name a point of the free space (--inside){}",
                        describe(place), hint));
    }
    result.of.push_back(number);
    const double nearest = std::round(number);
    if (region.volume > least) result.error = std::max(result.error, std::abs(number - nearest));
    result.volume += nearest * region.volume;
    if (nearest < 0 && region.volume > least) {
      result.inside_out.add(place);
      result.inside_out_volume += region.volume;
    }
    if (nearest > 1) result.covered_twice += (nearest - 1) * region.volume;
  }
  return result;
}

}  // namespace cellwalk::detail
