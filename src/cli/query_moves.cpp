// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cli/query_moves.h"

#include <cellwalk/walk/locate.h>

namespace cellwalk::cli {
namespace {

Status to_status(Walk_status status) {
  switch (status) {
    case Walk_status::arrived:
      return Status::free;
    case Walk_status::contact:
      return Status::contact;
    case Walk_status::lost:
      break;
  }
  return Status::lost;
}

/// `is_compared`: the exact time of a contact is wanted, not only its rounding.
template <class Kernel, int D>
Answer<D> move_from(const Snapshot<D>& snapshot, const Particle<D>& particle, const Point<D>& to,
                    const Move_options& options, bool is_compared, Edge_counts& counts) {
  std::vector<Cell> visited;
  const Walk_result<D> result = walk<Kernel>(snapshot, particle, to, counts.walk,
                                             {options.strategy, is_compared ? &visited : nullptr, nullptr});
  Answer<D> answer{to_status(result.status), result.cells, result.cell, {}};
  if (options.touch == Touch::stop) {
    answer.contact = first_touch(snapshot, particle, to, counts);
    if (answer.contact) {
      answer.status = Status::contact;
      answer.cell = answer.contact->cell;
    }
  } else if (result.contact) {
    answer.contact = Contact<D>{*result.contact, Body_feature::vertex, Exact_time(result.contact->time)};
    if (is_compared && Kernel::is_exact) {
      Way<D> way{particle, particle, visited, {}, true};
      way.to.position = to;
      answer.contact->impact = vertex_contact(snapshot, way, *result.contact, counts.walk).impact;
    }
  }
  return answer;
}

template <class Kernel, int D>
Answer<D> answer(const Snapshot<D>& snapshot, const Locator<D>& locator, const Move_query<D>& move,
                 const Move_options& options, Edge_counts& counts) {
  const auto& [from, to] = move.points;
  const Location<D> start = locator.locate(from);
  const bool has_sides = start.sides > 1;
  Answer<D> best;
  best.status = Status::outside;
  for (const Cell cell : start.cells) {
    const Particle<D> particle{from, cell, start.dimension, 0};
    const Answer<D> result = move_from<Kernel>(snapshot, particle, to, options, has_sides, counts);
    const bool further = result.status == Status::free ||
                         (result.contact && best.contact && result.contact->impact > best.contact->impact);
    if (best.status == Status::outside || further) best = result;
    if (!has_sides || best.status == Status::free) break;
  }
  return best;
}

template <class Kernel, int D>
std::vector<Answer<D>> answer_all(const Snapshot<D>& snapshot, const std::vector<Move_query<D>>& moves,
                                  const Move_options& options, Edge_counts& total) {
  const Locator<D> locator(snapshot);
  return answer_rows(moves, "walking", total, [&](const Move_query<D>& move, Edge_counts& counts) {
    return answer<Kernel>(snapshot, locator, move, options, counts);
  });
}

}  // namespace

template <int D>
std::vector<Answer<D>> answer_moves(const Snapshot<D>& snapshot, const std::vector<Move_query<D>>& moves,
                                    const Move_options& options, Edge_counts& counts) {
  return with_kernel(options.kernel, [&](auto policy) {
    return answer_all<decltype(policy)>(snapshot, moves, options, counts);
  });
}

template std::vector<Answer<2>> answer_moves(const Snapshot<2>&, const std::vector<Move_query<2>>&,
                                             const Move_options&, Edge_counts&);
template std::vector<Answer<3>> answer_moves(const Snapshot<3>&, const std::vector<Move_query<3>>&,
                                             const Move_options&, Edge_counts&);

}  // namespace cellwalk::cli
