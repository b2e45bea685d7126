// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge of edges with a radius: verifies answers (docs/radius.md) in a lattice that was placed by a
// similarity, so that distances can be measured in its units.
//
// Two hulls are at least r apart if min n.b - max n.a >= r |n| for some n, over their corners a and b (Cauchy
// and Schwarz), and, where they are, for one of a finite list: differences of corners, parts of these across
// edges, products of edges, normals. Each direction is tried in doubles, then in numbers of 113 bits, at last
// in integers.
#ifndef CELLWALK_EXPERIMENTS_ENDURANCE_THICK_JUDGE_H
#define CELLWALK_EXPERIMENTS_ENDURANCE_THICK_JUDGE_H

#include <cellwalk/query/query.h>

#include <vector>

#include "sweep_judge.h"

namespace cellwalk::endurance {

enum class Thick_fault {
  none,
  wrong_start,    ///< close or outside, though the start is free
  false_free,     ///< free, though the triangle comes nearer to a wall than the radius
  false_contact,  ///< blocked, though it does not come nearer to the wall that is named
  late,           ///< it comes nearer to a wall before the time
  early,          ///< it does not come nearer to the wall right after the time
  wrong_wall,     ///< names a facet that is no wall in reach
  wrong_point,    ///< not at the distance of the radius from the edge at that time
  count
};
inline constexpr std::array<const char*, 8> thick_fault_names{
    "none", "wrong_start", "false_free", "false_contact", "late", "early", "wrong_wall", "wrong_point"};

template <int D>
class Thick_judge {
 public:
  Thick_judge(const Lattice<D>& lattice, int bits);

  /// True if the edge keeps the radius from all walls before it moves.
  bool starts_free(const Edge_sites<D>& move, Whole radius);

  /// \pre the start is free, in free space
  Thick_fault fault_of(const World<D>& world, const Edge_sites<D>& move, Whole radius,
                       const Answer<D>& answer);

  /// A wall was exactly at the radius from what was looked at last.
  bool was_tied() const { return tied_; }

 private:
  static constexpr std::size_t wall_corners = D == 2 ? 2 : 4;
  struct Wall {
    std::uint32_t side = 0;
    std::size_t size = 0;
    std::array<Site<D>, wall_corners> corners{};
    Site<D> low{}, high{};
  };
  /// The triangle that is swept until a time that is a double.
  struct Swept {
    Edge_sites<D> move;
    double time = 1;
  };

  void find_near(const Edge_sites<D>& move, Whole radius);
  bool is_apart(const Swept& swept, const Wall& wall, Whole radius);

  const Lattice<D>& lattice_;
  const int bits_;
  std::vector<Wall> walls_;
  std::vector<const Wall*> near_;
  bool tied_ = false;
};

extern template class Thick_judge<2>;
extern template class Thick_judge<3>;

}  // namespace cellwalk::endurance

#endif  // CELLWALK_EXPERIMENTS_ENDURANCE_THICK_JUDGE_H
