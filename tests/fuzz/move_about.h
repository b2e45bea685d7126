// SPDX-License-Identifier: LGPL-3.0-or-later
// Points, walks and sweeps that bytes decide in an environment, judged by oracles that share no predicate
// with the library.
#ifndef CELLWALK_TESTS_FUZZ_MOVE_ABOUT_H
#define CELLWALK_TESTS_FUZZ_MOVE_ABOUT_H

#include <cellwalk/edge/contact_search.h>
#include <cellwalk/environment/snapshot.h>
#include <cellwalk/walk/locate.h>

#include <cstddef>

#include "fuzz/decoder.h"

namespace cellwalk::fuzz {

/// A search with the bytes that it has had in inputs found so far, or none.
inline const Search_options* take_search(Decoder& in, Search_options& search) {
  const std::size_t method = in.below(3);
  search.cells = in.flag() ? Search_cells::traversed : Search_cells::flooded;
  if (method == 0) return nullptr;
  search.method = static_cast<Contact_search>(method - 1);
  return &search;
}

/// The point between two, or beyond them.
template <int D>
Point<D> combination(const Point<D>& a, const Point<D>& b, double share) {
  return (1 - share) * a + share * b;
}

/// A point, mostly in a degenerate position: at a vertex, in an edge or facet, on a line through two
/// vertices, an ulp beside.
template <int D>
Point<D> some_point(const Snapshot<D>& snapshot, Decoder& in);

/// What was judged, of all inputs together: tests assert that it was not nothing.
struct Judged {
  std::size_t places = 0, walks = 0, walks_blocked = 0, sweeps = 0, sweeps_blocked = 0, chains = 0;
};
const Judged& judged();

/// Locates points, walks between them by all strategies, and sweeps edges, as long as there are bytes, up to
/// so many times. Each answer is judged: by invariants always, by the oracles where coordinates have few
/// digits.
/// \throw Finding where an answer is wrong
template <int D>
void move_about(const Snapshot<D>& snapshot, const Cell_soup<D>& soup, Decoder& in, std::size_t most);

extern template Point<2> some_point(const Snapshot<2>&, Decoder&);
extern template Point<3> some_point(const Snapshot<3>&, Decoder&);
extern template void move_about(const Snapshot<2>&, const Cell_soup<2>&, Decoder&, std::size_t);
extern template void move_about(const Snapshot<3>&, const Cell_soup<3>&, Decoder&, std::size_t);

}  // namespace cellwalk::fuzz

#endif  // CELLWALK_TESTS_FUZZ_MOVE_ABOUT_H
