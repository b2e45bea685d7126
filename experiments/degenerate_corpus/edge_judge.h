// SPDX-License-Identifier: LGPL-3.0-or-later
// Judges edges of which one end moves: the oracle of walks judges the path of the end, that of chains the
// edge. Cells and chains are handed on by the library, as far as the oracles agree with it: if they do not,
// nothing is made.
#ifndef CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_EDGE_JUDGE_H
#define CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_EDGE_JUDGE_H

#include <cellwalk/edge/chain.h>
#include <cellwalk/edge/sweep.h>
#include <cellwalk/walk/locate.h>

#include <optional>
#include <vector>

#include "case.h"
#include "edge/chain_oracle.h"
#include "oracle/oracle.h"

namespace cellwalk::corpus {

template <int D>
struct Edge {
  Particle<D> p, q;
  Chain chain;  ///< from p to q
};

struct Judged {
  Crossing crossing = Crossing::no;
  std::vector<Rational> times;  ///< at which it may be blocked
};

template <int D>
class Edge_judge {
 public:
  explicit Edge_judge(const Cell_soup<D>& soup);

  /// The edge as it stands. None if an end is not in free space, or a wall parts them.
  std::optional<Edge<D>> place(const Point<D>& p, const Point<D>& q);

  /// Judges a move of end 0 or 1, and makes it if it is free. None if the path of the end leaves a choice.
  /// \throw std::logic_error where the library contradicts the oracles
  std::optional<Judged> move(Edge<D>& edge, const Move<D>& move);

 private:
  const Cell_soup<D>& soup_;
  const Snapshot<D> snapshot_;
  const Locator<D> locator_;
  const oracle::Oracle<D> oracle_;
  const oracle::Chain_oracle<D> chains_;
  Edge_counts counts_;
};

}  // namespace cellwalk::corpus

#endif  // CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_EDGE_JUDGE_H
