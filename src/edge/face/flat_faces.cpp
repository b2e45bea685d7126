// SPDX-License-Identifier: LGPL-3.0-or-later
// Sides handed on among the faces and edges in one plane until they agree, or a wall parts them.
#include <cellwalk/internal/edge/flat_faces.h>
#include <cellwalk/internal/edge/swept_triangle.h>
#include <cellwalk/internal/kernel/predicates.h>

#include <algorithm>
#include <array>
#include <memory>

#include "borders.h"
#include "ridge_wedges.h"
#include "supporting_wall_search.h"

namespace cellwalk::detail {
namespace {

/// All that p takes along in one plane that holds its way: the faces and edges in it move in it, and the
/// other ones are on one side of it. Each of the former is on one side of each group of walls that its
/// interior meets on the way. Two that are joined are on the same side of a wall that has inner points in the
/// area that the common edge sweeps, or on the way of p; and in one wedge where walls have a ridge on that
/// way.
class Motion_in_plane {
 public:
  /// \param flat a face that moves in the plane
  Motion_in_plane(const Snapshot<3>& snapshot, const Vertex_path<3>& path,
                  std::span<const Edge_at_vertex> edges, std::span<const Face_at_vertex> faces,
                  std::size_t flat, Ridge_wedges* wedges, Face_counts& counts)
      : snapshot_(snapshot),
        path_(path),
        edges_(edges),
        faces_(faces),
        wedges_(wedges),
        counts_(counts),
        plane_(triangle_of(is_in_line(faces[flat].pq) ? faces[flat].pr : faces[flat].pq), counts.walk) {
    of_edge_.resize(edges.size());
    for (std::size_t e = 0; e < edges.size(); ++e)
      if (height(e) == 0 && !is_in_line(e)) add_edge(e);
    for (std::size_t f = 0; f < faces.size(); ++f)
      if (has_face(f)) add_face(f);
  }

  bool has_face(std::size_t f) const {
    return height(faces_[f].pq) == 0 && height(faces_[f].pr) == 0 &&
           !(is_in_line(faces_[f].pq) && is_in_line(faces_[f].pr));
  }

  /// Determines all sides. Returns a wall for which there is none.
  Half_facet settle() {
    bind();
    for (;;) {
      const Half_facet wall = spread();
      if (wall != Half_facet::none) return wall;
      if (std::ranges::none_of(parts_, [](const auto& part) { return part->search->choose_next(); }))
        return Half_facet::none;
    }
  }

  void append_to(Flat_faces& result) const {
    for (const auto& part : parts_) {
      if (!part->is_face) continue;
      auto& [face, walls] = result.supporting_walls.emplace_back();
      face = part->number;
      if (!part->has_interior) continue;
      const Supporting_walls found = part->search->under_face();
      walls.assign(found.begin(), found.end());
    }
  }

 private:
  /// A face or an edge that moves in the plane.
  struct Part {
    bool is_face;
    std::size_t number;
    bool has_interior = true;  ///< of a face, in the end
    Swept_in_plane swept{};
    std::optional<Triangle_in_plane> triangle{};
    std::optional<Supporting_wall_search> search{};
  };

  const Point<3>& a() const { return path_.from.position; }
  const Point<3>& b() const { return path_.to.position; }
  const Point<3>& end(std::size_t e) const { return edges_[e].end.position; }
  std::array<Point<3>, 3> triangle_of(std::size_t e) const { return {a(), b(), end(e)}; }
  bool is_in_line(std::size_t e) const { return are_collinear(a(), b(), end(e)); }
  int height(std::size_t e) const { return plane_.side(end(e)); }

  void add(std::unique_ptr<Part> part, const Corners& corners) {
    Candidate_walls candidates(path_.from.cell);
    find_candidate_walls(snapshot_, corners, candidates, counts_);
    part->search.emplace(snapshot_, *part->triangle, part->swept, candidates);
    parts_.push_back(std::move(part));
  }

  void add_edge(std::size_t e) {
    auto part = std::make_unique<Part>(Part{false, e});
    part->triangle.emplace(triangle_of(e), counts_.walk);
    part->swept.push_back(*part->triangle);
    of_edge_[e] = part.get();
    add(std::move(part), {a(), b(), end(e), end(e)});
    Supporting_wall_search& search = *parts_.back()->search;
    search.follow({{&edges_[e].before}, a(), end(e), path_.from.cell});
    search.follow({{edges_[e].after}, b(), end(e), path_.to.cell});
  }

  void add_face(std::size_t f) {
    const Face_at_vertex& face = faces_[f];
    const Particle<3>&q = edges_[face.pq].end, &r = edges_[face.pr].end;
    auto part = std::make_unique<Part>(Part{true, f, !are_collinear(b(), q.position, r.position)});
    const Corners corners{a(), b(), q.position, r.position};
    part->swept = swept_in_plane(corners, counts_.walk);
    if (part->has_interior)
      part->triangle.emplace(std::array{b(), q.position, r.position}, counts_.walk);
    else
      part->triangle.emplace(part->swept.front());
    add(std::move(part), corners);
    Supporting_wall_search& search = *parts_.back()->search;
    search.keep(*face.known);
    const Face_chains chains{{edges_[face.pq].after, false}, face.qr, {edges_[face.pr].after, true}};
    for (const Face_side& side : sides_of(chains, path_.to, q, r)) search.follow(side);
  }

  /// The given half-facets that have inner points on the way of p or, for an edge in its line, on the way of
  /// the edge.
  std::vector<Half_facet> along(std::vector<Half_facet> halves, const std::size_t* edge) const {
    std::erase_if(halves, [&](Half_facet f) {
      const Cell_view<3> cell = snapshot_.view(snapshot_.cell_of(f));
      const auto has = [&](const Point<3>& u, const Point<3>& v) {
        return u != v && plane_.has_inside(cell, snapshot_.facet_of(f), u, v);
      };
      return !has(a(), b()) && (edge == nullptr || (!has(a(), end(*edge)) && !has(b(), end(*edge))));
    });
    return halves;
  }

  /// The faces in the plane at an edge in the line of the way.
  std::vector<Part*> faces_at(std::size_t e) const {
    std::vector<Part*> found;
    for (const auto& part : parts_)
      if (part->is_face && (faces_[part->number].pq == e || faces_[part->number].pr == e))
        found.push_back(part.get());
    return found;
  }
  std::vector<Part*> moving_edges() const {
    std::vector<Part*> found;
    for (Part* const part : of_edge_)
      if (part != nullptr) found.push_back(part);
    return found;
  }

  /// Puts a part on a side of the plane, at all walls that it meets or those along a line.
  void bind(Part& part, int side, bool is_along, const std::size_t* edge = nullptr) {
    const int own = side * plane_.fixed_side() * part.triangle->fixed_side();
    const std::vector<Half_facet> halves = part.search->halves_at(own);
    for (const Half_facet half : is_along ? along(halves, edge) : halves) part.search->take(half);
  }

  /// An edge or face that ends off the plane fixes the side on which the parts joined to it may be.
  void bind() {
    const std::vector<Part*> moving = moving_edges();
    for (std::size_t e = 0; e < edges_.size(); ++e)
      if (height(e) != 0) bind(*moving.front(), height(e), true);
    for (const Face_at_vertex& face : faces_)
      for (const auto& [e, other] : {std::pair(face.pq, face.pr), std::pair(face.pr, face.pq)}) {
        if (height(e) != 0 || height(other) == 0) continue;
        if (of_edge_[e] != nullptr)
          bind(*of_edge_[e], height(other), false);
        else
          for (Part* const part : faces_at(e)) bind(*part, height(other), true, &e);
      }
  }

  /// Hands sides on from part to part, until nothing is new. Returns a wall for which there is none.
  Half_facet spread() {
    for (bool is_new = true; is_new;) {
      is_new = false;
      const auto hand = [&](const Part& from, Part& to, auto select) {
        for (const Half_facet half : select(from.search->taken())) is_new |= to.search->take(half);
      };
      const auto join = [&](Part& one, Part& other, auto select) {
        hand(one, other, select);
        hand(other, one, select);
      };
      for (const auto& part : parts_)
        if (part->is_face)
          for (const std::size_t e : {faces_[part->number].pq, faces_[part->number].pr})
            if (of_edge_[e] != nullptr)  // the edge meets all that is taken, or has no place for it
              join(*part, *of_edge_[e], [](std::vector<Half_facet> halves) { return halves; });
      const std::vector<Part*> moving = moving_edges();
      for (Part* const part : moving)
        if (part != moving.front())
          join(*moving.front(), *part, [&](auto halves) { return along(std::move(halves), nullptr); });
      for (std::size_t e = 0; e < edges_.size(); ++e) {
        if (height(e) != 0 || of_edge_[e] != nullptr) continue;
        const std::vector<Part*> at_edge = faces_at(e);
        for (Part* const part : at_edge)
          if (part != at_edge.front())
            join(*at_edge.front(), *part, [&](auto halves) { return along(std::move(halves), &e); });
      }
      if (wedges_ != nullptr) is_new |= spread_to_wedges();
      for (const auto& part : parts_)
        if (part->search->piercing() != Half_facet::none) return part->search->piercing();
    }
    return Half_facet::none;
  }

  /// Between the parts in the plane and those held on the way, also off the plane.
  bool spread_to_wedges() {
    bool is_new = false;
    for (const auto& part : parts_)
      for (const Half_facet half : part->search->taken()) wedges_->hold_side(half);
    for (const auto& part : parts_)
      for (const int side : {-1, 1})
        for (const Half_facet half : part->search->halves_at(side))
          if (wedges_->needs(half)) is_new |= part->search->take(half);
    return is_new;
  }

  const Snapshot<3>& snapshot_;
  const Vertex_path<3>& path_;
  std::span<const Edge_at_vertex> edges_;
  std::span<const Face_at_vertex> faces_;
  Ridge_wedges* wedges_;  ///< null if all that p takes along is joined
  Face_counts& counts_;
  Triangle_in_plane plane_;
  std::vector<std::unique_ptr<Part>> parts_;
  std::vector<Part*> of_edge_;  ///< null for edges off the plane, or in the line of the way
};

bool moves_in_its_plane(const Vertex_path<3>& path, const Point<3>& q, const Point<3>& r,
                        Face_counts& counts) {
  return Exact::orientation(counts.walk.predicates, path.from.position, path.to.position, q, r) == 0;
}

/// With all edges, and all faces that move off their plane; none if walls part nothing. Where an edge has no
/// face, its chain determines its wedge, also if it lies in a wall or in the line of the way; and that was
/// followed from the cells through which p walks.
std::optional<Ridge_wedges> wedges_on_way(const Snapshot<3>& snapshot, const Vertex_path<3>& path,
                                          std::span<const Edge_at_vertex> edges,
                                          std::span<const Face_at_vertex> faces, Face_counts& counts) {
  std::optional<Ridge_wedges> wedges(std::in_place, snapshot, path, counts);
  if (wedges->is_empty()) return {};
  std::vector<bool> has_face(edges.size());
  for (const Face_at_vertex& face : faces) has_face[face.pq] = has_face[face.pr] = true;
  if (std::ranges::find(has_face, false) != has_face.end()) wedges->hold_path(path);
  for (const Edge_at_vertex& edge : edges)
    if (!are_collinear(path.from.position, path.to.position, edge.end.position))
      wedges->hold_edge(edge.end.position);
  for (const Face_at_vertex& face : faces) {
    const Point<3>&q = edges[face.pq].end.position, &r = edges[face.pr].end.position;
    if (!moves_in_its_plane(path, q, r, counts)) wedges->hold_face(q, r);
  }
  return wedges;
}

}  // namespace

std::optional<Contact<3>> wall_between_parts(const Snapshot<3>& snapshot, const Vertex_path<3>& path,
                                             std::span<const Edge_at_vertex> edges,
                                             std::span<const Face_at_vertex> faces, Face_counts& counts) {
  const auto wedges = wedges_on_way(snapshot, path, edges, faces, counts);
  return wedges ? wedges->conflict() : std::nullopt;
}

Flat_faces find_flat_faces(const Snapshot<3>& snapshot, const Vertex_path<3>& path,
                           std::span<const Edge_at_vertex> edges, std::span<const Face_at_vertex> faces,
                           bool are_joined, Face_counts& counts) {
  const Point<3>&a = path.from.position, &b = path.to.position;
  Flat_faces result;
  std::optional<Ridge_wedges> wedges =
      are_joined ? std::nullopt : wedges_on_way(snapshot, path, edges, faces, counts);
  std::vector<bool> is_done(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Point<3>&q = edges[faces[f].pq].end.position, &r = edges[faces[f].pr].end.position;
    if (is_done[f] || !moves_in_its_plane(path, q, r, counts) ||
        (are_collinear(a, b, q) && are_collinear(a, b, r)))
      continue;
    Motion_in_plane motion(snapshot, path, edges, faces, f, wedges ? &*wedges : nullptr, counts);
    for (std::size_t g = f; g < faces.size(); ++g)
      if (motion.has_face(g)) is_done[g] = true;
    const Half_facet wall = motion.settle();
    if (wall != Half_facet::none)
      result.contact = contact_at_start(snapshot, wall, a);
    else if (wedges)
      result.contact = wedges->conflict();
    if (result.contact) {
      result.face = f;
      return result;
    }
    motion.append_to(result);
  }
  return result;
}

}  // namespace cellwalk::detail
