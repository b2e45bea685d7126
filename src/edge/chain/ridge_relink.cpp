// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cellwalk/internal/edge/ridge_relink.h>

#include <array>
#include <bit>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "ridge.h"

namespace cellwalk::detail {
namespace {

template <int D>
class Ridge_relink {
 public:
  Ridge_relink(const Snapshot<D>& snapshot, const Certain_line<D>& line,
               const std::array<Spread_point<D>, 2>& ends, Chain& chain,
               std::vector<Facet_corners<D>>& corners)
      : snapshot_(snapshot), line_(line), ends_(ends), chain_(chain), corners_(corners) {
    chain_.clear();
    corners_.clear();
  }

  bool passes(std::span<const Facet_corners<D>> corners) const {
    for (const Facet_corners<D>& some : corners)
      if (!line_.passes(some)) return false;
    return true;
  }
  void append(Half_facet facet, std::span<const Facet_corners<D>> corners) {
    chain_.push_back(facet);
    corners_.insert(corners_.end(), corners.begin(), corners.end());
  }
  /// True if the line certainly passes a facet on the inner sides of all ridges but one, which is set, and
  /// the ends of the edge certainly lie on both sides of its plane.
  bool is_passed_but_for_one(Half_facet facet, std::optional<Ridge>& beyond) {
    // Corners beside a chain may begin with another one.
    const std::size_t before = corners_.size();
    append_corners(snapshot_, facet, corners_);
    const bool is_one = find_ridge_beyond(facet, std::span(corners_).subspan(before), beyond);
    corners_.resize(before);
    return is_one && distance_from_plane(snapshot_, facet, ends_[0]) < -plane_error &&
           distance_from_plane(snapshot_, facet, ends_[1]) > plane_error;
  }
  /// Appends the facets on the other way round a ridge, from the cell before a run of facets to that after
  /// it. False if one is not certainly passed.
  bool go_round(Half_facet first, Half_facet last, const Ridge& ridge) {
    std::size_t facets = 0;
    return detail::go_round(snapshot_, first, ridge, snapshot_.neighbour(last), [&](Half_facet f) {
      if (snapshot_.is_impassable(f) || ++facets > most_facets_round) return false;
      const std::size_t before = corners_.size();
      append_corners(snapshot_, f, corners_);
      chain_.push_back(f);
      return passes(std::span(corners_).subspan(before));
    });
  }

 private:
  /// More are seldom, and walked round as fast.
  static constexpr std::size_t most_facets_round = 16;

  bool find_ridge_beyond(Half_facet facet, std::span<const Facet_corners<D>> corners,
                         std::optional<Ridge>& beyond) const {
    beyond.reset();
    constexpr std::size_t ridges_a_part = 3;
    const Cell_view<D> cell = snapshot_.view(snapshot_.cell_of(facet));
    for (std::size_t part = 0; part < corners.size(); ++part) {
      const unsigned not_passed = ~line_.ridges_passed(corners[part]) & Certain_line<D>::all_lanes;
      if (not_passed == 0) continue;
      if (beyond || !std::has_single_bit(not_passed)) return false;
      beyond = ridge_of(cell, snapshot_.facet_of(facet),
                        part * ridges_a_part + static_cast<std::size_t>(std::countr_zero(not_passed)));
    }
    return beyond.has_value();
  }

  const Snapshot<D>& snapshot_;
  const Certain_line<D>& line_;
  const std::array<Spread_point<D>, 2>& ends_;
  Chain& chain_;
  std::vector<Facet_corners<D>>& corners_;
};

}  // namespace

template <int D>
bool relink_at_ridges(const Snapshot<D>& snapshot, const Certain_line<D>& line,
                      const std::array<Spread_point<D>, 2>& ends, std::span<const Half_facet> word,
                      Word_corners<D> corners, Chain& chain, std::vector<Facet_corners<D>>& its_corners) {
  Ridge_relink<D> relink(snapshot, line, ends, chain, its_corners);
  std::optional<Ridge> beyond, next;
  for (std::size_t i = 0; i < word.size();) {
    if (relink.passes(corners.front())) {
      relink.append(word[i++], corners.front());
      corners.drop_front();
      continue;
    }
    const Half_facet first = word[i];
    if (!relink.is_passed_but_for_one(first, beyond)) return false;
    Half_facet last = first;
    corners.drop_front();
    while (++i < word.size() && relink.is_passed_but_for_one(word[i], next) && next == beyond) {
      last = word[i];
      corners.drop_front();
    }
    if (!relink.go_round(first, last, *beyond)) return false;
  }
  return true;
}

#define CELLWALK_INSTANTIATE(D)                                                                      \
  template bool relink_at_ridges(const Snapshot<D>&, const Certain_line<D>&,                         \
                                 const std::array<Spread_point<D>, 2>&, std::span<const Half_facet>, \
                                 Word_corners<D>, Chain&, std::vector<Facet_corners<D>>&);

CELLWALK_INSTANTIATE(2)
CELLWALK_INSTANTIATE(3)

#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk::detail
