// SPDX-License-Identifier: LGPL-3.0-or-later
// Walks of several particles at a time through cells of at most four facets, by float planes with an error
// bound. It includes nothing, so that the instructions of one kind of processor stay in the file that is
// compiled for it.
//
// The rule and its proof are those of certified_exit.h: among the facets with the target certainly outside,
// the exit is the one whose interval of times ends first, if no other interval begins before that.
#ifndef CELLWALK_WALK_TRACE_LANE_WALK_H
#define CELLWALK_WALK_TRACE_LANE_WALK_H

namespace cellwalk::detail {

/// The particles that are walked at a time.
inline constexpr unsigned lane_slots = 16;

/// How a row ended: decided by planes, and if so in a cell or at a wall.
enum class Lane_verdict : unsigned char { undecided, arrived, blocked };

/// Steps of all walks are counted together. In step i the walk of a slot meets the half-facet lane_slots i +
/// slot of those of all; the row met those of the steps [begin, end), the wall included.
struct Lane_row {
  Lane_verdict verdict;
  unsigned char slot;
  unsigned begin, end;
  unsigned cell;  ///< the last one
};

/// A motion in the frame.
struct Lane_motion {
  float from[3], to[3];
  unsigned cell;
  bool starts_inside;  ///< the start is certainly in the interior of the cell
  Lane_row* row;       ///< where its end is written
};

/// The half-facets met, with room for those of some steps.
struct Lane_met {
  unsigned* half_facet;
  unsigned long steps;
};

struct Lane_walks {
  const float* blocks;    ///< of four planes each, by cell: components of their normals, then offsets
  const unsigned* links;  ///< of half-facets: the neighbour, with the highest bit where there is a wall
  float error, slack;     ///< of planes, and of times beside that
  const unsigned char (*ahead)[64];  ///< of half-facets: what is fetched of those met, to be read next
  const Lane_motion* motions;
  unsigned long count;
  unsigned long most_facets;  ///< about as many as a motion may meet; otherwise it is undecided
  Lane_met met;
  Lane_met (*grow)(void* owner);  ///< makes room for more steps
  void* owner;
};

using Lane_walk = void (*)(const Lane_walks& walks);

namespace {

/// The exit of a cell, by bits of its four facets: of those met first, and 16 times those that are decided.
/// There is one if it is the only one met first, and all are decided.
struct Exit_lanes {
  static constexpr unsigned char none = 4;
  unsigned char lane[256];
  constexpr Exit_lanes() : lane() {
    for (unsigned i = 0; i < 256; ++i) {
      const unsigned first = i & 0xf, decided = i >> 4;
      lane[i] = decided != 0xf ? none
                : first == 1   ? 0
                : first == 2   ? 1
                : first == 4   ? 2
                : first == 8   ? 3
                               : none;
    }
  }
};
inline constexpr Exit_lanes exit_lanes;

/// Walks under way.
/// \tparam Lanes vectors of floats, four for each of some cells
template <class Lanes, unsigned D>
class Walks_in_lanes {
 public:
  explicit Walks_in_lanes(const Lane_walks& walks) : walks_(walks), met_(walks.met) {
    for (unsigned slot = 0; slot < lane_slots; ++slot) {
      cell_[slot] = walks.motions[0].cell;  // any, where there are fewer motions than slots
      start(slot, 0);
    }
  }

  void run() {
    using V = typename Lanes::Floats;
    const V error = Lanes::all_floats(walks_.error), slack = Lanes::all_floats(walks_.slack);
    const V never = Lanes::all_floats(4), one = Lanes::all_floats(1);
    const float* const blocks = walks_.blocks;
    const unsigned* const links = walks_.links;
    const auto* const ahead = walks_.ahead;
    for (unsigned step = 0; active_ != 0; ++step) {
      if (step == met_.steps) make_room(step);
      unsigned* const met = met_.half_facet + lane_slots * static_cast<unsigned long>(step);
#pragma GCC unroll 4
      for (unsigned slot = 0; slot < lane_slots; slot += Lanes::cells) {
        const float* block[Lanes::cells];
        for (unsigned i = 0; i < Lanes::cells; ++i)
          block[i] = blocks + 4 * (D + 1) * static_cast<unsigned long>(cell_[slot + i]);
        const Lines& lines = lines_[slot / Lanes::cells];
        V plane[D + 1];
        Lanes::template load_planes<D>(block, plane);
        V a = plane[D], b = a;
        for (unsigned k = 0; k < D; ++k) {
          a = Lanes::multiply_add(plane[k], Lanes::load_floats(lines.from[k]), a);
          b = Lanes::multiply_add(plane[k], Lanes::load_floats(lines.to[k]), b);
        }
        const auto outside = Lanes::is_above(b, error);
        const V inverse = one / (b - a);
        const V time = -a * inverse, width = Lanes::multiply_add(error, inverse, slack);
        const V upper = Lanes::choose(outside, time + width, never);
        const auto first = Lanes::is_at_most(time - width, Lanes::least_of_four(upper)) & outside;
        const auto decided = Lanes::is_above(-error, b) | outside;
        const unsigned exits = Lanes::exits(first, decided & are_certain_[slot / Lanes::cells]);
        for (unsigned i = 0; i < Lanes::cells; ++i) {
          const unsigned s = slot + i;
          const unsigned lane = exit_lanes.lane[Lanes::exit(exits, i)];
          if (lane != Exit_lanes::none) [[likely]] {
            const unsigned f = 4 * cell_[s] + lane, link = links[f];
            met[s] = f;
            __builtin_prefetch(ahead[f], 0, 2);  // for later, so not into the nearest cache
            if (static_cast<int>(link) >= 0) [[likely]] {
              cell_[s] = link;
              __builtin_prefetch(blocks + 4 * (D + 1) * static_cast<unsigned long>(link));
              __builtin_prefetch(links + 4 * static_cast<unsigned long>(link));
              continue;
            }
            end(s, Lane_verdict::blocked, step + 1, step + 1);
          } else if (motion_[s]) {
            const unsigned exit = Lanes::exit(Lanes::exits(first, decided), i);
            const bool arrives = exit == 0xf0 && (Lanes::mask(outside) >> 4 * i & 0xf) == 0;
            const unsigned of_start = are_certain(s) ? 0xf : Lanes::mask(Lanes::is_above(-error, a)) >> 4 * i;
            leave_or_end(s, exit_lanes.lane[exit], of_start, arrives, step);
          }
        }
      }
    }
  }

 private:
  struct alignas(64) Lines {
    float from[D][4 * Lanes::cells], to[D][4 * Lanes::cells];
  };

  bool are_certain(unsigned slot) const {
    return (Lanes::mask(are_certain_[slot / Lanes::cells]) >> 4 * (slot % Lanes::cells) & 1) != 0;
  }

  /// \param step the first of the walk
  void start(unsigned slot, unsigned step) {
    Lines& lines = lines_[slot / Lanes::cells];
    const unsigned first = 4 * (slot % Lanes::cells);
    begin_[slot] = step;
    Lanes::set_cell(are_certain_[slot / Lanes::cells], slot % Lanes::cells, false);
    if (next_motion_ == walks_.count) {
      motion_[slot] = nullptr;
      for (unsigned lane = 0; lane < 4; ++lane)
        lines.to[0][first + lane] = __builtin_nanf("");  // decides nothing
      return;
    }
    const Lane_motion& motion = walks_.motions[next_motion_++];
    for (unsigned k = 0; k < D; ++k)
      for (unsigned lane = 0; lane < 4; ++lane) {
        lines.from[k][first + lane] = motion.from[k];
        lines.to[k][first + lane] = motion.to[k];
      }
    motion_[slot] = &motion;
    cell_[slot] = motion.cell;
    Lanes::set_cell(are_certain_[slot / Lanes::cells], slot % Lanes::cells, motion.starts_inside);
    ++active_;
  }

  /// \param end the step after its last one
  /// \param next the first of the next walk in the slot
  [[gnu::noinline]] void end(unsigned slot, Lane_verdict verdict, unsigned end, unsigned next) {
    *motion_[slot]->row = {verdict, static_cast<unsigned char>(slot), begin_[slot], end, cell_[slot]};
    --active_;
    start(slot, next);
  }

  /// Makes room for more steps, and ends walks that seem to have no end.
  [[gnu::noinline]] void make_room(unsigned step) {
    met_ = walks_.grow(walks_.owner);
    for (unsigned slot = 0; slot < lane_slots; ++slot)
      if (motion_[slot] && step - begin_[slot] > walks_.most_facets)
        end(slot, Lane_verdict::undecided, step, step);
  }

  /// Where the exit is not that of most steps: none, undecided, or from a start in the boundary.
  /// \param inner of which facets the start is on the inner side, as bits
  [[gnu::noinline]] void leave_or_end(unsigned slot, unsigned lane, unsigned inner, bool arrives,
                                      unsigned step) {
    if (lane == Exit_lanes::none || (inner >> lane & 1) == 0)
      return end(slot, arrives ? Lane_verdict::arrived : Lane_verdict::undecided, step, step + 1);
    const unsigned f = 4 * cell_[slot] + lane, link = walks_.links[f];
    met_.half_facet[lane_slots * static_cast<unsigned long>(step) + slot] = f;
    if (static_cast<int>(link) < 0) return end(slot, Lane_verdict::blocked, step + 1, step + 1);
    cell_[slot] = link;
    Lanes::set_cell(are_certain_[slot / Lanes::cells], slot % Lanes::cells, true);
  }

  const Lane_walks& walks_;
  Lines lines_[lane_slots / Lanes::cells];
  Lane_met met_;
  unsigned cell_[lane_slots];
  /// The line passes the inside of the cell before any exit.
  typename Lanes::Bits are_certain_[lane_slots / Lanes::cells] = {};
  unsigned begin_[lane_slots];
  const Lane_motion* motion_[lane_slots];
  unsigned long next_motion_ = 0;
  unsigned active_ = 0;
};

template <class Lanes, unsigned D>
void walk_in_lanes(const Lane_walks& walks) {
  Walks_in_lanes<Lanes, D>(walks).run();
}

}  // namespace

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_LANE_WALK_H
