// SPDX-License-Identifier: LGPL-3.0-or-later
// The planes of tetrahedra for walks in floating point. It includes nothing of the library, so that the
// instructions of one kind of processor stay in the file that is compiled for it.
#ifndef CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PLAIN_PLANES_H
#define CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PLAIN_PLANES_H

namespace cellwalk::track_lengths {

/// The four planes n.x = o of a tetrahedron; n is a unit vector that points outwards. Both sides of a facet
/// have the same one, up to the sign. One cache line in single precision, two in double precision.
template <class Real>
struct alignas(16 * sizeof(Real)) Plain_planes {
  Real normal[3][4], offset[4];
};

inline constexpr unsigned plain_outside = 0xffffffffu;

/// A mesh for plain walks; cells by name.
template <class Real>
struct Plain_mesh {
  const Plain_planes<Real>* planes;
  const unsigned (*neighbours)[4];  ///< plain_outside beyond the boundary and walls
  unsigned most_steps;              ///< of a walk: a longer one has no end
};

struct Plain_ray {
  double from[3], to[3];
  unsigned cell;
};

enum Plain_end : unsigned char { plain_arrived, plain_left, plain_endless };

/// Rays that are followed together, at most.
inline constexpr unsigned most_together = 4;

/// Where walks write their pieces: row i is [begin[i], end[i]) of the list `list[i]`. Each list has room for
/// all pieces.
struct Plain_rows {
  struct List {
    unsigned* cells;
    double* lengths;
  } lists[most_together];
  unsigned char* list;
  unsigned long *begin, *end;
  Plain_end* how;
};

/// Follows rays, so many together.
void fused_walk(const Plain_mesh<double>& mesh, const Plain_ray* rays, unsigned count, unsigned together,
                const Plain_rows& rows);
void fused_walk(const Plain_mesh<float>& mesh, const Plain_ray* rays, unsigned count, unsigned together,
                const Plain_rows& rows);

}  // namespace cellwalk::track_lengths

#endif  // CELLWALK_EXPERIMENTS_TRACK_LENGTHS_PEERS_PLAIN_PLANES_H
