// SPDX-License-Identifier: LGPL-3.0-or-later
// The sides within the polygon form a plane graph. Diagonals are added where the remainder has an angle of
// more than half a turn; then all faces are convex, and none has a hole.
#include "overlay.h"

#include <cellwalk/kernel/exact.h>

#include <algorithm>
#include <compare>
#include <optional>
#include <utility>

namespace cellwalk::detail {
namespace {

/// The faces of an overlay: one for each other polygon, by its place, the remainder, and what lies outside.
constexpr std::uint32_t remaining = 0xffffffffu, outside = 0xfffffffeu;

class Overlay {
 public:
  Overlay(std::span<const Point<2>> points, double tolerance)
      : points_(points), signs_{tolerance}, edges_(points.size()) {}

  /// False if two polygons lie on the same side of an edge, or in the same face.
  bool add(const Overlay_loop& rim, std::span<const Overlay_loop> others);
  /// Adds diagonals until all angles of the remainder are convex; false if that fails.
  bool make_convex();
  /// Nothing if one is not convex, as where others overlap each other.
  std::vector<Overlay_loop> faces();

 private:
  /// An edge from one vertex, and the face on its left.
  struct Edge {
    std::uint32_t to, face;
  };
  struct Candidate {
    bool leaves_an_angle;
    double square;
    std::uint32_t vertex;
    auto operator<=>(const Candidate&) const = default;
  };

  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return signs_.turn(points_[a], points_[b], points_[c]);
  }
  Edge* find(std::uint32_t from, std::uint32_t to) {
    const auto at =
        std::find_if(edges_[from].begin(), edges_[from].end(), [&](const Edge& e) { return e.to == to; });
    return at == edges_[from].end() ? nullptr : &*at;
  }
  /// The edge after one around its face.
  std::pair<std::uint32_t, std::size_t> next(std::uint32_t v, std::size_t edge) const;
  /// Calls visit(edges, as vertex and place) for each cycle of edges around a face, while it returns true.
  template <class Visit>
  bool for_each_face(const Visit& visit);
  /// Gives all edges around a face its name, those of the rim within another polygon too.
  bool name_faces();
  std::vector<std::uint8_t> mark_inside(const Overlay_loop& rim);
  void sort_around(std::uint32_t v);
  bool bounds_remainder(std::uint32_t v) const {
    return std::any_of(edges_[v].begin(), edges_[v].end(), [](const Edge& e) { return e.face == remaining; });
  }
  /// The place of an edge at v to the left of which the remainder has an angle of more than half a turn.
  std::optional<std::size_t> find_reflex(std::uint32_t v);
  /// Adds a diagonal there.
  bool connect(std::uint32_t v, std::size_t edge);
  bool is_convex(const Overlay_loop& loop) const;
  bool is_visible(std::uint32_t v, std::uint32_t w);

  std::span<const Point<2>> points_;
  Signs_in_plane signs_;
  std::vector<std::vector<Edge>> edges_;  ///< by vertex; counterclockwise once they are sorted
  std::vector<std::uint32_t> border_;     ///< vertices of the remainder
};

/// Marks the points in the closed polygon.
std::vector<std::uint8_t> Overlay::mark_inside(const Overlay_loop& rim) {
  std::vector<std::uint8_t> is_inside(points_.size(), 1), is_on_rim(points_.size(), 0);
  for (const std::uint32_t v : rim) is_on_rim[v] = 1;
  for (std::uint32_t v = 0; v < points_.size(); ++v)
    for (std::size_t i = 0; !is_on_rim[v] && is_inside[v] && i < rim.size(); ++i)
      is_inside[v] = turn(rim[i], rim[(i + 1) % rim.size()], v) >= 0;
  return is_inside;
}

bool Overlay::add(const Overlay_loop& rim, std::span<const Overlay_loop> others) {
  const std::vector<std::uint8_t> is_inside = mark_inside(rim);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::uint32_t a = rim[i], b = rim[(i + 1) % rim.size()];
    edges_[a].push_back({b, remaining});
    edges_[b].push_back({a, outside});
  }
  for (std::uint32_t other = 0; other < others.size(); ++other) {
    const Overlay_loop& loop = others[other];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      if (!is_inside[a] || !is_inside[b]) continue;
      if (Edge* const edge = find(a, b)) {
        if (edge->face != remaining) return false;
        edge->face = other;
      } else {
        edges_[a].push_back({b, other});
        edges_[b].push_back({a, remaining});
      }
    }
  }
  for (std::uint32_t v = 0; v < points_.size(); ++v) sort_around(v);
  if (!name_faces()) return false;
  for (std::uint32_t v = 0; v < points_.size(); ++v)
    if (bounds_remainder(v)) border_.push_back(v);
  return true;
}

void Overlay::sort_around(std::uint32_t v) {
  // Directions that rise lexicographically come first: each half is less than a turn, in order.
  std::sort(edges_[v].begin(), edges_[v].end(), [&](const Edge& a, const Edge& b) {
    const bool a_falls = points_[a.to] < points_[v], b_falls = points_[b.to] < points_[v];
    if (a_falls != b_falls) return b_falls;
    return Signs_in_plane{}.turn(points_[v], points_[a.to], points_[b.to]) > 0;
  });
}

std::optional<std::size_t> Overlay::find_reflex(std::uint32_t v) {
  const std::vector<Edge>& around = edges_[v];
  for (std::size_t i = 0; i < around.size(); ++i)
    if (around[i].face == remaining && turn(v, around[i].to, around[(i + 1) % around.size()].to) < 0)
      return i;
  return {};
}

bool Overlay::make_convex() {
  for (const std::uint32_t v : border_)
    while (const auto edge = find_reflex(v))
      if (!connect(v, *edge)) return false;
  return true;
}

bool Overlay::connect(std::uint32_t v, std::size_t edge) {
  const std::uint32_t a = edges_[v][edge].to, b = edges_[v][(edge + 1) % edges_[v].size()].to;
  std::vector<Candidate> candidates;
  for (const std::uint32_t w : border_) {
    // The other angle from b to a is convex.
    if (w == v || (turn(v, b, w) >= 0 && turn(v, a, w) <= 0)) continue;
    const Vector<2> d = points_[w] - points_[v];
    candidates.push_back({turn(v, a, w) < 0 || turn(v, w, b) < 0, dot(d, d), w});
  }
  std::sort(candidates.begin(), candidates.end());
  for (const Candidate& candidate : candidates) {
    const std::uint32_t w = candidate.vertex;
    if (!is_visible(v, w)) continue;
    edges_[v].push_back({w, remaining});
    edges_[w].push_back({v, remaining});
    sort_around(v);
    sort_around(w);
    return true;
  }
  return false;
}

bool Overlay::is_visible(std::uint32_t v, std::uint32_t w) {
  const auto [low, high] = std::minmax(points_[v], points_[w]);
  for (const std::uint32_t x : border_) {
    if (x == v || x == w) continue;
    const int side = turn(v, w, x);
    if (side == 0 && low < points_[x] && points_[x] < high) return false;
    for (const Edge& e : edges_[x]) {
      if (e.to < x || e.to == v || e.to == w) continue;
      if (side * turn(v, w, e.to) < 0 && turn(x, e.to, v) * turn(x, e.to, w) < 0) return false;
    }
  }
  return true;
}

std::pair<std::uint32_t, std::size_t> Overlay::next(std::uint32_t v, std::size_t edge) const {
  // The face lies to the left: the next edge is the one clockwise from the way back.
  const std::uint32_t w = edges_[v][edge].to;
  const auto& around = edges_[w];
  const auto back = std::find_if(around.begin(), around.end(), [&](const Edge& e) { return e.to == v; });
  return {w, static_cast<std::size_t>((back == around.begin() ? around.end() : back) - around.begin()) - 1};
}

template <class Visit>
bool Overlay::for_each_face(const Visit& visit) {
  std::vector<std::vector<std::uint8_t>> is_done(edges_.size());
  for (std::size_t v = 0; v < edges_.size(); ++v) is_done[v].assign(edges_[v].size(), 0);
  std::vector<std::pair<std::uint32_t, std::size_t>> cycle;
  for (std::uint32_t first = 0; first < edges_.size(); ++first)
    for (std::size_t start = 0; start < edges_[first].size(); ++start) {
      cycle.clear();
      for (auto at = std::pair(first, start); !is_done[at.first][at.second]; at = next(at.first, at.second)) {
        is_done[at.first][at.second] = 1;
        cycle.push_back(at);
      }
      if (!cycle.empty() && !visit(cycle)) return false;
    }
  return true;
}

bool Overlay::name_faces() {
  return for_each_face([&](const auto& cycle) {
    std::uint32_t face = remaining;
    for (const auto& [v, i] : cycle) {
      const std::uint32_t own = edges_[v][i].face;
      if (own == remaining || own == face) continue;
      if (face != remaining) return false;
      face = own;
    }
    for (const auto& [v, i] : cycle) edges_[v][i].face = face;
    return true;
  });
}

std::vector<Overlay_loop> Overlay::faces() {
  std::vector<Overlay_loop> loops;
  const bool are_convex = for_each_face([&](const auto& cycle) {
    if (edges_[cycle[0].first][cycle[0].second].face == outside) return true;
    Overlay_loop& loop = loops.emplace_back();
    for (const auto& at : cycle) loop.push_back(at.first);
    return is_convex(loop);
  });
  return are_convex ? loops : std::vector<Overlay_loop>{};
}

bool Overlay::is_convex(const Overlay_loop& loop) const {
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i)
    if (turn(loop[i], loop[(i + 1) % n], loop[(i + 2) % n]) < 0) return false;
  Overlay_loop sorted = loop;
  std::sort(sorted.begin(), sorted.end());
  return n >= 3 && std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

}  // namespace

int Signs_in_plane::turn(const Point<2>& a, const Point<2>& b, const Point<2>& c) const {
  Predicate_counts counts;
  if (tolerance == 0) return Exact::orientation(counts, a, b, c);
  const Vector<2> along = b - a, to = c - a;
  const double distance = (along[0] * to[1] - along[1] * to[0]) / length(along);
  return distance > tolerance ? 1 : distance < -tolerance ? -1 : 0;
}

std::vector<Overlay_loop> overlay(std::span<const Point<2>> points, const Overlay_loop& rim,
                                  std::span<const Overlay_loop> others, double tolerance) {
  Overlay graph(points, tolerance);
  if (!graph.add(rim, others) || !graph.make_convex()) return {};
  return graph.faces();
}

}  // namespace cellwalk::detail
