// SPDX-License-Identifier: LGPL-3.0-or-later
// Methods on a hierarchy that keep boxes: the walls of an enlarged box are kept until what it was made for
// leaves it. Once for all hierarchies.
//
// Walls has the members
//   Candidate                       a wall triangle with `Float_box box`
//   Place                           a point, as its arithmetic takes it
//   void query(box, list)           appends the candidates whose boxes meet a box
//   Place place(point)
//   bool is_behind(candidate, place)            on the side of the triangle that is no free space
//   bool is_on_line(candidate, place, place)    the line of two points passes the triangle
// or, instead of the last two,
//   double radius                               that is kept from walls
//   bool is_near(candidate, place, place)       the segment of two points is nearer than that
#ifndef CELLWALK_EXPERIMENTS_REAL_SCENES_PEERS_KEPT_BOXES_H
#define CELLWALK_EXPERIMENTS_REAL_SCENES_PEERS_KEPT_BOXES_H

#include <algorithm>
#include <memory>
#include <utility>

#include "common/peers/float_box.h"
#include "common/peers/growing_box.h"
#include "peer.h"

namespace cellwalk::real_scenes {

using experiments::Box;
using experiments::Float_box;
using experiments::Growing_box;

/// A move of a vertex in its body.
struct Move {
  std::uint32_t vertex;
  const Point<3>* positions;  ///< of the body, now
  const Point<3>& target;
  std::span<const std::uint32_t> neighbours;

  const Point<3>& from() const { return positions[vertex]; }
};

inline Box box_of(const Move& move) {
  Growing_box box(move.from());
  box.add(move.target);
  for (const std::uint32_t q : move.neighbours) box.add(move.positions[q]);
  return box.box();
}

/// The box of all walls that may matter for what has a box.
template <class Walls>
Box reach_of(const Box& box, const Walls& walls) {
  if constexpr (requires { walls.radius; })
    return box.enlarged(walls.radius);
  else
    return box;
}

/// A part of a body with the walls near it.
template <class Candidate>
struct Kept_part {
  Box box = Box::nowhere();
  std::vector<Candidate> list;

  /// Makes sure that the list holds all walls that meet `now`.
  template <class Walls>
  void cover(const Box& now, double margin, Walls& walls) {
    if (box.contains(now)) return;
    box = now.enlarged(margin);
    list.clear();
    walls.query(box, list);
  }
};

/// Appends the candidates of a list whose boxes meet a box.
template <class Candidate>
void add_near(const Box& box, const std::vector<Candidate>& list, std::vector<const Candidate*>& near) {
  if (list.empty()) return;
  const Float_box rounded(box);
  for (const Candidate& c : list)
    if (meet(rounded, c.box)) near.push_back(&c);
}

/// Tests moves against candidates.
template <class Walls>
class Move_test {
 public:
  using Candidate = typename Walls::Candidate;
  using Place = typename Walls::Place;

  /// \param near candidates for a part of the body; those near the move are tested
  bool is_blocked(const Move& move, std::span<const Candidate* const> near, Walls& walls) {
    const Float_box box(reach_of(box_of(move), walls));
    met_.clear();
    for (const Candidate* c : near)
      if (meet(box, c->box)) met_.push_back(c);
    return !met_.empty() && is_blocked_by(move, met_, walls);
  }
  /// \param near all are tested
  bool is_blocked_by(const Move& move, std::span<const Candidate* const> near, Walls& walls) {
    const Place from = walls.place(move.from()), to = walls.place(move.target);
    if constexpr (requires { walls.radius; }) {
      for (const Candidate* c : near) {
        if (walls.is_near(*c, from, to)) return true;
        for (const std::uint32_t q : move.neighbours)
          if (walls.is_near(*c, to, walls.place(move.positions[q]))) return true;
      }
      return false;
    } else {
      return is_crossed(move, near, walls, from, to);
    }
  }

 private:
  bool is_crossed(const Move& move, std::span<const Candidate* const> near, const Walls& walls,
                  const Place& from, const Place& to) const {
    for (const Candidate* c : near) {
      const bool is_behind = walls.is_behind(*c, to);
      const auto crosses = [&](const Place& end) {
        return walls.is_behind(*c, end) != is_behind && walls.is_on_line(*c, to, end);
      };
      if (crosses(from)) return true;
      for (const std::uint32_t q : move.neighbours)
        if (crosses(walls.place(move.positions[q]))) return true;
    }
    return false;
  }

  std::vector<const Candidate*> met_;
};

/// A box is kept for each star of a vertex: what one move may meet. Without a margin nothing is kept, and
/// each move asks the hierarchy.
template <class Walls>
class Star_boxes : public Placed_peer {
 public:
  Star_boxes(const Motion& motion, std::shared_ptr<Walls> walls, double margin)
      : Placed_peer(motion), walls_(std::move(walls)), margin_(margin) {}

  void prepare() override { parts_.assign(margin_ > 0 ? motion_.trace.vertices() : 1, {}); }
  void step(std::span<const Point<3>> targets, std::span<std::uint8_t> blocked) override {
    for (std::size_t b = 0; b < motion_.bodies(); ++b) {
      const Lists& neighbours = motion_.joints[b]->neighbours;
      const std::size_t first = motion_.first_vertex[b];
      Point<3>* const x = positions_.data() + first;
      for (std::uint32_t v = 0; v < neighbours.size(); ++v) {
        const Move move{v, x, targets[first + v], neighbours[v]};
        const bool stays = is_blocked(move, parts_[margin_ > 0 ? first + v : 0]);
        blocked[first + v] = stays;
        if (!stays) x[v] = move.target;
      }
    }
  }

 private:
  using Part = Kept_part<typename Walls::Candidate>;

  bool is_blocked(const Move& move, Part& part) {
    const Box now = reach_of(box_of(move), *walls_);
    if (margin_ == 0) part.box = Box::nowhere();
    part.cover(now, margin_, *walls_);
    near_.clear();
    add_near(now, part.list, near_);
    return !near_.empty() && test_.is_blocked_by(move, near_, *walls_);
  }

  std::shared_ptr<Walls> walls_;
  double margin_;
  std::vector<Part> parts_;
  std::vector<const typename Walls::Candidate*> near_;
  Move_test<Walls> test_;
};

/// A box is kept for each body, or for each group of its vertices, with their neighbours. A step looks at the
/// boxes of all positions and targets, so it holds whatever moves.
template <class Walls>
class Group_boxes : public Placed_peer {
 public:
  Group_boxes(const Motion& motion, std::shared_ptr<Walls> walls, double margin, bool whole_bodies)
      : Placed_peer(motion), walls_(std::move(walls)), margin_(margin), whole_bodies_(whole_bodies) {
    std::size_t parts = 0, most = 1;
    for (const auto& joints : motion.joints) {
      first_part_.push_back(parts);
      parts += count_parts(*joints);
      most = std::max(most, count_parts(*joints));
    }
    first_part_.push_back(parts);
    near_.resize(most);
  }

  void prepare() override { parts_.assign(first_part_.back(), {}); }
  void step(std::span<const Point<3>> targets, std::span<std::uint8_t> blocked) override {
    for (std::size_t b = 0; b < motion_.bodies(); ++b) {
      const std::size_t first = motion_.first_vertex[b], count = motion_.first_vertex[b + 1] - first;
      step_body(b, targets.subspan(first, count), blocked.subspan(first, count));
    }
  }

 private:
  using Candidate = typename Walls::Candidate;

  std::size_t count_parts(const Joints& joints) const { return whole_bodies_ ? 1 : joints.groups.size(); }

  void step_body(std::size_t b, std::span<const Point<3>> targets, std::span<std::uint8_t> blocked) {
    const Joints& joints = *motion_.joints[b];
    Point<3>* const x = positions_.data() + motion_.first_vertex[b];
    if (!find_near(b, joints, x, targets)) {
      std::ranges::copy(targets, x);
      std::ranges::fill(blocked, std::uint8_t{0});
      return;
    }
    for (std::uint32_t v = 0; v < targets.size(); ++v) {
      const auto& near = near_[whole_bodies_ ? 0 : joints.group_of[v]];
      const bool stays =
          !near.empty() && test_.is_blocked({v, x, targets[v], joints.neighbours[v]}, near, *walls_);
      blocked[v] = stays;
      if (!stays) x[v] = targets[v];
    }
  }
  /// Finds the walls near each part of a body. False if there are none at all.
  bool find_near(std::size_t b, const Joints& joints, const Point<3>* x, std::span<const Point<3>> targets) {
    bool any = false;
    for (std::size_t part = 0; part < count_parts(joints); ++part) {
      const Box now =
          reach_of(whole_bodies_ ? whole_box(x, targets) : hull_box(joints.hulls[part], x, targets), *walls_);
      Kept_part<Candidate>& kept = parts_[first_part_[b] + part];
      kept.cover(now, margin_, *walls_);
      near_[part].clear();
      add_near(now, kept.list, near_[part]);
      any |= !near_[part].empty();
    }
    return any;
  }
  static Box whole_box(const Point<3>* x, std::span<const Point<3>> targets) {
    Growing_box box(x[0]);
    for (std::size_t v = 0; v < targets.size(); ++v) {
      box.add(x[v]);
      box.add(targets[v]);
    }
    return box.box();
  }
  static Box hull_box(std::span<const std::uint32_t> hull, const Point<3>* x,
                      std::span<const Point<3>> targets) {
    Growing_box box(x[hull[0]]);
    for (const std::uint32_t v : hull) {
      box.add(x[v]);
      box.add(targets[v]);
    }
    return box.box();
  }

  std::shared_ptr<Walls> walls_;
  double margin_;
  bool whole_bodies_;
  std::vector<std::size_t> first_part_;  ///< of each body, and their number
  std::vector<Kept_part<Candidate>> parts_;
  std::vector<std::vector<const Candidate*>> near_;  ///< of each part of the body in motion
  Move_test<Walls> test_;
};

/// All these methods on one hierarchy, under names that begin with that of its library.
template <class Walls>
void add_kept_boxes(const std::string& library, bool is_exact, const Motion& motion,
                    const std::shared_ptr<Walls>& walls, const Build& build, Peers& peers) {
  const auto add = [&](std::unique_ptr<Peer> peer, const std::string& kept, double margin) {
    peer->name = library + "_" + kept;
    peer->library = library;
    peer->is_exact = is_exact;
    peer->margin_steps = margin;
    peer->build = build;
    peers.push_back(std::move(peer));
  };
  add(std::make_unique<Star_boxes<Walls>>(motion, walls, 0), "move", 0);
  for (const double margin : margins) {
    const double length = margin * motion.step_length;
    add(std::make_unique<Star_boxes<Walls>>(motion, walls, length), "star", margin);
    add(std::make_unique<Group_boxes<Walls>>(motion, walls, length, false), "group", margin);
    add(std::make_unique<Group_boxes<Walls>>(motion, walls, length, true), "body", margin);
  }
}

}  // namespace cellwalk::real_scenes

#endif  // CELLWALK_EXPERIMENTS_REAL_SCENES_PEERS_KEPT_BOXES_H
