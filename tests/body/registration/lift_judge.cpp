// SPDX-License-Identifier: LGPL-3.0-or-later
#include "body/registration/lift_judge.h"

#include <cellwalk/internal/body/body_access.h>

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>

namespace cellwalk::test {
namespace {

Exact_point_3 between(const Exact_point_3& u, const Exact_point_3& v, const Fraction& t) {
  Exact_point_3 x;
  for (std::size_t k = 0; k < 3; ++k) x[k] = u[k] + t * (v[k] - u[k]);
  return x;
}

using Place = std::array<Fraction, 2>;  ///< in a face: a + s (b - a) + t (c - a)

/// (s,t) -> constant + s at_s + t at_t, its first coefficient of s and t that is not 0 being 1.
struct Line {
  Fraction at_s, at_t, constant;

  int side(const Place& x) const { return Fraction(constant + x[0] * at_s + x[1] * at_t).sign(); }
  auto key() const { return std::tie(at_s, at_t, constant); }
  bool operator<(const Line& other) const { return key() < other.key(); }
};

}  // namespace

/// The pieces of a face: where lines in its plane meet, between these points, and between the lines.
class Lift_judge::Face_cutter {
 public:
  Face_cutter(Lift_judge& judge, std::uint32_t f, const std::array<std::uint32_t, 3>& corners)
      : judge_(judge), corners_(corners), face_(f) {
    std::array<Point<3>, 3> points;
    for (std::size_t k = 0; k < 3; ++k) {
      points[k] = judge.soup_.points[corners[k]];
      at_[k] = exact(points[k]);
    }
    near_ = judge.near_.near(points);
  }

  bool is_flat() const {
    const auto normal = cross(minus(at_[1], at_[0]), minus(at_[2], at_[0]));
    return dot(normal, normal) == 0;
  }

  void run() {
    parallel_.resize(judge_.near_.planes().size());
    for (const std::size_t p : judge_.near_.planes_of(near_)) add_plane(p);
    for (const Line& side : {Line{0, 1, 0}, Line{1, 0, 0}, Line{1, 1, -1}}) lines_.try_emplace(side);
    for (const auto& [line, planes] : lines_) cut_line(line, planes);
  }

 private:
  struct Of_line {
    std::size_t plane;
    int sense;
  };

  static bool is_inside(const Place& x) { return x[0] > 0 && x[1] > 0 && x[0] + x[1] < 1; }
  static bool is_in_closed(const Place& x) { return x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1; }

  void add_plane(std::size_t p) {
    const Exact_plane& plane = judge_.near_.planes()[p];
    const Fraction a = plane(at_[0]), s = plane(at_[1]) - a, t = plane(at_[2]) - a;
    const Fraction first = s != 0 ? s : t;
    parallel_[p] = static_cast<signed char>(a.sign());
    if (first == 0) return;
    lines_[Line{s / first, t / first, a / first}].push_back({p, first.sign()});
  }

  void cut_line(const Line& line, const std::vector<Of_line>& planes) {
    std::set<Place> points;  // ascending in one coordinate, or in the other where that stands
    for (const auto& [other, of_other] : lines_) {
      const Fraction determinant = line.at_s * other.at_t - line.at_t * other.at_s;
      if (determinant == 0) continue;
      const Place x{(line.at_t * other.constant - other.at_t * line.constant) / determinant,
                    (other.at_s * line.constant - line.at_s * other.constant) / determinant};
      if (is_in_closed(x)) points.insert(x);
    }
    for (auto here = points.begin(); here != points.end(); ++here) {
      const auto next = std::next(here);
      if (next == points.end()) break;
      cut_segment(*here, *next, line, planes);
    }
  }

  void cut_segment(const Place& from, const Place& to, const Line& line, const std::vector<Of_line>& planes) {
    const Place middle{(from[0] + to[0]) / 2, (from[1] + to[1]) / 2};
    const Piece segment = piece_at(middle);
    judge_.join(segment, piece_at(from));
    judge_.join(segment, piece_at(to));
    Signs signs = signs_at(middle);
    const Place centre{Fraction(1, 3), Fraction(1, 3)};
    for (const int side : {-1, 1}) {
      if (!is_inside(middle) && line.side(centre) != side) continue;  // out of the triangle
      for (const Of_line& of : planes) signs[of.plane] = static_cast<signed char>(side * of.sense);
      const auto [known, is_new] = polygons_.try_emplace(signs);
      if (is_new) {
        known->second = judge_.add(signs, near_);
        judge_.faces_[face_].push_back(known->second);
      }
      judge_.join(known->second, segment);
    }
  }

  Signs signs_at(const Place& x) const {
    Signs signs = parallel_;
    for (const auto& [line, planes] : lines_) {
      const int side = line.side(x);
      for (const Of_line& of : planes) signs[of.plane] = static_cast<signed char>(side * of.sense);
    }
    return signs;
  }

  Piece piece_at(const Place& x) {
    const auto [known, is_new] = pieces_.try_emplace(x);
    if (is_new) known->second = is_inside(x) ? judge_.add(signs_at(x), near_) : on_border(x);
    return known->second;
  }

  Piece on_border(const Place& x) const {
    if (x[1] == 0) return on_side(0, 1, x[0]);
    if (x[0] == 0) return on_side(0, 2, x[1]);
    return on_side(1, 2, x[1]);
  }
  /// The piece of the edge between two corners at a parameter from the first to the second.
  Piece on_side(std::size_t i, std::size_t j, Fraction t) const {
    std::uint32_t u = corners_[i], v = corners_[j];
    if (u > v) {
      std::swap(u, v);
      t = 1 - t;
    }
    const auto& edges = judge_.soup_.edges;
    const auto e = static_cast<std::size_t>(std::ranges::find(edges, std::array{u, v}) - edges.begin());
    const Edge_pieces& edge = judge_.edges_.at(e);
    if (t == 0) return edge.in_order.front();
    if (t == 1) return edge.in_order.back();
    const auto cut = std::ranges::lower_bound(edge.cuts, t);
    const auto k = static_cast<std::size_t>(cut - edge.cuts.begin());
    return edge.in_order[2 * k + (cut != edge.cuts.end() && *cut == t ? 2 : 1)];
  }

  Lift_judge& judge_;
  const std::array<std::uint32_t, 3> corners_;
  const std::uint32_t face_;
  std::array<Exact_point_3, 3> at_;
  std::vector<std::size_t> near_;
  std::map<Line, std::vector<Of_line>> lines_;
  std::map<Place, Piece> pieces_;
  /// A polygon is told from others by the planes' sides on which it lies.
  std::map<Signs, Piece> polygons_;
  Signs parallel_;  ///< the sides on which the face lies of planes that do not cut it
};

Lift_judge::Lift_judge(const Snapshot<3>& snapshot, const Body_soup<3>& soup)
    : snapshot_(snapshot), soup_(soup), near_(snapshot, soup.points), faces_(soup.faces.size()) {
  for (const Point<3>& x : soup.points) {
    const auto near = near_.near({&x, 1});
    add(near_.signs_at(exact(x), near_.planes_of(near)), near);
  }
  for (std::uint32_t e = 0; e < soup.edges.size(); ++e) cut_edge(e);
  for (std::uint32_t f = 0; f < soup.faces.size(); ++f) {
    Face_cutter cutter(*this, f, soup.faces[f]);
    if (!cutter.is_flat()) cutter.run();
  }
  std::ranges::sort(borders_);
  borders_.erase(std::unique(borders_.begin(), borders_.end()), borders_.end());
}

Lift_judge::Piece Lift_judge::add(const Signs& signs, std::span<const std::size_t> near) {
  sides_.push_back(near_.linked_at(signs, near));
  Domain& domain = domains_.emplace_back(sides_.back());
  std::ranges::sort(domain);
  domain.erase(std::unique(domain.begin(), domain.end()), domain.end());
  std::erase(domain, -1);
  signs_.push_back(signs);
  return signs_.size() - 1;
}

void Lift_judge::cut_edge(std::uint32_t e) {
  const auto [u, v] = soup_.edges[e];
  const Exact_point_3 a = exact(soup_.points[u]), b = exact(soup_.points[v]);
  const auto near = near_.near(std::array{soup_.points[u], soup_.points[v]});
  const auto planes = near_.planes_of(near);
  std::set<Fraction> cuts;
  for (const std::size_t p : planes) {
    const Exact_plane& plane = near_.planes()[p];
    const Fraction at_a = plane(a), at_b = plane(b);
    if (at_a.sign() * at_b.sign() < 0) cuts.insert(at_a / (at_a - at_b));
  }
  Edge_pieces& edge = edges_.emplace_back();
  edge.cuts.assign(cuts.begin(), cuts.end());
  edge.in_order.push_back(u);
  Fraction last = 0;
  for (std::size_t k = 0; k <= edge.cuts.size(); ++k) {
    const bool is_last = k == edge.cuts.size();
    const Fraction next = is_last ? Fraction(1) : edge.cuts[k];
    const Piece segment = add(near_.signs_at(between(a, b, (last + next) / 2), planes), near);
    join(segment, edge.in_order.back());
    edge.in_order.push_back(segment);
    edge.in_order.push_back(is_last ? v : add(near_.signs_at(between(a, b, next), planes), near));
    join(segment, edge.in_order.back());
    last = next;
  }
}

/// Leaves out sides that no side of a piece beside them continues. False if none are left.
bool Lift_judge::narrow(std::vector<Domain>& domains) const {
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const auto& [piece, border] : borders_) {
      const Sides& there = sides_[border];
      const auto continued = [&](int side) { return there[static_cast<std::size_t>(side)]; };
      Domain &of = domains[piece], &at = domains[border];
      const auto dropped =
          std::erase_if(of, [&](int side) { return !std::ranges::count(at, continued(side)); });
      const auto lost = std::erase_if(at, [&](int side) { return !std::ranges::count(of, side, continued); });
      has_changed |= dropped + lost > 0;
      if (of.empty() || at.empty()) return false;
    }
  }
  return true;
}

bool Lift_judge::has_choice(std::vector<Domain> domains) const {
  if (std::ranges::any_of(domains, &Domain::empty) || !narrow(domains)) return false;
  const auto open = std::ranges::find_if(domains, [](const Domain& domain) { return domain.size() > 1; });
  if (open == domains.end()) return true;
  const Domain all = *open;
  for (const int side : all) {
    *open = {side};
    if (has_choice(domains)) return true;
  }
  return false;
}

bool Lift_judge::may_choose() const {
  std::vector<Domain> domains = domains_;
  return narrow(domains) &&
         std::ranges::any_of(domains, [](const Domain& domain) { return domain.size() > 1; });
}

bool Lift_judge::restrict_to(std::vector<Domain>& domains, Piece piece, int cell) const {
  const int side = cell < 0 ? -1 : sides_[piece][static_cast<std::size_t>(cell)];
  std::erase_if(domains[piece], [&](int other) { return other != side; });
  return !domains[piece].empty();
}

/// Whether it is in a closed facet of a cell.
bool Lift_judge::lies_in(Piece piece, Half_facet f, Cell cell) const {
  const int c = near_.number_of(cell);
  return c >= 0 && sides_[piece][static_cast<std::size_t>(c)] >= 0 && near_.is_in(f, cell, signs_[piece]);
}

/// The chain passes each facet where it first can.
bool Lift_judge::follow_chain(const Body<3>& body, std::uint32_t e, std::vector<Domain>& domains) const {
  const std::vector<Piece>& pieces = edges_[e].in_order;
  Cell cell = body.particles()[body.edges()[e][0]].cell;
  std::size_t k = 0;
  if (!restrict_to(domains, pieces[k], near_.number_of(cell))) return false;
  for (const Half_facet f : body.chain(e)) {
    for (; k < pieces.size() && !lies_in(pieces[k], f, cell); ++k)
      if (!restrict_to(domains, pieces[k], near_.number_of(cell))) return false;
    if (k == pieces.size() || snapshot_.is_impassable(f)) return false;
    if (!restrict_to(domains, pieces[k], near_.number_of(cell))) return false;
    cell = snapshot_.neighbour(f);
  }
  for (; k < pieces.size(); ++k)
    if (!restrict_to(domains, pieces[k], near_.number_of(cell))) return false;
  return true;
}

std::string Lift_judge::fault(Body<3>& body) const {
  std::vector<Domain> domains = domains_;
  for (std::uint32_t v = 0; v < body.vertex_count(); ++v)
    if (!restrict_to(domains, v, near_.number_of(body.particles()[v].cell)))
      return "vertex " + std::to_string(v) + " is not in its cell";
  for (std::uint32_t e = 0; e < edges_.size(); ++e)
    if (!follow_chain(body, e, domains)) return "edge " + std::to_string(e) + " has no chain";
  if (!has_choice(domains)) return "a wall comes between faces and edges";
  const detail::Body_access<3> access(body);
  for (std::uint32_t f = 0; f < faces_.size(); ++f)
    for (const Piece piece : faces_[f])
      for (const Half_facet wall : access.supporting_walls(f))
        if (const Cell cell = snapshot_.cell_of(wall); lies_in(piece, wall, cell))
          if (!restrict_to(domains, piece, near_.number_of(cell)))
            return "face " + std::to_string(f) + " rests on both sides of a wall";
  return has_choice(domains) ? "" : "a wall comes between faces on their supporting walls";
}

}  // namespace cellwalk::test
