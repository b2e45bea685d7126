// SPDX-License-Identifier: LGPL-3.0-or-later
#include "membrane_judge.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace cellwalk::endurance {
namespace {

int sign(Wide x) { return (x > 0) - (x < 0); }

}  // namespace

template <int D>
Membrane_judge<D>::Membrane_judge(const World<D>& world)
    : world_(world), lattice_(world.lattice), walks_(world.lattice, world.bits) {
  std::set<std::array<std::uint32_t, 2>> edges;
  for (std::uint32_t s = 0; s < lattice_.side_count(); ++s) {
    const std::uint32_t other = lattice_.opposite(s);
    if (lattice_.is_wall(s) && (other == no_cell || s < other)) walls_.push_back(s);
    const auto& loop = lattice_.loop(s);
    if (D == 3)
      for (std::size_t v = 0; v < loop.size(); ++v) {
        const std::uint32_t next = loop[(v + 1) % loop.size()];
        edges.insert({std::min(loop[v], next), std::max(loop[v], next)});
      }
  }
  edges_.assign(edges.begin(), edges.end());
}

template <int D>
bool Membrane_judge<D>::see(const Edge_sites<D>& move, Sweep_truth& truth) {
  const auto& families = lattice_.families();
  const Whole mask = world_.cell_units() - 1;
  bool in_plane = false;
  for (std::size_t j = 0; j < families.size(); ++j) {
    at_a_[j] = families[j](move.a);
    at_b_[j] = families[j](move.b);
    at_q_[j] = families[j](move.q);
    const bool q_on = (at_q_[j] & mask) == 0;
    truth.degenerate |= q_on || (at_a_[j] & mask) == 0 || (at_b_[j] & mask) == 0;
    in_plane |= q_on && at_a_[j] == at_q_[j] && at_b_[j] == at_q_[j];
  }
  return in_plane;
}

/// The edge keeps its sides. Its end makes it longer, or comes back along it, and goes on from the other end.
template <int D>
void Membrane_judge<D>::judge_flat(const Edge_cells& edge, const Edge_sites<D>& move, Sweep_truth& truth) {
  truth.degenerate = true;
  std::size_t i = 0;
  while (i + 1 < D && move.a[i] == move.q[i]) ++i;
  const Whole edge_way = move.q[i] - move.a[i], way = move.b[i] - move.a[i];
  const bool comes_back = edge_way != 0 && way != 0 && (edge_way > 0) == (way > 0);
  if (!comes_back) {
    first_ = walks_.follow(edge.p, move.a, move.b).end;
  } else if (std::abs(way) > std::abs(edge_way)) {
    const Time end = walks_.follow(edge.q, move.q, move.b).end;
    first_ = {std::abs(edge_way) * end.denominator + end.numerator * (std::abs(way) - std::abs(edge_way)),
              std::abs(way) * end.denominator};
  }
}

template <int D>
Line Membrane_judge<D>::line_of(const Side& side) const {
  const std::size_t j = side.family;
  const Whole q = at_q_[j] - (Whole{side.plane} << world_.bits);
  return {side.outwards * (at_a_[j] - at_q_[j]), side.outwards * (at_b_[j] - at_a_[j]), side.outwards * q};
}

/// The part of a line inside of the triangle, if it is more than a point, and no side of it.
template <int D>
auto Membrane_judge<D>::in_triangle(const Line& line) const -> std::optional<Piece> {
  std::array<int, 3> signs;
  for (std::size_t v = 0; v < 3; ++v) signs[v] = sign(line.at(triangle_corners[v]));
  if (std::find(signs.begin(), signs.end(), 1) == signs.end() ||
      std::find(signs.begin(), signs.end(), -1) == signs.end())
    return {};
  std::array<Corner, 2> ends;
  std::size_t found = 0;
  for (std::size_t v = 0; v < 3; ++v) {
    if (signs[v] == 0) ends[found++] = triangle_corners[v];
    if (signs[v] * signs[(v + 1) % 3] < 0) ends[found++] = crossing(line, triangle_sides[v]);
  }
  return Piece{ends[0], ends[1]};
}

/// Cuts off what is outside of another line; false if nothing is strictly inside.
template <int D>
bool Membrane_judge<D>::cut(Piece& piece, const Line& line, const Line& by) {
  const int from = sign(by.at(piece.from)), to = sign(by.at(piece.to));
  if (from >= 0 && to >= 0) return false;
  if (from > 0) piece.from = crossing(line, by);
  if (to > 0) piece.to = crossing(line, by);
  return true;
}

template <int D>
void Membrane_judge<D>::note(const Piece& piece) {
  for (const Corner& end : {piece.from, piece.to})
    if (end.u > 0 && end.time() < first_) first_ = end.time();
}

/// Walls in whose interior polygons have a common side.
template <int D>
void Membrane_judge<D>::meet_walls() {
  for (const std::uint32_t wall : walls_) {
    const Line line = line_of(lattice_.side(wall));
    if (line.u == 0 && line.w == 0) continue;
    std::optional<Piece> piece = in_triangle(line);
    if (!piece) continue;
    const std::size_t first = wall / lattice_.sides_of_cell() * lattice_.sides_of_cell();
    bool is_met = true;
    for (std::size_t s = first; s < first + lattice_.sides_of_cell() && is_met; ++s)
      if (s != wall && lattice_.side(s).family != lattice_.side(wall).family)
        is_met = cut(*piece, line, line_of(lattice_.side(s)));
    if (is_met) note(*piece);
  }
}

/// Edges of the lattice in the plane of the triangle, in which polygons have a common side.
template <int D>
void Membrane_judge<D>::meet_edges(const Edge_sites<D>& move) {
  Site<D> a = move.a, b = move.b;
  for (std::size_t i = 0; i < D; ++i) {
    a[i] -= move.q[i];
    b[i] -= move.a[i];
  }
  const auto minor = [](const Site<D>& x, const Site<D>& y, std::size_t i, std::size_t k) {
    return x[i] * y[k] - x[k] * y[i];
  };
  std::size_t i = 0, k = 1;
  if (minor(a, b, i, k) == 0) k = 2;
  if (minor(a, b, i, k) == 0) i = 1;
  const Whole area = minor(a, b, i, k);
  const std::size_t other = 3 - i - k;
  const auto place = [&](std::uint32_t v) -> std::optional<Corner> {
    Site<D> x;
    for (std::size_t axis = 0; axis < D; ++axis)
      x[axis] = (Whole{lattice_.point(v)[axis]} << world_.bits) - move.q[axis];
    const Corner corner{minor(x, b, i, k), minor(a, x, i, k), area};
    if (Wide(corner.u) * a[other] + Wide(corner.w) * b[other] != Wide(x[other]) * area) return {};
    return area > 0 ? corner : Corner{-corner.u, -corner.w, -area};
  };
  std::vector<std::optional<Corner>> places(lattice_.point_count());
  std::size_t in_plane = 0;
  for (std::uint32_t v = 0; v < places.size(); ++v) {
    places[v] = place(v);
    in_plane += places[v].has_value();
  }
  if (in_plane < 2) return;
  for (const auto& [v, w] : edges_)
    if (places[v] && places[w]) meet_edge(v, w, {*places[v], *places[w]});
}

template <int D>
void Membrane_judge<D>::meet_edge(std::uint32_t v, std::uint32_t w, const Piece& whole) {
  const auto& families = lattice_.families();
  const auto value = [&](std::size_t j, std::uint32_t point) {
    const auto x = lattice_.point(point);
    return x[static_cast<std::size_t>(families[j].i)] -
           (families[j].k < 0 ? 0 : x[static_cast<std::size_t>(families[j].k)]);
  };
  Planes planes{}, before{};
  unsigned on = 0;
  Line line{0, 0, 0};
  bool along_first = true;  // the edge a - q leads off it, and else b - a
  for (std::size_t j = 0; j < families.size(); ++j) {
    before[j] = static_cast<std::int16_t>(std::min(value(j, v), value(j, w)));
    if (value(j, v) != value(j, w)) continue;
    on |= 1u << j;
    planes[j] = before[j];
    line = {at_a_[j] - at_q_[j], at_b_[j] - at_a_[j], at_q_[j] - (Whole{planes[j]} << world_.bits)};
    along_first = line.u != 0;
  }
  Piece piece = whole;
  for (const Line& side : triangle_sides)
    if (!cut(piece, line, side)) return;
  Values ways{};
  for (std::size_t j = 0; j < families.size(); ++j) {
    ways[j] = along_first ? at_a_[j] - at_q_[j] : at_b_[j] - at_a_[j];
    if ((on >> j & 1u) && ways[j] > 0) --before[j];
  }
  const std::uint32_t cell = cell_with(before);
  if (cell == no_cell || lattice_.is_solid(cell) || !walks_.leads_on(cell, on, planes, ways)) note(piece);
}

template <int D>
std::uint32_t Membrane_judge<D>::cell_with(const Planes& floors) const {
  std::size_t cube = 0;
  for (std::size_t i = D; i-- > 0;) {
    if (floors[i] < 0 || floors[i] >= lattice_.size()[i]) return no_cell;
    cube = cube * static_cast<std::size_t>(lattice_.size()[i]) + static_cast<std::size_t>(floors[i]);
  }
  const std::size_t cells_of_cube = lattice_.cut() == Cut::cubes ? 1 : (D == 2 ? 2 : 6);
  for (std::size_t c = cube * cells_of_cube; c < (cube + 1) * cells_of_cube; ++c) {
    const auto& own = lattice_.floors(static_cast<std::uint32_t>(c));
    bool equal = true;
    for (std::size_t j = 0; j < lattice_.families().size(); ++j) equal = equal && own[j] == floors[j];
    if (equal) return static_cast<std::uint32_t>(c);
  }
  return no_cell;
}

/// True if all pieces of the edge from p to q that lie in planes of facets lead off into the direction, from
/// the cells of its chain. (Others lie inside of cells.)
template <int D>
bool Membrane_judge<D>::leads_off(const Edge_cells& edge, const Site<D>& p, const Site<D>& q,
                                  const Values& ways) {
  const auto& families = lattice_.families();
  Planes planes{};
  unsigned on = 0;
  std::vector<Time> cuts{{0, 1}, {1, 1}};  // between which the edge is in the same facets
  const Whole unit = world_.cell_units();
  for (std::size_t j = 0; j < families.size(); ++j) {
    const Whole at_p = families[j](p), way = families[j](q) - at_p;
    if (way == 0 && (at_p & (unit - 1)) == 0) {
      on |= 1u << j;
      planes[j] = static_cast<std::int16_t>(at_p >> world_.bits);
    }
    for (Whole k = std::min(at_p, at_p + way) >> world_.bits; k << world_.bits <= std::max(at_p, at_p + way);
         ++k)
      if (const Whole to = (k << world_.bits) - at_p;
          way != 0 && (to == 0 || (to > 0) == (way > 0)) && std::abs(to) <= std::abs(way))
        cuts.push_back({std::abs(to), std::abs(way)});
  }
  if (on == 0) return true;
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<Time> places;
  if (!is_passed(world_, p, q, edge.p, edge.q, *edge.chain, &places)) return false;
  std::uint32_t cell = edge.p;
  std::size_t passed = 0;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    for (; passed < places.size() && !(cuts[c] < places[passed]); ++passed)
      cell = lattice_.side(world_.side_of[to_index((*edge.chain)[passed])]).beyond;
    if (!walks_.leads_on(cell, on, planes, ways)) return false;
  }
  return true;
}

template <int D>
bool Membrane_judge<D>::is_chain_after(const Edge_cells& edge, const Edge_sites<D>& move) {
  Sweep_truth ignored;
  if (see(move, ignored) || is_flat(move)) return true;
  Values back{};
  for (std::size_t j = 0; j < lattice_.families().size(); ++j) back[j] = at_a_[j] - at_b_[j];
  return leads_off(edge, move.b, move.q, back);
}

template <int D>
std::optional<Sweep_truth> Membrane_judge<D>::judge(const Edge_cells& edge, const Edge_sites<D>& move) {
  Sweep_truth truth;
  first_ = {1, 1};
  const bool in_plane = see(move, truth);
  const bool flat = is_flat(move);
  if (in_plane && !flat) return {};
  if (flat) {
    judge_flat(edge, move, truth);
  } else {
    Values ways{};
    for (std::size_t j = 0; j < lattice_.families().size(); ++j) ways[j] = at_b_[j] - at_a_[j];
    if (leads_off(edge, move.a, move.q, ways)) {
      meet_walls();
      if constexpr (D == 3) meet_edges(move);
    } else {
      first_ = {0, 1};
    }
  }
  truth.end = first_;
  truth.is_free = first_ == Time{1, 1};
  const Walk_truth& walk = walks_.follow(edge.p, move.a, move.b);
  truth.by_vertex = !walk.arrives && walk.end == first_;
  truth.may_be_by_vertex = walk.has_choice;
  return truth;
}

template class Membrane_judge<2>;
template class Membrane_judge<3>;

}  // namespace cellwalk::endurance
