// SPDX-License-Identifier: LGPL-3.0-or-later
// Lengths next to the middle of two doubles. Random motions hardly ever have such a piece, and they alone
// tell whether errors are bounded as they have to be: one that is too small rounds them.
#include <cellwalk/generators/grid.h>
#include <cellwalk/internal/environment/gluing.h>
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/walk/trace.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "walk/lane_measures.h"
#include "walk/trace/lane_kinds.h"

namespace cellwalk {
namespace {

using Large = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<150>>;

/// A motion, and that of its pieces whose length is next to the middle of two doubles.
struct Tie {
  Particle<3> particle;
  Point<3> to;
  std::vector<Cell_exit> exits;
  std::size_t piece;
  double nearest;  ///< to its length
};

class TraceTies : public testing::Test {
 protected:
  TraceTies() : snapshot_(make_snapshot()), locator_(snapshot_), planes_(detail::lane_planes(snapshot_)) {}

  static Snapshot<3> make_snapshot() {
    Simplex_grid_options<3> options;
    options.cells = Grid_options<3>::filled(4);
    options.jitter = 0.12;
    options.map.origin = {-2, -2, -2};
    const Cell_soup<3> soup = tetrahedral_grid(options);
    return Snapshot<3>::compile(soup, glue(soup));
  }

  Point<3> any_point() {
    Point<3> p;
    for (double& x : p) x = random_.real(-1.75, 1.75);
    return p;
  }

  /// A coordinate of the start is so small that its doubles are far closer than those of lengths: it is
  /// chosen such that the middle is as far from the length as twice the precision of a double cannot tell.
  std::optional<Tie> any_tie() {
    Tie tie{{}, any_point(), {}, 0, 0};
    Point<3> from = any_point();
    const std::size_t axis = random_.below(3);
    from[axis] = random_.real(0x1p-52, 0x1p-50);
    if (!walk_through_facets(from, tie) || tie.exits.empty()) return {};
    tie.piece = random_.below(tie.exits.size() + 1);

    const auto length_from = [&](const Large& x) {
      std::array<Large, 3> start{from[0], from[1], from[2]};
      start[axis] = x;
      return length(start, tie);
    };
    const auto below = length_from(from[axis]).convert_to<double>(), above = std::nextafter(below, 9.0);
    const Large middle = (Large(below) + Large(above)) / 2;
    const double error = error_of_ends(from, tie) * random_.real(0.01, 0.9) * (random_.chance(0.5) ? -1 : 1);
    Large x = from[axis], next = x / 2, of_x = length_from(x);
    for (int i = 0; i < 20 && x != next; ++i) {  // the rule of secants
      const Large of_next = length_from(next);
      if (of_next == of_x) break;
      const Large step = (middle + error - of_next) * (next - x) / (of_next - of_x);
      x = next;
      of_x = of_next;
      next += step;
    }
    from[axis] = next.convert_to<double>();
    const Large off = length_from(from[axis]) - middle;
    const std::size_t exits = tie.exits.size();
    if (!(abs(off) < error_of_ends(from, tie))) return {};  // it does not depend on that coordinate enough
    if (off == 0 || !walk_through_facets(from, tie) || tie.exits.size() != exits) return {};
    tie.nearest = off > 0 ? above : below;
    return tie;
  }

  /// False if the motion passes a ridge or vertex, or does not arrive.
  bool walk_through_facets(const Point<3>& from, Tie& tie) {
    const auto particle = locator_.particle_at(from);
    if (!particle) return false;
    tie.particle = *particle;
    tie.exits.clear();
    Walk_counts counts;
    Walk_options options;
    options.exits = &tie.exits;
    if (walk(snapshot_, *particle, tie.to, counts, options).contact) return false;
    return std::ranges::none_of(tie.exits, [](const Cell_exit& x) { return x.facet == Half_facet::none; });
  }

  /// The length of a piece of the motion from `start`.
  Large length(const std::array<Large, 3>& start, const Tie& tie) const {
    std::array<Large, 3> way;
    Large square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      way[k] = Large(tie.to[k]) - start[k];
      square += way[k] * way[k];
    }
    const auto share = [&](std::size_t exit) {
      const auto loop = snapshot_.loop(tie.exits[exit].facet);
      const auto corner = [&](std::size_t i, std::size_t k) { return Large(snapshot_.point(loop[i])[k]); };
      Large height = 0, slope = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        const Large normal = (corner(1, i) - corner(0, i)) * (corner(2, j) - corner(0, j)) -
                             (corner(1, j) - corner(0, j)) * (corner(2, i) - corner(0, i));
        height += normal * (corner(0, k) - start[k]);
        slope += normal * way[k];
      }
      return Large(height / slope);
    };
    const Large begin = tie.piece == 0 ? Large(0) : share(tie.piece - 1),
                end = tie.piece == tie.exits.size() ? Large(1) : share(tie.piece);
    return Large(sqrt(square) * (end - begin));
  }

  /// The error that lane_lengths.h proves of the places at which the piece begins and ends.
  double error_of_ends(const Point<3>& from, const Tie& tie) const {
    const Vector<3> way = tie.to - from;
    double sum = 0;
    for (const std::size_t exit : {tie.piece - 1, tie.piece}) {
      if (exit >= tie.exits.size()) continue;  // an end of the motion
      const detail::Lane_plane& plane = planes_.planes[to_index(tie.exits[exit].facet)];
      double slope = 0;
      for (std::size_t k = 0; k < 3; ++k) slope += plane.high[k] * way[k] / cellwalk::length(way);
      sum += 0x1p16 * 0x1p-106 * planes_.size / std::abs(slope);
    }
    return sum;
  }

  std::vector<double> exact(const Tie& tie) const {
    return lengths_of_pieces(snapshot_, tie.particle.position, tie.to, tie.exits, tie.exits.size() + 1);
  }

  Random random_{11};
  const Snapshot<3> snapshot_;
  const Locator<3> locator_;
  const detail::Lane_planes planes_;
};

TEST_F(TraceTies, AreLeftOpenByLanesAndRoundedByExactNumbers) {
  const double error = detail::lane_error * planes_.size;
  std::vector<std::size_t> ties_of_piece(32);
  for (int count = 0; count < 1500;) {
    const std::optional<Tie> tie = any_tie();
    if (!tie) continue;
    ++count;
    ++ties_of_piece[std::min<std::size_t>(tie->piece, 31)];
    const std::vector<double> lengths = exact(*tie);
    ASSERT_EQ(lengths[tie->piece], tie->nearest);
    std::vector<unsigned> met;
    for (const Cell_exit& exit : tie->exits) met.push_back(to_index(exit.facet));
    for (const detail::Lane_kind& kind : detail::lane_kinds()) {
      const Measured measured(tie->particle.position, tie->to, planes_, met, error, kind.functions);
      ASSERT_EQ(measured.length[tie->piece], 0) << kind.name << ", piece " << tie->piece;
      for (std::size_t i = 0; i < lengths.size(); ++i)
        ASSERT_TRUE(measured.length[i] == lengths[i] || measured.length[i] == 0) << kind.name;
    }
  }
  for (std::size_t piece = 0; piece < 10; ++piece)  // in all lanes, and beyond the first eight
    EXPECT_GT(ties_of_piece[piece], 20u) << piece;
}

/// The lengths of rows are computed together; one that is open must not pass for those that are certain.
TEST_F(TraceTies, AreRoundedInRowsAmongOthers) {
  for (const std::size_t every : {1u, 31u, 32u, 33u, 1000u}) {
    std::vector<Particle<3>> particles;
    std::vector<Point<3>> targets;
    std::vector<std::vector<double>> expected;
    while (particles.size() < 400) {
      std::optional<Tie> tie = any_tie();
      if (particles.size() % every != every / 2) {
        tie = Tie{{}, any_point(), {}, 0, 0};
        if (!walk_through_facets(any_point(), *tie)) continue;
      }
      if (!tie) continue;
      particles.push_back(tie->particle);
      targets.push_back(tie->to);
      expected.push_back(exact(*tie));
    }
    Traces traces;
    Walk_counts counts;
    Tracer<3>(snapshot_).trace(particles, targets, traces, counts);
    for (std::size_t row = 0; row < expected.size(); ++row) {
      const std::vector<double> lengths(
          traces.lengths.begin() + static_cast<std::ptrdiff_t>(traces.offsets[row]),
          traces.lengths.begin() + static_cast<std::ptrdiff_t>(traces.offsets[row + 1]));
      ASSERT_EQ(lengths, expected[row]) << "row " << row << ", a tie in every " << every;
    }
  }
}

}  // namespace
}  // namespace cellwalk
