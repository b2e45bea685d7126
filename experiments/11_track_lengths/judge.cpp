// SPDX-License-Identifier: LGPL-3.0-or-later
#include "judge.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace cellwalk::track_lengths {
namespace {

using Large = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    1024, 1024, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
using Unbounded = boost::multiprecision::cpp_int;

constexpr int unit_exponent = -128, most_exponent = 12;
constexpr int length_exponent = -1200;  // of the unit in which lengths are compared: below half an ulp of all

/// x in units of a power of two.
template <class Number>
Number in_units(double x, int exponent) {
  if (x == 0) return 0;
  int of_x = 0;
  const double fraction = std::frexp(x, &of_x);
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(fraction, 53));
  const int shift = of_x - 53 - exponent;
  if (shift >= 0) return Number(mantissa) << shift;
  if ((mantissa & ((std::int64_t{1} << std::min(-shift, 62)) - 1)) != 0)
    throw std::runtime_error("the judge of lengths: a coordinate is too fine");
  return Number(mantissa >> std::min(-shift, 62));
}

}  // namespace

Row row_of(const Traces& traces, std::size_t i) {
  const std::size_t begin = traces.offsets[i], count = traces.offsets[i + 1] - begin;
  return {
      std::span(traces.cells).subspan(begin, count), std::span(traces.lengths).subspan(begin, count),
      std::span(traces.crossings)
          .subspan(traces.crossing_offsets[i], traces.crossing_offsets[i + 1] - traces.crossing_offsets[i]),
      traces.ends[i]};
}

Judge::Integer Judge::integer(double x) {
  if (!(std::abs(x) < std::ldexp(1.0, most_exponent)))
    throw std::runtime_error("the judge of lengths: a coordinate is too large");
  return in_units<Integer>(x, unit_exponent);
}

Judge::Vector Judge::vector(const Point<3>& p) { return {integer(p[0]), integer(p[1]), integer(p[2])}; }

Judge::Integer Judge::height(const Plane& plane, const Vector& x) {
  return plane.normal[0] * x[0] + plane.normal[1] * x[1] + plane.normal[2] * x[2] - plane.offset;
}

bool Judge::is_less(const Share& a, const Share& b) {
  return Large(a.numerator) * b.denominator < Large(b.numerator) * a.denominator;
}

void Judge::add(std::vector<Share>& shares, const Share& share) {
  const auto at = std::lower_bound(shares.begin(), shares.end(), share, is_less);
  if (at == shares.end() || is_less(share, *at)) shares.insert(at, share);
}

Judge::Judge(const Snapshot<3>& snapshot) : snapshot_(snapshot), planes_(snapshot.half_facet_slots() / 4) {
  for (std::size_t k = 0; k < 3; ++k) {
    low_[k].assign(planes_.size(), std::numeric_limits<double>::infinity());
    high_[k].assign(planes_.size(), -std::numeric_limits<double>::infinity());
  }
  for (std::size_t index = 0; index < snapshot.cell_count(); ++index) {
    const std::uint32_t cell = to_index(snapshot.cell(index));
    const Cell_view<3> view = snapshot.view(snapshot.cell(index));
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        low_[k][cell] = std::min(low_[k][cell], view.point(i)[k]);
        high_[k][cell] = std::max(high_[k][cell], view.point(i)[k]);
      }
      const Vector p = vector(view.point((i + 1) % 4)), q = vector(view.point((i + 2) % 4)),
                   r = vector(view.point((i + 3) % 4));
      Plane& plane = planes_[cell][i];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
        plane.normal[k] = (q[l] - p[l]) * (r[m] - p[m]) - (q[m] - p[m]) * (r[l] - p[l]);
      }
      plane.offset = 0;
      plane.offset = height(plane, p);
      if (height(plane, vector(view.point(i))) > 0) continue;
      for (Integer& x : plane.normal) x = -x;
      plane.offset = -plane.offset;
    }
  }
}

/// The part of positive length of a ray in a closed cell.
bool Judge::cut(std::uint32_t cell, const Vector& a, const Vector& b, Visit& visit) const {
  visit = {cell, {0, 1}, {1, 1}};
  for (const Plane& plane : planes_[cell]) {
    const Integer of_a = height(plane, a), of_b = height(plane, b);
    if (of_a >= 0 && of_b >= 0) continue;
    if (of_a <= 0 && of_b <= 0) return false;
    if (of_a < 0) {
      const Share enters{-of_a, of_b - of_a};
      if (is_less(visit.first, enters)) visit.first = enters;
    } else {
      const Share leaves{of_a, of_a - of_b};
      if (is_less(leaves, visit.last)) visit.last = leaves;
    }
    if (!is_less(visit.first, visit.last)) return false;
  }
  return true;
}

std::vector<Judge::Visit> Judge::visits(const Point<3>& from, const Point<3>& to) const {
  std::array<double, 3> low{}, high{};
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(from[k], to[k]);
    high[k] = std::max(from[k], to[k]);
  }
  const Vector a = vector(from), b = vector(to);
  std::vector<Visit> all;
  Visit visit;
  for (std::uint32_t cell = 0; cell < planes_.size(); ++cell) {
    bool is_near = true;
    for (std::size_t k = 0; k < 3; ++k) is_near &= low_[k][cell] <= high[k] && low[k] <= high_[k][cell];
    if (is_near && cut(cell, a, b, visit)) all.push_back(visit);
  }
  return all;
}

std::vector<Judge::Share> Judge::events_of(const std::vector<Visit>& visits) {
  std::vector<Share> events;
  for (const Visit& visit : visits) {
    add(events, visit.first);
    add(events, visit.last);
  }
  return events;
}

/// True if no double is nearer to the length of a part of the ray, whose squared length is given in squares
/// of the unit.
bool Judge::is_nearest(double length, const Integer& square, const Share& begin, const Share& end) {
  if (!(length >= 0)) return false;
  const auto middle_to = [&](double neighbour) {  // twice the middle
    return Unbounded(in_units<Unbounded>(length, length_exponent) +
                     in_units<Unbounded>(neighbour, length_exponent));
  };
  const Unbounded numerator = Unbounded(end.numerator) * Unbounded(begin.denominator) -
                              Unbounded(begin.numerator) * Unbounded(end.denominator);
  const Unbounded denominator = Unbounded(begin.denominator) * Unbounded(end.denominator);
  // With q = numerator / denominator: low <= 2 sqrt(square) q 2^(unit_exponent - length_exponent) <= high.
  const Unbounded exact = Unbounded(square) * numerator * numerator
                          << (2 * (unit_exponent - length_exponent) + 2);
  const Unbounded low = length == 0 ? Unbounded(0) : middle_to(std::nextafter(length, 0.0)) * denominator;
  const Unbounded high =
      middle_to(std::nextafter(length, std::numeric_limits<double>::infinity())) * denominator;
  return low * low <= exact && exact <= high * high;
}

/// Where the last piece of a row may end; nothing if there is no way to lay its pieces.
std::vector<Judge::Share> Judge::ends(const std::vector<Visit>& visits, const Integer& square,
                                      const Row& row) const {
  const std::vector<Share> events = events_of(visits);
  std::vector<Share> here{{0, 1}};
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const auto visit = std::ranges::find(visits, to_index(row.cells[i]), &Visit::cell);
    if (visit == visits.end()) return {};
    std::vector<Share> next;
    for (const Share& begin : here) {
      if (is_less(begin, visit->first)) continue;
      auto end = std::upper_bound(events.begin(), events.end(), begin, is_less);
      for (; end != events.end() && !is_less(visit->last, *end); ++end)
        if (is_nearest(row.lengths[i], square, begin, *end)) add(next, *end);
    }
    here = std::move(next);
  }
  return here;
}

std::string Judge::fault(const Point<3>& from, const Point<3>& to, const Row& row) const {
  if (row.end.status == Walk_status::lost) return "it has no cell";
  if (row.cells.size() != row.lengths.size()) return "a piece has no length";
  const Vector a = vector(from), b = vector(to);
  Integer square = 0;
  for (std::size_t k = 0; k < 3; ++k) square += (b[k] - a[k]) * (b[k] - a[k]);
  const std::vector<Share> ends = this->ends(visits(from, to), square, row);
  if (ends.empty()) return "its pieces do not lie in their cells, one after the other, with their lengths";
  if (row.end.status == Walk_status::arrived)
    return is_less(ends.back(), {1, 1}) ? "it arrives without the last pieces" : "";

  if (!snapshot_.is_impassable(row.end.wall)) return "no wall blocks it";
  const std::vector<std::uint32_t> wall = snapshot_.loop(row.end.wall);
  const Cell_view<3> view = snapshot_.view(snapshot_.cell_of(row.end.wall));
  for (std::size_t i = 0; i < 4; ++i) {
    if (std::ranges::find(wall, view.point_index(i)) != wall.end()) continue;
    const Plane& plane = planes_[to_index(snapshot_.cell_of(row.end.wall))][i];
    const Integer of_a = height(plane, a), of_b = height(plane, b);
    for (const Share& end : ends)
      if (Large(of_a) * end.denominator + Large(end.numerator) * (of_b - of_a) == 0) return "";
  }
  return "it does not end at its wall";
}

}  // namespace cellwalk::track_lengths
