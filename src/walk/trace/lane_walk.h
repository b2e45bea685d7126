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

/// The half-facets that a row met, the wall included, are [begin, end) of those of its slot.
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

/// The half-facets met by the rows of a slot, with room for more.
struct Lane_met {
  unsigned* half_facet;
  unsigned long count, room;
};

struct Lane_walks {
  const float* blocks;    ///< of four planes each, by cell: components of their normals, then offsets
  const unsigned* links;  ///< of half-facets: the neighbour, with the highest bit where there is a wall
  float error, slack;     ///< of planes, and of times beside that
  const Lane_motion* motions;
  unsigned long count;
  unsigned long most_facets;                 ///< a motion that meets more of them is undecided
  Lane_met* met;                             ///< of each slot
  void (*grow)(void* owner, unsigned slot);  ///< makes room in a slot
  void* owner;
};

using Lane_walk = void (*)(const Lane_walks& walks);

namespace {

/// Lanes by their masks: the exit of a cell is the only one of `exits`, and all four planes must be decided.
struct Exit_lanes {
  static constexpr unsigned char none = 4;
  unsigned char lane[256];  ///< at index exits + 16 decided
  constexpr Exit_lanes() : lane() {
    for (unsigned i = 0; i < 256; ++i) {
      const unsigned exits = i & 0xf, decided = i >> 4;
      lane[i] = decided != 0xf ? none
                : exits == 1   ? 0
                : exits == 2   ? 1
                : exits == 4   ? 2
                : exits == 8   ? 3
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
  explicit Walks_in_lanes(const Lane_walks& walks) : walks_(walks) {
    for (unsigned slot = 0; slot < lane_slots; ++slot) {
      const Lane_met& met = walks.met[slot];
      next_[slot] = met.half_facet + met.count;
      cell_[slot] = walks.motions[0].cell;  // any, where there are fewer motions than slots
      start(slot);
    }
  }

  void run() {
    using V = typename Lanes::Floats;
    const V error = Lanes::all_floats(walks_.error), slack = Lanes::all_floats(walks_.slack);
    const V never = Lanes::all_floats(4), one = Lanes::all_floats(1);
    const float* const blocks = walks_.blocks;
    const unsigned* const links = walks_.links;
    while (active_ != 0)
      for (unsigned slot = 0; slot < lane_slots; slot += Lanes::cells) {
        const float* block[Lanes::cells];
        for (unsigned i = 0; i < Lanes::cells; ++i)
          block[i] = blocks + 4 * (D + 1) * static_cast<unsigned long>(cell_[slot + i]);
        const Lines& lines = lines_[slot / Lanes::cells];
        V a = Lanes::row(block, 4 * D), b = a;
        for (unsigned k = 0; k < D; ++k) {
          const V normal = Lanes::row(block, 4 * k);
          a = Lanes::multiply_add(normal, Lanes::load_floats(lines.from[k]), a);
          b = Lanes::multiply_add(normal, Lanes::load_floats(lines.to[k]), b);
        }
        const auto outside = Lanes::is_above(b, error);
        const V inverse = one / (b - a);
        const V time = -a * inverse, width = Lanes::multiply_add(error, inverse, slack);
        const V upper = Lanes::choose(outside, time + width, never);
        const auto first = Lanes::is_at_most(time - width, Lanes::least_of_four(upper)) & outside;
        const unsigned exits = Lanes::mask(first), beyond = Lanes::mask(outside);
        const unsigned decided = beyond | Lanes::mask(Lanes::is_above(-error, b));
        for (unsigned i = 0; i < Lanes::cells; ++i) {
          const unsigned s = slot + i;
          const unsigned lane = exit_lanes.lane[(exits >> 4 * i & 0xf) | (decided >> 4 * i & 0xf) << 4];
          if (lane != Exit_lanes::none && is_certain_[s]) [[likely]] {
            const unsigned f = 4 * cell_[s] + lane, link = links[f];
            *next_[s]++ = f;
            if (static_cast<int>(link) >= 0 && next_[s] != limit_[s]) [[likely]] {
              cell_[s] = link;
              continue;
            }
            pass_or_end(s, link);
          } else {
            const unsigned inside = Lanes::mask(Lanes::is_above(-error, a)) >> 4 * i & 0xf;
            leave_or_end(s, lane, beyond >> 4 * i & 0xf, decided >> 4 * i & 0xf, inside);
          }
        }
      }
  }

 private:
  struct alignas(64) Lines {
    float from[D][4 * Lanes::cells], to[D][4 * Lanes::cells];
  };

  void start(unsigned slot) {
    Lines& lines = lines_[slot / Lanes::cells];
    const unsigned first = 4 * (slot % Lanes::cells);
    begin_[slot] = static_cast<unsigned>(next_[slot] - walks_.met[slot].half_facet);
    is_certain_[slot] = false;
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
    is_certain_[slot] = motion.starts_inside;
    set_limit(slot);
    ++active_;
  }

  /// Where to look whether there is room, or a walk that does not end.
  void set_limit(unsigned slot) {
    const Lane_met& met = walks_.met[slot];
    const unsigned long most = begin_[slot] + walks_.most_facets;
    limit_[slot] = met.half_facet + (most < met.room ? most : met.room);
  }

  [[gnu::noinline]] void end(unsigned slot, Lane_verdict verdict) {
    const auto met = static_cast<unsigned>(next_[slot] - walks_.met[slot].half_facet);
    *motion_[slot]->row = {verdict, static_cast<unsigned char>(slot), begin_[slot], met, cell_[slot]};
    --active_;
    start(slot);
  }

  /// After a facet that is a wall, or where the limit is reached.
  [[gnu::noinline]] void pass_or_end(unsigned slot, unsigned link) {
    Lane_met& met = walks_.met[slot];
    met.count = static_cast<unsigned long>(next_[slot] - met.half_facet);
    const bool is_endless = met.count - begin_[slot] >= walks_.most_facets;
    if (met.count == met.room) {
      walks_.grow(walks_.owner, slot);
      next_[slot] = met.half_facet + met.count;
    }
    if (static_cast<int>(link) < 0 || is_endless) {
      end(slot, static_cast<int>(link) < 0 ? Lane_verdict::blocked : Lane_verdict::undecided);
      return;
    }
    cell_[slot] = link;
    is_certain_[slot] = true;
    set_limit(slot);
  }

  /// Where the exit is not that of most steps: none, undecided, or from a start in the boundary.
  [[gnu::noinline]] void leave_or_end(unsigned slot, unsigned lane, unsigned beyond, unsigned decided,
                                      unsigned inside) {
    if (!motion_[slot]) return;
    if (lane != Exit_lanes::none && (inside >> lane & 1) != 0) {
      const unsigned f = 4 * cell_[slot] + lane;
      *next_[slot]++ = f;
      pass_or_end(slot, walks_.links[f]);
      return;
    }
    end(slot, decided == 0xf && beyond == 0 ? Lane_verdict::arrived : Lane_verdict::undecided);
  }

  const Lane_walks& walks_;
  Lines lines_[lane_slots / Lanes::cells];
  unsigned cell_[lane_slots];
  unsigned* next_[lane_slots];
  unsigned* limit_[lane_slots];
  bool is_certain_[lane_slots];  ///< the line passes the inside of the cell before any exit
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
