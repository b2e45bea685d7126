// SPDX-License-Identifier: LGPL-3.0-or-later
// The judge of rows: it cuts the ray by all tetrahedra near it in integers, and looks at nothing else than
// points and corners of cells.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_JUDGE_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_JUDGE_H

#include <cellwalk/walk/trace.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cellwalk::track_lengths {

/// A row of Traces.
struct Row {
  std::span<const Cell> cells;
  std::span<const double> lengths;
  std::span<const Half_facet> crossings;
  Trace_end end;
};
Row row_of(const Traces& traces, std::size_t i);

class Judge {
 public:
  /// \throw std::runtime_error for coordinates that are no multiples of 2^-128 or above 2^12
  explicit Judge(const Snapshot<3>& snapshot);

  /// The fault of a row, or an empty text: each piece lies in its closed cell, begins where the one before
  /// ends, and has the double nearest to its exact length; the first begins at the start; the last ends at
  /// the target if the motion arrives, otherwise on the plane of the wall that blocks it.
  std::string fault(const Point<3>& from, const Point<3>& to, const Row& row) const;

 private:
  using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
      512, 512, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
  using Vector = std::array<Integer, 3>;
  /// A share of the ray: a fraction whose denominator is positive.
  struct Share {
    Integer numerator, denominator;
  };
  /// normal.x - offset > 0 inside the cell, in units of 2^-128.
  struct Plane {
    Vector normal;
    Integer offset;
  };
  struct Visit {
    std::uint32_t cell;
    Share first, last;
  };

  static Integer integer(double x);
  static Vector vector(const Point<3>& p);
  static bool is_less(const Share& a, const Share& b);
  static void add(std::vector<Share>& shares, const Share& share);
  static Integer height(const Plane& plane, const Vector& x);
  static bool is_nearest(double length, const Integer& square, const Share& begin, const Share& end);
  static std::vector<Share> events_of(const std::vector<Visit>& visits);
  bool cut(std::uint32_t cell, const Vector& a, const Vector& b, Visit& visit) const;
  std::vector<Visit> visits(const Point<3>& from, const Point<3>& to) const;
  std::vector<Share> ends(const std::vector<Visit>& visits, const Integer& square, const Row& row) const;

  const Snapshot<3>& snapshot_;
  std::vector<std::array<Plane, 4>> planes_;       // of each cell; plane i is opposite its corner i
  std::array<std::vector<double>, 3> low_, high_;  // boxes of cells
};

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_JUDGE_H
