// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge of walks: follows the definition of a correct answer (docs/walk.md) in a lattice, in integers.
#ifndef CELLWALK_EXPERIMENTS_ENDURANCE_WALK_JUDGE_H
#define CELLWALK_EXPERIMENTS_ENDURANCE_WALK_JUDGE_H

#include <cellwalk/walk/walk.h>

#include <span>
#include <vector>

#include "world.h"

namespace cellwalk::endurance {

/// A time in [0,1].
struct Time {
  Whole numerator = 0, denominator = 1;
};
inline bool operator<(const Time& a, const Time& b) {
  return Wide(a.numerator) * b.denominator < Wide(b.numerator) * a.denominator;
}
inline bool operator==(const Time& a, const Time& b) {
  return Wide(a.numerator) * b.denominator == Wide(b.numerator) * a.denominator;
}

/// True if t is the greatest double that is not greater than the time.
bool is_rounded(double t, const Time& time);

/// All that a walk may answer.
struct Walk_truth {
  bool arrives = false;
  Time end{1, 1};           ///< where it is blocked
  bool has_choice = false;  ///< somewhere it may go on on several sides of walls
  int dimension = 0;        ///< of the lowest cell of the lattice that holds the end of the way
  bool degenerate =
      false;  ///< the way starts, passes or ends on an edge or vertex, ends on a facet, or runs in one
};

enum class Walk_fault {
  none,
  missed_wall,    ///< arrives, though every legal way is blocked
  false_contact,  ///< blocked, though a legal way arrives
  wrong_time,     ///< not the latest time that a legal way reaches, rounded down, or the point is not there
  wrong_cell,     ///< ends in a cell in which no legal way ends
  wrong_kind,     ///< the dimension of the target, or the kind of the contact
  wrong_wall,     ///< names a facet that is no wall, is not met there, or not from the cells of the walk
  wrong_normal,
  count
};
inline constexpr std::array<const char*, 8> walk_fault_names{"none",       "missed_wall", "false_contact",
                                                             "wrong_time", "wrong_cell",  "wrong_kind",
                                                             "wrong_wall", "wrong_normal"};

template <int D>
class Walk_judge {
 public:
  explicit Walk_judge(const Lattice<D>& lattice, int bits);

  /// Follows all legal ways from a to b together.
  /// \pre the closure of the cell holds a
  const Walk_truth& follow(std::uint32_t cell, const Site<D>& a, const Site<D>& b);

  /// True if a motion in a cell leads on from a point, in the direction in which the families change so.
  /// \param on the families that are whole at the point, a bit each, with their values
  bool leads_on(std::uint32_t cell, unsigned on, const std::array<std::int16_t, most_families>& planes,
                const std::array<Whole, most_families>& ways);

  /// The cells in which a legal way may end, of the motion followed last.
  std::span<const std::uint32_t> ends() const { return cells_; }
  bool may_end_in(std::uint32_t cell) const;

  /// The cells linked with one of the ends at the end of the way.
  std::span<const std::uint32_t> linked_with(std::uint32_t cell);
  /// True if the motion followed last ends on a side, and leads out of its cell there.
  bool leads_out_at_end(const Side& side) const;

 private:
  struct Crossing {
    Whole value, way;    ///< of the family at the start, and its change
    Whole next, speed;   ///< its change up to the next plane, and in all: both positive
    std::int16_t plane;  ///< the one on which it is, or which is next
  };

  void begin(const Site<D>& a, const Site<D>& b);
  void link(unsigned on);
  bool enter(unsigned on);
  bool is_divided(unsigned within);
  bool is_at(const Side& side, unsigned on) const {
    return (on >> side.family & 1u) && side.plane == crossings_[side.family].plane;
  }

  const Lattice<D>& lattice_;
  const int bits_;
  std::array<Crossing, most_families> crossings_{};
  std::vector<std::uint32_t> cells_, linked_;
  std::vector<std::uint32_t> seen_;  ///< per cell: the link() in which it was found last
  std::uint32_t links_ = 0;
  unsigned at_end_ = 0;  ///< the families that are whole at the end of the way
  Walk_truth truth_;
};

/// A motion of a particle, in the lattice and in space.
template <int D>
struct Walk_motion {
  Site<D> a, b;
  Point<D> from, to;
  std::uint32_t cell = 0;
};

/// What is wrong with the answer to a motion that the judge has just followed.
template <int D>
Walk_fault fault_of(const World<D>& world, Walk_judge<D>& judge, const Walk_truth& truth,
                    const Walk_motion<D>& motion, const Walk_result<D>& result);

extern template class Walk_judge<2>;
extern template class Walk_judge<3>;

}  // namespace cellwalk::endurance

#endif  // CELLWALK_EXPERIMENTS_ENDURANCE_WALK_JUDGE_H
