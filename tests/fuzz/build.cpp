// SPDX-License-Identifier: LGPL-3.0-or-later
// Cells from bytes: a small complex with a few things done to it, most of them harm. What is refused is
// refused; what is certified is certified again from its own soup, and moved about in.
#include <cellwalk/environment/environment.h>
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/generators/lattice_world.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "environment/sample_soups.h"
#include "fuzz/decoder.h"
#include "fuzz/move_about.h"
#include "fuzz/targets.h"

namespace cellwalk::fuzz {
namespace {

template <int D>
Cell_soup<D> grid(Decoder& in) {
  Grid_options<D> options;
  for (auto& n : options.cells) n = static_cast<std::uint32_t>(1 + in.below(D == 2 ? 4 : 3));
  if constexpr (D == 2)
    return square_grid(options);
  else
    return hex_grid(options);
}

template <int D>
Cell_soup<D> simplices(Decoder& in) {
  Simplex_grid_options<D> options;
  for (auto& n : options.cells) n = static_cast<std::uint32_t>(1 + in.below(D == 2 ? 3 : 2));
  options.jitter = in.flag() ? 0.125 : 0;
  if constexpr (D == 2)
    return triangle_grid(options);
  else
    return tetrahedral_grid(options);
}

template <int D>
Cell_soup<D> mixed(Decoder& in) {
  auto options = mixed_lattice_world<D>(in.byte());
  options.cells = Grid_options<D>::filled(static_cast<std::uint32_t>(2 + in.below(D == 2 ? 4 : 2)));
  return lattice_world(options);
}

/// Points and cells of any kind, that hang together or not.
template <int D>
Cell_soup<D> from_scratch(Decoder& in) {
  Cell_soup<D> soup;
  soup.points.resize(D + 1 + in.below(9));
  for (Point<D>& p : soup.points)
    for (double& x : p) x = in.coordinate();
  const auto index = [&] { return static_cast<std::uint32_t>(in.below(soup.points.size())); };
  for (std::size_t n = 1 + in.below(5); n > 0; --n) {
    std::array<std::uint32_t, 8> v;
    for (auto& i : v) i = index();
    if constexpr (D == 2) {
      add_polygon(soup, std::span(v).first(3 + in.below(4)));
    } else {
      switch (in.below(4)) {
        case 0:
          add_tetrahedron(soup, v[0], v[1], v[2], v[3]);
          break;
        case 1:
          add_pyramid(soup, {v[0], v[1], v[2], v[3], v[4]});
          break;
        case 2:
          add_prism(soup, {v[0], v[1], v[2], v[3], v[4], v[5]});
          break;
        default:
          add_hexahedron(soup, v);
      }
    }
  }
  return soup;
}

template <int D>
Cell_soup<D> base(Decoder& in) {
  switch (in.below(5)) {
    case 0:
      return grid<D>(in);
    case 1:
      return simplices<D>(in);
    case 2:
      return mixed<D>(in);
    case 3:
      return from_scratch<D>(in);
    default:
      if constexpr (D == 2)
        return in.flag() ? test::pinched_squares() : test::collinear_polygon();
      else
        return test::pinched_tetrahedra();
  }
}

/// Gives a cell its own copies of some of its points: where it met others, there are walls that coincide.
template <int D>
void part(Cell_soup<D>& soup, std::size_t cell, std::span<const std::uint32_t> loop) {
  std::map<std::uint32_t, std::uint32_t> copies;
  for (const std::uint32_t v : loop)
    if (copies.try_emplace(v, static_cast<std::uint32_t>(soup.points.size())).second)
      soup.points.push_back(Point<D>(soup.points[v]));
  for (std::size_t i = soup.facet_begin[soup.cell_begin[cell]];
       i < soup.facet_begin[soup.cell_begin[cell + 1]]; ++i)
    if (const auto found = copies.find(soup.vertices[i]); found != copies.end())
      soup.vertices[i] = found->second;
}

using Loops = std::vector<std::vector<std::uint32_t>>;

/// A facet in two pieces, as its two cells have them: the first, the door, is the same in both; of the
/// second, the other cell has a finer division, so that there are walls that coincide in the plane of the
/// door.
std::pair<Loops, Loops> pieces(Cell_soup<2>& soup, const std::vector<std::uint32_t>& loop) {
  const std::uint32_t a = loop[0], b = loop[1], m = static_cast<std::uint32_t>(soup.points.size()), n = m + 1;
  soup.points.push_back(combination<2>(soup.points[a], soup.points[b], 0.5));
  soup.points.push_back(combination<2>(soup.points[m], soup.points[b], 0.5));
  return {{{a, m}, {m, b}}, {{b, n}, {n, m}, {m, a}}};
}

std::pair<Loops, Loops> pieces(Cell_soup<3>& soup, const std::vector<std::uint32_t>& loop) {
  std::vector<std::uint32_t> rest(loop);
  rest.erase(rest.begin() + 1);
  if (rest.size() < 3) return {{loop}, {{loop.rbegin(), loop.rend()}}};
  const auto centre = static_cast<std::uint32_t>(soup.points.size());
  soup.points.push_back(combination<3>(soup.points[rest[0]],
                                       combination<3>(soup.points[rest[1]], soup.points[rest[2]], 0.5), 0.5));
  Loops others{{loop[2], loop[1], loop[0]}};
  for (std::size_t i = 0; i < rest.size(); ++i)
    others.push_back({rest[(i + 1) % rest.size()], rest[i], centre});
  return {{{loop[0], loop[1], loop[2]}, rest}, others};
}

/// A slit beside a door: where a facet parts two cells.
template <int D>
void slit(Cell_soup<D>& soup, std::size_t facet) {
  const std::uint32_t opposite = glue(soup).opposite[facet];
  if (opposite == no_facet) return;
  Cell_soup<D> result;
  result.points = soup.points;
  const std::vector<std::uint32_t> loop(soup.facet(facet).begin(), soup.facet(facet).end());
  const auto [own, others] = pieces(result, loop);
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) {
      if (f != facet && f != opposite)
        result.add_facet(soup.facet(f), soup.impassable[f]);
      else
        for (const auto& piece : f == facet ? own : others) result.add_facet(piece, soup.impassable[f]);
    }
    result.end_cell(soup.solid[c]);
  }
  soup = std::move(result);
}

template <int D>
void drop(Cell_soup<D>& soup, std::size_t dropped) {
  Cell_soup<D> rest;
  rest.points = soup.points;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    if (c == dropped) continue;
    for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f)
      rest.add_facet(soup.facet(f), soup.impassable[f]);
    rest.end_cell(soup.solid[c]);
  }
  soup = std::move(rest);
}

template <int D>
void alter(Cell_soup<D>& soup, Decoder& in) {
  const std::size_t kind = in.below(9), cell = in.below(soup.cell_count()),
                    facet = in.below(soup.facet_count());
  const std::vector<std::uint32_t> loop(soup.facet(facet).begin(), soup.facet(facet).end());
  if (*std::max_element(loop.begin(), loop.end()) >= soup.points.size()) return;  // already broken
  switch (kind) {
    case 0:
      soup.impassable[facet] ^= 1;
      break;
    case 1:
      soup.solid[cell] ^= 1;
      break;
    case 2:  // walls that coincide
      for (std::size_t c = 0; c < soup.cell_count(); ++c)
        if (soup.cell_begin[c] <= facet && facet < soup.cell_begin[c + 1]) return part<D>(soup, c, loop);
      break;
    case 3:
      part<D>(soup, cell, std::span(loop).first(1));
      break;
    case 4:
      if (soup.cell_count() > 1) drop(soup, cell);
      break;
    case 5:
      for (double& x : soup.points[loop[0]]) x += static_cast<std::int8_t>(in.byte()) / 16.0;
      break;
    case 6:
      soup.vertices[soup.facet_begin[facet]] = static_cast<std::uint32_t>(in.below(soup.points.size() + 1));
      break;
    case 7:
      reads([&] { slit(soup, facet); }, {Error_code::input, Error_code::not_certified});
      break;
    default:
      std::reverse(soup.vertices.begin() + soup.facet_begin[facet],
                   soup.vertices.begin() + soup.facet_begin[facet + 1]);
  }
}

bool are_alike(const Certificate& a, const Certificate& b) {
  return a.cells == b.cells && a.facets == b.facets && a.ridges == b.ridges && a.vertices == b.vertices &&
         a.solid_cells == b.solid_cells && a.walls == b.walls && a.boundary_facets == b.boundary_facets &&
         a.membranes == b.membranes && a.components == b.components &&
         a.pinched_vertices == b.pinched_vertices;
}

template <int D>
void build_and_move(Decoder& in) {
  Cell_soup<D> soup = base<D>(in);
  const std::uint8_t choices = in.byte();
  for (std::size_t n = in.below(8); n > 0; --n) alter(soup, in);
  Build_options options;
  options.duplicates = static_cast<Duplicate_vertices>(choices % 3);
  options.split = choices / 3 % 2 == 0;
  options.keep_map = choices / 6 % 2 == 0;
  Build_report report;
  std::optional<Environment<D>> environment;
  const auto codes = {Error_code::input, Error_code::not_certified};
  if (!reads([&] { environment.emplace(Environment<D>::build(soup, options, &report)); }, codes)) return;
  demand(are_alike(environment->certify(), report.certificate), "certified again, it is another environment");
  const Cell_soup<D> own = environment->soup();
  Build_report again;
  Environment<D>::build(own, {options.duplicates, false, false}, &again);
  demand(are_alike(again.certificate, report.certificate), "its own soup makes another environment");
  constexpr std::size_t most_motions = 8;
  move_about(environment->snapshot(), own, in, most_motions);
}

}  // namespace

void build(std::string_view bytes) {
  Decoder in(bytes);
  if (in.flag())
    build_and_move<3>(in);
  else
    build_and_move<2>(in);
}

}  // namespace cellwalk::fuzz
