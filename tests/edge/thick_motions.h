// SPDX-License-Identifier: LGPL-3.0-or-later
// Motions with a radius made up for the worlds of the walk: half of them degenerate, with radii at which
// errors would show.
#ifndef CELLWALK_TESTS_EDGE_THICK_MOTIONS_H
#define CELLWALK_TESTS_EDGE_THICK_MOTIONS_H

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "edge/slit_worlds.h"
#include "edge/thick_oracle.h"
#include "edge/thin_worlds.h"
#include "oracle/seed.h"
#include "walk/oracle_worlds.h"

namespace cellwalk::test {

inline constexpr std::uint64_t thick_world_kinds = oracle::world_kinds + 4;

/// The worlds of the walk, spikes, sheets, windows among slits, and (3D) layers.
template <int D>
oracle::World<D> thick_world(std::uint64_t i) {
  const std::uint64_t kind = i % thick_world_kinds, seed = oracle::reseeded(i);
  if (kind == oracle::world_kinds) return spikes<D>(seed);
  if (kind == oracle::world_kinds + 1) return sheets<D>(seed);
  if (kind == oracle::world_kinds + 2) return slit_world<D>(seed);
  if constexpr (D == 3)
    if (kind == oracle::world_kinds + 3) {
      int slits = 0;
      return with_slits(layered_world(seed), seed, slits);
    }
  return oracle::make_world<D>(i / thick_world_kinds * oracle::world_kinds + kind % oracle::world_kinds);
}

/// How a radius was chosen.
enum class Radius_kind {
  of_start,
  above_start,
  of_still_end,
  of_sweep,
  above_sweep,
  lattice,
  random,
  tiny,
  count
};

template <int D>
class Thick_motions {
 public:
  /// \param of_faces the motions are those of faces
  Thick_motions(const oracle::World<D>& world, const Thick_oracle<D>& oracle, std::uint64_t seed,
                bool of_faces = false)
      : oracle_(oracle), source_(world, seed), of_faces_(of_faces) {}

  /// Mostly one that starts without meeting a wall.
  Thick_motion<D> next() {
    Thick_motion<D> motion;
    for (int tries = 0; tries < 6; ++tries) {
      motion = without_radius();
      start_ = root_rounded_down(oracle_.square_to_walls(before(motion)));
      if (start_ > 0) break;
    }
    choose_radius(motion);
    return motion;
  }

  Radius_kind radius_kind() const { return radius_kind_; }

 private:
  Random& random() { return source_.random(); }

  Thick_motion<D> without_radius() {
    const bool generic = random().chance(0.5);
    const oracle::Motion_kind kind = source_.kind(generic);
    Thick_motion<D> m;
    m.p = source_.start(kind);
    const auto shortened = [&](const Point<D>& x) {
      return m.p + std::ldexp(1, -static_cast<int>(random().below(3))) * (x - m.p);
    };
    m.target = shortened(source_.target(kind, m.p, m.p));
    const auto other_kind =
        kind == oracle::Motion_kind::in_wall_plane || kind == oracle::Motion_kind::along_edge
            ? oracle::Motion_kind::to_lattice
            : kind;
    m.q = shortened(source_.target(other_kind, m.p, m.target));
    if (!generic) make_degenerate(m);
    if (of_faces_) m.third = shortened(source_.target(other_kind, m.p, m.q));
    if (of_faces_ && !generic) make_face_degenerate(m);
    return m;
  }

  void make_face_degenerate(Thick_motion<D>& m) {
    const Thick_wall<D>& wall = oracle_.walls()[random().below(oracle_.walls().size())];
    const Vector<D> along = wall.corners[1] - wall.corners[0], across = wall.corners.back() - wall.corners[0];
    const auto eighths = [&] { return (static_cast<double>(random().below(17)) - 8) / 8; };
    switch (random().below(8)) {
      case 0:  // an edge, or less
        m.third = random().chance(0.5) ? m.q : m.p;
        break;
      case 1:  // in the line of p and q
        m.third = m.q + eighths() * (m.p - m.q);
        break;
      case 2:  // the side that stands still is parallel to an edge of a wall
        m.third = m.q + eighths() * along;
        break;
      case 3: {  // or to the wall
        const double s = eighths(), t = eighths();
        m.third = m.q + s * along + t * across;
        break;
      }
      case 4: {  // the face is parallel to the wall
        const double s = eighths(), t = eighths(), u = eighths();
        m.q = m.p + s * along;
        m.third = m.p + t * along + u * across;
        break;
      }
      case 5: {  // it becomes so
        const double s = eighths(), t = eighths(), u = eighths();
        m.third = m.q + s * along;
        m.target = m.q + t * along + u * across;
        break;
      }
      case 6: {  // p passes through the line of the side that stands still, in the plane of the face
        const double s = eighths();
        m.target = m.p + 2.0 * (m.q + s * (*m.third - m.q) - m.p);
        break;
      }
      default:
        break;
    }
  }

  void make_degenerate(Thick_motion<D>& m) {
    const Thick_wall<D>& wall = oracle_.walls()[random().below(oracle_.walls().size())];
    const Vector<D> along = wall.corners[1] - wall.corners[0], across = wall.corners.back() - wall.corners[0];
    const auto eighths = [&] { return (static_cast<double>(random().below(17)) - 8) / 8; };
    switch (random().below(10)) {
      case 0:
        m.q = m.p;
        break;
      case 1:  // to q, through it, or away from it
        m.target = m.p + (static_cast<double>(random().below(7)) - 2) / 2 * (m.q - m.p);
        break;
      case 2:
        m.target = m.p;
        break;
      case 3: {  // parallel to a wall
        const double s = eighths(), t = eighths();
        m.target = m.p + s * along + t * across;
        break;
      }
      case 4:  // the edge is parallel to one of a wall
        m.q = m.p + eighths() * along;
        break;
      case 5:  // it becomes so
        m.target = m.q + eighths() * along;
        break;
      case 6: {  // all are parallel to a wall
        const double s = eighths(), t = eighths();
        m.target = m.p + s * along;
        m.q = m.p + s * along + t * across;
        break;
      }
      case 7:  // towards a corner, or past it
        m.target = m.p + (1 + static_cast<double>(random().below(3))) / 2 * (wall.corners[0] - m.p);
        break;
      default:
        break;
    }
  }

  void choose_radius(Thick_motion<D>& m) {
    radius_kind_ = static_cast<Radius_kind>(random().below(static_cast<std::uint64_t>(Radius_kind::count)));
    const auto above = [](double x) { return std::nextafter(x, std::numeric_limits<double>::max()); };
    const auto distance_of = [&](const std::vector<Point<D>>& points) {
      return root_rounded_down(oracle_.square_to_walls(points));
    };
    double r = start_;
    switch (radius_kind_) {
      case Radius_kind::above_start:
        r = above(start_);
        break;
      case Radius_kind::of_still_end:
        // The nearer end stands still, so that a start at r is one of the still end.
        if (m.third && distance_of({*m.third}) > distance_of({m.p})) std::swap(m.p, *m.third);
        if (distance_of({m.p}) < distance_of({m.q})) std::swap(m.p, m.q);
        break;
      case Radius_kind::of_sweep:
        r = distance_of(swept(m));
        break;
      case Radius_kind::above_sweep:
        r = above(distance_of(swept(m)));
        break;
      case Radius_kind::lattice: {
        const auto& corners = oracle_.walls()[random().below(oracle_.walls().size())].corners;
        r = std::exp2(std::floor(std::log2(length(corners[1] - corners[0]))) -
                      static_cast<double>(random().below(5)));
        break;
      }
      case Radius_kind::random:
        r = start_ * random().real(0.05, 1.05);
        break;
      case Radius_kind::tiny:
        r = start_ * std::ldexp(1, -static_cast<int>(random().below(60)));
        break;
      default:
        break;
    }
    m.radius = r > 0 ? r : std::numeric_limits<double>::denorm_min();
  }

  const Thick_oracle<D>& oracle_;
  oracle::Motion_source<D> source_;
  bool of_faces_;
  double start_ = 0;
  Radius_kind radius_kind_{};
};

}  // namespace cellwalk::test

#endif  // CELLWALK_TESTS_EDGE_THICK_MOTIONS_H
