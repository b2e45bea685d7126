// SPDX-License-Identifier: LGPL-3.0-or-later
// A case of the corpus, as it is written.
#ifndef CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_CASE_H
#define CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_CASE_H

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "world.h"

namespace cellwalk::corpus {

/// One vertex of the object, or of the walls, moves along a straight line.
template <int D>
struct Move {
  std::uint32_t vertex = 0;
  Point<D> to{};
};

/// A time at which the object meets walls.
struct Meeting {
  std::uint32_t move = 0;
  Rational time;
  std::vector<std::uint32_t> walls;     ///< that it meets then
  std::string feature;                  ///< of them, of lowest dimension
  std::vector<std::string> wall_kinds;  ///< of them
};

enum class Crossing { no, yes, either };
inline constexpr std::array<const char*, 3> crossing_names{"no", "yes", "either"};

template <int D>
struct Case {
  std::string id, degeneracy, near;  ///< near: the case of which a target was moved by an ulp
  std::string nature;                ///< more that tells sorts apart; it is not written
  std::vector<Point<D>> points, side;
  std::vector<Move<D>> moves;
  bool moves_wall = false;       ///< what moves is a vertex of the world, and the object stands still
  bool at_start = false;         ///< the object meets a wall before it moves
  std::optional<Meeting> touch;  ///< the first time at which it meets a wall off its start
  Crossing crossing = Crossing::no;
  std::vector<Meeting> crossings;  ///< times at which it may be blocked
};

/// Where what moves is before it does.
template <int D>
Point<D> start_of(const Case<D>& c, const World<D>& world, const Move<D>& move) {
  return c.moves_wall ? world.soup.points[move.vertex] : c.points[move.vertex];
}

/// The points of the object in a move, at a time.
template <int D>
std::vector<Vec> pose(const Case<D>& c, std::uint32_t move, const Rational& time);

/// What differs legally between libraries.
template <int D>
const char* convention(const Case<D>& c);

template <int D>
nlohmann::ordered_json to_json(const Case<D>& c, const char* kind, const World<D>& world);
template <int D>
nlohmann::ordered_json to_json(const World<D>& world);

/// A case as the program that answers it needs it.
template <int D>
Case<D> question(const nlohmann::ordered_json& json);

}  // namespace cellwalk::corpus

#endif  // CELLWALK_EXPERIMENTS_DEGENERATE_CORPUS_CASE_H
