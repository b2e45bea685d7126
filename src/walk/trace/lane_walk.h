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
inline constexpr unsigned lane_slots = 8;

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

void walk_in_fused_lanes_2(const Lane_walks& walks);
void walk_in_fused_lanes_3(const Lane_walks& walks);

namespace {

/// \tparam Lanes vectors of floats, four for each of `cells` cells
template <class Lanes, unsigned D>
void walk_in_lanes(const Lane_walks& walks) {
  using V = typename Lanes::Floats;
  constexpr unsigned cells = Lanes::cells, lanes = 4 * cells, groups = lane_slots / cells;
  constexpr unsigned never = 4;
  struct alignas(64) Group {
    float from[D][lanes], to[D][lanes];
    unsigned cell[cells];
    unsigned doubtful[cells];  ///< lanes at which the start need not be strictly inside
    const Lane_motion* motion[cells];
    unsigned begin[cells];
  } group[groups];
  unsigned long next = 0;
  unsigned active = 0;

  const auto start = [&](Group& g, unsigned i) {
    if (next == walks.count) {
      g.motion[i] = nullptr;
      return;
    }
    const Lane_motion& motion = walks.motions[next++];
    for (unsigned k = 0; k < D; ++k)
      for (unsigned lane = 0; lane < 4; ++lane) {
        g.from[k][4 * i + lane] = motion.from[k];
        g.to[k][4 * i + lane] = motion.to[k];
      }
    g.cell[i] = motion.cell;
    g.doubtful[i] = motion.starts_inside ? 0 : 0xf;
    g.motion[i] = &motion;
    ++active;
  };
  const auto end = [&](Group& g, unsigned i, unsigned slot, Lane_verdict verdict) {
    const auto met = static_cast<unsigned>(walks.met[slot].count);
    *g.motion[i]->row = {verdict, static_cast<unsigned char>(slot), g.begin[i], met, g.cell[i]};
    g.begin[i] = met;
    --active;
    start(g, i);
  };

  for (unsigned j = 0; j < groups; ++j)
    for (unsigned i = 0; i < cells; ++i) {
      group[j].cell[i] = walks.motions[0].cell;  // any, where there are fewer motions than slots
      for (unsigned k = 0; k < D; ++k)
        for (unsigned lane = 0; lane < 4; ++lane)
          group[j].from[k][4 * i + lane] = group[j].to[k][4 * i + lane] = 0;
      group[j].begin[i] = static_cast<unsigned>(walks.met[j * cells + i].count);
      start(group[j], i);
    }
  const V error = Lanes::all_floats(walks.error), slack = Lanes::all_floats(walks.slack);
  while (active != 0)
    for (unsigned j = 0; j < groups; ++j) {
      Group& g = group[j];
      const float* block[cells];
      for (unsigned i = 0; i < cells; ++i)
        block[i] = walks.blocks + 4 * (D + 1) * static_cast<unsigned long>(g.cell[i]);
      V a = Lanes::row(block, 4 * D), b = a;
      for (unsigned k = 0; k < D; ++k) {
        const V normal = Lanes::row(block, 4 * k);
        a = Lanes::multiply_add(normal, Lanes::load_floats(g.from[k]), a);
        b = Lanes::multiply_add(normal, Lanes::load_floats(g.to[k]), b);
      }
      const auto outside = b > error;
      const V inverse = Lanes::all_floats(1) / (b - a);
      const V time = -a * inverse, width = Lanes::multiply_add(error, inverse, slack);
      const V upper = Lanes::choose(outside, time + width, Lanes::all_floats(never));
      const auto first = (time - width <= Lanes::least_of_four(upper)) & outside;
      const unsigned exits = Lanes::mask(first), beyond = Lanes::mask(outside);
      const unsigned decided = beyond | Lanes::mask(b < -error), inside = Lanes::mask(a < -error);
      for (unsigned i = 0; i < cells; ++i) {
        if (!g.motion[i]) continue;
        const unsigned slot = j * cells + i, exit = exits >> 4 * i & 0xf;
        const bool is_decided = (decided >> 4 * i & 0xf) == 0xf;
        const bool leaves = is_decided && exit != 0 && (exit & (exit - 1)) == 0 &&
                            (exit & g.doubtful[i] & ~(inside >> 4 * i)) == 0;
        if (leaves) [[likely]] {
          const unsigned f = 4 * g.cell[i] + static_cast<unsigned>(__builtin_ctz(exit));
          Lane_met& met = walks.met[slot];
          met.half_facet[met.count++] = f;
          if (met.count == met.room) [[unlikely]]
            walks.grow(walks.owner, slot);
          const unsigned link = walks.links[f];
          g.doubtful[i] = 0;
          if (static_cast<int>(link) >= 0 && met.count - g.begin[i] <= walks.most_facets) [[likely]]
            g.cell[i] = link;
          else
            end(g, i, slot, static_cast<int>(link) < 0 ? Lane_verdict::blocked : Lane_verdict::undecided);
        } else {
          const bool is_in_cell = is_decided && (beyond >> 4 * i & 0xf) == 0;
          end(g, i, slot, is_in_cell ? Lane_verdict::arrived : Lane_verdict::undecided);
        }
      }
    }
}

}  // namespace

}  // namespace cellwalk::detail

#endif  // CELLWALK_WALK_TRACE_LANE_WALK_H
