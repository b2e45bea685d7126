// SPDX-License-Identifier: LGPL-3.0-or-later
// The region free of walls in which a body moves without tests, and the vertices and edges that are stale
// since. Theory: docs/bodies.md, clearance.
#ifndef CELLWALK_BODY_REGION_REGION_CACHE_H
#define CELLWALK_BODY_REGION_REGION_CACHE_H

#include <cellwalk/internal/body/certificates.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "body/shape/body_topology.h"
#include "clear_region.h"

namespace cellwalk::detail {

template <int D>
class Region_cache {
 public:
  /// \param radius that walls keep from the body
  Region_cache(std::size_t vertices, std::size_t edges, const Body_certificates& certificates, double radius)
      : certificates_(certificates),
        radius_(radius),
        is_outside_(vertices),
        outside_neighbours_(vertices),
        is_vertex_stale_(vertices),
        is_edge_stale_(edges) {}

  bool has_region() const { return region_.has_value(); }
  /// The region, or null.
  const Clear_region<D>* region() const { return region_ ? &*region_ : nullptr; }
  /// True if there is a region, and all vertices lie in it.
  bool holds_body() const { return region_ && outside_ == 0; }
  /// \pre there is a region
  bool holds_all(std::span<const Point<D>> points) const { return region_->holds_all(points); }
  bool holds(const Point<D>& x) const { return region_->holds(x); }
  const Particle<D>& anchor() const { return region_->anchor(); }
  /// True if a vertex lies in the region, and would at x.
  bool holds_way(std::uint32_t vertex, const Point<D>& x) const {
    return region_ && !is_outside_[vertex] && region_->holds(x);
  }
  /// The same, and its neighbours lie there too.
  bool holds_star(std::uint32_t vertex, const Point<D>& x) const {
    return region_ && !is_outside_[vertex] && outside_neighbours_[vertex] == 0 && region_->holds(x);
  }
  bool is_outside(std::uint32_t vertex) const { return is_outside_[vertex]; }
  void set_outside(std::uint32_t vertex, bool is_outside, const Body_topology& topology) {
    if (is_outside != static_cast<bool>(is_outside_[vertex])) change_outside(vertex, is_outside, topology);
  }
  void give_up() { region_.reset(); }

  /// Begins a step in which the region there is does not do: true if no other is to be looked for, or not
  /// yet.
  bool must_wait();
  /// The vertex about which the next region is looked for.
  std::uint32_t anchor_vertex() const { return anchor_vertex_; }
  /// Looks for a region that holds positions and targets as far as possible.
  std::optional<Clear_region<D>> search(const Snapshot<D>& snapshot, const Particle<D>& anchor,
                                        std::span<const Point<D>> positions,
                                        std::span<const Point<D>> targets, Body_counts& counts);
  /// True if some vertex lies outside of the region that there is, or of the one found.
  bool loses_vertices(const std::optional<Clear_region<D>>& found,
                      std::span<const Point<D>> positions) const {
    return outside_ != 0 || !found || !found->holds_all(positions);
  }
  /// Takes over the result of a search.
  /// \pre set_outside() was called where that changes
  /// Returns true if it holds the body and all targets.
  bool take(const std::optional<Clear_region<D>>& found, std::span<const Point<D>> targets,
            Body_counts& counts);

  // A vertex is stale that was moved in the region and not registered there; an edge, if its chain is not
  // known. Edges at a stale vertex are as well, marked or not.
  void mark_all_moved() { are_all_stale_ = true; }
  void mark_moved(std::uint32_t vertex) { is_vertex_stale_[vertex] = true; }
  void mark_moved(std::size_t first, std::size_t count) {
    std::fill_n(is_vertex_stale_.begin() + static_cast<std::ptrdiff_t>(first), count, true);
  }
  bool are_all_stale() const { return are_all_stale_; }
  bool is_any_stale() const {
    const auto is_set = [](char is_stale) { return is_stale != 0; };
    return are_all_stale_ || std::ranges::any_of(is_vertex_stale_, is_set) ||
           std::ranges::any_of(is_edge_stale_, is_set);
  }
  /// Marks each vertex after all were marked at once.
  void spread_marks();
  bool is_vertex_stale(std::uint32_t vertex) const { return is_vertex_stale_[vertex]; }
  bool is_edge_stale(std::uint32_t edge) const { return is_edge_stale_[edge]; }
  void mark_edge(std::uint32_t edge, bool is_stale) { is_edge_stale_[edge] = is_stale; }
  /// All that a copy has, but the certificates and the radius, by which it was made.
  template <class Archive>
  void archive(Archive& a) {
    a(region_, outside_, is_outside_, outside_neighbours_, are_all_stale_, is_vertex_stale_, is_edge_stale_);
    a(search_backoff_, target_backoff_, next_backoff_, steps_ahead_, anchor_vertex_);
  }

  /// True if the state that was read belongs to this number of vertices and edges.
  bool is_consistent(std::size_t vertices, std::size_t edges) const {
    return is_outside_.size() == vertices && outside_neighbours_.size() == vertices &&
           is_vertex_stale_.size() == vertices && is_edge_stale_.size() == edges && outside_ <= vertices &&
           (vertices == 0 || anchor_vertex_ < vertices);
  }

  /// The vertex is registered now: only its edges are stale.
  void pass_mark_on(std::uint32_t vertex, const Body_topology& topology);

 private:
  void change_outside(std::uint32_t vertex, bool is_outside, const Body_topology& topology);
  /// True if parts of the body may have regions of their own.
  bool has_parts() const { return is_outside_.size() >= certificates_.least_vertices_of_parts; }

  Body_certificates certificates_;
  double radius_;
  std::optional<Clear_region<D>> region_;
  std::uint32_t outside_ = 0;  ///< vertices not in it
  std::vector<char> is_outside_;
  std::vector<std::uint32_t> outside_neighbours_;  ///< of each vertex, how many
  bool are_all_stale_ = false;                     ///< all vertices
  std::vector<char> is_vertex_stale_, is_edge_stale_;
  // Searches that find nothing are repeated less and less often.
  std::uint32_t search_backoff_ = 0;  ///< steps until a region is looked for that holds all positions
  std::uint32_t target_backoff_ = 0;  ///< the same for targets, while all positions are held
  std::uint32_t next_backoff_ = 4;    ///< steps if that finds none
  double steps_ahead_ = Region_request<D>{}.steps_ahead;  ///< that the next region is to hold
  std::uint32_t anchor_vertex_ = 0;
};

extern template class Region_cache<2>;
extern template class Region_cache<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGION_REGION_CACHE_H
