// SPDX-License-Identifier: LGPL-3.0-or-later
// Sides of vertices and chains of edges are chosen one after the other. A face is tested when the last of its
// own is chosen; where it does not pass, that choice is changed.
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
    for (std::uint32_t e = 0; e < chain_.size(); ++e) {
      const auto [u, v] = body.topology.edges()[e];
      if (side_[u] == unset || side_[v] == unset || chains_between(e, 0, 0).size() > 1) chain_[e] = unset;
    }
    order();
  }

  Side_search run() {
    const auto particles = body_.particles;
    const auto chains = body_.chains;
    const auto walls = body_.supporting_walls;
    for (Supporting_walls& of_face : body_.supporting_walls) of_face.clear();
    if (choose_all()) {
      for (std::uint32_t e = 0; e < chain_.size(); ++e) body_.set_chain(e, Chain(body_.chains[e]));
      Face_counts uncounted;
      if (register_faces(body_, uncounted).empty()) return Side_search::found;
    }
    body_.particles = particles;
    for (std::uint32_t e = 0; e < chain_.size(); ++e) body_.set_chain(e, chains[e]);
    body_.supporting_walls = walls;
    return are_all_tried_ ? Side_search::none : Side_search::ended;
  }

 private:
  static constexpr std::uint32_t unset = 0xffffffffu;

  /// The side of a vertex or the chain of an edge.
  struct Choice {
    bool is_of_edge;
    std::uint32_t number;
    bool is_first;                     ///< neither it nor those after it depend on any before it
    std::vector<std::uint32_t> faces;  ///< all whose last choice it is
  };

  const std::vector<Chain>& chains_between(std::uint32_t e, std::uint32_t i, std::uint32_t j) {
    const auto [known, is_new] = chains_.try_emplace({e, i, j});
    if (is_new) {
      const auto [u, v] = body_.topology.edges()[e];
      known->second = all_chains(*body_.snapshot, sides_[u][i], sides_[v][j], walks_);
    }
    are_all_tried_ &= known->second.are_all;
    return known->second.chains;
  }

  /// All choices, those that have to do with each other together. Faces are entered from those with which
  /// they share choices, so that one that does not pass is met soon after the choice that it depends on.
  void order() {
    const auto& faces = body_.topology.faces();
    const auto& edges = body_.topology.edges();
    faces_at_.resize(edges.size());
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      for (const std::uint32_t e : body_.topology.sides(f)) faces_at_[e].push_back(f);
    // Parts are the faces, and then the edges.
    const auto face_count = static_cast<std::uint32_t>(faces.size());
    std::vector<char> is_part_seen(faces.size() + edges.size(), 0), is_vertex_seen(side_.size(), 0),
        is_edge_seen(edges.size(), 0);
    std::vector<std::uint32_t> parts;
    const auto enter = [&](std::uint32_t part) {
      if (!std::exchange(is_part_seen[part], 1)) parts.push_back(part);
    };
    for (std::uint32_t first = 0; first < is_part_seen.size(); ++first) {
      bool is_first = true;
      const auto add = [&](bool is_of_edge, std::uint32_t number) {
        choices_.push_back({is_of_edge, number, std::exchange(is_first, false), {}});
      };
      parts.clear();
      enter(first);
      for (std::size_t next = 0; next < parts.size(); ++next) {
        const bool is_face = parts[next] < face_count;
        const std::uint32_t n = is_face ? parts[next] : parts[next] - face_count;
        const auto of_part = [&](const auto& of_face, const auto& of_edge) {
          using Numbers = std::vector<std::uint32_t>;
          return is_face ? Numbers(of_face.begin(), of_face.end()) : Numbers(of_edge.begin(), of_edge.end());
        };
        for (const std::uint32_t v : of_part(faces[n], edges[n])) {
          if (side_[v] != unset || std::exchange(is_vertex_seen[v], 1)) continue;
          add(false, v);
          for (const auto& corner : body_.topology.face_corners_of(v)) enter(corner.face);
          for (const Corner& corner : body_.topology.corners_of(v)) enter(face_count + corner.edge);
        }
        for (const std::uint32_t e : of_part(body_.topology.sides(n), std::array{n})) {
          if (chain_[e] != unset || std::exchange(is_edge_seen[e], 1)) continue;
          add(true, e);
          for (const std::uint32_t f : faces_at_[e]) enter(f);
        }
      }
    }
    std::vector<char> is_face_seen(faces.size(), 0);
    for (auto choice = choices_.rbegin(); choice != choices_.rend(); ++choice) {
      if (!choice->is_of_edge) continue;  // those of its edges come later
      for (const std::uint32_t f : faces_at_[choice->number])
        if (!std::exchange(is_face_seen[f], 1)) choice->faces.push_back(f);
    }
    for (std::uint32_t f = 0; f < faces.size(); ++f)
      if (!is_face_seen[f]) without_choice_.push_back(f);
  }

  /// True if all faces pass. Those that do not depend on each other are searched one after the other.
  bool choose_all() {
    are_all_tried_ = true;
    if (!pass(without_choice_)) return false;
    const std::size_t most = most_steps_back + most_steps_back_of_choice * choices_.size();
    for (std::size_t k = 0, steps_back = 0; k < choices_.size();) {
      if (!take_next(choices_[k])) {
        if (choices_[k].is_first) return false;
        --k;
        ++steps_back;
      } else if (!pass(choices_[k].faces)) {
        ++steps_back;
      } else if (++k < choices_.size() && choices_[k].is_first) {
        are_all_tried_ = true;
      }
      if (steps_back > most) return are_all_tried_ = false;
    }
    return true;
  }
  /// Takes the next side or chain, the first one after the last. False if there was none left.
  bool take_next(const Choice& choice) {
    const std::uint32_t n = choice.number;
    std::uint32_t& taken = choice.is_of_edge ? chain_[n] : side_[n];
    ++taken;
    if (!choice.is_of_edge) {
      if (taken == sides_[n].size()) return reset(taken);
      body_.particles[n] = sides_[n][taken];
    } else {
      const auto [u, v] = body_.topology.edges()[n];
      const std::vector<Chain>& chains = chains_between(n, side_[u], side_[v]);
      if (taken == chains.size()) return reset(taken);
      body_.chains[n] = chains[taken];
    }
    return true;
  }
  static bool reset(std::uint32_t& taken) {
    taken = unset;
    return false;
  }
  bool pass(const std::vector<std::uint32_t>& faces) {
    return std::ranges::all_of(faces, [&](std::uint32_t f) {
      return registered_face(body_, f, face_counts_).piercing == Half_facet::none;
    });
  }

  Body_state<3>& body_;
  const std::vector<Sides>& sides_;
  std::vector<std::uint32_t> side_, chain_;  ///< taken by each vertex and edge, or unset
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, All_chains> chains_;
  std::vector<std::vector<std::uint32_t>> faces_at_;  ///< each edge
  std::vector<Choice> choices_;
  std::vector<std::uint32_t> without_choice_;  ///< faces
  bool are_all_tried_ = true;
  Walk_counts walks_;
  Face_counts face_counts_;
};

}  // namespace

Side_search find_sides_of_faces(Body_state<3>& body, const std::vector<std::vector<Particle<3>>>& sides) {
  return Face_sides(body, sides).run();
}

}  // namespace cellwalk::detail
