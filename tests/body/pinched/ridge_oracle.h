// SPDX-License-Identifier: LGPL-3.0-or-later
// An oracle for bodies that are pinched at a vertex p on the ridge of a world: whether all that p takes along
// the ridge can go from wedge to wedge together. It tries all ways to do so, in whole numbers.
#ifndef CELLWALK_TESTS_BODY_PINCHED_RIDGE_ORACLE_H
#define CELLWALK_TESTS_BODY_PINCHED_RIDGE_ORACLE_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "body/pinched/ridge_world.h"

namespace cellwalk::test::ridge {

/// Edges lead from p to their ends, and triangles are between two of these.
struct Star {
  std::vector<Place> ends;
  std::vector<std::array<std::size_t, 2>> faces;
};
/// The cells through which an edge passes from p to its end, and the sides between them.
struct Edge_chain {
  std::vector<std::size_t> cells;
  std::vector<Side> passed;
};
/// How a star is registered, with p at an x.
struct Star_state {
  int x = 0;
  std::size_t cell = 0;
  std::vector<Edge_chain> chains;               ///< by end
  std::vector<std::vector<Cell_side>> resting;  ///< by face: the walls in its plane, from its side
};

/// x and level of a point in a half-plane.
using Flat_point = std::array<int, 2>;

/// True if the inner points of two convex hulls meet (those of a segment are all but its ends).
inline bool do_overlap(const std::vector<Flat_point>& a, const std::vector<Flat_point>& b) {
  const auto is_line_between = [&](const Flat_point& u, const Flat_point& v) {
    const auto range = [&](const std::vector<Flat_point>& points) {
      std::vector<int> sides;
      for (const auto& [x, level] : points)
        sides.push_back((v[0] - u[0]) * (level - u[1]) - (v[1] - u[1]) * (x - u[0]));
      const auto [low, high] = std::minmax_element(sides.begin(), sides.end());
      return std::pair(*low, *high);
    };
    const auto of_a = range(a), of_b = range(b);
    return u != v && (of_a.second <= of_b.first || of_b.second <= of_a.first);
  };
  for (const auto* hull : {&a, &b})  // a line between them is parallel to a side of one
    for (const Flat_point& u : *hull)
      for (const Flat_point& v : *hull)
        if (is_line_between(u, v)) return false;
  return true;
}

/// An edge, and at which parameters it is where.
struct Rational_edge {
  Xyz<Rational> p, q;

  Rational_edge(const Ridge_world& world, int x, const Place& end) : p{x, 0, 0} {
    const Xyz<int> at = world.point(end);
    q = {at[0], at[1], at[2]};
  }
  /// From the first to the last parameter in a side of a cell; in reverse order if there is none.
  std::array<Rational, 2> span(const Ridge_world& world, const Cell_side& in) const {
    std::array<Rational, 2> span{0, 1};
    const auto keep = [&](const Rational& a, const Rational& b) {  // where it is >= 0
      if (a < 0 && b < 0) span = {1, 0};
      if (a < 0 && b >= 0) span[0] = std::max(span[0], Rational(a / (a - b)));
      if (a >= 0 && b < 0) span[1] = std::min(span[1], Rational(a / (a - b)));
    };
    for (const Side side : all_sides) {
      const Rational a = world.value(in.first, side, p), b = world.value(in.first, side, q);
      keep(a, b);
      if (side == in.second) keep(-a, -b);
    }
    return span;
  }
  /// By cell: whether it is linked, at a parameter, with the cell in which the chain is there.
  std::vector<bool> linked(const Ridge_world& world, const Edge_chain& chain, const Rational& t) const {
    std::size_t at = 0;
    for (std::size_t k = 0; k < chain.passed.size(); ++k)
      if (span(world, {chain.cells[k], chain.passed[k]})[1] < t) at = k + 1;
    Xyz<Rational> x;
    for (std::size_t k = 0; k < 3; ++k) x[k] = p[k] + t * (q[k] - p[k]);
    return world.linked(chain.cells[at], x);
  }
};

enum class Verdict { possible, no_side, no_wedge };

/// The ways in which a star can move with p along the axis.
class Ridge_oracle {
 public:
  Ridge_oracle(const Ridge_world& world, const Star& star, int from, int to)
      : world_(world), star_(star), from_(from), to_(to) {
    for (int slab = 0; slab < world.slabs; ++slab)
      if (const auto [low, high] = on_slab(slab, from, to); low < high) way_.push_back(slab);
    if (to < from) std::reverse(way_.begin(), way_.end());
    for (const int slab : way_)
      for (int k = 0; k < world.sectors(); ++k)
        if (wedge(slab, k) == k) wedges_[slab].push_back(k);
    for (const Place& end : star.ends) edges_.push_back(add_edge(end));
    for (const auto& face : star.faces) faces_.push_back(add_face(face));
  }

  /// What the registration says where the way starts, or where it ends.
  void heed(const Star_state& state) {
    for (std::size_t e = 0; e < star_.ends.size(); ++e) {
      const Place& end = star_.ends[e];
      const Rational_edge edge(world_, state.x, end);
      if (end.is_on_axis()) heed_on_axis(edge, state.chains[e], state.x, end.x);
      for (const auto& [wall, rest] : edges_[e]) {
        const auto [low, high] = edge.span(world_, {wall, Side::own});
        if (low < high) allow_linked(rest, edge.linked(world_, state.chains[e], (low + high) / 2));
      }
    }
    const auto linked = world_.linked(state.cell, Xyz<int>{state.x, 0, 0});
    (state.x == from_ ? at_start_ : at_end_) = linked;
  }
  /// A flat face stays on its side of the walls in its plane.
  void heed_faces(const Star_state& state) {
    for (std::size_t n = 0; n < faces_.size(); ++n)
      for (const auto& [cell, side] : state.resting[n]) {
        const std::size_t wall = side == Side::next ? world_.neighbour(cell, side) : cell;
        const auto rest = faces_[n].find(wall);
        if (rest != faces_[n].end()) rests_[rest->second].may_be[side == Side::next ? 0 : 1] = false;
      }
  }
  /// p is between a half-plane and the next one on a slab.
  void hold(int slab, int k) {
    std::erase_if(wedges_[slab], [&](int other) { return other != wedge(slab, k); });
  }

  Verdict verdict() {
    for (const Rest& rest : rests_)
      for (std::size_t s = 0; s < 2; ++s) rests_[root(rest.group)].may_be[s] &= rest.may_be[s];
    for (const Rest& rest : rests_)
      if (const auto& may_be = rests_[root(rest.group)].may_be; !may_be[0] && !may_be[1])
        return Verdict::no_side;
    std::vector<int> history;
    return way_.empty() || can_go_on(history) ? Verdict::possible : Verdict::no_wedge;
  }

 private:
  /// Something in a half-plane at a wall there, and on which sides it may be: that of the sector of this
  /// number, and the one before. Those of a group are on the same side.
  struct Rest {
    int slab, half_plane, shell;
    std::size_t group;
    std::array<bool, 2> may_be{true, true};
  };
  using Rests = std::map<std::size_t, std::size_t>;  ///< of an edge or a face: by wall

  /// The piece of a slab that is between two x.
  static std::pair<int, int> on_slab(int slab, int x, int y) {
    constexpr int length = Ridge_world::slab_length;
    return {std::max(slab * length, std::min(x, y)), std::min((slab + 1) * length, std::max(x, y))};
  }
  /// The first sector that is linked with one around the axis.
  int wedge(int slab, int k) const {
    for (int n = 0; n < world_.sectors(); ++n, k = world_.before(k))
      if (world_.has_wall(slab, k, 0)) return k;
    return 0;
  }
  std::size_t root(std::size_t group) const {
    while (rests_[group].group != group) group = rests_[group].group;
    return group;
  }
  void join(std::size_t a, std::size_t b) { rests_[root(a)].group = root(b); }

  Rests add_edge(const Place& end) {
    if (end.is_on_axis()) return {};
    if (end.is_in_half_plane()) return add_flat(end.half_plane, {{from_, 0}, {to_, 0}, {end.x, end.alpha}});
    for (const int slab : way_) hold(slab, end.half_plane);
    return {};
  }
  Rests add_face(const std::array<std::size_t, 2>& face) {
    std::size_t first = face[0], last = face[1];
    if (star_.ends[first].is_on_axis()) std::swap(first, last);
    const Place &u = star_.ends[first], &v = star_.ends[last];
    const bool is_flat = v.is_on_axis() || (v.is_in_half_plane() && v.half_plane == u.half_plane);
    if (!is_flat || !u.is_in_half_plane()) {
      if (!v.is_on_axis()) hold_between(first, last);
      return {};
    }
    const Rests flat = add_flat(u.half_plane, {{from_, 0}, {to_, 0}, {u.x, u.alpha}, {v.x, v.alpha}});
    for (const std::size_t e : face)
      for (const auto& [wall, rest] : edges_[e])
        if (flat.contains(wall)) join(rest, flat.at(wall));
    return flat;
  }
  /// What sweeps a region of a half-plane rests on walls there, on one side of those that meet inside.
  Rests add_flat(int k, const std::vector<Flat_point>& swept) {
    Rests rests;
    for (int slab = 0; slab < world_.slabs; ++slab)
      for (int shell = 0; shell < Ridge_world::shells; ++shell) {
        const int x = slab * Ridge_world::slab_length, y = x + Ridge_world::slab_length;
        const int low = Ridge_world::levels_of(shell).first, high = Ridge_world::levels_of(shell).second;
        const std::size_t wall = world_.cell(slab, k, shell);
        if (!world_.has_wall(slab, k, shell) ||
            !do_overlap(swept, {{x, low}, {x, high}, {y, low}, {y, high}}))
          continue;
        const std::size_t own = rests_.size();
        rests_.push_back({slab, k, shell, own});
        rests[wall] = own;
        const auto join_with = [&](int other_slab, int other_shell, const Flat_point& end) {
          const auto other = rests.find(world_.cell(other_slab, k, other_shell));
          if (other != rests.end() && do_overlap(swept, {{x, low}, end})) join(own, other->second);
        };
        if (slab > 0) join_with(slab - 1, shell, {x, high});
        if (shell > 0) join_with(slab, shell - 1, {y, low});
      }
    for (const int slab : way_)
      if (!world_.has_wall(slab, k, 0)) hold(slab, k);
    return rests;
  }
  /// A face off the half-planes has its edges on the sides on which it is.
  void hold_between(std::size_t first, std::size_t last) {
    const auto at_first = world_.point(star_.ends[first]), at_last = world_.point(star_.ends[last]);
    if (at_first[1] * at_last[2] < at_first[2] * at_last[1]) std::swap(first, last);
    const Place &u = star_.ends[first], &v = star_.ends[last];
    const int end = v.is_in_half_plane() ? world_.before(v.half_plane) : v.half_plane;
    for (const int slab : way_)
      for (int k = u.half_plane;; k = world_.next(k)) {
        hold(slab, k);
        if (k == end) break;
      }
    for (const auto& [wall, rest] : edges_[first]) rests_[rest].may_be[1] = false;
    for (const auto& [wall, rest] : edges_[last]) rests_[rest].may_be[0] = false;
  }
  void allow_linked(std::size_t at, const std::vector<bool>& linked) {
    Rest& rest = rests_[at];
    if (!linked[world_.cell(rest.slab, rest.half_plane, rest.shell)]) rest.may_be[0] = false;
    if (!linked[world_.cell(rest.slab, world_.before(rest.half_plane), rest.shell)]) rest.may_be[1] = false;
  }
  void heed_on_axis(const Rational_edge& edge, const Edge_chain& chain, int x, int end) {
    for (const int slab : way_) {
      const auto way = on_slab(slab, from_, to_), piece = on_slab(slab, x, end);
      const int low = std::max(way.first, piece.first), high = std::min(way.second, piece.second);
      if (low >= high) continue;
      const auto linked = edge.linked(world_, chain, (Rational(low + high) / 2 - x) / (end - x));
      for (int k = 0; k < world_.sectors(); ++k)
        if (linked[world_.cell(slab, k, 0)]) hold(slab, k);
    }
  }
  bool is_in(int slab, int of_wedge, const std::vector<bool>& linked) const {
    if (linked.empty()) return true;  // anywhere
    for (int k = 0; k < world_.sectors(); ++k)
      if (wedge(slab, k) == of_wedge && linked[world_.cell(slab, k, 0)]) return true;
    return false;
  }
  /// True if p, and what it takes along, can go on from the wedges in which it was.
  bool can_go_on(std::vector<int>& history) const {
    const std::size_t n = history.size();
    if (n == way_.size()) return is_in(way_.back(), history.back(), at_end_) && suits_rests(history);
    std::vector<bool> linked = at_start_;
    if (n > 0) {
      const int x = Ridge_world::slab_length * std::max(way_[n - 1], way_[n]);
      linked = world_.linked(world_.cell(way_[n - 1], history.back(), 0), Xyz<int>{x, 0, 0});
    }
    for (const int next : wedges_.at(way_[n])) {
      if (!is_in(way_[n], next, linked)) continue;
      history.push_back(next);
      if (can_go_on(history)) return true;
      history.pop_back();
    }
    return false;
  }
  /// True if each group has a side on which it is in the wedges of the way.
  bool suits_rests(const std::vector<int>& history) const {
    std::vector<std::array<bool, 2>> may_be;
    for (const Rest& rest : rests_) may_be.push_back(rest.may_be);
    for (const Rest& rest : rests_)
      for (std::size_t n = 0; n < way_.size(); ++n) {
        if (rest.shell != 0 || rest.slab != way_[n]) continue;
        auto& of_group = may_be[root(rest.group)];
        of_group[0] &= wedge(rest.slab, rest.half_plane) == history[n];
        of_group[1] &= wedge(rest.slab, world_.before(rest.half_plane)) == history[n];
      }
    for (std::size_t r = 0; r < rests_.size(); ++r)
      if (const auto& of_group = may_be[root(r)]; !of_group[0] && !of_group[1]) return false;
    return true;
  }

  const Ridge_world& world_;
  const Star& star_;
  int from_, to_;
  std::vector<int> way_;                    ///< the slabs through which p passes
  std::map<int, std::vector<int>> wedges_;  ///< on each of them: those in which p may be
  std::vector<Rests> edges_, faces_;
  std::vector<Rest> rests_;
  std::vector<bool> at_start_, at_end_;  ///< the cells that are linked with that of p
};

}  // namespace cellwalk::test::ridge

#endif  // CELLWALK_TESTS_BODY_PINCHED_RIDGE_ORACLE_H
