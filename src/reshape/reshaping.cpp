// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/body/stop_candidates.h>
#include <cellwalk/internal/environment/vertex_mover.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/reshape/reshaping.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "cut/cutter.h"
#include "move/vertex_trial.h"
#include "move/wall_hit.h"
#include "replace/relaxer.h"
#include "residents/resident_groups.h"
#include "toggle/toggle.h"

namespace cellwalk {
namespace {

/// A vertex that touches something tries these shares of its way, halved so often.
constexpr int touch_halvings = 6;
/// How much further than needed something is pushed, so that rounding does not bring it back.
constexpr double contact_offset_ulps = 16;

}  // namespace

template <int D>
struct Reshaping<D>::State {
  State(Environment<D>& of, const Residents<D>& residents, const Reshape_options& given)
      : environment(of),
        options(given),
        groups(environment.snapshot(), residents),
        mover(environment),
        trial(groups, counts),
        toggle(environment, groups, counts.walk),
        replacer(environment, groups, mover, counts),
        tissue(environment, groups, toggle, counts) {}

  /// move: to the target, if that is free. whether: the same, but the result need not say what is met.
  /// nothing: it stays in any case.
  enum class Attempt : std::uint8_t { move, whether, nothing };
  Vertex_result<D> attempt(std::uint32_t point, const Point<D>& target, Attempt kind, bool is_first = false);
  bool decide(const Point<D>& from, std::uint32_t point, bool any, Vertex_result<D>& result);
  Vertex_result<D> move(std::uint32_t point, const Point<D>& target, bool is_first,
                        std::vector<Wall_hit<D>>* hits = nullptr);
  bool push(const Wall_hit<D>& hit, const Vector<D>& motion);
  detail::Box<D> box_of_star(const Point<D>& target) const;
  detail::Toggle<D>& restored_toggle();
  detail::Tissue_patch<D>& restored_tissue();
  void check_open() const;
  void close();

  Environment<D>& environment;
  Reshape_options options;
  Reshape_counts counts;
  detail::Resident_groups<D> groups;
  detail::Vertex_mover<D> mover;
  detail::Vertex_trial<D> trial;
  detail::Toggle<D> toggle;
  detail::Replacer<D> replacer;
  detail::Tissue_patch<D> tissue;
  bool is_open = true;
};

/// The box of the cells around the point of the mover, before and after its move.
template <int D>
detail::Box<D> Reshaping<D>::State::box_of_star(const Point<D>& target) const {
  detail::Box<D> box;
  box.extend(target);
  for (const Cell c : mover.star()) {
    const Cell_view<D> view = mover.snapshot().view(c);
    for (std::size_t v = 0; v < view.vertex_count(); ++v) box.extend(view.point(v));
  }
  return box;
}

/// Moves the point to the target or leaves it where it is.
/// \param is_first whether a call asks for this move for the first time
template <int D>
Vertex_result<D> Reshaping<D>::State::attempt(std::uint32_t point, const Point<D>& target, Attempt kind,
                                              bool is_first) {
  check_open();
  const detail::Star_check check = mover.begin(point, target);
  ++counts.moves;
  counts.cells += mover.star().size();
  Vertex_result<D> result;
  result.point = point;
  result.position = mover.from();
  if (check.defect != detail::Star_defect::none) {
    result.end = check.defect == detail::Star_defect::cell ? Move_end::cell : Move_end::boundary;
    result.cell = check.cell;
    result.share = check.share;
    return result;
  }
  if (target == mover.from()) return result;
  counts.opened += groups.open(box_of_star(target));
  mover.place();
  bool is_free = false;
  try {
    is_free = decide(mover.from(), point, kind == Attempt::whether, result);
    if (is_first && groups.has_open()) {
      counts.near += trial.near();
      counts.certified += trial.certified();
    }
  } catch (...) {
    mover.take_back();
    throw;
  }
  if (!is_free || kind == Attempt::nothing) {
    mover.take_back();
    if (is_free) result.position = target;
    return result;
  }
  trial.commit();
  mover.commit();
  ++counts.made;
  result.position = target;
  return result;
}

/// True if nothing is in the way of the point, which the snapshot has at its target.
template <int D>
bool Reshaping<D>::State::decide(const Point<D>& from, std::uint32_t point, bool any,
                                 Vertex_result<D>& result) {
  if (!groups.has_open()) {
    trial.clear();
    return true;
  }
  const detail::Moving_star<D> star(mover.snapshot(), point, from, mover.star(), counts.walk);
  counts.walls += star.walls().size();
  const detail::Obstruction met = trial.run(star, mover.star(), any);
  if (met.meeting == detail::Encounter::apart) return true;
  result.end = met.meeting == detail::Encounter::hit ? Move_end::contact : Move_end::touch;
  if (met.hit) result.hit = to_wall_hit(met, star, groups);
  return false;
}

/// \param hits if not null, all that the point meets is added
template <int D>
Vertex_result<D> Reshaping<D>::State::move(std::uint32_t point, const Point<D>& target, bool is_first,
                                           std::vector<Wall_hit<D>>* hits) {
  const auto go = [&] {
    Vertex_result<D> result = attempt(point, target, Attempt::move, std::exchange(is_first, false));
    if (hits && result.hit) hits->push_back(*result.hit);
    return result;
  };
  Vertex_result<D> result = go();
  if (options.at_contact == At_contact::hold) return result;
  if (options.at_contact == At_contact::push)
    for (int k = 0; k < options.most_pushes && result.hit; ++k) {
      if (!push(*result.hit, target - result.position)) break;
      result = go();
    }
  const Point<D> from = result.position;
  const auto try_at = [&](const Point<D>& x) {
    if (x == from || attempt(point, x, Attempt::whether).end != Move_end::reached) return false;
    result.position = x;
    return true;
  };
  if (result.end == Move_end::contact && result.hit->time != Exact_time()) {
    Contact<D> contact;
    contact.time = result.hit->time;
    contact.normal = -1.0 * result.hit->normal;
    detail::try_stops<D>(from, target, contact, try_at);
  } else if (result.end == Move_end::touch) {
    for (int k = 1; k <= touch_halvings; ++k)
      if (try_at(from + std::ldexp(1.0, -k) * (target - from))) break;
  }
  return result;
}

/// Moves what was met by what is left of the motion of the wall there, along the normal, as far as other
/// walls allow; shared among the vertices of an edge or a face so that the point met moves so far. False if
/// nothing moved.
template <int D>
bool Reshaping<D>::State::push(const Wall_hit<D>& hit, const Vector<D>& motion) {
  ++counts.pushes;
  const double left = hit.weights[0] * (1 - hit.time.rounded());
  double squares = 0;
  for (const double w : hit.resident_weights) squares += w * w;
  const double depth =
      std::max(0.0, left * dot(motion, hit.normal)) +
      contact_offset_ulps * std::max(detail::ulp<D>(hit.point), detail::ulp<D>(Point<D>{} + motion));
  bool has_moved = false;
  const auto vertices = groups.vertices_of(hit.resident);
  for (std::size_t k = 0; k < vertices.size(); ++k)
    has_moved |=
        groups.push(vertices[k], (hit.resident_weights[k] / squares * depth) * hit.normal, options.body);
  return has_moved;
}

/// Facets and cells change between moves only: all certificates are made anew, since what is written of the
/// two cells of a facet must hold for both.
template <int D>
detail::Toggle<D>& Reshaping<D>::State::restored_toggle() {
  check_open();
  mover.restore();
  return toggle;
}

template <int D>
void Reshaping<D>::State::check_open() const {
  if (!is_open)
    throw Error(Error_code::usage, "the environment is not open for moves any more: make a new Reshaping");
}

template <int D>
void Reshaping<D>::State::close() {
  if (!std::exchange(is_open, false)) return;
  mover.restore();
  if (!replacer.is_broken() && !tissue.is_broken()) groups.follow_epoch();
}

template <int D>
Reshaping<D>::Reshaping(Environment<D>& environment, const Residents<D>& residents,
                        const Reshape_options& options)
    : state_(std::make_unique<State>(environment, residents, options)) {}

template <int D>
Reshaping<D>::~Reshaping() {
  try {
    if (state_) state_->close();
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
Vertex_result<D> Reshaping<D>::ask(std::uint32_t point, const Point<D>& target) {
  return state_->attempt(point, target, State::Attempt::nothing, true);
}

template <int D>
Change_result Reshaping<D>::open(Half_facet facet) {
  return state_->restored_toggle().open(facet);
}

template <int D>
Change_result Reshaping<D>::close(Half_facet facet) {
  return state_->restored_toggle().close(facet);
}

template <int D>
Change_result Reshaping<D>::excavate(Cell cell) {
  return state_->restored_toggle().excavate(cell);
}

template <int D>
Change_result Reshaping<D>::fill(Cell cell) {
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
detail::Tissue_patch<D>& Reshaping<D>::State::restored_tissue() {
  check_open();
  if (environment.is_frozen())
    throw Error(Error_code::usage, "the environment is frozen: build it with its map to cut it");
  mover.restore();
  return tissue;
}

template <int D>
Replacement Reshaping<D>::peel(std::uint32_t vertex, std::span<const Cell> solid, const Point<D>& target) {
  detail::Tissue_patch<D>& tissue = state_->restored_tissue();
  const Snapshot<D>& snapshot = state_->environment.snapshot();
  if (!is_finite(target))
    throw Error(Error_code::input, "the new position is not finite: correct its coordinates");
  for (const Cell c : solid)
    if (!snapshot.is_cell(c) || !snapshot.is_solid(c) || snapshot.view(c).vertex_count() != D + 1 ||
        std::ranges::find(snapshot.view(c).vertices, vertex) == snapshot.view(c).vertices.end())
      throw Error(Error_code::usage, "cell " + std::to_string(to_index(c)) +
                                         " is no solid simplex with point " + std::to_string(vertex));
  if (solid.empty()) throw Error(Error_code::usage, "no cells are to be taken back: name those in front");
  Replacement result;
  const auto point = tissue.peel(vertex, solid, target, result.reason);
  result.is_made = point.has_value();
  if (!point) return result;
  result.point = *point;
  result.cells = state_->environment.cells_around(*point);
  return result;
}

template <int D>
Cut_report Reshaping<D>::cut(const Blade<D>& blade, const Cut_options<D>& options) {
  detail::Tissue_patch<D>& tissue = state_->restored_tissue();
  if (!(options.opening > 0) || !std::isfinite(options.opening))
    throw Error(Error_code::input, "a cut is opened by a positive length");
  return detail::Cutter<D>(state_->environment, tissue, blade, options).run();
}

template <int D>
Relax_report Reshaping<D>::relax(std::span<const std::uint32_t> points, const Relax_options& options) {
  state_->check_open();
  detail::Relaxer<D> relaxer(
      state_->environment, state_->replacer, options, [&](std::uint32_t point, const Point<D>& target) {
        return state_->attempt(point, target, State::Attempt::whether).end == Move_end::reached;
      });
  return relaxer.run(points);
}

template <int D>
void Reshaping<D>::close() {
  state_->close();
}

template <int D>
const Reshape_counts& Reshaping<D>::counts() const {
  return state_->counts;
}

template class Reshaping<2>;
template class Reshaping<3>;

}  // namespace cellwalk
