// SPDX-License-Identifier: LGPL-3.0-or-later
// Signs by CGAL's kernels and in double-double numbers, and the walks of the policies of the experiment.
#include "policies.h"

#include <cellwalk/internal/kernel/twofold.h>
#include <cellwalk/walk/walk_impl.h>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Simple_cartesian.h>

#include <array>

namespace cellwalk {
namespace exact_float {
namespace {

using detail::exact_difference;

template <class Kernel, class... P>
int orientation_2(const P&... p) {
  return CGAL::orientation(typename Kernel::Point_2(p[0], p[1])...);
}
template <class Kernel, class... P>
int orientation_3(const P&... p) {
  return CGAL::orientation(typename Kernel::Point_3(p[0], p[1], p[2])...);
}

using Filtered = CGAL::Exact_predicates_inexact_constructions_kernel;
using Rounded = CGAL::Simple_cartesian<double>;

int sign_of(const Twofold& x) { return detail::sign_of(x.high != 0 ? x.high : x.low); }

}  // namespace

int orientation_epick(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  return orientation_2<Filtered>(p, q, r);
}
int orientation_epick(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s) {
  return orientation_3<Filtered>(p, q, r, s);
}
int orientation_cartesian(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  return orientation_2<Rounded>(p, q, r);
}
int orientation_cartesian(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s) {
  return orientation_3<Rounded>(p, q, r, s);
}

int orientation_twofold(const Point<2>& p, const Point<2>& q, const Point<2>& r) {
  const Twofold ax = exact_difference(q[0], p[0]), ay = exact_difference(q[1], p[1]);
  const Twofold bx = exact_difference(r[0], p[0]), by = exact_difference(r[1], p[1]);
  return sign_of(ax * by - ay * bx);
}

int orientation_twofold(const Point<3>& p, const Point<3>& q, const Point<3>& r, const Point<3>& s) {
  std::array<Twofold, 3> a, b, c;
  for (std::size_t i = 0; i < 3; ++i) {
    a[i] = exact_difference(q[i], p[i]);
    b[i] = exact_difference(r[i], p[i]);
    c[i] = exact_difference(s[i], p[i]);
  }
  return sign_of((a[0] * b[1] - a[1] * b[0]) * c[2] + (b[0] * c[1] - b[1] * c[0]) * a[2] +
                 (c[0] * a[1] - c[1] * a[0]) * b[2]);
}

}  // namespace exact_float

#define CELLWALK_INSTANTIATE(KERNEL)                                                               \
  template Walk_result<2> walk<KERNEL, 2>(const Snapshot<2>&, const Particle<2>&, const Point<2>&, \
                                          Walk_counts&, Walk_strategy, const Walk_options&);       \
  template Walk_result<3> walk<KERNEL, 3>(const Snapshot<3>&, const Particle<3>&, const Point<3>&, \
                                          Walk_counts&, Walk_strategy, const Walk_options&);
CELLWALK_INSTANTIATE(exact_float::Epick)
CELLWALK_INSTANTIATE(exact_float::Adaptive)
CELLWALK_INSTANTIATE(exact_float::Cartesian)
CELLWALK_INSTANTIATE(exact_float::Long_double)
CELLWALK_INSTANTIATE(exact_float::Double_double)
#undef CELLWALK_INSTANTIATE

}  // namespace cellwalk
