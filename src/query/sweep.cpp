// SPDX-License-Identifier: LGPL-3.0-or-later
// The sweeps from all pairs of sides of the ends, of which the best one is the answer.
#include <cellwalk/edge/contact_search.h>
#include <cellwalk/internal/edge/all_chains.h>
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/query/query.h>

#include <list>
#include <vector>

#include "thick.h"

namespace cellwalk {
namespace {

/// An edge before it moves.
template <int D>
struct Start {
  Particle<D> p, q;
  Chain chain;
};

/// The starts of an edge that crosses no wall: one for each pair of sides of its ends.
/// \param has_choice set if the edge may pass walls in its line on other sides as well
template <int D>
std::list<Start<D>> starts(const Snapshot<D>& snapshot, const Locator<D>& locator, const Point<D>& p_at,
                           const Point<D>& q_at, bool& has_choice, Walk_counts& counts) {
  const auto all_p = locator.particles_at(p_at);
  const auto all_q = locator.particles_at(q_at);
  std::list<Start<D>> found;
  for (const Particle<D>& p : all_p)
    for (const Particle<D>& q : all_q) {
      const Chain_result<D> chain = find_any_chain(snapshot, p, q, counts);
      if (chain.contact) continue;
      const Start<D> start{p, q, chain.chain};
      found.push_back(start);
      has_choice |= chain.has_choice;
    }
  return found;
}

/// The starts of an edge with all ways past the walls in its line.
template <int D>
std::list<Start<D>> on_all_sides(const Snapshot<D>& snapshot, const std::list<Start<D>>& starts,
                                 Walk_counts& counts) {
  std::list<Start<D>> found;
  for (const Start<D>& start : starts)
    for (const Chain& chain : detail::all_chains(snapshot, start.p, start.q, counts).chains) {
      const Start<D> other{start.p, start.q, chain};
      found.push_back(other);
    }
  return found;
}

template <int D>
Answer<D> to_answer(const Sweep_result<D>& result) {
  if (result.contact) return {Motion_status::contact, result.cells, result.contact->cell, result.contact};
  return {Motion_status::free, result.cells, result.p.cell, {}};
}

}  // namespace

template <int D>
Answer<D> answer_sweep(const Snapshot<D>& snapshot, const Locator<D>& locator, const Edge_motion<D>& motion,
                       const Sweep_options& options, Edge_counts& counts) {
  if (motion.radius != 0)
    return answer_thick<D>(snapshot, locator, {motion.p, motion.target, motion.q, motion.radius}, options,
                           counts);
  detail::check_finite(motion.target, "the target of a motion");
  if (options.search) detail::check_search(*options.search);
  const auto sweep = [&](const Start<D>& start, const Sweep_options& chosen) {
    return to_answer(sweep_edge(snapshot, start.p, motion.target, start.q, start.chain, chosen, counts));
  };
  bool has_choice = false;
  const std::list<Start<D>> all = starts(snapshot, locator, motion.p, motion.q, has_choice, counts.walk);
  Answer<D> best;
  best.status = Motion_status::outside;
  if (all.empty()) return best;
  if (all.size() == 1 && !has_choice) return sweep(all.front(), options);

  Sweep_options exact = options;
  exact.search = nullptr;
  const Start<D>* best_start = nullptr;
  const auto try_all = [&](const std::list<Start<D>>& tried) {
    for (const Start<D>& start : tried) {
      const Answer<D> result = sweep(start, exact);
      if (best_start && result.contact && result.contact->exact_time() <= best.contact->exact_time())
        continue;
      best = result;
      best_start = &start;
      if (best.status == Motion_status::free) return;
    }
  };
  try_all(all);
  std::list<Start<D>> others;
  if (has_choice && best.status != Motion_status::free) {
    others = on_all_sides(snapshot, all, counts.walk);
    try_all(others);
  }
  if (best.status == Motion_status::free || !options.search) return best;
  return sweep(*best_start, options);
}

template Answer<2> answer_sweep(const Snapshot<2>&, const Locator<2>&, const Edge_motion<2>&,
                                const Sweep_options&, Edge_counts&);
template Answer<3> answer_sweep(const Snapshot<3>&, const Locator<3>&, const Edge_motion<3>&,
                                const Sweep_options&, Edge_counts&);

}  // namespace cellwalk
