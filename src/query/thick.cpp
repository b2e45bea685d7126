// SPDX-License-Identifier: LGPL-3.0-or-later
// One sweep from any side of the start: with a radius, all sides give the same answer.
#include "thick.h"

#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/walk/walk.h>

namespace cellwalk {

template <int D>
Answer<D> answer_thick(const Snapshot<D>& snapshot, const Locator<D>& locator,
                       const detail::Thick_motion<D>& motion, const Sweep_options& options,
                       Edge_counts& counts) {
  if (!(motion.radius >= 0 && std::isfinite(motion.radius)))
    throw Error(Error_code::input, "a radius takes a finite number of at least 0");
  detail::check_thick_sweep(options);
  detail::check_finite(motion.target, "the target of a motion");
  if (motion.q) detail::check_finite(*motion.q, "the still end of an edge");
  const std::optional<Particle<D>> start = locator.particle_at(motion.p);
  Answer<D> answer;
  answer.status = Motion_status::outside;
  if (!start) return answer;
  const detail::Thick_result<D> result =
      detail::sweep_thick<D>(snapshot, start->cell, motion, counts, detail::part_of(options.sweep));
  answer.contact = result.contact;
  answer.cell = start->cell;
  if (result.starts_close) {
    answer.status = Motion_status::close;
    return answer;
  }
  answer.status = result.contact ? Motion_status::contact : Motion_status::free;
  // Up to there, nothing is in the way of the vertex.
  const Point<D> end =
      result.contact ? point_on<D>(motion.p, motion.target, result.contact->time) : motion.target;
  const Walk_result<D> walked = walk(snapshot, *start, end, counts.walk, {.locates_contact = false});
  answer.cells = walked.cells;
  answer.cell = walked.cell;
  if (answer.contact) answer.contact->cell = walked.cell;
  return answer;
}

template Answer<2> answer_thick<2>(const Snapshot<2>&, const Locator<2>&, const detail::Thick_motion<2>&,
                                   const Sweep_options&, Edge_counts&);
template Answer<3> answer_thick<3>(const Snapshot<3>&, const Locator<3>&, const detail::Thick_motion<3>&,
                                   const Sweep_options&, Edge_counts&);

}  // namespace cellwalk
