// SPDX-License-Identifier: GPL-3.0-or-later
// Triangles in a plane, cut together with exact constructions.
#ifndef CELLWALK_MESHING_REPAIR_CUT_PLANE_H
#define CELLWALK_MESHING_REPAIR_CUT_PLANE_H

#ifndef CGAL_NO_CDT_2_WARNING
#define CGAL_NO_CDT_2_WARNING
#endif
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "facets.h"

namespace cellwalk::detail {

using Exact_kernel = CGAL::Exact_predicates_exact_constructions_kernel;

/// A point or segment in which a triangle meets others, twice the same point for a point.
using Trace = std::pair<Exact_kernel::Point_3, Exact_kernel::Point_3>;

/// Triangles in a plane, up to rounding, as one constrained triangulation: where several lie on each other,
/// they get the same parts. They are seen along the axis that is the nearest to the normal.
class Cut_plane {
  using E = Exact_kernel;

 public:
  /// \param triangle the plane's
  explicit Cut_plane(const E::Triangle_3& triangle);

  /// Adds a triangle in the plane.
  /// \param corners their numbers
  /// \return its number among those of the plane
  std::size_t add(const E::Triangle_3& triangle, const Triangle& corners);

  /// Cuts along a trace.
  void insert(const Trace& trace);

  /// True if all corners lie within a distance of the plane along the axis.
  bool contains(const E::Triangle_3& triangle, double distance) const;

  /// A triangle whose corners are moved into the plane along the axis, if they are within a distance of it.
  /// None are if it would have no area then.
  E::Triangle_3 snapped(const E::Triangle_3& other, double distance) const;

  /// The points on side k of a triangle, from its corner k to the next, without these.
  std::vector<E::Point_3> points_on_side(std::size_t triangle, int k) const;

  /// The parts of a triangle, oriented as it is.
  /// \param number of a point that is no corner
  std::vector<Triangle> parts(std::size_t triangle,
                              const std::function<std::uint32_t(const E::Point_3&)>& number) const;

 private:
  struct Number {
    std::uint32_t value = none;  ///< of a corner
  };
  static constexpr std::uint32_t none = 0xffffffffu;
  using Vertex_base = CGAL::Triangulation_vertex_base_with_info_2<Number, E>;
  using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<
      E, CGAL::Triangulation_data_structure_2<Vertex_base, CGAL::Constrained_triangulation_face_base_2<E>>,
      CGAL::Exact_intersections_tag>;
  using Vertex = Triangulation::Vertex_handle;
  using Face = Triangulation::Face_handle;

  struct Member {
    std::array<Vertex, 3> corners;
    Triangle numbers;
  };

  E::Point_2 seen(const E::Point_3& p) const;
  E::Point_3 lifted(const E::Point_2& p) const;
  bool is_near(const E::Point_3& p, double distance) const;
  /// The vertices on side k, with both ends.
  std::vector<Vertex> side(const Member& member, int k) const;

  E::Plane_3 plane_;
  int axis_ = 0;
  Triangulation triangulation_;
  std::vector<Member> members_;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_MESHING_REPAIR_CUT_PLANE_H
