// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sweep_judge.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace cellwalk::endurance {

template <int D>
bool holds(const Lattice<D>& lattice, int bits, std::uint32_t cell, const Site<D>& x) {
  const Side* sides = lattice.sides(cell);
  return std::all_of(sides, sides + lattice.sides_of_cell(), [&](const Side& s) {
    return s.outwards * (lattice.families()[s.family](x) - (Whole{s.plane} << bits)) <= 0;
  });
}

template <int D>
Sweep_judge<D>::Sweep_judge(const Lattice<D>& lattice, int bits)
    : lattice_(lattice), bits_(bits), walks_(lattice, bits) {
  for (std::uint32_t c = 0; c < lattice.cell_count(); ++c) {
    if (!lattice.is_solid(c)) continue;
    solid_.push_back(c);
    for (std::size_t i = 0; i < lattice.sides_of_cell(); ++i) {
      const auto s = static_cast<std::uint32_t>(c * lattice.sides_of_cell() + i);
      if (lattice.neighbour(s) == no_cell || lattice.is_solid(lattice.neighbour(s))) inner_.push_back(s);
    }
  }
}

template <int D>
void Sweep_judge<D>::see(const Edge_sites<D>& move) {
  const auto& families = lattice_.families();
  for (std::size_t j = 0; j < families.size(); ++j) {
    at_a_[j] = families[j](move.a);
    at_b_[j] = families[j](move.b);
    at_q_[j] = families[j](move.q);
  }
}

/// True if all corners of the triangle are on the outside of one side, or on it.
template <int D>
bool Sweep_judge<D>::misses(std::uint32_t cell) const {
  const Side* sides = lattice_.sides(cell);
  return std::any_of(sides, sides + lattice_.sides_of_cell(), [&](const Side& s) {
    return outside(s, at_a_[s.family]) >= 0 && outside(s, at_b_[s.family]) >= 0 &&
           outside(s, at_q_[s.family]) >= 0;
  });
}

/// Cuts off what is outside of a line; false if nothing is strictly inside.
template <int D>
bool Sweep_judge<D>::clip(Polygon& polygon, const Line& line) {
  std::array<int, most_corners> signs;
  bool any_inside = false, any_outside = false;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Wide value = line.at(polygon.corners[i]);
    signs[i] = (value > 0) - (value < 0);
    any_inside |= value < 0;
    any_outside |= value > 0;
  }
  if (!any_inside) return false;
  if (!any_outside) return true;
  Polygon rest;
  const auto add = [&rest](const Corner& corner, const Line& edge) {
    rest.corners[rest.size] = corner;
    rest.edges[rest.size++] = edge;
  };
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const int here = signs[i], next = signs[i + 1 == polygon.size ? 0 : i + 1];
    const Line& edge = polygon.edges[i];
    if (here <= 0) add(polygon.corners[i], here == 0 && next > 0 ? line : edge);
    if (here * next >= 0) continue;
    add(crossing(edge, line), next > 0 ? line : edge);
  }
  polygon = rest;
  return true;
}

/// Notes the first time at which the edge meets the inside of a cell, or of its side `without`, in whose
/// plane the triangle lies.
template <int D>
void Sweep_judge<D>::meet(std::uint32_t cell, std::size_t without) {
  Polygon polygon;
  for (const Corner& corner : triangle_corners) {
    polygon.corners[polygon.size] = corner;
    polygon.edges[polygon.size] = triangle_sides[polygon.size];
    ++polygon.size;
  }
  const Side* sides = lattice_.sides(cell);
  for (std::size_t i = 0; i < lattice_.sides_of_cell(); ++i) {
    if (i == without) continue;
    const Side& s = sides[i];
    const Whole a = outside(s, at_a_[s.family]), b = outside(s, at_b_[s.family]),
                q = outside(s, at_q_[s.family]);
    if (!clip(polygon, {a - q, b - a, q})) return;
  }
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Time time = polygon.corners[i].time();
    if (time.denominator > 0 && time < first_) first_ = time;
  }
}

template <int D>
Sweep_truth Sweep_judge<D>::judge(std::uint32_t cell, const Edge_sites<D>& move) {
  see(move);
  Sweep_truth truth;
  const Whole mask = (Whole{1} << bits_) - 1;
  unsigned in_planes = 0;  // that hold the triangle
  for (std::size_t j = 0; j < lattice_.families().size(); ++j) {
    const bool a_on = (at_a_[j] & mask) == 0, b_on = (at_b_[j] & mask) == 0, q_on = (at_q_[j] & mask) == 0;
    truth.degenerate |= a_on || b_on || q_on;
    if (q_on && at_a_[j] == at_q_[j] && at_b_[j] == at_q_[j]) in_planes |= 1u << j;
  }
  const Walk_truth& walk = walks_.follow(cell, move.a, move.b);
  first_ = {1, 1};
  if (is_flat(move)) {
    // The edge covers nothing but what its end passes.
    truth.degenerate = true;
    first_ = walk.end;
    truth.is_free = walk.arrives;
  } else {
    for (std::size_t i = 0; i < D; ++i) {
      const Whole most = Whole{lattice_.size()[i]} << bits_;
      const Whole over = std::max(move.b[i] - most, -move.b[i]);
      const Whole way = std::abs(move.b[i] - move.a[i]);
      if (over > 0 && Time{way - over, way} < first_) first_ = {way - over, way};
    }
    if (in_planes == 0) {
      for (const std::uint32_t c : solid_)
        if (!misses(c)) meet(c, lattice_.sides_of_cell());
    } else {
      for (const std::uint32_t s : inner_) {
        const Side& side = lattice_.side(s);
        if ((in_planes >> side.family & 1u) && outside(side, at_q_[side.family]) == 0)
          meet(lattice_.cell_of(s), s % lattice_.sides_of_cell());
      }
    }
    truth.is_free = first_ == Time{1, 1};
  }
  truth.end = first_;
  truth.by_vertex = !walk.arrives && walk.end == first_;
  if (!walk.arrives && walk.end < first_)
    throw std::logic_error("the end of an edge is blocked before the edge");
  return truth;
}

template <int D>
bool is_passed(const World<D>& world, const Site<D>& x, const Site<D>& q, std::uint32_t cell,
               std::uint32_t last, const Chain& chain, std::vector<Time>* places) {
  const Lattice<D>& lattice = world.lattice;
  Time low{0, 1};  // where the segment passes the facet
  for (const Half_facet half : chain) {
    if (to_index(half) >= world.side_of.size()) return false;
    const std::uint32_t number = world.side_of[to_index(half)];
    if (number == no_cell || lattice.cell_of(number) != cell || lattice.is_wall(number)) return false;
    Time high{1, 1};
    const auto keep = [&](Whole at_x, Whole at_q) {  // where the affine function is at most 0
      if (at_x > 0 && at_q > 0) return false;
      if (at_x > 0) low = std::max(low, Time{at_x, at_x - at_q});
      if (at_q > 0) high = std::min(high, Time{-at_x, at_q - at_x});
      return !(high < low);
    };
    for (std::size_t i = 0; i < lattice.sides_of_cell(); ++i) {
      const Side& s = lattice.sides(cell)[i];
      const Family& family = lattice.families()[s.family];
      const Whole plane = Whole{s.plane} << world.bits;
      const Whole at_x = s.outwards * (family(x) - plane), at_q = s.outwards * (family(q) - plane);
      if (!keep(at_x, at_q)) return false;
      if (cell * lattice.sides_of_cell() + i == number && !keep(-at_x, -at_q)) return false;
    }
    if (places) places->push_back(low);
    cell = lattice.side(number).beyond;
  }
  return cell == last;
}

namespace {

/// True if the point is on the segment, up to rounding.
template <int D>
bool is_near(const Point<D>& x, const Point<D>& p, const Point<D>& q) {
  const Vector<D> edge = q - p, to_x = x - p;
  double size = 0;
  for (std::size_t i = 0; i < D; ++i) size = std::max({size, std::abs(p[i]), std::abs(q[i])});
  const double square = dot(edge, edge);
  const double share = square > 0 ? std::clamp(dot(to_x, edge) / square, 0.0, 1.0) : 0;
  return length(to_x - share * edge) <= 0x1p-40 * size;
}

}  // namespace

template <int D>
Sweep_fault fault_of(const World<D>& world, const Sweep_truth& truth, const Edge_sites<D>& move,
                     const Particle<D>& q, const Sweep_result<D>& result) {
  const auto& snapshot = world.snapshot();
  if (result.contact) {
    const Contact<D>& contact = *result.contact;
    if (truth.is_free) return Sweep_fault::false_contact;
    if (!is_rounded(contact.time, truth.end)) return Sweep_fault::wrong_time;
    const Point<D> from = world.place(move.a);
    if (!is_near<D>(contact.point, from + contact.time * (world.place(move.b) - from), q.position))
      return Sweep_fault::wrong_time;
    const bool is_by_vertex = contact.body == Body_feature::vertex;
    if (is_by_vertex ? !truth.by_vertex && !truth.may_be_by_vertex : truth.by_vertex)
      return Sweep_fault::wrong_feature;
    const std::uint32_t number =
        to_index(contact.facet) < world.side_of.size() ? world.side_of[to_index(contact.facet)] : no_cell;
    return number != no_cell && world.lattice.is_wall(number) ? Sweep_fault::none : Sweep_fault::wrong_wall;
  }
  if (!truth.is_free) return Sweep_fault::false_free;
  const std::uint32_t cell = snapshot.index(result.p.cell);
  if (result.p.position != world.place(move.b) || world.lattice.is_solid(cell) ||
      !holds(world.lattice, world.bits, cell, move.b))
    return Sweep_fault::wrong_cell;
  return is_passed(world, move.b, move.q, cell, snapshot.index(q.cell), result.chain)
             ? Sweep_fault::none
             : Sweep_fault::wrong_chain;
}

#define CELLWALK_ENDURANCE_SWEEP(D)                                                                      \
  template class Sweep_judge<D>;                                                                         \
  template bool holds(const Lattice<D>&, int, std::uint32_t, const Site<D>&);                            \
  template bool is_passed(const World<D>&, const Site<D>&, const Site<D>&, std::uint32_t, std::uint32_t, \
                          const Chain&, std::vector<Time>*);                                             \
  template Sweep_fault fault_of(const World<D>&, const Sweep_truth&, const Edge_sites<D>&,               \
                                const Particle<D>&, const Sweep_result<D>&);
CELLWALK_ENDURANCE_SWEEP(2)
CELLWALK_ENDURANCE_SWEEP(3)
#undef CELLWALK_ENDURANCE_SWEEP

}  // namespace cellwalk::endurance
