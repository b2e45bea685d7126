// SPDX-License-Identifier: LGPL-3.0-or-later
#include "exact.h"

#include <boost/multiprecision/cpp_int.hpp>

namespace cellwalk::corpus {
namespace {

Vec minus(const Vec& a, const Vec& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Rational dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec negated(const Vec& a) { return {-a[0], -a[1], -a[2]}; }
bool is_zero(const Vec& a) { return a[0] == 0 && a[1] == 0 && a[2] == 0; }

/// The points x with normal . (x - origin) <= 0.
struct Half_space {
  Vec normal, origin;
};

/// Half-spaces whose intersection is the feature.
std::vector<Half_space> half_spaces(std::span<const Vec> feature) {
  std::vector<Half_space> result;
  const auto add_plane = [&](const Vec& normal) {
    result.push_back({normal, feature[0]});
    result.push_back({negated(normal), feature[0]});
  };
  if (feature.size() == 1) {
    for (std::size_t i = 0; i < 3; ++i) {
      Vec axis{};
      axis[i] = 1;
      add_plane(axis);
    }
    return result;
  }
  const Vec along = minus(feature[1], feature[0]);
  if (feature.size() == 2) {
    Vec across{};
    for (std::size_t i = 0; i < 3 && is_zero(across); ++i) {
      Vec axis{};
      axis[i] = 1;
      across = cross(along, axis);
    }
    add_plane(across);
    add_plane(cross(along, across));
    result.push_back({along, feature[1]});
    result.push_back({negated(along), feature[0]});
    return result;
  }
  const Vec normal = cross(along, minus(feature[2], feature[0]));
  add_plane(normal);
  for (std::size_t i = 0; i < 3; ++i)
    result.push_back({cross(minus(feature[(i + 1) % 3], feature[i]), normal), feature[i]});
  return result;
}

}  // namespace

Vec between(const Vec& a, const Vec& b, const Rational& t) {
  Vec r;
  for (std::size_t i = 0; i < 3; ++i) r[i] = a[i] + t * (b[i] - a[i]);
  return r;
}

bool meet(std::span<const Vec> hull, std::span<const Vec> feature) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto by_coordinate = [i](const Vec& x, const Vec& y) { return x[i] < y[i]; };
    const auto [low, high] = std::minmax_element(hull.begin(), hull.end(), by_coordinate);
    const auto [least, most] = std::minmax_element(feature.begin(), feature.end(), by_coordinate);
    if ((*high)[i] < (*least)[i] || (*most)[i] < (*low)[i]) return false;
  }
  std::vector<Vec> corners(hull.begin(), hull.end());
  for (const Half_space& h : half_spaces(feature)) {
    std::vector<Vec> left;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec &u = corners[i], &v = corners[(i + 1) % corners.size()];
      const Rational at_u = dot(h.normal, minus(u, h.origin)), at_v = dot(h.normal, minus(v, h.origin));
      if (at_u <= 0) left.push_back(u);
      if ((at_u < 0 && at_v > 0) || (at_u > 0 && at_v < 0))
        left.push_back(between(u, v, Rational(at_u / (at_u - at_v))));
    }
    corners = std::move(left);
    if (corners.empty()) return false;
  }
  return true;
}

std::string text(const Rational& x) { return x.str(); }

// GMP would round towards 0.
double rounded(const Rational& x) {
  return boost::multiprecision::cpp_rational(x.str()).convert_to<double>();
}

}  // namespace cellwalk::corpus
