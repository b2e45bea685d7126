// SPDX-License-Identifier: LGPL-3.0-or-later
#include "environment/nonconforming.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace cellwalk::test {
namespace {

template <int D>
using Lattice_place = std::array<int, static_cast<std::size_t>(D)>;
using Below = std::function<std::size_t(std::size_t)>;

/// The extent of all layers in each direction; a multiple of 4, for two rounds of halving.
constexpr int extent = 8;
constexpr int thickness = 4;

/// How a box is divided: into one cell, into simplices, or into cells between.
enum class Division { whole, simplices, other_simplices, prisms, pyramids };

template <int D>
class Maker {
 public:
  Maker(const Layers_options& options, const Below& below) : options_(options), below_(below) {}

  Cell_soup<D> make();

 private:
  using Cuts = std::vector<int>;

  Cuts cuts(int layer);
  void add_box(const Lattice_place<D>& low, const Lattice_place<D>& high, Division division);
  void add_cells(const std::array<std::uint32_t, std::size_t{1} << D>& v, Division division);
  std::uint32_t point(const Lattice_place<D>& place);
  void insert_points_on_edges();
  void turn();

  const Layers_options& options_;
  const Below& below_;
  Cell_soup<D> soup_;
  std::vector<Lattice_place<D>> places_;  ///< of the points
  std::vector<int> layer_of_;             ///< of the points
  std::map<std::pair<int, Lattice_place<D>>, std::uint32_t> points_;
  int layer_ = 0;
};

template <int D>
typename Maker<D>::Cuts Maker<D>::cuts(int layer) {
  std::set<int> cuts{0, extent};
  if (options_.shifted)
    for (std::size_t n = below_(4); n > 0; --n) cuts.insert(static_cast<int>(1 + below_(extent - 1)));
  else
    cuts.insert(extent / 2);
  if (options_.hanging && layer % 2 == 1) {
    const Cuts coarse(cuts.begin(), cuts.end());
    for (std::size_t i = 1; i < coarse.size(); ++i) cuts.insert((coarse[i - 1] + coarse[i]) / 2);
  }
  return {cuts.begin(), cuts.end()};
}

template <int D>
Cell_soup<D> Maker<D>::make() {
  const auto some_division = [&] { return static_cast<Division>(below_(5)); };
  const int count = 2 + static_cast<int>(below_(2));
  for (layer_ = 0; layer_ < count; ++layer_) {
    const Cuts y = cuts(layer_), z = D == 3 ? cuts(layer_) : Cuts{0, 0};
    // These conform within a layer.
    const Division of_layer =
        options_.by_layer ? (below_(2) != 0 ? Division::whole : Division::simplices) : Division::whole;
    for (std::size_t i = 1; i < y.size(); ++i)
      for (std::size_t j = 1; j < z.size(); ++j) {
        if (options_.incomplete && below_(5) == 0) continue;
        const Division division = options_.cells && !options_.by_layer ? some_division() : of_layer;
        if constexpr (D == 2)
          add_box({layer_ * thickness, y[i - 1]}, {(layer_ + 1) * thickness, y[i]}, division);
        else
          add_box({layer_ * thickness, y[i - 1], z[j - 1]}, {(layer_ + 1) * thickness, y[i], z[j]}, division);
      }
  }
  if (options_.collinear) insert_points_on_edges();
  if (options_.incomplete)
    for (std::uint8_t& solid : soup_.solid) solid = below_(6) == 0;
  turn();
  return std::move(soup_);
}

template <int D>
std::uint32_t Maker<D>::point(const Lattice_place<D>& place) {
  const int layer = options_.gap < 0 ? 0 : layer_;
  const auto [found, is_new] =
      points_.try_emplace({layer, place}, static_cast<std::uint32_t>(places_.size()));
  if (is_new) {
    places_.push_back(place);
    layer_of_.push_back(layer);
  }
  return found->second;
}

template <int D>
void Maker<D>::add_box(const Lattice_place<D>& low, const Lattice_place<D>& high, Division division) {
  std::array<std::uint32_t, std::size_t{1} << D> v;
  for (std::size_t corner = 0; corner < v.size(); ++corner) {
    Lattice_place<D> place;
    for (std::size_t k = 0; k < D; ++k) place[k] = corner >> k & 1 ? high[k] : low[k];
    v[corner] = point(place);
  }
  add_cells(v, division);
}

template <>
void Maker<2>::add_cells(const std::array<std::uint32_t, 4>& v, Division division) {
  const auto polygon = [&](const std::vector<std::uint32_t>& corners) {
    std::vector<std::uint32_t> loop;
    for (const std::uint32_t k : corners) loop.push_back(v[k]);
    add_polygon(soup_, loop);
  };
  switch (division) {
    case Division::simplices:
    case Division::prisms:
      polygon({0, 1, 3});
      polygon({0, 3, 2});
      break;
    case Division::other_simplices:
      polygon({0, 1, 2});
      polygon({1, 3, 2});
      break;
    default:
      polygon({0, 1, 3, 2});
  }
}

template <>
void Maker<3>::add_cells(const std::array<std::uint32_t, 8>& v, Division division) {
  // Kuhn's division, which conforms with that of the next box.
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kuhn{
      {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
  constexpr std::array<std::array<std::uint32_t, 4>, 5> five{
      {{0, 1, 3, 5}, {0, 3, 2, 6}, {0, 5, 6, 4}, {3, 6, 5, 7}, {0, 3, 6, 5}}};
  switch (division) {
    case Division::simplices:
      for (const auto& t : kuhn) add_tetrahedron(soup_, v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
      break;
    case Division::other_simplices:
      for (const auto& t : five) add_tetrahedron(soup_, v[t[0]], v[t[1]], v[t[2]], v[t[3]]);
      break;
    case Division::prisms:
      add_prism(soup_, {v[0], v[1], v[3], v[4], v[5], v[7]});
      add_prism(soup_, {v[0], v[3], v[2], v[4], v[7], v[6]});
      break;
    case Division::pyramids:
      add_pyramid(soup_, {v[1], v[5], v[7], v[3], v[0]});
      add_pyramid(soup_, {v[2], v[3], v[7], v[6], v[0]});
      add_pyramid(soup_, {v[4], v[6], v[7], v[5], v[0]});
      break;
    default:
      add_hexahedron(soup_, {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]});
  }
}

/// Points of the same layer that lie in an edge become vertices of cells of several facets that have it.
template <int D>
void Maker<D>::insert_points_on_edges() {
  const auto lies_within = [&](std::uint32_t x, std::uint32_t a, std::uint32_t b) {
    if (layer_of_[x] != layer_of_[a] || x == a || x == b) return false;
    Lattice_place<D> ab, ax;
    int along = 0, square = 0;
    for (std::size_t k = 0; k < D; ++k) {
      ab[k] = places_[b][k] - places_[a][k];
      ax[k] = places_[x][k] - places_[a][k];
      along += ab[k] * ax[k];
      square += ab[k] * ab[k];
    }
    for (std::size_t k = 0; k < D; ++k)
      if (ax[k] * square != ab[k] * along) return false;
    return 0 < along && along < square;
  };
  const Cell_soup<D> before = std::exchange(soup_, {});
  for (std::size_t c = 0; c < before.cell_count(); ++c) {
    const bool inserts = below_(2) != 0;
    for (std::size_t f = before.cell_begin[c]; f < before.cell_begin[c + 1]; ++f) {
      const auto loop = before.facet(f);
      std::vector<std::uint32_t> longer;
      for (std::size_t i = 0; i < (D == 2 ? 1 : loop.size()); ++i) {
        const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
        std::vector<std::uint32_t> between;
        for (std::uint32_t x = 0; inserts && x < places_.size(); ++x)
          if (lies_within(x, a, b)) between.push_back(x);
        std::sort(between.begin(), between.end(),
                  [&](std::uint32_t x, std::uint32_t y) { return lies_within(x, a, y); });
        longer.push_back(a);
        longer.insert(longer.end(), between.begin(), between.end());
      }
      if constexpr (D == 3) {
        soup_.add_facet(longer);
      } else {
        longer.push_back(loop[1]);
        for (std::size_t i = 1; i < longer.size(); ++i) soup_.add_facet({longer[i - 1], longer[i]});
      }
    }
    soup_.end_cell(before.solid[c]);
  }
}

template <int D>
void Maker<D>::turn() {
  std::array<Lattice_place<D>, static_cast<std::size_t>(D)> matrix{};  // columns
  int determinant = 0;
  for (int tries = 0; options_.turned && determinant <= 0 && tries < 20; ++tries) {
    for (Lattice_place<D>& column : matrix)
      for (int& x : column) x = static_cast<int>(below_(7)) - 3;
    const auto& m = matrix;
    if constexpr (D == 2)
      determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    else
      determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                    m[1][0] * (m[0][1] * m[2][2] - m[0][2] * m[2][1]) +
                    m[2][0] * (m[0][1] * m[1][2] - m[0][2] * m[1][1]);
  }
  if (determinant <= 0) {
    matrix = {};
    for (std::size_t k = 0; k < D; ++k) matrix[k][k] = 1;
  }
  for (std::size_t v = 0; v < places_.size(); ++v) {
    Point<D> point{};
    for (std::size_t j = 0; j < D; ++j)
      for (std::size_t k = 0; k < D; ++k) point[k] += matrix[j][k] * places_[v][j];
    // Along the first column, which leads from layer to layer.
    if (options_.gap > 0)
      for (std::size_t k = 0; k < D; ++k) point[k] += options_.gap * layer_of_[v] * matrix[0][k];
    soup_.points.push_back(point);
  }
}

}  // namespace

template <int D>
Cell_soup<D> layers(const Layers_options& options, const Below& below) {
  return Maker<D>(options, below).make();
}

template Cell_soup<2> layers(const Layers_options&, const Below&);
template Cell_soup<3> layers(const Layers_options&, const Below&);

}  // namespace cellwalk::test
