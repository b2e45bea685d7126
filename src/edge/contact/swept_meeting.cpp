// SPDX-License-Identifier: LGPL-3.0-or-later
// Features clipped in the triangle by their half-spaces, and the normals of their meetings.
#include "swept_meeting.h"

#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/walk/star.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "edge/exact/rational_segment.h"

namespace cellwalk::detail {
namespace {

/// A point of the triangle by its weights at a, b and q, up to a positive factor; or a function on the
/// triangle by its values there. Unlike coordinates, weights also serve if the triangle is a segment.
using Weights = Ring_vector<3>;

/// A corner of a polygon in the triangle, and a function that is 0 on the side from there to the next corner.
/// New corners are computed from the functions of two sides, not from other corners, so their weights stay
/// short.
struct Corner {
  Weights at, side;
};
using Polygon = boost::container::small_vector<Corner, 6>;

/// The common root of two functions.
/// \pre they have one in the triangle, and only one
Weights common_root(const Weights& f, const Weights& g) {
  Weights root = exact_cross(f, g);
  const auto is_negative = [](const Ring& x) { return CGAL::sign(x) == CGAL::NEGATIVE; };
  return std::any_of(root.begin(), root.end(), is_negative) ? negative(root) : root;
}

/// Keeps the part of a polygon on which a function is >= 0.
void clip(Polygon& polygon, const Weights& function) {
  const auto is_negative = [](const Ring& x) { return CGAL::sign(x) == CGAL::NEGATIVE; };
  if (std::none_of(function.begin(), function.end(), is_negative)) return;
  boost::container::small_vector<int, 8> signs;
  for (const Corner& corner : polygon) signs.push_back(CGAL::sign(exact_dot(function, corner.at)));
  if (std::all_of(signs.begin(), signs.end(), [](int sign) { return sign >= 0; })) return;
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const int here = signs[k], next = signs[k + 1 == polygon.size() ? 0 : k + 1];
    Corner& corner = polygon[k];
    std::optional<Weights> root;
    if (here * next < 0) root = common_root(corner.side, function);
    if (here > 0 && root) {
      kept.push_back({std::move(corner.at), std::move(corner.side)});
      kept.push_back({std::move(*root), function});
    } else if (root) {
      kept.push_back({std::move(*root), std::move(corner.side)});
    } else if (here == 0 && next < 0) {
      kept.push_back({std::move(corner.at), function});
    } else if (here >= 0) {
      kept.push_back(std::move(corner));
    }
  }
  polygon = std::move(kept);
}

/// True if x lies on the segment from u to v.
/// \pre the three points are collinear
template <int D>
bool lies_between(const Point<D>& u, const Point<D>& v, const Point<D>& x) {
  for (int i = 0; i < D; ++i)
    if (x[i] < std::min(u[i], v[i]) || x[i] > std::max(u[i], v[i])) return false;
  return true;
}

/// The part of the triangle that counts.
enum class Part { all, off_start };

template <int D>
std::optional<Meeting<D>> meeting_in_triangle(const Swept_triangle<D>& triangle,
                                              const Half_spaces<D>& feature, Part part = Part::off_start) {
  const std::array<Ring_vector<D>, 3> corners{exact<D>(triangle.a), exact<D>(triangle.b),
                                              exact<D>(triangle.q)};
  Polygon polygon{{{1, 0, 0}, {0, 0, 1}}, {{0, 1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, 1, 0}}};
  for (const Half_space<D>& h : feature) {
    clip(polygon, {h.at(corners[0]), h.at(corners[1]), h.at(corners[2])});
    if (polygon.empty()) return {};
  }
  const Weights* first = nullptr;
  Fraction time, off_p;
  bool goes_on = false;
  for (const Corner& corner : polygon) {
    const Weights& w = corner.at;
    const Ring off_q = w[0] + w[1];
    const bool is_q = CGAL::is_zero(off_q);  // the edge never leaves q
    if (is_q && part == Part::off_start) continue;
    const Fraction here = is_q ? Fraction(0) : Fraction(w[1], off_q),
                   here_off_p = is_q ? Fraction(1) : Fraction(w[2], off_q);
    goes_on |= here.sign() > 0;
    if (first && (here > time || (here == time && here_off_p >= off_p))) continue;
    first = &w;
    time = here;
    off_p = here_off_p;
  }
  if (!first || (part == Part::off_start && !goes_on)) return {};
  Meeting<D> meeting{time, {}, CGAL::is_zero((*first)[2])};
  meeting.point.denominator = (*first)[0] + (*first)[1] + (*first)[2];
  for (int i = 0; i < D; ++i)
    meeting.point.numerator[i] =
        (*first)[0] * corners[0][i] + (*first)[1] * corners[1][i] + (*first)[2] * corners[2][i];
  return meeting;
}

/// The meeting if p moves in the line of the edge. Off its start, the edge sweeps a part of the path of p.
template <int D>
std::optional<Meeting<D>> collinear_meeting(const Swept_triangle<D>& t, const Half_spaces<D>& feature) {
  if (lies_between<D>(t.a, t.q, t.b)) return {};
  if (!lies_between<D>(t.a, t.b, t.q)) return meeting_in_triangle<D>({t.a, t.b, t.a}, feature);
  auto meeting = meeting_in_triangle<D>({t.q, t.b, t.q}, feature);
  if (!meeting) return {};
  int axis = 0;
  while (t.a[axis] == t.b[axis]) ++axis;
  const Ring a(t.a[axis]), to_b = Ring(t.b[axis]) - a, to_q = Ring(t.q[axis]) - a;
  const Fraction& from_q = meeting->time;
  meeting->time =
      Fraction(to_q * from_q.denominator() + from_q.numerator() * (to_b - to_q), to_b * from_q.denominator());
  return meeting;
}

template <int D>
Vector<D> unit(Vector<D> v) {
  double largest = 0;
  for (const double x : v) largest = std::max(largest, std::abs(x));
  if (!(largest > 0) || !std::isfinite(largest)) return {};
  for (double& x : v) x /= largest;
  return normalized(v) + Vector<D>{};  // no negative zeros for readers of tables
}

/// v without its component along a unit vector.
template <int D>
Vector<D> across(const Vector<D>& v, const Vector<D>& along) {
  return v - dot(v, along) * along;
}

/// A direction perpendicular to the edge and the feature that it meets; its length is the sine of the angle
/// between them. All directions given are unit vectors, so that nothing depends on the scale.
Vector<2> perpendicular(const Snapshot<2>&, const Contact<2>&, const Vector<2>& edge, const Vector<2>&) {
  return {-edge[1], edge[0]};
}

Vector<3> perpendicular(const Snapshot<3>& snapshot, const Contact<3>& contact, const Vector<3>& edge,
                        const Vector<3>& back) {
  if (contact.kind == Contact_kind::vertex) return across<3>(back, edge);
  const Cell_view<3> cell = snapshot.view(snapshot.cell_of(contact.facet));
  const auto loop = cell.loop(snapshot.facet_of(contact.facet));
  const Point<3>&u = cell.point(loop[contact.corner]),
        &v = cell.point(loop[(contact.corner + 1) % loop.size()]);
  return cross(edge, unit<3>(v - u));
}

/// Sines and cosines of angles below this bound are due to rounding.
constexpr double parallel = 0x1p-40;

/// True if a unit vector points against a motion, given the unit vector opposite to the motion.
template <int D>
bool is_against(const Vector<D>& normal, const Vector<D>& back) {
  return dot(normal, back) > parallel;
}

}  // namespace

template <int D>
std::optional<Meeting<D>> first_meeting(const Swept_triangle<D>& triangle, const Half_spaces<D>& feature) {
  if (are_collinear(triangle.a, triangle.b, triangle.q)) return collinear_meeting<D>(triangle, feature);
  return meeting_in_triangle<D>(triangle, feature);
}

template <int D>
std::optional<Meeting<D>> first_closed_meeting(const Swept_triangle<D>& triangle,
                                               const Half_spaces<D>& feature) {
  return meeting_in_triangle<D>(triangle, feature, Part::all);
}

template <int D>
Vector<D> vertex_normal(const Swept_triangle<D>& triangle, const Vector<D>& of_wall) {
  const Vector<D> back = unit<D>(triangle.a - triangle.b);
  return dot(of_wall, back) < -parallel ? back : of_wall;
}

template <int D>
Vector<D> edge_normal(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle,
                      const Contact<D>& contact, const Vector<D>& of_wall) {
  const Vector<D> back = unit<D>(triangle.a - triangle.b);
  const Vector<D> edge = unit<D>(triangle.q - point_on<D>(triangle.a, triangle.b, contact.time));
  if (contact.kind == Contact_kind::facet) {
    // The edge may come from behind the wall; then it meets the other side of the wall.
    const Vector<D> behind = -1.0 * of_wall + Vector<D>{};
    if (is_against<D>(behind, back)) return behind;
  } else {
    const Vector<D> normal = perpendicular(snapshot, contact, edge, back);
    const Vector<D> either = D == 2 ? normal : unit<D>(normal);  // in 2D it has length 1
    const Vector<D> turned = (dot(normal, back) < 0 ? -1.0 : 1.0) * either + Vector<D>{};
    if (length(normal) > parallel && is_against<D>(turned, back)) return turned;
  }
  if (is_against<D>(of_wall, back)) return of_wall;
  // The edge is parallel to the feature, or all motion lies in one plane.
  const Vector<D> off_edge = across<D>(back, edge);
  return length(off_edge) > parallel ? unit<D>(off_edge) : length(back) > 0 ? back : of_wall;
}

template <int D>
Contact<D> contact_with(const Snapshot<D>& snapshot, const Swept_triangle<D>& triangle, Half_facet wall,
                        const Meeting<D>& meeting) {
  const Cell c = snapshot.cell_of(wall);
  const Cell_view<D> cell = snapshot.view(c);
  const std::size_t i = snapshot.facet_of(wall);
  Contact<D> contact;
  contact.set_time(to_time(meeting.time));
  contact.point = meeting.point.rounded();
  const Facet_feature feature = lowest_feature<D>(cell, i, meeting.point);
  contact.kind = feature.kind;
  contact.corner = feature.corner;
  contact.facet = wall;
  contact.cell = c;
  contact.body = meeting.at_p ? Body_feature::vertex : Body_feature::edge;
  const Vector<D> of_wall = inner_normal(cell, i);
  contact.normal =
      meeting.at_p ? vertex_normal<D>(triangle, of_wall) : edge_normal(snapshot, triangle, contact, of_wall);
  return contact;
}

#define CELLWALK_INSTANTIATE(D)                                                                         \
  template std::optional<Meeting<D>> first_meeting<D>(const Swept_triangle<D>&, const Half_spaces<D>&); \
  template std::optional<Meeting<D>> first_closed_meeting<D>(const Swept_triangle<D>&,                  \
                                                             const Half_spaces<D>&);                    \
  template Vector<D> vertex_normal<D>(const Swept_triangle<D>&, const Vector<D>&);                      \
  template Vector<D> edge_normal<D>(const Snapshot<D>&, const Swept_triangle<D>&, const Contact<D>&,    \
                                    const Vector<D>&);                                                  \
  template Contact<D> contact_with<D>(const Snapshot<D>&, const Swept_triangle<D>&, Half_facet,         \
                                      const Meeting<D>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
