// SPDX-License-Identifier: LGPL-3.0-or-later
// The plain walk in floating point: in each tetrahedron the exit is the facet whose plane the ray meets first
// among those that it approaches from inside. No branch chooses it, there is no tolerance, and the length of
// a piece is the difference of two positions. Several rays may be followed together, so that the processor
// does not wait for one.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PLAIN_STEPS_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PLAIN_STEPS_H

#include "plain_planes.h"

#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace cellwalk::track_lengths {
namespace {

typedef double Doubles __attribute__((vector_size(32)));
typedef float Floats __attribute__((vector_size(16)));
template <class Real>
struct Lanes_of;
template <>
struct Lanes_of<double> {
  using V = Doubles;
};
template <>
struct Lanes_of<float> {
  using V = Floats;
};

/// Four lanes at once.
template <class V, class Real>
inline void load(const Real* lanes, V& vector) {
  __builtin_memcpy(&vector, lanes, sizeof(V));
}

/// The first lane in which two vectors are equal; there is one.
template <class V>
inline unsigned first_equal(const V& a, const V& b) {
#if defined(__AVX__)
  if constexpr (sizeof(V) == 32)
    return static_cast<unsigned>(
        __builtin_ctz(static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(a == b)))));
  else
    return static_cast<unsigned>(
        __builtin_ctz(static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(a == b)))));
#else
  return a[0] == b[0] ? 0 : a[1] == b[1] ? 1 : a[2] == b[2] ? 2 : 3;
#endif
}

template <class Real>
struct Walker {
  Real from[3], direction[3], length, at;
  unsigned cell, row, steps;
  unsigned char list;
  unsigned* cells;  // where the next piece is written
  double* lengths;
};

template <class Real>
inline void start(Walker<Real>& walker, const Plain_ray& ray) {
  double square = 0;
  for (int k = 0; k < 3; ++k) square += (ray.to[k] - ray.from[k]) * (ray.to[k] - ray.from[k]);
  const double length = __builtin_sqrt(square);
  for (int k = 0; k < 3; ++k) {
    walker.from[k] = static_cast<Real>(ray.from[k]);
    walker.direction[k] = static_cast<Real>((ray.to[k] - ray.from[k]) / length);
  }
  walker.length = static_cast<Real>(length);
  walker.at = 0;
  walker.cell = ray.cell;
  walker.steps = 0;
}

/// Takes a walker to the next cell, and writes the piece.
/// \return false if the walk ends
template <class Real>
inline bool step(const Plain_mesh<Real>& mesh, Walker<Real>& walker, Plain_end& how) {
  using V = typename Lanes_of<Real>::V;
  const Plain_planes<Real>& planes = mesh.planes[walker.cell];
  V x, y, z, offset;
  load(planes.normal[0], x);
  load(planes.normal[1], y);
  load(planes.normal[2], z);
  load(planes.offset, offset);
  const V slope = x * walker.direction[0] + y * walker.direction[1] + z * walker.direction[2];
  const V height = offset - x * walker.from[0] - y * walker.from[1] - z * walker.from[2];
  const V zero{}, infinity = zero + static_cast<Real>(__builtin_inf());
  const V met = slope > zero ? height / slope : infinity;
  V other = __builtin_shufflevector(met, met, 2, 3, 0, 1);
  V least = met < other ? met : other;
  other = __builtin_shufflevector(least, least, 1, 0, 3, 2);
  least = least < other ? least : other;
  const Real exit = least[0];
  *walker.cells++ = walker.cell;
  if (exit >= walker.length) {
    *walker.lengths++ = static_cast<double>(walker.length - walker.at);
    how = plain_arrived;
    return false;
  }
  *walker.lengths++ = static_cast<double>(exit - walker.at);
  walker.at = exit;
  walker.cell = mesh.neighbours[walker.cell][first_equal(met, least)];
  if (walker.cell == plain_outside) {
    how = plain_left;
    return false;
  }
  how = plain_endless;
  return ++walker.steps < mesh.most_steps;
}

template <class Real, unsigned together>
inline void follow(const Plain_mesh<Real>& mesh, const Plain_ray* rays, unsigned count,
                   const Plain_rows& rows) {
  Walker<Real> walkers[together];
  unsigned next = 0, active = 0;
  const auto starts = [&](Walker<Real>& walker) {
    if (next == count) return false;
    walker.row = next;
    rows.list[next] = walker.list;
    rows.begin[next] = static_cast<unsigned long>(walker.cells - rows.lists[walker.list].cells);
    start(walker, rays[next++]);
    return true;
  };
  for (unsigned i = 0; i < together; ++i) {
    Walker<Real>& walker = walkers[active];
    walker.list = static_cast<unsigned char>(i);
    walker.cells = rows.lists[i].cells;
    walker.lengths = rows.lists[i].lengths;
    active += starts(walker);
  }
  while (active > 0)
    for (unsigned i = 0; i < active;) {
      Walker<Real>& walker = walkers[i];
      Plain_end how;
      if (step(mesh, walker, how)) [[likely]] {
        ++i;
        continue;
      }
      rows.end[walker.row] = static_cast<unsigned long>(walker.cells - rows.lists[walker.list].cells);
      rows.how[walker.row] = how;
      if (starts(walker))
        ++i;
      else
        walker = walkers[--active];
    }
}

template <class Real>
inline void follow(const Plain_mesh<Real>& mesh, const Plain_ray* rays, unsigned count, unsigned together,
                   const Plain_rows& rows) {
  if (together == 1)
    follow<Real, 1>(mesh, rays, count, rows);
  else
    follow<Real, most_together>(mesh, rays, count, rows);
}

}  // namespace
}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PLAIN_STEPS_H
