// SPDX-License-Identifier: LGPL-3.0-or-later
// A walk as text: cells, signs and choices.
#ifndef CELLWALK_CLI_QUERY_WALK_LOG_H
#define CELLWALK_CLI_QUERY_WALK_LOG_H

#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/walk/strategy.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "cli/common/contact_kind_names.h"

namespace cellwalk::cli {

/// A walk and the cells that it visited.
template <int D>
struct Logged_walk {
  Walk_result<D> result;
  std::vector<Cell> visited;
};

template <class Kernel, int D>
Logged_walk<D> logged_walk(const Snapshot<D>& snapshot, const Particle<D>& particle, const Point<D>& to,
                           Walk_strategy strategy) {
  Logged_walk<D> logged;
  Walk_counts counts;
  logged.result = walk<Kernel>(snapshot, particle, to, counts, strategy, {&logged.visited});
  return logged;
}

/// A sign of a kernel, followed by the right one if it is wrong.
inline std::string sign_text(int sign, int exact) {
  return sign == exact ? fmt::format("{:+d}", sign) : fmt::format("{:+d} (exactly {:+d})", sign, exact);
}

/// The result of a walk, in one line.
template <int D>
std::string end_of(const Snapshot<D>& snapshot, const Walk_result<D>& result) {
  const std::uint32_t cell = snapshot.index(result.cell);
  switch (result.status) {
    case Walk_status::arrived:
      return fmt::format("arrives in cell {}, on a cell of dimension {}", cell, result.dimension);
    case Walk_status::contact:
      return fmt::format("is blocked in cell {} at time {} by a wall of cell {}: {}", cell,
                         result.contact->time, snapshot.index(snapshot.cell_of(result.contact->facet)),
                         contact_kind_names[static_cast<std::size_t>(result.contact->kind)]);
    case Walk_status::lost:
      break;
  }
  return fmt::format("is lost in cell {} after {} cells", cell, result.cells);
}

/// One cell of a walk: all its facets with the sign of the target, the ridges of those that have the target
/// outside, and the exit of the walk.
template <class Kernel, int D>
std::string step_text(const Snapshot<D>& snapshot, const Point<D>& from, const Point<D>& to, Cell cell,
                      Cell next) {
  const Cell_view<D> view = snapshot.view(cell);
  Walk_counts counts;
  std::string text, passages;
  for (std::size_t i = 0; i < view.facet_count(); ++i) {
    const Half_facet f = Snapshot<D>::half_facet(cell, i);
    const int side = detail::side<Kernel>(view, i, to, counts),
              exact = detail::side<Exact>(view, i, to, counts);
    const bool is_wall = snapshot.is_impassable(f);
    text += fmt::format(
        "    facet {}: target {}, {}", i, sign_text(side, exact),
        is_wall ? std::string("wall") : fmt::format("to cell {}", snapshot.index(snapshot.neighbour(f))));
    if (!is_wall && snapshot.neighbour(f) == next)
      passages += fmt::format("{}{}", passages.empty() ? "" : ", ", i);
    if (side > 0 || exact > 0) {
      text += "; line against its ridges";
      for (std::size_t k = 0; k < view.loop(i).size(); ++k)
        text += ' ' + sign_text(detail::along<Kernel>(view, i, k, from, to, counts),
                                detail::along<Exact>(view, i, k, from, to, counts));
    }
    text += '\n';
  }
  if (next == Cell::none) return text;
  return text +
         fmt::format("    goes on in cell {}, {}\n", snapshot.index(next),
                     passages.empty() ? "round a ridge or vertex" : "which is behind facet " + passages);
}

/// All steps of a walk; the first and last ones of a long one.
template <class Kernel, int D>
std::string log_text(const Snapshot<D>& snapshot, const Point<D>& from, const Point<D>& to,
                     const Logged_walk<D>& walk) {
  constexpr std::size_t most = 40;  // steps shown at either end
  std::string text;
  for (std::size_t k = 0; k < walk.visited.size(); ++k) {
    if (k == most && walk.visited.size() > 2 * most) {
      text += fmt::format("  ... {} steps are left out\n", walk.visited.size() - 2 * most);
      k = walk.visited.size() - most;
    }
    const Cell next = k + 1 < walk.visited.size() ? walk.visited[k + 1] : Cell::none;
    text += fmt::format("  step {}: cell {}\n", k + 1, snapshot.index(walk.visited[k]));
    text += step_text<Kernel>(snapshot, from, to, walk.visited[k], next);
  }
  return text + fmt::format("  {}\n", end_of(snapshot, walk.result));
}

/// The first difference of two walks of one motion, in one line.
template <int D>
std::string comparison(const Logged_walk<D>& walk, const Logged_walk<D>& exact) {
  const auto [here, there] =
      std::mismatch(walk.visited.begin(), walk.visited.end(), exact.visited.begin(), exact.visited.end());
  if (here != walk.visited.end() || there != exact.visited.end())
    return fmt::format("the walks part after step {}", here - walk.visited.begin());
  const auto& a = walk.result;
  const auto& b = exact.result;
  if (a.status != b.status) return "the same cells, but another end";
  if (a.contact && (a.contact->facet != b.contact->facet || a.contact->kind != b.contact->kind))
    return "the same cells, but another contact";
  if (a.dimension != b.dimension) return "the same cells, but another dimension";
  return "no difference";
}

}  // namespace cellwalk::cli

#endif  // CELLWALK_CLI_QUERY_WALK_LOG_H
