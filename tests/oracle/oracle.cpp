// SPDX-License-Identifier: LGPL-3.0-or-later
#include "oracle/oracle.h"

#include <algorithm>
#include <optional>
#include <set>

#include "oracle/exact_world.h"

namespace cellwalk::oracle {
namespace {

/// Values of at most so many bits can be combined twice in 128 and 256 bits: (d-n) A + n B with
/// |d|,|n|,|A|,|B| < 2^124.
constexpr int narrow_bits = 124;

/// Bits of x scaled by 2^shift.
int scaled_bits(double x, int shift) {
  const Dyadic d = to_dyadic(x);
  return d.mantissa == 0 ? 0 : bit_length<std::int64_t>(d.mantissa) + d.exponent + shift;
}

}  // namespace

template <int D>
struct Oracle<D>::Data {
  Cell_soup<D> soup;
  Facet_table facets;
  int shift = 0;
  std::optional<Exact_world<D, Int128>> narrow;
  std::optional<Exact_world<D, Wide>> wide;  // made when first needed
  std::size_t narrow_traces = 0, wide_traces = 0;

  explicit Data(Cell_soup<D> s) : soup(std::move(s)), facets(make_facet_table(soup)) {
    bool any = false;
    for (const Point<D>& p : soup.points)
      for (double x : p)
        if (x != 0) {
          shift = any ? std::max(shift, integer_shift(x)) : integer_shift(x);
          any = true;
        }
    int bits = 0;
    for (const Point<D>& p : soup.points)
      for (double x : p) bits = std::max(bits, scaled_bits(x, shift));
    // A rim's normal has three factors, its offset four; differences and sums of three add at most 4 bits a
    // factor.
    if (4 * bits + 16 <= narrow_bits)
      narrow.emplace(soup, facets, shift);
    else
      wide.emplace(soup, facets, shift);
  }
};

template <int D>
Oracle<D>::Oracle(Cell_soup<D> soup) : data_(std::make_unique<Data>(std::move(soup))) {}
template <int D>
Oracle<D>::~Oracle() = default;
template <int D>
Oracle<D>::Oracle(Oracle&&) noexcept = default;

template <int D>
const Cell_soup<D>& Oracle<D>::soup() const {
  return data_->soup;
}

template <int D>
Trace Oracle<D>::trace(const Point<D>& a, const Point<D>& b) const {
  int extra = 0;
  for (const Point<D>* p : {&a, &b})
    for (double x : *p)
      if (x != 0) extra = std::max(extra, integer_shift(x) - data_->shift);
  int bits = 0;
  for (const Point<D>* p : {&a, &b})
    for (double x : *p) bits = std::max(bits, scaled_bits(x, data_->shift + extra));
  if (data_->narrow && data_->narrow->value_bits(bits, extra) <= narrow_bits) {
    ++data_->narrow_traces;
    return data_->narrow->trace(a, b, extra);
  }
  if (!data_->wide) data_->wide.emplace(data_->soup, data_->facets, data_->shift);
  ++data_->wide_traces;
  return data_->wide->trace(a, b, extra);
}

template <int D>
Place Oracle<D>::place(const Point<D>& p) const {
  const Trace here = trace(p, p);
  const std::vector<int> classes = here.classes_at(0);
  Place place;
  place.dimension = D;
  std::set<int> sides;
  for (std::size_t v = 0; v < here.visits.size(); ++v) {
    const Visit& visit = here.visits[v];
    (visit.solid ? place.solid_cells : place.free_cells).push_back(visit.cell);
    if (!visit.solid) sides.insert(classes[v]);
    if (!visit.solid) place.dimensions.push_back(visit.dimension_at_last);
    place.dimension = std::min(place.dimension, visit.dimension_at_last);
  }
  place.sides = static_cast<int>(sides.size());
  return place;
}

template <int D>
bool Oracle<D>::is_passable(std::uint32_t cell, std::uint32_t facet) const {
  return data_->facets.passable[data_->soup.cell_begin[cell] + facet];
}

template <int D>
std::size_t Oracle<D>::narrow_traces() const {
  return data_->narrow_traces;
}
template <int D>
std::size_t Oracle<D>::wide_traces() const {
  return data_->wide_traces;
}

template class Oracle<2>;
template class Oracle<3>;

}  // namespace cellwalk::oracle
