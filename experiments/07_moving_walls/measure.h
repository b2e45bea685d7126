// SPDX-License-Identifier: LGPL-3.0-or-later
// Records the motion of the walls of a scene by Cellwalk, has all peers answer it, and judges all answers.
#ifndef CELLWALK_EXPERIMENTS_MOVING_WALLS_MEASURE_H
#define CELLWALK_EXPERIMENTS_MOVING_WALLS_MEASURE_H

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/peers/measured_build.h"
#include "narrow.h"
#include "scene.h"

namespace cellwalk::moving_walls {

/// The answers of a method, and its work.
struct Tally {
  std::uint64_t blocked = 0, missed = 0, reported = 0;  ///< reported: blocked moves that are not
  std::uint64_t tests = 0;                              ///< of a tetrahedron and an edge
  std::uint64_t signs = 0, exact_signs = 0;             ///< of orientations; those that needed exact numbers
};

/// Microseconds of each step.
struct Times {
  std::vector<double>
      update;                 ///< peers: the boxes and the hierarchy; Cellwalk: certificates anew, in close()
  std::vector<double> query;  ///< peers: the pairs; Cellwalk: nothing
  std::vector<double> answer;  ///< peers: the pairs tested; Cellwalk: the moves, contacts and stops included
};

struct Row {
  std::string method, library;
  Arithmetic arithmetic = Arithmetic::exact;
  Tally tally;
  Times times;
  std::uint64_t pairs = 0;  ///< of a triangle and an edge whose boxes meet; Cellwalk: edges through stars
  experiments::Build build;
};

/// The judge's counts of a scene.
struct Judged {
  std::uint64_t steps = 0, moves = 0, blocked = 0, bad_stops = 0, pairs = 0, touches = 0;
};

struct Result {
  std::string scene;
  std::string movers;
  std::uint64_t cells = 0, points = 0, walls = 0, bodies = 0, edges = 0, steps = 0;
  std::uint64_t point_moves = 0;  ///< asked for, of all points
  std::uint64_t moves = 0;        ///< of vertices of the walls, recorded
  std::uint64_t dropped = 0;  ///< not recorded, as a cell would have been flat, or the boundary met itself
  Judged judged;
  std::vector<Row> rows;
};

/// All members, for experiments::shared_trials().
template <class Archive, class Value>
void members(Archive& archive, Value& times) requires std::same_as<std::remove_const_t<Value>, Times> {
  archive(times.update);
  archive(times.query);
  archive(times.answer);
}
template <class Archive, class Value>
void members(Archive& archive, Value& row) requires std::same_as<std::remove_const_t<Value>, Row> {
  archive(row.method);
  archive(row.library);
  archive(row.arithmetic);
  archive(row.tally);
  archive(row.times);
  archive(row.pairs);
  experiments::members_of_build(archive, row.build);
}
template <class Archive, class Value>
void members(Archive& archive, Value& result) requires std::same_as<std::remove_const_t<Value>, Result> {
  archive(result.scene);
  archive(result.movers);
  for (auto* count : {&result.cells, &result.points, &result.walls, &result.bodies, &result.edges,
                      &result.steps, &result.point_moves, &result.moves, &result.dropped})
    archive(*count);
  archive(result.judged);
  archive(result.rows);
}

/// What answers of a method are changed before they are judged: for tests of the judge.
enum class Spoiled : std::uint8_t {
  nothing,
  hits,  ///< the first blocked move of each step is said to be free
  boxes  ///< pairs are looked for in the upper half of each box only
};

struct Measure_options {
  int steps = 32;  ///< of one beat
  int rounds = 1;  ///< of the whole motion; times are those of all rounds
  int judged = 1;  ///< every so many steps are judged; 0: none
  bool is_timed = true;
  Spoiled spoiled = Spoiled::nothing;
};

/// \param make makes the scene, as it is at the start
Result measure(const std::function<std::unique_ptr<Scene>()>& make, const std::string& name,
               std::string_view movers, const Measure_options& options);

}  // namespace cellwalk::moving_walls

#endif  // CELLWALK_EXPERIMENTS_MOVING_WALLS_MEASURE_H
