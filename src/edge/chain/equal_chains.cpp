// SPDX-License-Identifier: LGPL-3.0-or-later
// The pieces of two chains compared in exact order, and the first point at which they part.
#include "equal_chains.h"

#include <cellwalk/internal/walk/link_search.h>
#include <cellwalk/internal/walk/star.h>

#include <algorithm>
#include <vector>

namespace cellwalk::detail {
namespace {

/// A path between cells that are linked at a point of a segment.
template <int D>
class Link_path {
 public:
  /// Searches from a cell that contains the point at t until `to` is found.
  Link_path(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, Cell from, Cell to,
            const Fraction& t)
      : links_(snapshot, from) {
    const auto holds_point = [&](const Cell_view<D>& cell, std::size_t i) {
      const std::optional<Span> met = segment.in_facet(cell, i);
      if (!met || met->low > t) return false;
      const Half_facet f = Snapshot<D>::half_facet(links_.cell(), i);
      const bool is_wall = snapshot.is_impassable(f);
      if (met->high < t) {
        if (!is_wall) last_before = std::max<Fraction>(last_before, met->high);
        return false;
      }
      if (!is_wall && !links_.contains(snapshot.neighbour(f))) {
        part.low = std::max<Fraction>(part.low, met->low);
        part.high = std::min<Fraction>(part.high, met->high);
      }
      return true;
    };
    const auto note = [&](const Cell_view<D>&, std::size_t, Half_facet f) {
      wall = first_placed(snapshot, wall, f);
    };
    while (!reached_ && links_.next()) {
      reached_ = links_.cell() == to;
      if (!reached_) links_.expand_all(holds_point, note);
    }
  }

  /// True if the cells are linked there.
  explicit operator bool() const { return reached_; }

  /// The facets on the path.
  /// \pre the cells are linked
  std::vector<Half_facet> path() const {
    std::vector<Half_facet> facets;
    links_.append_path(links_.place(), facets);
    return facets;
  }

  Span part{0, 1};                     ///< the part of the segment that lies in all facets passed
  Half_facet wall = Half_facet::none;  ///< a wall at the point, of one of the cells found
  Fraction last_before = 0;            ///< the last end of a passable facet of these cells before the point

 private:
  Link_search<D> links_;  ///< stopped at `to`, if it is linked
  bool reached_ = false;
};

/// The first parameter between low and high at which two cells that contain this piece are not linked. They
/// are compared at its middle, and then on both sides of the part to which the result applies. A single point
/// needs no test: the facets that a chain passes in it link the cells before and after, which are compared
/// themselves.
template <int D>
std::optional<Parting> first_parting(const Snapshot<D>& snapshot, const Rational_segment<D>& segment,
                                     Cell cell, Cell other, const Fraction& low, const Fraction& high) {
  if (cell == other || !(low < high)) return {};
  const Link_path<D> linked(snapshot, segment, cell, other, middle(low, high));
  if (linked) {
    const auto before = first_parting(snapshot, segment, cell, other, low, linked.part.low);
    return before ? before : first_parting(snapshot, segment, cell, other, linked.part.high, high);
  }
  // Before the point, nothing can link them as far back as the last end of a passable facet.
  const Fraction since = std::max<Fraction>(low, linked.last_before);
  const auto before = first_parting(snapshot, segment, cell, other, low, since);
  return before ? before : Parting{since, linked.wall};
}

}  // namespace

template <int D>
std::vector<Piece> pieces_of(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, Cell start,
                             std::span<const Half_facet> chain, const Fraction& end) {
  std::vector<Piece> pieces;
  Cell cell = start;
  Fraction last = 0;
  for (const Half_facet f : chain) {
    const auto met = segment.in_facet(snapshot.view(snapshot.cell_of(f)), snapshot.facet_of(f));
    Fraction next = last;
    if (met) next = std::min<Fraction>(end, std::max<Fraction>(last, met->low));
    pieces.push_back({cell, last, next});
    cell = snapshot.neighbour(f);
    last = next;
  }
  pieces.push_back({cell, last, end});
  return pieces;
}

template <int D>
std::optional<Parting> parting_of(const Snapshot<D>& snapshot, const Rational_segment<D>& segment,
                                  const std::vector<Piece>& chain, const std::vector<Piece>& other) {
  for (auto piece = chain.begin(), with = other.begin();;) {
    auto parting =
        first_parting(snapshot, segment, piece->cell, with->cell, std::max<Fraction>(piece->low, with->low),
                      std::min<Fraction>(piece->high, with->high));
    if (parting) return parting;
    if (piece->high <= with->high) {
      if (++piece == chain.end()) return {};
    } else if (++with == other.end()) {
      return {};
    }
  }
}

template <int D>
std::vector<Half_facet> link_at(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, Cell from,
                                Cell to, const Fraction& t) {
  return Link_path<D>(snapshot, segment, from, to, t).path();
}

template <int D>
bool are_equal(const Snapshot<D>& snapshot, const Rational_segment<D>& segment, Cell start,
               const Chain& chain, const Chain& other, Half_facet& wall) {
  if (chain == other) return true;
  const auto pieces = [&](const Chain& c) {
    return pieces_of<D>(snapshot, segment, start, {c.data(), c.size()}, 1);
  };
  const auto parting = parting_of<D>(snapshot, segment, pieces(chain), pieces(other));
  if (parting) wall = parting->wall;
  return !parting;
}

#define CELLWALK_INSTANTIATE(D)                                                                           \
  template std::vector<Piece> pieces_of<D>(const Snapshot<D>&, const Rational_segment<D>&, Cell,          \
                                           std::span<const Half_facet>, const Fraction&);                 \
  template std::optional<Parting> parting_of<D>(const Snapshot<D>&, const Rational_segment<D>&,           \
                                                const std::vector<Piece>&, const std::vector<Piece>&);    \
  template std::vector<Half_facet> link_at<D>(const Snapshot<D>&, const Rational_segment<D>&, Cell, Cell, \
                                              const Fraction&);                                           \
  template bool are_equal<D>(const Snapshot<D>&, const Rational_segment<D>&, Cell, const Chain&,          \
                             const Chain&, Half_facet&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
