// SPDX-License-Identifier: LGPL-3.0-or-later
// Private to io: the two orders of the corners of wedges.
#ifndef CELLWALK_IO_MESH_WEDGE_ORDER_H
#define CELLWALK_IO_MESH_WEDGE_ORDER_H

#include <cellwalk/kernel/exact.h>
#include <cellwalk/records/cell_soup.h>

#include <algorithm>
#include <vector>

namespace cellwalk::io {

/// VTK documents one order of the corners of wedges, and many programs write the other. Other cells in the
/// file decide: if all of them have one orientation and all wedges the other, the wedges are reversed. (A
/// file of wedges only is inverted as a whole when the environment is built.)
class Wedge_order {
 public:
  explicit Wedge_order(Cell_soup<3>& soup) : soup_(soup) {}

  /// Notes the orientation of the cell that was just added. Exact.
  void note_cell(bool is_wedge) {
    const std::size_t c = soup_.cell_count() - 1;
    // The first two facets share no vertex, or (tetrahedra, pyramids) the second has a vertex off the first.
    const auto base = soup_.facet(soup_.cell_begin[c]), next = soup_.facet(soup_.cell_begin[c] + 1);
    const Point<3>* off = &soup_.points[next[0]];
    for (std::uint32_t v : next)
      if (std::find(base.begin(), base.end(), v) == base.end()) off = &soup_.points[v];
    const int sign = Exact::orientation(counts_, soup_.points[base[2]], soup_.points[base[1]],
                                        soup_.points[base[0]], *off);
    (sign > 0 ? (is_wedge ? upright_wedges_ : upright_others_)
              : (is_wedge ? inverted_wedges_ : inverted_others_)) += 1;
    if (is_wedge) wedges_.push_back(c);
  }

  /// Reverses all wedges if the other cells require it. Returns the number of reversed wedges.
  std::size_t settle() {
    const bool against_upright = upright_others_ > 0 && inverted_others_ == 0 && upright_wedges_ == 0;
    const bool against_inverted = inverted_others_ > 0 && upright_others_ == 0 && inverted_wedges_ == 0;
    if (!against_upright && !against_inverted) return 0;
    for (std::size_t c : wedges_)
      for (std::uint32_t f = soup_.cell_begin[c]; f < soup_.cell_begin[c + 1]; ++f)
        std::reverse(soup_.vertices.begin() + soup_.facet_begin[f],
                     soup_.vertices.begin() + soup_.facet_begin[f + 1]);
    return wedges_.size();
  }

 private:
  Cell_soup<3>& soup_;
  std::vector<std::size_t> wedges_;
  Predicate_counts counts_;
  std::size_t upright_wedges_ = 0, inverted_wedges_ = 0, upright_others_ = 0, inverted_others_ = 0;
};

}  // namespace cellwalk::io

#endif  // CELLWALK_IO_MESH_WEDGE_ORDER_H
