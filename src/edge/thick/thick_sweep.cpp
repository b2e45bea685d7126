// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls found by one flood, of which the first to come near is the contact.
#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/internal/kernel/distance.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/internal/walk/signs.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <compare>
#include <tuple>
#include <vector>

#include "near_normal.h"
#include "near_time.h"
#include "near_walls.h"

namespace cellwalk::detail {
namespace {

template <int D>
using Points = boost::container::small_vector<Point<D>, 8>;

template <int D>
Points<D> corners_of(const Snapshot<D>& snapshot, Half_facet wall) {
  const Cell_view<D> view = snapshot.view(snapshot.cell_of(wall));
  Points<D> corners;
  for (const std::uint16_t v : view.loop(snapshot.facet_of(wall))) corners.push_back(view.point(v));
  return corners;
}

template <int D>
std::span<const Point<D>> in(const Points<D>& points) {
  return {points.data(), points.size()};
}

/// The order of the corners of a wall that does not depend on where its loop starts, nor on the side: the
/// lowest corner is the second, after the lower of its neighbours. So the first three are not collinear.
template <int D>
class Canonical_order {
 public:
  explicit Canonical_order(const Points<D>& corners) : size_(corners.size()) {
    const auto lowest = static_cast<std::size_t>(std::ranges::min_element(corners) - corners.begin());
    const std::size_t next = (lowest + 1) % size_, last = (lowest + size_ - 1) % size_;
    const bool is_forward = corners[last] < corners[next];
    first_ = is_forward ? last : next;
    step_ = is_forward ? 1 : size_ - 1;
    for (std::size_t i = 0; i < size_; ++i) corners_.push_back(corners[in_loop(i)]);
  }

  std::span<const Point<D>> corners() const { return in<D>(corners_); }
  /// The position of a vertex, or of the edge between two neighbours.
  std::uint16_t in_loop(const Feature& feature) const {
    const std::size_t i = in_loop(feature.corners[0]);
    if (feature.size == 1) return static_cast<std::uint16_t>(i);
    const std::size_t j = in_loop(feature.corners[1]);
    return static_cast<std::uint16_t>((i + 1) % size_ == j ? i : j);
  }

 private:
  std::size_t in_loop(std::size_t i) const { return (first_ + i * step_) % size_; }

  Points<D> corners_;
  std::size_t size_, first_, step_;
};

/// The feature of a wall that a contact names.
template <int D>
void set_feature(Contact<D>& contact, Half_facet wall, const Canonical_order<D>& order,
                 const Feature& of_wall) {
  contact.facet = wall;
  contact.kind = of_wall.size == D   ? Contact_kind::facet
                 : of_wall.size == 1 ? Contact_kind::vertex
                                     : Contact_kind::edge;
  contact.corner = contact.kind == Contact_kind::facet ? std::uint16_t{0} : order.in_loop(of_wall);
}

/// In proportion to the edge, points that are less nearer to each other are not.
constexpr double rounding = 0x1p-40;

template <int D>
class Thick_sweep {
 public:
  Thick_sweep(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion, Swept_part part)
      : snapshot_(snapshot), start_(start), motion_(motion), part_(part) {
    before_.push_back(motion.p);
    for (const auto& corner : {motion.q, motion.third})
      if (corner) before_.push_back(*corner);
  }

  Thick_result<D> run(Edge_counts& counts) {
    ++counts.floods;
    Cell_list cells;
    const Swept_hull<D> swept = swept_hull(motion_, Swept_part::all);
    Near_walls<D>(snapshot_, {swept.data(), swept.size()}, motion_.radius)
        .visit(start_, cells, [&](Half_facet wall) {
          ++counts.search_walls;
          look_at(wall);
        });
    counts.flooded_cells += cells.size();
    if (close_) return {close_, true};
    find_first();
    return {first_, false};
  }

  /// The first contact with these walls, if a flood finds the same.
  std::optional<Contact<D>> run_on(std::span<const Half_facet> walls) {
    for (const Half_facet wall : walls) {
      const Points<D> corners = corners_of(snapshot_, wall);
      if (is_any_near(corners)) keep_blocking(wall, corners);
    }
    find_first();
    if (first_ && first_->kind != Contact_kind::facet && !are_linked(tied_)) return {};
    return first_;
  }

 private:
  struct Blocking_wall {
    Half_facet wall;
    Canonical_order<D> order;
    double about_when;
  };

  void look_at(Half_facet wall) {
    const Points<D> corners = corners_of(snapshot_, wall);
    if (close_ && distance_bound<D>(in<D>(before_), in<D>(corners)) > close_->distance) return;
    if (is_far(swept_hull(motion_, Swept_part::all), corners)) return;
    if (!is_far(before_, corners))
      keep_nearest(wall, corners);
    else if (!close_ && is_any_near(corners))
      keep_blocking(wall, corners);
  }

  void keep_blocking(Half_facet wall, const Points<D>& corners) {
    const Canonical_order<D> order(corners);
    blocking_.push_back({wall, order, approximate_near_time<D>(motion_, order.corners())});
  }

  bool is_far(const auto& hull, const Points<D>& corners) {
    Vector<D> direction{};
    return is_apart<D>({hull.data(), hull.size()}, in<D>(corners), motion_.radius, direction,
                       distance_counts_);
  }

  /// True if a wall is near something that has to keep the distance.
  bool is_any_near(const Points<D>& corners) {
    if (part_ != Swept_part::segments) return !is_far(swept_hull(motion_, part_), corners);
    return !is_far(swept_hull(motion_, Swept_part::way), corners) ||
           !is_far(swept_hull(motion_, Swept_part::end), corners);
  }

  void keep_nearest(Half_facet wall, const Points<D>& corners) {
    Contact<D> contact;
    contact.distance = distance_rounded_down<D>(in<D>(before_), in<D>(corners));
    if (close_ && (close_->distance < contact.distance ||
                   (close_->distance == contact.distance && close_->facet <= wall)))
      return;
    const Canonical_order<D> order(corners);
    Nearest<D> nearest = nearest_in_doubles<D>(in<D>(before_), order.corners());
    if constexpr (D == 3)
      if (contact.distance == 0) nearest = where_pierced(nearest, order.corners());
    contact.point = nearest.on_b;
    contact.body = body_feature(nearest.features.a);
    contact.cell = start_;
    set_feature(contact, wall, order, nearest.features.b);
    close_ = contact;
  }

  /// The point in which an edge of one pierces the other, if none of their features are near each other.
  Nearest<3> where_pierced(Nearest<3> best, std::span<const Point<3>> wall) const {
    const auto gap = [](const Nearest<3>& pair) { return length(pair.on_b - pair.on_a); };
    const auto try_edges = [&](std::span<const Point<3>> edges, std::span<const Point<3>> facet,
                               bool are_of_wall) {
      for (std::size_t i = 0; facet.size() > 2 && i < edges.size(); ++i) {
        const Point<3>&p = edges[i], &q = edges[(i + 1) % edges.size()];
        const Vector<3> n = unit_normal(facet[0], facet[1], facet[2]);
        const double of_p = dot(n, p - facet[0]), of_q = dot(n, q - facet[0]);
        if (!(of_p * of_q < 0)) continue;
        const Points<3> x{point_on<3>(p, q, of_p / (of_p - of_q))};
        Nearest<3> found = nearest_in_doubles<3>(in<3>(x), facet);
        if (!(gap(found) + rounding * length(q - p) < gap(best))) continue;
        found.features.a = are_of_wall ? facet_feature(0, 1, 2) : edge_feature(i, (i + 1) % edges.size());
        found.features.b = are_of_wall ? edge_feature(i, (i + 1) % edges.size()) : facet_feature(0, 1, 2);
        found.on_a = found.on_b = x[0];
        best = found;
      }
    };
    try_edges(in<3>(before_), wall, false);
    try_edges(wall, in<3>(before_), true);
    return best;
  }

  /// A side of a face that stands still is met by the face.
  Body_feature body_feature(const Feature& of_motion) const {
    if (motion_.third && of_motion.corners[0] != 0) return Body_feature::face;
    return static_cast<Body_feature>(of_motion.size - 1);
  }

  void find_first() {
    // What is met first excludes most others.
    std::ranges::sort(blocking_, {}, &Blocking_wall::about_when);
    for (const Blocking_wall& blocking : blocking_) keep_first(blocking);
  }

  void keep_first(const Blocking_wall& blocking) {
    const auto& [wall, order, about_when] = blocking;
    if (first_ && is_later<D>(motion_, order.corners(), first_->time)) return;
    const Near_time near = find_near_time<D>(motion_, order.corners(), about_when);
    // The interior of a wall is met from the side where the vertex has been all the time.
    if (near.of_wall.size == D && !has_inside(wall, motion_.p)) return;
    Contact<D> contact;
    contact.set_time(to_time(near.root));
    if (first_ && first_->time < contact.time) return;
    const Near_place<D> place = find_near_place<D>(motion_, order.corners(), near, contact.time);
    contact.point = place.on_wall;
    contact.normal = place.normal;
    contact.body = body_feature(near.of_motion);
    contact.cell = start_;
    set_feature(contact, wall, order, near.of_wall);
    const auto by_time = first_ ? contact.exact_time() <=> first_->exact_time() : std::strong_ordering::less;
    if (by_time > 0) return;
    if (by_time < 0) tied_.clear();
    tied_.push_back(contact);
    if (by_time < 0 || is_before(contact, *first_)) first_ = contact;
  }

  /// The vertex or the two ends of the edge of a wall that is met.
  Points<D> feature_of(const Contact<D>& contact) const {
    const Points<D> loop = corners_of(snapshot_, contact.facet);
    Points<D> feature{loop[contact.corner]};
    if (contact.kind == Contact_kind::edge) feature.push_back(loop[(contact.corner + 1) % loop.size()]);
    std::ranges::sort(feature);
    return feature;
  }

  /// True if all contacts are with one vertex or edge, round which their walls are linked: then any flood
  /// that finds one of them finds all, and it finds one.
  bool are_linked(std::span<const Contact<D>> contacts) const {
    const Points<D> feature = feature_of(contacts[0]);
    for (const Contact<D>& other : contacts)
      if (other.kind != contacts[0].kind || feature_of(other) != feature) return false;
    std::size_t found = 0;
    Cell_list cells;
    cells.assign(snapshot_.cell_of(contacts[0].facet));
    for (std::size_t next = 0; next < cells.size(); ++next) {
      const Cell cell = cells[next];
      for (std::size_t i = 0; i < snapshot_.view(cell).facet_count(); ++i) {
        const Half_facet half = Snapshot<D>::half_facet(cell, i);
        const Points<D> corners = corners_of(snapshot_, half);
        const auto is_corner = [&](const Point<D>& x) {
          return std::ranges::find(corners, x) != corners.end();
        };
        if (!std::ranges::all_of(feature, is_corner)) continue;
        if (snapshot_.is_impassable(half))
          found += static_cast<std::size_t>(std::ranges::count(contacts, half, &Contact<D>::facet));
        else if (const Cell behind = snapshot_.neighbour(half); !cells.contains(behind))
          cells.add(behind);
      }
    }
    return found == contacts.size();
  }

  /// True if a point off the plane of a facet is on the side of the cell.
  bool has_inside(Half_facet wall, const Point<D>& x) const {
    Walk_counts uncounted;
    return side<Exact>(snapshot_.view(snapshot_.cell_of(wall)), snapshot_.facet_of(wall), x, uncounted) < 0;
  }

  const Snapshot<D>& snapshot_;
  Cell start_;
  const Thick_motion<D>& motion_;
  Swept_part part_;
  Points<D> before_;
  std::vector<Blocking_wall> blocking_;
  std::optional<Contact<D>> close_, first_;
  std::vector<Contact<D>> tied_;  ///< at the time of the first
  Distance_counts distance_counts_;
};

}  // namespace

template <int D>
Thick_result<D> sweep_thick(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion,
                            Edge_counts& counts, Swept_part part) {
  return Thick_sweep<D>(snapshot, start, motion, part).run(counts);
}

template <int D>
std::optional<Contact<D>> contact_without_flood(const Snapshot<D>& snapshot, Cell start,
                                                const Thick_motion<D>& motion,
                                                std::span<const Half_facet> walls, Swept_part part) {
  return Thick_sweep<D>(snapshot, start, motion, part).run_on(walls);
}

void check_thick_sweep(const Sweep_options& options) {
  const auto refuse = [](const char* reason) { throw Error(Error_code::usage, reason); };
  if (options.touch == Touch::stop) refuse("touch stop: not for motions with a radius, which touch no wall");
  if (options.search) refuse("the searches of the paper: not for edges with a radius, whose times are exact");
}

template <int D>
double clearance(const Snapshot<D>& snapshot, Cell start, const Point<D>& p, const Point<D>& q,
                 double up_to) {
  const Points<D> edge{p, q};
  Cell_list cells;
  double least = up_to;
  Near_walls<D>(snapshot, in<D>(edge), up_to).visit(start, cells, [&](Half_facet wall) {
    const Points<D> corners = corners_of(snapshot, wall);
    least = std::min(least, distance_bound<D>(in<D>(edge), in<D>(corners)));
  });
  return least;
}

template double clearance<2>(const Snapshot<2>&, Cell, const Point<2>&, const Point<2>&, double);
template double clearance<3>(const Snapshot<3>&, Cell, const Point<3>&, const Point<3>&, double);

template std::optional<Contact<2>> contact_without_flood(const Snapshot<2>&, Cell, const Thick_motion<2>&,
                                                         std::span<const Half_facet>, Swept_part);
template std::optional<Contact<3>> contact_without_flood(const Snapshot<3>&, Cell, const Thick_motion<3>&,
                                                         std::span<const Half_facet>, Swept_part);

template Thick_result<2> sweep_thick<2>(const Snapshot<2>&, Cell, const Thick_motion<2>&, Edge_counts&,
                                        Swept_part);
template Thick_result<3> sweep_thick<3>(const Snapshot<3>&, Cell, const Thick_motion<3>&, Edge_counts&,
                                        Swept_part);

}  // namespace cellwalk::detail
