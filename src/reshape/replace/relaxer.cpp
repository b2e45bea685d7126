// SPDX-License-Identifier: LGPL-3.0-or-later
// The operations tried on the worst cells, each kept if the least quality rises.
#include "relaxer.h"

#include <algorithm>
#include <array>
#include <utility>

namespace cellwalk::detail {
namespace {

/// A vertex goes to the mean of its neighbours, or so far towards it.
constexpr std::array<double, 4> shares_of_way{1, 0.75, 0.5, 0.25};
/// An operation that does not raise the least quality by this factor is not worth it, and might be undone
/// again.
constexpr double least_gain = 1 + 0x1p-10;

}  // namespace

template <int D>
Relaxer<D>::Relaxer(Environment<D>& environment, Replacer<D>& replacer, const Relax_options& options,
                    std::function<bool(std::uint32_t, const Point<D>&)> move)
    : environment_(environment),
      replacer_(replacer),
      options_(options),
      kept_(options.keep.begin(), options.keep.end()),
      move_(std::move(move)) {}

/// All cells around the points, each once, by name.
template <int D>
std::vector<Cell> Relaxer<D>::cells() const {
  std::vector<Cell> result;
  for (const std::uint32_t point : points_) {
    const std::vector<Cell> star = environment_.cells_around(point);
    result.insert(result.end(), star.begin(), star.end());
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

template <int D>
double Relaxer<D>::length(std::uint32_t u, std::uint32_t v) const {
  return cellwalk::length(replacer_.snapshot().point(v) - replacer_.snapshot().point(u));
}

template <int D>
double Relaxer<D>::mean_edge() const {
  double sum = 0, count = 0;
  for (const Cell c : cells()) {
    const auto vertices = replacer_.snapshot().view(c).vertices;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      for (std::size_t j = i + 1; j < vertices.size(); ++j, ++count) sum += length(vertices[i], vertices[j]);
  }
  return count == 0 ? 0 : sum / count;
}

template <int D>
double Relaxer<D>::quality_of(Cell cell) const {
  const Snapshot<D>& snapshot = replacer_.snapshot();
  return quality<D>(Patch<D>{}.corners(snapshot, corners_of(snapshot, cell)));
}

template <int D>
double Relaxer<D>::least_quality(std::span<const Cell> cells) const {
  double least = 1;
  for (const Cell c : cells) least = std::min(least, quality_of(c));
  return least;
}

template <int D>
bool Relaxer<D>::make_if_better(const Patch<D>& patch, const std::string& reason, std::uint32_t& count) {
  if (!reason.empty()) return false;
  const double wanted = least_gain * std::max(0.0, least_quality(patch.removed));
  for (const auto& cell : patch.cells)
    if (!(quality<D>(patch.corners(replacer_.snapshot(), cell)) > wanted)) return false;
  const Replacement made = replacer_.make(patch);
  if (made.is_made && patch.added) points_.insert(made.point);
  count += made.is_made;
  return made.is_made;
}

/// Moves a vertex of the cell so that the worst cell around it gets better.
template <int D>
bool Relaxer<D>::smooth(const Candidate& candidate) {
  const Snapshot<D>& snapshot = replacer_.snapshot();
  for (const std::uint32_t v : candidate.corners) {
    if (kept_.contains(v) || !replacer_.is_off_walls(v)) continue;
    const std::vector<Cell> star = environment_.cells_around(v);
    std::set<std::uint32_t> neighbours;
    for (const Cell c : star) {
      const auto vertices = snapshot.view(c).vertices;
      neighbours.insert(vertices.begin(), vertices.end());
    }
    neighbours.erase(v);
    const Point<D> from = snapshot.point(v);
    Vector<D> way{};
    for (const std::uint32_t u : neighbours)
      way = way + (1 / static_cast<double>(neighbours.size())) * (snapshot.point(u) - from);
    const double before = least_quality(star);
    const auto is_better = [&](const Point<D>& x) {
      return std::ranges::all_of(star, [&](Cell c) {
        const auto corners = corners_of(snapshot, c);
        auto places = Patch<D>{}.corners(snapshot, corners);
        for (std::size_t k = 0; k < corners.size(); ++k)
          if (corners[k] == v) places[k] = x;
        return quality<D>(places) > least_gain * before;
      });
    };
    for (const double share : shares_of_way)
      if (const Point<D> x = from + share * way; is_better(x) && move_(v, x)) return ++report_.smoothed;
  }
  return false;
}

template <int D>
bool Relaxer<D>::flip(const Candidate& candidate) {
  for (std::size_t i = 0; i <= D; ++i) {
    std::string reason;
    const Patch<D> patch = replacer_.flipped(Snapshot<D>::half_facet(candidate.cell, i), reason);
    if (make_if_better(patch, reason, report_.flipped)) return true;
  }
  return false;
}

template <int D>
bool Relaxer<D>::remove_edges(const Candidate& candidate) {
  if constexpr (D == 3)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) {
        std::string reason;
        const Patch<3> patch = replacer_.without_edge(candidate.corners[i], candidate.corners[j], reason);
        if (make_if_better(patch, reason, report_.edges_removed)) return true;
      }
  return false;
}

template <int D>
bool Relaxer<D>::collapse(const Candidate& candidate) {
  for (const std::uint32_t u : candidate.corners) {
    if (kept_.contains(u)) continue;
    for (const std::uint32_t v : candidate.corners) {
      if (u == v || !(length(u, v) < options_.shortest * edge_)) continue;
      std::string reason;
      const Patch<D> patch = replacer_.collapsed(u, v, reason);
      if (!make_if_better(patch, reason, report_.collapsed)) continue;
      points_.erase(u);
      points_.insert(v);
      return true;
    }
  }
  return false;
}

template <int D>
bool Relaxer<D>::split(const Candidate& candidate) {
  for (std::size_t i = 0; i <= D; ++i)
    for (std::size_t j = i + 1; j <= D; ++j) {
      const std::uint32_t u = candidate.corners[i], v = candidate.corners[j];
      if (!(length(u, v) > options_.longest * edge_)) continue;
      const Point<D>& x = replacer_.snapshot().point(u);
      std::string reason;
      const Patch<D> patch = replacer_.split(u, v, x + 0.5 * (replacer_.snapshot().point(v) - x), reason);
      if (make_if_better(patch, reason, report_.split)) return true;
    }
  return false;
}

/// Makes the first operation that makes the cell and those beside it better.
template <int D>
bool Relaxer<D>::improve(const Candidate& candidate) {
  return (options_.flip && (flip(candidate) || remove_edges(candidate))) ||
         (options_.smooth && smooth(candidate)) || (options_.collapse && collapse(candidate)) ||
         (options_.split && split(candidate));
}

template <int D>
Relax_report Relaxer<D>::run(std::span<const std::uint32_t> points) {
  replacer_.check_points(points);
  replacer_.check_points(options_.keep);
  points_ = {points.begin(), points.end()};
  const Snapshot<D>& snapshot = replacer_.snapshot();
  edge_ = mean_edge();
  report_.least_before = report_.least_after = least_quality(cells());
  for (bool gets_on = true; gets_on && static_cast<int>(report_.rounds) < options_.most_rounds;) {
    gets_on = false;
    std::vector<Candidate> candidates;
    for (const Cell c : cells())
      if (const double q = quality_of(c); q < options_.good_enough)
        candidates.push_back({q, corners_of(snapshot, c), c});
    std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
      return std::pair(a.quality, a.corners) < std::pair(b.quality, b.corners);
    });
    if (candidates.empty()) break;
    ++report_.rounds;
    for (const Candidate& candidate : candidates) {
      if (report_.operations() >= options_.most_operations) break;
      if (!snapshot.is_cell(candidate.cell) || corners_of(snapshot, candidate.cell) != candidate.corners ||
          !(quality_of(candidate.cell) < options_.good_enough))
        continue;
      ++report_.tried;
      gets_on |= improve(candidate);
    }
  }
  report_.least_after = least_quality(cells());
  return report_;
}

template class Relaxer<2>;
template class Relaxer<3>;

}  // namespace cellwalk::detail
