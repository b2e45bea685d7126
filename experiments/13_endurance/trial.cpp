// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trial.h"

#include <algorithm>

namespace cellwalk::endurance {

std::vector<Population> populations() {
  std::vector<Population> all;
  for (const int dimension : {2, 3})
    for (const Cut cut : {Cut::cubes, Cut::simplices})
      for (const Grid grid : {Grid::coarse, Grid::mixed, Grid::fine}) all.push_back({dimension, cut, grid});
  return all;
}

template <int D>
Site<D> Sites<D>::begin(Draw& draw) {
  const bool is_coarse = grid_ == Grid::coarse || (grid_ == Grid::mixed && draw.whole(2) == 0);
  step_ = is_coarse ? unit() >> draw.whole(3) : 1;
  Site<D> x;
  for (std::size_t i = 0; i < D; ++i)
    x[i] = step_ * draw.whole(Whole{0}, (Whole{lattice_.size()[i]} << bits_) / step_);
  return x;
}

/// \pre `from` is a multiple of the step
template <int D>
Site<D> Sites<D>::near(const Site<D>& from, Whole step, Draw& draw) const {
  constexpr std::array<Whole, 8> halves{1, 1, 1, 1, 2, 2, 2, 5};
  const Whole reach = std::max(Whole{1}, halves[draw.whole(8)] * unit() / 2 / step);
  Site<D> x;
  for (std::size_t i = 0; i < D; ++i) x[i] = from[i] + step * draw.whole(-reach, reach);
  return x;
}

template <int D>
Site<D> Sites<D>::coarse_near(const Site<D>& from, Draw& draw) const {
  const Whole step = unit() >> draw.whole(3);
  Site<D> on;
  for (std::size_t i = 0; i < D; ++i) on[i] = from[i] / step * step;
  return near(on, step, draw);
}

template <int D>
Site<D> Sites<D>::degenerate_near(const Site<D>& from, Draw& draw) const {
  Site<D> x = near(from, 1, draw);
  const std::size_t i = draw.whole(D);
  switch (draw.whole(5)) {
    case 0:  // to a point of the coarse grid
      return coarse_near(from, draw);
    case 1: {  // through it
      const Site<D> through = coarse_near(from, draw);
      for (std::size_t k = 0; k < D; ++k) x[k] = 2 * through[k] - from[k];
      return x;
    }
    case 2:  // in a plane, or a line, parallel to facets
      x[i] = from[i];
      return x;
    case 3: {  // along an axis or a diagonal
      const Whole way = x[i] - from[i];
      for (std::size_t k = 0; k < D; ++k)
        if (k != i) x[k] = from[k] + way * draw.whole(Whole{-1}, Whole{1});
      return x;
    }
    default: {  // to a facet
      const Site<D> on = coarse_near(from, draw);
      x[i] = on[i];
      return x;
    }
  }
}

template <int D>
Site<D> Sites<D>::next(const Site<D>& from, Draw& draw) {
  if (grid_ == Grid::mixed) return draw.whole(4) == 0 ? near(from, 1, draw) : degenerate_near(from, draw);
  Site<D> x = near(from, step_, draw);
  if (grid_ == Grid::coarse && draw.whole(2) == 0) {  // in a plane of facets, if it begins there
    const std::size_t i = draw.whole(D);
    x[i] = from[i];
  }
  return x;
}

template <int D>
Lattice<D> random_lattice(Cut cut, Walls walls, Draw& draw) {
  for (;;) {
    Lattice<D> lattice(random_size<D>(draw), cut);
    add_random_walls(lattice, walls, draw);
    if (walls == Walls::solid) link_free_cells(lattice);
    for (std::uint32_t c = 0; c < lattice.cell_count(); ++c)
      if (!lattice.is_solid(c)) return lattice;
  }
}

template class Sites<2>;
template class Sites<3>;
template Lattice<2> random_lattice(Cut, Walls, Draw&);
template Lattice<3> random_lattice(Cut, Walls, Draw&);

}  // namespace cellwalk::endurance
