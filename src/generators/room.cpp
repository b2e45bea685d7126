// SPDX-License-Identifier: LGPL-3.0-or-later
// Walls with doors on a grid of squares, and random star-shaped obstacles.
#include <cellwalk/generators/room.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "check_option.h"
#include "ear_clipping.h"

namespace cellwalk {
namespace {

using detail::check_option;

/// The size of the block of an obstacle along each axis, in squares.
constexpr std::uint32_t block_size = 3;

/// Directions in order of their angle, each about 64 long: integers, so that every machine has the same.
constexpr std::array<std::array<int, 2>, 24> directions{
    {{64, 0},    {62, 17},   {55, 32},  {45, 45},  {32, 55},  {17, 62},   {0, 64},    {-17, 62},
     {-32, 55},  {-45, 45},  {-55, 32}, {-62, 17}, {-64, 0},  {-62, -17}, {-55, -32}, {-45, -45},
     {-32, -55}, {-17, -62}, {0, -64},  {17, -62}, {32, -55}, {45, -45},  {55, -32},  {62, -17}}};

class Rooms {
 public:
  explicit Rooms(const Room_options& options)
      : options_(options),
        size_{options.rooms[0] * options.room_size[0], options.rooms[1] * options.room_size[1]},
        random_(options.seed),
        block_(std::size_t{size_[0]} * size_[1], false) {
    for (std::uint32_t y = 0; y <= size_[1]; ++y)
      for (std::uint32_t x = 0; x <= size_[0]; ++x) points_.push_back({double(x), double(y)});
  }

  Cell_soup<2> build() {
    for (int axis : {0, 1}) add_walls(axis);
    for (std::uint32_t j = 0; j < options_.rooms[1]; ++j)
      for (std::uint32_t i = 0; i < options_.rooms[0]; ++i) add_obstacles(i, j);
    for (std::uint32_t y = 0; y < size_[1]; ++y)
      for (std::uint32_t x = 0; x < size_[0]; ++x)
        if (!block_[square(x, y)])
          add_cell(std::array{corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1)}, false);
    place_points();
    return std::move(soup_);
  }

 private:
  std::uint32_t corner(std::uint32_t x, std::uint32_t y) const { return x + (size_[0] + 1) * y; }
  std::size_t square(std::uint32_t x, std::uint32_t y) const { return x + std::size_t{size_[0]} * y; }

  /// Adds walls across an axis, each with a door at a random place.
  void add_walls(int axis) {
    const int along = 1 - axis;
    const std::uint32_t length = options_.room_size[along];
    for (std::uint32_t wall = 1; wall < options_.rooms[axis]; ++wall)
      for (std::uint32_t room = 0; room < options_.rooms[along]; ++room) {
        const auto door = static_cast<std::uint32_t>(random_.below(length - options_.door + 1));
        for (std::uint32_t i = 0; i < length; ++i) {
          if (i >= door && i < door + options_.door) continue;
          std::array<std::uint32_t, 2> from, to;
          from[axis] = to[axis] = wall * options_.room_size[axis];
          from[along] = room * length + i, to[along] = from[along] + 1;
          walls_.insert({corner(from[0], from[1]), corner(to[0], to[1])});
        }
      }
  }

  void add_obstacles(std::uint32_t i, std::uint32_t j) {
    const std::uint32_t x0 = i * options_.room_size[0], y0 = j * options_.room_size[1];
    std::vector<std::array<std::uint32_t, 2>> places;
    for (std::uint32_t y = 0; y + block_size <= options_.room_size[1]; ++y)
      for (std::uint32_t x = 0; x + block_size <= options_.room_size[0]; ++x)
        places.push_back({x0 + x, y0 + y});
    random_.shuffle(places);
    std::uint32_t placed = 0;
    for (std::size_t k = 0; k < places.size() && placed < options_.obstacles; ++k) {
      const auto [x, y] = places[k];
      if (!claim_block(x, y)) continue;
      add_obstacle(x, y);
      ++placed;
    }
    if (placed < options_.obstacles)
      throw Error(Error_code::usage, "rooms: only " + std::to_string(placed) + " of " +
                                         std::to_string(options_.obstacles) +
                                         " obstacles fit into a room; give fewer, or larger rooms");
  }

  bool claim_block(std::uint32_t x, std::uint32_t y) {
    for (std::uint32_t j = 0; j < block_size; ++j)
      for (std::uint32_t i = 0; i < block_size; ++i)
        if (block_[square(x + i, y + j)]) return false;
    for (std::uint32_t j = 0; j < block_size; ++j)
      for (std::uint32_t i = 0; i < block_size; ++i) block_[square(x + i, y + j)] = true;
    return true;
  }

  /// Adds a polygon that is star-shaped about the middle of the block, and the triangles between it and the
  /// boundary of the block.
  void add_obstacle(std::uint32_t x, std::uint32_t y) {
    const Point<2> middle{x + block_size / 2.0, y + block_size / 2.0};
    detail::Polygon_indices inner;
    for (int d : choose_directions()) {
      const auto reach = static_cast<double>(30 + random_.below(41)) / 64;  // 0.47 to 1.09 squares
      inner.push_back(static_cast<std::uint32_t>(points_.size()));
      points_.push_back(
          {middle[0] + reach * directions[d][0] / 64, middle[1] + reach * directions[d][1] / 64});
    }
    detail::Polygon_indices outer;
    for (std::uint32_t i = 0; i < block_size; ++i) outer.push_back(corner(x + i, y));
    for (std::uint32_t i = 0; i < block_size; ++i) outer.push_back(corner(x + block_size, y + i));
    for (std::uint32_t i = block_size; i > 0; --i) outer.push_back(corner(x + i, y + block_size));
    for (std::uint32_t i = block_size; i > 0; --i) outer.push_back(corner(x, y + i));
    for (const auto& t : detail::clip_ears(points_, detail::bridge(points_, outer, inner)))
      add_cell(t, false);
    if (options_.keep_obstacles)
      for (const auto& t : detail::clip_ears(points_, inner)) add_cell(t, true);
  }

  /// 3 to 9 directions, ascending, no two neighbours half a turn or more apart, so that the middle lies
  /// inside.
  std::vector<int> choose_directions() {
    const int turn = static_cast<int>(directions.size());
    for (;;) {
      std::vector<int> all(turn);
      for (int d = 0; d < turn; ++d) all[d] = d;
      random_.shuffle(all);
      all.resize(3 + random_.below(7));
      std::sort(all.begin(), all.end());
      bool wide = false;
      for (std::size_t i = 0; i < all.size(); ++i)
        wide = wide || (all[(i + 1) % all.size()] - all[i] + turn) % turn >= turn / 2;
      if (!wide) return all;
    }
  }

  void add_cell(std::span<const std::uint32_t> polygon, bool solid) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const std::uint32_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
      soup_.add_facet({a, b}, solid || walls_.contains(std::minmax(a, b)));
    }
    soup_.end_cell(solid);
  }

  /// Numbers the points in use and computes their positions.
  void place_points() {
    std::vector<std::uint32_t> number(points_.size(), 0);
    for (std::uint32_t v : soup_.vertices) number[v] = 1;
    for (std::size_t v = 0; v < points_.size(); ++v) {
      if (number[v] == 0) continue;
      number[v] = static_cast<std::uint32_t>(soup_.points.size());
      soup_.points.push_back(options_.square * points_[v]);
    }
    for (std::uint32_t& v : soup_.vertices) v = number[v];
  }

  const Room_options& options_;
  std::array<std::uint32_t, 2> size_;  // of everything, in squares
  Random random_;
  std::vector<bool> block_;       // per square: part of an obstacle's block
  std::vector<Point<2>> points_;  // in squares; the lattice, then corners of obstacles
  std::set<std::pair<std::uint32_t, std::uint32_t>> walls_;
  Cell_soup<2> soup_;
};

}  // namespace

Cell_soup<2> room_2d(const Room_options& options) {
  double squares = 1;
  for (int axis : {0, 1}) {
    check_option(options.rooms[axis] > 0, "rooms: give at least 1 room along each axis");
    check_option(options.room_size[axis] >= block_size,
                 "rooms: a room must have at least 3 squares along each axis");
    check_option(options.door >= 1 && options.door <= options.room_size[axis],
                 "rooms: the door must have at least 1 square and not more than the wall");
    squares *= static_cast<double>(options.rooms[axis]) * options.room_size[axis];
  }
  check_option(squares <= 1e8, "rooms: too large; give fewer or smaller rooms");
  check_option(options.square > 0 && std::isfinite(options.square),
               "rooms: the edge of a square must be positive");
  return Rooms(options).build();
}

}  // namespace cellwalk
