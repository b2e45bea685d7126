// SPDX-License-Identifier: LGPL-3.0-or-later
// The walks from all sides of the start, of which the one that gets furthest is the answer.
#include <cellwalk/internal/edge/sweep_along.h>
#include <cellwalk/internal/kernel/check_finite.h>
#include <cellwalk/internal/query/kernel_choice.h>

#include <vector>

#include "thick.h"

namespace cellwalk {
namespace {

Motion_status to_status(Walk_status status) {
  switch (status) {
    case Walk_status::arrived:
      return Motion_status::free;
    case Walk_status::contact:
      return Motion_status::contact;
    case Walk_status::lost:
      break;
  }
  return Motion_status::lost;
}

template <class Kernel, int D>
Answer<D> move_from(const Snapshot<D>& snapshot, const Particle<D>& particle, const Point<D>& to, Touch touch,
                    Walk_strategy strategy, Edge_counts& counts) {
  const bool stops = touch == Touch::stop;
  const Walk_result<D> result =
      walk<Kernel>(snapshot, particle, to, counts.walk, strategy, {.locates_contact = !stops});
  Answer<D> answer{to_status(result.status), result.cells, result.cell, {}};
  if (stops) {
    answer.contact = first_touch(snapshot, particle, to, counts);
    if (answer.contact) {
      answer.status = Motion_status::contact;
      answer.cell = answer.contact->cell;
    }
  } else if (result.contact) {
    if constexpr (Kernel::is_exact)
      answer.contact = vertex_contact(snapshot, particle.position, to, *result.contact, counts.walk);
    else
      answer.contact = result.contact;
  }
  return answer;
}

template <class Kernel, int D>
Answer<D> answer(const Snapshot<D>& snapshot, const Locator<D>& locator, const Point<D>& from,
                 const Point<D>& to, Touch touch, Walk_strategy strategy, Edge_counts& counts) {
  const std::vector<Particle<D>> starts = locator.particles_at(from);
  Answer<D> best;
  best.status = Motion_status::outside;
  for (std::uint32_t side = 0; side < starts.size(); ++side) {
    Answer<D> result = move_from<Kernel>(snapshot, starts[side], to, touch, strategy, counts);
    result.side = side;
    const bool further = result.status == Motion_status::free ||
                         (result.contact && best.contact && result.contact->time > best.contact->time);
    if (best.status == Motion_status::outside || further) best = result;
    if (best.status == Motion_status::free) break;
  }
  return best;
}

}  // namespace

template <int D>
Answer<D> answer_move(const Snapshot<D>& snapshot, const Locator<D>& locator, const Point<D>& from,
                      const Point<D>& to, Touch touch, const Walk_method& method, Edge_counts& counts) {
  detail::check_finite(to, "the target of a motion");
  return with_kernel(method.kernel, [&](auto policy) {
    return answer<decltype(policy)>(snapshot, locator, from, to, touch, method.strategy, counts);
  });
}

template <int D>
Answer<D> answer_move(const Snapshot<D>& snapshot, const Locator<D>& locator, const Point<D>& from,
                      const Point<D>& to, Touch touch, Edge_counts& counts, double radius) {
  if (radius != 0) {
    Sweep_options options;
    options.touch = touch;
    return answer_thick<D>(snapshot, locator, {from, to, {}, radius}, options, counts);
  }
  return answer_move(snapshot, locator, from, to, touch, {}, counts);
}

template Answer<2> answer_move(const Snapshot<2>&, const Locator<2>&, const Point<2>&, const Point<2>&, Touch,
                               Edge_counts&, double);
template Answer<2> answer_move(const Snapshot<2>&, const Locator<2>&, const Point<2>&, const Point<2>&, Touch,
                               const Walk_method&, Edge_counts&);
template Answer<3> answer_move(const Snapshot<3>&, const Locator<3>&, const Point<3>&, const Point<3>&, Touch,
                               Edge_counts&, double);
template Answer<3> answer_move(const Snapshot<3>&, const Locator<3>&, const Point<3>&, const Point<3>&, Touch,
                               const Walk_method&, Edge_counts&);

}  // namespace cellwalk
