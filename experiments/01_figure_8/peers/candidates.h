// SPDX-License-Identifier: LGPL-3.0-or-later
// Candidate walls per body: those of the body's box in one step, or of an enlarged box, kept until the body
// leaves it.
#ifndef CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_CANDIDATES_H
#define CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_CANDIDATES_H

#include <cstddef>
#include <span>
#include <vector>

#include "body_box.h"

namespace cellwalk::figure_8 {

/// By how much the box of a body is enlarged before its walls are kept: so many steps at the speed of the
/// trace.
inline constexpr double kept_steps = 5;

/// Candidate: has a member `box`, in which the wall lies.
template <class Candidate>
class Kept_candidates {
 public:
  explicit Kept_candidates(double steps) : steps_(steps) {}

  void reset(const Trace& trace) {
    margin_ = steps_ * trace.speed;
    if (bodies_.size() < trace.bodies) bodies_.resize(trace.bodies);
    for (Body& b : bodies_) b.box = Box::nowhere();
  }
  /// The walls that a body may meet in a step: those kept whose boxes meet that of the step. `query(box,
  /// list)` appends the candidates that meet a box.
  template <class Query, class Counter>
  std::span<const Candidate* const> find(std::size_t body, const Point<3>* positions, const Point<3>* targets,
                                         const Query& query, Counter& counter) {
    Body& b = bodies_[body];
    const Box now = body_box(positions, targets);
    if (!b.box.contains(now)) {
      b.box = now.enlarged(margin_);
      b.list.clear();
      counter.boxes();
      query(b.box, b.list);
      // Without a margin, nothing is kept for the next step.
      if (margin_ == 0) b.box = Box::nowhere();
    }
    near_.clear();
    for (const Candidate& c : b.list)
      if (experiments::meet(now, c.box)) near_.push_back(&c);
    return near_;
  }

 private:
  struct Body {
    Box box = Box::nowhere();
    std::vector<Candidate> list;
  };
  double steps_, margin_ = 0;
  std::vector<Body> bodies_;
  std::vector<const Candidate*> near_;
};

}  // namespace cellwalk::figure_8

#endif  // CELLWALK_EXPERIMENTS_FIGURE_8_PEERS_CANDIDATES_H
