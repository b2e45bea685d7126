// SPDX-License-Identifier: LGPL-3.0-or-later
// The walks of a block of rows as far as planes decide them, several at a time, so that the processor finds
// the exits of several cells at once.
#ifndef CELLWALK_WALK_TRACE_BLOCK_WALK_H
#define CELLWALK_WALK_TRACE_BLOCK_WALK_H

#include <cellwalk/environment/snapshot.h>
#include <cellwalk/internal/walk/certified_exit.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lane_functions.h"
#include "lane_planes.h"

namespace cellwalk::detail {

/// The walks of at most this many rows.
inline constexpr std::size_t rows_of_block = 256;

template <int D>
class Block_walk {
 public:
  Block_walk(const Snapshot<D>& snapshot, const Lane_planes& planes, const Lane_functions& functions)
      : snapshot_(snapshot),
        planes_(planes),
        walk_in_lanes_(snapshot.uniform_blocks() != 1 ? nullptr
                       : D == 2                       ? functions.walk_2
                                                      : functions.walk_3) {
    grow();
  }
  Block_walk(const Block_walk&) = delete;
  Block_walk& operator=(const Block_walk&) = delete;

  /// \pre at most rows_of_block; cells exist
  void run(std::span<const Particle<D>> particles, std::span<const Point<D>> targets) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const Particle<D>& particle = particles[i];
      rows_[i] = {};
      Float_point<D> from, to;
      if (particle.cell == Cell::none || !snapshot_.frame().map(particle.position, from)) continue;
      is_cut_[i] = !snapshot_.frame().map(targets[i], to);
      if (is_cut_[i] && !map_exit(particle.position, targets[i], to)) continue;
      Lane_motion& motion = motions_[count++];
      std::copy(from.begin(), from.end(), motion.from);
      std::copy(to.begin(), to.end(), motion.to);
      motion.cell = to_index(particle.cell);
      motion.starts_inside = particle.dimension == D;
      motion.row = &rows_[i];
    }
    if (count == 0) return;
    if (walk_in_lanes_)
      in_lanes(count);
    else if (snapshot_.uniform_blocks() == 1)
      one_by_one(count, [&](const Slot& slot) {
        return certified_exit<D>(*snapshot_.blocks(slot.cell), slot.line, slot.starts_inside);
      });
    else
      one_by_one(count, [&](const Slot& slot) {
        return exit_of_blocks(snapshot_, slot.cell, slot.line, slot.starts_inside);
      });
    for (std::size_t i = 0; i < particles.size(); ++i)
      if (is_cut_[i] && rows_[i].verdict == Lane_verdict::arrived) rows_[i].verdict = Lane_verdict::undecided;
  }

  const Lane_row& row(std::size_t i) const { return rows_[i]; }
  /// The number of facets that a row met.
  static std::size_t count_of_met(const Lane_row& row) { return row.end - row.begin; }
  /// The half-facets that a row met: the first, and every lane_slots-th from there on. lane_room more may be
  /// read.
  const unsigned* met(const Lane_row& row) const {
    return kept_.data() + lane_slots * std::size_t{row.begin} + row.slot;
  }

 private:
  struct Slot {
    Frame_line<D> line{Float_point<D>{}, Float_point<D>{}};
    const Lane_motion* motion = nullptr;
    Cell cell = Cell::none;
    unsigned begin = 0, step = 0;
    bool starts_inside = false;
    unsigned char number = 0;
  };

  /// Maps a point at which the way from a point of the frame to one outside is about to leave it; false if
  /// there is none. It is computed in the frame, where it is off the way by some 2^-53, which the error of
  /// the planes covers. (The point itself, rounded, could be off by more, far from the origin.)
  bool map_exit(const Point<D>& from, const Point<D>& to, Float_point<D>& y) const {
    const Plane_frame<D>& frame = snapshot_.frame();
    Point<D> at;
    double share = 1;
    for (std::size_t k = 0; k < D; ++k) {
      at[k] = (from[k] - frame.centre[k]) * frame.scale;
      const double step = to[k] - from[k];
      if (step != 0) share = std::min(share, ((step < 0 ? -1 : 1) - at[k]) / frame.scale / step);
    }
    share *= 1 - 0x1p-30;
    bool inside = true;
    for (std::size_t k = 0; k < D; ++k) {
      const double t = at[k] + share * (to[k] - from[k]) * frame.scale;
      inside &= std::abs(t) <= 1;
      y[k] = static_cast<float>(t);
    }
    return inside;
  }

  Lane_met grow() {
    kept_.resize(std::max<std::size_t>(lane_slots * (rows_of_block + lane_room), 2 * kept_.size()));
    return room();
  }
  Lane_met room() { return {kept_.data(), kept_.size() / lane_slots - lane_room}; }

  void in_lanes(std::size_t count) {
    static_assert(sizeof(Plane_block<D>) == 4 * (D + 1) * sizeof(float));
    walk_in_lanes_({reinterpret_cast<const float*>(snapshot_.blocks(Cell{0})), snapshot_.links(Cell{0}),
                    plane_error, time_slack,
                    reinterpret_cast<const unsigned char(*)[sizeof(Lane_plane)]>(planes_.planes.data()),
                    motions_.data(), count, snapshot_.half_facet_slots(), room(),
                    [](void* owner) { return static_cast<Block_walk*>(owner)->grow(); }, this});
  }

  template <class Find_exit>
  void one_by_one(std::size_t count, Find_exit find_exit) {
    std::array<Slot, 4> slots;
    std::size_t next = 0, active = 0;
    const auto start = [&](Slot& slot) {
      if (next == count) return false;
      const Lane_motion& motion = motions_[next++];
      Float_point<D> from, to;
      std::copy_n(motion.from, D, from.begin());
      std::copy_n(motion.to, D, to.begin());
      slot.line = Frame_line<D>(from, to);
      slot.motion = &motion;
      slot.cell = Cell{motion.cell};
      slot.starts_inside = motion.starts_inside;
      slot.begin = slot.step;
      return true;
    };
    for (std::size_t i = 0; i < slots.size(); ++i) {
      slots[active].number = static_cast<unsigned char>(i);
      if (start(slots[active])) ++active;
    }
    while (active != 0)
      for (std::size_t i = 0; i < active;) {
        Slot& slot = slots[i];
        const Certified_exit exit = find_exit(slot);
        Lane_verdict verdict =
            exit.verdict == Certified_exit::inside ? Lane_verdict::arrived : Lane_verdict::undecided;
        if (exit.verdict == Certified_exit::leaves) {
          const Half_facet f = Snapshot<D>::half_facet(slot.cell, exit.facet);
          if (slot.step == room().steps) grow();
          kept_[lane_slots * std::size_t{slot.step++} + slot.number] = to_index(f);
          const bool is_blocked = snapshot_.is_impassable(f);
          if (!is_blocked && slot.step - slot.begin <= snapshot_.half_facet_slots()) {
            slot.cell = snapshot_.neighbour(f);
            slot.starts_inside = true;
            ++i;
            continue;
          }
          if (is_blocked) verdict = Lane_verdict::blocked;
        }
        *slot.motion->row = {verdict, slot.number, slot.begin, slot.step, to_index(slot.cell)};
        if (!start(slot)) std::swap(slot, slots[--active]);
      }
  }

  const Snapshot<D>& snapshot_;
  const Lane_planes& planes_;
  const Lane_walk walk_in_lanes_;  ///< if any
  std::array<Lane_row, rows_of_block> rows_;
  std::array<bool, rows_of_block> is_cut_{};  ///< the motion is walked to the border of the frame only
  std::array<Lane_motion, rows_of_block> motions_;
  std::vector<unsigned> kept_;  ///< the half-facets met, as Lane_row has them
};

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_BLOCK_WALK_H
