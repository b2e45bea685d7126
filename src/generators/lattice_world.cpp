// SPDX-License-Identifier: LGPL-3.0-or-later
// The facets of boxes of cubes, and their cells: whole, cut into prisms, simplices or pyramids.
#include <cellwalk/internal/generators/lattice_world.h>
#include <cellwalk/internal/generators/placement.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <array>

#include "lattice_partition.h"

namespace cellwalk {
namespace detail {
namespace {

using Cube = std::array<std::uint32_t, 3>;
using Loop2 = std::vector<std::array<std::uint32_t, 2>>;
using Loop3 = std::vector<Cube>;

/// The name of a lattice point: twice its coordinates.
Cube name(const Cube& k) { return {2 * k[0], 2 * k[1], 2 * k[2]}; }

/// Determines the facets of a 3D world. A side of a box consists of lattice squares; the cut or the merging
/// of a square depends only on the square and the two boxes next to it, so that both have the same facets.
class Facets {
 public:
  Facets(const Lattice_partition<3>& partition, const Lattice_world_options<3>& options)
      : partition_(partition), options_(options) {}

  /// The facets of the side of a box across `axis`, at its high or low end, as loops seen from outside the
  /// box.
  std::vector<Loop3> side(const Lattice_box<3>& box, int axis, bool high) const {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    std::vector<Loop3> loops;
    for (std::uint32_t j = 0; j < box.size[c]; ++j)
      for (std::uint32_t i = 0; i < box.size[b]; ++i) {
        Cube inside = box.low;  // the cube of the box behind the square
        inside[b] += i;
        inside[c] += j;
        if (high) inside[axis] += box.size[axis] - 1;
        add_square(inside, axis, high, loops);
      }
    return loops;
  }

 private:
  /// The index of the box across the square, or an index of no box if there is none. Low and high ends of the
  /// world differ, so that every side of the world is a contact of its own.
  std::uint32_t across(const Cube& inside, int axis, bool high) const {
    const auto outside = static_cast<std::uint32_t>(partition_.boxes.size()) + 2 * axis + high;
    Cube next = inside;
    if (high ? next[axis] + 1 == partition_.cells[axis] : next[axis] == 0) return outside;
    high ? ++next[axis] : --next[axis];
    return partition_.box_of[partition_.cube(next)];
  }

  /// True if the box needs its squares across `axis` to be cut along their diagonals.
  bool wants_cut(std::uint32_t box, int axis) const {
    if (box >= partition_.boxes.size()) return false;
    const auto& b = partition_.boxes[box];
    return b.shape == Lattice_shape::simplices || (b.shape == Lattice_shape::prisms && b.axis == axis);
  }

  /// A random number of the contact of two boxes.
  std::uint64_t contact_hash(std::uint32_t box, std::uint32_t other) const {
    return scramble(scramble(options_.seed) + scramble(std::min(box, other)) +
                    3 * scramble(std::max(box, other)));
  }

  void add_square(const Cube& inside, int axis, bool high, std::vector<Loop3>& loops) const {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    const std::uint32_t box = partition_.box_of[partition_.cube(inside)], other = across(inside, axis, high);
    std::array<std::uint32_t, 3> size{1, 1, 1};
    if (wants_cut(box, axis) || wants_cut(other, axis)) {
      add_rectangle(inside, size, axis, high, loops, true);
      return;
    }
    const std::uint64_t hash = contact_hash(box, other);
    if (static_cast<double>(hash >> 11) * 0x1p-53 < options_.merge_share) {
      // One facet for the whole contact, or (one time in four) one for each of its rows along b.
      const bool rows = hash % 4 == 0;
      for (int a : {b, c}) {
        if (rows && a == c) continue;
        if (!grow_contact(inside, box, other, axis, high, a, size[a]))
          return;  // it belongs to the facet of its lowest square
      }
    }
    add_rectangle(inside, size, axis, high, loops, false);
  }

  /// Extends a facet along axis `a` as far as the same boxes touch; false if it does not start at this
  /// square.
  bool grow_contact(Cube inside, std::uint32_t box, std::uint32_t other, int axis, bool high, int a,
                    std::uint32_t& size) const {
    const auto same = [&](const Cube& cube) {
      return partition_.box_of[partition_.cube(cube)] == box && across(cube, axis, high) == other;
    };
    Cube next = inside;
    if (next[a] > 0) {
      --next[a];
      if (same(next)) return false;
    }
    for (next = inside; ++next[a] < partition_.cells[a] && same(next);) ++size;
    return true;
  }

  /// A rectangle with all lattice points on its rim, or a square cut from its lowest to its highest corner.
  void add_rectangle(const Cube& inside, const Cube& size, int axis, bool high, std::vector<Loop3>& loops,
                     bool cut) const {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    Cube at = inside;
    if (high) ++at[axis];
    Loop3 rim;  // counterclockwise seen from the high side
    const auto go = [&](int a, std::uint32_t steps, bool up) {
      for (std::uint32_t i = 0; i < steps; ++i) {
        rim.push_back(name(at));
        up ? ++at[a] : --at[a];
      }
    };
    go(b, size[b], true);
    go(c, size[c], true);
    go(b, size[b], false);
    go(c, size[c], false);
    std::vector<Loop3> pieces;
    if (cut)
      pieces = {{rim[0], rim[1], rim[2]}, {rim[0], rim[2], rim[3]}};
    else
      pieces = {rim};
    for (Loop3& piece : pieces) {
      if (!high) std::reverse(piece.begin(), piece.end());
      loops.push_back(std::move(piece));
    }
  }

  const Lattice_partition<3>& partition_;
  const Lattice_world_options<3>& options_;
};

/// All facets of a box.
std::vector<Loop3> all_sides(const Facets& facets, const Lattice_box<3>& box) {
  std::vector<Loop3> loops;
  for (int axis = 0; axis < 3; ++axis)
    for (bool high : {false, true})
      for (Loop3& loop : facets.side(box, axis, high)) loops.push_back(std::move(loop));
  return loops;
}

void add_cell(Lattice_builder<3>& builder, const std::vector<Loop3>& loops) {
  if (!builder.begin_cell()) return;
  for (const Loop3& loop : loops) builder.add_facet(loop);
  builder.end_cell();
}

/// The six tetrahedra of a cube along its diagonal, one for each order of the axes.
void add_simplices(Lattice_builder<3>& builder, const Lattice_box<3>& box) {
  for (int first = 0; first < 3; ++first)
    for (int turn : {1, 2}) {
      Cube k = box.low;
      std::array<Cube, 4> v;
      v[0] = name(k);
      ++k[first], v[1] = name(k);
      ++k[(first + turn) % 3], v[2] = name(k);
      ++k[(first + 2 * turn) % 3], v[3] = name(k);
      if (turn == 2) std::swap(v[1], v[2]);  // an odd order of the axes is left-handed
      add_cell(builder, {{v[0], v[2], v[1]}, {v[0], v[1], v[3]}, {v[1], v[2], v[3]}, {v[2], v[0], v[3]}});
    }
}

/// Adds two prisms along an axis, separated along the diagonals of their ends.
void add_prisms(Lattice_builder<3>& builder, const Facets& facets, const Lattice_box<3>& box) {
  const int a = box.axis, b = (a + 1) % 3, c = (a + 2) % 3;
  const auto low = facets.side(box, a, false), high = facets.side(box, a, true);
  Cube k = box.low;
  std::array<Cube, 4> cut;  // counterclockwise seen from the side of high b
  cut[0] = name(k);
  ++k[b], ++k[c], cut[1] = name(k);
  ++k[a], cut[2] = name(k);
  --k[b], --k[c], cut[3] = name(k);
  for (int half : {0, 1}) {
    std::vector<Loop3> loops{low[half], high[half]};
    for (int axis : {b, c}) {
      const bool at_high = (axis == b) == (half == 0);  // the first half lies at high b and low c
      for (const Loop3& loop : facets.side(box, axis, at_high)) loops.push_back(loop);
    }
    loops.push_back(half == 0 ? Loop3{cut[1], cut[0], cut[3], cut[2]} : Loop3{cut.begin(), cut.end()});
    add_cell(builder, loops);
  }
}

/// Adds a pyramid over each facet, with its apex in the centre.
void add_star(Lattice_builder<3>& builder, const Facets& facets, const Lattice_box<3>& box) {
  Cube apex = name(box.low);
  for (auto& x : apex) ++x;
  for (const Loop3& base : all_sides(facets, box)) {
    std::vector<Loop3> loops{base};
    for (std::size_t i = 0; i < base.size(); ++i)
      loops.push_back({base[(i + 1) % base.size()], base[i], apex});
    add_cell(builder, loops);
  }
}

Cell_soup<3> build(const Lattice_world_options<3>& options) {
  const Lattice_partition<3> partition = make_lattice_partition(options);
  const Facets facets(partition, options);
  Lattice_builder<3> builder(options);
  for (const auto& box : partition.boxes) switch (box.shape) {
      case Lattice_shape::box:
        add_cell(builder, all_sides(facets, box));
        break;
      case Lattice_shape::simplices:
        add_simplices(builder, box);
        break;
      case Lattice_shape::prisms:
        add_prisms(builder, facets, box);
        break;
      case Lattice_shape::star:
        add_star(builder, facets, box);
        break;
    }
  return builder.take();
}

void add_cell(Lattice_builder<2>& builder, const Loop2& polygon) {
  if (!builder.begin_cell()) return;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    builder.add_facet({polygon[i], polygon[(i + 1) % polygon.size()]});
  builder.end_cell();
}

/// The rim of a box with all lattice points on it, counterclockwise.
Loop2 rim_of(const Lattice_box<2>& box) {
  Loop2 rim;
  std::array<std::uint32_t, 2> at{2 * box.low[0], 2 * box.low[1]};
  for (int side = 0; side < 4; ++side)
    for (std::uint32_t i = 0; i < box.size[side % 2]; ++i) {
      rim.push_back(at);
      side < 2 ? at[side % 2] += 2 : at[side % 2] -= 2;
    }
  return rim;
}

Cell_soup<2> build(const Lattice_world_options<2>& options) {
  Lattice_builder<2> builder(options);
  for (const auto& box : make_lattice_partition(options).boxes) {
    const Loop2 rim = rim_of(box);
    const std::array<std::uint32_t, 2> centre{rim[0][0] + 1, rim[0][1] + 1};
    if (box.shape == Lattice_shape::simplices) {
      add_cell(builder, {rim[0], rim[1], rim[2]});
      add_cell(builder, {rim[0], rim[2], rim[3]});
    } else if (box.shape == Lattice_shape::star) {
      for (int i = 0; i < 4; ++i) add_cell(builder, {rim[i], rim[(i + 1) % 4], centre});
    } else {
      add_cell(builder, rim);
    }
  }
  return builder.take();
}

template <int D>
void check(const Lattice_world_options<D>& options) {
  for (double share : {options.box_share, options.simplex_share, options.prism_share, options.star_share,
                       options.merge_share, options.membrane_share, options.solid_share,
                       options.removed_share, options.slit_share})
    if (!(share >= 0 && share <= 1))
      throw Error(Error_code::usage, "lattice world: every share must lie in [0,1]");
  // Shares written in decimal may sum up to a little more than 1.
  if (options.box_share + options.simplex_share + options.prism_share + options.star_share > 1 + 1e-9)
    throw Error(Error_code::usage,
                "lattice world: the shares of boxes, simplices, prisms and stars sum to more than 1");
  if (D == 2 && options.prism_share > 0)
    throw Error(Error_code::usage, "lattice world: there are no prisms in 2D");
  double names = 1;
  for (std::uint32_t n : options.cells) {
    if (n == 0)
      throw Error(Error_code::usage, "lattice world: a dimension is 0; give at least 1 cube along each axis");
    names *= 2.0 * n + 1;
  }
  if (names > 1e8)
    throw Error(Error_code::usage, "lattice world: too large; give fewer cells, or use a grid");
  check_placement<D>(options.map, options.cells, 1, Placement::planar);
}

}  // namespace
}  // namespace detail

template <int D>
Lattice_world_options<D> mixed_lattice_world(std::uint64_t seed) {
  Lattice_world_options<D> options;
  options.seed = seed;
  options.box_share = 0.3;
  options.simplex_share = 0.2;
  options.prism_share = D == 3 ? 0.15 : 0;
  options.star_share = 0.1;
  options.merge_share = D == 3 ? 0.4 : 0;
  options.membrane_share = 0.15;
  options.solid_share = 0.05;
  options.removed_share = 0.08;
  return options;
}

template <int D>
Cell_soup<D> lattice_world(const Lattice_world_options<D>& options) {
  detail::check(options);
  return detail::build(options);
}

template Lattice_world_options<2> mixed_lattice_world<2>(std::uint64_t);
template Lattice_world_options<3> mixed_lattice_world<3>(std::uint64_t);
template Cell_soup<2> lattice_world(const Lattice_world_options<2>&);
template Cell_soup<3> lattice_world(const Lattice_world_options<3>&);

}  // namespace cellwalk
