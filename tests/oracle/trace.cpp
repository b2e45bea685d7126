// SPDX-License-Identifier: LGPL-3.0-or-later
#include "oracle/trace.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace cellwalk::oracle {
namespace {

/// Merges the classes of visits joined by passable facets that hold the events first..last.
std::vector<int> linked_classes(const Trace& trace, int first, int last) {
  std::vector<int> parent(trace.visits.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (const Incidence& i : trace.incidences)
    if (i.passable && i.first <= first && last <= i.last) parent[root(i.visit)] = root(i.neighbour);
  std::vector<int> result(trace.visits.size(), -1);
  for (std::size_t v = 0; v < result.size(); ++v)
    if (trace.visits[v].first <= first && last <= trace.visits[v].last) result[v] = root(static_cast<int>(v));
  return result;
}

}  // namespace

int Trace::visit_of(std::uint32_t cell) const {
  for (std::size_t v = 0; v < visits.size(); ++v)
    if (visits[v].cell == cell) return static_cast<int>(v);
  return -1;
}

std::vector<int> Trace::classes_at(int event) const { return linked_classes(*this, event, event); }

std::vector<int> Trace::classes_after(int event) const { return linked_classes(*this, event, event + 1); }

Truth judge(const Trace& trace, std::uint32_t start) {
  const int start_visit = trace.visit_of(start);
  if (start_visit < 0 || trace.visits[start_visit].first != 0)
    throw std::invalid_argument("the motion does not start in its cell");
  Truth truth;
  std::vector<int> states{start_visit};  // visits the motion may be in as it reaches the event
  for (int event = 0; event < trace.last_event() && !states.empty(); ++event) {
    const std::vector<int> at = trace.classes_at(event);
    const std::vector<int> after = trace.classes_after(event);
    std::vector<int> next;
    for (std::size_t v = 0; v < after.size(); ++v)
      if (after[v] >= 0 && std::any_of(states.begin(), states.end(), [&](int s) { return at[s] == at[v]; }))
        next.push_back(static_cast<int>(v));
    for (int s : states)
      if (std::none_of(next.begin(), next.end(), [&](int v) { return at[v] == at[s]; }))
        truth.stops.push_back({trace.visits[s].cell, event, trace.visits[s].dimension_at_last});
    truth.choices += std::any_of(next.begin(), next.end(), [&](int v) {
      return std::any_of(next.begin(), next.end(),
                         [&](int w) { return at[v] == at[w] && after[v] != after[w]; });
    });
    truth.unique_cells = truth.unique_cells && next.size() <= 1;
    states = std::move(next);
  }
  for (int s : states) truth.arrivals.push_back(trace.visits[s].cell);
  return truth;
}

Path_fault check_path(const Trace& trace, std::uint32_t start, std::span<const std::uint32_t> path) {
  if (path.empty() || path.front() != start) return Path_fault::wrong_start;
  int current = trace.visit_of(start);
  if (current < 0 || trace.visits[current].first != 0) return Path_fault::not_met;
  int event = 0;  // at which the motion came into the current cell
  for (const std::uint32_t cell : path.subspan(1)) {
    const int next = trace.visit_of(cell);
    if (next < 0) return Path_fault::not_met;
    const int last = trace.visits[current].last;
    const auto is_linked = [&](int e) {
      const std::vector<int> at = trace.classes_at(e);
      return at[next] >= 0 && at[next] == at[current];
    };
    while (event < last && !is_linked(event)) ++event;
    if (event == trace.last_event() || trace.visits[next].last <= event) return Path_fault::no_further_piece;
    if (!is_linked(event)) return Path_fault::not_linked;
    current = next;
  }
  return Path_fault::none;
}

}  // namespace cellwalk::oracle
