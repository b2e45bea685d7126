// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's searches for the contact of an edge, for those who repeat it: sweeps know the exact one.
// Paper: section III. Theory: docs/bodies.md, searches.
#ifndef CELLWALK_EDGE_CONTACT_SEARCH_H
#define CELLWALK_EDGE_CONTACT_SEARCH_H

namespace cellwalk {

enum class Contact_search {
  dichotomic,  ///< bisection of complete sweeps: the longest motion found free, within a bound
  /// The paper's bisection: a temporary particle walks along the edge from the position of p at each time.
  /// The edge is free at the time found and blocked within a bound after it. Obstacles that it met and left
  /// before are not found, so the time may be late.
  dichotomic_segment,
  /// The first of the obstacle vertices (2D) or edges (3D) of the cells met that lie in the swept triangle.
  exhaustive
};

/// The cells whose obstacles an exhaustive search examines.
enum class Search_cells {
  flooded,   ///< those that the swept triangle meets: complete
  traversed  ///< those that the edge crosses at its end: the paper's
};

/// How a sweep locates a contact, once its existence is known: see Sweep_options::search.
/// Cost: dichotomic: log2(1/tolerance) sweeps; dichotomic_segment: as many walks of p and of the edge;
/// exhaustive: some rational arithmetic for each wall of the cells.
struct Search_options {
  Contact_search method = Contact_search::dichotomic;
  double tolerance = 0x1p-20;  ///< of dichotomic searches: length of the final interval of time, in (0,1]
  Search_cells cells = Search_cells::flooded;
  /// Whether an exhaustive search skips obstacles that signs find outside the swept triangle, beyond the edge
  /// at its end (the paper's limit). The answer does not depend on it.
  bool below = true;
};

namespace detail {

/// \throw Error(usage) for a dichotomic search whose tolerance does not lie in (0,1]: it need not end
void check_search(const Search_options& search);

}  // namespace detail

}  // namespace cellwalk

#endif  // CELLWALK_EDGE_CONTACT_SEARCH_H
