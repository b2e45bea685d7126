// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether a body can be somewhere in free space, on any sides of walls, and whether it is: by definition, in
// rational numbers. Of the library it uses which cells there are and how they are joined. 3D.
#ifndef CELLWALK_TESTS_BODY_REGISTRATION_LIFT_JUDGE_H
#define CELLWALK_TESTS_BODY_REGISTRATION_LIFT_JUDGE_H

#include <cellwalk/body/body.h>
#include <cellwalk/environment/snapshot.h>

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "body/registration/near_cells_exact.h"

namespace cellwalk::test {

/// The planes of all facets near cut the body into open pieces: points, segments and polygons. Each piece
/// lies in the same closed cells with all its points; those that are linked there are one side. The body is
/// in free space on some sides if each piece has a side such that the side of each piece, continued to one in
/// its border, is the side of that one. Faces with collinear corners have no pieces of their own.
class Lift_judge {
 public:
  Lift_judge(const Snapshot<3>& snapshot, const Body_soup<3>& soup);

  std::size_t plane_count() const { return near_.planes().size(); }
  std::size_t piece_count() const { return signs_.size(); }
  /// True if there are such sides.
  bool can_be_somewhere() const { return has_choice(domains_); }
  /// True if there are several: some piece has more than one side even where its neighbours are respected.
  bool may_choose() const;
  /// Empty if the vertices, chains and supporting walls of a body are such sides; else what is wrong.
  std::string fault(Body<3>& body) const;

 private:
  using Sides = std::vector<int>;  ///< of each cell near: the least cell linked with it there, or -1
  using Domain = std::vector<int>;
  using Piece = std::size_t;

  struct Edge_pieces {
    std::vector<Fraction> cuts;   ///< strictly between 0 and 1
    std::vector<Piece> in_order;  ///< the first end, a segment, a point, ..., the second end
  };
  class Face_cutter;

  Piece add(const Signs& signs, std::span<const std::size_t> near);
  void join(Piece piece, Piece border) { borders_.emplace_back(piece, border); }
  void cut_edge(std::uint32_t e);
  bool narrow(std::vector<Domain>& domains) const;
  bool has_choice(std::vector<Domain> domains) const;
  bool lies_in(Piece piece, Half_facet f, Cell cell) const;
  bool restrict_to(std::vector<Domain>& domains, Piece piece, int cell) const;
  bool follow_chain(const Body<3>& body, std::uint32_t e, std::vector<Domain>& domains) const;

  const Snapshot<3>& snapshot_;
  const Body_soup<3>& soup_;
  Near_cells_exact near_;
  std::vector<Signs> signs_;
  std::vector<Sides> sides_;
  std::vector<Domain> domains_;
  std::vector<std::pair<Piece, Piece>> borders_;
  std::vector<Edge_pieces> edges_;
  std::vector<std::vector<Piece>> faces_;  ///< the polygons of each
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_BODY_REGISTRATION_LIFT_JUDGE_H
