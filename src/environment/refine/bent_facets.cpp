// SPDX-License-Identifier: LGPL-3.0-or-later
// Ears cut off a convex polygon, the lowest vertex first: in either direction the same.
#include "bent_facets.h"

#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>

namespace cellwalk::detail {
namespace {

class Ear_cutter {
 public:
  Ear_cutter(std::span<const Point<3>> points, const Facet_loop& loop, double tolerance)
      : points_(points), ring_(loop), tolerance_(tolerance) {
    for (std::size_t i = 2; i < loop.size(); ++i) normal_ = normal_ + cross(at(i - 1) - at(0), at(i) - at(0));
    normal_ = normalized(normal_, {});
  }

  bool is_bent_and_convex() const {
    bool is_bent = false;
    for (std::size_t i = 0; i < ring_.size(); ++i) {
      const double height = height_at(i);
      if (height < -tolerance_) return false;
      is_bent |= height <= tolerance_ && !are_collinear(at(i), at(i + 1), at(i + 2));
    }
    return is_bent;
  }

  /// Nothing if no ear is left.
  std::vector<Facet_loop> triangles() {
    std::vector<Facet_loop> triangles;
    while (ring_.size() > 3) {
      std::size_t lowest = ring_.size();
      for (std::size_t i = 0; i < ring_.size(); ++i)
        if (is_ear(i) && (lowest == ring_.size() || middle(i) < middle(lowest))) lowest = i;
      if (lowest == ring_.size()) return {};
      triangles.push_back({vertex(lowest), vertex(lowest + 1), vertex(lowest + 2)});
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>((lowest + 1) % ring_.size()));
    }
    triangles.push_back(ring_);
    return triangles;
  }

 private:
  std::uint32_t vertex(std::size_t i) const { return ring_[i % ring_.size()]; }
  std::uint32_t middle(std::size_t i) const { return vertex(i + 1); }
  const Point<3>& at(std::size_t i) const { return points_[vertex(i)]; }

  /// Of the middle one of three vertices above the line of its neighbours; below it is not convex.
  double height_at(std::size_t i) const {
    const Vector<3> base = at(i + 2) - at(i);
    return dot(normal_, cross(at(i + 1) - at(i), base)) / length(base);
  }
  /// True if neither the triangle nor what it leaves is flat.
  bool is_ear(std::size_t i) {
    if (height_at(i) <= tolerance_) return false;
    const Facet_loop whole = ring_;
    ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>((i + 1) % ring_.size()));
    bool has_corner = false;
    for (std::size_t k = 0; k < ring_.size(); ++k) has_corner |= height_at(k) > tolerance_;
    ring_ = whole;
    return has_corner;
  }

  std::span<const Point<3>> points_;
  Facet_loop ring_;
  double tolerance_;
  Vector<3> normal_{};
};

}  // namespace

std::vector<Facet_loop> triangles_of_bent(std::span<const Point<3>> points, const Facet_loop& loop,
                                          double tolerance) {
  if (loop.size() == 3) return {};
  Ear_cutter cutter(points, loop, tolerance);
  return cutter.is_bent_and_convex() ? cutter.triangles() : std::vector<Facet_loop>{};
}

}  // namespace cellwalk::detail
