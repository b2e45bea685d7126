// SPDX-License-Identifier: LGPL-3.0-or-later
// The vertices, edges and faces with a radius, by place. Theory: docs/radius.md, walls that move and change.
#ifndef CELLWALK_RESHAPE_RESIDENTS_THICK_MEMBERS_H
#define CELLWALK_RESHAPE_RESIDENTS_THICK_MEMBERS_H

#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/walk/contact.h>

#include <boost/container/static_vector.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "member.h"

namespace cellwalk::detail {

/// A vertex without edges, an edge or a face.
template <int D>
struct Thick_member {
  Member member;
  Body_feature feature;
  double radius;                                              ///< greater than 0
  boost::container::static_vector<std::uint32_t, 3> corners;  ///< vertices of its body
  boost::container::static_vector<Point<D>, 3> points;        ///< where these are

  std::span<const Point<D>> hull() const { return {points.data(), points.size()}; }
};

/// Those of some bodies. A wall is too near to one if it is nearer than its radius, wherever cells are.
template <int D>
class Thick_members {
 public:
  Thick_members();
  ~Thick_members();

  void add(Thick_member<D> member);
  /// A vertex goes elsewhere.
  void move(Member vertex, const Point<D>& to) noexcept;
  /// Those that may be nearer than their radius to something in a box, in the order of add().
  /// Cost: a search in an R-tree, which is made at the first call.
  std::vector<const Thick_member<D>*> near(const Box<D>& box);
  /// Those that are nearer than that to the hull of a point, a segment or (3D) a convex polygon.
  std::vector<const Thick_member<D>*> nearer_to(std::span<const Point<D>> hull);

 private:
  struct Tree;
  std::vector<Thick_member<D>> members_;
  std::unique_ptr<Tree> tree_;  ///< of their boxes, once it is needed
};

extern template class Thick_members<2>;
extern template class Thick_members<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_RESIDENTS_THICK_MEMBERS_H
