// SPDX-License-Identifier: LGPL-3.0-or-later
// The walls found by one flood, of which the first to come near is the contact.
#include <cellwalk/internal/edge/thick_sweep.h>
#include <cellwalk/internal/kernel/distance.h>
#include <cellwalk/internal/kernel/predicates.h>
#include <cellwalk/kernel/error.h>

#include <algorithm>

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

/// The feature of a wall that a contact names.
template <int D>
void set_feature(Contact<D>& contact, Half_facet wall, const Feature& of_wall) {
  contact.facet = wall;
  contact.kind = of_wall.size == D   ? Contact_kind::facet
                 : of_wall.size == 1 ? Contact_kind::vertex
                                     : Contact_kind::edge;
  contact.corner = contact.kind == Contact_kind::facet ? std::uint16_t{0} : of_wall.corners[0];
}

/// Points that are nearer to each other, in proportion, may be the same.
constexpr double rounding = 0x1p-40;

template <int D>
class Thick_sweep {
 public:
  Thick_sweep(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion)
      : snapshot_(snapshot), start_(start), motion_(motion) {
    before_.push_back(motion.p);
    if (motion.q) before_.push_back(*motion.q);
    swept_ = before_;
    swept_.push_back(motion.target);
  }

  Thick_result<D> run(Edge_counts& counts) {
    ++counts.floods;
    Cell_list cells;
    Near_walls<D>(snapshot_, in<D>(swept_), motion_.radius).visit(start_, cells, [&](Half_facet wall) {
      ++counts.search_walls;
      look_at(wall);
    });
    counts.flooded_cells += cells.size();
    if (close_) return {close_, true};
    return {first_, false};
  }

 private:
  void look_at(Half_facet wall) {
    const Points<D> corners = corners_of(snapshot_, wall);
    if (close_ && distance_bound<D>(in<D>(before_), in<D>(corners)) > close_->distance) return;
    if (is_far(swept_, corners)) return;
    if (!is_far(before_, corners))
      keep_nearest(wall, corners);
    else if (!close_)
      keep_first(wall, corners);
  }

  bool is_far(const Points<D>& hull, const Points<D>& corners) {
    Feature_pair near;
    return is_apart<D>(in<D>(hull), in<D>(corners), motion_.radius, near, distance_counts_);
  }

  void keep_nearest(Half_facet wall, const Points<D>& corners) {
    Contact<D> contact;
    contact.distance = distance_rounded_down<D>(in<D>(before_), in<D>(corners));
    if (close_ && (close_->distance < contact.distance ||
                   (close_->distance == contact.distance && close_->facet <= wall)))
      return;
    Nearest<D> nearest = nearest_in_doubles<D>(in<D>(before_), in<D>(corners));
    if constexpr (D == 3)
      if (contact.distance == 0 && motion_.q) nearest = pierced(nearest, corners);
    contact.point = nearest.on_b;
    contact.body = nearest.features.a.size == 2 ? Body_feature::edge : Body_feature::vertex;
    contact.cell = start_;
    set_feature(contact, wall, nearest.features.b);
    close_ = contact;
  }

  /// The point in which the edge pierces a facet, none of whose features need be near.
  Nearest<3> pierced(const Nearest<3>& nearest, const Points<3>& corners) const {
    const Point<3>&p = before_[0], &q = before_[1];
    const double apart = length(nearest.on_b - nearest.on_a);
    if (apart <= rounding * (length(q - p) + length(nearest.on_b - p))) return nearest;
    const Vector<3> n = unit_normal(corners[0], corners[1], corners[2]);
    const double of_p = dot(n, p - corners[0]), of_q = dot(n, q - corners[0]);
    if (!(of_p * of_q < 0)) return nearest;
    const Point<3> x = point_on<3>(p, q, of_p / (of_p - of_q));
    return {{{{0, 1, 0}, 2}, {{0, 1, 2}, 3}}, x, x};
  }

  void keep_first(Half_facet wall, const Points<D>& corners) {
    if (first_ && is_later<D>(motion_, in<D>(corners), first_->time)) return;
    const Near_time near = find_near_time<D>(motion_, in<D>(corners));
    Contact<D> contact;
    contact.set_time(to_time(near.root));
    if (first_ && first_->time < contact.time) return;
    const Near_place<D> place = find_near_place<D>(motion_, in<D>(corners), near, contact.time);
    contact.point = place.on_wall;
    contact.normal = place.normal;
    contact.body = near.of_motion.size == 2 ? Body_feature::edge : Body_feature::vertex;
    contact.cell = start_;
    set_feature(contact, wall, near.of_wall);
    if (!first_ || is_before(contact, *first_)) first_ = contact;
  }

  const Snapshot<D>& snapshot_;
  Cell start_;
  const Thick_motion<D>& motion_;
  Points<D> before_, swept_;
  std::optional<Contact<D>> close_, first_;
  Distance_counts distance_counts_;
};

}  // namespace

template <int D>
Thick_result<D> sweep_thick(const Snapshot<D>& snapshot, Cell start, const Thick_motion<D>& motion,
                            Edge_counts& counts) {
  return Thick_sweep<D>(snapshot, start, motion).run(counts);
}

void check_thick_sweep(const Sweep_options& options) {
  const auto refuse = [](const char* reason) { throw Error(Error_code::usage, reason); };
  if (options.touch == Touch::stop) refuse("touch stop: not for motions with a radius, which touch no wall");
  if (options.sweep == Sweep::three_segments)
    refuse("sweep three_segments: not for edges with a radius; take triangle");
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

template Thick_result<2> sweep_thick<2>(const Snapshot<2>&, Cell, const Thick_motion<2>&, Edge_counts&);
template Thick_result<3> sweep_thick<3>(const Snapshot<3>&, Cell, const Thick_motion<3>&, Edge_counts&);

}  // namespace cellwalk::detail
