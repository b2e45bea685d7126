// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cellwalk::endurance {
namespace {

/// Matrices of positive determinant whose columns are orthogonal and of one length.
template <int D>
struct Turn {
  Whole length;
  std::array<std::array<Whole, D>, D> columns;
};
const std::vector<Turn<2>> turns_2{{1, {{{1, 0}, {0, 1}}}},
                                   {5, {{{3, 4}, {-4, 3}}}},
                                   {5, {{{-4, 3}, {-3, -4}}}},
                                   {13, {{{5, 12}, {-12, 5}}}},
                                   {17, {{{-8, -15}, {15, -8}}}}};
const std::vector<Turn<3>> turns_3{{1, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
                                   {3, {{{1, 2, 2}, {2, 1, -2}, {-2, 2, -1}}}},
                                   {3, {{{2, -1, 2}, {2, 2, -1}, {-1, 2, 2}}}},
                                   {7, {{{2, 3, 6}, {3, -6, 2}, {6, 2, -3}}}},
                                   {9, {{{1, 4, 8}, {4, 7, -4}, {-8, 4, -1}}}}};
template <int D>
const std::vector<Turn<D>>& turns();
template <>
const std::vector<Turn<2>>& turns<2>() {
  return turns_2;
}
template <>
const std::vector<Turn<3>>& turns<3>() {
  return turns_3;
}

template <int D>
Whole determinant(const std::array<std::array<Whole, D>, D>& c) {
  if constexpr (D == 2) {
    return c[0][0] * c[1][1] - c[0][1] * c[1][0];
  } else {
    Whole sum = 0;
    for (std::size_t i = 0; i < 3; ++i)
      sum += c[0][i] * (c[1][(i + 1) % 3] * c[2][(i + 2) % 3] - c[1][(i + 2) % 3] * c[2][(i + 1) % 3]);
    return sum;
  }
}

template <int D>
Environment<D> build(const Cell_soup<D>& soup) {
  Build_options options;
  options.split = false;
  options.keep_map = false;
  return Environment<D>::build(soup, options);
}

/// Cells that share something, as one list after the other.
template <int D>
struct Star {
  std::vector<std::uint32_t> cells;
  std::vector<std::uint32_t> points;  ///< what they share: corners of the lattice, sorted
};

/// The stars of all edges and vertices of the lattice.
template <int D>
std::vector<Star<D>> stars_of(const Lattice<D>& lattice) {
  std::vector<Star<D>> stars(lattice.point_count());
  std::vector<std::pair<std::array<std::uint32_t, 2>, std::uint32_t>> edges;
  for (std::uint32_t s = 0; s < lattice.side_count(); ++s) {
    const auto& loop = lattice.loop(s);
    const std::uint32_t cell = lattice.cell_of(s);
    for (std::size_t v = 0; v < loop.size(); ++v) {
      stars[loop[v]].cells.push_back(cell);
      stars[loop[v]].points = {loop[v]};
      const std::uint32_t next = loop[(v + 1) % loop.size()];
      if (D == 3) edges.push_back({{std::min(loop[v], next), std::max(loop[v], next)}, cell});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (e == 0 || edges[e].first != edges[e - 1].first)
      stars.push_back({{}, {edges[e].first[0], edges[e].first[1]}});
    stars.back().cells.push_back(edges[e].second);
  }
  for (Star<D>& star : stars) {
    std::sort(star.cells.begin(), star.cells.end());
    star.cells.erase(std::unique(star.cells.begin(), star.cells.end()), star.cells.end());
  }
  return stars;
}

/// The free cells of a star linked with one of them, through sides that hold what they share.
template <int D>
std::vector<std::uint32_t> linked_in(const Lattice<D>& lattice, const Star<D>& star, std::uint32_t first) {
  std::vector<std::uint32_t> linked{first};
  for (std::size_t at = 0; at < linked.size(); ++at)
    for (std::size_t i = 0; i < lattice.sides_of_cell(); ++i) {
      const std::size_t s = linked[at] * lattice.sides_of_cell() + i;
      const std::uint32_t beyond = lattice.side(s).beyond;
      if (beyond == no_cell || std::find(linked.begin(), linked.end(), beyond) != linked.end()) continue;
      const auto& loop = lattice.loop(s);
      if (std::all_of(star.points.begin(), star.points.end(),
                      [&](std::uint32_t p) { return std::find(loop.begin(), loop.end(), p) != loop.end(); }))
        linked.push_back(beyond);
    }
  return linked;
}

}  // namespace

template <int D>
Placement<D> random_placement(Placing placing, int bits, int most_cells, Draw& draw) {
  Placement<D> place;
  const auto& turned = turns<D>()[draw.whole(static_cast<std::uint32_t>(turns<D>().size()))];
  place.columns = turned.columns;
  if (placing == Placing::similarity) place.length = turned.length;
  if (placing == Placing::affine && draw.whole(4) > 0) {
    do
      for (auto& column : place.columns)
        for (Whole& x : column) x = draw.whole(Whole{-3}, Whole{3});
    while (determinant<D>(place.columns) <= 0);
  }
  // Sums of coordinates stay below 2^52: 3 columns of at most 15, and an origin up to eight worlds away.
  Whole most = 0;
  for (const auto& column : place.columns)
    for (const Whole x : column) most = std::max(most, std::abs(x));
  const Whole reach = most * D * most_cells << bits;
  if (draw.whole(2) == 0)
    for (Whole& x : place.origin) x = draw.whole(-8 * reach, 8 * reach);
  if (9 * reach > Whole{1} << 52) throw std::logic_error("coordinates of a world are too long");
  const int unit = draw.whole(2) == 0 ? 0 : static_cast<int>(draw.whole(Whole{-20}, Whole{20}));
  place.scale = std::ldexp(1.0, unit - bits);
  return place;
}

template <int D>
World<D>::World(Lattice<D> cells, const Placement<D>& placed, int bits_of_cell)
    : lattice(std::move(cells)),
      place(placed),
      bits(bits_of_cell),
      environment(build(soup_of(lattice, place, bits))),
      locator(environment.snapshot()) {
  side_of.assign(snapshot().half_facet_slots(), no_cell);
  const auto key = [](std::vector<std::uint32_t> loop) {
    std::sort(loop.begin(), loop.end());
    return loop;
  };
  for (std::uint32_t c = 0; c < lattice.cell_count(); ++c)
    for (std::size_t i = 0; i < lattice.sides_of_cell(); ++i) {
      const Half_facet half = Snapshot<D>::half_facet(snapshot().cell(c), i);
      const auto loop = key(snapshot().loop(half));
      for (std::size_t k = 0; k < lattice.sides_of_cell(); ++k) {
        const auto side = static_cast<std::uint32_t>(c * lattice.sides_of_cell() + k);
        if (key(lattice.loop(side)) == loop) side_of[to_index(half)] = side;
      }
      if (side_of[to_index(half)] == no_cell) throw std::logic_error("a facet is none of the lattice");
    }
  // The gradient of a family in space: row vectors times the inverse of the columns, up to a factor.
  const auto& c = place.columns;
  for (std::size_t j = 0; j < lattice.families().size(); ++j) {
    const Family& f = lattice.families()[j];
    const auto cofactors = [&](int i) {
      Vector<D> v{};
      if constexpr (D == 2) {
        const auto& other = c[static_cast<std::size_t>(1 - i)];
        const double sign = i == 0 ? 1 : -1;
        v = {sign * static_cast<double>(other[1]), -sign * static_cast<double>(other[0])};
      } else {
        const auto &a = c[static_cast<std::size_t>(i + 1) % 3], &b = c[static_cast<std::size_t>(i + 2) % 3];
        for (std::size_t r = 0; r < 3; ++r)
          v[r] = static_cast<double>(a[(r + 1) % 3] * b[(r + 2) % 3] - a[(r + 2) % 3] * b[(r + 1) % 3]);
      }
      return v;
    };
    normals[j] = normalized(f.k < 0 ? cofactors(f.i) : cofactors(f.i) - cofactors(f.k));
  }
}

template <int D>
Cell_soup<D> soup_of(const Lattice<D>& lattice, const Placement<D>& place, int bits) {
  Cell_soup<D> soup;
  for (std::size_t p = 0; p < lattice.point_count(); ++p) {
    Site<D> x;
    for (std::size_t i = 0; i < D; ++i) x[i] = Whole{lattice.point(p)[i]} << bits;
    soup.points.push_back(place(x));
  }
  for (std::uint32_t c = 0; c < lattice.cell_count(); ++c) {
    for (std::size_t i = 0; i < lattice.sides_of_cell(); ++i) {
      const std::size_t s = c * lattice.sides_of_cell() + i;
      soup.add_facet(lattice.loop(s), lattice.is_wall(s));
    }
    soup.end_cell(lattice.is_solid(c));
  }
  return soup;
}

template <int D>
std::array<int, D> random_size(Draw& draw) {
  std::array<int, D> size;
  for (int& n : size) n = 2 + static_cast<int>(draw.whole(3));
  return size;
}

template <int D>
void add_random_walls(Lattice<D>& lattice, Walls walls, Draw& draw) {
  constexpr std::array<double, 4> solid_shares{0.05, 0.1, 0.2, 0.35}, membrane_shares{0, 0.05, 0.15, 0.3};
  const double part = walls == Walls::few ? 0.25 : 1;
  const double solid = part * solid_shares[draw.whole(4)];
  const auto per_cube =
      static_cast<std::uint32_t>(lattice.cut() == Cut::cubes || draw.whole(2) == 0 ? 1 : (D == 2 ? 2 : 6));
  const auto cells = static_cast<std::uint32_t>(lattice.cell_count());
  for (std::uint32_t c = 0; c < cells; c += per_cube) {
    if (!draw.chance(solid)) continue;
    for (std::uint32_t k = c; k < c + per_cube; ++k) lattice.make_solid(k);
  }
  if (walls == Walls::solid) return;
  const double scattered = part * membrane_shares[draw.whole(4)];
  for (std::size_t s = 0; s < lattice.side_count(); ++s)
    if (lattice.opposite(s) > s && draw.chance(scattered)) lattice.make_wall(s);
  for (std::uint32_t planes = draw.whole(4); planes > 0; --planes) {
    const Side chosen = lattice.side(draw.whole(static_cast<std::uint32_t>(lattice.side_count())));
    for (std::size_t s = 0; s < lattice.side_count(); ++s)
      if (lattice.opposite(s) > s && lattice.side(s).family == chosen.family &&
          lattice.side(s).plane == chosen.plane && draw.chance(0.7 * part))
        lattice.make_wall(s);
  }
}

template <int D>
void link_free_cells(Lattice<D>& lattice) {
  const auto stars = stars_of(lattice);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Star<D>& star : stars) {
      const auto first =
          std::find_if(star.cells.begin(), star.cells.end(), [&](auto c) { return !lattice.is_solid(c); });
      if (first == star.cells.end()) continue;
      const auto linked = linked_in(lattice, star, *first);
      for (const std::uint32_t c : star.cells)
        if (!lattice.is_solid(c) && std::find(linked.begin(), linked.end(), c) == linked.end()) {
          lattice.make_solid(c);
          changed = true;
        }
    }
  }
}

#define CELLWALK_ENDURANCE_WORLD(D)                                           \
  template Placement<D> random_placement<D>(Placing, int, int, Draw&);        \
  template struct World<D>;                                                   \
  template Cell_soup<D> soup_of(const Lattice<D>&, const Placement<D>&, int); \
  template std::array<int, D> random_size<D>(Draw&);                          \
  template void add_random_walls(Lattice<D>&, Walls, Draw&);                  \
  template void link_free_cells(Lattice<D>&);
CELLWALK_ENDURANCE_WORLD(2)
CELLWALK_ENDURANCE_WORLD(3)
#undef CELLWALK_ENDURANCE_WORLD

}  // namespace cellwalk::endurance
