// SPDX-License-Identifier: LGPL-3.0-or-later
// Better cells where there are no walls: vertices move, cells are replaced. Qualities choose the operations
// that are tried.
#ifndef CELLWALK_RESHAPE_REPLACE_RELAXER_H
#define CELLWALK_RESHAPE_REPLACE_RELAXER_H

#include <functional>
#include <set>

#include "replacement.h"

namespace cellwalk::detail {

/// One run of Reshaping::relax().
template <int D>
class Relaxer {
 public:
  /// \param move moves a vertex, and returns whether it arrived
  Relaxer(Environment<D>& environment, Replacer<D>& replacer, const Relax_options& options,
          std::function<bool(std::uint32_t, const Point<D>&)> move);

  Relax_report run(std::span<const std::uint32_t> points);

 private:
  /// The points of a cell, to find it again when it was replaced by one of another name.
  struct Candidate {
    double quality;
    typename Patch<D>::Simplex corners;
    Cell cell;
  };
  std::vector<Cell> cells() const;
  double mean_edge() const;
  double least_quality(std::span<const Cell> cells) const;
  double quality_of(Cell cell) const;
  bool improve(const Candidate& candidate);
  bool smooth(const Candidate& candidate);
  bool flip(const Candidate& candidate);
  bool remove_edges(const Candidate& candidate);
  bool collapse(const Candidate& candidate);
  bool split(const Candidate& candidate);
  /// Makes a patch if its cells are better than those that it replaces.
  bool make_if_better(const Patch<D>& patch, const std::string& reason, std::uint32_t& count);
  double length(std::uint32_t u, std::uint32_t v) const;

  Environment<D>& environment_;
  Replacer<D>& replacer_;
  Relax_options options_;
  std::set<std::uint32_t> kept_;
  std::function<bool(std::uint32_t, const Point<D>&)> move_;
  std::set<std::uint32_t> points_;
  double edge_ = 0;  ///< the mean length at the start
  Relax_report report_;
};

extern template class Relaxer<2>;
extern template class Relaxer<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_REPLACE_RELAXER_H
