// SPDX-License-Identifier: LGPL-3.0-or-later
// The sides of faces on which walls lie that have landed on them: knows walls only, in rational numbers.
#ifndef CELLWALK_TESTS_RESHAPE_FACE_SIDES_H
#define CELLWALK_TESTS_RESHAPE_FACE_SIDES_H

#include <cellwalk/reshape/reshaping.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <tuple>

#include "kernel/rational_meeting.h"

namespace cellwalk::test {

template <class World>
class Face_sides {
 public:
  explicit Face_sides(const World& world) : world_(world) {}

  /// True if a wall at a vertex lies in a face, and a move would take it to where the face is.
  /// \pre the vertex has not moved yet
  bool is_passed(std::uint32_t v, const Point<3>& target) const {
    const Point<3> from = world_.snapshot.point(v);
    bool result = false;
    for_each(v, [&](const Key& key, const Triangle& face, Triangle wall) {
      wall[0] = from;
      if (!overlap(face, wall)) return;
      const auto known = sides_.find(key);
      result |= known != sides_.end() && side(face, target) == known->second;
    });
    return result;
  }

  /// Notes a move that was made.
  void note(std::uint32_t v, const Point<3>& from) {
    const Point<3> to = world_.snapshot.point(v);
    for_each(v, [&](const Key& key, const Triangle& face, Triangle wall) {
      wall[0] = to;
      if (!overlap(face, wall))
        sides_.erase(key);
      else if (const int came_from = side(face, from); came_from != 0)
        sides_[key] = -came_from;
    });
  }

  std::size_t size() const { return sides_.size(); }

 private:
  using Triangle = std::array<Point<3>, 3>;
  using Key = std::tuple<std::size_t, std::size_t, std::array<std::uint32_t, 3>>;  ///< body, face, wall

  static int side(const Triangle& face, const Point<3>& x) {
    return volume_sign<3>(std::array{face[0], face[1], face[2], x});
  }

  /// True if both lie in one plane, and their interiors have a point in common.
  static bool overlap(const Triangle& a, const Triangle& b) {
    for (const Point<3>& x : b)
      if (side(a, x) != 0) return false;
    Point<3> apex = a[0];
    for (std::size_t k = 0; k < 3 && side(a, apex) == 0; ++k) {
      apex = a[0];
      apex[k] += 1;
    }
    const auto parts = [&](const Triangle& one, const Triangle& other) {
      const int turn = volume_sign<3>(std::array{one[0], one[1], one[2], apex});
      for (std::size_t k = 0; k < 3; ++k)
        if (std::ranges::none_of(other, [&](const Point<3>& x) {
              return volume_sign<3>(std::array{one[k], one[(k + 1) % 3], x, apex}) == turn;
            }))
          return true;
      return false;
    };
    return side(a, apex) != 0 && !parts(a, b) && !parts(b, a);
  }

  /// Calls visit(key, face, wall) for each face and each wall at a vertex; the wall has the vertex first.
  template <class Visit>
  void for_each(std::uint32_t v, const Visit& visit) const {
    const Snapshot<3>& snapshot = world_.snapshot;
    for (std::size_t i = 0; i < snapshot.cell_slots(); ++i) {
      const Cell c = snapshot.cell(i);
      if (c == Cell::none || snapshot.is_solid(c)) continue;
      for (std::size_t f = 0; f < snapshot.facet_count(c); ++f) {
        const Half_facet half = Snapshot<3>::half_facet(c, f);
        auto loop = snapshot.loop(half);
        if (!snapshot.is_impassable(half) || loop.size() != 3) continue;
        const auto at = std::ranges::find(loop, v);
        if (at == loop.end()) continue;
        std::iter_swap(loop.begin(), at);
        std::sort(loop.begin() + 1, loop.end());
        const Triangle wall{snapshot.point(loop[0]), snapshot.point(loop[1]), snapshot.point(loop[2])};
        std::array<std::uint32_t, 3> corners{loop[0], loop[1], loop[2]};
        std::sort(corners.begin(), corners.end());
        for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
          const auto x = world_.bodies[b]->positions();
          const auto faces = world_.bodies[b]->faces();
          for (std::size_t k = 0; k < faces.size(); ++k)
            visit(Key{b, k, corners}, Triangle{x[faces[k][0]], x[faces[k][1]], x[faces[k][2]]}, wall);
        }
      }
    }
  }

  const World& world_;
  std::map<Key, int> sides_;
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_RESHAPE_FACE_SIDES_H
