// SPDX-License-Identifier: LGPL-3.0-or-later
#include "wall_judge.h"

#include <boost/multiprecision/gmp.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace cellwalk::ablation {
namespace {

using Fraction = boost::multiprecision::mpq_rational;

template <class Number>
using Vector_of = std::array<Number, 3>;

template <class Number>
Vector_of<Number> difference(const Point<3>& x, const Point<3>& y) {
  return {Number(x[0]) - Number(y[0]), Number(x[1]) - Number(y[1]), Number(x[2]) - Number(y[2])};
}

/// A rounded value and a bound of its error.
struct Rounded {
  long double value, error;
};

/// Each product and sum is off by 2^-64 of its size at most, differences too. 32 of them are more than there
/// are one after the other.
Rounded rounded_orientation(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& t) {
  const auto x = difference<long double>(q, p), y = difference<long double>(r, p),
             z = difference<long double>(t, p);
  long double sum = 0, size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const long double one = x[i] * y[j] * z[k], other = x[i] * y[k] * z[j];
    sum += one - other;
    size += std::abs(one) + std::abs(other);
  }
  return {sum, 32 * 0x1p-64L * size};
}

Fraction exact_orientation(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& t) {
  const auto x = difference<Fraction>(q, p), y = difference<Fraction>(r, p), z = difference<Fraction>(t, p);
  Fraction sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    sum += x[i] * (y[j] * z[k] - y[k] * z[j]);
  }
  return sum;
}

/// A polynomial of degree 2 on an interval, in the basis of Bernstein.
struct Parabola {
  std::array<Fraction, 3> values;

  /// Its sign, if the coefficients agree in it; otherwise 0.
  int certain_sign() const {
    const int sign = values[0].sign();
    return values[1].sign() == sign && values[2].sign() == sign ? sign : 0;
  }
  Fraction at(const Fraction& s) const {
    const Fraction r = 1 - s;
    return r * r * values[0] + 2 * r * s * values[1] + s * s * values[2];
  }
  /// The same on a part of the interval.
  Parabola within(const Fraction& low, const Fraction& high) const {
    const Fraction middle = (1 - low) * ((1 - high) * values[0] + high * values[1]) +
                            low * ((1 - high) * values[1] + high * values[2]);
    return {{at(low), middle, at(high)}};
  }
};

/// f(p(s), q(s)) of a function that is affine in both.
template <class Function>
Parabola parabola(const Moving_edge& e, const Function& f) {
  return {{f(e.a, e.c), (f(e.a, e.d) + f(e.b, e.c)) / 2, f(e.b, e.d)}};
}

/// The one root of f between low and high, where f is monotone and its signs differ.
class Root {
 public:
  Root(Parabola f, Fraction low, Fraction high)
      : f_(std::move(f)), low_(std::move(low)), high_(std::move(high)), sign_at_low_(f_.at(low_).sign()) {}

  /// The sign of another polynomial there; 0 if 200 bisections do not tell.
  int sign_of(const Parabola& g) {
    for (int i = 0; i < 200; ++i) {
      if (const int sign = g.within(low_, high_).certain_sign()) return sign;
      const Fraction middle = (low_ + high_) / 2;
      const int sign = f_.at(middle).sign();
      if (sign == 0) return g.at(middle).sign();
      (sign == sign_at_low_ ? low_ : high_) = middle;
    }
    return 0;
  }

 private:
  Parabola f_;
  Fraction low_, high_;
  int sign_at_low_;
};

/// A point off the plane of anything that is met, but for bad luck, which is found out.
Point<3> beside(const Point<3>& u, const Point<3>& v) {
  const double size = std::max({1.0, std::abs(v[0] - u[0]), std::abs(v[1] - u[1]), std::abs(v[2] - u[2])});
  return {u[0] + 0.7548776662 * size, u[1] + 0.5698402910 * size, u[2] + 0.3361970254 * size};
}

/// Whether the segments meet inside where they lie in one plane.
Verdict meeting_at(Root& root, const Moving_edge& e, const Point<3>& u, const Point<3>& v) {
  const Point<3> w = beside(u, v);
  const auto ends = [&](const Point<3>& a, const Point<3>& b) {
    const Fraction from = exact_orientation(u, v, w, a), to = exact_orientation(u, v, w, b);
    return Parabola{{from, (from + to) / 2, to}};
  };
  const auto seen_from = [&](const Point<3>& x) {
    return parabola(e, [&](const Point<3>& p, const Point<3>& q) { return exact_orientation(p, q, w, x); });
  };
  const int p = root.sign_of(ends(e.a, e.b)), q = root.sign_of(ends(e.c, e.d));
  if (p * q > 0) return Verdict::free;
  const int at_u = root.sign_of(seen_from(u)), at_v = root.sign_of(seen_from(v));
  if (at_u * at_v > 0) return Verdict::free;
  return p * q < 0 && at_u * at_v < 0 ? Verdict::blocked : Verdict::undecided;
}

Verdict exactly(const Moving_edge& e, const Point<3>& u, const Point<3>& v) {
  const Parabola f =
      parabola(e, [&](const Point<3>& p, const Point<3>& q) { return exact_orientation(p, q, u, v); });
  std::array<Fraction, 3> ends{0, 1, 1};
  std::size_t count = 2;
  const Fraction bend = f.values[0] - 2 * f.values[1] + f.values[2];
  if (bend != 0) {
    const Fraction vertex = (f.values[0] - f.values[1]) / bend;
    if (vertex > 0 && vertex < 1) {
      ends[1] = vertex;
      count = 3;
    }
  }
  Verdict result = Verdict::free;
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const int low = f.at(ends[i]).sign(), high = f.at(ends[i + 1]).sign();
    if (low == 0 || high == 0) result = Verdict::undecided;
    if (low * high >= 0) continue;
    Root root(f, ends[i], ends[i + 1]);
    const Verdict here = meeting_at(root, e, u, v);
    if (here == Verdict::blocked) return here;
    if (here == Verdict::undecided) result = here;
  }
  return result;
}

}  // namespace

int orientation_sign(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& t) {
  const Rounded rounded = rounded_orientation(p, q, r, t);
  if (std::abs(rounded.value) > rounded.error && rounded.error > 0x1p-900L) return rounded.value > 0 ? 1 : -1;
  return exact_orientation(p, q, r, t).sign();
}

Verdict point_meets_triangle(const Point<3>& a, const Point<3>& b, std::span<const Point<3>, 3> t) {
  const int at_a = orientation_sign(t[0], t[1], t[2], a), at_b = orientation_sign(t[0], t[1], t[2], b);
  if (at_a * at_b > 0 || a == b) return Verdict::free;
  bool has_zero = at_a == 0 || at_b == 0;
  int first = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const int sign = orientation_sign(a, b, t[i], t[(i + 1) % 3]);
    has_zero |= sign == 0;
    if (first * sign < 0) return Verdict::free;
    if (sign != 0) first = sign;
  }
  return has_zero ? Verdict::undecided : Verdict::blocked;
}

Verdict edge_passes_segment(const Moving_edge& e, const Point<3>& u, const Point<3>& v) {
  const Rounded ends[] = {rounded_orientation(e.a, e.c, u, v), rounded_orientation(e.b, e.d, u, v)};
  const Rounded one = rounded_orientation(e.a, e.d, u, v), other = rounded_orientation(e.b, e.c, u, v);
  const Rounded middle{one.value + other.value, 2 * (one.error + other.error)};
  const auto sign = [](const Rounded& x) {
    return x.error > 0x1p-900L ? int(x.value > x.error) - int(x.value < -x.error) : 0;
  };
  if (sign(ends[0]) != 0 && sign(ends[0]) == sign(ends[1]) && sign(ends[0]) == sign(middle))
    return Verdict::free;
  return exactly(e, u, v);
}

Wall_judge::Box Wall_judge::box_of(std::span<const Point<3>> points) {
  Point<3> low = points[0], high = low;
  for (const Point<3>& x : points)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}

template <class Visit>
bool Wall_judge::any_near(const Tree& tree, const Box& box, const Visit& visit) {
  for (auto at = tree.qbegin(boost::geometry::index::intersects(box)); at != tree.qend(); ++at)
    if (visit(at->second)) return true;
  return false;
}

Wall_judge::Wall_judge(const experiments::Wall_mesh& walls) {
  std::set<std::array<std::uint32_t, 2>> known;
  std::vector<std::pair<Box, std::uint32_t>> of_triangles, of_segments;
  for (std::uint32_t t = 0; t < walls.triangles.size(); ++t) {
    triangles_.push_back({walls.corner(t, 0), walls.corner(t, 1), walls.corner(t, 2)});
    of_triangles.emplace_back(box_of(triangles_.back()), t);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = std::minmax(walls.triangles[t][k], walls.triangles[t][(k + 1) % 3]);
      if (!known.insert({i, j}).second) continue;
      of_segments.emplace_back(box_of(std::array{walls.points[i], walls.points[j]}),
                               static_cast<std::uint32_t>(segments_.size()));
      segments_.push_back({walls.points[i], walls.points[j]});
    }
  }
  triangle_tree_ = Tree(of_triangles);
  segment_tree_ = Tree(of_segments);
}

Verdict Wall_judge::judge(const Moving_edge& edge) const {
  const Box box = box_of(std::array{edge.a, edge.b, edge.c, edge.d});
  bool is_decided = true;
  const auto note = [&is_decided](Verdict verdict) {
    is_decided &= verdict != Verdict::undecided;
    return verdict == Verdict::blocked;
  };
  const bool is_blocked = any_near(triangle_tree_, box,
                                   [&](std::uint32_t t) {
                                     return note(point_meets_triangle(edge.a, edge.b, triangles_[t])) ||
                                            note(point_meets_triangle(edge.c, edge.d, triangles_[t]));
                                   }) ||
                          any_near(segment_tree_, box, [&](std::uint32_t i) {
                            return note(edge_passes_segment(edge, segments_[i][0], segments_[i][1]));
                          });
  if (is_blocked) return Verdict::blocked;
  return is_decided ? Verdict::free : Verdict::undecided;
}

Verdict Wall_judge::judge_segment(const Point<3>& p, const Point<3>& q) const {
  Verdict result = Verdict::free;
  any_near(triangle_tree_, box_of(std::array{p, q}), [&](std::uint32_t t) {
    const Verdict here = point_meets_triangle(p, q, triangles_[t]);
    if (here != Verdict::free && result != Verdict::blocked) result = here;
    return here == Verdict::blocked;
  });
  return result;
}

}  // namespace cellwalk::ablation
