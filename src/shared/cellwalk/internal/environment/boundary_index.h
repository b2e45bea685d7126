// SPDX-License-Identifier: LGPL-3.0-or-later
// The boundary facets of an environment by position, kept while it is edited, with certificates that they do
// not meet. Theory: docs/moving.md.
#ifndef CELLWALK_INTERNAL_ENVIRONMENT_BOUNDARY_INDEX_H
#define CELLWALK_INTERNAL_ENVIRONMENT_BOUNDARY_INDEX_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/environment/box_grid.h>
#include <cellwalk/internal/environment/parting.h>
#include <cellwalk/internal/kernel/box.h>

#include <boost/container/small_vector.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cellwalk::detail {

/// The bounding box of cells.
template <int D>
Box<D> box_of(const Snapshot<D>& snapshot, std::span<const Cell> cells);

/// All boundary facets, in boxes around the zones of their vertices. A vertex is *clear* if each boundary
/// facet at it is parted from all others wherever all vertices are in their zones: then it may go anywhere in
/// its own, and nothing needs to be looked at. Does not refer to the snapshot.
template <int D>
class Boundary_index {
 public:
  /// Cost: linear in the number of facets.
  explicit Boundary_index(const Snapshot<D>& snapshot);

  /// The current boundary facets of cells.
  static std::vector<Half_facet> facets(const Snapshot<D>& snapshot, std::span<const Cell> cells);

  /// Follows an edit that replaces boundary facets by others. Points that are in use do not move.
  void replace(const Snapshot<D>& snapshot, std::span<const Half_facet> old, std::span<const Half_facet> now);

  /// The facets that meet a box with theirs, ascending.
  std::vector<Half_facet> meeting(std::span<const Point<D>> points, const Box<D>& box) const;

  /// True proves that no boundary facet at a point meets another one, but in the hull of common corners, on
  /// the whole straight way of the point to a target. Stores the data that follow() needs.
  /// \pre the point is on the boundary
  /// Cost: a comparison while the point stays in its zone; else a few us.
  bool is_way_free(std::span<const Point<D>> points, std::uint32_t point, const Point<D>& target);
  /// A point of the boundary was moved.
  /// Cost: nothing while it stays in its zone, little if is_way_free() was just called; else a few us.
  void follow(std::span<const Point<D>> points, std::uint32_t point);

 private:
  using Names = boost::container::small_vector<std::uint32_t, 8>;
  struct Vertex {
    Zone<D> zone;
    bool is_clear = false;
    Names facets;  ///< those at it
  };
  struct Facet {
    Half_facet name = Half_facet::none;
    Names corners;  ///< points
  };
  using Corner = Zoned_corner<D>;
  using Corners = std::array<Corner, static_cast<std::size_t>(D)>;
  /// The zone and the points that a way of a vertex needs.
  struct Way {
    std::uint32_t point = 0;
    Point<D> target{};                  ///< where it ends
    Zone<D> zone;                       ///< that of the vertex from then on
    std::vector<std::uint32_t> shrunk;  ///< points that need to have no zone, but the place where they are
    std::vector<std::array<std::uint32_t, 2>> met;  ///< facets that are not parted
  };

  Vertex& vertex(std::uint32_t point) { return vertices_[number_[point]]; }
  const Vertex& vertex(std::uint32_t point) const { return vertices_[number_[point]]; }
  void add(const Snapshot<D>& snapshot, Half_facet name);
  void remove(Half_facet name);
  Box<D> zone_box(const Facet& facet) const;
  bool is_simplex(std::uint32_t facet) const { return facets_[facet].corners.size() == std::size_t{D}; }
  Corners corners(std::uint32_t facet) const;
  void doubt(std::uint32_t facet);
  void find_way(std::span<const Point<D>> points, const Zoned_move<D>& move, bool stops);
  bool part(std::span<const Point<D>> points, const Zoned_move<D>& move, std::span<const Corner> low,
            std::span<const Corner> high, bool is_one_facet);
  void set_zone(std::uint32_t point, const Zone<D>& zone);

  static constexpr std::uint32_t none = 0xffffffffu;
  std::vector<std::uint32_t> number_;  ///< of the vertex of each point of the environment, or none
  std::vector<Vertex> vertices_;
  std::vector<Facet> facets_;
  std::vector<std::uint32_t> free_;  ///< places of removed facets
  std::unordered_map<std::uint32_t, std::uint32_t> facet_of_name_;
  Box_grid<D> grid_;
  Way way_;
  bool is_way_known_ = false;  ///< way_ was found free, and nothing has changed since
  std::vector<std::uint32_t> near_;
};

extern template class Boundary_index<2>;
extern template class Boundary_index<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_INTERNAL_ENVIRONMENT_BOUNDARY_INDEX_H
