// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge of answers about motions with a radius: by all walls, in rational arithmetic. Exact times are
// enclosed by comparisons to an interval of 2^-80, at whose ends the definition must say the same.
#ifndef CELLWALK_TESTS_QUERY_THICK_JUDGE_H
#define CELLWALK_TESTS_QUERY_THICK_JUDGE_H

#include <cellwalk/internal/kernel/fraction.h>
#include <cellwalk/query/query.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "edge/thick_oracle.h"

namespace cellwalk::test {

/// What is true of a motion that starts in free space.
template <int D>
struct Thick_truth {
  Fraction start_square;  ///< of the distance to walls before the motion
  bool is_close = false;
  std::vector<const Thick_wall<D>*> blocking;  ///< unless it starts too close

  Motion_status status() const {
    if (is_close) return Motion_status::close;
    return blocking.empty() ? Motion_status::free : Motion_status::contact;
  }
};

template <int D>
class Thick_judge {
 public:
  explicit Thick_judge(const Snapshot<D>& snapshot) : snapshot_(snapshot), oracle_(snapshot) {}

  const Thick_oracle<D>& oracle() const { return oracle_; }

  Thick_truth<D> truth_of(const Thick_motion<D>& motion) const {
    Thick_truth<D> truth;
    truth.start_square = oracle_.square_to_walls(before(motion));
    truth.is_close = !root_is_at_least(truth.start_square, motion.radius);
    if (!truth.is_close) truth.blocking = oracle_.nearer_than(motion.radius, swept(motion));
    return truth;
  }

  /// The fault of an answer; empty if it has none.
  /// \param truth of the motion
  std::string fault_of(const Answer<D>& answer, const Thick_motion<D>& motion,
                       const Thick_truth<D>& truth) const {
    if (answer.status != truth.status())
      return std::string("status ") + motion_status_names[static_cast<int>(answer.status)] + " instead of " +
             motion_status_names[static_cast<int>(truth.status())];
    if (answer.contact.has_value() != (answer.status != Motion_status::free)) return "contact";
    if (answer.status == Motion_status::free)
      return in_closure(snapshot_, answer.cell, motion.target) ? "" : "cell of a free motion";
    const Contact<D>& contact = *answer.contact;
    if (answer.status == Motion_status::close) return fault_of_start(contact, motion, truth);
    if (std::string fault = fault_of_time(contact, motion, truth); !fault.empty()) return fault;
    return fault_of_place(contact, motion);
  }

 private:
  static double to_double(const Fraction& x) { return static_cast<double>(x); }

  std::string fault_of_start(const Contact<D>& contact, const Thick_motion<D>& motion,
                             const Thick_truth<D>& truth) const {
    if (contact.time != 0 || contact.exact_time() != Exact_time()) return "time of a start too close";
    if (contact.distance != root_rounded_down(truth.start_square)) return "distance of a start too close";
    const double tolerance = 1e-9 * size_of(motion, contact.facet);
    const Hull<D> point{to_rational_point(contact.point)};
    const double to_part = root_rounded_down(oracle_.from_part_at(0, motion, point).square);
    if (!(std::abs(to_part - contact.distance) <= tolerance)) return "nearest point too far from what moves";
    if (!is_on_wall(contact, tolerance)) return "nearest point off the wall";
    return "";
  }

  std::string fault_of_time(const Contact<D>& contact, const Thick_motion<D>& motion,
                            const Thick_truth<D>& truth) const {
    const Exact_time time = contact.exact_time();
    const double rounded = contact.time;
    if (!(rounded >= 0 && rounded < 1)) return "time not in [0,1)";
    if (time.rounded() != rounded) return "two rounded times";
    const double next = std::nextafter(rounded, 2.);
    if (time < Exact_time(rounded) || time >= Exact_time(next)) return "rounded time";
    // The bounds are doubles plus shares of the ulp, which is a double as well.
    Fraction low(rounded), high(next);
    Ring ring_low(rounded);
    double width = next - rounded;
    while (width > 0x1p-80) {
      width /= 2;
      const Ring ring_middle(ring_low + Ring(width));
      const Fraction middle = low + Fraction(width);
      if (time < to_time(cellwalk::Fraction(ring_middle, Ring(1)))) {
        high = middle;
      } else {
        low = middle;
        ring_low = ring_middle;
      }
    }
    if (!Thick_oracle<D>::is_free_until(low, motion, truth.blocking)) return "blocked before its time";
    if (Thick_oracle<D>::is_free_until(high, motion, truth.blocking)) return "free after its time";
    return "";
  }

  std::string fault_of_place(const Contact<D>& contact, const Thick_motion<D>& motion) const {
    const Fraction time(contact.time);
    const double size = size_of(motion, contact.facet), r = motion.radius;
    const Hull<D> point{to_rational_point(contact.point)};
    const double to_part = root_rounded_down(oracle_.from_part_at(time, motion, point).square);
    // Feet of nearly parallel edges are off by the root of an ulp. It shows where r is hardly more.
    const double off = 1e-9 * r + (r > 1e-6 * size ? 1e-13 : 1e-7) * size;
    if (!(std::abs(to_part - r) <= off)) return "contact not at r from what moves";
    if (!is_on_wall(contact, 1e-12 * size)) return "contact off its feature of the wall";
    if (contact.body == Body_feature::vertex) {
      const Hull<D> p{at_time(motion.p, motion.target, time)};
      const double to_vertex = root_rounded_down(shortest_vector<D>(p, point).square);
      if (!(std::abs(to_vertex - r) <= 1e-9 * r + 1e-13 * size)) return "contact not at r from the vertex";
    }
    if (!(std::abs(length(contact.normal) - 1) <= 1e-14)) return "normal not of length 1";
    if (dot(contact.normal, motion.target - motion.p) > 1e-9 * length(motion.target - motion.p))
      return "normal along the motion";
    // Shortest vectors of sets that differ by some ulp differ by the root of that.
    const double tolerance = std::max(1e-6, 4 * std::sqrt(1e-16 * size / r));
    if (tolerance > 1e-3) return "";
    const auto z = oracle_.from_part_at(time, motion, hull_of(contact.facet)).vector;
    // The foot on what moves.
    Hull<D> foot = point;
    Vector<D> away;
    for (std::size_t k = 0; k < D; ++k) {
      foot[0][k] -= z[k];
      away[k] = -to_double(z[k] / Fraction(r));
    }
    const double to_foot = root_rounded_down(oracle_.from_part_at(time, motion, foot).square);
    if (!(to_foot <= tolerance * r + 1e-9 * size)) return "contact not where the wall is nearest";
    return length(normalized(away) - contact.normal) <= tolerance ? "" : "normal";
  }

  std::vector<Point<D>> corners_of(Half_facet f) const {
    std::vector<Point<D>> corners;
    for (const std::uint32_t v : snapshot_.loop(f)) corners.push_back(snapshot_.point(v));
    return corners;
  }

  Hull<D> hull_of(Half_facet f) const { return to_hull<D>(corners_of(f)); }

  /// True if the contact's point lies on the feature that it names, of a wall with a free side.
  bool is_on_wall(const Contact<D>& contact, double tolerance) const {
    if (!snapshot_.is_impassable(contact.facet) || snapshot_.is_solid(snapshot_.cell_of(contact.facet)))
      return false;
    std::vector<Point<D>> feature = corners_of(contact.facet);
    const std::size_t n = feature.size(), i = contact.corner;
    if (contact.kind == Contact_kind::vertex) feature = {feature[i]};
    if (contact.kind == Contact_kind::edge) feature = {feature[i], feature[(i + 1) % n]};
    return root_rounded_down(
               shortest_vector<D>({to_rational_point(contact.point)}, to_hull<D>(feature)).square) <=
           tolerance;
  }

  double size_of(const Thick_motion<D>& motion, Half_facet f) const {
    double size = 0;
    std::vector<Point<D>> points = corners_of(f);
    for (const Point<D>& x : swept(motion)) points.push_back(x);
    for (const Point<D>& x : points)
      for (const double c : x) size = std::max(size, std::abs(c));
    return size;
  }

  const Snapshot<D>& snapshot_;
  const Thick_oracle<D> oracle_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_QUERY_THICK_JUDGE_H
