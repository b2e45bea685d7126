// SPDX-License-Identifier: LGPL-3.0-or-later
// Maps as users build and edit them, with CGAL's functions and items of their own.
#include <cellwalk/lcc/contact_search.h>
#include <cellwalk/lcc/defect.h>
#include <cellwalk/lcc/walker.h>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Linear_cell_complex_constructors.h>
#include <CGAL/Linear_cell_complex_for_combinatorial_map.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/version.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace cellwalk::lcc {
namespace {

template <int D, class Kernel = CGAL::Epick, class Items = CGAL::Linear_cell_complex_min_items>
using Complex =
    CGAL::Linear_cell_complex_for_combinatorial_map<D, D, CGAL::Linear_cell_complex_traits<D, Kernel>, Items>;
using Complex_2 = Complex<2>;
using Complex_3 = Complex<3>;
using Point_2 = Complex_2::Point;
using Point_3 = Complex_3::Point;

/// Unit cubes from the origin, sewn.
template <class Lcc>
void add_cubes(Lcc& map, int nx, int ny, int nz) {
  using Point = typename Lcc::Point;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        map.make_hexahedron(Point(x, y, z), Point(x + 1, y, z), Point(x + 1, y + 1, z), Point(x, y + 1, z),
                            Point(x, y + 1, z + 1), Point(x, y, z + 1), Point(x + 1, y, z + 1),
                            Point(x + 1, y + 1, z + 1));
  map.sew3_same_facets();
}

/// The dart from one point to another in a map of one cell.
Complex_3::Dart_handle dart_between(Complex_3& map, const Point_3& from, const Point_3& to) {
  for (auto it = map.darts().begin(); it != map.darts().end(); ++it)
    if (map.point(it) == from && map.point(map.beta<1>(it)) == to) return it;
  throw std::logic_error("no such edge");
}
/// The dart that starts at a point in a facet whose points all have the same z.
Complex_3::Dart_handle dart_at(Complex_3& map, const Point_3& from) {
  for (auto it = map.darts().begin(); it != map.darts().end(); ++it)
    if (map.point(it) == from && map.point(map.beta<1>(it)).z() == from.z() &&
        map.point(map.beta<0>(it)).z() == from.z())
      return it;
  throw std::logic_error("no such facet");
}
/// A dart of the facet between two cells.
Complex_3::Dart_handle inner_facet(Complex_3& map) {
  for (auto it = map.darts().begin(); it != map.darts().end(); ++it)
    if (!map.is_free<3>(it)) return it;
  throw std::logic_error("no inner facet");
}

/// Marks both sides of a facet.
template <class Lcc, class Dart_of>
void mark_facet(Lcc& map, Dart_of d, typename Lcc::size_type mark) {
  map.template mark_cell<2>(d, mark);
}

template <class Lcc>
void walk_through_cubes() {
  using Point = typename Lcc::Point;
  Lcc map;
  add_cubes(map, 3, 2, 2);
  const Walker<Lcc> walker(map);
  EXPECT_FALSE(find_defect(walker));
  Counts counts;
  const auto start = walker.particles_at(Point(0.5, 0.5, 0.5));
  ASSERT_EQ(start.size(), 1u);
  const auto across = walker.walk(start[0], Point(2.5, 0.75, 0.5), counts);
  EXPECT_EQ(across.status, Status::arrived);
  EXPECT_EQ(across.cells, 3u);
  EXPECT_EQ(counts.stars, 0u);
  // Exactly through an edge, and through the vertex (1,1,1).
  const auto by_edge = walker.walk(start[0], Point(1.5, 1.5, 0.5), counts);
  EXPECT_EQ(by_edge.status, Status::arrived);
  EXPECT_EQ(by_edge.cells, 2u);
  const auto by_vertex = walker.walk(start[0], Point(1.5, 1.5, 1.5), counts);
  EXPECT_EQ(by_vertex.status, Status::arrived);
  EXPECT_EQ(by_vertex.cells, 2u);
  EXPECT_EQ(counts.stars, 2u);
  const auto out = walker.walk(start[0], Point(0.5, 0.5, -1.5), counts);
  ASSERT_EQ(out.status, Status::contact);
  EXPECT_EQ(out.contact->time, Rational(1) / 4);
  EXPECT_EQ(out.contact->dimension, 2);
  EXPECT_EQ(out.contact->normal, (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(walker.particles_at(Point(9, 9, 9)).size(), 0u);
}

TEST(LccByHand, AnyKernel) {
  walk_through_cubes<Complex_3>();
  walk_through_cubes<Complex<3, CGAL::Epeck>>();
  walk_through_cubes<Complex<3, CGAL::Simple_cartesian<double>>>();
  walk_through_cubes<Complex<3, CGAL::Simple_cartesian<Rational>>>();
}

#if CGAL_VERSION_NR >= 1050600000
struct Index_items {
  using Use_index = CGAL::Tag_true;
  template <class Map>
  struct Dart_wrapper {
    using Vertex_attribute = CGAL::Cell_attribute_with_point<Map>;
    using Attributes = std::tuple<Vertex_attribute>;
  };
};
TEST(LccByHand, IndexBasedMap) { walk_through_cubes<Complex<3, CGAL::Epick, Index_items>>(); }
#endif

TEST(LccByHand, CellsInsertedAndRemovedByCgal) {
  Complex_3 map;
  add_cubes(map, 2, 1, 1);
  const Walker<Complex_3> walker(map);
  Counts counts;
  const auto start = walker.particles_at(Point_3(0.25, 0.5, 0.5)).at(0);
  const Point_3 target(1.75, 0.5, 0.5);
  EXPECT_EQ(walker.walk(start, target, counts).cells, 2u);

  // The facet between the cubes becomes four coplanar triangles, and the motion leads through their common
  // vertex.
  map.insert_barycenter_in_cell<2>(inner_facet(map));
  ASSERT_FALSE(find_defect(walker));
  counts = {};
  EXPECT_EQ(walker.walk(start, target, counts).cells, 2u);
  EXPECT_EQ(counts.stars, 1u);

  // Without them the cubes are one cell, whose long facets are pairs of coplanar ones.
  for (auto inner = map.darts().begin(); inner != map.darts().end();) {
    if (map.is_free<3>(inner)) {
      ++inner;
    } else {
      map.remove_cell<2>(inner);
      inner = map.darts().begin();
    }
  }
  ASSERT_FALSE(find_defect(walker));
  EXPECT_EQ(walker.walk(walker.particles_at(start.position).at(0), target, counts).cells, 1u);
}

TEST(LccByHand, CellCutInTwoByCgal) {
  Complex_3 map;
  add_cubes(map, 1, 1, 1);
  const Walker<Complex_3> walker(map);
  // Along the plane x + y = 1: diagonals of two facets, then a facet between them.
  const Point_3 a(1, 0, 0), b(0, 1, 0), c(0, 1, 1), d(1, 0, 1);
  map.insert_cell_1_in_cell_2(dart_at(map, a), dart_at(map, b));
  map.insert_cell_1_in_cell_2(dart_at(map, c), dart_at(map, d));
  std::vector<Complex_3::Dart_handle> path{dart_between(map, a, b), dart_between(map, b, c),
                                           dart_between(map, c, d), dart_between(map, d, a)};
  ASSERT_TRUE(map.is_insertable_cell_2_in_cell_3(path.begin(), path.end()));
  map.insert_cell_2_in_cell_3(path.begin(), path.end());
  ASSERT_FALSE(find_defect(walker));
  Counts counts;
  const auto start = walker.particles_at(Point_3(0.25, 0.25, 0.5)).at(0);
  EXPECT_EQ(walker.walk(start, Point_3(0.75, 0.75, 0.5), counts).cells, 2u);
  EXPECT_EQ(walker.walk(start, Point_3(0.5, 0.5, 0.5), counts).cells, 1u);
}

TEST(LccByHand, MarkedFacetsAreWalls) {
  Complex_3 map;
  add_cubes(map, 2, 1, 1);
  const auto mark = map.get_new_mark();
  for (auto it = map.darts().begin(); it != map.darts().end(); ++it)
    if (!map.is_free<3>(it) && !map.is_marked(it, mark)) mark_facet(map, it, mark);
  const Walker<Complex_3, Marked_walls<Complex_3>> walker(map, {map, mark});
  EXPECT_FALSE(find_defect(walker));
  Counts counts;
  auto p = walker.particles_at(Point_3(0.5, 0.5, 0.5)).at(0);
  const auto blocked = walker.move(p, Point_3(1.5, 0.5, 0.5), counts);
  ASSERT_EQ(blocked.status, Status::contact);
  EXPECT_EQ(blocked.contact->time, Rational(1) / 2);
  EXPECT_EQ(p.position, Point_3(0.5, 0.5, 0.5));
  // It touches the wall and slides along it.
  EXPECT_EQ(walker.move(p, Point_3(1, 0.5, 0.5), counts).status, Status::arrived);
  EXPECT_EQ(walker.move(p, Point_3(1, 0.75, 0.25), counts).status, Status::arrived);
  // The membrane has two sides there, and the particle is on its own.
  const auto sides = walker.particles_at(p.position);
  ASSERT_EQ(sides.size(), 2u);
  int own = 0;
  for (const auto& side : sides) own += walker.are_linked(p.dart, side.dart, p.position, counts);
  EXPECT_EQ(own, 1);
  EXPECT_EQ(walker.walk(p, Point_3(1.5, 0.75, 0.25), counts).contact->time, Rational(0));
  // An edge between both sides of the membrane crosses it, though both its ends lie in its plane.
  const auto& other = walker.are_linked(p.dart, sides[0].dart, p.position, counts) ? sides[1] : sides[0];
  const auto inside = walker.particles_at(Point_3(0.5, 0.5, 0.5)).at(0);
  const auto check = walker.check_edge(inside, Point_3(1, 0.5, 0.5), other, counts);
  EXPECT_EQ(check.status, Status::contact);
  EXPECT_FALSE(check.is_by_vertex);
  map.free_mark(mark);
}

/// Squares in the plane with one corner missing: an obstacle at (1,1).
void add_bend(Complex_2& map) {
  const auto square = [&](double x, double y) {
    return map.make_quadrangle(Point_2(x, y), Point_2(x + 1, y), Point_2(x + 1, y + 1), Point_2(x, y + 1));
  };
  const auto below = square(0, 0), right = square(1, 0), above = square(0, 1);
  map.sew<2>(map.beta<1>(below), map.beta<0>(right));
  map.sew<2>(map.beta<1, 1>(below), above);
}

TEST(LccByHand, BothSearchesFindTheCornerThatAnEdgeMeets) {
  Complex_2 map;
  add_bend(map);
  const Walker<Complex_2> walker(map);
  ASSERT_FALSE(find_defect(walker));
  Counts counts;
  const auto p = walker.particles_at(Point_2(1.5, 0.25)).at(0),
             q = walker.particles_at(Point_2(0.25, 1.5)).at(0);
  const Point_2 target(1.5, 0.75);
  const auto check = walker.check_edge(p, target, q, counts);
  ASSERT_EQ(check.status, Status::contact);
  EXPECT_FALSE(check.is_by_vertex);
  // The edge meets the corner (1,1) when p is at (1.5, 2/3), on the line from q through it.
  const auto exact = exhaustive_search(walker, p, target, q, counts);
  ASSERT_TRUE(exact);
  EXPECT_EQ(exact->time, Rational(5) / 6);
  EXPECT_EQ(exact->dimension, 0);
  EXPECT_EQ(map.point(exact->feature), Point_2(1, 1));
  EXPECT_LT(exact->normal[1], 0);
  const auto bisected = dichotomic_search(walker, p, target, q, 0x1p-30, counts);
  ASSERT_TRUE(bisected);
  EXPECT_LE(bisected->time, exact->time);
  EXPECT_LT(exact->time - bisected->time, Rational(0x1p-30));
  // Doubles do not resolve it: the search ends nevertheless.
  EXPECT_LE(dichotomic_search(walker, p, target, q, 1e-300, counts)->time, exact->time);
  EXPECT_FALSE(dichotomic_search(walker, p, Point_2(1.5, 0.3), q, 0x1p-30, counts));
  EXPECT_FALSE(exhaustive_search(walker, p, Point_2(1.5, 0.3), q, counts));
  // Where a wall stops p itself, both give its contact.
  for (const auto& contact : {exhaustive_search(walker, p, Point_2(2.5, 0.25), q, counts),
                              dichotomic_search(walker, p, Point_2(2.5, 0.25), q, 0x1p-30, counts)}) {
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->time, Rational(1) / 2);
  }
}

/// The edge meets a vertex of one wall and the interior of an edge of another one at the same time: the
/// vertex is the contact, in whatever order the facets of their cell are listed.
TEST(LccByHand, OfMeetingsAtOneTimeThatOfTheLowestDimensionIsTheContact) {
  std::array<int, 3> axis{0, 1, 2};
  do {
    const auto at = [&](double x, double y, double z) {
      std::array<double, 3> r{};
      r[axis[0]] = x, r[axis[1]] = y, r[axis[2]] = z;
      return Point_3(r[0], r[1], r[2]);
    };
    Complex_3 map;
    add_cubes(map, 3, 3, 3);
    // Of the cell from (1,1,0) to (2,2,1): the square of x = 2, and that of y = 2.
    const auto mark = map.get_new_mark();
    for (auto it = map.darts().begin(); it != map.darts().end(); ++it) {
      std::array<bool, 2> has{};
      for (auto d = map.beta<1>(it); d != it; d = map.beta<1>(d)) {
        has[0] |= map.point(it) == at(2, 1, 0) && map.point(d) == at(2, 2, 1);
        has[1] |= map.point(it) == at(1, 2, 0) && map.point(d) == at(2, 2, 1);
      }
      if ((has[0] || has[1]) && !map.is_marked(it, mark)) mark_facet(map, it, mark);
    }
    const Walker<Complex_3, Marked_walls<Complex_3>> walker(map, {map, mark});
    Counts counts;
    const auto p = walker.particles_at(at(2.5, 0.25, 1.125)).at(0),
               q = walker.particles_at(at(0.5, 2.5, 0.25)).at(0);
    const auto found = exhaustive_search(walker, p, at(2.5, 0.75, 1.375), q, counts);
    ASSERT_TRUE(found);
    // On the way from q to (2.5, 0.5, 1.25) lie (1, 2, 0.5) and (2, 1, 1).
    EXPECT_EQ(found->time, Rational(1) / 2);
    EXPECT_EQ(found->dimension, 0) << axis[0] << axis[1] << axis[2];
    EXPECT_EQ(map.point(found->feature), at(2, 1, 1));
    map.free_mark(mark);
  } while (std::next_permutation(axis.begin(), axis.end()));
}

TEST(LccByHand, WallAtTheStandingEnd) {
  // q lies in the cell on the lower left, at the corner (1,0), the moved end above. One passes there to the
  // lower right only. The facet from (2,0) to (3,0) is a wall in the same line that does not contain q.
  Complex_2 map;
  const auto first = map.make_combinatorial_polygon(6);
  auto d = first;
  for (const Point_2& x :
       {Point_2(0, 0), Point_2(1, 0), Point_2(2, 0), Point_2(3, 0), Point_2(3, 1), Point_2(0, 1)}) {
    map.set_vertex_attribute(d, map.create_vertex_attribute(x));
    d = map.beta<1>(d);
  }
  const auto left = map.make_quadrangle(Point_2(0, -1), Point_2(1, -1), Point_2(1, 0), Point_2(0, 0));
  const auto right = map.make_quadrangle(Point_2(1, -1), Point_2(2, -1), Point_2(2, 0), Point_2(1, 0));
  map.sew<2>(map.beta<1>(first), map.beta<1, 1>(right));
  const Walker<Complex_2> walker(map);
  ASSERT_FALSE(find_defect(walker));
  Counts counts;
  const Point_2 corner(1, 0);
  const auto check = walker.check_edge({Point_2(1, 0.5), first}, corner, {corner, left}, counts);
  ASSERT_EQ(check.status, Status::contact);
  EXPECT_FALSE(check.is_by_vertex);
  EXPECT_TRUE(map.point(check.contact->wall) == corner ||
              map.point(map.beta<1>(check.contact->wall)) == corner);
  EXPECT_EQ(map.point(check.contact->feature), corner);
}

/// The first defect of a map.
template <class Lcc, class... Walls>
std::optional<Defect_kind> defect_of(const Lcc& map, const Walls&... walls) {
  const auto found = find_defect(Walker(map, walls...));
  return found ? std::optional(found->kind) : std::nullopt;
}

TEST(LccByHand, DefectsAreFound) {
  {
    Complex_2 map;
    map.make_segment(Point_2(0, 0), Point_2(1, 0));
    EXPECT_EQ(defect_of(map), Defect_kind::open_cell);
  }
  {
    Complex_2 map;  // a reflex corner
    const auto d = map.make_quadrangle(Point_2(0, 0), Point_2(4, 0), Point_2(1, 1), Point_2(0, 4));
    (void)d;
    EXPECT_EQ(defect_of(map), Defect_kind::nonconvex_cell);
  }
  {
    Complex_2 map;
    map.make_triangle(Point_2(0, 0), Point_2(1, 0), Point_2(2, 0));
    EXPECT_EQ(defect_of(map), Defect_kind::flat_cell);
  }
  {
    Complex_2 map;
    map.make_triangle(Point_2(0, 0), Point_2(0, 0), Point_2(2, 0));
    EXPECT_EQ(defect_of(map), Defect_kind::flat_facet);
  }
  {
    Complex_2 map;  // cells of both orientations
    map.make_triangle(Point_2(0, 0), Point_2(1, 0), Point_2(0, 1));
    map.make_triangle(Point_2(5, 0), Point_2(5, 1), Point_2(6, 0));
    EXPECT_EQ(defect_of(map), Defect_kind::nonconvex_cell);
  }
  {
    Complex_2 map;
    map.make_combinatorial_polygon(4);  // without points
    EXPECT_EQ(defect_of(map), Defect_kind::open_cell);
  }
  for (int k = 0; k < 24; ++k) {  // at each dart, since a facet may begin at any of them
    Complex_3 map;
    add_cubes(map, 1, 1, 1);
    auto d = map.darts().begin();
    std::advance(d, k);
    map.insert_point_in_cell<1>(d, map.point(d));
    EXPECT_EQ(defect_of(map), Defect_kind::short_edge);
  }
  const auto hexahedron = [](Complex_3& map, const Point_3& corner) {
    return map.make_hexahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(1, 1, 0), Point_3(0, 1, 0),
                               Point_3(0, 1, 1), Point_3(0, 0, 1), Point_3(1, 0, 1), corner);
  };
  {
    Complex_3 map;
    hexahedron(map, Point_3(1, 1, 1.25));
    const auto kind = defect_of(map);
    EXPECT_TRUE(kind == Defect_kind::bent_facet || kind == Defect_kind::nonconvex_cell);
  }
  {
    Complex_3 map;
    map.make_tetrahedron(Point_3(0, 0, 0), Point_3(1, 0, 0), Point_3(0, 1, 0), Point_3(1, 1, 0));
    EXPECT_EQ(defect_of(map), Defect_kind::flat_cell);
  }
  {
    Complex_3 map;
    add_cubes(map, 2, 1, 1);
    const auto mark = map.get_new_mark();
    for (auto it = map.darts().begin(); it != map.darts().end(); ++it)
      if (!map.is_free<3>(it)) {
        map.mark(it, mark);  // of one dart only
        break;
      }
    EXPECT_EQ(defect_of(map, Marked_walls<Complex_3>(map, mark)), Defect_kind::one_sided_wall);
    map.free_mark(mark);
  }
}

}  // namespace
}  // namespace cellwalk::lcc
