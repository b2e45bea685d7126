// SPDX-License-Identifier: LGPL-3.0-or-later
// The oracle of facets that close and cells that are filled: by definition, with all choices of all vertices
// of a body, in rational numbers. Of the library it uses which cells there are and how they are joined.
#ifndef CELLWALK_TESTS_RESHAPE_CLOSING_JUDGE_H
#define CELLWALK_TESTS_RESHAPE_CLOSING_JUDGE_H

#include <cellwalk/reshape/reshaping.h>

#include <algorithm>
#include <array>
#include <memory>
#include <stdexcept>
#include <string>

#include "reshape/segment_places.h"

namespace cellwalk::test {

struct Closing_tally {
  int changes = 0, made = 0, refused = 0;
  int relinked = 0;   ///< made, and a chain or cell of a resident changed
  int by_choice = 0;  ///< refused, although each vertex and edge alone has a side
  int by_faces = 0;   ///< refused for a face only
  int undecided = 0;  ///< of these, such that no wall pierces the face
  int missed = 0, false_blocks = 0, wrong_registrations = 0, wrong_holders = 0;
  std::string last;  ///< what was found of the last change
  int wrong() const { return missed + false_blocks + wrong_registrations + wrong_holders; }
};

/// Of one change, made with all that is known before it.
template <int D>
class Closing_judge {
 public:
  using Bodies = std::vector<std::unique_ptr<Body<D>>>;

  /// \param closed facets that become walls, both sides of each
  /// \param filled the cell that becomes solid, or none
  /// \param has_faces of each body, whether its faces count
  Closing_judge(const Snapshot<D>& snapshot, const Bodies& bodies, std::span<const Particle<D>> particles,
                std::vector<Half_facet> closed, Cell filled, const std::vector<bool>& has_faces)
      : snapshot_(snapshot), closed_(std::move(closed)), filled_(filled) {
    now_ = {[&s = snapshot](Half_facet f) { return !s.is_impassable(f); }, [](Cell) { return true; }};
    // The snapshot changes meanwhile.
    std::set<Half_facet> walls(closed_.begin(), closed_.end());
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i)
      for (std::size_t k = 0; k <= D && snapshot.cell(i) != Cell::none; ++k)
        if (const Half_facet f = Snapshot<D>::half_facet(snapshot.cell(i), k); snapshot.is_impassable(f))
          walls.insert(f);
    then_ = {[walls](Half_facet f) { return !walls.contains(f); }, [filled](Cell c) { return c != filled; }};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      Of_body& of = bodies_.emplace_back();
      of.edges.assign(bodies[i]->edges().begin(), bodies[i]->edges().end());
      of.faces.assign(bodies[i]->faces().begin(), bodies[i]->faces().end());
      of.has_faces = has_faces[i];
      for (const Particle<D>& p : bodies[i]->particles()) of.vertices.emplace_back(*this, p, p, Chain{});
      for (std::size_t e = 0; e < of.edges.size(); ++e) {
        const auto [u, v] = of.edges[e];
        of.segments.emplace_back(*this, bodies[i]->particles()[u], bodies[i]->particles()[v],
                                 bodies[i]->chain(e));
      }
      const auto x = bodies[i]->positions();
      for (const auto& [p, q, r] : of.faces) of.corners.push_back({x[p], x[q], x[r]});
    }
    for (const Particle<D>& p : particles) particles_.emplace_back(*this, p, p, Chain{});
  }

  void judge(const Outcome& result, const Bodies& bodies, std::span<const Particle<D>> particles,
             Closing_tally& tally) {
    ++tally.changes;
    ++(result.is_made ? tally.made : tally.refused);
    bool may_be = true, is_held_alone = false, is_parted = false;
    std::vector<Resident> alone;
    for (std::uint32_t i = 0; i < particles_.size(); ++i)
      if (particles_[i].starts().empty()) alone.push_back({true, 0, Body_feature::vertex, i});
    for (std::uint32_t b = 0; b < bodies_.size(); ++b) {
      const Of_body& of = bodies_[b];
      for (std::uint32_t v = 0; v < of.vertices.size(); ++v)
        if (of.vertices[v].starts().empty()) alone.push_back({false, b, Body_feature::vertex, v});
      for (std::uint32_t e = 0; e < of.edges.size(); ++e)
        if (!of.vertices[of.edges[e][0]].starts().empty() && !of.vertices[of.edges[e][1]].starts().empty() &&
            of.segments[e].relation().empty())
          alone.push_back({false, b, Body_feature::edge, e});
      if (of.has_faces)
        for (std::uint32_t f = 0; f < of.faces.size(); ++f)
          if (is_face_parted(of, f)) {
            is_parted = true;
            const Resident face{false, b, Body_feature::face, f};
            tally.wrong_holders +=
                std::find(result.held_by.begin(), result.held_by.end(), face) == result.held_by.end();
          }
      std::vector<Cell> sides(of.vertices.size());
      may_be = may_be && can_be(of, sides, 0);
    }
    std::sort(alone.begin(), alone.end());
    for (const Particle<D>& p : particles) may_be = may_be && snapshot_.is_cell(p.cell);
    is_held_alone = !alone.empty();
    may_be = may_be && !is_held_alone && !is_parted;
    tally.last = "; made " + std::to_string(result.is_made) + ", may be " + std::to_string(may_be) +
                 ", parted " + std::to_string(is_parted) + ", filled " +
                 std::to_string(filled_ != Cell::none) + ", held by";
    const auto name = [&](const std::vector<Resident>& all) {
      for (const Resident& r : all)
        tally.last += (r.is_particle ? " p" : " b") + std::to_string(r.owner) +
                      "ved"[r.feature == Body_feature::vertex ? 0
                            : r.feature == Body_feature::edge ? 1
                                                              : 2] +
                      std::to_string(r.number);
    };
    name(result.held_by);
    tally.last += "; alone";
    name(alone);
    if (result.is_made) {
      tally.missed += !may_be;
      tally.wrong_holders += !result.held_by.empty();
      judge_registrations(bodies, particles, tally);
      return;
    }
    const bool is_by_face = std::any_of(result.held_by.begin(), result.held_by.end(),
                                        [](const Resident& r) { return r.feature == Body_feature::face; });
    tally.wrong_holders +=
        result.held_by.empty() || !std::is_sorted(result.held_by.begin(), result.held_by.end());
    for (const Resident& r : alone)
      tally.wrong_holders += !std::binary_search(result.held_by.begin(), result.held_by.end(), r);
    if (is_held_alone && !is_parted && !is_by_face)
      for (const Resident& r : result.held_by)
        tally.wrong_holders += !std::binary_search(alone.begin(), alone.end(), r) &&
                               !has_end_among(alone, r) && !is_held_together(alone, r);
    tally.by_choice += !is_held_alone && !is_parted;
    if (is_by_face && !is_held_alone) {
      ++tally.by_faces;
      tally.undecided += !is_parted;
    }
    tally.false_blocks += may_be && !(D == 3 && is_by_face);
  }

 private:
  /// An edge, or a particle as one of no length.
  class Segment {
   public:
    Segment(const Closing_judge& judge, const Particle<D>& p, const Particle<D>& q, const Chain& chain)
        : snapshot_(&judge.snapshot_),
          places_(judge.snapshot_, p.position, q.position),
          p_cell_(p.cell),
          q_cell_(q.cell),
          now_(places_.classes(judge.now_)),
          then_(places_.classes(judge.then_)) {
      const auto classes = places_.classes_of(now_, p.cell, {chain.begin(), chain.end()});
      if (!classes) throw std::logic_error("not a chain before");
      chain_ = *classes;
    }

    /// The sides on which the start may be then.
    std::set<Cell> starts() const { return allowed(0, p_cell_); }

    /// Sides of the ends between which there is a chain.
    std::set<std::pair<Cell, Cell>> relation() const {
      std::set<std::pair<Cell, Cell>> result;
      for (const Cell start : allowed(0, p_cell_)) {
        std::set<Cell> reached{start};
        for (std::size_t k = 1; k < places_.size(); ++k) {
          std::set<Cell> next;
          for (const Cell from : reached)
            for (const auto& [cell, least] : then_[k]) {
              if (next.contains(least)) continue;
              // Linked at the point: some cell of the piece is in the class of the point.
              const std::size_t point = k % 2 == 0 ? k : k - 1, piece = k % 2 == 0 ? k - 1 : k;
              const Cell of_point = k % 2 == 0 ? least : from, of_piece = k % 2 == 0 ? from : least;
              bool is_linked = false;
              for (const auto& [c, l] : then_[piece])
                is_linked |= l == of_piece && then_[point].contains(c) && then_[point].at(c) == of_point;
              if (!is_linked) continue;
              if (k % 2 == 1 && now_[k].at(least) != chain_[k / 2]) continue;
              next.insert(least);
            }
          reached = std::move(next);
        }
        for (const Cell end : reached)
          if (allowed(places_.size() - 1, q_cell_).contains(end)) result.insert({start, end});
      }
      return result;
    }

    /// True if a registration is one that the edge may have then.
    bool is_continued(const Particle<D>& p, const Particle<D>& q, const Chain& chain) const {
      if (!allowed(0, p_cell_).contains(class_at(0, p.cell)) ||
          !allowed(places_.size() - 1, q_cell_).contains(class_at(places_.size() - 1, q.cell)))
        return false;
      const auto after = places_.classes_of(then_, p.cell, {chain.begin(), chain.end()});
      const auto seen_now = places_.classes_of(now_, p.cell, {chain.begin(), chain.end()});
      if (!after || !seen_now || *seen_now != chain_) return false;
      Cell last = p.cell;
      for (const Half_facet f : chain) last = snapshot_->neighbour(f);
      return last == q.cell;
    }

   private:
    Cell class_at(std::size_t place, Cell c) const {
      const auto found = then_[place].find(c);
      return found == then_[place].end() ? Cell::none : found->second;
    }
    /// Classes then that are part of the class of a cell now.
    std::set<Cell> allowed(std::size_t place, Cell c) const {
      std::set<Cell> result;
      for (const auto& [cell, least] : then_[place])
        if (now_[place].at(cell) == now_[place].at(c)) result.insert(least);
      return result;
    }

    const Snapshot<D>* snapshot_;
    Segment_places<D> places_;
    Cell p_cell_, q_cell_;
    typename Segment_places<D>::Classes now_, then_;
    std::vector<Cell> chain_;
  };

  struct Of_body {
    std::vector<std::array<std::uint32_t, 2>> edges;
    std::vector<std::array<std::uint32_t, 3>> faces;
    bool has_faces = false;
    std::vector<Segment> vertices, segments;
    std::vector<std::array<Point<D>, 3>> corners;  ///< of faces
  };

  /// True if an edge holds with one of its ends.
  bool has_end_among(const std::vector<Resident>& alone, const Resident& r) const {
    if (r.is_particle || r.feature != Body_feature::edge) return false;
    const auto& ends = bodies_[r.owner].edges[r.number];
    return std::any_of(ends.begin(), ends.end(), [&](std::uint32_t v) {
      return std::binary_search(alone.begin(), alone.end(),
                                Resident{false, r.owner, Body_feature::vertex, v});
    });
  }

  /// True if the vertices and edges of a body each have a side alone, but not together.
  bool is_held_together(const std::vector<Resident>& alone, const Resident& r) const {
    const auto is_of_body = [&](const Resident& other) {
      return !other.is_particle && other.owner == r.owner;
    };
    if (r.is_particle || std::any_of(alone.begin(), alone.end(), is_of_body)) return false;
    std::vector<Cell> sides(bodies_[r.owner].vertices.size());
    return !can_be(bodies_[r.owner], sides, 0);
  }

  using Flat = std::array<Place<2>, 3>;
  /// True if an inner point of a segment lies inside a triangle.
  static bool enters(const Flat& triangle, const Place<2>& a, const Place<2>& b) {
    Interval part;
    const Fraction sense = volume(triangle).sign();
    std::array<Fraction, 3> at_a, at_b;
    for (std::size_t k = 0; k < 3; ++k) {
      at_a[k] = sense * volume({triangle[k], triangle[(k + 1) % 3], a});
      at_b[k] = sense * volume({triangle[k], triangle[(k + 1) % 3], b});
      keep_positive(part, at_a[k], at_b[k]);
      if (part.is_empty()) return false;
    }
    if (part.low == part.high) return false;
    const Fraction t = (part.low + part.high) / 2;
    for (std::size_t k = 0; k < 3; ++k)
      if (Fraction(at_a[k] + t * (at_b[k] - at_a[k])).sign() <= 0) return false;
    return true;
  }
  /// True if a new wall comes through a face, not in its plane.
  bool is_face_parted(const Of_body& of, std::uint32_t number) const {
    const auto& corners = of.corners[number];
    std::array<Place<D>, 3> face;
    for (std::size_t k = 0; k < 3; ++k) face[k] = exact_place<D>(corners[k], 0);
    const auto points_of = [&](std::span<const std::uint32_t> points) {
      std::vector<Place<D>> result;
      for (const std::uint32_t p : points) result.push_back(exact_place<D>(snapshot_.point(p), 0));
      return result;
    };
    if constexpr (D == 3) {
      std::size_t axis = 0;
      const auto flat = [&](const Place<3>& x) { return Place<2>{x[(axis + 1) % 3], x[(axis + 2) % 3]}; };
      const auto flat_face = [&] { return Flat{flat(face[0]), flat(face[1]), flat(face[2])}; };
      while (axis < 3 && volume(flat_face()).sign() == 0) ++axis;
      if (axis == 3) return false;
      return std::any_of(closed_.begin(), closed_.end(), [&](Half_facet f) {
        const auto x = points_of(snapshot_.loop(f));
        std::vector<Place<3>> ends;
        std::array<Fraction, 3> heights;
        bool is_above = false, is_below = false;
        for (std::size_t k = 0; k < 3; ++k) {
          heights[k] = volume({face[0], face[1], face[2], x[k]});
          is_above |= heights[k].sign() > 0;
          is_below |= heights[k].sign() < 0;
          if (heights[k].sign() == 0) ends.push_back(x[k]);
        }
        if (!is_above || !is_below) return false;
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t m = (k + 1) % 3;
          if (heights[k].sign() * heights[m].sign() >= 0) continue;
          const Fraction t = heights[k] / (heights[k] - heights[m]);
          Place<3> y;
          for (std::size_t c = 0; c < 3; ++c) y[c] = x[k][c] + t * (x[m][c] - x[k][c]);
          ends.push_back(y);
        }
        return enters(flat_face(), flat(ends[0]), flat(ends[1]));
      });
    }
    return false;
  }

  bool can_be(const Of_body& of, std::vector<Cell>& sides, std::size_t v) const {
    if (v == sides.size()) return true;
    for (const Cell side : of.vertices[v].starts()) {
      sides[v] = side;
      bool fits = true;
      for (std::uint32_t e = 0; e < of.edges.size() && fits; ++e) {
        const auto [a, b] = of.edges[e];
        if (std::max(a, b) != v) continue;
        fits = of.segments[e].relation().contains({sides[a], sides[b]});
      }
      if (fits && can_be(of, sides, v + 1)) return true;
    }
    return false;
  }

  void judge_registrations(const Bodies& bodies, std::span<const Particle<D>> particles,
                           Closing_tally& tally) const {
    for (std::size_t i = 0; i < particles.size(); ++i)
      tally.wrong_registrations += !particles_[i].is_continued(particles[i], particles[i], {});
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Of_body& of = bodies_[b];
      const auto now = bodies[b]->particles();
      for (std::size_t v = 0; v < now.size(); ++v)
        tally.wrong_registrations += !of.vertices[v].is_continued(now[v], now[v], {});
      for (std::size_t e = 0; e < of.edges.size(); ++e)
        tally.wrong_registrations +=
            !of.segments[e].is_continued(now[of.edges[e][0]], now[of.edges[e][1]], bodies[b]->chain(e));
    }
  }

  const Snapshot<D>& snapshot_;
  std::vector<Half_facet> closed_;
  Cell filled_;
  Passages now_, then_;
  std::vector<Of_body> bodies_;
  std::vector<Segment> particles_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_CLOSING_JUDGE_H
