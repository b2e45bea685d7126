// SPDX-License-Identifier: LGPL-3.0-or-later
// Random edges in free space, and the cells through which they pass.
#include <cellwalk/internal/kernel/random.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/query/query.h>
#include <cellwalk/walk/walk.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace cellwalk {
namespace {

/// Edges tried for each that is requested.
constexpr std::size_t most_tries = 8;
/// The default length of edges, in mean distances between walls.
constexpr double part_of_wall_distance = 0.1;

/// D! times the volume of a simplex, rounded.
double scaled_volume(const std::array<Point<3>, 4>& s) {
  return dot(s[1] - s[0], cross(s[2] - s[0], s[3] - s[0]));
}
double scaled_volume(const std::array<Point<2>, 3>& s) {
  const Vector<2> a = s[1] - s[0], b = s[2] - s[0];
  return a[0] * b[1] - a[1] * b[0];
}

/// The area of the side opposite the first point, rounded; in 2D its length.
double area(const std::array<Point<3>, 4>& s) { return length(cross(s[2] - s[1], s[3] - s[1])) / 2; }
double area(const std::array<Point<2>, 3>& s) { return length(s[2] - s[1]); }

/// A simplex of a cell: its least point and a part of a facet. The volume is 0 for facets at that point.
template <int D>
struct Piece {
  std::array<Point<D>, D + 1> simplex;
  bool is_wall = false;  ///< the facet is one

  bool operator<(const Piece& other) const { return simplex < other.simplex; }
};

/// The pieces of a cell. They and their order depend on the geometry only, so that environments of other
/// files give the same numbers.
template <int D>
void cut(const Snapshot<D>& snapshot, Cell cell, std::vector<Piece<D>>& pieces) {
  const Cell_view<D> view = snapshot.view(cell);
  Point<D> least = view.point(0);
  for (std::size_t v = 1; v < view.vertex_count(); ++v) least = std::min(least, view.point(v));
  pieces.clear();
  std::vector<Point<D>> loop;
  for (std::size_t f = 0; f < view.facet_count(); ++f) {
    const bool is_wall = snapshot.is_impassable(Snapshot<D>::half_facet(cell, f));
    loop.clear();
    for (const std::uint16_t v : view.loop(f)) loop.push_back(view.point(v));
    if constexpr (D == 2) {
      pieces.push_back({{least, loop[0], loop[1]}, is_wall});
    } else {
      std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
      for (std::size_t i = 1; i + 1 < loop.size(); ++i)
        pieces.push_back({{least, loop[0], loop[i], loop[i + 1]}, is_wall});
    }
  }
  std::sort(pieces.begin(), pieces.end());
}

/// Random points of free space, uniformly distributed up to rounding.
template <int D>
class Free_space {
 public:
  explicit Free_space(const Snapshot<D>& snapshot) : snapshot_(snapshot) {
    double sum = 0, wall_area = 0;
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell c = snapshot.cell(i);
      if (c == Cell::none || snapshot.is_solid(c)) continue;
      cut(snapshot, c, pieces_);
      for (const Piece<D>& piece : pieces_) {
        sum += scaled_volume(piece.simplex);
        if (piece.is_wall) wall_area += area(piece.simplex);
      }
      cells_.push_back(c);
      volume_up_to_.push_back(sum);
    }
    const double chord = D == 2 ? std::numbers::pi * sum / 2 / wall_area : 4 * sum / 6 / wall_area;
    if (std::isfinite(chord) && chord > 0) wall_distance_ = chord;
  }

  double wall_distance() const { return wall_distance_; }

  /// A particle at a random point; none if rounding leads it into a wall.
  std::optional<Particle<D>> particle(Random& random, Walk_counts& counts) {
    const double volume = random.real() * volume_up_to_.back();
    const auto at = std::upper_bound(volume_up_to_.begin(), volume_up_to_.end() - 1, volume);
    const Cell c = cells_[static_cast<std::size_t>(at - volume_up_to_.begin())];
    cut(snapshot_, c, pieces_);
    // The walk from a vertex finds the cell of the rounded point, and whether it lies on a facet.
    Particle<D> particle{pieces_.front().simplex[0], c, 0};
    const Point<D> target = point(pick(random), random);
    if (move(snapshot_, particle, target, counts, without_contacts).status != Walk_status::arrived) return {};
    return particle;
  }

  static constexpr Walk_options without_contacts{.locates_contact = false};

 private:
  /// One of the pieces, with the probability of its volume.
  const std::array<Point<D>, D + 1>& pick(Random& random) const {
    double total = 0;
    for (const Piece<D>& piece : pieces_) total += scaled_volume(piece.simplex);
    double left = random.real() * total;
    const Piece<D>* picked = &pieces_.back();
    for (const Piece<D>& piece : pieces_) {
      const double volume = scaled_volume(piece.simplex);
      if (volume <= 0) continue;
      picked = &piece;
      if (left < volume) break;
      left -= volume;
    }
    return picked->simplex;
  }

  /// A random point of a simplex: sorted numbers divide [0,1] into its barycentric coordinates.
  static Point<D> point(const std::array<Point<D>, D + 1>& s, Random& random) {
    std::array<double, D + 1> cuts{};
    for (std::size_t i = 0; i < D; ++i) cuts[i] = random.real();
    cuts[D] = 1;
    std::sort(cuts.begin(), cuts.end());
    Point<D> p = s[0];
    for (std::size_t i = 0; i < D; ++i) p = p + (cuts[i + 1] - cuts[i]) * (s[i + 1] - s[0]);
    return p;
  }

  const Snapshot<D>& snapshot_;
  std::vector<Cell> cells_;
  std::vector<double> volume_up_to_;
  std::vector<Piece<D>> pieces_;  // of one cell
  double wall_distance_ = 0;
};

/// A direction, uniformly distributed.
template <int D>
Vector<D> direction(Random& random) {
  constexpr double least = 0.01;  // so that rounding does not matter
  for (;;) {
    Vector<D> v;
    for (double& x : v) x = random.real(-1, 1);
    const double squared = dot(v, v);
    if (squared <= 1 && squared >= least) return normalized(v);
  }
}

}  // namespace

template <int D>
Edge_cells count_edge_cells(const Snapshot<D>& snapshot, const Edge_cells_options& options) {
  if (!(options.length >= 0 && std::isfinite(options.length)))
    throw Error(Error_code::usage, "the length of edges must be a finite number of at least 0");
  Free_space<D> space(snapshot);
  Edge_cells result;
  result.wall_distance = space.wall_distance();
  result.length = options.length > 0 ? options.length : part_of_wall_distance * result.wall_distance;
  if (result.wall_distance == 0) return result;
  Random random(options.seed);
  Walk_counts counts;
  double sum = 0, squares = 0;  // exact, as sums of small integers
  for (std::size_t i = 0; i < most_tries * options.edges && result.edges < options.edges; ++i) {
    const auto particle = space.particle(random, counts);
    if (!particle) continue;
    const Point<D> end = particle->position + result.length * direction<D>(random);
    const auto walked = walk(snapshot, *particle, end, counts, Free_space<D>::without_contacts);
    if (walked.status != Walk_status::arrived) {
      ++result.blocked;
      continue;
    }
    ++result.edges;
    sum += walked.cells;
    squares += static_cast<double>(walked.cells) * walked.cells;
  }
  if (result.edges == 0) return result;
  const auto n = static_cast<double>(result.edges);
  result.cells = sum / n;
  result.standard_error = std::sqrt(std::max(0.0, squares / n - result.cells * result.cells) / n);
  return result;
}

template Edge_cells count_edge_cells(const Snapshot<2>&, const Edge_cells_options&);
template Edge_cells count_edge_cells(const Snapshot<3>&, const Edge_cells_options&);

}  // namespace cellwalk
