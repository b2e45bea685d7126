// SPDX-License-Identifier: LGPL-3.0-or-later
// The attempt of a move, shorter ways where something touches, and the push of residents that were met.
#include "state.h"

#include <cellwalk/internal/body/stop_candidates.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "move/thick_trial.h"
#include "move/wall_hit.h"

namespace cellwalk::detail {
namespace {

/// A vertex that touches something tries shorter ways, halved up to this number of times.
constexpr int touch_halvings = 6;
/// How much further than needed something is pushed, so that rounding does not bring it back.
constexpr double contact_offset_ulps = 16;

}  // namespace

/// The box of the cells around the point of the mover, before and after its move.
template <int D>
Box<D> Reshaping_state<D>::box_of_star(const Point<D>& target) const {
  Box<D> box;
  box.extend(target);
  for (const Cell c : mover.star()) {
    const Cell_view<D> view = mover.snapshot().view(c);
    for (std::size_t v = 0; v < view.vertex_count(); ++v) box.extend(view.point(v));
  }
  return box;
}

/// Moves the point to the target or leaves it where it is.
/// \param is_first whether this is the first attempt of the move in a call
template <int D>
Vertex_result<D> Reshaping_state<D>::attempt(std::uint32_t point, const Point<D>& target, Attempt kind,
                                             bool is_first) {
  check_open();
  const Star_check check = mover.begin(point, target);
  ++counts.moves;
  counts.cells += mover.star().size();
  Vertex_result<D> result;
  result.point = point;
  result.position = mover.from();
  if (check.defect != Star_defect::none) {
    result.end = check.defect == Star_defect::cell ? Move_end::cell : Move_end::boundary;
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
    if (is_free && kind != Attempt::nothing) trial.prepare();
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
bool Reshaping_state<D>::decide(const Point<D>& from, std::uint32_t point, bool any,
                                Vertex_result<D>& result) {
  if (!groups.has_open()) {
    trial.clear();
    return true;
  }
  const Moving_star<D> star(mover.snapshot(), point, from, mover.star(), counts.walk);
  counts.walls += star.walls().size();
  std::optional<Wall_hit<D>> hit = first_near_hit(star, groups, any);
  if (any && hit) {
    result.end = Move_end::touch;
    return false;
  }
  if (trial.run(star, mover.star(), any) && !hit) return true;
  if (const auto& collision = trial.collision();
      collision && !(hit && hit->exact_time() < to_time(collision->time)))
    hit = to_wall_hit(*collision, star, groups);
  result.end = hit ? Move_end::contact : Move_end::touch;
  result.hit = std::move(hit);
  return false;
}

/// \param hits if not null, all that the point meets is added
template <int D>
Vertex_result<D> Reshaping_state<D>::move(std::uint32_t point, const Point<D>& target, bool is_first,
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
  if (result.end == Move_end::contact && result.hit->exact_time() != Exact_time()) {
    Contact<D> contact;
    contact.set_time(result.hit->exact_time());
    contact.normal = -1.0 * result.hit->normal;
    try_stops<D>(from, target, contact, try_at);
  } else if (result.end == Move_end::touch) {
    for (int k = 1; k <= touch_halvings; ++k)
      if (try_at(from + std::ldexp(1.0, -k) * (target - from))) break;
  }
  return result;
}

/// Pushes the resident that was met along the normal, by the rest of the motion of the wall there, as far as
/// other walls allow; shared among the vertices of an edge or a face so that the point met moves by that
/// length. False if nothing moved.
template <int D>
bool Reshaping_state<D>::push(const Wall_hit<D>& hit, const Vector<D>& motion) {
  ++counts.pushes;
  const double left = hit.weights[0] * (1 - hit.time);
  double squares = 0;
  for (const double w : hit.resident_weights) squares += w * w;
  const double depth = std::max(0.0, left * dot(motion, hit.normal)) +
                       contact_offset_ulps * std::max(ulp<D>(hit.point), ulp<D>(Point<D>{} + motion));
  bool has_moved = false;
  const auto vertices = groups.vertices_of(hit.resident);
  for (std::size_t k = 0; k < vertices.size(); ++k)
    has_moved |=
        groups.push(vertices[k], (hit.resident_weights[k] / squares * depth) * hit.normal, options.body);
  return has_moved;
}

/// Facets and cells change between moves only: all certificates are made anew, since the data of the two
/// cells of a facet must hold for both.
template <int D>
Toggle<D>& Reshaping_state<D>::restored_toggle() {
  check_open();
  mover.restore();
  return toggle;
}

template <int D>
void Reshaping_state<D>::check_open() const {
  if (!is_open)
    throw Error(Error_code::usage, "the environment is not open for moves any more: make a new Reshaping");
}

template <int D>
void Reshaping_state<D>::finish() {
  if (!std::exchange(is_open, false)) return;
  mover.restore();
  if (!transaction.is_broken()) groups.follow_epoch();
}

template <int D>
Splitter<D>& Reshaping_state<D>::restored_splitter() {
  check_open();
  if (environment.is_frozen())
    throw Error(Error_code::usage, "the environment is frozen: thaw() it to cut it");
  mover.restore();
  return splitter;
}

template struct Reshaping_state<2>;
template struct Reshaping_state<3>;

}  // namespace cellwalk::detail
