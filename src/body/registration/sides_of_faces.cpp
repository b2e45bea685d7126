// SPDX-License-Identifier: LGPL-3.0-or-later
// Faces and lone edges in turn, each on all sides that those before it leave, until one passes; then back to
// the last that has another choice.
#include "sides_of_faces.h"

#include <cellwalk/internal/edge/all_chains.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

#include "body/shape/body_faces.h"

namespace cellwalk::detail {
namespace {

class Face_sides {
 public:
  using Sides = std::vector<Particle<3>>;

  Face_sides(Body_state<3>& body, const std::vector<Sides>& sides)
      : body_(body), sides_(sides), side_(sides.size(), 0), chain_(body.chains.size(), 0) {
    for (std::uint32_t v = 0; v < sides.size(); ++v)
      if (sides[v].size() > 1) side_[v] = unset;
    for (std::uint32_t e = 0; e < chain_.size(); ++e)
      if (has_choice(e)) chain_[e] = unset;
    order();
  }

  Side_search run() {
    const auto particles = body_.particles;
    const auto chains = body_.chains;
    const auto walls = body_.supporting_walls;
    for (Supporting_walls& of_face : body_.supporting_walls) of_face.clear();
    if (!have_ended_ && place(0)) {
      for (std::uint32_t v = 0; v < side_.size(); ++v)
        if (side_[v] == unset) take_side(v, 0);  // of no edge
      for (std::uint32_t e = 0; e < chain_.size(); ++e) body_.set_chain(e, Chain(body_.chains[e]));
      Face_counts uncounted;
      if (register_faces(body_, uncounted).empty()) return Side_search::found;
    }
    body_.particles = particles;
    for (std::uint32_t e = 0; e < chain_.size(); ++e) body_.set_chain(e, chains[e]);
    body_.supporting_walls = walls;
    return have_ended_ ? Side_search::ended : Side_search::none;
  }

 private:
  static constexpr std::uint32_t unset = 0xffffffffu;
  /// The deepest search: each part takes some calls within those of the one before, and stacks of threads are
  /// small.
  static constexpr std::size_t most_parts = 1'000;

  /// A face, or an edge of none.
  struct Part {
    bool is_face;
    std::uint32_t number;
  };

  const std::vector<Chain>& chains_between(std::uint32_t e, std::uint32_t i, std::uint32_t j) {
    const auto [known, is_new] = chains_.try_emplace({e, i, j});
    if (is_new) {
      const auto [u, v] = body_.topology.edges()[e];
      known->second = all_chains(*body_.snapshot, sides_[u][i], sides_[v][j], walks_);
    }
    return known->second;
  }
  bool has_choice(std::uint32_t e) {
    const auto [u, v] = body_.topology.edges()[e];
    return side_[u] == unset || side_[v] == unset || chains_between(e, 0, 0).size() > 1;
  }
  bool has_choice(const Part& part) const {
    if (!part.is_face) return chain_[part.number] == unset;
    return std::ranges::any_of(body_.topology.sides(part.number),
                               [&](std::uint32_t e) { return chain_[e] == unset; });
  }

  /// Faces in the order in which they follow from each other, so that one that does not pass is met soon
  /// after the choice that it depends on; then the edges of none.
  void order() {
    const auto& faces = body_.topology.faces();
    std::vector<char> is_seen(faces.size(), 0), has_face(chain_.size(), 0);
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
      for (const std::uint32_t e : body_.topology.sides(f)) has_face[e] = 1;
      enter_face(f, is_seen);
      for (; next_ < parts_.size(); ++next_) {
        const std::uint32_t of = parts_[next_].number;
        for (const std::uint32_t v : faces[of])
          if (side_[v] == unset || is_at_choice(of, v))
            for (const auto& corner : body_.topology.face_corners_of(v)) enter_face(corner.face, is_seen);
      }
    }
    for (std::uint32_t e = 0; e < chain_.size(); ++e)
      if (!has_face[e] && chain_[e] == unset) parts_.push_back({false, e});
    have_ended_ = parts_.size() > most_parts;
  }
  bool is_at_choice(std::uint32_t f, std::uint32_t v) const {
    return std::ranges::any_of(body_.topology.sides(f), [&](std::uint32_t e) {
      const auto& ends = body_.topology.edges()[e];
      return chain_[e] == unset && (ends[0] == v || ends[1] == v);
    });
  }
  void enter_face(std::uint32_t f, std::vector<char>& is_seen) {
    if (is_seen[f] || !has_choice({true, f})) return;
    is_seen[f] = 1;
    parts_.push_back({true, f});
  }

  void take_side(std::uint32_t v, std::uint32_t side) {
    side_[v] = side;
    body_.particles[v] = sides_[v][side];
  }

  /// True if the k-th part and all after it pass on some sides.
  bool place(std::size_t k) {
    if (k == parts_.size()) return true;
    const Part part = parts_[k];
    if (!part.is_face) {
      const auto ends = body_.topology.edges()[part.number];
      return try_sides({ends[0], ends[1], ends[1]}, 0, k);
    }
    return try_sides(body_.topology.faces()[part.number], 0, k);
  }
  bool try_sides(const std::array<std::uint32_t, 3>& corners, std::size_t i, std::size_t k) {
    if (i == 3) return try_chains(0, k);
    const std::uint32_t v = corners[i];
    if (side_[v] != unset) return try_sides(corners, i + 1, k);
    for (std::uint32_t side = 0; side < sides_[v].size() && !have_ended_; ++side) {
      take_side(v, side);
      if (try_sides(corners, i + 1, k)) return true;
    }
    side_[v] = unset;
    return false;
  }
  bool try_chains(std::size_t i, std::size_t k) {
    const Part part = parts_[k];
    if (i == (part.is_face ? 3u : 1u)) return passes(part) && place(k + 1);
    const std::uint32_t e = part.is_face ? body_.topology.sides(part.number)[i] : part.number;
    if (chain_[e] != unset) return try_chains(i + 1, k);
    const auto [u, v] = body_.topology.edges()[e];
    const std::vector<Chain>& chains = chains_between(e, side_[u], side_[v]);
    for (std::uint32_t c = 0; c < chains.size() && !have_ended_; ++c) {
      chain_[e] = c;
      body_.chains[e] = chains[c];
      if (try_chains(i + 1, k)) return true;
    }
    chain_[e] = unset;
    return false;
  }
  bool passes(const Part& part) {
    if (!part.is_face) return true;
    have_ended_ |= ++tests_ > most_face_tests;
    return !have_ended_ && registered_face(body_, part.number, faces_).piercing == Half_facet::none;
  }

  Body_state<3>& body_;
  const std::vector<Sides>& sides_;
  std::vector<std::uint32_t> side_, chain_;  ///< taken by each vertex and edge, or unset
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::vector<Chain>> chains_;
  std::vector<Part> parts_;
  std::size_t next_ = 0;  ///< part whose neighbours are entered next
  std::size_t tests_ = 0;
  bool have_ended_ = false;
  Walk_counts walks_;
  Face_counts faces_;
};

}  // namespace

Side_search find_sides_of_faces(Body_state<3>& body, const std::vector<std::vector<Particle<3>>>& sides) {
  return Face_sides(body, sides).run();
}

}  // namespace cellwalk::detail
