// SPDX-License-Identifier: LGPL-3.0-or-later
// The state of a Reshaping: the environment and its editors, the residents, and the moves of single vertices.
// Theory: docs/moving.md.
#ifndef CELLWALK_RESHAPE_STATE_H
#define CELLWALK_RESHAPE_STATE_H

#include <cellwalk/internal/environment/vertex_mover.h>
#include <cellwalk/reshape/reshaping.h>

#include <cstdint>
#include <vector>

#include "cut/merger.h"
#include "cut/splitter.h"
#include "move/vertex_trial.h"
#include "replace/replacement.h"
#include "residents/resident_groups.h"
#include "toggle/toggle.h"

namespace cellwalk::detail {

template <int D>
struct Reshaping_state {
  Reshaping_state(Environment<D>& of, const Residents<D>& residents, const Reshape_options& given)
      : environment(of),
        options(given),
        groups(environment.snapshot(), residents),
        mover(environment),
        trial(groups, counts),
        toggle(environment, groups, counts.walk),
        transaction(environment, groups, counts),
        replacer(transaction, mover),
        splitter(transaction, toggle),
        merger(transaction, toggle) {}

  /// move: to the target, if that is free. whether: the same, but the result need not name the resident that
  /// is met, and a contact ends as a touch. nothing: it stays in any case.
  enum class Attempt : std::uint8_t { move, whether, nothing };
  Vertex_result<D> attempt(std::uint32_t point, const Point<D>& target, Attempt kind, bool is_first = false);
  bool decide(const Point<D>& from, std::uint32_t point, bool any, Vertex_result<D>& result);
  Vertex_result<D> move(std::uint32_t point, const Point<D>& target, bool is_first,
                        std::vector<Wall_hit<D>>* hits = nullptr);
  bool push(const Wall_hit<D>& hit, const Vector<D>& motion);
  Box<D> box_of_star(const Point<D>& target) const;
  Toggle<D>& restored_toggle();
  Splitter<D>& restored_splitter();
  void check_open() const;
  void finish();

  Environment<D>& environment;
  Reshape_options options;
  Reshape_counts counts;
  Resident_groups<D> groups;
  Vertex_mover<D> mover;
  Vertex_trial<D> trial;
  Toggle<D> toggle;
  Cell_transaction<D> transaction;
  Replacer<D> replacer;
  Splitter<D> splitter;
  Merger<D> merger;
  bool is_open = true;
};

extern template struct Reshaping_state<2>;
extern template struct Reshaping_state<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_STATE_H
