// SPDX-License-Identifier: LGPL-3.0-or-later
#include "thick_judge.h"

#include <boost/multiprecision/cpp_int.hpp>
#ifndef __SIZEOF_FLOAT128__
#include <boost/multiprecision/cpp_bin_float.hpp>
#endif

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "hulls.h"

namespace cellwalk::endurance {
namespace {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;  // 113 bits; not of ISO C++
#else
using Quad = boost::multiprecision::cpp_bin_float_quad;
#endif
using Large = boost::multiprecision::cpp_int;

/// A time as digits / 2^shift.
struct Dyadic {
  Whole digits = 1;
  int shift = 0;

  explicit Dyadic(double t) {
    digits = static_cast<Whole>(std::ldexp(std::frexp(t, &shift), 53));
    shift = 53 - shift;
    if (digits == 0) {
      shift = 0;
      return;
    }
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(digits));
    digits >>= zeros;
    shift -= zeros;
  }
};

/// How far the hulls are apart along a direction, compared with the radius.
enum class Reach { less, equal, more, open };

/// In rounded numbers, in cells. Let u be 2^-p for numbers of p digits. Corners have coordinates below 2^4,
/// and those at a time are off by less than 2^5 u each; so differences of corners are off by less than 2^7 u,
/// and directions by less than 2^6 u of the root of `square_of_terms`. Directions that are longer than 2^-12
/// of that root are off by less than 2^18 u of themselves. Gaps between points that are nearer than 2^5 to
/// each other then differ by less than 2^24 u, and by 2^9 u for all other roundings; the margin is 2^26 u. If
/// the gap is large enough, the direction does not matter.
template <class N, int D>
Reach rounded_reach(const Hulls<N, D>& hulls, const Direction<N, D>& direction, N radius, N margin) {
  const N square = product(direction.n, direction.n);
  const N gap = hulls.gap(direction.n);
  const N more = radius + margin, less = radius - margin;
  if (gap > 0 && square > 0 && gap * gap > more * more * square) return Reach::more;
  constexpr double small = 0x1p-24;  // 2^-12 squared
  if (!(square > N(small) * direction.square_of_terms)) return Reach::open;
  return gap <= 0 || gap * gap < less * less * square ? Reach::less : Reach::open;
}

template <class N, int D>
Reach exact_reach(const Hulls<N, D>& hulls, const Direction<N, D>& direction, const N& radius) {
  const N gap = hulls.gap(direction.n);
  if (gap <= 0) return Reach::less;
  const N left = gap * gap, right = radius * radius * product(direction.n, direction.n);
  return left < right ? Reach::less : left == right ? Reach::equal : Reach::more;
}

}  // namespace

template <int D>
Thick_judge<D>::Thick_judge(const Lattice<D>& lattice, int bits) : lattice_(lattice), bits_(bits) {
  for (std::uint32_t s = 0; s < lattice.side_count(); ++s) {
    const std::uint32_t other = lattice.opposite(s);
    const bool is_first = other == no_cell || s < other;
    const bool is_at_free_space = !lattice.is_solid(lattice.cell_of(s)) ||
                                  (other != no_cell && !lattice.is_solid(lattice.cell_of(other)));
    if (!is_first || !lattice.is_wall(s) || !is_at_free_space) continue;
    Wall wall;
    wall.side = s;
    for (const std::uint32_t p : lattice.loop(s)) {
      Site<D>& x = wall.corners[wall.size++];
      for (std::size_t i = 0; i < D; ++i) x[i] = Whole{lattice.point(p)[i]} << bits;
    }
    wall.low = wall.high = wall.corners[0];
    for (std::size_t v = 1; v < wall.size; ++v)
      for (std::size_t i = 0; i < D; ++i) {
        wall.low[i] = std::min(wall.low[i], wall.corners[v][i]);
        wall.high[i] = std::max(wall.high[i], wall.corners[v][i]);
      }
    walls_.push_back(wall);
  }
}

/// The walls that may be as near as the radius to what is swept: their boxes are.
template <int D>
void Thick_judge<D>::find_near(const Edge_sites<D>& move, Whole radius) {
  Site<D> low, high;
  for (std::size_t i = 0; i < D; ++i) {
    low[i] = std::min({move.a[i], move.b[i], move.q[i]});
    high[i] = std::max({move.a[i], move.b[i], move.q[i]});
  }
  near_.clear();
  for (const Wall& wall : walls_) {
    Whole square = 0;
    for (std::size_t i = 0; i < D; ++i) {
      const Whole gap = std::max({wall.low[i] - high[i], low[i] - wall.high[i], Whole{0}});
      square += gap * gap;
    }
    if (square <= radius * radius) near_.push_back(&wall);
  }
}

template <int D>
bool Thick_judge<D>::is_apart(const Swept& swept, const Wall& wall, Whole radius) {
  const Dyadic time(swept.time);
  const Edge_sites<D>& move = swept.move;
  // In integers of any type: coordinates relative to a corner of the wall, times 2^shift.
  const auto whole_hulls = [&](auto zero) {
    using N = decltype(zero);
    Hulls<N, D> hulls;
    hulls.size = wall.size;
    const N one = N(1) << time.shift;
    for (std::size_t i = 0; i < D; ++i) {
      const Whole origin = wall.corners[0][i];
      hulls.triangle[0][i] = N(move.a[i] - origin) * one;
      hulls.triangle[1][i] = N(move.a[i] - origin) * one + N(time.digits) * N(move.b[i] - move.a[i]);
      hulls.triangle[2][i] = N(move.q[i] - origin) * one;
      for (std::size_t v = 0; v < wall.size; ++v) hulls.wall[v][i] = N(wall.corners[v][i] - origin) * one;
    }
    return hulls;
  };
  const auto rounded_hulls = [&](auto zero) {
    using N = decltype(zero);
    Hulls<N, D> hulls;
    hulls.size = wall.size;
    const N unit = N(1) / static_cast<N>(Whole{1} << bits_);
    for (std::size_t i = 0; i < D; ++i) {
      const Whole origin = wall.corners[0][i];
      hulls.triangle[0][i] = N(move.a[i] - origin) * unit;
      hulls.triangle[1][i] = hulls.triangle[0][i] + N(swept.time) * (N(move.b[i] - move.a[i]) * unit);
      hulls.triangle[2][i] = N(move.q[i] - origin) * unit;
      for (std::size_t v = 0; v < wall.size; ++v) hulls.wall[v][i] = N(wall.corners[v][i] - origin) * unit;
    }
    return hulls;
  };
  const auto decide_exactly = [&](auto zero, const std::vector<std::size_t>& directions) {
    using N = decltype(zero);
    const auto hulls = whole_hulls(zero);
    const N thick = N(radius) << time.shift;
    Reach furthest = Reach::less;
    for (const std::size_t k : directions)
      furthest = std::max(furthest, exact_reach<N, D>(hulls, hulls.direction(k), thick));
    tied_ |= furthest == Reach::equal;
    return furthest != Reach::less;
  };

  const auto hulls = rounded_hulls(double{});
  const double unit = std::ldexp(1.0, -bits_);
  thread_local std::vector<std::size_t> open, still_open;
  open.clear();
  for (std::size_t k = 0; k < hulls.direction_count(); ++k) {
    const Reach reach =
        rounded_reach<double, D>(hulls, hulls.direction(k), static_cast<double>(radius) * unit, 0x1p-27);
    if (reach == Reach::more) return true;
    if (reach == Reach::open) open.push_back(k);
  }
  if (open.empty()) return false;
  // Below 2^c a coordinate, 2^(3c+3) one of a direction, 2^(4c+6) a gap.
  if (bits_ + 4 + time.shift <= 14) return decide_exactly(Wide{}, open);
  const auto longer = rounded_hulls(Quad{});
  still_open.clear();
  for (const std::size_t k : open) {
    const Reach reach = rounded_reach<Quad, D>(longer, longer.direction(k),
                                               static_cast<Quad>(radius) * static_cast<Quad>(unit), 0x1p-87);
    if (reach == Reach::more) return true;
    if (reach == Reach::open) still_open.push_back(k);
  }
  return !still_open.empty() && decide_exactly(Large{}, still_open);
}

template <int D>
bool Thick_judge<D>::starts_free(const Edge_sites<D>& move, Whole radius) {
  const Edge_sites<D> still{move.a, move.a, move.q};
  find_near(still, radius);
  return std::all_of(near_.begin(), near_.end(), [&](const Wall* wall) {
    return is_apart({still, 0}, *wall, radius);
  });
}

template <int D>
Thick_fault Thick_judge<D>::fault_of(const World<D>& world, const Edge_sites<D>& move, Whole radius,
                                     const Answer<D>& answer) {
  tied_ = false;
  find_near(move, radius);
  const auto is_free_until = [&](double time) {
    return std::all_of(near_.begin(), near_.end(), [&](const Wall* w) {
      return is_apart({move, time}, *w, radius);
    });
  };
  if (answer.status == Motion_status::free)
    return is_free_until(1) ? Thick_fault::none : Thick_fault::false_free;
  if (answer.status != Motion_status::contact || !answer.contact) return Thick_fault::wrong_start;
  const Contact<D>& contact = *answer.contact;
  if (!(contact.time >= 0 && contact.time < 1)) return Thick_fault::false_contact;
  if (to_index(contact.facet) >= world.side_of.size()) return Thick_fault::wrong_wall;
  const std::uint32_t named = world.side_of[to_index(contact.facet)];
  const auto wall = std::find_if(near_.begin(), near_.end(), [&](const Wall* w) {
    return named != no_cell && (w->side == named || w->side == lattice_.opposite(named));
  });
  if (wall == near_.end()) return Thick_fault::wrong_wall;
  if (is_apart({move, 1}, **wall, radius)) return Thick_fault::false_contact;
  if (!is_free_until(contact.time)) return Thick_fault::late;
  const bool was_tied = tied_;
  if (is_apart({move, std::nextafter(contact.time, 2.0)}, **wall, radius)) return Thick_fault::early;
  tied_ = was_tied;
  // The point lies on the wall, at the distance of the radius from the edge.
  const Point<D> from = world.place(move.a), q = world.place(move.q);
  const Point<D> p = from + contact.time * (world.place(move.b) - from);
  const Vector<D> edge = q - p, to_point = contact.point - p;
  const double square = dot(edge, edge);
  const double share = square > 0 ? std::clamp(dot(to_point, edge) / square, 0.0, 1.0) : 0;
  double size = 0;
  for (std::size_t i = 0; i < D; ++i) size = std::max({size, std::abs(from[i]), std::abs(q[i])});
  const double distance = length(to_point - share * edge);
  if (!(std::abs(distance - world.place(radius)) <= 0x1p-30 * size)) return Thick_fault::wrong_point;
  const auto& corner = (*wall)->corners[0];
  const Vector<D>& normal = world.normals[lattice_.side(named).family];
  return std::abs(dot(contact.point - world.place(corner), normal)) <= 0x1p-30 * size
             ? Thick_fault::none
             : Thick_fault::wrong_point;
}

template class Thick_judge<2>;
template class Thick_judge<3>;

}  // namespace cellwalk::endurance
