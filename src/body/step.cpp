// SPDX-License-Identifier: LGPL-3.0-or-later
// The step of a body: its vertices one after the other, stopped at walls and led along them.
#include <cellwalk/body/body.h>

#include <algorithm>
#include <cmath>

#include "slide.h"
#include "stop_candidates.h"

namespace cellwalk {
namespace {

/// Steps without a search after one that found no region: bodies near walls stay there for a while.
constexpr std::uint32_t steps_without_search = 8;
/// Regions larger than this many times the body are not looked for.
constexpr double largest_region = 4;
/// Nor are those smaller than this part of half the diagonal of its box.
constexpr double smallest_region = 0.5;
/// A search may look at so many cells: it must not cost more than the tests it saves.
constexpr std::size_t cells_per_vertex = 128, most_cells = 4096;

/// What is left of a motion that met walls, the last of them just now.
template <int D>
Vector<D> slide(const Vector<D>& motion, std::span<const Vector<D>> normals) {
  const Vector<D>& last = normals.back();
  const Vector<D> along = motion - std::min(0.0, dot(motion, last)) * last;
  for (std::size_t i = normals.size() - 1; i-- > 0;) {
    if (dot(along, normals[i]) >= 0) continue;
    const Vector<D> both = detail::along_both(along, last, normals[i]);
    const bool leads_out = std::all_of(normals.begin(), normals.end(),
                                       [&](const Vector<D>& n) { return dot(both, n) >= -0x1p-40; });
    return leads_out ? both : Vector<D>{};
  }
  return along;
}

}  // namespace

template <int D>
void Body<D>::step(std::span<const Point<D>> targets, const Body_options& options,
                   std::vector<Body_contact<D>>& contacts, Body_counts& counts) {
  if (positions_.empty()) return;
  counts.moves += positions_.size();
  if (stays_in_region(targets, options, counts)) {
    std::copy(targets.begin(), targets.end(), positions_.begin());
    is_behind_ = true;
    counts.in_region += positions_.size();
    return;
  }
  std::vector<Vector<D>> normals;
  for (std::uint32_t v = 0; v < positions_.size(); ++v) {
    Point<D> target = targets[v];
    normals.clear();
    for (int met = 0; met < options.most_contacts; ++met) {
      const auto contact = try_move(v, target, options, counts);
      if (!contact) break;
      ++counts.contacts;
      contacts.push_back(*contact);
      if (options.hold) {
        ++counts.held;
        break;
      }
      counts.held += !stop(v, target, *contact, options, counts);
      normals.push_back(contact->contact.normal);
      const Vector<D> left = slide<D>(targets[v] - positions_[v], normals);
      if (!(length(left) > 0)) break;
      target = positions_[v] + left + (detail::lift_ulps * detail::ulp<D>(positions_[v])) * normals.back();
      if (!is_finite(target)) break;
    }
  }
}

template <int D>
bool Body<D>::stop(std::uint32_t vertex, const Point<D>& target, const Body_contact<D>& met,
                   const Body_options& options, Body_counts& counts) {
  if (met.contact.impact == Exact_time()) return false;
  const Point<D> from = positions_[vertex];
  Body_options tried = options;
  tried.sweep.search = Contact_search::exact;  // whether there is a contact matters, not where
  return detail::try_stops<D>(from, target, met.contact, [&](const Point<D>& x) {
    if (x == from) return false;
    ++counts.stop_tries;
    return !try_move(vertex, x, tried, counts, true);
  });
}

template <int D>
bool Body<D>::stays_in_region(std::span<const Point<D>> targets, const Body_options& options,
                              Body_counts& counts) {
  if (!options.clearance || options.sweep.touch == Touch::stop) {
    catch_up(counts);
    region_.reset();
    return false;
  }
  const auto is_inside = [this](const Point<D>& x) { return region_->holds(x); };
  if (region_ && std::all_of(targets.begin(), targets.end(), is_inside)) return true;
  catch_up(counts);
  region_.reset();
  if (patience_ > 0) {
    --patience_;
    return false;
  }
  // A new region round the middle of the body, if a vertex sees that.
  Point<D> low = positions_[0], high = low;
  for (std::span<const Point<D>> points : {std::span<const Point<D>>(positions_), targets})
    for (const Point<D>& x : points)
      for (int k = 0; k < D; ++k) {
        low[k] = std::min(low[k], x[k]);
        high[k] = std::max(high[k], x[k]);
      }
  const Point<D> middle = low + 0.5 * (high - low);
  const double half = 0.5 * length(high - low);
  Particle<D> center = particles_[0];
  patience_ = steps_without_search;
  ++counts.no_region;
  if (!is_finite(middle) || !std::isfinite(half)) return false;
  if (move(*snapshot_, center, middle, counts.edges.walk).status != Walk_status::arrived) return false;
  region_ = clear_region(*snapshot_, center, smallest_region * half, std::max(largest_region * half, 1e-100),
                         std::min(most_cells, cells_per_vertex * positions_.size()));
  if (!region_) return false;
  const auto holds_all = [&](std::span<const Point<D>> points) {
    return std::all_of(points.begin(), points.end(), is_inside);
  };
  if (!holds_all(positions_) || !holds_all(targets)) {
    region_.reset();
    return false;
  }
  patience_ = 0;
  --counts.no_region;
  ++counts.regions;
  return true;
}

template <int D>
void Body<D>::catch_up(Body_counts& counts) {
  if (!is_behind_) return;
  is_behind_ = false;
  // Inside the region no wall is in the way from its centre, nor between two of its points.
  for (std::size_t v = 0; v < particles_.size(); ++v) {
    particles_[v] = region_->center;
    move(*snapshot_, particles_[v], positions_[v], counts.edges.walk);
  }
  counts.catch_ups += particles_.size();
  for (Face_rests& rests : rests_) rests.clear();
  for (std::size_t e = 0; e < edges_.size(); ++e)
    chains_[e] =
        find_chain(*snapshot_, particles_[edges_[e][0]], particles_[edges_[e][1]], counts.edges.walk).chain;
}

#define CELLWALK_INSTANTIATE(D)                                                                              \
  template void Body<D>::step(std::span<const Point<D>>, const Body_options&, std::vector<Body_contact<D>>&, \
                              Body_counts&);                                                                 \
  template bool Body<D>::stop(std::uint32_t, const Point<D>&, const Body_contact<D>&, const Body_options&,   \
                              Body_counts&);                                                                 \
  template bool Body<D>::stays_in_region(std::span<const Point<D>>, const Body_options&, Body_counts&);      \
  template void Body<D>::catch_up(Body_counts&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
