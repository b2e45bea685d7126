// SPDX-License-Identifier: LGPL-3.0-or-later
// Regions free of walls that stand still while the parts of a body move through them. Theory: docs/bodies.md,
// clearance.
#ifndef CELLWALK_BODY_REGION_REGION_POOL_H
#define CELLWALK_BODY_REGION_REGION_POOL_H

#include <cellwalk/internal/body/certificates.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "body/shape/body_topology.h"
#include "clear_region.h"

namespace cellwalk::detail {

/// Each vertex has a list of some of the regions that hold its position.
template <int D>
class Region_pool {
 public:
  /// \param radius that walls keep from the body
  Region_pool(std::size_t vertices, const Body_certificates& certificates, double radius);

  /// True if regions of parts of the body are used: it is large enough, and the certificates include them.
  bool is_used() const { return is_used_; }
  /// True if some region is known to hold the vertex.
  bool holds(std::uint32_t vertex) const { return !known_.empty() && known_[vertex][0] != none; }
  /// One of those.
  /// \pre holds(vertex)
  const Clear_region<D>& region_of(std::uint32_t vertex) const {
    return regions_[static_cast<std::size_t>(known_[vertex][0])];
  }

  /// All regions that there are.
  std::span<const Clear_region<D>> regions() const { return regions_; }

  /// Makes the clusters about the vertices of a body, so that its first steps need not.
  void prepare(const Snapshot<D>& snapshot, std::span<const Particle<D>> particles) const;
  /// Begins a step, with or without regions.
  void begin_step(bool is_used);
  /// True if a region known to hold a vertex is known to hold its neighbours, and holds the target; then the
  /// vertex is taken to lie at the target.
  bool try_move_in_known(std::uint32_t vertex, const Point<D>& target, const Body_topology& topology);
  /// The same of any region that there is, where none of those does.
  bool try_move_in_other(std::uint32_t vertex, const Point<D>& target, std::span<const Point<D>> positions,
                         const Body_topology& topology);
  /// True if a region for a vertex should be looked for now.
  bool should_search(std::uint32_t vertex);
  /// Looks for a region that holds the same. True if it is found; then try_move_in_known() is true.
  /// \pre should_search(vertex), both others were false
  /// \param particle of the vertex, at its position
  bool search(const Snapshot<D>& snapshot, const Particle<D>& particle, std::uint32_t vertex,
              const Point<D>& target, std::span<const Point<D>> positions, const Body_topology& topology,
              Body_counts& counts);
  /// A vertex came to lie elsewhere.
  void place(std::uint32_t vertex, const Point<D>& position);
  /// A vertex is not known to lie in a region.
  void forget(std::uint32_t vertex);
  /// No vertex is.
  void forget_all();
  /// Edits of the environment void all regions.
  void clear();

  /// All members of a copy but those that follow from its certificates, by which it was made.
  template <class Archive>
  void archive(Archive& a) {
    std::vector<std::array<int, places_known>> known(known_.size());
    for (std::size_t v = 0; v < known.size(); ++v)
      for (int k = 0; k < places_known; ++k) known[v][static_cast<std::size_t>(k)] = known_[v][k];
    a(is_used_, known, wait_, waits_, regions_, users_, hand_, margin_, walls_left_);
    if constexpr (Archive::is_reading) {
      known_.resize(known.size());
      for (std::size_t v = 0; v < known.size(); ++v)
        known_[v] = Known{known[v][0], known[v][1], known[v][2], known[v][3]};
    }
  }
  /// True if all that was read refers to something.
  bool is_consistent(std::size_t vertices) const;

 private:
  static constexpr int none = -1;
  /// Regions that hold a vertex, the last found first, then `none`.
  using Known = Int4;
  static constexpr int places_known = 4;

  bool knows(std::uint32_t vertex, int region) const { return lane_mask(known_[vertex] == region) != 0; }
  std::uint32_t& users(int region) { return users_[static_cast<std::size_t>(region)]; }
  const Clear_region<D>& at(int region) const { return regions_[static_cast<std::size_t>(region)]; }
  bool know_star(std::uint32_t vertex, int region, const Body_topology& topology) const;
  void add(std::uint32_t vertex, int region);
  void stay_in(std::uint32_t vertex, int region, const Point<D>& position);
  bool take_in(std::uint32_t vertex, int region, std::span<const Point<D>> positions,
               const Body_topology& topology);
  /// A place for a region; `none` if there is none.
  int free_place();

  bool is_used_ = false;
  bool by_clusters_;
  double radius_;
  std::vector<Known> known_;         ///< of each vertex
  std::vector<std::uint8_t> wait_;   ///< of each vertex, moves until it may search again
  std::vector<std::uint8_t> waits_;  ///< such moves after its next search in vain
  std::vector<Clear_region<D>> regions_;
  std::vector<std::uint32_t> users_;  ///< vertices known to lie in each
  int hand_ = 0;                      ///< the place looked at next for one without vertices
  double margin_ = 1;                 ///< about a star, in its sizes
  std::size_t walls_left_ = 0;        ///< that may be looked at in this step
};

extern template class Region_pool<2>;
extern template class Region_pool<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGION_REGION_POOL_H
