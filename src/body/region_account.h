// SPDX-License-Identifier: LGPL-3.0-or-later
// Whether regions free of walls pay for a body. Theory: docs/bodies.md, certified moves.
#ifndef CELLWALK_BODY_REGION_ACCOUNT_H
#define CELLWALK_BODY_REGION_ACCOUNT_H

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "clear_region.h"

namespace cellwalk::detail {

/// Regions cost searches, and save tests of edges. Both are counted in units of about one operation, never by
/// clocks, so that a body does the same on each machine. A body that spends more than it saves rests: it goes
/// without regions for some steps, and for twice as many whenever the next attempt fails as well.
class Region_account {
 public:
  /// \param rests_first a body whose edges are few, so that their tests are cheap, tries regions later
  Region_account(std::size_t vertices, bool rests_first)
      : vertices_(static_cast<std::int64_t>(vertices)),
        balance_(first_credit * vertices_),
        rest_(rests_first ? first_rest : 0) {}

  /// True if regions are to be used in the step that begins.
  bool begin_step() {
    if (rest_ > 0) {
      if (--rest_ == 0) balance_ = first_credit * vertices_;
      return false;
    }
    if (balance_ < 0) {
      rest_ = next_rest_;
      next_rest_ = std::min(2 * next_rest_, most_rest);
      return false;
    }
    if (balance_ == most_credit * vertices_) next_rest_ = least_rest;
    return true;
  }
  /// A region spared a move the tests of its edges.
  void earn(std::size_t edges) {
    balance_ =
        std::min(balance_ + of_edge * static_cast<std::int64_t>(edges) - of_move, most_credit * vertices_);
  }
  /// No region was known to hold a move.
  void pay_move() { balance_ -= of_move; }
  void pay_search(const Region_effort& effort) {
    balance_ -= of_search + of_cell * static_cast<std::int64_t>(effort.cells) +
                of_wall * static_cast<std::int64_t>(effort.walls);
  }
  /// The chain of an edge that left its region was looked for.
  void pay_chain() { balance_ -= of_chain; }

  template <class Archive>
  void archive(Archive& a) {
    a(balance_, rest_, next_rest_);
  }

 private:
  /// Instructions, as counted in experiment 06.
  static constexpr std::int64_t of_edge = 250, of_move = 150, of_search = 1500, of_cell = 100, of_wall = 60,
                                of_chain = 900;
  /// For each vertex: the credit of an attempt, and the most that is saved for bad times.
  static constexpr std::int64_t first_credit = 2000, most_credit = 4000;
  /// Steps.
  static constexpr std::uint32_t first_rest = 8, least_rest = 64, most_rest = 1024;

  std::int64_t vertices_, balance_;
  std::uint32_t rest_, next_rest_ = least_rest;
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_BODY_REGION_ACCOUNT_H
