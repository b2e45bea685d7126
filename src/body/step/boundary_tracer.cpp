// SPDX-License-Identifier: LGPL-3.0-or-later
// The legs of many motions, round after round: in each, those go on that met a wall which lets them. In the
// end the legs of each are put together.
#include <cellwalk/body/boundary_tracer.h>
#include <cellwalk/body/verified_stop.h>
#include <cellwalk/internal/body/stop_candidates.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <string>
#include <utility>

#include "slide.h"

namespace cellwalk {
namespace {

/// A vector that leads into a wall, mirrored in its plane.
template <int D>
Vector<D> mirror(const Vector<D>& v, const Vector<D>& normal) {
  return v - (2 * std::min(0.0, dot(v, normal))) * normal;
}

/// The legs of a round.
struct Round {
  std::vector<std::uint32_t> rows;  ///< of the motions, ascending
  Traces traces;
};

/// Appends a part of the values of a leg.
template <class Value>
void append(std::vector<Value>& to, const std::vector<Value>& from, std::uint64_t begin, std::uint64_t end) {
  to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
            from.begin() + static_cast<std::ptrdiff_t>(end));
}

/// Appends the rows of all motions. Those of a round are among those of the round before.
void append_rows(const std::vector<Round>& rounds, std::size_t rows, Traces& traces) {
  std::vector<std::size_t> next(rounds.size(), 0);
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = 0; k < rounds.size(); ++k) {
      const Traces& legs = rounds[k].traces;
      const std::size_t i = next[k];
      if (i == legs.size() || rounds[k].rows[i] != row) break;
      ++next[k];
      if (k == 0) {
        traces.ends.emplace_back();
      } else {
        traces.crossings.push_back(traces.ends.back().wall);
      }
      append(traces.cells, legs.cells, legs.offsets[i], legs.offsets[i + 1]);
      append(traces.lengths, legs.lengths, legs.offsets[i], legs.offsets[i + 1]);
      append(traces.crossings, legs.crossings, legs.crossing_offsets[i], legs.crossing_offsets[i + 1]);
      traces.ends.back() = legs.ends[i];
    }
    traces.offsets.push_back(traces.cells.size());
    traces.crossing_offsets.push_back(traces.crossings.size());
  }
}

}  // namespace

template <int D>
bool Boundary_tracer<D>::passes(const Passage& passage, Particle<D>& particle,
                                const Vector<D>& normal) const {
  const Point<D> there = particle.position + passage.translation;
  const double unit = std::max(detail::ulp<D>(there), detail::ulp<D>(particle.position));
  const auto is_found = [&](const Point<D>& x) {
    if (!is_finite(x)) return false;
    const Location<D> at = locator_.locate(x);
    for (std::size_t i = 0; i < at.cells.size(); ++i)
      if (passage.cells.contains(to_index(at.cells[i]))) {
        particle = at.sides[static_cast<std::size_t>(at.side_of_cell[i])];
        return true;
      }
    return false;
  };
  // Off the wall that is reached, which faces the other way.
  if (is_found(there)) return true;
  for (double shift = unit; shift <= passage.reach; shift *= 2)
    if (is_found(there - shift * normal)) return true;
  // At its rim off other walls, too.
  constexpr int directions = D == 2 ? 9 : 27;
  for (double shift = unit; shift <= passage.reach; shift *= 2)
    for (int direction = 0; direction < directions; ++direction) {
      Point<D> x = there;
      for (int k = 0, digits = direction; k < D; ++k, digits /= 3) x[k] += shift * (digits % 3 - 1);
      if (is_found(x)) return true;
    }
  return false;
}

template <int D>
bool Boundary_tracer<D>::goes_on(Half_facet wall, Particle<D>& particle, Point<D>& target, Vector<D>& heading,
                                 Walk_counts& counts) const {
  const auto answer = answers_.find(to_index(wall));
  if (answer == answers_.end()) return false;
  const Walk_result<D> result = walk<Exact>(snapshot_, particle, target, counts);
  const Point<D> from = particle.position;
  const Contact<D> contact = vertex_contact(snapshot_, from, target, result.contact.value(), counts);
  stop_at_contact(snapshot_, particle, target, contact, counts);
  Vector<D> rest = (1 - contact.time) * (target - from), off = contact.normal;  // off the wall it starts from
  if (answer->second == reflects) {
    heading = mirror<D>(heading, contact.normal);
    rest = mirror<D>(rest, contact.normal);
  } else {
    if (!passes(passages_[answer->second], particle, contact.normal)) return false;
    off = -1.0 * off;
  }
  // What leaves a wall by a few ulp may lead into it by rounding.
  const double unit =
      std::max({detail::ulp<D>(particle.position), detail::ulp<D>(from), detail::ulp<D>(rest)});
  const Vector<D> lift = (detail::contact_offset_ulps * unit) * off;
  target = particle.position + (dot(rest, off) < 2 * length(lift) ? rest + lift : rest);
  return is_finite(target);
}

template <int D>
void Boundary_tracer<D>::trace(std::span<Particle<D>> particles, std::span<const Point<D>> targets,
                               int most_bounces, Traces& traces, Walk_counts& counts,
                               std::span<Vector<D>> headings) const {
  if (most_bounces < 0)
    throw Error(Error_code::usage,
                "the number of bounces cannot be negative, and is " + std::to_string(most_bounces));
  std::vector<Round> rounds(1);
  std::vector<Particle<D>> moving(particles.begin(), particles.end());
  std::vector<Point<D>> goals(targets.begin(), targets.end());
  std::vector<Vector<D>> mirrored(particles.size());
  if (!headings.empty()) mirrored.assign(headings.begin(), headings.end());
  std::vector<std::pair<std::uint32_t, Particle<D>>> arrived;
  for (std::uint32_t row = 0; row < particles.size(); ++row) rounds[0].rows.push_back(row);
  while (!rounds.back().rows.empty()) {
    Round& round = rounds.back();
    tracer_.trace(moving, goals, round.traces, counts);
    Round next;
    for (std::size_t i = 0; i < moving.size(); ++i) {
      const Trace_end& end = round.traces.ends[i];
      if (end.status == Walk_status::arrived) arrived.emplace_back(round.rows[i], moving[i]);
      if (end.status != Walk_status::contact || rounds.size() > static_cast<std::size_t>(most_bounces) ||
          !goes_on(end.wall, moving[i], goals[i], mirrored[round.rows[i]], counts))
        continue;
      moving[next.rows.size()] = moving[i];
      goals[next.rows.size()] = goals[i];
      next.rows.push_back(round.rows[i]);
    }
    moving.resize(next.rows.size());
    goals.resize(next.rows.size());
    rounds.push_back(std::move(next));
  }
  append_rows(rounds, particles.size(), traces);
  for (const auto& [row, particle] : arrived) {
    particles[row] = particle;
    if (!headings.empty()) headings[row] = mirrored[row];
  }
}

template class Boundary_tracer<2>;
template class Boundary_tracer<3>;

}  // namespace cellwalk
