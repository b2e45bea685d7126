// SPDX-License-Identifier: LGPL-3.0-or-later
// The decision whether a vertex of the environment may move among residents, and how they are registered
// then.
#ifndef CELLWALK_RESHAPE_MOVE_VERTEX_TRIAL_H
#define CELLWALK_RESHAPE_MOVE_VERTEX_TRIAL_H

#include <cellwalk/internal/edge/face_at_star.h>
#include <cellwalk/internal/edge/follow_edge.h>
#include <cellwalk/internal/edge/moving_star.h>
#include <cellwalk/reshape/move.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "reshape/residents/resident_groups.h"

namespace cellwalk::detail {

/// One after the other: run() decides about a move, prepare() finds the memory that commit() needs, and
/// commit() registers the residents that the move touched. Kept for its memory.
template <int D>
class Vertex_trial {
 public:
  Vertex_trial(Resident_groups<D>& groups, Reshape_counts& counts) : groups_(groups), counts_(counts) {}

  /// True if the vertex of a star may move.
  /// \param cells the cells around it
  /// \param any if true, the first obstruction found will do, and no collision is located
  bool run(const Moving_star<D>& star, std::span<const Cell> cells, bool any);
  /// The first collision; none if the vertex may move, or if walls only touch something.
  const std::optional<Collision>& collision() const { return first_; }
  /// The number of residents that run() looked at by the first choice of sides, and of those that
  /// certificates decided.
  std::uint64_t near() const { return near_; }
  std::uint64_t certified() const { return certified_; }
  /// Before commit(), since it takes memory. If no commit() follows, it does no harm.
  void prepare();
  /// Registers the residents near.
  /// \pre run() was true, or clear() was called; then prepare() was
  void commit() noexcept;
  /// Nothing is near.
  void clear() {
    moved_.clear();
    chains_.clear();
    supporting_walls_.clear();
  }

 private:
  struct Moved_vertex {
    Member member;
    Particle<D> now;
    std::vector<Cell_until> stays;  ///< if it was followed
    bool keeps_cell, is_free;
    std::size_t taken = 0;   ///< its side
    std::size_t choice = 0;  ///< the number of its combined choice, from 1 on; 0 if it has none
  };
  void find_groups_near(const Moving_star<D>& star);
  bool try_group(const Moving_star<D>& star, std::uint32_t group);
  void note_first_choice(const Reshape_counts& before);
  bool goes_further_than(const std::optional<Collision>& other) const;
  bool try_vertices(const Moving_star<D>& star, std::span<const Member> vertices);
  bool try_vertex(const Moving_star<D>& star, Moved_vertex& vertex);
  void follow_kept(const Moving_star<D>& star, std::initializer_list<const Moved_vertex*> vertices);
  bool try_edges(const Moving_star<D>& star, std::span<const Member> edges);
  bool has_faces_near(const Moving_star<D>& star, std::uint32_t number) const;
  void try_faces(const Moving_star<D>& star, std::uint32_t number);
  bool try_edge(const Moving_star<D>& star, Member edge);
  Followed_vertex<D> follow(const Moving_star<D>& star, Member vertex);
  Followed_edge follow(const Moving_star<D>& star, Member edge, const Moved_vertex* moved_p,
                       const Moved_vertex* moved_q);
  Followed_edge follow_anew(const Moving_star<D>& star, Member edge, const Moved_vertex* moved_p,
                            const Moved_vertex* moved_q);
  bool try_face(const Moving_star<D>& star, Member face, std::span<const Point<D>> points);
  Face_at_star after(const Moving_star<D>& star, Member face, std::span<const Point<D>> points);
  void block(Star_meeting met, Member member, std::initializer_list<const Moved_vertex*> vertices);
  bool try_combinations(const std::function<bool()>& try_choice, std::optional<Collision>& last);
  bool take_next();
  std::size_t choice_of_next() const;
  void note_choices(std::size_t choices);
  template <class Starts>
  bool meets(const Moving_star<D>& star, std::span<const Point<D>> points, const Starts& keeps_at_start,
             Star_meeting& met) const;
  void take(std::optional<Collision>& collision, Star_meeting& met) const;
  const Moved_vertex* find(Member vertex) const;

  Resident_groups<D>& groups_;
  Reshape_counts& counts_;
  /// The number of choices that are tried where vertices and edges of a body may be on several sides of
  /// walls, each for all of them, and then that of combinations.
  static constexpr std::size_t most_choices = 4;
  static constexpr std::size_t most_combinations = 256;
  std::size_t choice_ = 0, choices_ = 1;
  bool follows_all_ = false;   ///< also vertices that keep their cells
  std::size_t dead_ends_ = 0;  ///< the most sides on which a vertex is blocked after a while, not on others
  bool to_dead_end_ = false;   ///< these are tried
  /// The side that a followed vertex takes, of as many, where each takes its own.
  struct Choice {
    std::size_t sides, taken;
    std::set<std::size_t> blamed{};  ///< those before it on which depends what blocked on the sides taken
  };
  std::vector<Choice> combined_;
  /// By member and choices of vertices, since combinations repeat them.
  std::map<std::tuple<Member, std::size_t>, Followed_vertex<D>> followed_vertices_;
  std::map<std::tuple<Member, std::size_t, std::size_t>, Followed_edge> followed_edges_;
  bool combines_ = false;         ///< each takes its own
  std::size_t passed_ = 0;        ///< of the combined choices, by this trial
  std::size_t with_choice_ = 0;   ///< vertices that have one, by this trial
  std::set<std::size_t> blamed_;  ///< only another one of these choices may let it pass
  bool any_ = false;
  std::uint64_t near_ = 0, certified_ = 0;
  // By the present choice:
  bool is_free_ = true;
  std::optional<Collision> collision_;
  std::optional<Collision> first_;
  std::vector<Member> vertices_, edges_;
  std::vector<std::uint32_t> groups_near_;
  Chain in_star_;                    ///< facets of a chain that have the vertex
  std::vector<Moved_vertex> moved_;  ///< of all in the star, in order
  std::vector<std::pair<Member, Chain>> chains_;
  std::vector<std::pair<Member, Supporting_walls>> supporting_walls_;
};

extern template class Vertex_trial<2>;
extern template class Vertex_trial<3>;

}  // namespace cellwalk::detail

#endif  // CELLWALK_RESHAPE_MOVE_VERTEX_TRIAL_H
