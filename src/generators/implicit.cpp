// SPDX-License-Identifier: LGPL-3.0-or-later
// The lattice is the body-centred cubic one: the points of integer coordinates that are all even (corners) or
// all odd (centres). Each tetrahedron has two centres that are neighbours along an axis and two corners that
// are neighbours along another: twelve around a centre for its three higher neighbours.
#include <cellwalk/internal/generators/implicit.h>
#include <cellwalk/kernel/error.h>
#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace cellwalk {
namespace {

using Node = std::array<int, 3>;  // lattice coordinates

/// Fractions of an edge within which a cut moves the lattice point onto the surface: those for which Labelle
/// and Shewchuk prove dihedral angles above 10.7 degrees. Long edges join points of the same kind.
constexpr double snap_long = 0.24999, snap_short = 0.41189;

/// The least thickness of tissue, in edges of the lattice's cubes. No edge is longer than one, so that no
/// tetrahedron is cut on both of its sides; and a lattice point moves by 0.36 of one at most.
constexpr double least_tissue = 1.25;

/// Secant steps towards a cut. The remaining error only makes the surface less smooth.
constexpr int cut_steps = 4;

constexpr double most_nodes = 1e9;

class Stuffing {
 public:
  explicit Stuffing(const Implicit_shape& shape) : shape_(shape), step_(shape.cell_size / 2) {
    if (!(shape.cell_size > 0))
      throw Error(Error_code::usage, "implicit shape: the cell size must be positive");
    if (!(shape.tissue == 0 ||
          (shape.tissue >= least_tissue * shape.cell_size && std::isfinite(shape.tissue))))
      throw Error(Error_code::usage,
                  "implicit shape: the tissue must be 0 or at least 1.25 times the cell size; give a smaller "
                  "cell size, or thicker tissue");
    // Cubes around the box, so that no tetrahedron of the shape or its tissue is missing at its rim.
    const double ring = 1 + std::ceil(shape.tissue / shape.cell_size);
    double nodes = 1;
    for (int i = 0; i < 3; ++i) {
      const double cubes = std::ceil((shape.high[i] - shape.low[i]) / shape.cell_size) + 2 * ring;
      if (!(cubes > 2 && (nodes *= cubes + 1) <= most_nodes))
        throw Error(Error_code::usage,
                    "implicit shape: the box is empty or has too many cells; give a larger cell size");
      cubes_[i] = static_cast<int>(cubes);
      origin_[i] = shape.low[i] - ring * shape.cell_size;
    }
  }

  Cell_soup<3> fill() {
    sample();
    cut_edges();
    snap();
    for_each_node(1, [&](const Node& centre) { add_tetrahedra_round(centre); });
    if (soup_.cell_count() == 0)
      throw Error(Error_code::usage, "implicit shape: no cell lies inside it; give a smaller cell size");
    return std::move(soup_);
  }

 private:
  /// Calls f(node) for all corners (parity 0) or centres (parity 1), x fastest.
  template <class F>
  void for_each_node(int parity, const F& f) const {
    Node n;
    for (n[2] = parity; n[2] <= 2 * cubes_[2]; n[2] += 2)
      for (n[1] = parity; n[1] <= 2 * cubes_[1]; n[1] += 2)
        for (n[0] = parity; n[0] <= 2 * cubes_[0]; n[0] += 2) f(n);
  }

  /// Corners first, then centres.
  std::size_t index(const Node& n) const {
    const int parity = n[0] & 1;
    const std::size_t nx = cubes_[0] + 1 - parity, ny = cubes_[1] + 1 - parity;
    const std::size_t first = parity ? std::size_t(cubes_[0] + 1) * (cubes_[1] + 1) * (cubes_[2] + 1) : 0;
    return first + n[0] / 2 + nx * (n[1] / 2 + ny * std::size_t(n[2] / 2));
  }

  bool is_node(const Node& n) const {
    for (int i = 0; i < 3; ++i)
      if (n[i] < 0 || n[i] > 2 * cubes_[i]) return false;
    return true;
  }

  Point<3> lattice_position(const Node& n) const {
    Point<3> p;
    for (int i = 0; i < 3; ++i) p[i] = origin_[i] + step_ * n[i];
    return p;
  }

  void sample() {
    const std::size_t corners = std::size_t(cubes_[0] + 1) * (cubes_[1] + 1) * (cubes_[2] + 1);
    depth_.resize(corners + std::size_t(cubes_[0]) * cubes_[1] * cubes_[2]);
    vertex_.assign(depth_.size(), none);
    for (int parity : {0, 1})
      for_each_node(parity, [&](const Node& n) { depth_[index(n)] = shape_.depth(lattice_position(n)); });
  }

  bool is_cut(std::size_t a, std::size_t b, double level) const {
    return (depth_[a] > level && depth_[b] < level) || (depth_[a] < level && depth_[b] > level);
  }

  /// The depth of the surface that cuts an edge: that of the shape, or the outer one of its tissue.
  std::optional<double> cut_level(std::size_t a, std::size_t b) const {
    if (is_cut(a, b, 0)) return 0;
    if (shape_.tissue != 0 && is_cut(a, b, -shape_.tissue)) return -shape_.tissue;
    return std::nullopt;
  }

  static std::uint64_t edge(std::size_t a, std::size_t b) {
    return std::min<std::uint64_t>(a, b) << 32 | std::max<std::uint64_t>(a, b);
  }

  /// The neighbours of a node, each by the direction of its edge.
  static constexpr std::array<Node, 14> directions() {
    std::array<Node, 14> d{};
    for (int i = 0; i < 8; ++i) d[i] = {i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1};
    for (int i = 0; i < 6; ++i) d[8 + i][i / 2] = i & 1 ? 2 : -2;
    return d;
  }

  void cut_edges() {
    for (int parity : {0, 1})
      for_each_node(parity, [&](const Node& n) {
        const std::size_t a = index(n);
        for (const Node& d : directions()) {
          const Node m{n[0] + d[0], n[1] + d[1], n[2] + d[2]};
          if (!is_node(m)) continue;
          const std::size_t b = index(m);
          if (a > b) continue;
          if (const auto level = cut_level(a, b))
            cuts_[edge(a, b)] = {cut(n, m, depth_[a] - *level, depth_[b] - *level, *level), none};
        }
      });
  }

  /// The fraction at which the surface of a depth cuts the edge from a to b, which are deeper by da and db:
  /// by the Illinois method, which keeps the root bracketed.
  double cut(const Node& na, const Node& nb, double da, double db, double level) const {
    const Point<3> a = lattice_position(na), b = lattice_position(nb);
    double ta = 0, tb = 1, t = 0.5;
    for (int step = 0; step < cut_steps; ++step) {
      t = ta + (tb - ta) * (da / (da - db));
      const double d = shape_.depth(a + t * (b - a)) - level;
      if (d == 0) break;
      if ((d > 0) == (da > 0)) {
        ta = t, da = d, db /= 2;
      } else {
        tb = t, db = d, da /= 2;
      }
    }
    return t;
  }

  /// Moves each lattice point that is close to a cut onto the nearest such cut.
  void snap() {
    for (int parity : {0, 1})
      for_each_node(parity, [&](const Node& n) {
        const std::size_t a = index(n);
        double nearest = 3, level = 0;  // in lattice units; more than any edge
        Point<3> place{};
        for (const Node& d : directions()) {
          const Node m{n[0] + d[0], n[1] + d[1], n[2] + d[2]};
          if (!is_node(m)) continue;
          const std::size_t b = index(m);
          const auto cut = cut_level(a, b);  // a snapped point lies on it, and its edges are not cut again
          if (!cut) continue;
          const double t = cuts_.at(edge(a, b)).fraction, from_a = a < b ? t : 1 - t;
          const bool is_long = (d[0] & 1) == 0;
          const double distance = from_a * (is_long ? 2 : std::sqrt(3.0));
          if (from_a > (is_long ? snap_long : snap_short) || distance >= nearest) continue;
          nearest = distance, level = *cut;
          place = between(n, m, from_a);
        }
        if (nearest < 3) {
          depth_[a] = level;
          snapped_[a] = place;
        }
      });
  }

  Point<3> between(const Node& a, const Node& b, double t) const {
    const Point<3> p = lattice_position(a);
    return p + t * (lattice_position(b) - p);
  }

  std::uint32_t add_point(const Point<3>& p) {
    soup_.points.push_back(p);
    return static_cast<std::uint32_t>(soup_.points.size() - 1);
  }

  std::uint32_t vertex(const Node& n) {
    const std::size_t i = index(n);
    if (vertex_[i] == none) {
      const auto moved = snapped_.find(i);
      vertex_[i] = add_point(moved == snapped_.end() ? lattice_position(n) : moved->second);
    }
    return vertex_[i];
  }

  std::uint32_t cut_vertex(const Node& a, const Node& b) {
    Cut& cut = cuts_.at(edge(index(a), index(b)));
    if (cut.vertex == none)
      cut.vertex = add_point(index(a) < index(b) ? between(a, b, cut.fraction) : between(b, a, cut.fraction));
    return cut.vertex;
  }

  void add_tetrahedra_round(const Node& centre) {
    for (int axis = 0; axis < 3; ++axis) {
      Node next = centre;
      next[axis] += 2;
      if (!is_node(next)) continue;
      const int b = (axis + 1) % 3, c = (axis + 2) % 3;
      // The square of corners between the two centres, in order around it.
      std::array<Node, 4> square;
      for (int i = 0; i < 4; ++i) {
        square[i] = centre;
        square[i][axis] += 1;
        square[i][b] += i == 0 || i == 3 ? -1 : 1;
        square[i][c] += i < 2 ? -1 : 1;
      }
      for (int i = 0; i < 4; ++i) add_parts({centre, next, square[i], square[(i + 1) % 4]});
    }
  }

  /// Adds the part of a lattice tetrahedron that lies in the shape, and that in its tissue.
  void add_parts(const std::array<Node, 4>& nodes) {
    double deepest = depth_[index(nodes[0])], highest = deepest;
    for (const Node& n : nodes) {
      deepest = std::max(deepest, depth_[index(n)]);
      highest = std::min(highest, depth_[index(n)]);
    }
    if (deepest > 0) add_part(nodes, 0, 1, false);
    if (shape_.tissue == 0 || deepest <= -shape_.tissue) return;
    if (highest >= -shape_.tissue) {
      // Outside of the shape; if all nodes lie on its surface, all of the tetrahedron.
      if (highest < 0) add_part(nodes, 0, -1, true);
      if (highest == 0 && deepest == 0) add_whole(nodes, true);
      return;
    }
    if (deepest > 0)
      throw Error(
          Error_code::usage,
          "implicit shape: the tissue is thinner than a cell somewhere; give a smaller cell size, or a "
          "depth that is the distance to the surface");
    add_part(nodes, -shape_.tissue, 1, true);
  }

  void add_whole(const std::array<Node, 4>& n, bool solid) {
    const auto a = vertex(n[0]), b = vertex(n[1]), c = vertex(n[2]), d = vertex(n[3]);
    add({a, b, c, d}, solid);
  }

  /// Adds the part of a lattice tetrahedron on one side of a depth: deeper (1) or less deep (-1). If the
  /// surface leaves a quadrangle of a facet, it is cut from its inner point of lower index, as in the
  /// neighbour; one on the surface is cut in the same way from both sides.
  void add_part(std::array<Node, 4> nodes, double level, int side, bool solid) {
    // Inner points by index, then those on the surface, then outer ones.
    const auto rank = [&](const Node& n) {
      const double deeper = side * (depth_[index(n)] - level);
      return deeper > 0 ? 0 : deeper == 0 ? 1 : 2;
    };
    std::array<int, 3> count{};
    for (const Node& n : nodes) ++count[rank(n)];
    if (count[0] == 0) return;
    std::sort(nodes.begin(), nodes.end(), [&](const Node& m, const Node& n) {
      return rank(m) != rank(n) ? rank(m) < rank(n) : index(m) < index(n);
    });
    const auto& [p, q, r, s] = nodes;
    // The end of the inner part towards node n, seen from the inner point `from`.
    const auto end = [&](const Node& from, const Node& n) {
      return rank(n) == 2 ? cut_vertex(from, n) : vertex(n);
    };
    const auto add = [&](const std::array<std::uint32_t, 4>& t) { this->add(t, solid); };
    if (count[0] == 1) {
      add({vertex(p), end(p, q), end(p, r), end(p, s)});
    } else if (count[2] == 0) {
      add({vertex(p), vertex(q), vertex(r), vertex(s)});
    } else if (count[0] == 2 && count[2] == 1) {
      const auto ps = cut_vertex(p, s), qs = cut_vertex(q, s);
      add({vertex(p), vertex(q), vertex(r), qs});
      add({vertex(p), vertex(r), qs, ps});
    } else if (count[0] == 2) {
      const auto pr = cut_vertex(p, r), ps = cut_vertex(p, s), qr = cut_vertex(q, r), qs = cut_vertex(q, s);
      add({vertex(p), vertex(q), qr, qs});
      // The quadrangle on the surface is cut along its shorter diagonal.
      if (length(soup_.points[pr] - soup_.points[qs]) < length(soup_.points[ps] - soup_.points[qr])) {
        add({vertex(p), pr, qr, qs});
        add({vertex(p), pr, qs, ps});
      } else {
        add({vertex(p), pr, qr, ps});
        add({vertex(p), ps, qr, qs});
      }
    } else {
      const auto ps = cut_vertex(p, s), qs = cut_vertex(q, s), rs = cut_vertex(r, s);
      add({vertex(p), vertex(q), vertex(r), rs});
      add({vertex(p), vertex(q), rs, qs});
      add({vertex(p), qs, rs, ps});
    }
  }

  /// An array, since its initialiser makes new points in the order written; arguments have no order.
  void add(const std::array<std::uint32_t, 4>& tetrahedron, bool solid) {
    const auto [a, b, c, d] = tetrahedron;
    Predicate_counts counts;
    const auto& p = soup_.points;
    const int sign = Exact::orientation(counts, p[a], p[b], p[c], p[d]);
    if (sign == 0)
      throw Error(
          Error_code::not_certified,
          "implicit shape: a cell is flat; the size of cells is below the resolution of the coordinates");
    sign > 0 ? add_tetrahedron(soup_, a, b, c, d) : add_tetrahedron(soup_, b, a, c, d);
    soup_.solid.back() = solid;
  }

  static constexpr std::uint32_t none = 0xffffffffu;

  struct Cut {
    double fraction;  // from the node of lower index
    std::uint32_t vertex;
  };

  const Implicit_shape& shape_;
  double step_;  // of lattice coordinates
  Node cubes_;
  Point<3> origin_;
  std::vector<double> depth_;                          // per node; exactly that of a surface on which it lies
  std::vector<std::uint32_t> vertex_;                  // per node: its point of the soup
  std::unordered_map<std::uint64_t, Cut> cuts_;        // per cut edge
  std::unordered_map<std::size_t, Point<3>> snapped_;  // nodes moved onto the surface
  Cell_soup<3> soup_;
};

}  // namespace

Cell_soup<3> fill_implicit(const Implicit_shape& shape) { return Stuffing(shape).fill(); }

}  // namespace cellwalk
