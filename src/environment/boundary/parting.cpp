// SPDX-License-Identifier: LGPL-3.0-or-later
// The search for planes between two facets, and the radius that each of them proves.
#include <cellwalk/internal/environment/parting.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cellwalk::detail {
namespace {

constexpr double not_parted = -1;

/// Of the room between two facets each takes less than half,
constexpr double fair_share = 0.49;
/// and of the room that the zones of others leave, a little less than all.
constexpr double safe_share = 0.98;
/// The numbers of directions that are tried for one facet, or for all at a vertex, as long as they leave less
/// than this share of the requested radius.
constexpr int tries_one = 12, tries_many = 3;
constexpr double poor_share = 0.5;
/// The error of a rounded distance, relative to the largest coordinate: sums and products of a dozen terms,
/// and directions that are unit vectors within 2^-50, with a margin of 2^7.
constexpr double distance_error = 0x1p-40;
/// Magnitudes of coordinates beyond which products may overflow or lose digits.
constexpr double smallest_size = 1e-100, largest_size = 1e100;
/// The same for squares of directions.
constexpr double smallest_square = 1e-220, largest_square = 1e220;

/// A corner relative to the end of the vertex that moves.
template <int D>
struct Corner {
  Vector<D> at{};
  double radius = 0;
};

/// Two sets of corners, of which the first, `low`, has the vertex that moves. Corners in common come first,
/// in the same order; the vertex that moves is in the origin, and starts at `start`.
template <int D>
class Parted_sets {
 public:
  static constexpr std::size_t size = static_cast<std::size_t>(D);
  using Corners = std::span<const Zoned_corner<D>>;

  Parted_sets(Corners low, Corners high, const Zoned_move<D>& move);

  double radius(double enough, bool is_one_facet);

 private:
  void try_direction(const Vector<D>& direction);
  double radius_along(const Vector<D>& d) const;
  double radius_across_edge() const requires(D == 3);
  using Places = std::array<Vector<D>, most_corners>;
  void try_planes(const Vector<D>& upwards, const Places& low, const Places& high);
  double altitude(const Vector<D>& n, const Vector<D>& p, const Vector<D>& q, const Vector<D>& x) const
      requires(D == 3);

  std::array<Corner<D>, most_corners> low_;
  std::array<Corner<D>, size> high_;
  std::size_t low_size_, common_ = 0;
  std::size_t mover_ = 0;  ///< its place in low_; in high_ too, if it is common
  Vector<D> start_{};
  double error_ = 0;
  bool is_in_range_ = false;
  double best_ = not_parted;
};

template <int D>
Parted_sets<D>::Parted_sets(Corners low, Corners high, const Zoned_move<D>& move)
    : low_size_(low.size()), start_(move.from - move.to) {
  double largest = 0;
  const auto corner = [&](const Zoned_corner<D>& given) {
    Corner<D> result;
    if (given.name == move.vertex) return result;
    result = {given.zone.centre - move.to, given.zone.radius};
    double sum = result.radius;
    for (const double x : result.at) sum += std::abs(x);
    largest = std::max(largest, sum);
    return result;
  };
  std::array<bool, size> is_common{};
  std::size_t own = low_size_;
  for (const Zoned_corner<D>& c : low) {
    std::size_t j = 0;
    while (j < size && c.name != high[j].name) ++j;
    const std::size_t place = j == size ? --own : common_++;
    low_[place] = corner(c);
    if (c.name == move.vertex) mover_ = place;
    if (j == size) continue;
    is_common[j] = true;
    high_[place] = low_[place];
  }
  for (std::size_t j = 0, next = common_; j < size; ++j)
    if (!is_common[j]) high_[next++] = corner(high[j]);
  double sum = 0;
  for (const double x : start_) sum += std::abs(x);
  largest = std::max(largest, sum);
  error_ = distance_error * largest;
  is_in_range_ = largest > smallest_size && largest < largest_size;
}

/// The radius that a plane across a direction proves, which all lower corners that are not common lie below,
/// and the upper ones above. It goes through a common corner, if there is one.
/// \pre the direction has unit length
template <int D>
double Parted_sets<D>::radius_along(const Vector<D>& d) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const bool is_hinge_moving = common_ == 1 && mover_ == 0;
  // Highest and lowest places of corners that do not move, with their zones and without.
  double top = -infinity, bottom = infinity, top_centre = -infinity, bottom_centre = infinity;
  for (std::size_t k = common_; k < low_size_; ++k) {
    if (k == mover_) continue;
    const double h = dot(d, low_[k].at);
    top = std::max(top, h + low_[k].radius);
    top_centre = std::max(top_centre, h);
  }
  for (std::size_t k = common_; k < size; ++k) {
    const double h = dot(d, high_[k].at);
    bottom = std::min(bottom, h - high_[k].radius);
    bottom_centre = std::min(bottom_centre, h);
  }
  const double start = dot(d, start_);
  double room = 0, fair = 0;
  if (is_hinge_moving) {
    // It lies between them all the way.
    if (!(top < start - error_ && bottom > start + error_)) return not_parted;
    room = std::min(bottom, -top) - error_;
    fair = std::min(bottom_centre, -top_centre);
  } else {
    if (common_ == 1) {
      const double hinge = dot(d, low_[0].at);
      if (!(bottom - low_[0].radius > hinge + error_)) return not_parted;
      bottom_centre = hinge;
      bottom = hinge - low_[0].radius;
    }
    if (!(std::max(top, start) < bottom - error_)) return not_parted;
    room = bottom - error_;
    fair = bottom_centre;
  }
  return room > 0 ? std::min(safe_share * room, fair_share * fair) : not_parted;
}

template <int D>
void Parted_sets<D>::try_direction(const Vector<D>& direction) {
  const double square = dot(direction, direction);
  if (!(square > smallest_square && square < largest_square)) return;
  best_ = std::max(best_, radius_along((1 / std::sqrt(square)) * direction));
}

/// The least altitude of a triangle seen along n, negative if it turns the other way; 0 if that is not known.
/// \pre n has unit length
template <int D>
double Parted_sets<D>::altitude(const Vector<D>& n, const Vector<D>& p, const Vector<D>& q,
                                const Vector<D>& x) const requires(D == 3) {
  const Vector<3> pq = q - p, px = x - p, qx = x - q;
  const double longest = std::max({dot(pq, pq), dot(px, px), dot(qx, qx)});
  return longest > smallest_square ? dot(n, cross(pq, px)) / std::sqrt(longest) : 0;
}

/// An edge in common: a plane through it is searched, such that all other lower corners lie on one side, and
/// the upper one on the other.
template <int D>
double Parted_sets<D>::radius_across_edge() const requires(D == 3) {
  const Vector<3>&p = low_[0].at, &q = low_[1].at, &y = high_[2].at;
  const Vector<3> edge = q - p;
  const double square = dot(edge, edge);
  if (!(square > smallest_square && square < largest_square)) return not_parted;
  const auto beside = [&](const Vector<3>& z) {
    const Vector<3> w = (z - p) - (dot(z - p, edge) / square) * edge;
    return normalized(w, Vector<3>{});
  };
  Vector<3> low_side{};
  for (std::size_t k = 2; k < low_size_; ++k) low_side = low_side + beside(low_[k].at);
  const Vector<3> n = normalized(cross(edge, normalized(low_side, Vector<3>{}) - beside(y)), Vector<3>{});
  const bool is_edge_moving = mover_ < 2;
  const auto at_start = [&](std::size_t k) { return k == mover_ ? start_ : low_[k].at; };
  const Vector<3> p0 = at_start(0), q0 = at_start(1);
  double of_edge = 0;  // zones of corners that do not move
  for (std::size_t k = 0; k < 2; ++k)
    if (k != mover_) of_edge = std::max(of_edge, low_[k].radius);
  double least = std::numeric_limits<double>::infinity();
  const auto is_beside = [&](double sense, const Vector<3>& x, const Vector<3>& x0, double radius,
                             bool moves) {
    const double least_altitude = 2 * std::max(of_edge, radius) + error_;
    const double now = sense * altitude(n, p, q, x);
    if (moves) least = std::min(least, now);
    return now > least_altitude && (!moves || sense * altitude(n, p0, q0, x0) > least_altitude);
  };
  for (std::size_t k = 2; k < low_size_; ++k)
    if (!is_beside(1, low_[k].at, at_start(k), low_[k].radius, is_edge_moving || k == mover_))
      return not_parted;
  if (!is_beside(-1, y, y, high_[2].radius, is_edge_moving)) return not_parted;
  return std::max(0.0, fair_share * (least - error_));
}

/// Tries directions across planes that touch both facets: those of one of them, or through an edge of each.
/// About a common corner, those that are as far from three of the directions.
template <int D>
void Parted_sets<D>::try_planes(const Vector<D>& upwards, const Places& low, const Places& high) {
  const auto try_upwards = [&](const Vector<D>& n) {
    if (best_ < 0) try_direction((dot(n, upwards) < 0 ? -1.0 : 1.0) * n);
  };
  const auto edge = [](const Places& facet, std::size_t k) { return facet[(k + 1) % size] - facet[k]; };
  if constexpr (D == 2) {
    for (const Places& facet : {low, high})
      if (const Vector<2> along = edge(facet, 0); common_ == 0) try_upwards({-along[1], along[0]});
  } else if (common_ == 1) {
    const std::array<Vector<3>, 4> u{-1.0 * low[1], -1.0 * low[2], high[1], high[2]};
    for (std::size_t k = 0; k < 4; ++k) try_upwards(cross(u[(k + 1) % 4] - u[k], u[(k + 2) % 4] - u[k]));
  } else {
    for (const Places& facet : {low, high}) try_upwards(cross(edge(facet, 0), edge(facet, 1)));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) try_upwards(cross(edge(low, i), edge(high, j)));
  }
}

template <int D>
double Parted_sets<D>::radius(double enough, bool is_one_facet) {
  if (!is_in_range_) return not_parted;
  if constexpr (D == 3)
    if (common_ == 2) return radius_across_edge();
  if (common_ > 1) return not_parted;
  // The direction is that to the point nearest to 0 of the differences of upper and lower points; about a
  // common corner, of their directions and those opposite to the lower ones. It starts with their mean, and
  // goes towards the lowest of them along it.
  Places low, high;
  const auto place = [&](const Corner<D>& c) {
    return common_ == 0 ? c.at : normalized(c.at - low_[0].at, Vector<D>{});
  };
  Vector<D> mean_low{}, mean_high{};
  for (std::size_t k = common_; k < size; ++k) mean_high = mean_high + (high[k] = place(high_[k]));
  for (std::size_t k = common_; k < low_size_; ++k) mean_low = mean_low + (low[k] = place(low_[k]));
  Vector<D> d = (1 / static_cast<double>(size - common_)) * mean_high -
                (1 / static_cast<double>(low_size_ - common_)) * mean_low;
  for (int tries = is_one_facet ? tries_one : tries_many; tries > 0; --tries) {
    try_direction(d);
    if (best_ >= poor_share * enough) break;
    std::size_t top = common_, bottom = common_;
    for (std::size_t k = common_; k < low_size_; ++k)
      if (dot(d, low[k]) > dot(d, low[top])) top = k;
    for (std::size_t k = common_; k < size; ++k)
      if (dot(d, high[k]) < dot(d, high[bottom])) bottom = k;
    const Vector<D> lowest = common_ == 0                               ? high[bottom] - low[top]
                             : dot(d, high[bottom]) < -dot(d, low[top]) ? high[bottom]
                                                                        : -1.0 * low[top];
    const Vector<D> way = lowest - d;
    const double share = -dot(d, way) / dot(way, way);
    if (!(share > 0)) break;
    d = d + std::min(share, 1.0) * way;
  }
  if (best_ < 0 && is_one_facet) try_planes(d, low, high);
  return best_;
}

}  // namespace

template <int D>
bool Zone<D>::contains(const Point<D>& x) const {
  if (x == centre) return true;
  const Vector<D> away = x - centre;
  const double square = dot(away, away);
  return radius > smallest_size && radius < largest_size && square * (1 + distance_error) <= radius * radius;
}

template <int D>
double parting_radius(std::span<const Zoned_corner<D>> low, std::span<const Zoned_corner<D>> high,
                      const Zoned_move<D>& move, double enough, bool is_one_facet) {
  return Parted_sets<D>(low, high, move).radius(enough, is_one_facet);
}

template struct Zone<2>;
template struct Zone<3>;
template double parting_radius<2>(std::span<const Zoned_corner<2>>, std::span<const Zoned_corner<2>>,
                                  const Zoned_move<2>&, double, bool);
template double parting_radius<3>(std::span<const Zoned_corner<3>>, std::span<const Zoned_corner<3>>,
                                  const Zoned_move<3>&, double, bool);

}  // namespace cellwalk::detail
