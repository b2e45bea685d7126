// SPDX-License-Identifier: LGPL-3.0-or-later
// Loops turned by the direction of their common edges, and the sign of the enclosed volume.
#include <cellwalk/internal/io/polyhedron.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace cellwalk::io {
namespace {

using Loops = std::vector<std::vector<std::uint32_t>>;

struct Side {
  std::size_t loop;
  bool forward;  ///< from the lower vertex to the higher
};
using Edge_sides = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>>;

Edge_sides sides_of_edges(const Loops& loops) {
  Edge_sides sides;
  for (std::size_t f = 0; f < loops.size(); ++f)
    for (std::size_t i = 0; i < loops[f].size(); ++i) {
      const std::uint32_t a = loops[f][i], b = loops[f][(i + 1) % loops[f].size()];
      sides[std::minmax(a, b)].push_back({f, a < b});
    }
  return sides;
}

/// The loops to be reversed so that all agree with the first; none if the surface is not closed or not
/// orientable.
std::optional<std::vector<bool>> agreement(const Loops& loops, const Edge_sides& sides) {
  for (const auto& [edge, both] : sides)
    if (both.size() != 2) return std::nullopt;
  std::vector<int> turned(loops.size(), -1);
  std::vector<std::size_t> queue{0};
  turned[0] = 0;
  for (std::size_t q = 0; q < queue.size(); ++q) {
    const auto& loop = loops[queue[q]];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto& both = sides.at(std::minmax(loop[i], loop[(i + 1) % loop.size()]));
      const Side &own = both[both[0].loop == queue[q] ? 0 : 1],
                 &other = both[both[0].loop == queue[q] ? 1 : 0];
      const int wanted = turned[queue[q]] ^ static_cast<int>(own.forward == other.forward);
      if (turned[other.loop] < 0) {
        turned[other.loop] = wanted;
        queue.push_back(other.loop);
      } else if (turned[other.loop] != wanted) {
        return std::nullopt;
      }
    }
  }
  if (queue.size() != loops.size()) return std::nullopt;
  return std::vector<bool>(turned.begin(), turned.end());
}

double six_volumes(const Loops& loops, const std::vector<Point<3>>& points) {
  const Point<3>& apex = points[loops[0][0]];
  double sum = 0;
  for (const auto& loop : loops)
    for (std::size_t i = 1; i + 1 < loop.size(); ++i)
      sum += dot(points[loop[0]] - apex, cross(points[loop[i]] - apex, points[loop[i + 1]] - apex));
  return sum;
}

}  // namespace

bool turn_alike(Loops& loops, const std::vector<Point<3>>& points) {
  const auto turn = agreement(loops, sides_of_edges(loops));
  if (!turn || std::find(turn->begin(), turn->end(), true) == turn->end()) return false;
  for (std::size_t f = 0; f < loops.size(); ++f)
    if ((*turn)[f]) std::reverse(loops[f].begin(), loops[f].end());
  if (six_volumes(loops, points) < 0)
    for (auto& loop : loops) std::reverse(loop.begin(), loop.end());
  return true;
}

}  // namespace cellwalk::io
