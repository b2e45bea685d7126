// SPDX-License-Identifier: LGPL-3.0-or-later
// Replacements of cells by others over the same region, with their residents.
#ifndef CELLWALK_RESHAPE_REPLACE_REPLACEMENT_H
#define CELLWALK_RESHAPE_REPLACE_REPLACEMENT_H

#include <cellwalk/internal/environment/cell_patcher.h>
#include <cellwalk/internal/environment/vertex_mover.h>
#include <cellwalk/reshape/move.h>
#include <cellwalk/reshape/replacement.h>

#include <cstdint>
#include <vector>

#include "cell_transaction.h"
#include "patch.h"

namespace cellwalk::detail {

/// The operations are described at Reshaping.
template <int D>
class Replacer {
 public:
  /// \param mover the certificates that it has withdrawn are restored before cells are replaced
  Replacer(Cell_transaction<D>& transaction, Vertex_mover<D>& mover)
      : transaction_(transaction), mover_(mover) {}

  Replacement insert_point(Cell cell, const Point<D>& position);
  Replacement split_edge(std::uint32_t u, std::uint32_t v, const Point<D>& position);
  Replacement flip(Half_facet facet);
  Replacement remove_edge(std::uint32_t u, std::uint32_t v);
  Replacement collapse(std::uint32_t u, std::uint32_t onto);

  /// The replacement that an operation would make, for callers that evaluate it before.
  /// `reason` is set if it is refused.
  Patch<D> split(std::uint32_t u, std::uint32_t v, const Point<D>& position, std::string& reason) const;
  Patch<D> flipped(Half_facet facet, std::string& reason) const;
  Patch<D> without_edge(std::uint32_t u, std::uint32_t v, std::string& reason) const;
  Patch<D> collapsed(std::uint32_t u, std::uint32_t onto, std::string& reason) const;
  Replacement make(const Patch<D>& patch);

  /// \throw Error(usage) if the environment is frozen, if there is no such point, or if a cell around it is
  ///        not a simplex
  void check_points(std::span<const std::uint32_t> points) const;
  /// True if no wall has a point, nor the boundary.
  bool is_off_walls(std::uint32_t point) const;
  const Snapshot<D>& snapshot() const { return transaction_.snapshot(); }

 private:
  void prepare(const Patch<D>& patch);
  Replacement replace(const Patch<D>& patch, const Cell_soup<D>& soup, const Gluing& gluing);
  void check_edit() const;
  void check_simplices(const std::vector<Cell>& cells) const;
  void check_point(std::uint32_t point) const;
  std::vector<Cell> cells_at_edge(std::uint32_t u, std::uint32_t v) const;
  bool has_wall_at_edge(const std::vector<Cell>& cells, std::uint32_t u, std::uint32_t v) const;
  std::vector<std::uint32_t> ring(const std::vector<Cell>& cells, std::uint32_t u, std::uint32_t v) const;

  Cell_transaction<D>& transaction_;
  Vertex_mover<D>& mover_;
};

extern template class Replacer<2>;
extern template class Replacer<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_REPLACE_REPLACEMENT_H
