// SPDX-License-Identifier: LGPL-3.0-or-later
// The public functions of Reshaping, each passed to the part that makes the change.
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "cut/cutter.h"
#include "cut/slitter.h"
#include "replace/relaxer.h"
#include "state.h"

namespace cellwalk {

template <int D>
Reshaping<D>::Reshaping(Environment<D>& environment, const Residents<D>& residents,
                        const Reshape_options& options)
    : state_(std::make_unique<detail::Reshaping_state<D>>(environment, residents, options)) {}

template <int D>
Reshaping<D>::~Reshaping() {
  try {
    if (state_) state_->finish();
  } catch (...) {  // memory: certificates stay withdrawn, and bodies refuse to go on
  }
}

template <int D>
Reshaping<D>::Reshaping(Reshaping&&) noexcept = default;

template <int D>
Reshaping<D>& Reshaping<D>::operator=(Reshaping&& other) noexcept {
  std::swap(state_, other.state_);
  return *this;
}

template <int D>
Vertex_result<D> Reshaping<D>::move(std::uint32_t point, const Point<D>& target) {
  return state_->move(point, target, true);
}

template <int D>
Move_report<D> Reshaping<D>::move(std::span<const Vertex_move<D>> moves) {
  state_->check_open();
  for (const auto& [point, target] : moves) state_->mover.check(point, target);
  Move_report<D> report;
  std::vector<std::size_t> left(moves.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  std::vector<Vertex_result<D>> last(moves.size());
  for (bool gets_on = true;
       gets_on && !left.empty() && static_cast<int>(report.rounds) < state_->options.most_rounds;) {
    gets_on = false;
    ++report.rounds;
    std::vector<std::size_t> still_left;
    for (const std::size_t i : left) {
      const auto& [point, target] = moves[i];
      Vertex_result<D>& result = last[i];
      result = state_->move(point, target, report.rounds == 1, &report.hits);
      if (result.end == Move_end::reached) {
        gets_on = true;
        continue;
      }
      still_left.push_back(i);
      const Point<D> from = result.position;
      if (result.end != Move_end::cell || !(result.share > 0)) continue;
      const Vertex_result<D> part =
          state_->move(point, from + 0.5 * result.share * (target - from), false, &report.hits);
      gets_on |= part.position != from;
      result.position = part.position;
    }
    std::reverse(still_left.begin(), still_left.end());
    left = std::move(still_left);
  }
  std::sort(left.begin(), left.end());
  for (const std::size_t i : left) report.short_of_target.push_back(last[i]);
  return report;
}

template <int D>
Vertex_result<D> Reshaping<D>::test_move(std::uint32_t point, const Point<D>& target) {
  return state_->attempt(point, target, detail::Reshaping_state<D>::Attempt::nothing, true);
}

template <int D>
Outcome Reshaping<D>::open(Half_facet facet) {
  return state_->restored_toggle().open(facet);
}

template <int D>
Outcome Reshaping<D>::close(Half_facet facet) {
  return state_->restored_toggle().close(facet);
}

template <int D>
Outcome Reshaping<D>::excavate(Cell cell) {
  return state_->restored_toggle().excavate(cell);
}

template <int D>
Outcome Reshaping<D>::fill(Cell cell) {
  return state_->restored_toggle().fill(cell);
}

template <int D>
Replacement Reshaping<D>::insert_point(Cell cell, const Point<D>& position) {
  state_->check_open();
  return state_->replacer.insert_point(cell, position);
}

template <int D>
Replacement Reshaping<D>::split_edge(std::uint32_t u, std::uint32_t v, const Point<D>& position) {
  state_->check_open();
  return state_->replacer.split_edge(u, v, position);
}

template <int D>
Replacement Reshaping<D>::flip(Half_facet facet) {
  state_->check_open();
  return state_->replacer.flip(facet);
}

template <int D>
Replacement Reshaping<D>::remove_edge(std::uint32_t u, std::uint32_t v) {
  state_->check_open();
  return state_->replacer.remove_edge(u, v);
}

template <int D>
Replacement Reshaping<D>::collapse(std::uint32_t u, std::uint32_t onto) {
  state_->check_open();
  return state_->replacer.collapse(u, onto);
}

template <int D>
Replacement Reshaping<D>::split_vertex(std::uint32_t vertex, std::span<const Cell> solid,
                                       const Point<D>& target) {
  detail::Splitter<D>& splitter = state_->restored_splitter();
  const Snapshot<D>& snapshot = state_->environment.snapshot();
  if (!is_finite(target))
    throw Error(Error_code::input, "the new position is not finite: correct its coordinates");
  for (const Cell c : solid)
    if (!snapshot.is_cell(c) || !snapshot.is_solid(c) || snapshot.view(c).vertex_count() != D + 1 ||
        std::ranges::find(snapshot.view(c).vertices, vertex) == snapshot.view(c).vertices.end())
      throw Error(Error_code::usage,
                  "cell " +
                      (snapshot.is_cell(c) ? std::to_string(snapshot.index(c)) : "of a name that is gone") +
                      " is no solid simplex with point " + std::to_string(vertex));
  for (auto c = solid.begin(); c != solid.end(); ++c)
    if (std::find(solid.begin(), c, *c) != c)
      throw Error(Error_code::usage, "cell " + std::to_string(snapshot.index(*c)) +
                                         " is named twice: name each cell that is taken back once");
  if (solid.empty()) throw Error(Error_code::usage, "no cells are to be taken back: name those in front");
  Replacement result;
  const auto point = splitter.split_vertex(vertex, solid, target, result.reason);
  result.is_made = point.has_value();
  if (!point) return result;
  result.point = *point;
  result.cells = state_->environment.cells_around(*point);
  return result;
}

template <int D>
Replacement Reshaping<D>::merge_vertices(std::uint32_t point, std::uint32_t onto) {
  state_->restored_splitter();
  state_->replacer.check_points(std::array{point, onto});
  if (point == onto) throw Error(Error_code::usage, "a point is merged with another, not with itself");
  return state_->merger.merge_vertices(point, onto);
}

template <int D>
Cut_report Reshaping<D>::cut(const Blade<D>& blade, const Cut_options<D>& options) {
  detail::Splitter<D>& splitter = state_->restored_splitter();
  if (!(options.opening > 0) || !std::isfinite(options.opening))
    throw Error(Error_code::input, "a cut is opened by a positive length");
  if (!(options.snap >= 0 && options.snap <= 0.5))
    throw Error(Error_code::input, "the share of an edge within which a cut passes its end lies in [0,0.5]");
  detail::Slitter<D> slitter(state_->environment, splitter, state_->toggle, blade, options);
  detail::Cutter<D> cutter(state_->environment, splitter, blade, options);
  cutter.prepare();
  slitter.prepare();
  return cutter.run(slitter.run());
}

template <int D>
Relax_report Reshaping<D>::relax(std::span<const std::uint32_t> points, const Relax_options& options) {
  state_->check_open();
  detail::Relaxer<D> relaxer(
      state_->environment, state_->replacer, options, [&](std::uint32_t point, const Point<D>& target) {
        return state_->attempt(point, target, detail::Reshaping_state<D>::Attempt::whether).end ==
               Move_end::reached;
      });
  return relaxer.run(points);
}

template <int D>
void Reshaping<D>::finish() {
  state_->finish();
}

template <int D>
const Reshape_counts& Reshaping<D>::counts() const {
  return state_->counts;
}

template class Reshaping<2>;
template class Reshaping<3>;

}  // namespace cellwalk
