// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walk/oracle_worlds.h"

#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/generators/slits.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "oracle/exact_world.h"
#include "oracle/seed.h"

namespace cellwalk::oracle {
namespace {

/// Parts some of the facets about a few vertices.
template <int D>
void shatter(Cell_soup<D>& soup, Random& random) {
  std::vector<std::uint8_t> is_slit(soup.facet_count());
  for (int k = 0; k < 4; ++k) {
    const auto v = static_cast<std::uint32_t>(random.below(soup.points.size()));
    const bool whole = random.below(2) == 0;
    for (std::size_t f = 0; f < soup.facet_count(); ++f)
      if (std::ranges::find(soup.facet(f), v) != soup.facet(f).end() && (whole || random.below(2) == 0))
        is_slit[f] = 1;
  }
  open_slits<D>(soup, is_slit);
}

/// Membranes and solid cells for generators that make none.
template <int D>
void add_walls(Cell_soup<D>& soup, Random& random) {
  for (auto& wall : soup.impassable) wall = random.below(12) == 0;
  for (std::size_t c = 0; c < soup.cell_count(); ++c) {
    if (random.below(25) != 0) continue;
    soup.solid[c] = 1;
    for (std::size_t f = soup.cell_begin[c]; f < soup.cell_begin[c + 1]; ++f) soup.impassable[f] = 1;
  }
}

template <int D>
Cell_soup<D> simplices(const Simplex_grid_options<D>& options) {
  if constexpr (D == 2)
    return triangle_grid(options);
  else
    return tetrahedral_grid(options);
}

}  // namespace

template <int D>
World<D> make_world(std::uint64_t i) {
  const std::uint64_t seed = reseeded(i);
  Random random(seed);
  auto mixed = mixed_lattice_world<D>(seed);
  const bool large = i / world_kinds % 2 == 1;
  mixed.cells.fill(D == 2 ? (large ? 10 : 5) : (large ? 4 : 3));
  Simplex_grid_options<D> grid;
  grid.cells.fill(D == 2 ? 6 : 3);
  grid.seed = seed;
  World<D> world;
  const auto finish = [&](const char* kind, Cell_soup<D> soup, bool is_dyadic) {
    world.name = std::string(kind) + ", world " + std::to_string(i);
    world.soup = std::move(soup);
    world.is_dyadic = is_dyadic;
    return world;
  };
  switch (i % world_kinds) {
    case 0:
      return finish("integer lattice", lattice_world(mixed), true);
    case 1:
      mixed.map = cellwalk::scaled<D>(0.125);
      return finish("1/8 lattice", lattice_world(mixed), true);
    case 2:
      mixed.map = rotated<D>();
      return finish("rotated lattice", lattice_world(mixed), true);
    case 3:
      mixed.map = rotated<D>(0.125);
      return finish("rotated 1/8 lattice", lattice_world(mixed), true);
    case 4:
      mixed.map = sheared<D>();
      return finish("sheared lattice", lattice_world(mixed), true);
    case 5:
      mixed.map = cellwalk::scaled<D>(0x1p20);
      return finish("lattice times 2^20", lattice_world(mixed), true);
    case 6:
      mixed.map = cellwalk::scaled<D>(0x1p-20);
      return finish("lattice times 2^-20", lattice_world(mixed), true);
    case 7:
      mixed.box_share = 0.6;
      mixed.simplex_share = mixed.prism_share = 0;
      mixed.merge_share = D == 2 ? 0 : large ? 0.6 : 0.1;
      mixed.membrane_share = 0.3;
      return finish("boxes", lattice_world(mixed), true);
    case 8:
      mixed.removed_share = 0.3;
      mixed.membrane_share = 0.1;
      return finish("pinched lattice", lattice_world(mixed), true);
    case 9: {
      grid.map = cellwalk::scaled<D>(large ? 1e-6 : 1e6);
      Cell_soup<D> soup = simplices(grid);
      if (large) shatter(soup, random);
      add_walls(soup, random);
      return finish("simplices of size 1e-6 or 1e6", std::move(soup), false);
    }
    case 10: {
      grid.map = cellwalk::scaled<D>(0.1);
      grid.jitter = 0.15;
      Cell_soup<D> soup = simplices(grid);
      if (large) shatter(soup, random);
      add_walls(soup, random);
      return finish("simplices in general position", std::move(soup), false);
    }
    case 11:
      mixed.cells.fill(2);
      mixed.membrane_share = 0.3;
      mixed.solid_share = mixed.removed_share = 0;
      return finish("small world of membranes", lattice_world(mixed), true);
    case 12: {
      const std::array maps{cellwalk::scaled<D>(1), rotated<D>(),      cellwalk::scaled<D>(0.125),
                            sheared<D>(),           rotated<D>(0.125), cellwalk::scaled<D>(0x1p-20)};
      mixed.map = maps[i / world_kinds % maps.size()];
      mixed.slit_share = D == 2 ? 0.12 : 0.06;
      return finish("lattice with slits", lattice_world(mixed), true);
    }
    case 13:
      mixed.box_share = 0.7;
      mixed.simplex_share = mixed.prism_share = 0;
      mixed.merge_share = D == 2 ? 0 : 0.1;
      mixed.slit_share = D == 2 ? 0.2 : 0.1;
      if (large) mixed.map = rotated<D>();
      return finish("boxes with slits", lattice_world(mixed), true);
    default:
      mixed.cells.fill(D == 2 ? 3 : 2);
      mixed.slit_share = 0.25;
      mixed.solid_share = mixed.removed_share = 0;
      return finish("small world of slits and membranes", lattice_world(mixed), true);
  }
}

template <int D>
Motion_source<D>::Motion_source(const World<D>& world, std::uint64_t seed)
    : world_(world), random_(reseeded(seed)) {
  const Facet_table table = make_facet_table(world.soup);
  for (std::uint32_t f = 0; f < table.passable.size(); ++f)
    if (!table.passable[f]) walls_.push_back(f);
  low_ = high_ = world.soup.points[world.soup.vertices[0]];
  for (std::uint32_t v : world.soup.vertices)
    for (int i = 0; i < D; ++i) {
      low_[i] = std::min(low_[i], point(v)[i]);
      high_[i] = std::max(high_[i], point(v)[i]);
    }
}

template <int D>
Motion_kind Motion_source<D>::kind(bool generic) {
  const int first_degenerate = static_cast<int>(Motion_kind::to_lattice);
  if (generic) return random_.below(3) == 0 ? Motion_kind::generic : Motion_kind::generic_short;
  return static_cast<Motion_kind>(between(first_degenerate, motion_kinds - 1));
}

/// origin + i/8 (u - origin) + j/8 (v - origin)
template <int D>
Point<D> Motion_source<D>::combine(const Point<D>& origin, const Point<D>& u, int i, const Point<D>& v,
                                   int j) const {
  return origin + (i / 8.0) * (u - origin) + (j / 8.0) * (v - origin);
}

template <int D>
Point<D> Motion_source<D>::in_box() {
  Point<D> p;
  for (int i = 0; i < D; ++i) p[i] = low_[i] + (1.1 * random_.real() - 0.05) * (high_[i] - low_[i]);
  return p;
}

/// The mean of 2, 4 or 8 corners of a cell, taken with repetition.
template <int D>
Point<D> Motion_source<D>::in_cell() {
  const Cell_soup<D>& soup = world_.soup;
  const std::size_t c = random_.below(soup.cell_count());
  const std::uint32_t facets = soup.cell_begin[c + 1] - soup.cell_begin[c];
  const int n = 2 << random_.below(3);
  Point<D> sum{};
  for (int k = 0; k < n; ++k) {
    const Loop loop = soup.facet(soup.cell_begin[c] + random_.below(facets));
    sum = sum + point(loop[random_.below(loop.size())]);
  }
  return (1.0 / n) * sum;
}

template <int D>
Point<D> Motion_source<D>::in_facet(Loop loop) {
  if constexpr (D == 2) {
    return on_edge(loop);
  } else {
    const std::size_t k = 1 + random_.below(loop.size() - 2);
    const int i = between(0, 8), j = between(0, 8 - i);
    return combine(point(loop[0]), point(loop[k]), i, point(loop[k + 1]), j);
  }
}

template <int D>
Point<D> Motion_source<D>::on_edge(Loop loop) {
  const std::size_t k = random_.below(loop.size());
  const Point<D>& u = point(loop[k]);
  return combine(u, point(loop[(k + 1) % loop.size()]), between(1, 7), u, 0);
}

template <int D>
Point<D> Motion_source<D>::start(Motion_kind kind) {
  if (is_generic(kind)) return in_box();
  if (kind == Motion_kind::in_wall_plane) {
    support_ = world_.soup.facet(walls_[random_.below(walls_.size())]);
    return in_facet(support_);
  }
  if (kind == Motion_kind::nearly) return next_to(start(Motion_kind::to_lattice));
  if (kind == Motion_kind::along_edge) {
    const Loop loop = any_facet();
    const std::size_t k = random_.below(loop.size() - 1);
    support_ = loop.subspan(k, 2);
    return on_edge(support_);
  }
  switch (random_.below(5)) {
    case 0:
      return point(any_facet()[0]);
    case 1:
      return on_edge(any_facet());
    case 2:
      return in_facet(any_facet());
    default:
      return in_cell();
  }
}

template <int D>
Point<D> Motion_source<D>::near(const Point<D>& p, double distance) {
  Point<D> q = p;
  for (int i = 0; i < D; ++i) q[i] += distance * (2 * random_.real() - 1) * (high_[i] - low_[i]);
  return q;
}

/// p moved along some axes by 2^-18 to 2^-52 of the world's size.
template <int D>
Point<D> Motion_source<D>::next_to(const Point<D>& p) {
  Point<D> q = p;
  for (int i = 0; i < D; ++i) q[i] += between(-1, 1) * std::ldexp(high_[i] - low_[i], -between(18, 52));
  return q;
}

template <int D>
Point<D> Motion_source<D>::target(Motion_kind kind, const Point<D>& from, const Point<D>& last) {
  const auto past = [&](const Point<D>& p) { return from + double(between(2, 4)) / 2 * (p - from); };
  // Half of the features are chosen nearby, so that short motions are as common as long ones.
  const auto close_facet = [&](auto&& choose) {
    Loop best = choose();
    if (random_.below(2) == 0) return best;
    for (int k = 0; k < 8; ++k) {
      const Loop other = choose();
      if (length(point(other[0]) - from) < length(point(best[0]) - from)) best = other;
    }
    return best;
  };
  const auto facet = [&] { return close_facet([&] { return any_facet(); }); };
  const auto wall = [&] {
    return close_facet([&] { return world_.soup.facet(walls_[random_.below(walls_.size())]); });
  };
  switch (kind) {
    case Motion_kind::generic:
      return in_box();
    case Motion_kind::generic_short:
      return near(from, std::ldexp(0.5, -static_cast<int>(random_.below(6))));
    case Motion_kind::to_lattice:
      return in_cell();
    case Motion_kind::to_vertex:
      return point(facet()[0]);
    case Motion_kind::to_edge:
      return on_edge(facet());
    case Motion_kind::to_facet:
      return in_facet(facet());
    case Motion_kind::to_wall:
      return in_facet(wall());
    case Motion_kind::through_vertex:
      return past(point(facet()[0]));
    case Motion_kind::through_edge:
      return past(on_edge(facet()));
    case Motion_kind::through_facet:
      return past(in_facet(facet()));
    case Motion_kind::in_wall_plane: {
      // Along a combination of two edges of the wall on which it starts.
      const Vector<D> u = point(support_[1]) - point(support_[0]);
      const Vector<D> v = point(support_.back()) - point(support_[0]);
      const int of_v = between(-16, 16), of_u = between(-16, 16);  // drawn in this order by every compiler
      return from + (of_u / 8.0) * u + (of_v / 8.0) * v;
    }
    case Motion_kind::along_edge:
      return from + (between(-32, 32) / 8.0) * (point(support_[1]) - point(support_[0]));
    case Motion_kind::nearly: {
      const int first = static_cast<int>(Motion_kind::to_lattice),
                last_kind = static_cast<int>(Motion_kind::through_facet);
      return next_to(target(static_cast<Motion_kind>(between(first, last_kind)), from, last));
    }
    case Motion_kind::backward:
      return from + (between(2, 12) / 4.0) * (last - from);
    default:
      return from;
  }
}

template World<2> make_world<2>(std::uint64_t);
template World<3> make_world<3>(std::uint64_t);
template class Motion_source<2>;
template class Motion_source<3>;

}  // namespace cellwalk::oracle
