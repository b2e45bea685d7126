// SPDX-License-Identifier: LGPL-3.0-or-later
// The paper's method on a linear cell complex of one's own: built and cut with CGAL's functions, and walked
// from dart to dart. Nothing else of Cellwalk is needed, and no library of it is linked.
#include <cellwalk/lcc/contact_search.h>
#include <cellwalk/lcc/defect.h>
#include <cellwalk/lcc/walker.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>

#include <cstddef>
#include <cstdio>

using Lcc = CGAL::Linear_cell_complex_for_combinatorial_map<
    3, 3, CGAL::Linear_cell_complex_traits<3, CGAL::Exact_predicates_inexact_constructions_kernel>>;
using Point = Lcc::Point;
namespace lcc = cellwalk::lcc;

namespace {

//! [map]
/// Unit cubes in a row. Facets that fit are sewn, so that one passes them.
void add_row_of_cubes(Lcc& map, int count) {
  for (int x = 0; x < count; ++x)
    map.make_hexahedron(Point(x, 0, 0), Point(x + 1, 0, 0), Point(x + 1, 1, 0), Point(x, 1, 0),
                        Point(x, 1, 1), Point(x, 0, 1), Point(x + 1, 0, 1), Point(x + 1, 1, 1));
  map.sew3_same_facets();
}
//! [map]

/// A dart of the facet in the plane of points with this x.
Lcc::Dart_handle facet_at(Lcc& map, double x) {
  auto d = map.darts().begin();
  while (map.point(d).x() != x || map.point(map.beta<1>(d)).x() != x || map.point(map.beta<0>(d)).x() != x)
    ++d;
  return d;
}

}  // namespace

int main() {
  Lcc map;
  add_row_of_cubes(map, 4);

  //! [walls]
  // The last facet between two cubes is a membrane, marked on both sides.
  const auto wall = map.get_new_mark();
  map.mark_cell<2>(facet_at(map, 3), wall);
  const lcc::Walker<Lcc, lcc::Marked_walls<Lcc>> walker(map, {map, wall});
  if (lcc::find_defect(walker)) return 1;
  //! [walls]

  //! [walk]
  lcc::Counts counts;
  lcc::Particle<Lcc> p = walker.particles_at(Point(0.5, 0.5, 0.5)).at(0);
  const auto moved = walker.move(p, Point(2.5, 0.5, 0.5), counts);
  std::printf("arrives after %zu cells\n", moved.cells);
  const auto blocked = walker.move(p, Point(3.5, 0.5, 0.5), counts);
  std::printf("blocked after %g of its way, normal %g %g %g\n", CGAL::to_double(blocked.contact->time),
              blocked.contact->normal[0], blocked.contact->normal[1], blocked.contact->normal[2]);
  //! [walk]

  //! [cut]
  // Two cubes become one cell, and the next facet a fan of triangles: the motion passes exactly through its
  // middle.
  map.remove_cell<2>(facet_at(map, 1));
  map.insert_barycenter_in_cell<2>(facet_at(map, 2));
  if (lcc::find_defect(walker)) return 1;
  counts = {};
  const lcc::Particle<Lcc> again = walker.particles_at(Point(0.5, 0.5, 0.5)).at(0);
  const std::size_t cells = walker.walk(again, Point(2.5, 0.5, 0.5), counts).cells;
  std::printf("after cutting: %zu cells, %d vertex passed\n", cells, static_cast<int>(counts.stars));
  //! [cut]

  //! [edge]
  // Cubes around a bend: the edge meets the one at the inner corner while its end moves.
  Lcc bend;
  add_row_of_cubes(bend, 2);
  bend.make_hexahedron(Point(0, 1, 0), Point(1, 1, 0), Point(1, 2, 0), Point(0, 2, 0), Point(0, 2, 1),
                       Point(0, 1, 1), Point(1, 1, 1), Point(1, 2, 1));
  bend.sew3_same_facets();
  const lcc::Walker<Lcc> in_bend(bend);
  const auto q = in_bend.particles_at(Point(0.25, 1.5, 0.5)).at(0);
  const auto end = in_bend.particles_at(Point(1.5, 0.25, 0.5)).at(0);
  const Point target(1.5, 0.75, 0.5);
  const auto check = in_bend.check_edge(end, target, q, counts);
  const auto exact = lcc::exhaustive_search(in_bend, end, target, q, counts);
  const auto bisected = lcc::dichotomic_search(in_bend, end, target, q, 0x1p-20, counts);
  std::printf("the edge is %s after %g of the way of its end, by bisection %.6f\n",
              check.contact ? "blocked" : "free", CGAL::to_double(exact->time),
              CGAL::to_double(bisected->time));
  //! [edge]
  map.free_mark(wall);
  return 0;
}
