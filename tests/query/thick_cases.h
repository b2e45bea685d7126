// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions with a radius whose answers are known by heart.
#ifndef CELLWALK_TESTS_QUERY_THICK_CASES_H
#define CELLWALK_TESTS_QUERY_THICK_CASES_H

#include <cellwalk/query/query.h>

#include <array>
#include <optional>
#include <vector>

namespace cellwalk::test {

/// membrane: a box with a membrane x = 4, 2 <= y, z <= 6; plane: the same in 2D; step: [0,8]^3 without all
/// that has x > 4 and z < 4; channel: [0,8]^2 x [0,2]; wedge: |z| <= 3y/4; spike: a triangle alone; oblique:
/// a facet alone.
enum class Room { membrane, plane, step, channel, wedge, spike, oblique };

struct Thick_answer {
  Motion_status status = Motion_status::free;
  bool touches = false;           ///< free, and comes as near as r
  double time = 0;                ///< of a contact, rounded down
  std::array<double, 2> exact{};  ///< its exact time if that is known as a fraction: numerator, denominator
  Body_feature body = Body_feature::vertex;
  Contact_kind kind = Contact_kind::facet;
  std::vector<std::array<double, 3>> normals{};  ///< of all walls that are met at this time
  double distance = 0;                           ///< of a start too close, rounded to nearest
};

struct Thick_case {
  const char* name;
  Room room;
  double radius;
  std::array<double, 3> p, target;
  std::optional<std::array<double, 3>> q;  ///< none: a particle
  Thick_answer answer;
};

/// Free, without coming as near as r, or just so.
inline const Thick_answer clear{}, at_r{.touches = true};

inline Thick_answer close_at(double distance) {
  return {.status = Motion_status::close, .distance = distance};
}

inline Thick_answer met(double time, std::array<double, 2> exact, Body_feature body, Contact_kind kind,
                        std::vector<std::array<double, 3>> normals) {
  return {.status = Motion_status::contact,
          .time = time,
          .exact = exact,
          .body = body,
          .kind = kind,
          .normals = std::move(normals)};
}

/// The end p meets a facet: the most frequent case.
inline Thick_answer end_on_facet(std::array<double, 2> exact, double time,
                                 std::vector<std::array<double, 3>> normals) {
  return met(time, exact, Body_feature::vertex, Contact_kind::facet, std::move(normals));
}
inline Thick_answer end_on_facet(double time, std::vector<std::array<double, 3>> normals) {
  return end_on_facet({time, 1}, time, std::move(normals));
}

inline std::vector<Thick_case> thick_cases() {
  constexpr auto vertex = Body_feature::vertex, edge = Body_feature::edge;
  constexpr auto on_vertex = Contact_kind::vertex, on_edge = Contact_kind::edge;
  constexpr std::array<double, 2> irrational{}, long_fraction{};
  constexpr double ulp = 0x1p-52;
  using enum Room;
  return {
      {"touch ends", membrane, 1, {2, 4, 4}, {3, 4, 4}, {{2, 5, 4}}, at_r},
      {"touch and one ulp",
       membrane,
       1,
       {2, 4, 4},
       {3 + 2 * ulp, 4, 4},
       {{2, 5, 4}},
       end_on_facet({0x1p51, 0x1p51 + 1}, 0.9999999999999996, {{-1, 0, 0}})},
      {"starts at r, leaves", membrane, 1, {3, 4, 4}, {2, 4, 4}, {{3, 5, 4}}, at_r},
      {"starts at r, parallel", membrane, 1, {3, 4, 4}, {3, 3, 4}, {{3, 5, 4}}, at_r},
      {"starts at r, enters", membrane, 1, {3, 4, 4}, {4, 4, 4}, {{3, 5, 4}}, end_on_facet(0, {{-1, 0, 0}})},
      {"beyond the wall", membrane, 1, {2, 4, 4}, {6, 4, 4}, {{2, 5, 4}}, end_on_facet(0.25, {{-1, 0, 0}})},
      {"beyond two walls",
       membrane,
       1,
       {2, 4, 4},
       {10, 4, 4},
       {{2, 5, 4}},
       end_on_facet(0.125, {{-1, 0, 0}})},
      {"outer wall behind the rim",
       membrane,
       1,
       {2, 7, 4},
       {10, 7, 4},
       {{2, 7, 5}},
       end_on_facet(0.625, {{-1, 0, 0}})},
      {"past the rim at r", membrane, 1, {2, 7, 4}, {6, 7, 4}, {{2, 7, 5}}, at_r},
      {"past the rim too near",
       membrane,
       1,
       {2, 7 - 8 * ulp, 4},
       {6, 7 - 8 * ulp, 4},
       {{2, 7 - 8 * ulp, 5}},
       met(0.4999999850988388, irrational, vertex, on_edge, {{0, 1, 0}})},
      {"past a corner of the rim",
       membrane,
       1,
       {2, 7, 7},
       {6, 6.5, 6.5},
       {{2, 7, 6.5}},
       met(0.6058952099257188, irrational, edge, on_vertex, {{0.039008, 0.745124, 0.665784}})},
      {"rod turns about the rim",
       membrane,
       1,
       {1, 7, 4},
       {2, 4, 4},
       {{5, 7, 4}},
       met(0, {0, 1}, edge, on_edge, {{0, 1, 0}})},
      {"too close elsewhere", membrane, 1, {1, 7.25, 4}, {1, 4, 4}, {{5, 7, 4}}, close_at(0.75)},
      {"corner of the room, three walls",
       membrane,
       1,
       {2, 2, 2},
       {0, 0, 0},
       {{3, 3, 3}},
       end_on_facet(0.5, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})},
      {"corner reached exactly", membrane, 1, {2, 2, 2}, {1, 1, 1}, {{3, 3, 3}}, at_r},
      {"starts too close", membrane, 1, {3.5, 4, 4}, {2, 4, 4}, {{2, 5, 4}}, close_at(0.5)},
      {"edge too close, ends not", membrane, 1, {3, 3.5, 6.5}, {2, 4, 4}, {{5, 3.5, 6.5}}, close_at(0.5)},
      {"edge crosses the membrane", membrane, 1, {2, 4, 4}, {2, 5, 4}, {{6, 4, 4}}, close_at(0)},
      {"still point", membrane, 1, {3, 4, 4}, {3, 4, 4}, {{3, 4, 4}}, at_r},
      {"particle", membrane, 1, {2, 4, 4}, {6, 4, 4}, {}, end_on_facet(0.25, {{-1, 0, 0}})},
      {"passes through q", membrane, 1, {2, 4, 4}, {2, 4, 0}, {{2, 4, 3}}, end_on_facet(0.75, {{0, 0, 1}})},
      {"collinear to the wall",
       membrane,
       1,
       {2, 4, 4},
       {4, 4, 4},
       {{1, 4, 4}},
       end_on_facet(0.5, {{-1, 0, 0}})},
      {"q at r of the rim, turns in",
       membrane,
       1,
       {2, 7, 4},
       {5, 6.75, 4},
       {{4, 7, 4}},
       met(0, {0, 1}, edge, on_edge, {{0, 1, 0}})},
      {"q at r of the rim, along", membrane, 1, {2, 7, 4}, {6, 7, 4}, {{4, 7, 4}}, at_r},
      {"2D, in line with the membrane", plane, 1, {3, 4, 0}, {3, 5, 0}, {{3, 2, 0}}, at_r},
      {"2D, round the end",
       plane,
       1,
       {2, 7, 0},
       {5, 6, 0},
       {{4, 7, 0}},
       met(0, {0, 1}, edge, on_vertex, {{0, 1, 0}})},
      {"2D, starts too close", plane, 1, {2, 4, 0}, {6, 7, 0}, {{4, 7, 0}}, close_at(0.5547001962252291)},
      {"2D, end before edge", plane, 1, {2, 5, 0}, {4, 6, 0}, {{2, 7, 0}}, end_on_facet(0.5, {{-1, 0, 0}})},
      {"2D, edge and end at once",
       plane,
       1,
       {2, 4, 0},
       {6, 4, 0},
       {{3, 7, 0}},
       end_on_facet(0.25, {{-1, 0, 0}})},
      {"over a convex edge", step, 1, {2, 4, 5}, {6, 4, 5}, {{2, 5, 5}}, at_r},
      {"over a convex edge, below",
       step,
       1,
       {2, 4, 4.5},
       {6, 4, 4.5},
       {{2, 5, 4.5}},
       met(0.2834936490538903, irrational, vertex, on_edge, {{-0.866025, 0, 0.5}})},
      {"onto a convex edge",
       step,
       1,
       {2, 4, 6},
       {5, 4, 3},
       {{2, 5, 6}},
       met(0.4309644062711508, irrational, vertex, on_edge, {{-0.707107, 0, 0.707107}})},
      {"into a reflex edge",
       step,
       1,
       {2, 4, 2},
       {4, 4, 0},
       {{2, 5, 2}},
       end_on_facet(0.5, {{-1, 0, 0}, {0, 0, 1}})},
      {"along a reflex edge", step, 1, {3, 2, 1}, {3, 6, 1}, {{3, 1, 1}}, at_r},
      {"rod on a convex edge",
       step,
       1,
       {2, 4, 7},
       {7, 4, 4},
       {{2, 4, 2}},
       met(0.35520818569092444, irrational, edge, on_edge, {{-0.911438, 0, 0.411438}})},
      {"channel of 2r", channel, 1, {2, 4, 1}, {6, 4, 1}, {{1, 4, 1}}, at_r},
      {"channel of 2r, up",
       channel,
       1,
       {2, 4, 1},
       {6, 4, 1 + ulp},
       {{1, 4, 1}},
       end_on_facet(0, {{0, 0, -1}})},
      {"channel of less than 2r", channel, 1 + 4 * ulp, {2, 4, 1}, {6, 4, 1}, {{3, 4, 1}}, close_at(1)},
      {"into a wedge",
       wedge,
       3,
       {4, 8, 0},
       {4, 2, 0},
       {{4, 9, 0}},
       end_on_facet(0.5, {{0, 0.6, -0.8}, {0, 0.6, 0.8}})},
      {"along a wedge", wedge, 3, {2, 5, 0}, {6, 5, 0}, {{1, 5, 0}}, at_r},
      {"r larger than the room", membrane, 100, {2, 4, 4}, {2, 5, 4}, {{2, 4, 5}}, close_at(2)},
      {"spike met by the edge",
       spike,
       1,
       {2, 2, 6},
       {2, 4, 3},
       {{6, 6, 6}},
       met(0.6295240746867349, irrational, edge, on_vertex, {{-0.549387, 0.253063, 0.796324}})},
      {"time with a square root",
       oblique,
       1,
       {4, 4, 6},
       {4, 4, 0},
       {{4, 5, 6}},
       end_on_facet(irrational, 0.6640825332367508, {{-0.123091, -0.123091, 0.984732}})},
      {"least r",
       membrane,
       5e-324,
       {2, 4, 4},
       {6, 4, 4},
       {{2, 5, 4}},
       end_on_facet(long_fraction, 0.49999999999999994, {{-1, 0, 0}})},
      {"great r", membrane, 1e308, {2, 4, 4}, {6, 4, 4}, {{2, 5, 4}}, close_at(2)},
  };
}

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_QUERY_THICK_CASES_H
