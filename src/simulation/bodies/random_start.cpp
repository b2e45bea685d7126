// SPDX-License-Identifier: LGPL-3.0-or-later
// Points drawn in the boxes of free cells until one lies in its cell, and unit vectors.
#include "random_start.h"

#include <cellwalk/internal/kernel/box.h>
#include <cellwalk/walk/locate.h>

#include <algorithm>

namespace cellwalk::detail {
namespace {

template <int D>
Box<D> box_of(const Snapshot<D>& snapshot, Cell c) {
  const Cell_view<D> view = snapshot.view(c);
  Box<D> box;
  for (std::size_t i = 0; i < view.vertex_count(); ++i) box.extend(view.point(i));
  return box;
}

}  // namespace

template <int D>
Free_space<D>::Free_space(const Snapshot<D>& snapshot) : snapshot_(snapshot) {
  for (std::uint32_t i = 0; i < snapshot.cell_slots(); ++i) {
    const Cell c = snapshot.cell(i);
    if (c == Cell::none || snapshot.is_solid(c)) continue;
    const Box<D> box = box_of(snapshot, c);
    double volume = 1;
    for (std::size_t d = 0; d < D; ++d) volume *= box.high[d] - box.low[d];
    cells_.push_back(i);
    sum_.push_back((sum_.empty() ? 0 : sum_.back()) + volume);
  }
}

template <int D>
typename Free_space<D>::Place Free_space<D>::draw(Random& random) const {
  for (;;) {
    const double drawn = random.real(0, sum_.back());
    const auto at =
        static_cast<std::size_t>(std::upper_bound(sum_.begin(), sum_.end(), drawn) - sum_.begin());
    const Cell c = snapshot_.cell(cells_[std::min(at, cells_.size() - 1)]);
    const Box<D> box = box_of(snapshot_, c);
    Point<D> p;
    for (std::size_t d = 0; d < D; ++d) p[d] = random.real(box.low[d], box.high[d]);
    if (in_closure(snapshot_, c, p)) return {p, c};
  }
}

template <int D>
Vector<D> random_direction(Random& random) {
  for (;;) {
    Vector<D> v;
    for (double& x : v) x = random.real(-1, 1);
    const double l = length(v);
    if (l > 0.01 && l <= 1) return (1 / l) * v;
  }
}

template class Free_space<2>;
template class Free_space<3>;
template Vector<2> random_direction<2>(Random&);
template Vector<3> random_direction<3>(Random&);

}  // namespace cellwalk::detail
