// SPDX-License-Identifier: LGPL-3.0-or-later
// The nearest points of two hulls in doubles: of each edge and edge, and of each vertex and facet.
#include <boost/container/small_vector.hpp>

#include <algorithm>
#include <limits>

#include "filter.h"

namespace cellwalk::detail {
namespace {

double clamped(double x) { return x > 0 ? std::min(x, 1.0) : 0.0; }  // 0 for a NaN

/// The s at which the line w + s d is nearest to that of e; not a number if they are parallel.
double nearest_weight(const Vector<3>& d, const Vector<3>& e, const Vector<3>& w) {
  const Vector<3> n = cross(d, e);
  return dot(cross(e, w), n) / dot(n, n);
}
double nearest_weight(const Vector<2>& d, const Vector<2>& e, const Vector<2>& w) {
  return (e[0] * w[1] - e[1] * w[0]) / (d[0] * e[1] - d[1] * e[0]);
}

/// The search over pairs of features; points are relative to the first corner of b.
template <int D>
class Search {
 public:
  Search(std::span<const Point<D>> a, std::span<const Point<D>> b) {
    for (const Point<D>& x : a) a_.push_back(x - b[0]);
    for (const Point<D>& x : b) b_.push_back(x - b[0]);
  }

  Relative_nearest<D> run() {
    const auto with_side = [&](const Feature& side) {
      if (a_.size() == 1) edges({{0, 0, 0}, 2}, side);
      for_each_edge_of_simplex(a_.size(), [&](const Feature& edge) { edges(edge, side); });
    };
    if (b_.size() == 1) with_side({{0, 0, 0}, 2});
    for_each_side_of_polygon(b_.size(), with_side);
    if constexpr (D == 3) {
      for_each_triangle_of_polygon(b_.size(), [&](const Feature& facet) {
        for (std::size_t i = 0; i < a_.size(); ++i)
          vertex_and_facet(a_[i], vertex_feature(i), b_, facet, true);
      });
      for_each_facet_of_simplex(a_.size(), [&](const Feature& facet) {
        for (std::size_t i = 0; i < b_.size(); ++i)
          vertex_and_facet(b_[i], vertex_feature(i), a_, facet, false);
      });
    }
    best_.distance = std::sqrt(best_square_);
    return best_;
  }

 private:
  using Points = boost::container::small_vector<Point<D>, 8>;

  void keep(const Feature_pair& features, const Point<D>& on_a, const Point<D>& on_b) {
    const Vector<D> between = on_b - on_a;
    const double square = dot(between, between);
    if (square < best_square_) {
      best_ = {features, on_a, on_b, 0};
      best_square_ = square;
    }
  }

  /// The end of an edge at a weight of 0 or 1, otherwise the edge.
  static Feature feature_at(const Feature& edge, double weight) {
    return weight <= 0   ? vertex_feature(edge.corners[0])
           : weight >= 1 ? vertex_feature(edge.corners[1])
                         : edge;
  }

  /// Either edge may be a point.
  void edges(const Feature& of_a, const Feature& of_b) {
    const Point<D>&x = a_[of_a.corners[0]], &y = b_[of_b.corners[0]];
    const Vector<D> d = a_[of_a.corners[1]] - x, e = b_[of_b.corners[1]] - y, w = x - y;
    const double dd = dot(d, d), ee = dot(e, e), de = dot(d, e), dw = dot(d, w), ew = dot(e, w);
    // The nearest point of the lines, then of the ends that bound it. By vector products, since products of
    // lengths would cancel where the lines are nearly parallel.
    double s = clamped(nearest_weight(d, e, w));
    double t = (de * s + ew) / ee;
    if (!(t > 0)) {
      t = 0;
      s = clamped(-dw / dd);
    } else if (t >= 1) {
      t = 1;
      s = clamped((de - dw) / dd);
    }
    // An end is taken as it is, not as the sum that is rounded.
    const auto at = [](const Feature& f, const Points& points, const Vector<D>& edge, double weight) {
      return weight >= 1 ? points[f.corners[1]] : points[f.corners[0]] + weight * edge;
    };
    keep({feature_at(of_a, s), feature_at(of_b, t)}, at(of_a, a_, d, s), at(of_b, b_, e, t));
  }

  /// If the foot of a vertex lies in a facet of the other hull.
  void vertex_and_facet(const Point<D>& x, const Feature& vertex, const Points& others, const Feature& facet,
                        bool is_of_a) {
    const Point<D>& corner = others[facet.corners[0]];
    const Vector<D> u = others[facet.corners[1]] - corner, v = others[facet.corners[2]] - corner,
                    w = x - corner, n = cross(u, v);
    const double squared = dot(n, n);
    const double m = dot(cross(w, v), n) / squared, l = dot(cross(u, w), n) / squared;
    if (!(m >= 0 && l >= 0 && m + l <= 1 - 0x1p-50)) return;
    const Point<D> foot = (corner + m * u) + l * v;
    if (is_of_a)
      keep({vertex, facet}, x, foot);
    else
      keep({facet, vertex}, foot, x);
  }

  Points a_, b_;
  Relative_nearest<D> best_;
  double best_square_ = std::numeric_limits<double>::infinity();
};

}  // namespace

template <int D>
Relative_nearest<D> nearest_features(std::span<const Point<D>> a, std::span<const Point<D>> b) {
  return Search<D>(a, b).run();
}

template Relative_nearest<2> nearest_features<2>(std::span<const Point<2>>, std::span<const Point<2>>);
template Relative_nearest<3> nearest_features<3>(std::span<const Point<3>>, std::span<const Point<3>>);

template <int D>
Nearest<D> nearest_in_doubles(std::span<const Point<D>> a, std::span<const Point<D>> b) {
  const Relative_nearest<D> found = nearest_features<D>(a, b);
  return {found.features, found.on_a + b[0], found.on_b + b[0]};
}

template Nearest<2> nearest_in_doubles<2>(std::span<const Point<2>>, std::span<const Point<2>>);
template Nearest<3> nearest_in_doubles<3>(std::span<const Point<3>>, std::span<const Point<3>>);

}  // namespace cellwalk::detail
